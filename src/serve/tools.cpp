// SPDX-License-Identifier: MIT
#include "serve/tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "api/told.hpp"
#include "report/formats/reported.hpp"
#include "report/text/report.hpp"
#include "report/text/type_list.hpp"
#include "serve/asked.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostFindings = 10;
constexpr std::size_t kMostQuestions = 5;
constexpr std::size_t kMostLines = 6;       // of a run
constexpr std::size_t kMostAllLines = 300;  // of a whole run, a simulation
constexpr std::size_t kMostTypes = 400;

// --- Findings and their names ----------------------------------------------

bool is_question(const v1::Finding& finding) {
  return finding.level == v1::Level::Note && finding.code.starts_with("BT25");
}

std::string_view level_word(const v1::Finding& finding) {
  if (is_question(finding)) return "question";
  constexpr std::array<std::string_view, 3> kWords = {"note", "warning",
                                                      "error"};
  return kWords[static_cast<std::size_t>(finding.level)];
}

// "BT2208@50:12"; the second of two such is "BT2208@50:12#2".
std::vector<std::string> names_of(const v1::Report& report) {
  std::map<std::string, int> seen;
  std::vector<std::string> names;
  for (const v1::Finding& each : report.findings) {
    std::string name =
        fmt::format("{}@{}:{}", each.code, each.where.line, each.where.column);
    const int count = ++seen[name];
    if (count > 1) name += fmt::format("#{}", count);
    names.push_back(std::move(name));
  }
  return names;
}

std::string place_of(const v1::Position& where, const std::string& tree) {
  const std::string line =
      where.line == 0 ? "" : fmt::format("line {}", where.line);
  if (where.file.empty() || where.file == tree) return line;
  return line.empty() ? where.file : fmt::format("{} of {}", line, where.file);
}

// --- Runs --------------------------------------------------------------------

enum class Told : std::uint8_t { Choices, AllSteps };

// A line for each tick: what the world decides in it, or all that happens.
std::vector<std::string> lines_of(const v1::Run& run, Told told) {
  constexpr std::string_view kBegins = " begins";
  std::vector<std::string> lines;
  std::string heading;
  int time = -1;
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const v1::Step& step = run.steps[i];
    if (step.text.ends_with(kBegins)) {
      heading = step.text.substr(0, step.text.size() - kBegins.size());
    }
    const bool is_heading = step.text.ends_with(kBegins);
    if (is_heading || (told == Told::Choices && !step.is_chosen)) continue;
    if (lines.empty() || step.time != time) {
      lines.push_back((heading.empty() ? "before" : heading) + "  ");
    } else {
      lines.back() += ", ";
    }
    time = step.time;
    lines.back() += step.text;
  }
  if (run.loop && !lines.empty()) {
    lines.push_back(*run.loop < run.steps.size()
                        ? fmt::format("and so on for ever, from \"{}\"",
                                      run.steps[*run.loop].text)
                        : "and so on for ever");
  }
  return lines;
}

// Its beginning and its end where it is long.
void add_run(const v1::Run& run, std::size_t most, std::string& text,
             Told told = Told::Choices) {
  const std::vector<std::string> lines = lines_of(run, told);
  const bool is_long = lines.size() > most;
  const std::size_t behind = is_long ? most / 2 : 0;
  const std::size_t first = is_long ? most - behind - 1 : lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i == first && is_long) {
      text += fmt::format("  … {} more\n", lines.size() - first - behind);
    }
    if (i < first || i + behind >= lines.size()) {
      text += fmt::format("  {}\n", lines[i]);
    }
  }
}

// --- Changes of lines --------------------------------------------------------

// With the ends that they have.
std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
    lines.push_back(text.substr(at, end + 1 - at));
    at = end + 1;
  }
  return lines;
}

std::string text_of(const ServedSources& sources, const std::string& file) {
  auto read = sources.file(file);
  if (!read.value) {
    throw RpcError(rpc::kInvalidParams, read.diagnostics.front().message);
  }
  return read.value->text;
}

std::string without_end(std::string line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) {
    line.pop_back();
  }
  return line;
}

void add_diff(const AskedTree& asked, const v1::Finding& finding,
              std::string& text) {
  for (const v1::Change& change : finding.repair) {
    const auto lines = lines_in(text_of(*asked.sources, change.file));
    text += fmt::format("  @@ {}, line {}\n", change.file, change.first);
    for (std::size_t i = 0; i < change.removed; ++i) {
      const std::size_t at = change.first - 1 + i;
      if (at < lines.size()) text += "  -" + without_end(lines[at]) + '\n';
    }
    for (const std::string& line : change.added) {
      text += "  +" + without_end(line) + '\n';
    }
  }
}

// The files as they are with the changes made.
std::map<std::string, std::string> edited_files(const AskedTree& asked,
                                                const v1::Finding& finding) {
  std::map<std::string, std::vector<const v1::Change*>> by_file;
  for (const v1::Change& change : finding.repair) {
    by_file[change.file].push_back(&change);
  }
  std::map<std::string, std::string> edited;
  for (auto& [file, changes] : by_file) {
    std::vector<std::string> lines = lines_in(text_of(*asked.sources, file));
    const std::string end =
        !lines.empty() && lines[0].ends_with("\r\n") ? "\r\n" : "\n";
    std::ranges::sort(changes, std::greater<>(), &v1::Change::first);
    for (const v1::Change* change : changes) {
      const auto at = lines.begin() + static_cast<std::ptrdiff_t>(std::min(
                                          change->first - 1, lines.size()));
      const auto behind = at + static_cast<std::ptrdiff_t>(std::min(
                                   change->removed,
                                   static_cast<std::size_t>(lines.end() - at)));
      std::vector<std::string> added;
      for (const std::string& line : change->added) {
        added.push_back(without_end(line) + end);
      }
      const auto put = lines.erase(at, behind);
      lines.insert(put, added.begin(), added.end());
    }
    std::string text;
    for (const std::string& line : lines) text += line;
    edited[file] = std::move(text);
  }
  return edited;
}

// --- Reports --------------------------------------------------------------

void add_finding(const AskedTree& asked, const v1::Finding& finding,
                 const std::string& name, std::string& text, Json& list) {
  const std::string& tree = asked.fields.request.tree;
  const std::string place = place_of(finding.where, tree);
  text += fmt::format("{} {}{}{}: {}\n", name, level_word(finding),
                      place.empty() ? "" : ", ", place,
                      finding.message.substr(0, finding.message.find('\n')));
  if (!finding.help.empty()) text += fmt::format("  help: {}\n", finding.help);
  if (finding.run) add_run(*finding.run, kMostLines, text);
  if (!finding.repair.empty()) {
    text += "  repair, checked: with it the finding is gone\n";
    add_diff(asked, finding, text);
  }
  list.push(Json{{"finding", name},
                 {"code", finding.code},
                 {"level", level_word(finding)},
                 {"file", finding.where.file},
                 {"line", finding.where.line},
                 {"node", finding.node},
                 {"message", finding.message},
                 {"has_repair", !finding.repair.empty()}});
}

// Those that are as expected are counted.
void add_rules(const v1::Report& report, std::string& text, Json& data) {
  Json list = Json::array();
  std::size_t met = 0;
  std::size_t shown = 0;
  for (const v1::Rule& rule : report.rules) {
    list.push(Json{{"rule", rule.name},
                   {"verdict", verdict_word(rule.verdict)},
                   {"is_met", rule.is_met}});
    if (rule.is_met) ++met;
    if (rule.is_met || shown == kMostFindings) continue;
    ++shown;
    text +=
        fmt::format("rule {}: {}{}\n", rule.name, verdict_word(rule.verdict),
                    rule.reason.empty() ? "" : ": " + rule.reason);
    if (rule.run) add_run(*rule.run, kMostLines, text);
  }
  const std::size_t more = report.rules.size() - met - shown;
  if (more > 0) text += fmt::format("and {} more rules are not met\n", more);
  if (met > 0) {
    text += fmt::format("{} as expected\n", counted(met, "rule", "rules"));
  }
  data.add("rules", list);
}

constexpr std::array<std::string_view, 5> kOutcomes = {
    "met", "missed", "bad input", "undecided", "internal error"};

// The sum of it, and its findings: warnings and errors first.
ToolAnswer answer_of(const AskedTree& asked, const v1::Report& report) {
  const auto names = names_of(report);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < report.findings.size(); ++i) {
    if (!is_of_rule(report.findings[i])) order.push_back(i);
  }
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) {
    return static_cast<int>(report.findings[i].level) * 2 +
           (is_question(report.findings[i]) ? 0 : 1);
  });
  std::map<std::string_view, std::size_t> counts;
  for (const std::size_t i : order) ++counts[level_word(report.findings[i])];
  ToolAnswer answer;
  std::string counted_levels;
  for (const auto& [word, count] : counts) {
    counted_levels +=
        fmt::format("{}, ", counted(count, word, std::string(word) + 's'));
  }
  answer.text = fmt::format(
      "{}: {}; {}{} nodes, {} states{}\n", report.tree,
      kOutcomes[static_cast<std::size_t>(report.outcome)],
      counted_levels.empty() ? "no findings, " : counted_levels,
      report.node_count, report.states,
      report.stopped.empty() ? ""
                             : fmt::format(", stopped by {}", report.stopped));
  answer.data.add("outcome",
                  kOutcomes[static_cast<std::size_t>(report.outcome)]);
  answer.data.add("states", report.states);
  answer.data.add("stopped", report.stopped);
  add_rules(report, answer.text, answer.data);
  Json list = Json::array();
  std::size_t shown = 0;
  std::size_t questions = 0;
  for (const std::size_t i : order) {
    const v1::Finding& finding = report.findings[i];
    if (shown == kMostFindings ||
        (is_question(finding) && questions == kMostQuestions)) {
      continue;
    }
    ++shown;
    if (is_question(finding)) ++questions;
    add_finding(asked, finding, names[i], answer.text, list);
  }
  if (shown < order.size()) {
    answer.text += fmt::format("and {} more\n", order.size() - shown);
  }
  answer.data.add("findings", list);
  answer.data.add("more", order.size() - shown);
  return answer;
}

// The finding that the arguments name, of the tree as it is now.
struct NamedFinding {
  AskedTree asked;
  v1::Report report;
  std::size_t number = 0;

  const v1::Finding& finding() const { return report.findings[number]; }
};

NamedFinding finding_named_by(const JsonValue& arguments, Work& work,
                              const std::vector<std::string>& others) {
  NamedFinding found{asked_by(arguments, others), {}, 0};
  const std::string name = needed_text(arguments, "finding");
  found.report = checked_once(found.asked, work);
  const auto names = names_of(found.report);
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) {
    throw RpcError(rpc::kInvalidParams,
                   fmt::format("the tree has no finding `{}` now; check_tree "
                               "lists those that it has",
                               name.substr(0, 80)));
  }
  found.number = static_cast<std::size_t>(at - names.begin());
  return found;
}

// --- The tools ------------------------------------------------------------

ToolAnswer check_tree(const JsonValue& arguments, Work& work) {
  const AskedTree asked = asked_by(arguments, {});
  return answer_of(asked, checked_once(asked, work));
}

ToolAnswer explain_finding(const JsonValue& arguments, Work& work) {
  ToolAnswer answer;
  std::string code = arguments.word("code");
  if (arguments.member("tree") != nullptr) {
    const NamedFinding named =
        finding_named_by(arguments, work, {"code", "finding"});
    const v1::Finding& finding = named.finding();
    code = finding.code;
    answer.text = fmt::format("{}\n", finding.message);
    if (finding.run) {
      answer.text += "The run that shows it:\n";
      add_run(*finding.run, kMostAllLines, answer.text, Told::AllSteps);
    }
    answer.text += '\n';
  } else {
    refuse_others(arguments, {"code", "finding", "tree"});
  }
  const auto explained = v1::explain(code);
  if (!explained) {
    throw RpcError(rpc::kInvalidParams,
                   fmt::format("there is no code `{}`; give `code`, or `tree` "
                               "and `finding`",
                               code.substr(0, 80)));
  }
  answer.text +=
      fmt::format("{}: {}\n{}\nWhat to do: {}\n", explained->code,
                  explained->summary, explained->description, explained->help);
  answer.data.add("code", explained->code);
  return answer;
}

ToolAnswer propose_repair(const JsonValue& arguments, Work& work) {
  const NamedFinding named = finding_named_by(arguments, work, {"finding"});
  const v1::Finding& finding = named.finding();
  ToolAnswer answer;
  answer.data.add("has_repair", !finding.repair.empty());
  if (finding.repair.empty()) {
    answer.text = fmt::format(
        "No change of lines is known that mends it.{}\n",
        finding.help.empty() ? "" : " What may help: " + finding.help);
    return answer;
  }
  answer.text = fmt::format(
      "{}\nWith these lines the finding is gone, and no other warning is "
      "there:\n",
      finding.help);
  add_diff(named.asked, finding, answer.text);
  return answer;
}

ToolAnswer apply_repair(const JsonValue& arguments, Work& work) {
  const NamedFinding named = finding_named_by(arguments, work, {"finding"});
  const v1::Finding& finding = named.finding();
  if (finding.repair.empty()) {
    throw RpcError(rpc::kInvalidParams,
                   "no change of lines is known that mends it");
  }
  ToolAnswer answer;
  Json files = Json::array();
  for (const auto& [file, text] : edited_files(named.asked, finding)) {
    answer.text +=
        fmt::format("{}{}:\n{}", answer.text.empty() ? "" : "\n", file, text);
    files.push(Json{{"file", file}, {"text", text}});
  }
  answer.data.add("files", files);
  return answer;
}

ToolAnswer simulate_tree(const JsonValue& arguments, Work& work) {
  const AskedTree asked = asked_by(arguments, {});
  const v1::Simulation run = v1::simulated(
      asked.fields.request, asked.fields.plan, *asked.sources, &work);
  ToolAnswer answer;
  for (const v1::Finding& each : run.findings) {
    if (each.level == v1::Level::Error) answer.text += each.message + '\n';
  }
  const std::size_t left_out =
      run.lines.size() - std::min(run.lines.size(), kMostAllLines);
  if (left_out > 0) answer.text += fmt::format("… {} lines before\n", left_out);
  for (std::size_t i = left_out; i < run.lines.size(); ++i) {
    answer.text += run.lines[i] + '\n';
  }
  answer.text += run.end + '\n';
  answer.data.add("end", run.end);
  answer.data.add("ticks", run.ticks);
  return answer;
}

ToolAnswer list_node_types(const JsonValue& arguments, Work&) {
  refuse_others(arguments, {"profile", "part"});
  const std::string word = arguments.word("profile");
  const auto profile = word.empty() ? Profile::Btcpp4 : profile_named(word);
  if (!profile) {
    throw RpcError(rpc::kInvalidParams,
                   fmt::format("there is no profile `{}`", word.substr(0, 80)));
  }
  ToolAnswer answer;
  auto lines = type_lines(*profile, arguments.word("part"));
  answer.data.add("count", lines.size());
  lines.resize(std::min(lines.size(), kMostTypes));
  for (const std::string& line : lines) answer.text += line + '\n';
  if (lines.empty()) {
    answer.text = fmt::format("no node type of {} has this in its name\n",
                              profile_name(*profile));
  }
  return answer;
}

// --- What they are told ---------------------------------------------------

using Parameter = ToolParameter;
constexpr Parameter kTree{"tree", "string",
                          "the tree's file: XML of BehaviorTree.CPP, or .btf",
                          true};
constexpr Parameter kText{
    "text", "string",
    "the text of that file, where it is not to be read from the disk"};
constexpr Parameter kFiles{"files", "object",
                           "texts of other files, by their names"};
constexpr Parameter kProfile{
    "profile", "string",
    "the engine: nav2-jazzy, btcpp-4.9, …; without it, as the tree says"};
constexpr Parameter kMainTree{"main_tree", "string",
                              "the ID of the tree that runs"};
constexpr Parameter kLeaves{"leaves", "texts", "files of leaf contracts"};
constexpr Parameter kModels{"models", "texts", "files with a <TreeNodesModel>"};
constexpr Parameter kRules{"rules", "texts", "files of rules"};
constexpr Parameter kTypedRules{
    "typed_rules", "texts",
    "rules: \"never dock.failure\", \"every tick: a.success => b.failure\""};
constexpr Parameter kSeconds{"seconds", "number", "the most it may take"};
constexpr Parameter kFinding{"finding", "string",
                             "as check_tree names it: BT2208@50:12", true};

constexpr auto kOfCheck =
    std::to_array<Parameter>({kTree, kText, kFiles, kRules, kTypedRules,
                              kLeaves, kModels, kProfile, kMainTree, kSeconds});
constexpr auto kOfFinding = std::to_array<Parameter>(
    {kTree, kFinding, kText, kFiles, kRules, kTypedRules, kLeaves, kModels,
     kProfile, kMainTree, kSeconds});
constexpr auto kOfExplain = std::to_array<Parameter>(
    {{"code", "string", "a code alone: BT2208"},
     {"tree", "string", "the tree, for the whole run of one of its findings"},
     {"finding", "string", "as check_tree names it: BT2208@50:12"},
     kText,
     kFiles,
     kRules,
     kTypedRules,
     kLeaves,
     kModels,
     kProfile,
     kMainTree,
     kSeconds});
constexpr auto kOfSimulate = std::to_array<Parameter>(
    {kTree,
     kText,
     kFiles,
     kLeaves,
     kModels,
     kProfile,
     kMainTree,
     {"seed", "integer", "answers by chance; the same seed, the same run"},
     {"script", "string",
      "the name of a file of answers, one of `files` for instance"},
     {"run_ticks", "integer", "how many ticks of the tree; 100 without it"},
     kSeconds});
constexpr auto kOfTypes = std::to_array<Parameter>(
    {{"profile", "string", "nav2-jazzy, btcpp-4.9, paper for .btf, …"},
     {"part", "string", "of their names"}});

constexpr auto kTools = std::to_array<ToolRow>({
    {"check_tree", "Check a behavior tree",
     "Tries every run of a behavior tree. Without rules, tells what is "
     "suspicious in it, each finding with a run that shows it and, where one "
     "is known, a checked repair; with rules, a verdict for each.",
     kOfCheck, check_tree},
    {"explain_finding", "Explain a finding",
     "What a code means and what to do about it; with `tree` and `finding`, "
     "the whole run that shows it as well.",
     kOfExplain, explain_finding},
    {"propose_repair", "Propose a repair",
     "The change of lines that makes a finding go away, as a diff. It was "
     "checked: no other warning appears.",
     kOfFinding, propose_repair},
    {"apply_repair", "Apply a repair",
     "Returns the text of the tree's file with the repair made. Nothing is "
     "written.",
     kOfFinding, apply_repair},
    {"simulate", "Simulate a run",
     "One run of the tree, tick by tick: by a seed, by a script of answers, or "
     "with the first answer of each leaf.",
     kOfSimulate, simulate_tree},
    {"list_node_types", "List node types",
     "The node types of an engine: kind, ports, and what each does.", kOfTypes,
     list_node_types},
});

}  // namespace

std::span<const ToolRow> tools() { return kTools; }

Json schema_of(const ToolRow& tool) {
  Json properties = Json::object();
  Json needed = Json::array();
  for (const ToolParameter& each : tool.parameters) {
    Json one = Json::object();
    if (each.type == "texts") {
      one.add("type", "array").add("items", Json{{"type", "string"}});
    } else {
      one.add("type", each.type);
    }
    one.add("description", each.about);
    properties.add(each.name, one);
    if (each.is_needed) needed.push(each.name);
  }
  Json schema{{"type", "object"}, {"properties", properties}};
  if (!needed.is_empty()) schema.add("required", needed);
  schema.add("additionalProperties", false);
  return schema;
}

}  // namespace btcheck

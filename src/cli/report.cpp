// SPDX-License-Identifier: MIT
//
// Verdicts first, each in one line that can be read alone; the run that
// explains it below. Words carry the meaning, never colour.
#include "cli/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace btcheck {
namespace {

std::string_view verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::Holds:
      return "HOLDS";
    case Verdict::Violated:
      return "VIOLATED";
    case Verdict::Undecided:
      return "UNDECIDED";
  }
  return "";
}

std::string plural(std::uint64_t count, std::string_view word,
                   std::string_view words) {
  return fmt::format("{} {}", grouped(count), count == 1 ? word : words);
}

// How much time a run takes. One that shows a late answer ends with the unit
// in which it would have had to come, and that is one too many.
std::string ticks_text(const Run& run, TickSemantics ticks, bool is_late) {
  int elapsed = 0;
  const std::size_t end = run.loop == kNoLoop ? run.steps.size() : run.loop;
  for (std::size_t i = 0; i < end; ++i) elapsed += run.steps[i].step.elapsed;
  elapsed -= is_late ? 1 : 0;
  if (ticks == TickSemantics::Root) return plural(elapsed, "tick", "ticks");
  return plural(elapsed, "unit of time", "units of time");
}

// What stands after the name: how a verdict came about.
std::string note_of(const PropertyVerdict& verdict, TickSemantics ticks) {
  const Property& property = *verdict.property;
  std::string note;
  if (verdict.verdict == Verdict::Undecided) {
    return stop_text(verdict.stopped, verdict.progress);
  }
  if (verdict.run) {
    note = property.form == PropertyForm::Possible ? "witness after "
                                                   : "after ";
    const bool is_late = property.form == PropertyForm::Response &&
                         verdict.run->loop == kNoLoop;
    note += ticks_text(*verdict.run, ticks, is_late);
    if (verdict.run->loop != kNoLoop) note += ", then for ever";
  } else if (property.form == PropertyForm::Response) {
    note = verdict.longest_answer < 0
               ? "its trigger never happens"
               : fmt::format("answered within {} of {}",
                             verdict.longest_answer, property.to);
  }
  if (property.expectation == Expectation::None) return note;
  const bool met = verdict.met_expectation();
  const std::string_view expected =
      property.expectation == Expectation::Holds ? "to hold" : "a violation";
  if (!note.empty()) note += "; ";
  return note + (met ? "as expected" : fmt::format("expected {}", expected));
}

std::string verdict_text(const CheckResult& result, const CheckedFile& file,
                         const PropertyVerdict& verdict, Detail detail) {
  const Property& property = *verdict.property;
  const std::string note = note_of(verdict, file.network->ticks);
  std::string text = fmt::format("{:<9}  {}", verdict_word(verdict.verdict),
                                 property.name);
  if (!note.empty()) text += fmt::format("  ({})", note);
  text += '\n';
  if (!property.title.empty()) {
    text += fmt::format("           {}\n", property.title);
  }
  if (!verdict.error.empty()) {
    return text + fmt::format("           internal error: {}\n",
                              verdict.error);
  }
  const bool is_news = !verdict.met_expectation() ||
                       (verdict.verdict == Verdict::Violated &&
                        property.expectation == Expectation::None);
  if (!verdict.run || (!is_news && detail == Detail::Events)) return text;
  TextStyle style;
  style.detail = detail;
  if (property.form == PropertyForm::Response) {
    style.trigger_state = verdict.trigger_state;
  }
  text += fmt::format("           {}\n\n", property.text);
  text += run_text(*result.tree, *file.network, *verdict.run, style);
  return text + '\n';
}

std::string sums_text(const CheckedFile& file) {
  std::size_t holds = 0, violated = 0, undecided = 0, missed = 0;
  for (const PropertyVerdict& verdict : file.verdicts) {
    holds += verdict.verdict == Verdict::Holds;
    violated += verdict.verdict == Verdict::Violated;
    undecided += verdict.verdict == Verdict::Undecided;
    missed += !verdict.met_expectation();
  }
  std::string text = fmt::format(
      "\n{}: {} hold, {} violated, {} undecided",
      plural(file.verdicts.size(), "property", "properties"), holds, violated,
      undecided);
  if (missed == 0) return text + (undecided > 0 ? "\n" : "; all as expected\n");
  return text + fmt::format("; {} not as expected\n", missed);
}

struct TreeWords {
  TreeQuestion question;
  std::string_view words;
};
constexpr TreeWords kTreeWords[] = {
    {TreeQuestion::CanSucceed, "the mission can succeed"},
    {TreeQuestion::CanFail, "the mission can fail"},
    {TreeQuestion::CanAlwaysEnd, "from every state it can still end"},
    {TreeQuestion::NeverStuck, "it is never stuck"},
    {TreeQuestion::InRange, "every assignment stays in range"},
    {TreeQuestion::NoZeroTimeLoop, "every tick returns"}};

std::string tree_line(const TreeReport& report) {
  std::string_view words;
  for (const TreeWords& known : kTreeWords) {
    if (known.question == report.question) words = known.words;
  }
  std::string answer = "yes";
  if (report.verdict == Verdict::Violated) answer = "NO";
  if (report.verdict == Verdict::Undecided) answer = "UNDECIDED";
  const bool is_possibility = report.question == TreeQuestion::CanSucceed ||
                              report.question == TreeQuestion::CanFail;
  if (report.run) {
    answer += is_possibility ? fmt::format(", first at tick {}", report.ticks)
                             : std::string(", see below");
  }
  return fmt::format("  {:<36} {}\n", words, answer);
}

// A cell of the node table: the first tick, `-` for never, `?` for unknown,
// blank for what this type of node never does.
std::string cell(const Possibility& answer, bool applies) {
  if (answer.verdict == Verdict::Holds) return std::to_string(answer.ticks);
  if (!applies) return "";
  return answer.verdict == Verdict::Violated ? "-" : "?";
}

bool applies(const Network& network, NodeId node, std::size_t question) {
  constexpr std::array<std::string_view, kNodeQuestionCount> kLocations = {
      "tick_node", "success", "failure", "running", "halted"};
  const Automaton& automaton =
      network.automaton(network.node_automaton[index(node)]);
  return automaton.find_location(kLocations[question]).has_value();
}

int depth_of(const BehaviorTree& tree, NodeId node) {
  int depth = 0;
  for (; !tree.node(node).is_root(); node = tree.node(node).parent) ++depth;
  return depth;
}

constexpr std::size_t kNameWidth = 34;

std::string node_line(const BehaviorTree& tree, const Network& network,
                      const NodeReport& report) {
  const Node& node = tree.node(report.node);
  std::string name(static_cast<std::size_t>(depth_of(tree, report.node)), ' ');
  const std::string type(type_name(node.type));
  name += node.name.rfind(type, 0) == 0 ? node.name
                                        : fmt::format("{} {}", type, node.name);
  if (name.size() > kNameWidth) name = name.substr(0, kNameWidth - 1) + "~";
  std::string line = fmt::format("{:>5} {:<{}}", node.span.line, name,
                                 kNameWidth);
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    line += fmt::format(" {:>7}", cell(report.answers[q],
                                       applies(network, report.node, q)));
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

bool never(const NodeReport& report, NodeQuestion question) {
  return report.answers[static_cast<std::size_t>(question)].verdict ==
         Verdict::Violated;
}

bool may(const NodeReport& report, NodeQuestion question) {
  return report.answers[static_cast<std::size_t>(question)].verdict ==
         Verdict::Holds;
}

// Nodes that the author surely meant to be of use, and are not.
std::string worth_a_look(const BehaviorTree& tree,
                         const std::vector<NodeReport>& reports) {
  std::string text;
  for (const NodeReport& report : reports) {
    const Node& node = tree.node(report.node);
    const std::string name =
        fmt::format("  {} (line {})", node.name, node.span.line);
    if (never(report, NodeQuestion::Ticked)) {
      const bool parent_too =
          !node.is_root() &&
          never(reports[index(node.parent)], NodeQuestion::Ticked);
      if (!parent_too) text += name + " can never be ticked\n";
      continue;
    }
    if (!may(report, NodeQuestion::Ticked)) continue;
    const bool is_parallel = node.type == NodeType::Parallel ||
                             node.type == NodeType::ParallelAll;
    if (is_parallel && never(report, NodeQuestion::Success)) {
      text += name + fmt::format(" can never succeed: {} of {} children never "
                                 "do\n",
                                 node.threshold, node.children.size());
    }
    if (node.type == NodeType::Eval && !node.assignment) {
      if (never(report, NodeQuestion::Failure)) {
        text += name + " is always true when it is ticked\n";
      } else if (never(report, NodeQuestion::Success)) {
        text += name + " is never true when it is ticked\n";
      }
    }
  }
  return text.empty() ? text : "\nWorth a look\n" + text;
}

std::string fault_runs(const CheckResult& result, const CheckedFile& file,
                       Detail detail) {
  std::string text;
  for (const TreeReport& report : file.defaults->tree) {
    if (!is_fault(report) || !report.run) continue;
    for (const TreeWords& known : kTreeWords) {
      if (known.question == report.question) {
        text += fmt::format("\nNot so: {}\n", known.words);
      }
    }
    TextStyle style;
    style.detail = detail;
    text += report.run->steps.empty()
                ? "    from the very beginning\n"
                : run_text(*result.tree, *file.network, *report.run, style);
  }
  return text;
}

}  // namespace

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) {
    digits.insert(at - 3, ",");
  }
  return digits;
}

std::string stop_text(StopReason reason, const SearchProgress& progress) {
  const std::string covered =
      fmt::format("after {} states", grouped(progress.states));
  switch (reason) {
    case StopReason::MaxStates:
      return covered + ": the limit of --max-states; allow more";
    case StopReason::Memory:
      return covered + ": the limit of --memory; allow more, or --max-states";
    case StopReason::Timeout:
      return covered + ": the limit of --timeout; allow more";
    case StopReason::Interrupted:
      return covered + ": interrupted";
    case StopReason::None:
      break;
  }
  return covered;
}

std::string heading_text(const CheckResult& result, const CheckedFile& file) {
  const BehaviorTree& tree = *result.tree;
  return fmt::format("{}: {}, {}; profile paper, tick {}, no assumptions\n",
                     tree.file, plural(tree.nodes.size(), "node", "nodes"),
                     plural(tree.variables.size(), "variable", "variables"),
                     tick_name(file.network->ticks));
}

std::string verdicts_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail) {
  std::string text;
  for (const PropertyVerdict& verdict : file.verdicts) {
    text += verdict_text(result, file, verdict, detail);
  }
  if (text.ends_with("\n\n")) text.pop_back();
  return text + sums_text(file);
}

std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail) {
  const DefaultReport& report = *file.defaults;
  const BehaviorTree& tree = *result.tree;
  std::string text = "\nThe mission as a whole\n";
  for (const TreeReport& answer : report.tree) text += tree_line(answer);
  text += fmt::format(
      "\nEach node, and the tick at which it can first be so (-: never)\n"
      "{:>5} {:<{}} {:>7} {:>7} {:>7} {:>7} {:>7}\n",
      "line", "node", kNameWidth, "ticked", "success", "failure", "running",
      "halted");
  for (const NodeReport& node : report.nodes) {
    text += node_line(tree, *file.network, node);
  }
  text += worth_a_look(tree, report.nodes);
  text += fault_runs(result, file, detail);
  if (report.stopped != StopReason::None) {
    text += fmt::format("\nUNDECIDED where a ? stands: {}\n",
                        stop_text(report.stopped, report.progress));
  }
  if (!report.error.empty()) text += "\ninternal error: " + report.error + "\n";
  return text;
}

ExitCode exit_code_of(const CheckedFile& file) {
  ExitCode code = ExitCode::Met;
  auto worsen = [&](ExitCode other) { code = worst_of(code, other); };
  for (const PropertyVerdict& verdict : file.verdicts) {
    if (!verdict.error.empty()) worsen(ExitCode::Internal);
    if (verdict.verdict == Verdict::Undecided) worsen(ExitCode::Undecided);
    if (!verdict.met_expectation()) worsen(ExitCode::Missed);
  }
  if (!file.defaults) return code;
  if (!file.defaults->error.empty()) worsen(ExitCode::Internal);
  for (const TreeReport& report : file.defaults->tree) {
    if (is_fault(report)) worsen(ExitCode::Missed);
  }
  if (file.defaults->stopped != StopReason::None) worsen(ExitCode::Undecided);
  return code;
}

ExitCode worst_of(ExitCode one, ExitCode other) {
  constexpr std::array<ExitCode, 5> kWorstFirst = {
      ExitCode::Internal, ExitCode::BadInput, ExitCode::Missed,
      ExitCode::Undecided, ExitCode::Met};
  for (const ExitCode code : kWorstFirst) {
    if (one == code || other == code) return code;
  }
  return ExitCode::Met;
}

}  // namespace btcheck

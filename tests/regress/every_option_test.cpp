// SPDX-License-Identifier: MIT
//
// Nothing is accepted and ignored: every option of every command that reads
// trees, on a tree of each language, makes a difference that can be seen, or is
// refused. What makes none by its nature stands in a list, with the reason; an
// option that is added here or there has to be judged.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "cli/options/tables.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"
#include "text/json.hpp"

namespace btcheck::every_option_test {
namespace {

namespace fs = std::filesystem;

const std::string kProgram = "'" BTCHECK_PROGRAM "'";

// Both warn when they are read, have a finding with a repair, delays, and more
// states than a search looks at between two looks at its limits.
constexpr std::string_view kBtf = R"((defsv battery
  :states (Good Low) :init Good :transitions :all)
(BehaviorTree :name t
  (Sequence
    (RateController :hz 5 (Fallback (Eval (= battery good)) (Action :ID rest)))
    (ReactiveSequence (Condition :ID clear) (Action :ID act))
    (ParallelAll (Action :ID a) (Action :ID b) (Action :ID c) (Action :ID d))))
)";

constexpr std::string_view kXml =
    R"(<root BTCPP_format="4" main_tree_to_execute="T">
  <BehaviorTree ID="T">
    <Fallback>
      <AsyncSequence><Act name="e"/><Delay delay_msec="200"><Ask/></Delay><Act/>
      </AsyncSequence>
      <Timeout msec="300"><Act name="again"/></Timeout>
      <Parallel success_count="1"><Do/><Move/></Parallel>
      <ParallelAll><Act name="a"/><Act name="b"/><Act name="c"/><Act name="d"/>
      </ParallelAll>
    </Fallback>
  </BehaviorTree>
  <BehaviorTree ID="U"><Sequence><Act/><Act/></Sequence></BehaviorTree>
</root>
)";

// About which there is something to ask.
constexpr std::string_view kAsked =
    R"(<root BTCPP_format="4" main_tree_to_execute="T">
  <BehaviorTree ID="T">
    <Sequence>
      <Parallel><Sequence><Ask/><Act/><Do/></Sequence><Move/></Parallel>
      <ParallelAll><Act name="a"/><Act name="b"/><Act name="c"/><Act name="d"/>
      </ParallelAll>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="U"><Repeat num_cycles="-1"><Act/></Repeat></BehaviorTree>
</root>
)";

constexpr std::string_view kRules = R"(property can: possible root.success
property ends expect violated: eventually root.ended
property all: never root.success and root.failure
property late: never act.success
)";

void write(const fs::path& file, std::string_view text) {
  std::ofstream(file) << text;
}

struct Language {
  std::string tree;
  std::string_view text;
};
const Language kLanguages[] = {{"t.btf", kBtf}, {"t.xml", kXml}};

// An editor that opens the tree, asks what a check comes to, and ends.
std::string editor_session(const fs::path& folder, const std::string& tree,
                           std::string_view text) {
  const std::string uri = Json("file://" + (folder / tree).string()).text();
  std::string all;
  const auto send = [&](const std::string& message) {
    all += fmt::format("Content-Length: {}\r\n\r\n{}", message.size(), message);
  };
  send(fmt::format(R"({{"jsonrpc":"2.0","id":1,"method":"initialize","params":)"
                   R"({{"rootUri":{}}}}})",
                   Json("file://" + folder.string()).text()));
  send(fmt::format(
      R"({{"jsonrpc":"2.0","method":"textDocument/didOpen","params":)"
      R"({{"textDocument":{{"uri":{},"version":1,"text":{}}}}}}})",
      uri, Json(text).text()));
  send(fmt::format(R"({{"jsonrpc":"2.0","id":2,"method":"btcheck/check",)"
                   R"("params":{{"textDocument":{{"uri":{}}}}}}})",
                   uri));
  return all;
}

std::string replaced(std::string_view text, std::string_view what,
                     std::string_view with) {
  std::string result(text);
  for (auto at = result.find(what); at != result.npos;
       at = result.find(what, at + with.size())) {
    result.replace(at, what.size(), with);
  }
  return result;
}

// A folder with a tree and all that options name.
void fill(const fs::path& folder, const Language& language) {
  fs::create_directory(folder / "trees");
  write(folder / "trees" / language.tree, language.text);
  fs::create_directory(folder / "changed");
  write(folder / "changed" / language.tree,
        replaced(language.text, "Sequence", "Fallback"));
  write(folder / "trees/t.ltl",
        "tree \"" + language.tree + "\"\n" + std::string(kRules));
  write(folder / "more.ltl", "property more: [] tick.ends => <> root.ended\n");
  write(
      folder / "models.xml",
      "<root><TreeNodesModel><Condition ID=\"Ask\"/></TreeNodesModel></root>");
  write(folder / "t.leaves", "(defaction Act :returns (success failure))\n");
  write(folder / "other.toml",
        "loop = true\n[levels]\nBT1620 = \"error\"\nBT1007 = \"error\"\n");
  write(folder / "trees/btcheck.toml",
        "tick-ms = 60\n[levels]\nBT1620 = \"warning\"\nBT1007 = \"note\"\n");
  write(folder / "events.jsonl", "{\"topic\": \"/odom\", \"time\": 1}\n");
  write(folder / "answers.txt", "1\n1\n1\n");
  write(folder / "t.tests.jsonl", "somebody else's\n");
  const std::string tree = "trees/" + language.tree;
  for (const std::string_view method : {"init", "describe"}) {
    const std::string asked = fmt::format(
        R"({{"jsonrpc":"2.0","id":1,"method":"{}","params":{{"tree":"{}"}}}})",
        method, tree);
    write(folder / fmt::format("{}.rpc", method),
          fmt::format("Content-Length: {}\r\n\r\n{}", asked.size(), asked));
  }
  write(folder / "check.rpc",
        fmt::format(R"({{"jsonrpc":"2.0","id":1,"method":"tools/call",)"
                    R"("params":{{"name":"check_tree","arguments":)"
                    R"({{"tree":"{}"}}}}}})",
                    tree));
  write(folder / "open.rpc", editor_session(folder, tree, language.text));
  fs::create_directory(folder / "asked");
  write(folder / "asked/t.xml", kAsked);
  write(folder / "asked/btcheck.toml", "[levels]\nBT2502 = \"allow\"\n");
  fs::create_directory(folder / "elsewhere");
}

// What each option is tried with.
const std::map<std::string_view, std::string> kValues = {
    {"--prop", "--prop more.ltl"},
    {"-e", "-e '[] tick.ends => <> root.ended'"},
    {"--tick", "--tick nodes"},
    {"--profile", "--profile btcpp-3.8"},
    {"--against", "--against nav2-jazzy"},
    {"--tick-ms", "--tick-ms 20"},
    {"--tick-gap", "--tick-gap 5"},
    {"--models", "--models models.xml"},
    {"--leaves", "--leaves t.leaves"},
    {"--main-tree", "--main-tree U"},
    {"--root", "--root elsewhere"},
    {"--config", "--config other.toml"},
    {"--no-config", "--no-config"},
    {"--loop", "--loop"},
    {"--wake-ups", "--wake-ups"},
    {"--assume", "--assume actions-end"},
    {"--any-count", "--any-count"},
    {"--search", "--search dfs"},
    {"--reduce", "--reduce live"},
    {"--threads", "--threads 1"},
    {"--store", "--store exact"},
    {"--max-states", "--max-states 3"},
    {"--memory", "--memory 1"},
    {"--on-disk", "--on-disk elsewhere"},
    {"--cache", "--cache elsewhere"},
    {"--timeout", "--timeout 0.000001"},
    {"--format", "--format json"},
    {"--deny", "--deny BT1007 --deny BT1620"},
    {"--no-repairs", "--no-repairs"},
    {"--baseline", "--baseline base.json"},
    {"--write-baseline", "--write-baseline new.json"},
    {"--trace-dir", "--trace-dir runs"},
    // Alone, the one does not end, and the other is refused.
    {"--watch", "--watch --write-baseline new.json"},
    {"--view", "--view"},
    {"--stats", "--stats json"},
    {"--export", "--export aut=new.aut"},
    {"--observe", "--observe root"},
    {"--to", "--to smv"},
    {"--namespace", "--namespace robot"},
    {"-o", "-o new.txt"},
    {"--seed", "--seed 7"},
    {"--script", "--script more.ltl"},
    {"--ticks", "--ticks 9"},
    {"--leaves-exec", "--leaves-exec true"},
    {"--answer-ms", "--answer-ms 1"},
    {"--on-breach", "--on-breach fail"},
    {"--btlog", "--btlog new.btlog"},
    {"--from", "--from run.itf.json@1"},
    {"--topic", "--topic /behavior_tree_log"},
    {"--tree", "--tree more.ltl"},
    {"--learn-leaves", "--learn-leaves new.leaves"},
    {"--coverage", "--coverage"},
    {"--jobs", "--jobs 1"},
    {"--shard", "--shard 2/2"},
    {"--fail-fast", "--fail-fast"},
    {"--resume", "--resume"},
    {"--results", "--results new"},
    {"--force", "--force"},
    {"--no-wait", "--no-wait"},
    {"--lease", "--lease 7"},
    {"--join", "--join elsewhere"},
    {"--report", "--report new.html"},
    {"--stdio", "--stdio"},
    {"--check", "--check"},
    {"--diff", "--diff"},
    {"--verify", "--verify"},
    {"--stdin-name", "--stdin-name t.ltl"},
    {"--order", "--order 2"},
    {"--faults", "--faults never-ends"},
    {"--only", "--only act"},
    {"--late", "--late 1"},
    {"--others", "--others contract"},
    {"--observe", "--observe root"},
    {"--caller", "--caller once"},
    {"--git", "--git HEAD"},
    {"--color", "--color always"},
    {"-q", "-q"},
    {"-v", "-v"},
    {"--help", "--help"},
    {"--version", "--version"},
    {"--licenses", "--licenses"}};

// Why an option makes no difference to a command, of the tree it names or of
// both. Everything else has to.
struct Without {
  std::string_view commands;  // "check batch", "*"
  std::string_view option;    // or several
  std::string_view tree;      // "" for both
  std::string_view reason;
};
constexpr Without kWithout[] = {
    {"*", "--threads", "", "results are the same for every number"},
    {"*", "--jobs", "", "results are the same for every number"},
    {"*", "--on-disk", "", "used at the limit of --memory only"},
    {"*", "--cache", "", "results are the same whatever is known"},
    {"*", "--resume", "", "there is nothing that has been begun"},
    {"*", "--fail-fast", "", "one entry is the last one, too"},
    {"batch", "--no-repairs", "", "its table has none: JSON and the page have"},
    {"lint", "--tick-ms --loop --wake-ups", "", "it says nothing of time"},
    {"export", "-q", "", "it prints the model and nothing else"},
    {"answer leaves", "*", "t.btf", "it refuses the tree"},
    {"answer", "--search --reduce", "", "what is asked is the same"},
    {"leaves", "--config --no-config", "t.xml", "they name no models"},
    {"leaves", "--color", "t.xml", "it tells of errors only"},
    {"init", "-q", "", "it prints the rules; how far it is, on a terminal"},
    {"init", "--reduce", "", "verdicts are the same"},
    {"init", "--tick-ms --config --no-config --loop --wake-ups --max-states",
     "t.xml", "what is proposed for it is so or not in the first tick"},
    {"run", "--no-wait", "", "it prints the same, sooner"},
    {"simulate", "--tick", "", "what happens in a tick is the same"},
    {"monitor", "--tick-ms", "", "its rules do not count ticks"},
    {"conform", "--loop", "", "the log ends before the tree does"},
    {"explain", "--loop", "t.xml", "the log ends before the tree does"},
    {"conform", "--tick-ms", "t.btf", "the log has its ticks"},
    {"serve", "--stdio", "", "there is no other way"},
    {"serve", "--max-states", "t.xml", "as of init"},
    {"serve mcp lsp", "-q -v --color", "", "programs read what it prints"},
    {"lsp", "--stdio", "", "there is no other way"},
    {"conform", "-q", "", "it prints what it has found and nothing else"},
    {"tests", "--tick-ms", "t.xml", "what takes time is left out"},
    {"explain", "-q", "", "it prints what it has found and nothing else"},
    {"explain", "--tick-gap", "", "the log has its ticks"},
    {"fmt", "--config --no-config", "", "they leave nothing out here"},
    {"fmt", "--verify", "", "the networks are equal"},
    {"whatif", "--max-states", "t.xml",
     "no fault has as many as are searched between two looks at the limit"},
    {"diff", "--loop", "t.xml", "both differ before they end"},
    {"fmt", "--timeout", "", "it is done before a limit is looked at"},
};

bool names(std::string_view list, std::string_view word) {
  return list == "*" ||
         fmt::format(" {} ", list).find(fmt::format(" {} ", word)) !=
             std::string::npos;
}

bool is_without(std::string_view command, std::string_view option,
                std::string_view tree) {
  for (const Without& each : kWithout) {
    if (names(each.option, option) && names(each.commands, command) &&
        (each.tree.empty() || each.tree == tree)) {
      return true;
    }
  }
  return false;
}

// The command on the tree, without the option: in several ways, one of which
// has to show the difference.
std::vector<std::string> lines_of(const CommandRow& row,
                                  const Language& language) {
  const std::string line = std::string(row.word) + " trees/" + language.tree;
  switch (row.command) {
    case Command::Batch:
      return {"batch trees", "batch trees --reduce none"};
    case Command::Check:
      return {line, line + " -v", line + " --prop trees/t.ltl"};
    case Command::Export:
      return {line + " --to promela",
              line + " --to promela --prop trees/t.ltl"};
    case Command::Space:
      return {line, line + " --reduce bisimulation"};
    case Command::Simulate:
      return {line + " --seed 3 --ticks 8",
              line + " --seed 3 --ticks 60 --loop"};
    case Command::Run:
      return {line + " --seed 3 --no-wait --ticks 8",
              line + " --seed 3 --no-wait --ticks 60 --loop"};
    case Command::Lint:
      return {line, line + " --prop trees/t.ltl"};
    case Command::Answer:
      return {"answer asked/t.xml <answers.txt",
              "answer asked/t.xml --main-tree U <answers.txt"};
    case Command::Serve:
      return {"serve <init.rpc", "serve <describe.rpc"};
    case Command::Mcp:
      return {"mcp <check.rpc"};
    case Command::Lsp:
      return {"lsp <open.rpc"};
    case Command::Fmt:
      return {line, line + " none.btf"};
    case Command::Monitor:
      return {line + " <events.jsonl",
              line + " --prop trees/t.ltl " + "<events.jsonl"};
    case Command::Tests:
      return {line + " -o suites", line + " -o . --to jsonl"};
    case Command::Diff:
      return {line + " changed/" + language.tree,
              line + " changed/" + language.tree + " --caller once"};
    case Command::WhatIf:
      return {line, line + " --format json"};
    case Command::Conform:
      return {"conform run.btlog trees/" + language.tree,
              "conform run.btlog --coverage trees/" + language.tree};
    case Command::Explain:
      return {"explain run.btlog --tree trees/" + language.tree,
              "explain waits.btlog --tree waits.btf"};
    default:
      return {line};
  }
}

// What is printed, without times and memory, and which files there are.
std::string seen(const Outcome& outcome, const fs::path& folder) {
  static const std::regex kMeasured(
      "[0-9.]+ (s|ms|MB|MiB|GB|[a-zA-Z]*/s|B/state)\\b");
  std::string text =
      fmt::format("exit {}\n{}", outcome.code,
                  std::regex_replace(outcome.text, kMeasured, "#"));
  // Each time it is another folder.
  const std::string name = folder.string();
  for (auto at = text.find(name); at != text.npos; at = text.find(name)) {
    text.replace(at, name.size(), "FOLDER");
  }
  std::set<std::string> files;
  for (const auto& each : fs::recursive_directory_iterator(folder)) {
    files.insert(each.path().lexically_relative(folder).string());
  }
  for (const std::string& file : files) text += file + '\n';
  return text;
}

// A run of the tree, and its log; and of one to which it matters where time
// passes.
void record(const fs::path& folder, const Language& language) {
  write(folder / "waits.btf",
        "(BehaviorTree :name t (Sequence (Wait :duration 3) (Action :ID a)))");
  for (const auto& [name, tree] :
       {std::pair<std::string, std::string>("run", "trees/" + language.tree),
        {"waits", "waits.btf"}}) {
    run_in(folder, kProgram + " simulate " + tree + " --seed 3 --ticks 8 -o " +
                       name + ".itf.json >/dev/null 2>&1");
    run_in(folder, kProgram + " trace " + name + ".itf.json --to btlog -o " +
                       name + ".btlog 2>/dev/null");
  }
}

std::string told(const std::string& line, const std::string& option,
                 const Language& language) {
  const TemporaryFolder folder;
  fill(folder.path(), language);
  if (line.starts_with("conform") || line.starts_with("explain") ||
      option.starts_with("--from")) {
    record(folder.path(), language);
  }
  if (option.starts_with("--baseline")) {
    run_in(folder.path(), kProgram + " " + line +
                              " --write-baseline base.json >/dev/null 2>&1");
  }
  return seen(
      run_in(folder.path(), kProgram + " " + line + " " + option + " 2>&1"),
      folder.path());
}

}  // namespace

TEST_CASE("no option is accepted and ignored") {
  std::size_t tried = 0;
  for (const CommandRow& row : shown_commands()) {
    const bool reads_trees = option_of(row.command, "--root") != nullptr;
    if (!reads_trees) continue;
    for (const Language& language : kLanguages) {
      if (row.command == Command::Run && language.tree == "t.xml") {
        CHECK(told(lines_of(row, language)[0], "", language)
                  .find("error[BT1701]") != std::string::npos);
        continue;
      }
      std::map<std::string, std::string> plain;
      for (const std::string& line : lines_of(row, language)) {
        plain[line] = told(line, "", language);
      }
      for (const OptionRow& option : option_rows()) {
        if (!option.commands.contains(row.command)) continue;
        CAPTURE(row.word);
        CAPTURE(language.tree);
        CAPTURE(option.name);
        const auto value = kValues.find(option.name);
        REQUIRE(value != kValues.end());
        if (is_without(row.word, option.name, language.tree)) continue;
        const bool is_seen = std::ranges::any_of(plain, [&](const auto& each) {
          return told(each.first, value->second, language) != each.second;
        });
        CHECK(is_seen);
        ++tried;
      }
    }
  }
  MESSAGE(tried << " options tried");
}

}  // namespace btcheck::every_option_test

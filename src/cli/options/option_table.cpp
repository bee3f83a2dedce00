// SPDX-License-Identifier: MIT
//
// To add an option: a row here, and what it means in options.cpp.
#include "cli/options/option_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace btcheck {
namespace {

using enum Command;

constexpr CommandSet kReadsTrees = {Check, Batch,  Lint,
                                    Space, Export, Simulate};
constexpr CommandSet kSearches = {Check, Batch, Space, Demo};
constexpr CommandSet kEvery = {Check,  Batch,       Lint,     Space,
                               Export, Trace,       Simulate, Explain,
                               Demo,   Completions, Man};

constexpr std::array kOptions = {
    OptionRow{
        .name = "--prop",
        .value = "FILE",
        .kind = ValueKind::File,
        .help = "a file of properties",
        .commands = {Check, Lint, Export},
        .is_repeatable = true,
        .example = "btcheck TREE.btf --prop RULES.ltl",
    },
    OptionRow{
        .name = "--tick",
        .value = "SEMANTICS",
        .kind = ValueKind::Choice,
        .choices = "root leaves nodes none",
        .fallback = "what the property file says, else root",
        .help = "where time passes",
        .commands = {Check, Batch, Space, Export, Simulate, Demo},
    },
    OptionRow{
        .name = "--profile",
        .value = "PROFILE",
        .kind = ValueKind::Choice,
        .choices = "paper btcpp-3.8 btcpp-4 nav2-humble nav2-jazzy nav2-main",
        .fallback = "paper for .btf; an XML tree says it",
        .help = "whose nodes they are",
        .commands = kReadsTrees,
        .example = "btcheck TREE.xml --profile nav2-humble",
    },
    OptionRow{
        .name = "--tick-ms",
        .value = "MILLISECONDS",
        .kind = ValueKind::Free,
        .fallback = "100",
        .help = "XML trees: what one tick takes",
        .commands = kReadsTrees,
        .example = "btcheck TREE.xml --tick-ms 10",
    },
    OptionRow{
        .name = "--models",
        .value = "FILE",
        .kind = ValueKind::File,
        .help = "XML trees: a file with TreeNodesModel",
        .commands = kReadsTrees,
        .is_repeatable = true,
        .example = "btcheck TREE.xml --models nav2_tree_nodes.xml",
    },
    OptionRow{
        .name = "--leaves",
        .value = "FILE",
        .kind = ValueKind::File,
        .help = "XML trees: a file of leaf contracts",
        .commands = kReadsTrees,
        .is_repeatable = true,
        .example = "btcheck TREE.xml --leaves robot.leaves",
    },
    OptionRow{
        .name = "--main-tree",
        .value = "ID",
        .kind = ValueKind::Free,
        .help = "XML trees: the tree that runs",
        .commands = kReadsTrees,
        .example = "btcheck TREE.xml --main-tree Patrol",
    },
    OptionRow{
        .name = "--loop",
        .help = "XML trees: tick again what has ended",
        .commands = kReadsTrees,
        .example = "btcheck TREE.xml --loop",
    },
    OptionRow{
        .name = "--wake-ups",
        .help = "XML trees: tick as tickOnce does, not tickExactlyOnce",
        .commands = kReadsTrees,
        .example = "btcheck TREE.xml --wake-ups",
    },
    OptionRow{
        .name = "--assume",
        .value = "ASSUMPTION",
        .kind = ValueKind::Choice,
        .choices = "actions-end",
        .fallback = "it may run for ever",
        .help = "actions-end: an action ticked again and again ends again and "
                "again",
        .commands = {Check, Batch, Export, Demo},
        .is_repeatable = true,
        .also = "; property files may have `assume` lines",
    },
    OptionRow{
        .name = "--search",
        .value = "ORDER",
        .kind = ValueKind::Choice,
        .choices = "bfs dfs",
        .fallback = "bfs",
        .help = "bfs: shortest runs; dfs: deep first",
        .commands = kSearches,
    },
    OptionRow{
        .name = "--reduce",
        .value = "REDUCTION",
        .kind = ValueKind::Choice,
        .choices = "none live full",
        .fallback = "full; space: none",
        .help =
            "none: every interleaving and every value; live: values nothing "
            "reads any more are one; full: and independent steps are not "
            "interleaved",
        .commands = kSearches,
    },
    OptionRow{
        .name = "--threads",
        .value = "NUMBER",
        .kind = ValueKind::Free,
        .fallback = "one for each core",
        .help = "how many search at a time",
        .commands = kSearches,
    },
    OptionRow{
        .name = "--store",
        .value = "STORE",
        .kind = ValueKind::Choice,
        .choices = "exact compressed",
        .fallback = "compressed",
        .help =
            "exact: states as pairs of halves; compressed: the same in half "
            "the memory",
        .commands = {Space},
        .example = "btcheck space TREE.btf --store exact",
    },
    OptionRow{
        .name = "--max-states",
        .value = "NUMBER",
        .kind = ValueKind::Free,
        .fallback = "no limit",
        .help = "stop after about so many states",
        .commands = kSearches,
    },
    OptionRow{
        .name = "--memory",
        .value = "SIZE",
        .kind = ValueKind::Free,
        .fallback = "three quarters of the machine's",
        .help = "stop at so much memory, e.g. 4G",
        .commands = kSearches,
    },
    OptionRow{
        .name = "--on-disk",
        .value = "DIRECTORY",
        .kind = ValueKind::Directory,
        .fallback = "stop there",
        .help = "at the limit of --memory, go on in this directory: space, and "
                "rules about single states",
        .commands = kSearches,
    },
    OptionRow{
        .name = "--timeout",
        .value = "SECONDS",
        .kind = ValueKind::Free,
        .fallback = "never",
        .help = "stop after so many seconds",
        .commands = kSearches,
    },
    OptionRow{
        .name = "--format",
        .value = "FORMAT",
        .kind = ValueKind::Target,
        .choices = "text json jsonl sarif junit github",
        .fallback = "text",
        .help = "how results are told",
        .commands = {Check, Batch},
        .is_repeatable = true,
        .example = "btcheck TREE.btf --format json",
    },
    OptionRow{
        .name = "--format",
        .value = "FORMAT",
        .kind = ValueKind::Target,
        .choices = "text json sarif github",
        .fallback = "text",
        .help = "how findings are told",
        .commands = {Lint},
        .is_repeatable = true,
    },
    OptionRow{
        .name = "--trace-dir",
        .value = "DIRECTORY",
        .kind = ValueKind::Directory,
        .help =
            "write each run to this directory, as ITF JSON and as a page for "
            "a browser",
        .commands = {Check, Batch, Demo},
        .example = "btcheck TREE.btf --prop RULES.ltl --trace-dir runs",
    },
    OptionRow{
        .name = "--stats",
        .value = "FORMAT",
        .kind = ValueKind::Choice,
        .choices = "table json",
        .fallback = "table",
        .help = "how the figures are told",
        .commands = {Space},
        .example = "btcheck space TREE.btf --stats json",
    },
    OptionRow{
        .name = "--export",
        .value = "GRAPH",
        .kind = ValueKind::Target,
        .choices = "aut dot",
        .help = "the states and steps of a small space",
        .commands = {Space},
        .example = "btcheck space TREE.btf --export aut",
    },
    OptionRow{
        .name = "--to",
        .value = "FORMAT",
        .kind = ValueKind::Choice,
        .choices = "dot promela smv fiacre",
        .help = "a drawing or a model, with what --prop names as well",
        .commands = {Export},
        .is_required = true,
        .example = "btcheck export TREE.btf --to dot",
    },
    OptionRow{
        .name = "--to",
        .value = "FORMAT",
        .kind = ValueKind::Choice,
        .choices =
            "text html itf svg strip dot mermaid btlog chrome chrome-stack "
            "mcap substitution",
        .help = "what the run is turned into",
        .commands = {Trace},
        .is_required = true,
        .example = "btcheck trace RUN.itf.json --to html",
    },
    OptionRow{
        .name = "-o",
        .value = "FILE",
        .kind = ValueKind::File,
        .fallback = "standard output",
        .help = "the file to write",
        .commands = {Trace},
    },
    OptionRow{
        .name = "-o",
        .value = "FILE",
        .kind = ValueKind::File,
        .help = "keep the run here, as ITF "
                "JSON",
        .commands = {Simulate},
    },
    OptionRow{
        .name = "--at",
        .value = "TICK",
        .kind = ValueKind::Free,
        .fallback = "the last",
        .help = "the tick that svg, dot and mermaid draw",
        .commands = {Trace},
        .example = "btcheck trace RUN.itf.json --to svg --at 2",
    },
    OptionRow{
        .name = "--seed",
        .value = "NUMBER",
        .kind = ValueKind::Free,
        .fallback = "stepping by hand",
        .help = "a random run, the same for the same number",
        .commands = {Simulate},
        .example = "btcheck simulate TREE.btf --seed 7",
    },
    OptionRow{
        .name = "--script",
        .value = "FILE",
        .kind = ValueKind::File,
        .help = "the run in which the leaves answer what this file says",
        .commands = {Simulate},
        .example = "btcheck simulate TREE.btf --script FILE",
    },
    OptionRow{
        .name = "--ticks",
        .value = "NUMBER",
        .kind = ValueKind::Free,
        .fallback = "100",
        .help = "stop a random or scripted run after so many ticks",
        .commands = {Simulate},
        .example = "btcheck simulate TREE.btf --seed 7 --ticks 20",
    },
    OptionRow{
        .name = "--jobs",
        .value = "NUMBER",
        .kind = ValueKind::Free,
        .fallback = "one for each core",
        .help = "how many entries are checked at a time",
        .commands = {Batch},
        .example = "btcheck batch FOLDER --jobs 4",
    },
    OptionRow{
        .name = "--shard",
        .value = "I/N",
        .kind = ValueKind::Free,
        .fallback = "all of it",
        .help = "the i-th of n parts",
        .commands = {Batch},
        .example = "btcheck batch FOLDER --shard 1/4",
    },
    OptionRow{
        .name = "--fail-fast",
        .help = "stop at the first entry that is not as expected",
        .commands = {Batch},
        .example = "btcheck batch FOLDER --fail-fast",
    },
    OptionRow{
        .name = "--resume",
        .help = "take results of an earlier run where nothing has changed",
        .commands = {Batch},
        .example = "btcheck batch FOLDER --resume",
    },
    OptionRow{
        .name = "--report",
        .value = "FILE",
        .kind = ValueKind::File,
        .help = "write the results to this file, as an HTML page",
        .commands = {Batch},
        .example = "btcheck batch FOLDER --report report.html",
    },
    OptionRow{
        .name = "--color",
        .value = "MODE",
        .kind = ValueKind::Choice,
        .choices = "auto always never",
        .fallback = "auto",
        .help = "colours in messages",
        .commands = kEvery,
    },
    OptionRow{
        .name = "-q",
        .help = "no progress and no statistics",
        .commands = kEvery,
    },
    OptionRow{
        .name = "-v",
        .help = "tell every run, step by step",
        .commands = {Check, Batch, Trace, Demo},
    },
    OptionRow{
        .name = "--help",
        .help = "this text; COMMAND --help: that command alone",
        .commands = kEvery,
    },
    OptionRow{
        .name = "--version",
        .help = "which version this is",
        .commands = kEvery,
    }};

}  // namespace

std::span<const OptionRow> option_rows() { return kOptions; }

const OptionRow* option_of(Command command, std::string_view name) {
  const auto row =
      std::find_if(kOptions.begin(), kOptions.end(), [&](const auto& known) {
        return known.name == name && known.commands.contains(command);
      });
  return row == kOptions.end() ? nullptr : &*row;
}

std::vector<std::string> choices_of(const OptionRow& option) {
  std::vector<std::string> choices;
  std::string_view rest = option.choices;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    choices.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return choices;
}

std::string commands_with(std::string_view name) {
  std::vector<std::string> words;
  for (const CommandRow& row : command_rows()) {
    if (!row.is_hidden && option_of(row.command, name) != nullptr) {
      words.emplace_back(row.word);
    }
  }
  return listed(words, "and");
}

std::string listed(const std::vector<std::string>& words,
                   std::string_view last_joint) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) {
      text += i + 1 < words.size() ? ", " : fmt::format(" {} ", last_joint);
    }
    text += words[i];
  }
  return text;
}

}  // namespace btcheck

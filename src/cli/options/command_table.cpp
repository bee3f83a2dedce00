// SPDX-License-Identifier: MIT
//
// To add a command: a row here, its name in `Command`, and what it does in
// commands.cpp.
#include <algorithm>
#include <array>
#include <cassert>

#include "cli/options/option_table.hpp"

namespace btcheck {
namespace {

using enum Command;

constexpr std::array kCommands = {
    CommandRow{
        .command = Check,
        .word = "check",
        .argument = ArgumentKind::Tree,
        .shown = "TREE.btf",
        .missing = "no tree",
        .example = "btcheck TREE.btf",
        .summary = "what each node can and cannot do, or rules",
        .description =
            "Without rules, tells what each node of the tree can and cannot "
            "do. With --prop, checks each rule over every run and shows one "
            "that breaks it. TREE.btf may be a file of rules that names its "
            "tree. The word `check` may be left out.",
    },
    CommandRow{
        .command = Batch,
        .word = "batch",
        .argument = ArgumentKind::Batches,
        .shown = "FOLDER|MANIFEST...",
        .missing = "no folder and no manifest",
        .example = "btcheck batch FOLDER",
        .summary = "many trees and rules, several at a time",
        .description =
            "Checks every tree of a folder with the rules that belong to it, "
            "or what a manifest (.toml) names, and tells what came of each.",
    },
    CommandRow{
        .command = Lint,
        .word = "lint",
        .argument = ArgumentKind::Trees,
        .shown = "TREE.btf...",
        .missing = "no tree",
        .example = "btcheck lint TREE.btf",
        .summary = "what is wrong without exploring",
        .description =
            "Reads trees and rules and tells what is wrong with them as "
            "they stand: names, numbers of children, case, options without "
            "effect. Nothing is searched.",
    },
    CommandRow{
        .command = Space,
        .word = "space",
        .argument = ArgumentKind::Tree,
        .shown = "TREE.btf",
        .missing = "no tree",
        .example = "btcheck space TREE.btf",
        .summary = "build and measure the state space",
        .description =
            "Builds every state of the tree and tells how many there are, "
            "how deep they lie, and which parts multiply them.",
    },
    CommandRow{
        .command = Export,
        .word = "export",
        .argument = ArgumentKind::Tree,
        .shown = "TREE.btf",
        .missing = "no tree",
        .example = "btcheck export TREE.btf --to dot",
        .summary = "draw the tree, or write it as a model for another tool",
        .description =
            "Writes the automata of the tree to standard output: as a "
            "drawing, or as a model for SPIN, nuXmv or TINA.",
    },
    CommandRow{
        .command = Trace,
        .word = "trace",
        .argument = ArgumentKind::Run,
        .shown = "RUN",
        .missing = "no file",
        .example = "btcheck trace RUN.itf.json --to html",
        .summary = "a run that was kept, as a picture, page or log",
        .description =
            "Converts a run that --trace-dir or `simulate -o` has kept, or "
            "prints a log of BehaviorTree.CPP.",
    },
    CommandRow{
        .command = Simulate,
        .word = "simulate",
        .argument = ArgumentKind::Tree,
        .shown = "TREE.btf",
        .missing = "no tree",
        .example = "btcheck simulate TREE.btf",
        .summary = "step through a tree, at random or by a script",
        .description =
            "Goes through one run of the tree: by hand, at random, or as a "
            "script of leaf results says.",
    },
    CommandRow{
        .command = Explain,
        .word = "explain",
        .argument = ArgumentKind::Code,
        .shown = "[CODE]",
        .summary = "the long text behind the code of a message",
        .description =
            "Tells what a code such as BT1014 means, what to do about it, "
            "and the smallest example. Without a code, lists them all.",
    },
    CommandRow{
        .command = Demo,
        .word = "demo",
        .summary = "a drone mission, and the hole in it",
        .description =
            "Checks a published drone mission, shows the run in which "
            "nobody watches the battery, and proves the tree that mends "
            "it.",
    },
    CommandRow{
        .command = Completions,
        .word = "completions",
        .argument = ArgumentKind::Shell,
        .shown = "bash|zsh|fish",
        .missing = "no shell",
        .example = "btcheck completions bash",
        .summary = "what a shell needs to complete words",
        .description = "Prints the completions for one shell.",
        .is_hidden = true,
    },
    CommandRow{
        .command = Man,
        .word = "man",
        .summary = "the man page, as troff",
        .description = "Prints the man page, as troff.",
        .is_hidden = true,
    }};

}  // namespace

std::span<const CommandRow> command_rows() { return kCommands; }
const CommandRow& row_of(Command command) {
  const auto row =
      std::find_if(kCommands.begin(), kCommands.end(),
                   [&](const auto& known) { return known.command == command; });
  assert(row != kCommands.end());
  return *row;
}

const CommandRow* command_named(std::string_view word) {
  const auto row =
      std::find_if(kCommands.begin(), kCommands.end(),
                   [&](const auto& known) { return known.word == word; });
  return row == kCommands.end() ? nullptr : &*row;
}

}  // namespace btcheck

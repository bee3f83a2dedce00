// SPDX-License-Identifier: MIT
//
// To add a command: a row here, before the hidden ones, its name in `Command`,
// and what it does in commands.cpp.
#include <algorithm>
#include <cassert>

#include "cli/options/option_table.hpp"

namespace btcheck {
namespace {

using enum Command;

constexpr CommandRow kCommands[] = {
    {.command = Check,
     .word = "check",
     .argument = ArgumentKind::Tree,
     .shown = "TREE.btf",
     .missing = "no tree",
     .example = "btcheck TREE.btf",
     .summary = "what each node can and cannot do; with --prop, rules",
     .description =
         "Without rules, tells what each node of the tree can and cannot do. "
         "With --prop, checks each rule over every run and shows one that "
         "breaks it. TREE.btf may be a file of rules that names its tree. The "
         "word `check` may be left out."},
    {.command = Batch,
     .word = "batch",
     .argument = ArgumentKind::Batches,
     .shown = "FOLDER|MANIFEST...",
     .missing = "no folder and no manifest",
     .example = "btcheck batch FOLDER",
     .summary = "many trees and rules, several at a time",
     .description =
         "Checks every tree of a folder with the rules that belong to it, or "
         "what a manifest (.toml) names, and reports the result of each."},
    {.command = Lint,
     .word = "lint",
     .argument = ArgumentKind::Trees,
     .shown = "TREE.btf...",
     .missing = "no tree",
     .example = "btcheck lint TREE.btf",
     .summary = "find mistakes without a search",
     .description = "Reads trees and rules and reports what is wrong with "
                    "them: names, numbers of children, case, options without "
                    "effect. Nothing is searched."},
    {.command = Space,
     .word = "space",
     .argument = ArgumentKind::Tree,
     .shown = "TREE.btf",
     .missing = "no tree",
     .example = "btcheck space TREE.btf",
     .summary = "build and measure the state space",
     .description = "Builds every state of the tree and tells how many there "
                    "are, how deep they lie, and which parts multiply them."},
    {.command = Export,
     .word = "export",
     .argument = ArgumentKind::Tree,
     .shown = "TREE.btf",
     .missing = "no tree",
     .example = "btcheck export TREE.btf --to dot",
     .summary = "draw the tree, or write it as a model for another tool",
     .description = "Writes the automata of the tree to standard output: as a "
                    "drawing, or as a model for SPIN, nuXmv or TINA."},
    {.command = Trace,
     .word = "trace",
     .argument = ArgumentKind::Run,
     .shown = "RUN",
     .missing = "no file",
     .example = "btcheck trace RUN.itf.json --to html",
     .summary = "a run that was kept, as a picture, page or log",
     .description = "Converts a run that --trace-dir or `simulate -o` has "
                    "kept, or prints a log of BehaviorTree.CPP."},
    {.command = Simulate,
     .word = "simulate",
     .argument = ArgumentKind::Tree,
     .shown = "TREE.btf",
     .missing = "no tree",
     .example = "btcheck simulate TREE.btf",
     .summary = "step through a tree, at random or by a script",
     .description = "Goes through one run of the tree: by hand, at random, or "
                    "as a script of leaf results says."},
    {.command = Explain,
     .word = "explain",
     .argument = ArgumentKind::Code,
     .shown = "[CODE]",
     .summary = "the long text behind the code of a message",
     .description =
         "Tells what a code such as BT1014 means, what to do about it, and the "
         "smallest example. Without a code, lists them all."},
    {.command = Demo,
     .word = "demo",
     .summary = "a drone mission, and the hole in it",
     .description =
         "Checks a published drone mission, shows the run in which nobody "
         "watches the battery, and proves the tree that mends it."},
    {.command = Completions,
     .word = "completions",
     .argument = ArgumentKind::Shell,
     .shown = "bash|zsh|fish",
     .missing = "no shell",
     .example = "btcheck completions bash",
     .summary = "what a shell needs to complete words",
     .description = "Prints the completions for one shell.",
     .is_hidden = true},
    {.command = Man,
     .word = "man",
     .summary = "the man page, as troff",
     .description = "Prints the man page, as troff.",
     .is_hidden = true}};

}  // namespace

std::span<const CommandRow> command_rows() { return kCommands; }

std::span<const CommandRow> shown_commands() {
  return {kCommands,
          std::ranges::find(kCommands, true, &CommandRow::is_hidden)};
}

const CommandRow& row_of(Command command) {
  const CommandRow* row =
      std::ranges::find(kCommands, command, &CommandRow::command);
  assert(row != std::end(kCommands));
  return *row;
}

const CommandRow* command_named(std::string_view word) {
  const CommandRow* row = std::ranges::find(kCommands, word, &CommandRow::word);
  return row == std::end(kCommands) ? nullptr : row;
}

}  // namespace btcheck

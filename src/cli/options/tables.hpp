// SPDX-License-Identifier: MIT
//
// Every command and option, each said once. The parser reads these tables;
// `--help`, the completions of shells and the man page are made of them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.hpp"

namespace btcheck {

// The words that follow a command and belong to no option.
enum class ArgumentKind : std::uint8_t {
  None,
  Tree,       // one tree, or one property file that names its tree
  Trees,      // several of them
  Batches,    // folders and manifests
  Files,      // trees, rules, contracts and folders
  Run,        // one run or log
  Logs,       // logs of one tree, and perhaps the tree
  Robots,     // addresses of robots
  CodeOrRun,  // perhaps the code of a diagnostic, or one run or log
  Shell       // the name of a shell
};

struct CommandRow {
  Command command = Command::Check;
  std::string_view word = {};
  ArgumentKind argument = ArgumentKind::None;
  std::string_view shown = {};    // the argument in a line of usage, "" if none
  std::string_view missing = {};  // the error without it; "" if it may be left
  std::string_view example = {};  // and the help of that error
  std::string_view summary = {};  // a few words, without a full stop
  std::string_view description = {};  // whole sentences
  bool is_hidden = false;  // for machines: in no list that people read
};

// What a shell offers for the value of an option.
enum class ValueKind : std::uint8_t {
  Flag,    // the option takes none
  Free,    // a number, a size: nothing to offer
  Choice,  // one of the choices
  Target,  // a choice, or CHOICE=FILE
  File,
  Directory
};

// A set of commands; the bit of each is its place in the enumeration.
struct CommandSet {
  constexpr CommandSet(std::initializer_list<Command> commands) {
    for (const Command command : commands) {
      bits |= 1u << static_cast<unsigned>(command);
    }
  }
  constexpr bool contains(Command command) const {
    return (bits >> static_cast<unsigned>(command) & 1u) != 0;
  }
  unsigned bits = 0;
};

struct OptionRow {
  std::string_view name = {};   // "--tick"; "-q" where there is no long one
  std::string_view value = {};  // its value in a line of usage: "SEMANTICS"
  // Where neither `value` nor `choices` says it: Target, File or Directory.
  ValueKind names = ValueKind::Free;
  std::string_view choices = {};   // "root leaves", in the order of their enum
  std::string_view fallback = {};  // what holds without it, "" if nothing does
  std::string_view help = {};      // lower case, without a full stop
  CommandSet commands = {};
  // `--view` alone is enough; a value follows `=`, as in `--view=8080`.
  bool may_stand_alone = false;
  bool is_repeatable = false;
  bool is_required = false;
  CommandSet first = {};          // those whose short help tells of it
  std::string_view instead = {};  // options that make it needless, "": none
  std::string_view example = {};  // of its use, "" for none
  std::string_view also = {};     // follows the list of choices in an error

  constexpr ValueKind kind() const {
    if (value.empty()) return ValueKind::Flag;
    return names == ValueKind::Free && !choices.empty() ? ValueKind::Choice
                                                        : names;
  }
};

// Both in the order of the help. An option that means different things to
// different commands has a row for each meaning.
std::span<const CommandRow> command_rows();
std::span<const CommandRow> shown_commands();  // without the hidden ones
std::span<const OptionRow> option_rows();

const CommandRow& row_of(Command command);

// nullptr where the word names no command.
const CommandRow* command_named(std::string_view word);

// The option as that command takes it; nullptr where it does not.
const OptionRow* option_of(Command command, std::string_view name);

std::vector<std::string> choices_of(const OptionRow& option);
// Those of a column: "--prop --view".
std::vector<std::string> words_of(std::string_view text);

// "check", "check and lint", "check, export and lint": who takes an option.
std::string commands_with(std::string_view name);

// --- Texts made of the tables --------------------------------------------

// A dozen lines, for a command line without any word.
std::string short_help();

// A screen, of the whole program or of one command: what it does, how it is
// called, what is needed first, and the names of all the rest.
std::string first_help();
std::string first_help(Command command);

// Every command and option; or those of one command.
std::string help_text();
std::string help_text(Command command);

std::string version_text();
// Of btcheck and of everything that is linked into the packaged program.
std::string licenses_text();

// The man page as troff, for section 1.
std::string man_page();

// The completions for "bash", "zsh" or "fish"; "" for another word.
std::string completions_for(std::string_view shell);

// "--search ORDER", "-h, --help".
std::string shown_name(const OptionRow& option);

// "a, b or c".
std::string listed(const std::vector<std::string>& words,
                   std::string_view last_joint);

}  // namespace btcheck

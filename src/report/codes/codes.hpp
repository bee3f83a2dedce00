// SPDX-License-Identifier: MIT
//
// Every code that btcheck shows, each said once: for `explain`, for the reports
// that programs read, and for the completions of shells.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck {

// Files and a command line that show the code, and no other.
struct CodeExample {
  std::string_view tree = {};        // tree.btf, or tree.xml
  std::string_view body = {};        // of the only tree in tree.xml, instead
  std::string_view models = {};      // and what its <TreeNodesModel> holds
  std::string_view rules = {};       // rules.ltl
  std::string_view script = {};      // script.txt
  std::string_view other_name = {};  // one more file
  std::string_view other = {};
  // Lines of words after `btcheck`, or after `$ ` any command of the shell; ""
  // for the tree with the rules or the script there are.
  std::string_view command = {};

  bool exists() const {
    return !tree.empty() || !body.empty() || !command.empty();
  }
};

// The tree of most examples, and rules that need no more than it.
inline constexpr std::string_view kOneAction =
    "(BehaviorTree :name t (Action :ID a))";
constexpr CodeExample rules_on_action(std::string_view rules) {
  return {.tree = kOneAction, .rules = rules};
}

struct CodeRow {
  std::string_view code = {};  // "BT2001"
  // Of what a check or `lint` finds, "PropertyViolated"; "" for diagnostics.
  std::string_view name = {};
  // A few words without a full stop; with a name, a sentence.
  std::string_view summary = {};
  std::string_view description = {};  // whole sentences
  std::string_view help = {};         // what to do about it
  Severity severity = Severity::Error;
  CodeExample example = {};
};

// By families.
std::span<const CodeRow> command_codes();
std::span<const CodeRow> tree_codes();
std::span<const CodeRow> property_codes();
std::span<const CodeRow> btcpp_codes();
std::span<const CodeRow> verdict_codes();  // in the order of the codes
std::span<const CodeRow> lint_codes();
std::span<const CodeRow> recording_codes();
std::span<const CodeRow> robot_codes();

// All of them, in the order of the codes.
std::vector<const CodeRow*> all_codes();

// nullptr for a code that does not exist. Case does not matter.
const CodeRow* code_named(std::string_view code);

// Whether the user may give it a level, and deny it: what is found in a tree or
// a mission, and what readers warn of. Errors of reading and verdicts of rules
// are what they are.
bool has_level(const CodeRow& row);

// Why a word is no code that may have a level, and what helps.
struct Objection {
  std::string message;
  std::string help;
};
Objection objection_to(std::string_view word);

struct ExampleFile {
  std::string name;
  std::string text;  // ends with a newline
};
std::vector<ExampleFile> files_of(const CodeExample& example);

// Its command lines, as they are typed.
std::vector<std::string> commands_of(const CodeExample& example);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The words of a command line, sorted by the options they belong to.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/options/tables.hpp"

namespace btcheck {

struct OptionWords {
  Command command = Command::Check;
  bool names_command = false;  // by its first word
  std::vector<std::string> inputs;
  // By name; each has a value for each time the option is given.
  std::map<std::string_view, std::vector<std::string>> values;

  bool has(std::string_view name) const { return values.contains(name); }
  // "" when it is not given.
  std::string value(std::string_view name) const;
  std::vector<std::string> all(std::string_view name) const;
  // The place of the value among the choices of its option.
  std::optional<std::size_t> choice(std::string_view name) const;
};

// Thrown for a command line that cannot be understood: error[BT0001], and what
// helps, "" for nothing.
struct Refusal {
  Answer answer;
};
[[noreturn]] void refuse(std::string_view message, std::string_view help);

// How a message about a command begins: "export ", or nothing for `check`.
std::string spoken_of(Command command);

// Sorts them, or refuses a word that cannot stand there: one that is no
// command, an option that is unknown or belongs to another command, one given
// twice or without its value, a value that is none of its choices.
OptionWords sorted_words(std::vector<std::string> line);

}  // namespace btcheck

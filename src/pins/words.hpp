// SPDX-License-Identifier: MIT
//
// What a .btpins file says: the words of a command line, `drone3.btf --prop
// drone3.ltl`, as `btcheck export` takes them, and a few of the module's own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "explore/partition/slots.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// How an engine is to see the tree.
struct PinsChoices {
  SlotKind slots = SlotKind::Variables;  // Packed: --packed
  bool forgets = false;      // --forget: values that nothing reads any more
  bool tells_idle = false;   // --idle: steps in which nothing happens
  bool tells_names = false;  // --names: of values, however many types that is
  bool has_guards = false;   // --guards: for partial-order reduction
};

struct PinsWords {
  PinsChoices choices;
  std::vector<std::string> others;
};

// Words between blanks; those with blanks stand in '…' or "…", and `#` begins a
// comment. `file` is for messages.
Result<std::vector<std::string>> split_words(const std::string& file,
                                             std::string_view text);
// A word as split_words reads it.
std::string as_word(const std::string& word);

PinsWords sorted_pins_words(std::vector<std::string> words);

// The words of a command line of `btcheck export` that say what is exported.
std::string words_of_export(std::vector<std::string> words);

}  // namespace btcheck

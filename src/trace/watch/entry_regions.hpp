// SPDX-License-Identifier: MIT
//
// Values of a blackboard's entries as rules tell them apart: what they are
// compared with, and what lies between.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// Of a region: no text that is compared with has a control character in it.
inline constexpr std::string_view kOtherText = "\1";

class EntryRegions {
 public:
  explicit EntryRegions(const PropertyFile& rules);

  // An entry of that name: each of its states is one region.
  StateVariable variable(std::string name) const;
  // The region of a value as LogMarks has it.
  int region_of(std::string_view value) const;

 private:
  void add(std::string name, EntryValue value);
  void add_word(const std::string& word);

  std::vector<double> numbers_;  // ascending
  std::vector<std::string> states_;
  std::vector<EntryValue> values_;
};

// The names by which rules know entries: their own, where no other has it, else
// with the path of the subtree before it.
std::vector<std::string> entry_names(const std::vector<std::string>& entries);

}  // namespace btcheck

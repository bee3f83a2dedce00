// SPDX-License-Identifier: MIT
//
// Blackboard entries of a program that runs: their values, as far as the rules
// of a file tell them apart.
#pragma once

#include <string>
#include <string_view>

#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Whether a rule of the file has a name that this entry has.
bool names_entry(const PropertyFile& rules, std::string_view name);

// An enumeration: `unset`, `no_value`, `unknown` (that nothing running ever
// is), the numbers and what lies between them, the texts, any other text, and
// last what is neither (docs/btcpp.md, "Blackboard entries"). A number that is
// compared with is a state of its own.
StateVariable entry_regions(const PropertyFile& rules, const std::string& name);

// The state of a value as a recording shows it: `3`, `-0.5`, `'go home'`,
// `unset`, `no_value`, `other`.
int region_of(const StateVariable& entry, std::string_view shown);

// The text of any other text: no entry of a rule has it.
inline constexpr std::string_view kOtherText = "\x01";

}  // namespace btcheck

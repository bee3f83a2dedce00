// SPDX-License-Identifier: MIT
//
// Random patterns with scopes and times.
#pragma once

#include <string>

#include "reference/random_property.hpp"

namespace btcheck::reference {

// A formula over the atoms of the property, in parentheses.
std::string text_of(const RandomProperty& property, FormulaId formula);

// P leadsto Q within [a,b], and nothing else.
void make_response(RandomProperty& made, AtomMaker& maker);

// A pattern of the catalogue in some scope, in one of its spellings.
void make_pattern(RandomProperty& made, AtomMaker& maker, int most_temporal);

// A pattern with a time, where it may have one.
void make_timed_pattern(RandomProperty& made, AtomMaker& maker);

}  // namespace btcheck::reference

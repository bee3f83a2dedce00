// SPDX-License-Identifier: MIT
//
// Random scripts of BehaviorTree.CPP that keep to small numbers and few texts.
#pragma once

#include <string>
#include <vector>

#include "reference/random_tree.hpp"

namespace btcheck::reference {

// The entries that scripts of one tree may name: numbers from 0 to 3, numbers
// that are 0 or 1, doubles from -3 to 3, texts `a` and `b`, and the same that
// are only read. There is at least one of each.
struct ScriptScope {
  std::vector<std::string> numbers;
  std::vector<std::string> flags;
  std::vector<std::string> doubles;
  std::vector<std::string> texts;
  std::vector<std::string> read_texts;
};

// For an attribute in double quotes: `x1 &lt; 2 &amp;&amp; t1 == 'a'`.
std::string random_condition(SplitMix64& random, const ScriptScope& scope);

// One or two statements: `x1 := 2; t1 = 'b'`.
std::string random_statements(SplitMix64& random, const ScriptScope& scope);

// One of them; not of an empty list.
std::string one_of(SplitMix64& random, const std::vector<std::string>& words);

}  // namespace btcheck::reference

// SPDX-License-Identifier: MIT
//
// What rules compare variables with, known before there is a tree.
#pragma once

#include <map>
#include <set>
#include <string>

#include "ltl/rules/property.hpp"

namespace btcheck {

// By the name of the variable, in small letters: the numbers, which may be
// none. A name may turn out to be a value of the variable beside it. Under ""
// stand the numbers of which only the tree says what they are compared with.
using ComparedNumbers = std::map<std::string, std::set<double>>;
// And the names beside it, which may be other variables.
using ComparedNames = std::map<std::string, std::set<std::string>>;

void add_compared(const PropertyFile& rules, ComparedNumbers& to,
                  ComparedNames& names);

}  // namespace btcheck

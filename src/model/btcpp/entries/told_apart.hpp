// SPDX-License-Identifier: MIT
//
// Declared numbers: which of their values a tree and its rules tell apart.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/expand/writers.hpp"

namespace btcheck::btcpp {

struct ToldApart {
  // One value of each region, ascending; nothing where all are told apart.
  std::optional<std::vector<int>> samples;
  std::string why_all;  // "its value is copied", or "" where it is small
};

// Of each entry that is declared to have a range. What scripts, contracts,
// ports and rules ask of one value of a region comes out the same for all of
// its values.
std::map<EntryName, ToldApart> told_apart(
    const BtcppExpansion& expansion, const ScriptWriters& writers,
    const std::map<EntryName, EntryDeclaration>& declared,
    const ScriptDetail& detail);

}  // namespace btcheck::btcpp

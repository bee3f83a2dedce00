// SPDX-License-Identifier: MIT
//
// How far numbers in entries are kept apart.
#pragma once

#include <vector>

#include "model/btcpp/entries/domain.hpp"
#include "model/btcpp/expand/writers.hpp"

namespace btcheck::btcpp {

// Sets the bounds of all domains: the numbers in the scripts that mention an
// entry, the literals it begins with, and the bounds of the entries that it is
// `mentioned` together with, in one script or SetBlackboard.
void find_bounds(const BtcppExpansion& expansion, const ScriptWriters& writers,
                 const std::vector<std::vector<EntryName>>& mentioned,
                 ScriptWorld& world);

}  // namespace btcheck::btcpp

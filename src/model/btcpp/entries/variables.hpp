// SPDX-License-Identifier: MIT
//
// Entries as state variables: names that a property can say.
#pragma once

#include <map>
#include <vector>

#include "model/btcpp/entries/domain.hpp"

namespace btcheck::btcpp {

// Declares one for each of the entries, in their order and that of
// `world.domains`. Those of the literals begin with them, all others unknown.
void declare_variables(const BtcppExpansion& expansion,
                       const std::vector<EntryName>& entries,
                       const std::map<EntryName, ScriptValue>& literals,
                       ScriptWorld& world);

}  // namespace btcheck::btcpp

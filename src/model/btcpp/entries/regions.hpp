// SPDX-License-Identifier: MIT
//
// A condition over a value that is not known, asked of one value of each kind
// that the condition tells apart: below, at, between and above its numbers,
// each of its texts, and others. So `x >= 30 && x < 10` is known to be false.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "model/btcpp/entries/world.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/script/script.hpp"
#include "model/btcpp/script/value.hpp"

namespace btcheck::btcpp {

// Values for some of the entries that the script reads and may not know:
// whatever they hold, the last statement comes out as it does in one of these
// cases. One case without values where nothing can be said.
using ScriptCase = std::map<EntryName, ScriptValue>;
std::vector<ScriptCase> cases_of(const BtcppExpansion& expansion,
                                 const ScriptWorld& world,
                                 std::uint32_t subtree, const ScriptTree& tree);

}  // namespace btcheck::btcpp

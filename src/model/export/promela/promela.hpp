// SPDX-License-Identifier: MIT
//
// The network as a model for SPIN, in its language Promela.
#pragma once

#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/export/language.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

inline constexpr ExportLanguage::Signs kPromelaSigns = {
    "Promela", " && ", " || ", "!", " == ", " != ", " % "};

// One process whose every step is one step of the network (Holzmann 2004,
// chapters 3 and 7): SPIN stores as many states as a search of btcheck, and
// every run is infinite, an idle step leading back to its state. With claims,
// where variables move by themselves, one bit more tells whether the last step
// was progress, and each claim F becomes ([]<> progress) -> F, our built-in
// justice. An error when a value may leave the 32 bits of Promela's int, whose
// arithmetic wraps.
Result<std::string> promela_text(const BehaviorTree& tree,
                                 const Network& network,
                                 const std::vector<ExportClaim>& claims = {});

}  // namespace btcheck

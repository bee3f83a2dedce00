// SPDX-License-Identifier: MIT
//
// The network as a model for frac and TINA, in their language Fiacre.
#pragma once

#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/export/language.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// One process for each automaton, in their order (Berthomieu et al., "The
// syntax and semantics of Fiacre", 2012), and a component of the tree's name
// that runs them; the claims as properties with their assertions. In discrete
// time it has as many states and steps as a search of btcheck finds (clocks do
// not count after a fault). An error when a value may leave 32 bits; a warning
// for a claim that is left out because no observation of single processes can
// say it.
Result<std::string> fiacre_text(const BehaviorTree& tree,
                                const Network& network,
                                const std::vector<ExportClaim>& claims = {});

// The same processes in H-Fiacre, for Hippo to run: where an Action, a
// Condition or a SetSV chose, a function in C is asked (links.hpp). What the
// model does not allow leads to the state `breach`. Of .btf trees, with time.
Result<std::string> hfiacre_text(const BehaviorTree& tree,
                                 const Network& network);

}  // namespace btcheck

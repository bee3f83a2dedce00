// SPDX-License-Identifier: MIT
//
// The network as a model for SPIN, in its language Promela.
#pragma once

#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Something to be checked on every run. Letters, digits and `_` in the name,
// no digit first. The formula is LTL as SPIN writes it ([] <> U W V ! && || ->
// <-> true false; SPIN knows no X), over p0, p1, …, which stand for
// propositions[0], propositions[1], …, each over the network's variables.
struct PromelaClaim {
  std::string name;
  std::string formula;
  std::vector<Expression> propositions;
  std::vector<std::string> remarks = {};  // for its reader, a line each
};

// One process whose every step is one step of the network (Holzmann 2004,
// chapters 3 and 7): SPIN stores as many states as a search of btcheck, and
// every run is infinite, an idle step leading back to its state. With claims,
// where variables move by themselves, one bit more tells whether the last step
// was progress, and each claim F becomes ([]<> progress) -> F, our built-in
// justice. An error (BT0005) when a value may leave the 32 bits of Promela's
// int: there its arithmetic wraps and ours does not.
Result<std::string> promela_text(const BehaviorTree& tree,
                                 const Network& network,
                                 const std::vector<PromelaClaim>& claims = {});

}  // namespace btcheck

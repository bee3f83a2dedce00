// SPDX-License-Identifier: MIT
//
// What the written-out space of a network says of a property.
#pragma once

#include <optional>
#include <string>

#include "check/bind/verdict.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_property.hpp"

namespace btcheck::reference {

struct NaiveAnswer {
  bool holds = false;
  bool has_run = true;  // some run is as the property's file assumes
};

// Nothing when an atom makes no sense here.
std::optional<NaiveAnswer> naive_verdict(const BehaviorTree& tree,
                                         const Network& network,
                                         const NaiveSpace& space,
                                         const RandomProperty& property);

// What is wrong with a run that is to violate a timed property at the state
// `occurrence`, "" for nothing: by the definition of its pattern.
std::string timed_evidence_flaw(const BehaviorTree& tree,
                                const Network& network, const NaiveSpace& space,
                                const RandomProperty& property, const Run& run,
                                std::size_t occurrence);

}  // namespace btcheck::reference

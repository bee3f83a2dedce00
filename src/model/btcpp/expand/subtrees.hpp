// SPDX-License-Identifier: MIT
//
// What the attributes of a SubTree make of the blackboard inside it.
#pragma once

#include "model/btcpp/document.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/findings.hpp"

namespace btcheck::btcpp {

// Fills the remapping of `subtree`, which is what `node` names. BT1610 for an
// `_autoremap` that is no Boolean, BT1614 for ports of its model that are not
// remapped.
void read_remapping(const BtcppDocument& document, const BtcppNode& node,
                    BtcppSubtree& subtree, FileFindings& findings);

}  // namespace btcheck::btcpp

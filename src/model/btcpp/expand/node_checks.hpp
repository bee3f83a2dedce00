// SPDX-License-Identifier: MIT
//
// What must be right about the ports and scripts of each node that is used.
#pragma once

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/findings.hpp"

namespace btcheck::btcpp {

// BT1609, BT1610, BT1615, BT1617, BT1618, BT1626, BT1630 and BT1631. Trees
// that nothing uses are not looked at; BehaviorTree.CPP does not either.
void check_nodes(const BtcppExpansion& expansion, FileFindings& findings);

}  // namespace btcheck::btcpp

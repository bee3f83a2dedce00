// SPDX-License-Identifier: MIT
//
// Which entries of which blackboards a tree uses, and how.
#pragma once

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/findings.hpp"

namespace btcheck::btcpp {

// BT1616, BT1627 and BT1628.
void check_blackboard(const BtcppExpansion& expansion, FileFindings& findings);

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// Children that no run can tick, as the tree is built.
#pragma once

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/findings.hpp"

namespace btcheck::btcpp {

// BT1629.
void check_reachability(const BtcppExpansion& expansion,
                        FileFindings& findings);

}  // namespace btcheck::btcpp

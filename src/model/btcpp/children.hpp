// SPDX-License-Identifier: MIT
//
// How many children a node has, and which.
#pragma once

#include <span>
#include <string_view>

#include "model/btcpp/document.hpp"
#include "model/btcpp/findings.hpp"

namespace btcheck::btcpp {

struct ChildTag {
  std::string_view tag;
  BtcppPlace place;
};

// BT1607: too few or too many, when the node is loaded or when it is ticked.
void check_child_count(BtcppRelease release, const BtcppNode& node,
                       std::span<const ChildTag> children,
                       FileFindings& findings);

// BT1619: what only a ReactiveSequence refuses.
void check_reactive_children(BtcppRelease release, const BtcppNode& node,
                             std::span<const ChildTag> children,
                             FileFindings& findings);

}  // namespace btcheck::btcpp

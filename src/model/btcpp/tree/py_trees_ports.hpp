// SPDX-License-Identifier: MIT
//
// What the attributes of a node of py_trees say, as the exporter
// (contrib/py_trees) writes them. Those of Timeout and Timer are read where
// other durations are.
#pragma once

#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/findings.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// Fills `made`, the node of `written`, whose children are `children`.
void set_py_trees_ports(const BtcppNode& written,
                        const std::vector<const BtcppNode*>& children,
                        Node& made, FileFindings& findings);

}  // namespace btcheck::btcpp

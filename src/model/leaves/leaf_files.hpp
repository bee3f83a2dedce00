// SPDX-License-Identifier: MIT
//
// Files of leaf contracts for XML trees.
#pragma once

#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Reads all files, in their order. Codes BT1000 to BT1010, BT1014 and BT1020.
Result<btcpp::LeafContracts> read_leaf_files(
    const std::vector<BtcppFile>& files);

}  // namespace btcheck

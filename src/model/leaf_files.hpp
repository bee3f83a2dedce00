// SPDX-License-Identifier: MIT
//
// Files of leaf contracts beside an XML tree.
#pragma once

#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Reads all files, in their order.
Result<btcpp::LeafContracts> read_leaf_files(
    const std::vector<BtcppFile>& files);

}  // namespace btcheck

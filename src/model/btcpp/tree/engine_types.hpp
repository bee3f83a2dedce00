// SPDX-License-Identifier: MIT
//
// Elements of XML trees as types of nodes.
#pragma once

#include "model/btcpp/document.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// The type of an element; of one that no engine knows, by its kind.
NodeType engine_type(const BtcppNode& node);

}  // namespace btcheck::btcpp

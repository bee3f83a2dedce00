// SPDX-License-Identifier: MIT
//
// What a named branch of Nav2 does not have: it refuses a tree for an unknown
// port. An unknown node may be one of the program's own.
#pragma once

#include <vector>

#include "model/btcpp/document.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck::btcpp {

// Of a profile of Nav2. Nodes that the engine has itself, or that a model
// describes, are none of Nav2's.
std::vector<Diagnostic> missing_in_branch(const BtcppDocument& document,
                                          Profile profile);

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// <TreeNodesModel>: which node types there are, and their ports.
#pragma once

#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/source_files.hpp"

namespace btcheck::btcpp {

// Adds the models of one file; a later one takes the place of an earlier one
// of the same kind and ID. BT1604, BT1605, BT1606, BT1625.
void read_models(const SourceFile& file, std::vector<BtcppModel>& models,
                 FileFindings& findings);

}  // namespace btcheck::btcpp

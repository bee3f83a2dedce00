// SPDX-License-Identifier: MIT
//
// The files that a command line names, read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "cli/options.hpp"
#include "diagnostic.hpp"
#include "model/network.hpp"
#include "model/tree.hpp"

namespace btcheck {

struct Inputs {
  InputFile tree;
  std::vector<InputFile> properties;
};

// Reads the tree and the properties in order; nothing when one of them cannot
// be read. What is wrong with them is shown, and kept in `found`.
std::optional<Inputs> read_inputs(const Options& options,
                                  std::vector<Diagnostic>& found);

// Reads one tree and lowers it, or shows what is wrong with it.
struct Lowered {
  BehaviorTree tree;
  Network network;
  std::string source;  // the text of its file
};
std::optional<Lowered> read_and_lower(const Options& options);

}  // namespace btcheck

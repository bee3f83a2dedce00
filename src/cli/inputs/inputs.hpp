// SPDX-License-Identifier: MIT
//
// The files that a command line names, read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "cli/options/options.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// "rules.ltl", "rules.btp".
bool is_property_file(const std::string& name);

struct Inputs {
  TreeInput tree;  // with the files that it includes
  std::vector<InputFile> properties;
};

// Reads the tree and the properties in order; nothing when one of them cannot
// be read. `tree` may be a property file that names its tree. Errors are added
// to `found`. Of the options, those count that say how trees are read.
std::optional<Inputs> gather_inputs(const std::string& tree,
                                    const std::vector<std::string>& properties,
                                    const Options& options,
                                    std::vector<Diagnostic>& found);

// The same for a command line; errors are also shown.
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

// SPDX-License-Identifier: MIT
//
// Leaf contracts in files beside an XML tree, as they are written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/script/value.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck::btcpp {

struct NamedEntry {
  std::string name;  // as scripts write it, "level", "@level"
  SourceSpan span;
};

// What a contract says of entries, as a script at the leaf.
struct ContractScript {
  std::string code;  // "" for none
  std::vector<NamedEntry> entries;
};

struct LeafRule {
  std::uint32_t file = 0;  // an index into the files
  NodeType leaf{};
  std::string name;                     // of leaves, with wildcards
  SourceSpan span;                      // of the name
  std::optional<LeafContract> results;  // only what it may answer
  std::optional<LeafMemory> memory;
  std::optional<Duration> duration;  // in ticks
  ContractScript requirement;
  ContractScript on_success;
  ContractScript on_failure;
};

// What an entry of the root holds before the first tick.
struct FirstValue {
  std::uint32_t file = 0;
  NamedEntry entry;
  ScriptValue value;
};

struct LeafContracts {
  std::vector<BtcppFile> files;
  std::vector<LeafRule> rules;  // in the order of the files
  std::vector<FirstValue> first_values;
};

}  // namespace btcheck::btcpp

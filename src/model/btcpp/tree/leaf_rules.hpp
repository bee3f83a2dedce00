// SPDX-License-Identifier: MIT
//
// Contracts in files beside an XML tree, and the leaves they are about.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/tree/contracts.hpp"
#include "model/btcpp/tree/node_scripts.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck::btcpp {

// A leaf has the first contract that matches it, in the order of the files.
// The name of a contract is compared as BehaviorTree.CPP does with those of
// substitution rules: with the leaf's name, its type, and as a pattern with
// its full path (BehaviorTreeFactory::instantiateTreeNode of 4.10). What the
// engine itself brings along has none.
class LeafRules {
 public:
  // Looks for the leaves. Both must outlive this. BT1011.
  LeafRules(const BtcppExpansion& expansion, const LeafContracts& contracts);

  // What the contracts say of entries.
  const ContractScripts& scripts() const { return scripts_; }

  // Warns of entries with a first value that are not modelled, BT1638.
  void check_first_values(const NodeScripts& scripts);

  // What the contract of this instance, if any, says on top of its type.
  // BT1020 where the two contradict each other, BT1638.
  void apply(std::uint32_t instance, NodeScripts& scripts, Node& leaf);

  bool has_error() const { return findings_.has_error(); }
  // With a warning for each contract that no leaf has, BT1021.
  std::vector<Diagnostic> take();

 private:
  void read_first_values();
  void choose();
  void check(const LeafRule& rule, const Node& leaf);
  void check_entries(const LeafRule& rule, std::uint32_t subtree,
                     const NodeScripts& scripts);
  void check_entry(std::uint32_t file, const NamedEntry& entry,
                   std::uint32_t subtree, const NodeScripts& scripts);
  void report_unused(std::size_t rule);
  std::string nearest(const LeafRule& rule) const;

  const BtcppExpansion& expansion_;
  const LeafContracts& contracts_;
  FileFindings findings_;
  std::vector<const LeafRule*> chosen_;  // by instance, or nullptr
  // By rule: whether a leaf has it, and which other has one that it matches.
  std::vector<bool> is_used_;
  std::vector<const LeafRule*> before_;
  ContractScripts scripts_;
};

}  // namespace btcheck::btcpp

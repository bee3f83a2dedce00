// SPDX-License-Identifier: MIT
//
// Contracts in files beside an XML tree, and the leaves they are about.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "diagnostic.hpp"
#include "model/btcpp/contract_script.hpp"
#include "model/btcpp/expansion.hpp"
#include "model/btcpp/node_scripts.hpp"
#include "model/btcpp/script_writers.hpp"
#include "model/btf_contracts.hpp"
#include "model/tree.hpp"

namespace btcheck::btcpp {

// A leaf has the first contract that matches it, in the order of the files.
// The name of a contract is compared as BehaviorTree.CPP does with those of
// substitution rules: with the leaf's name, its type, and as a pattern with
// its full path (BehaviorTreeFactory::instantiateTreeNode of 4.10). What the
// engine itself brings along has none.
class LeafRules {
 public:
  // Reads all files and looks for the leaves; these and the expansion must
  // outlive this. Codes BT1000 to BT1009, BT1014, BT1020.
  LeafRules(const BtcppExpansion& expansion, std::span<const BtcppFile> files);
  LeafRules(const LeafRules&) = delete;
  LeafRules& operator=(const LeafRules&) = delete;

  // What the contracts say of entries.
  const ContractScripts& scripts() const { return scripts_; }

  // What the contract of this instance, if any, says on top of its type.
  // BT1020 where the two contradict each other, BT1638.
  void apply(std::uint32_t instance, const NodeScripts& scripts, Node& leaf);

  bool has_error() const;
  // With a warning for each contract that no leaf has, BT1021.
  std::vector<Diagnostic> take();

 private:
  struct File {
    File(const BtcppFile& read);

    SourceText source;
    btf::Findings findings;
    btf::Forms forms;
  };
  struct Rule {
    File* file = nullptr;
    NodeType leaf = NodeType::Action;
    btf::ContractDraft contract;
    ContractScript requirement;
    ContractScript on_success;
    ContractScript on_failure;
    const Rule* before = nullptr;  // has the leaves that this one matches
  };

  void read(File& file);
  void read_contract(File& file, btf::FormId form, NodeType leaf);
  void choose();
  void check(const Rule& rule, const Node& leaf);
  void check_entries(const Rule& rule, std::uint32_t subtree,
                     const NodeScripts& scripts);
  void report_unused(const Rule& rule) const;
  std::string nearest(const Rule& rule) const;

  const BtcppExpansion& expansion_;
  std::deque<File> files_;
  std::deque<Rule> rules_;
  std::vector<Rule*> chosen_;  // by instance, or nullptr
  ContractScripts scripts_;
  std::vector<Diagnostic> refusals_;  // of files that are no text
};

}  // namespace btcheck::btcpp

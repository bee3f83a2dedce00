// SPDX-License-Identifier: MIT
//
// Contracts of leaves in files beside an XML tree: what they say, which leaf
// each is about, and what it changes there.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/script/value.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck::btcpp {

class NodeScripts;

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
  // False: it only says what the leaf means, and leaves the rest to others.
  bool has_behavior = true;
  LeafMeaning meaning;
  std::optional<LeafMemory> memory;
  std::optional<Duration> duration;  // in ticks
  ContractScript requirement;
  ContractScript decision;
  ContractScript on_success;
  ContractScript on_failure;
};

// A `defsv`: what an entry of the root holds before the first tick, and what it
// may hold.
struct DeclaredEntry {
  std::uint32_t file = 0;
  NamedEntry entry;
  std::optional<ScriptValue> initial;
  std::optional<EntryDeclaration> declaration;
};

// A `defenum`: what the program registers for scripts.
struct DeclaredEnumerator {
  std::uint32_t file = 0;
  SourceSpan span;  // of the name
  std::string name;
  int number = 0;
};

struct LeafContracts {
  std::vector<InputFile> files;
  std::vector<LeafRule> rules;  // in the order of the files
  std::vector<DeclaredEntry> entries;
  std::vector<DeclaredEnumerator> enumerators;
  // Names and types of leaves of other trees, which the rules may be about.
  std::set<std::string> elsewhere;
};

// A leaf has the first contract that matches it, in the order of the files;
// what it means is taken from all of them, of each part the first that is said.
// A contract's name matches as the name of a substitution rule does in
// BehaviorTree.CPP: it is the leaf's name or type, or a pattern of its full
// path (BehaviorTreeFactory::instantiateTreeNode of 4.10). The engine's own
// leaves have no contract.
class LeafRules {
 public:
  // Finds the leaves of each contract. Both arguments must outlive this.
  LeafRules(const BtcppExpansion& expansion, const LeafContracts& contracts);

  // What the contracts say of entries.
  const ContractScripts& scripts() const { return scripts_; }

  // Warns of declared entries that are not modelled. An error for those with
  // too many values.
  void check_declared(const NodeScripts& scripts);
  // Warns where it depends on no model whether this leaf writes one.
  void check_ports(std::uint32_t instance, const NodeScripts& scripts);

  // Applies the contract of this instance, if it has one. An error where the
  // contract contradicts itself or the type of the leaf.
  void apply(std::uint32_t instance, NodeScripts& scripts, Node& leaf);

  bool has_error() const { return findings_.has_error(); }
  // All findings, and a warning for each contract that no leaf has.
  std::vector<Diagnostic> take();

 private:
  void declare(const DeclaredEntry& declared);
  void choose();
  void check(const LeafRule& rule, const Node& leaf);
  void check_type(const DeclaredEntry& declared, const NodeScripts& scripts);
  void check_entries(std::uint32_t file, std::span<const NamedEntry> entries,
                     std::uint32_t subtree, const NodeScripts& scripts);
  void report_unused(std::size_t rule);
  bool is_of_other_tree(const LeafRule& rule) const;
  std::string nearest(const LeafRule& rule) const;

  const BtcppExpansion& expansion_;
  const LeafContracts& contracts_;
  FileFindings findings_;
  std::vector<const LeafRule*> chosen_;  // by instance, or nullptr
  // By instance, where there are any: those that say what the leaf means.
  std::map<std::uint32_t, std::vector<const LeafRule*>> meant_;
  // By rule: whether a leaf has it, and an earlier rule that took one of its.
  std::vector<bool> is_used_;
  std::vector<const LeafRule*> before_;
  ContractScripts scripts_;
  std::set<std::pair<EntryName, std::string>> told_ports_;  // by type of leaf
};

}  // namespace btcheck::btcpp

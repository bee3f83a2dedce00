// SPDX-License-Identifier: MIT
//
// The one tree that runs, made from a document: every SubTree has its own copy
// of the tree it names, with the numbers and paths that BehaviorTree.CPP gives;
// and the blackboard entries that names inside subtrees mean.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"

namespace btcheck {

// How a name inside a subtree reaches the blackboard around it.
struct BtcppRemapping {
  std::string inner;
  std::string outer;        // a key, or the literal's text
  bool is_literal = false;  // the entry is the subtree's own, with this value
};

// One use of a tree. The first is the tree that runs.
struct BtcppSubtree {
  const BtcppTree* tree = nullptr;
  std::string path;              // "" for the first, then "a/Move::4"
  std::uint32_t parent = 0;      // the subtree it stands in
  std::uint32_t first_node = 0;  // its root, an index into the nodes
  std::vector<BtcppRemapping> remappings;
  bool is_autoremapped = false;
  bool is_shared = false;  // version 3: one blackboard with its parent
};

struct BtcppInstance {
  const BtcppNode* node = nullptr;
  std::uint32_t subtree = 0;
  std::uint32_t parent = 0;             // of the first: itself
  std::vector<std::uint32_t> children;  // of a SubTree: the root inside
  std::string path;  // "Move::4/patrol", "Sequence::1": the fullPath
};

// The document must outlive it.
struct BtcppExpansion {
  const BtcppDocument* document = nullptr;
  std::vector<BtcppSubtree> subtrees;
  // In pre-order; the uid is the index and 1. A SubTree counts, and the root
  // inside it comes next.
  std::vector<BtcppInstance> nodes;
  // Entries of the root that the program around the tree is known to write.
  std::vector<std::string> given;
};

// Expands the tree of this ID, "" for the document's own choice. Checks what
// BehaviorTree.CPP checks when it loads and when it ticks the tree, and more.
Result<BtcppExpansion> expand_btcpp(const BtcppDocument& document,
                                    std::string_view main_tree = {},
                                    std::vector<std::string> given = {});

namespace btcpp {

// Whether what is passed to a SubTree without braces is a text, whatever it
// says.
bool passes_texts(const BtcppExpansion& expansion);

// An entry: a name on the blackboard of one subtree.
struct EntryName {
  std::uint32_t subtree = 0;
  std::string name;

  auto operator<=>(const EntryName&) const = default;
};

// The entry that a name means inside a subtree: `@name` is the root's, a
// remapped name is the parent's, and with `_autoremap` any that does not begin
// with `_` (Blackboard::createEntryImpl of BehaviorTree.CPP 4.10).
EntryName entry_of(const BtcppExpansion& expansion, std::uint32_t subtree,
                   std::string_view name);
// The entry that the name means there is on the blackboard that is asked for
// it: the subtree's own, or with `@` the root's.
bool is_own_name(const EntryName& entry, std::uint32_t subtree,
                 std::string_view name);

// How many values of each entry are kept apart. An entry with more of them may
// have any value, or its numbers are kept in ranges. Each level allows eight
// times as many.
struct ScriptDetail {
  static constexpr int kMostLevels = 2;
  static constexpr std::size_t kMostValues = 128;  // at level 0
  std::map<EntryName, int> levels;  // 0 for entries not in the map
  // What rules compare the entries of these names with, in small letters: they
  // are told apart by these numbers from the start, and as the highest level
  // has it.
  std::map<std::string, std::set<double>> asked;
  // The names that stand beside them in rules, of values or other entries.
  std::map<std::string, std::set<std::string>> beside;
  // A declared number of no more values keeps them all; of a larger one those
  // that the tree and the rules tell apart.
  std::int64_t most_whole = 16;

  std::size_t most_values(const EntryName& entry) const;
  // How far beyond the numbers in the scripts the ranges begin.
  double reach(const EntryName& entry) const;
};

}  // namespace btcpp
}  // namespace btcheck

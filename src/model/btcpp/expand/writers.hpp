// SPDX-License-Identifier: MIT
//
// Everything in a tree that may write the entries that scripts read: scripts,
// contracts, SetBlackboard, literals of SubTrees, and ports.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/script/domain.hpp"
#include "model/btcpp/script/script.hpp"
#include "model/btcpp/script/value.hpp"

namespace btcheck::btcpp {

struct PlacedScript {
  std::uint32_t subtree = 0;
  ScriptSyntax syntax;  // without a flaw
  bool is_of_contract = false;
  std::uint32_t node = 0;  // of the expansion
};

// What a contract says that a leaf does with entries; each "" for nothing.
struct LeafScripts {
  std::string requirement;
  std::string decision;
  std::string on_success;
  std::string on_failure;
};
// What a contract says of the values of an entry.
struct EntryDeclaration {
  DeclaredDomain domain;
  // Whether it moves by itself; nothing: if it has states and the tree does not
  // write it.
  std::optional<bool> is_free;
  // Moves, pairs of states; nothing: from any to any.
  std::optional<std::vector<std::pair<std::size_t, std::size_t>>> transitions;
};
struct ContractScripts {
  // Of leaves that have a contract, by their numbers in the expansion.
  std::map<std::uint32_t, LeafScripts> of;
  // What the program puts into entries before the first tick.
  std::map<EntryName, ScriptValue> initial;
  std::map<EntryName, EntryDeclaration> declared;
};

// <SetBlackboard value="…" output_key="…">
struct Setting {
  EntryName entry;
  std::optional<EntryName> source;  // of value="{source}"
  std::string text;                 // of any other value
  bool is_own = true;               // the entry is on the node's blackboard
  std::uint32_t node = 0;           // of the expansion
};
// What a node of this type sets; nothing when it throws at once, or when the
// blackboard decides which entry it writes.
std::optional<Setting> setting_of(const BtcppExpansion& expansion,
                                  const BtcppInstance& node);

// The entry that an UnsetBlackboard removes; nothing when it removes none,
// because the key is remapped, or when the blackboard decides which.
std::optional<EntryName> unset_by(const BtcppExpansion& expansion,
                                  const BtcppInstance& node);

// A port by which a leaf may write an entry.
struct PortWrite {
  EntryName entry;
  EntryType type = EntryType::Free;  // of the port
  ScriptValue value;                 // what the entry holds afterwards
  std::string reason;                // "the port `out` of Grasp may write it"
  // No model says which way the port goes: it may not write at all.
  bool is_open_port = false;
};

// Two ports of a node that the engine compares: Switch, BlackboardCheck.
struct PortPair {
  std::vector<EntryName> entries;  // that they point at
  std::vector<double> numbers;     // that are written there
  std::vector<std::string> texts;  // likewise, as written
};

struct ScriptWriters {
  std::vector<PlacedScript> scripts;
  std::vector<Setting> settings;
  std::vector<PortPair> compared;
  // Those that a SetBlackboard of version 4 writes or copies: what type a leaf
  // gives them matters to it alone.
  std::set<EntryName> typed_by_leaves;
  // Of leaves, by their numbers in the expansion.
  std::map<std::uint32_t, std::vector<PortWrite>> port_writes;
  std::vector<EntryName> unset;
  // First values: the literals of SubTrees, and those that contracts give.
  std::map<EntryName, ScriptValue> literals;
  // The types that the engine notes for entries when it loads the tree. An
  // entry in this map exists before the first tick, with or without a value.
  std::map<EntryName, EntryType> declared;
  // Entries that something else may write at any time, and what: "the port
  // `value` of LoopInt may write it".
  std::map<EntryName, std::string> foreign;
  // Why any entry may be written, or "".
  std::string all_foreign;
};

// What a literal of a SubTree's attribute puts into its entry in version 4.
ScriptValue literal_value(const std::string& text);

ScriptWriters script_writers(const BtcppExpansion& expansion,
                             const ContractScripts& contracts);

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// The node types that BehaviorTree.CPP and Nav2 bring along, one row each, and
// the ports that a node can have. After BehaviorTree.CPP 3.8.8 and 4.10.0
// (src/bt_factory.cpp, src/action_node.cpp, and the `providedPorts` of each
// node) and the branches galactic to main of Nav2
// (nav2_behavior_tree/plugins, and the base classes in its include folder); and
// those of py_trees 2.2.3.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/libraries/libraries.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// Any: a port without a type, or of one that only the engine can name.
enum class PortType : std::uint8_t {
  Any,
  Int,
  Unsigned,
  Bool,
  Double,
  String,
  Status,
  Script
};
// "int", "unsigned int", …, for messages.
std::string_view port_type_name(PortType type);

enum class Need : std::uint8_t { Optional, Mandatory };

struct PortRow {
  std::string_view name;
  BtcppDirection direction = BtcppDirection::Input;
  PortType type = PortType::Any;
  Need need = Need::Optional;
  // What else version 4 writes into a TreeNodesModel, or "".
  std::string_view preset = {};     // the default value
  std::string_view about = {};      // what the port is for
  std::string_view type_word = {};  // where `type` is not precise enough
  Releases in = {0, kNoRelease};    // that have it
};

// What a leaf can answer, and what it remembers. None can answer SKIPPED.
struct LeafAnswers {
  bool may_succeed = true;
  bool may_fail = true;
  bool may_run = false;
  LeafMemory memory = LeafMemory::None;
};

// The branches that profiles are named after, in the order of their release.
// Lyrical is main as well: their nodes are the same.
enum class Nav2Branch : std::uint8_t {
  Galactic,
  Humble,
  Iron,
  Jazzy,
  Kilted,
  Lyrical
};

// Some of them, a bit for each.
class Nav2Branches {
 public:
  constexpr Nav2Branches() = default;  // none
  constexpr Nav2Branches(std::initializer_list<Nav2Branch> branches) {
    for (const Nav2Branch branch : branches) bits_ |= bit(branch);
  }
  static constexpr Nav2Branches between(Nav2Branch first, Nav2Branch last) {
    Nav2Branches all;
    all.bits_ = (2U << static_cast<unsigned>(last)) - bit(first);
    return all;
  }
  static constexpr Nav2Branches all() {
    return between(Nav2Branch::Galactic, Nav2Branch::Lyrical);
  }

  constexpr bool has(Nav2Branch branch) const {
    return (bits_ & bit(branch)) != 0;
  }
  constexpr bool is_empty() const { return bits_ == 0; }
  constexpr Nav2Branches operator&(Nav2Branches other) const {
    other.bits_ &= bits_;
    return other;
  }

 private:
  static constexpr unsigned bit(Nav2Branch branch) {
    return 1U << static_cast<unsigned>(branch);
  }

  unsigned bits_ = 0;
};

Profile profile_of_branch(Nav2Branch branch);
// Of a profile of Nav2.
Nav2Branch branch_of(Profile profile);

// Which XML the trees of a profile are written in.
BtcppRelease dialect_of(Profile profile);

struct NodeTypeRow {
  std::string_view id;
  BtcppKind kind;
  NodeType type;  // what a node of this type is lowered as
  std::span<const PortRow> ports = {};
  // The number of children, where the row of `type` in model/tree/node_types
  // allows more; otherwise 0. Loading is less strict than ticking.
  int exact_children = 0;
  LeafAnswers answers = {};
  // Those that have a type of Nav2.
  Nav2Branches branches = Nav2Branches::all();
};

// A node type that every program of this release registers, or nullptr.
const NodeTypeRow* builtin_type(BtcppRelease release, std::string_view id);

// A node type of any branch of Nav2, or nullptr. Its ports differ between the
// branches, so a node may have ports that the row does not list.
const NodeTypeRow* nav2_type(std::string_view id);

// One of the two.
const NodeTypeRow* known_type(BtcppRelease release, std::string_view id);

// The type of another library, where the node is written as that one has it and
// has so many children.
const LibraryType* library_type_of(const BtcppNode& node, std::size_t children);

std::vector<std::string> builtin_names(BtcppRelease release);

// The first release that has a built-in node type, as far as that is later than
// the oldest profile of its version; else 0.
int first_release(std::string_view id);

// What a type that this release does not have is called today.
struct OldName {
  std::string_view today;   // in version 3 the type; else words; "" for none
  bool is_refused = false;  // no program registers the old name
};
OldName old_name(BtcppRelease release, std::string_view id);

std::span<const NodeTypeRow> nav2_types();

// Those that have this port of a node of Nav2, as far as they differ in it.
Nav2Branches branches_with_port(std::string_view node, std::string_view port);

// The branches that can load the document, by the types of Nav2 in it and their
// ports that not all of them have. Types that a model describes say nothing.
Nav2Branches branches_for(const BtcppDocument& document);

// What an element is lowered as: decided by its type, of either release, or by
// its kind when the type belongs to the user's program.
NodeType engine_type(BtcppRelease release, const BtcppNode& node);

struct PortFacts {
  BtcppDirection direction = BtcppDirection::Input;
  PortType type = PortType::Any;
};

// What BehaviorTree.CPP, a model, Nav2 or another library says about a port of
// a node, in this order; nothing when none of them has the port. Not for
// SubTrees.
std::optional<PortFacts> facts_of(const BtcppDocument& document,
                                  const BtcppNode& node, std::string_view port);

}  // namespace btcheck::btcpp

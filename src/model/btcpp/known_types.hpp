// SPDX-License-Identifier: MIT
//
// The node types that BehaviorTree.CPP and Nav2 bring along, one row each, and
// the ports that a node can have. After BehaviorTree.CPP 3.8.8 and 4.10.0
// (src/bt_factory.cpp, src/action_node.cpp, and the `providedPorts` of each
// node) and the branches galactic to main of Nav2
// (nav2_behavior_tree/plugins, and the base classes in its include folder); and
// those of py_trees 2.2.3.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/libraries/libraries.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"
#include "text/findings.hpp"

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
  bool is_threshold = false;        // it counts children
};

// What a type does to the entry that its port names: SetBlackboard's
// `output_key`, UnsetBlackboard's `key`.
enum class KeyedEntry : std::uint8_t { None, IsSet, IsUnset };

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

constexpr Nav2Branches from(Nav2Branch first) {
  return Nav2Branches::between(first, Nav2Branch::Lyrical);
}
inline constexpr Nav2Branches kFromHumble = from(Nav2Branch::Humble);
inline constexpr Nav2Branches kFromIron = from(Nav2Branch::Iron);
inline constexpr Nav2Branches kFromJazzy = from(Nav2Branch::Jazzy);
inline constexpr Nav2Branches kFromKilted = from(Nav2Branch::Kilted);
inline constexpr Nav2Branches kFromLyrical = from(Nav2Branch::Lyrical);
inline constexpr Nav2Branches kGalactic = {Nav2Branch::Galactic};
inline constexpr Nav2Branches kKilted = {Nav2Branch::Kilted};
inline constexpr Nav2Branches kUntilJazzy =
    Nav2Branches::between(Nav2Branch::Galactic, Nav2Branch::Jazzy);
inline constexpr Nav2Branches kUntilKilted =
    Nav2Branches::between(Nav2Branch::Humble, Nav2Branch::Kilted);
// Taken back into older branches, but not into all.
inline constexpr Nav2Branches kNotIron = {Nav2Branch::Humble, Nav2Branch::Jazzy,
                                          Nav2Branch::Kilted,
                                          Nav2Branch::Lyrical};
inline constexpr Nav2Branches kJazzyAndLyrical = {Nav2Branch::Jazzy,
                                                  Nav2Branch::Lyrical};

Profile profile_of_branch(Nav2Branch branch);
// Of a profile of Nav2.
Nav2Branch branch_of(Profile profile);

// Which XML the trees of a profile are written in.
BtcppRelease dialect_of(Profile profile);

// How a node compares the values of two ports.
enum class PortComparison : std::uint8_t {
  Switch,  // of 4.10 (details::CheckStringEquality): texts, or the numbers that
           // they are
  OldSwitch,  // of 4.5 to 4.9: texts, or the numbers that they begin with
  Text,       // Switch before 4.5, BlackboardCheckString
  Int,        // BlackboardCheckInt, …: what cannot be read equals nothing
  Double,
  ExactDouble,  // before 3.7
  Bool
};

// What the ports of one node say, as its profile reads them. What cannot be
// read, or is left open, is told.
class PortReader {
 public:
  virtual const BtcppNode& element() const = 0;
  virtual const BtcppNode* first_child() const = 0;  // nullptr: none
  virtual Profile profile() const = 0;
  // As it is written, else the default of its model.
  virtual std::optional<std::string> port(std::string_view name) const = 0;
  // A number that has to be known before the run.
  virtual int known_number(std::string_view name, int otherwise) = 0;
  // These are left open where an entry has them.
  virtual int rounds(std::string_view name) = 0;
  virtual Duration ticks(std::string_view name, double unit_ms) = 0;
  virtual Duration period(std::string_view name) = 0;
  // tick() reads a number by this port, and throws where none can be read.
  virtual void read_at_tick(Node& node, PortType type,
                            std::string_view name) = 0;
  // Scripts: of a port, one that decides; of what the node does by itself.
  virtual Script condition(std::string_view port) = 0;
  virtual Script action(std::string_view port) = 0;
  virtual Script equality(PortComparison how, std::string_view one,
                          std::string_view other) = 0;
  virtual Script set_blackboard() = 0;
  virtual Script unset_blackboard() = 0;
  virtual void refuse(const BtcppPlace& place, Wording finding) = 0;
  virtual void refuse_unmodelled(std::string_view port,
                                 std::string message) = 0;
  // Why not all that the node does is modelled.
  virtual void leave_open(std::string_view why) = 0;

  std::string text(std::string_view name) const {
    return port(name).value_or("");
  }
  bool flag(std::string_view name, bool otherwise) const;
  NodeStatus status(std::string_view name, NodeStatus otherwise) const;
  int release() const { return engine_release(profile()); }
  bool is_in(const Releases& releases) const { return releases.has(release()); }

 protected:
  ~PortReader() = default;
};
// Puts what the ports of a type say into its node.
using ReadPorts = void (*)(PortReader& ports, Node& node);

struct NodeTypeRow {
  std::string_view id;
  BtcppKind kind;
  NodeType type;  // what a node of this type is lowered as
  std::span<const PortRow> ports = {};
  // The number of children, where the row of `type` in model/tree/node_types
  // allows more; otherwise 0. Loading is less strict than ticking.
  int exact_children = 0;
  LeafAnswers answers = {};
  ReadPorts read = nullptr;  // where the node is made of more than its type
  // What it decides by something that is not modelled, so that every decision
  // is allowed.
  std::string_view left_open = {};
  KeyedEntry keyed = KeyedEntry::None;
  int since = 0;  // see `first_release`
  // Those that have a type of Nav2.
  Nav2Branches branches = Nav2Branches::all();
};

// Whether each type of a language is that of a row, or one of the others, and
// no type of another language is.
constexpr bool are_all_types(
    In language, std::initializer_list<std::span<const NodeTypeRow>> tables,
    std::initializer_list<NodeType> others) {
  return std::ranges::all_of(kNodeTypes, [&](const NodeTypeInfo& info) {
    const auto has_row = [&](std::span<const NodeTypeRow> rows) {
      return std::ranges::count(rows, info.type, &NodeTypeRow::type) > 0;
    };
    const bool is_there = std::ranges::count(others, info.type) > 0 ||
                          std::ranges::any_of(tables, has_row);
    return is_there == has(info.in, language);
  });
}

std::span<const NodeTypeRow> py_trees_types();

// A node type that every program of this release registers, or nullptr.
const NodeTypeRow* builtin_type(BtcppRelease release, std::string_view id);

// What the built-in type of this name does to an entry that a port names.
KeyedEntry keyed_by(BtcppRelease release, std::string_view id);

// A node type of any branch of Nav2, or nullptr. Its ports differ between the
// branches, so a node may have ports that the row does not list.
const NodeTypeRow* nav2_type(std::string_view id);

// The node that btcheck/observer.hpp registers, or nullptr.
const NodeTypeRow* observer_type(const BtcppNode& node);

// A built-in type, or one of Nav2.
const NodeTypeRow* known_type(BtcppRelease release, std::string_view id);
// Or that of the observer.
const NodeTypeRow* known_type(BtcppRelease release, const BtcppNode& node);

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

// The ports of a node of Nav2 in which the branches differ.
std::vector<std::string_view> ports_of_branches(std::string_view node);

// The branches that can load the document, by the types of Nav2 in it and their
// ports that not all of them have. Types that a model describes say nothing.
Nav2Branches branches_for(const BtcppDocument& document);

// What an element is lowered as: decided by its type, of either release, or by
// its kind when the type belongs to the user's program. The row is that of the
// type, or nullptr.
NodeType engine_type(BtcppRelease release, const BtcppNode& node);
const NodeTypeRow* engine_row(BtcppRelease release, const BtcppNode& node);

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

// SPDX-License-Identifier: MIT
//
// The node types that BehaviorTree.CPP and Nav2 bring along: kind, children,
// ports. After BehaviorTree.CPP 3.8.8 and 4.10.0 (src/bt_factory.cpp and the
// `providedPorts` of each node), and Nav2's plugins.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"

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
// "int", "unsigned", …, as a message names it.
std::string_view port_type_name(PortType type);

enum class Need : std::uint8_t { Optional, Mandatory };

struct PortRow {
  std::string_view name;
  BtcppDirection direction = BtcppDirection::Input;
  PortType type = PortType::Any;
  Need need = Need::Optional;
  // What else version 4 has in a TreeNodesModel; "" where nothing stands.
  std::string_view preset = {};     // the value by default
  std::string_view about = {};      // what the port is for
  std::string_view type_word = {};  // where `type` leaves it open
};

struct NodeTypeRow {
  std::string_view id;
  BtcppKind kind;
  // What the node takes when it is ticked; loading is less strict.
  int min_children;
  int max_children;  // kManyChildren when there is no upper end
  std::span<const PortRow> ports;
};
inline constexpr int kManyChildren = 1 << 20;

// A node type that is registered in every program of this release, or nullptr.
const NodeTypeRow* builtin_type(BtcppRelease release, std::string_view id);

// A node type of Nav2; its ports change with Nav2's branches, so those that
// are not listed may exist.
const NodeTypeRow* nav2_type(std::string_view id);

// One of the two.
const NodeTypeRow* known_type(BtcppRelease release, std::string_view id);

std::vector<std::string> builtin_names(BtcppRelease release);

const PortRow* port_of(const NodeTypeRow& type, std::string_view name);

// The name that version 4 has for a type of version 3: "SequenceWithMemory" for
// SequenceStar. "" when there is none, and in version 3.
std::string_view renamed_type(BtcppRelease release, std::string_view id);

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// The node types that BehaviorTree.CPP 4.10 brings along, as it lists them in a
// TreeNodesModel.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace btcheck {

enum class LoggedKind : std::uint8_t {
  Action,
  Condition,
  Control,
  Decorator,
  SubTree
};
// The word for it in XML.
std::string_view kind_name(LoggedKind kind);

struct LoggedModel {
  LoggedKind kind;
  std::string_view id;
};

struct LoggedPort {
  std::string_view model;      // the id of the model it belongs to
  std::string_view direction;  // input_port, output_port, inout_port
  std::string_view name;
  std::string_view type;
  std::string_view preset;  // the value by default, or ""
  std::string_view text;    // what it is for, or ""
};

// Ascending by id.
std::span<const LoggedModel> btcpp_models();
// Those of one model stand together.
std::span<const LoggedPort> btcpp_ports();

}  // namespace btcheck

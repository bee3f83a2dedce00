// SPDX-License-Identifier: MIT
//
// What is known of a node's ports: from BehaviorTree.CPP, from Nav2, or from
// a model.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/node_types.hpp"

namespace btcheck::btcpp {

struct PortFacts {
  BtcppDirection direction = BtcppDirection::Input;
  PortType type = PortType::Any;
};

// Of the port of a node that is no SubTree; nothing when neither the engine nor
// a model has it.
std::optional<PortFacts> facts_of(const BtcppDocument& document,
                                  const BtcppNode& node, std::string_view port);

// The names of all ports the node can have; nothing when they are not known.
std::optional<std::vector<std::string>> port_names(
    const BtcppDocument& document, const BtcppNode& node);

}  // namespace btcheck::btcpp

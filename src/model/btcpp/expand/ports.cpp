// SPDX-License-Identifier: MIT
#include "model/btcpp/expand/ports.hpp"

#include <array>
#include <utility>

namespace btcheck::btcpp {
namespace {

// Of the words that generated models have for C++ types; widths are left out,
// so that nothing is refused that the engine accepts.
PortType type_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PortType>, 9> kTypes = {
      {{"int", PortType::Int},
       {"unsigned int", PortType::Unsigned},
       {"unsigned", PortType::Unsigned},
       {"bool", PortType::Bool},
       {"double", PortType::Double},
       {"float", PortType::Double},
       {"NodeStatus", PortType::Status},
       {"BT::NodeStatus", PortType::Status},
       {"std::string", PortType::String}}};
  for (const auto& [word, type] : kTypes) {
    if (word == name) return type;
  }
  return PortType::Any;
}

}  // namespace

std::optional<PortFacts> facts_of(const BtcppDocument& document,
                                  const BtcppNode& node,
                                  std::string_view port) {
  const NodeTypeRow* type = builtin_type(document.release, node.id);
  const BtcppModel* model = document.model(node.id);
  if (type == nullptr && model != nullptr) {
    const BtcppPort* found = model->port(port);
    if (found == nullptr) return std::nullopt;
    return PortFacts{found->direction, type_named(found->type)};
  }
  if (type == nullptr) type = nav2_type(node.id);
  const PortRow* row = type == nullptr ? nullptr : port_of(*type, port);
  if (row == nullptr) return std::nullopt;
  return PortFacts{row->direction, row->type};
}

std::optional<std::vector<std::string>> port_names(
    const BtcppDocument& document, const BtcppNode& node) {
  std::vector<std::string> names;
  if (const auto* type = builtin_type(document.release, node.id)) {
    for (const PortRow& row : type->ports) names.emplace_back(row.name);
    return names;
  }
  const BtcppModel* model = document.model(node.id);
  if (model == nullptr) return std::nullopt;
  for (const BtcppPort& port : model->ports) names.push_back(port.name);
  return names;
}

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
#include "check/space/step_labels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "explore/state/transition_system.hpp"

namespace btcheck {
namespace {

// What the edge assigns to state variables and its label does not tell, from
// which the values along a path follow.
std::string assignments_of(const Network& network, const Edge& edge) {
  std::string text;
  for (const Assignment& update : edge.updates) {
    const Variable& variable = network.variable(update.variable);
    if (variable.role != VariableRole::State) continue;
    const std::string told =
        fmt::format("{} := {}", variable.name, assigned_text(network, update));
    if (told != edge.label) text += ", " + told;
  }
  return text;
}

std::string full_label(const Network& network, std::uint32_t number) {
  const Automaton& owner = network.owner_of_edge(number);
  const Edge& edge = network.edge(number);
  const std::string text =
      fmt::format("{}.{} -> {}", owner.name, owner.source(edge).name,
                  owner.target(edge).name);
  return text + (edge.label.empty() ? "" : ", " + edge.label) +
         assignments_of(network, edge);
}

bool is_seen(const Network& network, const Automaton& node, SeenAnswers seen) {
  switch (seen) {
    case SeenAnswers::OfRoot:
      return !network.node_caller[index(node.node)];
    case SeenAnswers::OfLeaves:
      return !node.find_location(LocationRole::Call);
    case SeenAnswers::OfAll:
      return true;
  }
  return true;
}

// A node that has thrown answers as well: the mission is over.
bool tells_answer(LocationRole role) {
  return is_answer(role) || role == LocationRole::Error;
}

std::string answer_label(const Network& network, std::uint32_t number,
                         SeenAnswers seen) {
  const Automaton& owner = network.owner_of_edge(number);
  const Edge& edge = network.edge(number);
  const Location& target = owner.target(edge);
  if (owner.kind != AutomatonKind::Node || !tells_answer(target.role) ||
      tells_answer(owner.source(edge).role) || !is_seen(network, owner, seen)) {
    return {};
  }
  return fmt::format("{} -> {}", owner.name, target.name);
}

}  // namespace

StepLabels::StepLabels(const Network& network, std::optional<SeenAnswers> seen)
    : network_(network), seen_(seen), labels_(network.edge_count() + 1) {
  labels_.back() = "time";
}

const std::string& StepLabels::of(std::uint32_t edge) {
  auto& label = edge == kTimeStep ? labels_.back() : labels_[edge];
  if (!label) {
    label = seen_ ? answer_label(network_, edge, *seen_)
                  : full_label(network_, edge);
  }
  return *label;
}

}  // namespace btcheck

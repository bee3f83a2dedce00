// SPDX-License-Identifier: MIT
//
// How often each edge of each automaton's table is taken, over many trees.
//
// An edge that is never taken by any tree is one no cross-check has seen. The
// key tells edges apart by what they are for, not by which child or value they
// are about: otherwise large trees would count too little.
#include "reference/edge_census.hpp"
#include "model/tree/node_types.hpp"

#include <algorithm>
#include <cctype>

namespace btcheck::reference {
namespace {

std::string replaced(std::string text, const std::string& part,
                     const std::string& by) {
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + by.size())) {
    text.replace(at, part.size(), by);
  }
  return text;
}

// Without the names of children and the numbers of `wait_1`.
std::string abstracted(const BehaviorTree& tree, NodeId node,
                       std::string text) {
  std::vector<std::string> names;
  for (const NodeId child : tree.node(node).children) {
    names.push_back(unique_name(tree, child));
  }
  std::ranges::sort(names, std::ranges::greater{}, &std::string::size);
  for (const std::string& name : names) text = replaced(text, name, "child");
  if (!text.starts_with("wait_")) return text;
  std::string result;
  for (const char c : text) {
    if (!std::isdigit(static_cast<unsigned char>(c))) {
      result += c;
    } else if (result.back() != 'N') {
      result += 'N';
    }
  }
  return result;
}

std::string options_of(const Node& node) {
  std::string options;
  if (node.halt) options += " :halt";
  if (node.wait && !node.halt) options += " :wait";
  if (node.loop) options += " :loop";
  if (node.duration) options += " :duration";
  return options;
}

// ", on running" when the guard asks for a child's answer.
std::string answer_in(const Network& network, const Edge& edge) {
  const auto terms = edge.guard.terms();
  for (std::size_t i = 0; i + 2 < terms.size(); ++i) {
    if (terms[i].operation != Operation::Variable ||
        terms[i + 1].operation != Operation::Constant ||
        terms[i + 2].operation != Operation::Equal) {
      continue;
    }
    const VariableId read{static_cast<std::uint32_t>(terms[i].operand)};
    const auto word = static_cast<std::size_t>(terms[i + 1].operand);
    if (network.variable(read).role == VariableRole::Status) {
      return ", on " + std::string(kStatusNames.at(word));
    }
  }
  return {};
}

}  // namespace

std::string edge_name(const BehaviorTree& tree, const Network& network,
                      const Automaton& automaton, const Edge& edge) {
  if (automaton.kind == AutomatonKind::StateVariable) {
    return "state variable: value -> value";
  }
  const Node& node = tree.node(automaton.node);
  const std::string type(type_name(node.type));
  const auto place = [&](LocationId location) {
    return abstracted(tree, automaton.node,
                      automaton.locations[index(location)].name);
  };
  const std::string edge_text =
      place(edge.source) + " -> " + place(edge.target);
  if (automaton.kind == AutomatonKind::Timer) {
    return type + " timer: " + edge_text;
  }
  const bool waits_for_children = place(edge.source) == "child_done";
  std::string name = type + options_of(node) + ": " + edge_text;
  if (waits_for_children) name += answer_in(network, edge);
  if (!edge.label.empty() && node.type != NodeType::SetSV) {
    name += " (" + abstracted(tree, automaton.node, edge.label) + ")";
  }
  return name;
}

void count_edges(const BehaviorTree& tree, const Network& network,
                 const NaiveSpace& space, EdgeCensus& census) {
  std::vector<std::uint64_t> taken(network.edge_count(), 0);
  for (const auto& steps : space.steps) {
    for (const NaiveSpace::Step& step : steps) {
      if (step.edge) ++taken[*step.edge];
    }
  }
  for (const Automaton& automaton : network.automata) {
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      census[edge_name(tree, network, automaton, automaton.edges[e])] +=
          taken[automaton.first_edge + e];
    }
  }
}

}  // namespace btcheck::reference

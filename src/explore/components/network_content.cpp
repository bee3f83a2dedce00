// SPDX-License-Identifier: MIT
#include "explore/components/network_content.hpp"

#include "explore/components/cut_part.hpp"

namespace btcheck {

NetworkContent::NetworkContent(const Network& network) {
  std::vector<std::int32_t> content;
  std::vector<VariableId> names;
  const auto put = [&](auto value) {
    content.push_back(static_cast<std::int32_t>(value));
  };
  const auto number = [&](VariableId name) {
    const auto [known, is_new] = variables_.try_emplace(
        index(name), static_cast<std::int32_t>(names.size()));
    if (is_new) names.push_back(name);
    return VariableId{static_cast<std::uint32_t>(known->second)};
  };
  put(network.ticks);
  put(network.fault ? static_cast<std::int64_t>(index(number(*network.fault)))
                    : -1);
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    if (automaton.edges.empty()) continue;
    automata_.emplace(a, static_cast<std::int32_t>(automata_.size()));
    put(automaton.kind);
    append(automaton, number, content);
    for (const Location& each : automaton.locations) put(each.role);
    // What others hear of it, and questions ask for.
    if (automaton.kind == AutomatonKind::Node) {
      put(index(number(network.node_status[index(automaton.node)])));
    }
    put(automaton.locals.size());
    for (const VariableId local : automaton.locals) put(index(number(local)));
  }
  for (const VariableId name : names) {
    const Variable& variable = network.variable(name);
    put(variable.min);
    put(variable.max);
    put(variable.initial);
  }
  hash_ = hash_of(content);
}

ContentHash NetworkContent::of(std::span<const std::int32_t> question) const {
  std::vector<std::int32_t> all;
  for (const std::uint64_t half : {hash_.low, hash_.high}) {
    all.push_back(static_cast<std::int32_t>(half >> 32));
    all.push_back(static_cast<std::int32_t>(half & 0xffffffff));
  }
  all.insert(all.end(), question.begin(), question.end());
  return hash_of(all);
}

}  // namespace btcheck

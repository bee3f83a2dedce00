// SPDX-License-Identifier: MIT
#include "explore/reduce/contexts.hpp"

#include <optional>
#include <set>
#include <utility>

#include "explore/state/accesses.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostFlags = 4;

}  // namespace

Contexts::Contexts(const Network& network, const Automaton& automaton)
    : network_(network), automaton_(automaton) {
  for (const VariableId local : automaton.locals) {
    const bool is_flag = network.variable(local).domain_size() == 2;
    if (is_flag && flags_.size() < kMostFlags) flags_.push_back(local);
  }
  for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) add_arcs(e);
  arcs_from_.resize(size());
  arcs_into_.resize(size());
  for (std::uint32_t arc = 0; arc < arcs_.size(); ++arc) {
    arcs_from_[arcs_[arc].from].push_back(arc);
    arcs_into_[arcs_[arc].to].push_back(arc);
  }
}

std::uint32_t Contexts::initial() const {
  const auto first = [&](VariableId variable) {
    const Variable& of = network_.variable(variable);
    return static_cast<std::uint32_t>(of.initial - of.min);
  };
  std::uint32_t context = first(automaton_.location) << flags_.size();
  for (std::uint32_t i = 0; i < flags_.size(); ++i) {
    context |= first(flags_[i]) << i;
  }
  return context;
}

// From every setting of the flags that the guard allows; a flag that is given
// a computed value may be either afterwards.
void Contexts::add_arcs(std::uint32_t number) {
  const Edge& edge = automaton_.edges[number];
  std::uint32_t demanded_mask = 0, demanded = 0;
  std::uint32_t fixed_mask = 0, fixed = 0, open = 0;
  for (std::uint32_t i = 0; i < flags_.size(); ++i) {
    const int lowest = network_.variable(flags_[i]).min;
    const std::uint32_t bit = 1u << i;
    if (const auto value = demanded_value(edge.guard, flags_[i])) {
      demanded_mask |= bit;
      if (*value != lowest) demanded |= bit;
    }
    for (const Assignment& update : edge.updates) {
      if (update.variable != flags_[i]) continue;
      const auto value = constant_value(update);
      fixed_mask |= bit;
      fixed &= ~bit;
      open = value ? open & ~bit : open | bit;
      if (value && *value != lowest) fixed |= bit;
    }
  }
  for (std::uint32_t flags = 0; flags < 1u << flags_.size(); ++flags) {
    if ((flags & demanded_mask) != demanded) continue;
    const std::uint32_t after = (flags & ~fixed_mask) | fixed;
    for (std::uint32_t some = open;; some = (some - 1) & open) {
      arcs_.push_back({index(edge.source) << flags_.size() | flags,
                       index(edge.target) << flags_.size() | after | some,
                       number});
      if (some == 0) break;
    }
  }
}

Mentions::Mentions(const Automaton& automaton) {
  for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
    const Edge& edge = automaton.edges[e];
    for (const Expression& conjunct : edge.guard.conjuncts()) {
      std::set<VariableId> reads;
      for_each_read(conjunct, [&](VariableId read, std::optional<int>) {
        reads.insert(read);
      });
      for (const VariableId read : reads) {
        Expression& guard = add(e, read).guard;
        guard = both(std::move(guard), conjunct);
      }
    }
    for (const Assignment& update : edge.updates) {
      add(e, update.variable);
      for_each_read(update.value,
                    [&](VariableId read, std::optional<int>) { add(e, read); });
    }
  }
}

const std::vector<Mentions::Mention>& Mentions::of(VariableId variable) const {
  static const std::vector<Mention> kNone;
  const auto found = mentions_.find(index(variable));
  return found == mentions_.end() ? kNone : found->second;
}

Mentions::Mention& Mentions::add(std::uint32_t edge, VariableId variable) {
  std::vector<Mention>& all = mentions_[index(variable)];
  if (all.empty() || all.back().edge != edge) all.push_back({edge, {}});
  return all.back();
}

}  // namespace btcheck

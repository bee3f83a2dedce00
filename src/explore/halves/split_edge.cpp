// SPDX-License-Identifier: MIT
//
// A guard is a conjunction, so it splits where each conjunct reads one half;
// an update is a list of assignments, most of them of constants, so it splits
// where each reads and writes one half, and the order within a half is kept.
// What does not split is rare, and left to the whole network.
#include "explore/halves/split_edge.hpp"

#include <algorithm>
#include <array>
#include <boost/container_hash/hash.hpp>

namespace btcheck {

std::size_t SplitEdges::AssignmentsHash::operator()(
    const Assignments& assignments) const {
  std::size_t hash = 0;
  for (const auto& [field, value] : assignments) {
    boost::hash_combine(hash, field.word);
    boost::hash_combine(hash, field.shift);
    for (const Term& term : value.terms()) {
      boost::hash_combine(hash, term.operand);
    }
  }
  return hash;
}

struct SplitEdges::Parts {
  Half own = Half::Low;
  Expression guards[2];  // by half
  Assignments assignments[2];
  bool is_mixed = false;
};

SplitEdges::SplitEdges(const Network& network, const StateLayout& layout)
    : network_(network),
      layout_(layout),
      conditions_(network, layout),
      automata_(network.automata.size()),
      effects_(1),
      known_effects_{{{}, 0}} {
  for (auto& guards : far_guards_) guards.resize(1);
  for (std::size_t a = 0; a < network.automata.size(); ++a) {
    if (layout.clocks[a]) clocked_.push_back(a);
  }
  for (std::size_t a = 0; a < network.automata.size(); ++a) {
    split_automaton(network.automata[a], a);
  }
}

void SplitEdges::split_automaton(const Automaton& automaton,
                                 std::size_t number) {
  SplitAutomaton& split = automata_[number];
  split.location = layout_.fields[index(automaton.location)];
  split.clock = layout_.clocks[number];
  if (automaton.gate) split.gate = layout_.fields[index(*automaton.gate)];
  split.is_timer = automaton.kind == AutomatonKind::Timer;
  // An automaton's variables all lie in one half, but those of no bits in none.
  split.half = layout_.half_of(split.clock  ? *split.clock
                               : split.gate ? *split.gate
                                            : split.location);
  split.edges.resize(automaton.locations.size());
  split.greatest_clock.resize(automaton.locations.size(), 0);
  for (const Edge& edge : automaton.edges) {
    SplitEdge made = split_edge(automaton, edge, split.half);
    int& greatest = split.greatest_clock[index(edge.source)];
    greatest = std::max(greatest, edge.when.greatest_clock());
    split.edges[index(edge.source)].push_back(std::move(made));
  }
}

SplitEdge SplitEdges::split_edge(const Automaton& automaton, const Edge& edge,
                                 Half own) {
  Parts parts;
  parts.own = own;
  split_guard(edge, parts);
  for (const Assignment& update : edge.updates) split_update(update, parts);
  const std::int32_t target = network_.variable(automaton.location).min +
                              static_cast<std::int32_t>(index(edge.target));
  split_update({automaton.location, Expression::constant(target)}, parts);

  const Half far = own == Half::Low ? Half::High : Half::Low;
  const std::size_t near_part = index(own);
  const std::size_t far_part = index(far);
  SplitEdge split;
  split.lower = edge.when.lower;
  split.upper = edge.when.upper;
  split.guard = conditions_.compile(parts.guards[near_part]);
  if (!parts.is_mixed) {
    split.far_guard = number_of_guard(parts.guards[far_part], far);
  }
  if (parts.is_mixed || split.far_guard == kMostFarGuards) {
    split.reach = EdgeReach::Mixed;
    return split;
  }
  split.effect = number_of_effect(std::move(parts.assignments[near_part]));
  split.far_effect = number_of_effect(std::move(parts.assignments[far_part]));
  if (split.far_guard != 0 || split.far_effect != 0) {
    split.reach = EdgeReach::Both;
  }
  return split;
}

namespace {

// Whether an expression reads the low half, and the high one.
std::array<bool, 2> reads_of(const Expression& expression,
                             const StateLayout& layout) {
  std::array<bool, 2> reads{};
  for (const Term& term : expression.terms()) {
    if (term.operation != Operation::Variable) continue;
    const Field& field = layout.fields[static_cast<std::size_t>(term.operand)];
    if (field.width == 0) continue;
    reads[index(layout.half_of(field))] = true;
  }
  return reads;
}

}  // namespace

void SplitEdges::split_guard(const Edge& edge, Parts& parts) const {
  for (const Expression& conjunct : edge.guard.conjuncts()) {
    const auto [reads_low, reads_high] = reads_of(conjunct, layout_);
    if (reads_low && reads_high) {
      parts.is_mixed = true;
      continue;
    }
    const std::size_t where = reads_low ? 0 : reads_high ? 1 : index(parts.own);
    parts.guards[where] = both(std::move(parts.guards[where]), conjunct);
  }
}

// Entering a location, one's own or another's, sets that automaton's clock to
// 0 (step.cpp).
void SplitEdges::split_update(const Assignment& update, Parts& parts) const {
  add_to(parts, layout_.fields[index(update.variable)], update.value);
  for (const std::size_t a : clocked_) {
    if (network_.automata[a].location == update.variable) {
      add_to(parts, *layout_.clocks[a], Expression::constant(0));
    }
  }
}

void SplitEdges::add_to(Parts& parts, const Field& field,
                        const Expression& value) const {
  if (field.width == 0) return;
  const std::size_t where = index(layout_.half_of(field));
  parts.is_mixed |= reads_of(value, layout_)[1 - where];
  parts.assignments[where].emplace_back(field, value);
}

std::uint32_t SplitEdges::number_of_effect(Assignments assignments) {
  const auto next = static_cast<std::uint32_t>(effects_.size());
  const auto [known, is_new] =
      known_effects_.try_emplace(std::move(assignments), next);
  if (!is_new) return known->second;
  std::vector<Write>& writes = effects_.emplace_back();
  for (const auto& [field, value] : known->first) {
    writes.push_back({field, conditions_.compile_value(value)});
  }
  return next;
}

std::uint32_t SplitEdges::number_of_guard(const Expression& guard, Half half) {
  if (guard.is_true()) return 0;
  std::vector<FarGuard>& guards = far_guards_[index(half)];
  const auto known = std::find_if(
      guards.begin() + 1, guards.end(),
      [&](const FarGuard& far) { return far.expression == guard; });
  const auto number = static_cast<std::uint32_t>(known - guards.begin());
  if (known == guards.end() && number < kMostFarGuards) {
    guards.push_back({guard, conditions_.compile(guard)});
  }
  return number;
}

void SplitEdges::apply(std::uint32_t effect, Word* state) const {
  for (const Write& write : effects_[effect]) {
    write.field.put(state, conditions_.value(write.value, state));
  }
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Compiling the tables: per automaton and location a run of edges, per edge a
// run of word tests and a run of word writes. The idea is SPIN's and LTSmin's
// (a next-state function that touches only what an edge names), done here on
// the packed words themselves. Automata that wait to be called are not even
// looked at: their gate bits say so (state_layout.hpp).
#include "explore/state/step.hpp"

#include <algorithm>

#include "text/budget.hpp"

namespace btcheck {

CompiledNetwork::CompiledNetwork(const Network& network)
    : CompiledNetwork(network, StateLayout(network)) {}

CompiledNetwork::CompiledNetwork(const Network& network, StateLayout layout)
    : network_(network),
      layout_(std::move(layout)),
      conditions_(network, layout_),
      initial_(layout_.initial(network)),
      is_untimed_(network.ticks == TickSemantics::None),
      automata_(network.automata.size()) {
  if (network.fault) fault_ = layout_.fields[index(*network.fault)];
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (layout_.clocks[a]) clocked_.push_back(a);
  }
  std::size_t writes = 0;
  for (const Automaton& automaton : network.automata) {
    for (const Edge& edge : automaton.edges) writes += edge.updates.size() + 2;
  }
  writes_.reserve(writes);
  edges_.reserve(network.edge_count());
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    ask_budget();
    const Automaton& automaton = network.automata[a];
    compile_automaton(AutomatonId{a});
    if (!automaton.gate && !automaton.edges.empty()) ungated_.push_back(a);
    if (automaton.kind == AutomatonKind::Timer && layout_.clocks[a]) {
      timers_.push_back(a);
    }
    has_free_moves_ |= automaton.kind == AutomatonKind::StateVariable &&
                       !automaton.edges.empty();
  }
}

void CompiledNetwork::compile_automaton(AutomatonId id) {
  const Automaton& automaton = network_.automaton(id);
  CompiledAutomaton& compiled = automata_[index(id)];
  compiled.location = layout_.fields[index(automaton.location)];
  compiled.first_location = static_cast<std::uint32_t>(locations_.size());
  compiled.clock = layout_.clocks[index(id)];
  if (automaton.gate) {
    const Field& gate = layout_.fields[index(*automaton.gate)];
    compiled.gate_word = gate.word;
    compiled.gate = gate.mask();
  }
  std::vector<std::vector<std::uint32_t>> leaving(automaton.locations.size());
  for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
    leaving[index(automaton.edges[e].source)].push_back(e);
  }
  for (const auto& edges : leaving) {
    CompiledLocation location;
    location.first_edge = static_cast<std::uint32_t>(edges_.size());
    for (const std::uint32_t e : edges) {
      compile_edge(automaton, id, e);
      location.greatest_clock = std::max(
          location.greatest_clock, automaton.edges[e].when.greatest_clock());
    }
    location.last_edge = static_cast<std::uint32_t>(edges_.size());
    locations_.push_back(location);
  }
}

void CompiledNetwork::compile_edge(const Automaton& automaton, AutomatonId id,
                                   std::uint32_t position) {
  ask_budget();
  const Edge& edge = automaton.edges[position];
  CompiledEdge compiled;
  compiled.guard = conditions_.compile(edge.guard);
  compiled.first_write = static_cast<std::uint32_t>(writes_.size());
  for (const Assignment& update : edge.updates) {
    compile_assignment(update, compiled.first_write);
  }
  write_constant(layout_.fields[index(automaton.location)],
                 network_.variable(automaton.location).min +
                     static_cast<int>(index(edge.target)),
                 compiled.first_write);
  if (layout_.clocks[index(id)]) {
    write_constant(*layout_.clocks[index(id)], 0, compiled.first_write);
  }
  compiled.last_write = static_cast<std::uint32_t>(writes_.size());
  compiled.number = automaton.first_edge + position;
  compiled.lower = edge.when.lower;
  compiled.upper = edge.when.upper;
  compiled.progress = automaton.kind != AutomatonKind::StateVariable;
  compiled.may_preempt = may_preempt(automaton, edge);
  edges_.push_back(compiled);
}

bool CompiledNetwork::may_preempt(const Automaton& automaton,
                                  const Edge& edge) const {
  const auto is_watched = [&](VariableId variable) {
    if (network_.fault == variable) return true;
    return std::ranges::any_of(clocked_, [&](std::uint32_t clocked) {
      const Automaton& other = network_.automata[clocked];
      return other.kind == AutomatonKind::Timer && other.location == variable;
    });
  };
  return is_watched(automaton.location) ||
         std::ranges::any_of(edge.updates, is_watched, &Assignment::variable);
}

// An assignment to the location of another automaton (a timer) resets that
// automaton's clock.
void CompiledNetwork::compile_assignment(const Assignment& assignment,
                                         std::uint32_t first_write) {
  const Field& field = layout_.fields[index(assignment.variable)];
  std::span<const Term> terms = assignment.value.terms();
  if (terms.size() == 1 && terms[0].operation == Operation::Constant) {
    write_constant(field, terms[0].operand, first_write);
  } else if (field.width > 0) {
    Write write;
    write.is_computed = true;
    write.program = conditions_.compile_value(assignment.value);
    write.field = field;
    writes_.push_back(write);
  }
  for (const std::uint32_t clocked : clocked_) {
    if (network_.automata[clocked].location == assignment.variable) {
      write_constant(*layout_.clocks[clocked], 0, first_write);
    }
  }
}

// Constants that go into one word are one write, unless a computed value,
// which may read the word, stands between them.
void CompiledNetwork::write_constant(const Field& field, std::int64_t value,
                                     std::uint32_t first_write) {
  if (field.width == 0) return;
  for (std::size_t i = writes_.size(); i > first_write; --i) {
    Write& known = writes_[i - 1];
    if (known.is_computed) break;
    if (known.word != field.word) continue;
    known.keep &= ~field.mask();
    known.bits = (known.bits & ~field.mask()) | field.bits(value);
    return;
  }
  writes_.push_back(
      {~field.mask(), field.bits(value), field.word, false, {}, {}});
}

Enabled CompiledNetwork::enabled(StateView state) const {
  Enabled found;
  successors(state, [&](StateView target, Step step) {
    const bool is_edge = step.edge != kTimeStep;
    found.tree |= is_edge && step.progress;
    found.any |=
        is_edge || !std::equal(target.begin(), target.end(), state.begin());
  });
  return found;
}

bool CompiledNetwork::is_at_rest(StateView state, AutomatonId automaton) const {
  const CompiledAutomaton& compiled = automata_[index(automaton)];
  const CompiledLocation& here = present(compiled, state.data());
  const std::int64_t clock =
      here.greatest_clock > 0 ? compiled.clock->get(state.data()) : 0;
  for (std::uint32_t i = here.first_edge; i < here.last_edge; ++i) {
    if (edges_[i].lower <= clock) return false;
  }
  return true;
}

void CompiledNetwork::clear_clocks(std::span<Word> state) const {
  for (const std::uint32_t clocked : clocked_) {
    automata_[clocked].clock->put(state.data(), 0);
  }
}

}  // namespace btcheck

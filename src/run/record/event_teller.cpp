// SPDX-License-Identifier: MIT
#include "run/record/event_teller.hpp"

#include <optional>

#include "run/leaves/function_leaves.hpp"

namespace btcheck {
namespace {

std::optional<run::Status> status_of(LocationRole role) {
  if (role == LocationRole::Success) return run::Status::Success;
  if (role == LocationRole::Failure) return run::Status::Failure;
  if (role == LocationRole::Running) return run::Status::Running;
  if (role == LocationRole::Halted) return run::Status::Halted;
  return std::nullopt;
}

}  // namespace

EventTeller::EventTeller(const BehaviorTree& tree,
                         const CompiledNetwork& system, Told told)
    : tree_(tree),
      system_(system),
      told_(std::move(told)),
      ticks_(tree.nodes.size(), 0) {
  for (const Automaton& automaton : system.network().automata) {
    for (const Edge& edge : automaton.edges) {
      meanings_.push_back(meaning_of(automaton, edge));
    }
  }
  names_ = short_names(tree);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    root_of_.push_back(btcheck::root_of(tree, NodeId{n}));
  }
  for (const StateVariable& variable : tree.variables) {
    std::vector<std::string>& words = words_.emplace_back();
    if (!variable.is_enumeration()) continue;
    for (int value = 0; value <= variable.max; ++value) {
      words.push_back(variable.value_name(value));
    }
  }
}

EventTeller::Meaning EventTeller::meaning_of(const Automaton& owner,
                                             const Edge& edge) const {
  Meaning meaning;
  if (owner.kind != AutomatonKind::Node) return meaning;
  const LocationRole from = owner.source(edge).role;
  const LocationRole to = owner.target(edge).role;
  meaning.node = owner.node;
  if (tree_.node(owner.node).is_root() && from == LocationRole::Tick) {
    meaning.is_told = true;
    meaning.kind = run::Event::Kind::TickBegins;
  } else if (from == LocationRole::Start && to == LocationRole::Tick) {
    meaning.is_told = !tree_.node(owner.node).is_root();
  } else if (const auto status = status_of(to)) {
    meaning.is_told = edge.source != edge.target;
    meaning.kind = run::Event::Kind::Answered;
    meaning.status = *status;
  }
  return meaning;
}

void EventTeller::began(StateView state) {
  for (const VariableId variable : system_.network().state_variable) {
    values_.push_back(static_cast<int>(system_.value(state, variable)));
  }
}

void EventTeller::stepped(StateView after, const Step& step) {
  if (step.edge == kTimeStep) return;
  const Meaning& meaning = meanings_[step.edge];
  if (meaning.is_told) {
    int& tick = ticks_[index(root_of_[index(meaning.node)])];
    if (meaning.kind == run::Event::Kind::TickBegins) ++tick;
    told_({meaning.kind, tick, names_[index(meaning.node)], meaning.status});
  }
  tell_changes(after);
}

void EventTeller::tell_changes(StateView after) {
  for (std::size_t v = 0; v < values_.size(); ++v) {
    const int value = static_cast<int>(
        system_.value(after, system_.network().state_variable[v]));
    if (value == values_[v]) continue;
    values_[v] = value;
    run::Event event{run::Event::Kind::Changed,
                     ticks_[index(tree_.roots.front())],
                     tree_.variables[v].name};
    if (words_[v].empty()) {
      event.number = number_of(tree_.variables[v], value);
    } else {
      event.value = words_[v][static_cast<std::size_t>(value)];
    }
    told_(event);
  }
}

}  // namespace btcheck

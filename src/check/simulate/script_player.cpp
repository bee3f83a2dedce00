// SPDX-License-Identifier: MIT
//
// Each answer of a leaf takes one result of its sequence, also where it had no
// choice: a script lists what happened, not what was open. An answer that
// stands is none: the leaf has not run. Where nobody has said whether it does,
// a leaf with results runs again. The time of an action with a :duration
// [min,max] is up when its next result is not running. Where a script and the
// tree disagree the run ends.
#include "check/simulate/script.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace btcheck {
namespace {

// The value of a state variable in a state.
int value_in(const Simulation& simulation, StateVariableId variable,
             const Valuation& state) {
  const VariableId read = simulation.network().state_variable[index(variable)];
  return state.variables[index(read)];
}

// What a choice of a leaf stands for: a NodeStatus, or the value found; -1 for
// an answer with effects that are a fault.
int result_of(const Simulation& simulation, const Node& leaf,
              const SimulationChoice& choice) {
  if (leaf.type == NodeType::SetSV) {
    return value_in(simulation, leaf.variable, simulation.after(choice));
  }
  const auto words = status_names(simulation.tree().profile);
  const Network& network = simulation.network();
  const Automaton& owner = network.owner_of_edge(choice.step.edge);
  const Edge& edge = network.edge(choice.step.edge);
  const auto word = std::ranges::find(words, owner.target(edge).name);
  if (word == words.end()) return -1;
  return static_cast<int>(word - words.begin());
}

std::string result_name(const Simulation& simulation, const Node& leaf,
                        int result) {
  return leaf.type == NodeType::SetSV
             ? simulation.tree().variable(leaf.variable).value_name(result)
             : std::string(status_names(
                   simulation.tree()
                       .profile)[static_cast<std::size_t>(result)]);
}

// Where the leaf may keep its answer or run again: that it runs again.
std::optional<std::size_t> running_again(const Simulation& simulation) {
  const auto choices = simulation.choices();
  const auto keeps = [&](const SimulationChoice& choice) {
    return keeps_answer(simulation.network().edge(choice.step.edge));
  };
  if (choices[0].kind != ChoiceKind::Answer || !keeps(choices[0])) {
    return std::nullopt;
  }
  for (std::size_t i = 1; i < choices.size(); ++i) {
    if (choices[i].kind == ChoiceKind::Tree) return i;
  }
  return std::nullopt;
}

}  // namespace

void ScriptCursor::advance() {
  ++position;
  if (result + 1 == sequence->results.size()) return;  // the last one repeats
  if (++used < next().times) return;
  used = 0;
  ++result;
}

ScriptCursors::ScriptCursors(const SimulationScript& script) {
  const auto begin = [&](const auto& numbers,
                         std::vector<ScriptCursor>& cursors) {
    for (const std::optional<std::size_t> number : numbers) {
      cursors.push_back({number ? &script.sequences[*number] : nullptr});
    }
  };
  begin(script.of_node, of_node);
  begin(script.of_variable, of_variable);
}

ScriptCursor& ScriptCursors::of_leaf(const BehaviorTree& tree, NodeId leaf) {
  ScriptCursor& own = of_node[index(leaf)];
  const Node& node = tree.node(leaf);
  const bool is_of_variable = own.sequence == nullptr &&
                              node.type == NodeType::SetSV &&
                              !moves_freely(tree, node.variable);
  return is_of_variable ? of_variable[index(node.variable)] : own;
}

ScriptPlayer::ScriptPlayer(const SimulationScript& script,
                           const SourceText& source)
    : source_(source), cursors_(script) {}

Diagnostic ScriptPlayer::refusal(const ScriptCursor& cursor, int tick,
                                 std::string_view who, std::string_view what,
                                 std::string instead) const {
  const ScriptedResult& next = cursor.next();
  return source_.diagnostic(
      Severity::Error, "BT1405", source_.span(next.begin, next.end),
      fmt::format("in tick {} `{}` cannot {}", tick, who, what),
      fmt::format("result {} of `{}`", cursor.position + 1,
                  cursor.sequence->name),
      std::move(instead));
}

ScriptedChoice ScriptPlayer::choose(const Simulation& simulation) {
  constexpr std::size_t kFirst = 0;
  const SimulationChoice& first = simulation.choices()[0];
  if (first.kind != ChoiceKind::Tick && first.kind != ChoiceKind::Answer) {
    return kFirst;
  }
  const BehaviorTree& tree = simulation.tree();
  const NodeId mover = simulation.network().owner_of_edge(first.step.edge).node;
  if (first.kind == ChoiceKind::Answer) return answer(simulation, mover);
  return mover == tree.roots.front() ? begin_tick(simulation)
                                     : ScriptedChoice(kFirst);
}

ScriptedChoice ScriptPlayer::answer(const Simulation& simulation, NodeId id) {
  const BehaviorTree& tree = simulation.tree();
  const Node& leaf = tree.node(id);
  ScriptCursor& cursor = cursors_.of_leaf(tree, id);
  if (cursor.sequence == nullptr) return std::size_t{0};
  if (const auto again = running_again(simulation)) return *again;
  const int wanted = cursor.next().value;
  const auto choices = simulation.choices();
  std::optional<std::size_t> due;
  std::optional<std::size_t> fault;
  std::vector<std::string> possible;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].kind == ChoiceKind::Due) due = i;
    if (choices[i].kind != ChoiceKind::Answer) continue;
    const int result = result_of(simulation, leaf, choices[i]);
    if (result == wanted) {
      cursor.advance();
      return i;
    }
    if (result < 0) fault = i;
    if (result >= 0) possible.push_back(result_name(simulation, leaf, result));
  }
  if (due) return *due;
  if (fault) return *fault;
  const std::string_view verb =
      leaf.type == NodeType::SetSV ? "find" : "answer";
  return refusal(
      cursor, simulation.ticks(id), short_name(tree, id),
      fmt::format("{} {}", verb, result_name(simulation, leaf, wanted)),
      fmt::format("there it can {} {}", verb, alternatives(possible)));
}

// Each free variable takes one result of its sequence before each tick of the
// first tree.
ScriptedChoice ScriptPlayer::begin_tick(const Simulation& simulation) {
  const BehaviorTree& tree = simulation.tree();
  const int tick = simulation.ticks(tree.roots.front()) + 1;
  if (moved_in_tick_ != tick) next_variable_ = 0;
  moved_in_tick_ = tick;
  while (next_variable_ < cursors_.of_variable.size()) {
    const StateVariableId variable{
        static_cast<std::uint32_t>(next_variable_++)};
    ScriptCursor& cursor = cursors_.of_variable[index(variable)];
    if (cursor.sequence == nullptr || !moves_freely(tree, variable)) continue;
    const int wanted = cursor.next().value;
    const int now = value_in(simulation, variable, simulation.state());
    const StateVariable& named = tree.variable(variable);
    std::vector<std::string> possible = {"stay " + named.value_name(now)};
    std::optional<std::size_t> move;
    for (std::size_t i = 0; i < simulation.choices().size(); ++i) {
      const SimulationChoice& choice = simulation.choices()[i];
      if (choice.kind != ChoiceKind::Move) continue;
      const int then = value_in(simulation, variable, simulation.after(choice));
      if (then == now) continue;
      if (then == wanted) move = i;
      possible.push_back("become " + named.value_name(then));
    }
    if (wanted != now && !move) {
      return refusal(cursor, tick, named.name,
                     "become " + named.value_name(wanted),
                     "there it can " + alternatives(possible));
    }
    cursor.advance();
    if (wanted != now) return *move;
  }
  return std::size_t{0};
}

}  // namespace btcheck

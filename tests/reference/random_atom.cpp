// SPDX-License-Identifier: MIT
//
// Random atoms and formulas over them: their text, and what they mean.
//
// The text goes through the reader and the binder, the meaning looks at the
// tables of the network by itself. Names are spelled in every way there is.
#include "reference/random_atom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "reference/random_ctl.hpp"
#include "reference/random_ltl.hpp"

namespace btcheck::reference {
namespace {

using AtomMeaning = std::function<std::optional<StateTest>(const BehaviorTree&,
                                                           const Network&)>;

std::optional<NodeId> node_called(const BehaviorTree& tree,
                                  const std::string& reference) {
  std::optional<NodeId> found;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    const std::array<std::string, 4> spellings = {
        node.name, fmt::format("{}@{}", node.name, node.span.line),
        unique_name(tree, NodeId{n}), fmt::format("btn{}", n)};
    if (std::ranges::find(spellings, reference) == spellings.end()) continue;
    if (found) return std::nullopt;
    found = NodeId{n};
  }
  return found;
}

const Automaton& automaton_of(const Network& network, NodeId node) {
  return network.automaton(network.node_automaton[index(node)]);
}

StateTest has_value(VariableId variable, int value) {
  return [variable, value](const NaiveSpace& space, std::size_t state) {
    return space.states[state].value(variable) == value;
  };
}

// The automaton is where the word says; never when it has no such place.
StateTest is_at(const Automaton& automaton, std::string_view word) {
  const auto found =
      std::ranges::find(automaton.locations, word, &Location::name);
  if (found == automaton.locations.end()) {
    return [](const NaiveSpace&, std::size_t) { return false; };
  }
  return has_value(automaton.location,
                   static_cast<int>(found - automaton.locations.begin()));
}

StateTest either_of(StateTest one, StateTest other) {
  return [=](const NaiveSpace& space, std::size_t state) {
    return one(space, state) || other(space, state);
  };
}

StateTest not_so(StateTest test) {
  return [=](const NaiveSpace& space, std::size_t state) {
    return !test(space, state);
  };
}

StateTest has_ended(const Automaton& root) {
  return either_of(is_at(root, "success"), is_at(root, "failure"));
}

StateTest is_active(const Network& network, NodeId node) {
  const int running = static_cast<int>(NodeStatus::Running);
  return either_of(has_value(*network.node_caller[index(node)], 1),
                   has_value(network.node_status[index(node)], running));
}

// Of a node or, called `root` or by its name, of the root.
AtomMeaning event(const std::string& reference, const std::string& word) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StateTest> {
    auto node = node_called(tree, reference);
    if (reference == "root") node = tree.roots.at(0);
    if (!node) return std::nullopt;
    const Automaton& automaton = automaton_of(network, *node);
    const bool is_root = tree.node(*node).is_root();
    if (is_root && word == "ended") return has_ended(automaton);
    if (is_root && word == "active") return not_so(has_ended(automaton));
    if (word == "active") return is_active(network, *node);
    return is_at(automaton, word == "ticked" ? "tick_node" : word);
  };
}

constexpr std::array<std::string_view, 6> kRelations = {"==", "!=", "<",
                                                        "<=", ">",  ">="};

bool compares(int left, std::string_view relation, int right) {
  if (relation == "==") return left == right;
  if (relation == "!=") return left != right;
  if (relation == "<") return left < right;
  if (relation == "<=") return left <= right;
  if (relation == ">") return left > right;
  return left >= right;
}

StateTest comparison(VariableId variable, std::string_view relation,
                     int value) {
  return [=](const NaiveSpace& space, std::size_t state) {
    return compares(space.states[state].value(variable), relation, value);
  };
}

AtomMeaning of_local(const std::string& reference, const std::string& name,
                     std::string_view relation, int value) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StateTest> {
    const auto node = node_called(tree, reference);
    if (!node) return std::nullopt;
    if (name == "status") {
      return comparison(network.node_status[index(*node)], relation, value);
    }
    for (const VariableId local : automaton_of(network, *node).locals) {
      if (network.variable(local).name == name) {
        return comparison(local, relation, value);
      }
    }
    return std::nullopt;
  };
}

AtomMeaning of_variable(const std::string& name, std::string_view relation,
                        const std::string& value) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StateTest> {
    for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
      if (tree.variables[v].name != name) continue;
      for (int i = tree.variables[v].min; i <= tree.variables[v].max; ++i) {
        if (tree.variables[v].value_name(i) == value) {
          return comparison(network.state_variable[v], relation, i);
        }
      }
    }
    return std::nullopt;
  };
}

// Process numbers: enumerated variables as declared, then the nodes.
AtomMeaning of_process(std::size_t number, const std::string& word) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StateTest> {
    std::size_t left = number;
    for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
      const StateVariable& variable = tree.variables[v];
      const auto mover = network.state_automaton[v];
      if ((!variable.is_enumeration() && !mover) || --left > 0) continue;
      if (!variable.is_enumeration()) {  // a number that moves is in one place
        const auto names = network.automaton(*mover).location_names();
        if (names != std::vector<std::string>{word}) return std::nullopt;
        return StateTest([](const NaiveSpace&, std::size_t) { return true; });
      }
      const auto found = std::ranges::find(variable.states, word);
      if (found == variable.states.end()) return std::nullopt;
      return has_value(network.state_variable[v],
                       static_cast<int>(found - variable.states.begin()));
    }
    const std::vector<NodeId> order = post_order(tree);
    if (left > order.size()) return std::nullopt;
    const Automaton& automaton = automaton_of(network, order[left - 1]);
    if (!automaton.find_location(word)) return std::nullopt;
    return is_at(automaton, word);
  };
}

AtomMeaning of_keyword(const std::string& word) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StateTest> {
    const Automaton& root = automaton_of(network, tree.roots.at(0));
    if (word == "tick") return is_at(root, "tick_node");
    const StateTest ended = has_ended(root);
    const std::optional<VariableId> fault = network.fault;
    return [=](const NaiveSpace& space, std::size_t state) -> bool {
      if (!space.dead[state] || word == "dead") return space.dead[state];
      if (fault && space.states[state].value(*fault) != 0) return false;
      return !ended(space, state);
    };
  };
}

// A state test with what it is about looked up in the tree at hand.
using StepMeaning =
    std::function<std::optional<StepTest>(const BehaviorTree&, const Network&)>;

// Whether a condition is as `before` says, and other than that after the step.
StepMeaning changes(const NaiveAtom& of, bool before) {
  return [of, before](const BehaviorTree& tree,
                      const Network& network) -> std::optional<StepTest> {
    const auto test = of.test(tree, network);
    if (!test) return std::nullopt;
    return [test = *test, before](const NaiveSpace& space, std::size_t state,
                                  const NaiveSpace::Step& step) {
      return test(space, state) == before && test(space, step.target) != before;
    };
  };
}

// An edge of one of these automata is taken.
StepTest takes_edge_of(std::vector<const Automaton*> movers) {
  return [movers = std::move(movers)](const NaiveSpace&, std::size_t,
                                      const NaiveSpace::Step& step) {
    return step.edge &&
           std::ranges::any_of(movers, [&](const Automaton* mover) {
             return *step.edge >= mover->first_edge &&
                    *step.edge < mover->first_edge + mover->edges.size();
           });
  };
}

StepMeaning node_moves(const std::string& reference) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StepTest> {
    const auto node = node_called(tree, reference);
    if (!node) return std::nullopt;
    std::vector<const Automaton*> movers = {&automaton_of(network, *node)};
    for (const Automaton& automaton : network.automata) {
      const bool is_timer = automaton.kind == AutomatonKind::Timer;
      if (is_timer && automaton.node == *node) movers.push_back(&automaton);
    }
    return takes_edge_of(std::move(movers));
  };
}

StepMeaning variable_moves(const std::string& name) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StepTest> {
    for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
      if (tree.variables[v].name != name || !network.state_automaton[v]) {
        continue;
      }
      return takes_edge_of({&network.automaton(*network.state_automaton[v])});
    }
    return std::nullopt;
  };
}

StepMeaning time_passes() {
  return [](const BehaviorTree&, const Network&) -> std::optional<StepTest> {
    return [](const NaiveSpace&, std::size_t, const NaiveSpace::Step& step) {
      return !step.edge.has_value();
    };
  };
}

}  // namespace

StateTest node_event(const Network& network, NodeId node,
                     std::string_view location) {
  return is_at(automaton_of(network, node), location);
}

int temporal_count(const FormulaPool& pool, FormulaId formula) {
  int temporal = 0;
  for (const FormulaId part : pool.nodes(formula)) {
    temporal += pool[part].kind >= FormulaKind::Next ? 1 : 0;
  }
  return temporal;
}

NaiveAtom AtomMaker::atom() {
  const int kind = random_.below(100);
  if (kind < 45) return node_atom();
  if (kind < 58) return local();
  if (kind < 78 && !tree_.variables.empty()) return variable();
  if (kind < 88) return process();
  const std::string word =
      one_of(std::array<std::string, 3>{"dead", "stuck", "tick"});
  return {word, of_keyword(word), {}};
}

// Enter and leave, of a node or a variable, or of time.
NaiveAtom AtomMaker::step_atom() {
  const std::uint32_t kind = number(10);
  if (kind == 0) return {"time.passes", {}, time_passes()};
  if (kind < 4) return moves();
  const NaiveAtom of = atom();
  const bool leaves = kind < 6;
  return {fmt::format("{} ({})", leaves ? "leave" : "enter", of.text),
          {},
          changes(of, leaves)};
}

NaiveAtom AtomMaker::moves() {
  std::vector<std::string> free;
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    if (network_.state_automaton[v]) free.push_back(tree_.variables[v].name);
  }
  if (!free.empty() && percent(40)) {
    const std::string name = one_of(free);
    return {name + ".moves", {}, variable_moves(name)};
  }
  const std::string reference = spelled(any_node());
  return {reference + ".moves", {}, node_moves(reference)};
}

FormulaId AtomMaker::state_formula(FormulaPool& pool, int size,
                                   std::uint32_t first) {
  if (size <= 1) return pool.atom(first + number(3));
  if (random_.percent(30)) {
    return pool.unary(FormulaKind::Not, state_formula(pool, size - 1, first));
  }
  const FormulaKind kind = one_of(std::array<FormulaKind, 4>{
      FormulaKind::And, FormulaKind::Or, FormulaKind::Implies,
      FormulaKind::Equivalent});
  const FormulaId left = state_formula(pool, size / 2, first);
  return pool.binary(kind, left,
                     state_formula(pool, size - 1 - size / 2, first));
}

FormulaId AtomMaker::temporal_formula(FormulaPool& pool, int most_temporal) {
  while (true) {
    std::mt19937 stream(static_cast<unsigned>(random_.next()));
    const FormulaId made =
        random_formula(pool, stream, 3 + random_.below(5), 3);
    const int temporal = temporal_count(pool, made);
    if (temporal > 0 && temporal <= most_temporal) return made;
  }
}

FormulaId AtomMaker::branching_formula(FormulaPool& pool) {
  while (true) {
    std::mt19937 stream(static_cast<unsigned>(random_.next()));
    const FormulaId made = random_ctl(pool, stream, 2 + random_.below(6), 3);
    if (pool.is_branching(made)) return made;
  }
}

std::string AtomMaker::spelled(NodeId node) {
  const std::array<std::string, 4> spellings = {
      tree_.node(node).name, unique_name(tree_, node),
      fmt::format("btn{}", index(node)),
      fmt::format("{}@{}", tree_.node(node).name, tree_.node(node).span.line)};
  const std::string chosen = one_of(spellings);
  return node_called(tree_, chosen) ? chosen : spellings[1];
}

NodeId AtomMaker::any_node() {
  return NodeId{number(static_cast<int>(tree_.nodes.size()))};
}

NaiveAtom AtomMaker::node_atom() {
  const NodeId node = any_node();
  const bool is_root = tree_.node(node).is_root();
  const std::string reference = is_root ? "root" : spelled(node);
  const std::string word =
      is_root
          ? one_of(std::array<std::string, 6>{"ticked", "success", "failure",
                                              "running", "active", "ended"})
          : one_of(std::array<std::string, 7>{"ticked", "success", "failure",
                                              "running", "halted", "done",
                                              "active"});
  return {reference + "." + word, event(reference, word), {}};
}

NaiveAtom AtomMaker::local() {
  const NodeId node = any_node();
  const std::string reference = spelled(node);
  const auto& locals = automaton_of(network_, node).locals;
  if (locals.empty() || random_.percent(40)) {
    const int word = random_.below(static_cast<int>(kStatusNames.size()));
    const std::string relation = random_.percent(70) ? "==" : "!=";
    return {fmt::format("{}.status {} {}", reference, relation,
                        kStatusNames[static_cast<std::size_t>(word)]),
            of_local(reference, "status",
                     relation == "==" ? kRelations[0] : kRelations[1], word),
            {}};
  }
  const Variable& variable = network_.variable(one_of(locals));
  const std::string_view relation = one_of(kRelations);
  const int value =
      variable.min + random_.below(variable.max - variable.min + 1);
  return {fmt::format("{}.{} {} {}", reference, variable.name, relation, value),
          of_local(reference, variable.name, relation, value),
          {}};
}

NaiveAtom AtomMaker::variable() {
  const StateVariable& variable = one_of(tree_.variables);
  const int value =
      variable.min + random_.below(variable.max - variable.min + 1);
  const std::string name = variable.value_name(value);
  if (variable.is_enumeration()) {
    const std::string_view relation = kRelations[number(2)];
    return {fmt::format("{} {} {}", variable.name, relation, name),
            of_variable(variable.name, relation, name),
            {}};
  }
  if (random_.percent(30)) {
    return {fmt::format("{} in {}..{}", variable.name, name, variable.max),
            of_variable(variable.name, ">=", name),
            {}};
  }
  const std::string_view relation = one_of(kRelations);
  return {fmt::format("{} {} {}", variable.name, relation, name),
          of_variable(variable.name, relation, name),
          {}};
}

NaiveAtom AtomMaker::process() {
  std::vector<std::vector<std::string>> words;
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    const StateVariable& variable = tree_.variables[v];
    if (variable.is_enumeration()) {
      words.push_back(variable.states);
    } else if (const auto mover = network_.state_automaton[v]) {
      words.push_back(network_.automaton(*mover).location_names());
    }
  }
  for (const NodeId node : post_order(tree_)) {
    words.push_back(automaton_of(network_, node).location_names());
  }
  const std::size_t chosen = number(static_cast<int>(words.size()));
  const std::string word = one_of(words[chosen]);
  return {fmt::format("{}/{}/state {}", tree_.node(tree_.roots.at(0)).name,
                      chosen + 1, word),
          of_process(chosen + 1, word),
          {}};
}

}  // namespace btcheck::reference

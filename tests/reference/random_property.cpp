// SPDX-License-Identifier: MIT
//
// Random properties of a tree: their text, and what it means.
//
// Text and meaning are made side by side: the text goes through the reader and
// the binder, the meaning looks at the tables of the network by itself. Names
// are spelled in every way there is. Formulas are printed in full and so say
// little about precedence, which has tests of its own.
#include "reference/random_property.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

#include "reference/random_ltl.hpp"

namespace btcheck::reference {
namespace {

using Meaning = std::function<std::optional<StateTest>(const BehaviorTree&,
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
  const auto found = std::ranges::find(automaton.locations, word);
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
Meaning event(const std::string& reference, const std::string& word) {
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

Meaning of_local(const std::string& reference, const std::string& name,
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

Meaning of_variable(const std::string& name, std::string_view relation,
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
Meaning of_process(std::size_t number, const std::string& word) {
  return [=](const BehaviorTree& tree,
             const Network& network) -> std::optional<StateTest> {
    std::size_t left = number;
    for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
      const StateVariable& variable = tree.variables[v];
      if (!variable.is_enumeration() || --left > 0) continue;
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

Meaning of_keyword(const std::string& word) {
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

class Maker {
 public:
  Maker(const BehaviorTree& tree, const Network& network, SplitMix64& random)
      : tree_(tree), network_(network), random_(random) {}

  NaiveAtom atom() {
    const int kind = random_.below(100);
    if (kind < 45) return node_event();
    if (kind < 58) return local();
    if (kind < 78 && !tree_.variables.empty()) return variable();
    if (kind < 88) return process();
    const std::string word =
        one_of(std::array<std::string, 3>{"dead", "stuck", "tick"});
    return {word, of_keyword(word)};
  }

  FormulaId state_formula(FormulaPool& pool, int size) {
    if (size <= 1) return pool.atom(number(3));
    if (random_.percent(30)) {
      return pool.unary(FormulaKind::Not, state_formula(pool, size - 1));
    }
    const FormulaKind kind = one_of(std::array<FormulaKind, 4>{
        FormulaKind::And, FormulaKind::Or, FormulaKind::Implies,
        FormulaKind::Equivalent});
    const FormulaId left = state_formula(pool, size / 2);
    return pool.binary(kind, left, state_formula(pool, size - 1 - size / 2));
  }

  FormulaId temporal_formula(FormulaPool& pool, int most_temporal) {
    while (true) {
      std::mt19937 stream(static_cast<unsigned>(random_.next()));
      const FormulaId made =
          random_formula(pool, stream, 3 + random_.below(5), 3);
      int temporal = 0;
      for (const FormulaId part : pool.nodes(made)) {
        temporal += pool[part].kind >= FormulaKind::Next ? 1 : 0;
      }
      if (temporal > 0 && temporal <= most_temporal) return made;
    }
  }

  std::uint32_t number(int bound) {
    return static_cast<std::uint32_t>(random_.below(bound));
  }

 private:
  template <class List>
  typename List::value_type one_of(const List& list) {
    return list[number(static_cast<int>(list.size()))];
  }

  std::string spelled(NodeId node) {
    const std::array<std::string, 4> spellings = {
        tree_.node(node).name, unique_name(tree_, node),
        fmt::format("btn{}", index(node)),
        fmt::format("{}@{}", tree_.node(node).name,
                    tree_.node(node).span.line)};
    const std::string chosen = one_of(spellings);
    return node_called(tree_, chosen) ? chosen : spellings[1];
  }

  NodeId any_node() {
    return NodeId{number(static_cast<int>(tree_.nodes.size()))};
  }

  NaiveAtom node_event() {
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
    return {reference + "." + word, event(reference, word)};
  }

  NaiveAtom local() {
    const NodeId node = any_node();
    const std::string reference = spelled(node);
    const auto& locals = automaton_of(network_, node).locals;
    if (locals.empty() || random_.percent(40)) {
      const int word = random_.below(static_cast<int>(kStatusNames.size()));
      const std::string relation = random_.percent(70) ? "==" : "!=";
      return {fmt::format("{}.status {} {}", reference, relation,
                          kStatusNames[static_cast<std::size_t>(word)]),
              of_local(reference, "status",
                       relation == "==" ? kRelations[0] : kRelations[1], word)};
    }
    const Variable& variable = network_.variable(one_of(locals));
    const std::string_view relation = one_of(kRelations);
    const int value =
        variable.min + random_.below(variable.max - variable.min + 1);
    return {
        fmt::format("{}.{} {} {}", reference, variable.name, relation, value),
        of_local(reference, variable.name, relation, value)};
  }

  NaiveAtom variable() {
    const StateVariable& variable = one_of(tree_.variables);
    const int value =
        variable.min + random_.below(variable.max - variable.min + 1);
    const std::string name = variable.value_name(value);
    if (variable.is_enumeration()) {
      const std::string_view relation = kRelations[number(2)];
      return {fmt::format("{} {} {}", variable.name, relation, name),
              of_variable(variable.name, relation, name)};
    }
    if (random_.percent(30)) {
      return {fmt::format("{} in {}..{}", variable.name, name, variable.max),
              of_variable(variable.name, ">=", name)};
    }
    const std::string_view relation = one_of(kRelations);
    return {fmt::format("{} {} {}", variable.name, relation, name),
            of_variable(variable.name, relation, name)};
  }

  NaiveAtom process() {
    std::vector<std::vector<std::string>> words;
    for (const StateVariable& variable : tree_.variables) {
      if (variable.is_enumeration()) words.push_back(variable.states);
    }
    for (const NodeId node : post_order(tree_)) {
      words.push_back(automaton_of(network_, node).locations);
    }
    const std::size_t chosen = number(static_cast<int>(words.size()));
    const std::string word = one_of(words[chosen]);
    return {fmt::format("{}/{}/state {}", tree_.node(tree_.roots.at(0)).name,
                        chosen + 1, word),
            of_process(chosen + 1, word)};
  }

  const BehaviorTree& tree_;
  const Network& network_;
  SplitMix64& random_;
};

std::string text_of(const RandomProperty& property, FormulaId formula) {
  return "(" + property.pool.text(formula, [&](std::uint32_t atom) {
    return "(" + property.atoms[atom].text + ")";
  }) + ")";
}

// never, always, possible, deadlockfree.
void make_state_property(RandomProperty& made, Maker& maker) {
  made.formula =
      maker.state_formula(made.pool, 1 + static_cast<int>(maker.number(4)));
  const std::string text = text_of(made, made.formula);
  const std::uint32_t kind = maker.number(10);
  if (kind < 4) {
    made.form = PropertyForm::Never;
    made.body = (kind < 2 ? "never " : "absent ") + text;
  } else if (kind < 7) {
    made.form = PropertyForm::Invariant;
    made.body = "always " + text;
  } else if (kind < 9) {
    made.form = PropertyForm::Possible;
    made.body = "possible " + text;
  } else {
    made.form = PropertyForm::DeadlockFree;
    made.body = "deadlockfree";
  }
}

// A formula, or a form that stands for one.
void make_ltl_property(RandomProperty& made, Maker& maker, int most_temporal) {
  made.form = PropertyForm::Ltl;
  FormulaPool& pool = made.pool;
  if (maker.number(10) < 6) {
    made.formula = maker.temporal_formula(pool, most_temporal);
    made.body = "ltl " + text_of(made, made.formula);
    return;
  }
  const FormulaId left = maker.state_formula(pool, 2);
  const FormulaId right = maker.state_formula(pool, 2);
  const FormulaId later = pool.unary(FormulaKind::Eventually, right);
  if (most_temporal < 2 || maker.number(5) == 0) {
    made.formula = later;
    made.body = "eventually " + text_of(made, right);
  } else if (maker.number(4) == 0) {
    made.formula = pool.unary(FormulaKind::Always, later);
    made.body = "infinitelyOften " + text_of(made, right);
  } else {
    made.formula = pool.unary(FormulaKind::Always,
                              pool.binary(FormulaKind::Implies, left, later));
    made.body = text_of(made, left) + " leadsto " + text_of(made, right);
  }
}

void make_response(RandomProperty& made, Maker& maker) {
  made.form = PropertyForm::Timed;
  made.formula = maker.state_formula(made.pool, 1);
  made.answer = maker.state_formula(made.pool, 2);
  made.from = static_cast<int>(maker.number(3));
  made.to = made.from + static_cast<int>(maker.number(3));
  made.body =
      fmt::format("{} leadsto {} within [{},{}]", text_of(made, made.formula),
                  text_of(made, made.answer), made.from, made.to);
}

}  // namespace

RandomProperty random_property(const BehaviorTree& tree, const Network& network,
                               SplitMix64& random,
                               const PropertyWeights& weights) {
  Maker maker(tree, network, random);
  RandomProperty made;
  for (int i = 0; i < 3; ++i) made.atoms.push_back(maker.atom());
  const int kind = random.below(100);
  if (kind < 35 && weights.most_temporal > 0) {
    make_ltl_property(made, maker, weights.most_temporal);
  } else if (kind < 55 && weights.response) {
    make_response(made, maker);
  } else {
    make_state_property(made, maker);
  }
  return made;
}

}  // namespace btcheck::reference

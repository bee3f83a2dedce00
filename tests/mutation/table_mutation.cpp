// SPDX-License-Identifier: MIT
//
// Every edge of a table is taken in turn, and everything about it that could
// be written wrongly is written wrongly, one thing at a time: where it leads,
// when it may be taken, what it assigns, how long it takes. The mistakes of
// one table are few enough to be listed, so none is left to chance.
#include "mutation/table_mutation.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace btcheck::mutation {
namespace {

constexpr std::array<std::string_view, kOperatorCount> kOperatorNames = {
    "other target",  "targets swapped", "no edge",     "guard negated",
    "no guard",      "part of a guard", "guard value", "guard's child",
    "no assignment", "other value",     "other child", "interval"};

// An expression with one of its terms replaced by another that takes as many
// values.
Expression with_term(const Expression& of, std::size_t place, Term by) {
  std::vector<Expression> stack;
  for (std::size_t i = 0; i < of.terms().size(); ++i) {
    const Term term = i == place ? by : of.terms()[i];
    if (arity(term.operation) == 0) {
      stack.push_back(term.operation == Operation::Constant
                          ? Expression::constant(term.operand)
                          : Expression::variable(term.operand));
      continue;
    }
    Expression last = std::move(stack.back());
    stack.pop_back();
    if (arity(term.operation) == 1) {
      stack.push_back(Expression::unary(term.operation, std::move(last)));
    } else {
      stack.back() = Expression::binary(term.operation, std::move(stack.back()),
                                        std::move(last));
    }
  }
  return std::move(stack.back());
}

Expression negated(const Expression& of) {
  return Expression::unary(Operation::Not, of);
}

class Mutator {
 public:
  Mutator(const BehaviorTree& tree, const Network& network,
          AutomatonId automaton);

  std::vector<Mutation> all();

 private:
  void mutate(std::size_t place);
  void targets(std::size_t place);
  void swaps(std::size_t place);
  void guards(std::size_t place);
  void guard_values(std::size_t place);
  void updates(std::size_t place);
  void update_values(std::size_t place, std::size_t which);
  void other_children(std::size_t place);
  void intervals(std::size_t place);

  // Adds the mutation that replaces one edge.
  void add(Operator which, std::size_t place, Edge edge, std::string text);
  bool is_of_child(VariableId variable, std::size_t child) const;
  VariableId moved(VariableId variable, std::size_t from, std::size_t to) const;
  bool names_child(const Expression& of, std::size_t child) const;
  std::string in_roles(std::string text) const;
  std::string edge_text(std::size_t place) const;
  std::string guard_text(const Expression& guard) const;
  std::string update_text(const Assignment& update) const;
  std::string location(LocationId id) const {
    return in_roles(automaton_.locations[btcheck::index(id)].name);
  }

  const Network& network_;
  const Automaton& automaton_;
  std::vector<NodeId> children_;
  // Names of this tree and what they are called in every tree.
  std::vector<std::pair<std::string, std::string>> roles_;
  std::vector<std::string> edge_texts_;
  std::vector<Mutation> found_;
};

Mutator::Mutator(const BehaviorTree& tree, const Network& network,
                 AutomatonId automaton)
    : network_(network), automaton_(network.automaton(automaton)) {
  if (automaton_.kind != AutomatonKind::StateVariable) {
    roles_.emplace_back(unique_name(tree, automaton_.node), "self");
    const Node& node = tree.node(automaton_.node);
    children_ = node.children;
    if (!node.is_root()) {
      roles_.emplace_back(unique_name(tree, node.parent), "parent");
    }
  }
  for (std::size_t i = 0; i < children_.size(); ++i) {
    roles_.emplace_back(unique_name(tree, children_[i]),
                        "child " + std::to_string(i + 1));
  }
  std::set<std::string> used;
  for (std::size_t i = 0; i < automaton_.edges.size(); ++i) {
    std::string text = edge_text(i);
    while (!used.insert(text).second) text += " (again)";
    edge_texts_.push_back(std::move(text));
  }
}

std::vector<Mutation> Mutator::all() {
  for (std::size_t i = 0; i < automaton_.edges.size(); ++i) mutate(i);
  return std::move(found_);
}

void Mutator::mutate(std::size_t place) {
  targets(place);
  swaps(place);
  guards(place);
  guard_values(place);
  updates(place);
  other_children(place);
  intervals(place);
}

void Mutator::targets(std::size_t place) {
  const Edge& edge = automaton_.edges[place];
  for (std::uint32_t to = 0; to < automaton_.locations.size(); ++to) {
    if (LocationId{to} == edge.target) continue;
    Edge wrong = edge;
    wrong.target = LocationId{to};
    add(Operator::OtherTarget, place, wrong,
        "leads to " + location(wrong.target));
  }
}

void Mutator::swaps(std::size_t place) {
  const Edge& edge = automaton_.edges[place];
  for (std::size_t i = place + 1; i < automaton_.edges.size(); ++i) {
    const Edge& other = automaton_.edges[i];
    if (other.source != edge.source || other.target == edge.target) continue;
    Edge one = edge;
    Edge two = other;
    std::swap(one.target, two.target);
    found_.push_back(
        {Operator::SwapTargets,
         edge_texts_[place] + ": targets swapped with " + edge_texts_[i],
         {{place, one}, {i, two}}});
  }
}

void Mutator::guards(std::size_t place) {
  const Edge& edge = automaton_.edges[place];
  Edge wrong = edge;
  wrong.guard = Expression::constant(0);
  add(Operator::DropEdge, place, wrong, "is missing");
  if (edge.guard.is_true()) return;
  wrong.guard = negated(edge.guard);
  add(Operator::NegateGuard, place, wrong, "guard negated");
  wrong.guard = {};
  add(Operator::DropGuard, place, wrong, "without its guard");
  const std::vector<Expression> parts = edge.guard.conjuncts();
  for (std::size_t left_out = 0; left_out < parts.size(); ++left_out) {
    if (parts.size() == 1) break;
    wrong.guard = {};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i != left_out) wrong.guard = both(wrong.guard, parts[i]);
    }
    add(Operator::DropConjunct, place, wrong,
        "does not ask for " + guard_text(parts[left_out]));
  }
}

void Mutator::guard_values(std::size_t place) {
  const Edge& edge = automaton_.edges[place];
  const auto terms = edge.guard.terms();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].operation != Operation::Constant) continue;
    for (int by : {-1, 1}) {
      const int value = terms[i].operand + by;
      if (i > 0 && terms[i - 1].operation == Operation::Variable) {
        const Variable& compared = network_.variable(
            VariableId{static_cast<std::uint32_t>(terms[i - 1].operand)});
        if (value < compared.min || value > compared.max) continue;
      }
      Edge wrong = edge;
      wrong.guard = with_term(edge.guard, i, {Operation::Constant, value});
      add(Operator::GuardValue, place, wrong,
          "when " + guard_text(wrong.guard));
    }
  }
}

void Mutator::updates(std::size_t place) {
  const Edge& edge = automaton_.edges[place];
  for (std::size_t i = 0; i < edge.updates.size(); ++i) {
    Edge wrong = edge;
    wrong.updates.erase(wrong.updates.begin() + static_cast<std::ptrdiff_t>(i));
    add(Operator::DropUpdate, place, wrong,
        "does not do " + update_text(edge.updates[i]));
    update_values(place, i);
  }
}

// A computed value becomes one end of the domain, a constant each other value.
void Mutator::update_values(std::size_t place, std::size_t which) {
  const Edge& edge = automaton_.edges[place];
  const Assignment& update = edge.updates[which];
  const Variable& variable = network_.variable(update.variable);
  for (int value = variable.min; value <= variable.max; ++value) {
    if (update.value == Expression::constant(value)) continue;
    Edge wrong = edge;
    wrong.updates[which].value = Expression::constant(value);
    add(Operator::UpdateValue, place, wrong,
        "does " + update_text(wrong.updates[which]) + " instead of " +
            update_text(update));
  }
}

bool Mutator::is_of_child(VariableId variable, std::size_t child) const {
  const std::uint32_t node = btcheck::index(children_[child]);
  return network_.node_caller[node] == variable ||
         network_.node_status[node] == variable;
}

// The same field of another child.
VariableId Mutator::moved(VariableId variable, std::size_t from,
                          std::size_t to) const {
  if (!is_of_child(variable, from)) return variable;
  const std::uint32_t target = btcheck::index(children_[to]);
  return network_.node_caller[btcheck::index(children_[from])] == variable
             ? *network_.node_caller[target]
             : network_.node_status[target];
}

bool Mutator::names_child(const Expression& of, std::size_t child) const {
  return std::any_of(
      of.terms().begin(), of.terms().end(), [&](const Term& term) {
        return term.operation == Operation::Variable &&
               is_of_child(VariableId{static_cast<std::uint32_t>(term.operand)},
                           child);
      });
}

void Mutator::other_children(std::size_t place) {
  const Edge& edge = automaton_.edges[place];
  for (std::size_t from = 0; from < children_.size(); ++from) {
    const bool updates_it =
        std::any_of(edge.updates.begin(), edge.updates.end(),
                    [&](const Assignment& update) {
                      return is_of_child(update.variable, from);
                    });
    for (std::size_t to = 0; to < children_.size(); ++to) {
      if (to == from) continue;
      const std::string text = "child " + std::to_string(to + 1) +
                               " instead of child " + std::to_string(from + 1);
      if (names_child(edge.guard, from)) {
        Edge wrong = edge;
        wrong.guard = edge.guard.replaced([&](const Term& term) {
          return read(moved(
              VariableId{static_cast<std::uint32_t>(term.operand)}, from, to));
        });
        add(Operator::GuardChild, place, wrong, "asks " + text);
      }
      if (!updates_it) continue;
      Edge wrong = edge;
      for (Assignment& update : wrong.updates) {
        update.variable = moved(update.variable, from, to);
      }
      add(Operator::UpdateChild, place, wrong, "calls " + text);
    }
  }
}

// An edge with a guard takes no time (model/automaton.hpp), so all that can go
// wrong with its interval is that it may wait. A timer's end is never 0.
void Mutator::intervals(std::size_t place) {
  const Edge& edge = automaton_.edges[place];
  const Interval when = edge.when;
  const int least_upper = automaton_.kind == AutomatonKind::Timer ? 1 : 0;
  std::vector<Interval> wrong_ones;
  if (when.is_urgent()) wrong_ones.push_back(kAnyTime);
  if (edge.guard.is_true()) {
    wrong_ones.push_back({when.lower - 1, when.upper});
    wrong_ones.push_back({when.lower + 1, when.upper});
    if (when.upper != kUnbounded) {
      wrong_ones.push_back({when.lower, when.upper - 1});
      wrong_ones.push_back({when.lower, when.upper + 1});
      wrong_ones.push_back({when.lower - 1, when.upper - 1});
      wrong_ones.push_back({when.lower + 1, when.upper + 1});
    }
  }
  for (const Interval& interval : wrong_ones) {
    if (interval.lower < 0 || interval.lower > interval.upper ||
        interval.upper < least_upper) {
      continue;
    }
    Edge wrong = edge;
    wrong.when = interval;
    add(Operator::Interval, place, wrong,
        "takes [" + std::to_string(interval.lower) + "," +
            (interval.upper == kUnbounded
                 ? std::string("...[")
                 : std::to_string(interval.upper) + "]"));
  }
}

void Mutator::add(Operator which, std::size_t place, Edge edge,
                  std::string text) {
  found_.push_back(
      {which, edge_texts_[place] + ": " + text, {{place, std::move(edge)}}});
}

std::string Mutator::in_roles(std::string text) const {
  for (const auto& [name, role] : roles_) {
    for (std::size_t at = text.find(name); at != std::string::npos;
         at = text.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if (end < text.size() && std::isdigit(text[end]) != 0) continue;
      text.replace(at, name.size(), role);
    }
  }
  return text;
}

std::string Mutator::guard_text(const Expression& guard) const {
  return in_roles(expression_text(network_, guard));
}

std::string Mutator::update_text(const Assignment& update) const {
  const auto terms = update.value.terms();
  const bool is_constant =
      terms.size() == 1 && terms[0].operation == Operation::Constant;
  return in_roles(qualified_name(network_, update.variable)) + " := " +
         (is_constant ? in_roles(network_.variable(update.variable)
                                     .value_name(terms[0].operand))
                      : guard_text(update.value));
}

std::string Mutator::edge_text(std::size_t place) const {
  const Edge& edge = automaton_.edges[place];
  std::string text = location(edge.source) + " -> " + location(edge.target);
  if (!edge.guard.is_true()) text += " when " + guard_text(edge.guard);
  for (std::size_t i = 0; i < edge.updates.size(); ++i) {
    text += (i == 0 ? " do " : ", ") + update_text(edge.updates[i]);
  }
  return text;
}

}  // namespace

std::string_view operator_name(Operator which) {
  return kOperatorNames[static_cast<std::size_t>(which)];
}

std::vector<Mutation> mutations_of(const BehaviorTree& tree,
                                   const Network& network,
                                   AutomatonId automaton) {
  return Mutator(tree, network, automaton).all();
}

}  // namespace btcheck::mutation

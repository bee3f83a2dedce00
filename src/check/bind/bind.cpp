// SPDX-License-Identifier: MIT
//
// Names are matched exactly first, then without regard to case, with a warning:
// the paper's listings mix cases. How a node is named stands in node_names.hpp.
// Codes:
//
//   BT1101  no node, variable or symbol of this name
//   BT1102  the name fits several nodes
//   BT1103  no process of this number, or another component's name
//   BT1104  the process has no such location, or the node no such variable
//   BT1105  the sides of a comparison do not fit
//   BT1106  always true or always false (warning)
//   BT1107  another case than declared (warning)
//   BT1111  nothing is known of an argument
//   BT1112  false while a node has no arguments (warning; bound_property.cpp)
//   BT1113  ticks of several trees at once
#include "check/bind/bind.hpp"
#include "check/bind/name_help.hpp"
#include "model/automata/past_memory.hpp"
#include "model/automata/tick_memory.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace btcheck {
namespace {

Expression joined(Operation operation, Expression left, Expression right) {
  return left.is_true()
             ? right
             : Expression::binary(operation, std::move(left), std::move(right));
}

Expression negation(Expression of) {
  return Expression::unary(Operation::Not, std::move(of));
}

constexpr std::pair<std::string_view, LocationRole> kEventRoles[] = {
    {"ticked", LocationRole::Tick},     {"success", LocationRole::Success},
    {"failure", LocationRole::Failure}, {"running", LocationRole::Running},
    {"skipped", LocationRole::Skipped}, {"halted", LocationRole::Halted},
    {"done", LocationRole::Done}};

// Inner for other words: no node is ever there.
LocationRole role_of_event(std::string_view word) {
  for (auto [event, role] : kEventRoles) {
    if (event == word) return role;
  }
  return LocationRole::Inner;
}

// Locations that some node types have no use for.
constexpr std::string_view kFrameStates[] = {"success", "failure", "running",
                                             "halted", "halt"};

Expression has_ended(const Network& network, NodeId root) {
  Expression ended;
  const Automaton& automaton = network.automaton(root);
  for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
    if (!is_end(automaton.locations[i].role)) continue;
    ended = joined(Operation::Or, std::move(ended),
                   equals(automaton.location, static_cast<int>(i)));
  }
  return ended;
}

// Between being called and giving control back, or running.
Expression is_active(const BehaviorTree& tree, const Network& network,
                     NodeId node) {
  if (tree.node(node).is_root()) return negation(has_ended(network, node));
  const VariableId status = network.node_status[index(node)];
  Expression runs = equals(status, NodeStatus::Running);
  if (is_engine(network.profile)) {
    runs = joined(Operation::Or, std::move(runs),
                  equals(status, NodeStatus::SkippedRunning));
  }
  return Expression::binary(Operation::Or,
                            equals(*network.node_caller[index(node)], 1),
                            std::move(runs));
}

template <class Of>
Expression of_roots(const BehaviorTree& tree, Operation joining, Of of) {
  Expression together;
  for (NodeId root : tree.roots) {
    together = joined(joining, std::move(together), of(root));
  }
  return together;
}

Expression all_roots_ended(const BehaviorTree& tree, const Network& network) {
  return of_roots(tree, Operation::And,
                  [&](NodeId root) { return has_ended(network, root); });
}

}  // namespace

std::nullopt_t Binder::refuse(std::string_view code, SourceSpan span,
                              std::string message, std::string label,
                              std::string help) {
  findings_.push_back(source_.diagnostic(Severity::Error, code, span,
                                         std::move(message), std::move(label),
                                         std::move(help)));
  return std::nullopt;
}

void Binder::warn(std::string_view code, SourceSpan span, std::string message,
                  std::string label) {
  findings_.push_back(source_.diagnostic(Severity::Warning, code, span,
                                         std::move(message), std::move(label)));
}

void Binder::warn_never(const Atom& atom, std::string label) {
  warn("BT1106", atom.span, fmt::format("`{}` is never true", atom.text),
       std::move(label));
}

void Binder::warn_of_case(SourceSpan span, std::string_view written,
                          std::string_view declared, std::string_view name) {
  warn("BT1107", span,
       fmt::format("`{}` differs in case from the {} `{}`", written, declared,
                   name),
       "matched without regard to case");
}

std::optional<NodeId> Binder::find_node(std::string_view reference,
                                        SourceSpan span) {
  if (equal_ignoring_case(reference, "root")) return tree_.roots[0];
  const std::vector<NodeId> found = names_.called(reference);
  if (found.size() == 1) {
    if (names_.differs_in_case(reference)) {
      warn_of_case(span, reference, "node's name", tree_.node(found[0]).name);
    }
    return found[0];
  }
  if (found.empty()) {
    return refuse("BT1101", span, fmt::format("unknown node `{}`", reference),
                  "no node has this name", node_help(tree_, names_, reference));
  }
  return refuse("BT1102", span,
                fmt::format("`{}` names {} nodes", reference, found.size()),
                "which one is meant?",
                "write one of " + names_.references_to(found));
}

std::optional<std::uint32_t> Binder::process(const Atom& atom) {
  const bool is_known = std::ranges::any_of(tree_.roots, [&](NodeId root) {
    return equal_ignoring_case(atom.component, tree_.node(root).name);
  });
  if (!is_known) {
    return refuse("BT1103", atom.span,
                  fmt::format("unknown component `{}`", atom.component), "",
                  fmt::format("the tree is called `{}`",
                              tree_.node(tree_.roots[0]).name));
  }
  const std::int32_t number = *atom.process;
  const std::size_t count = network_.automata.size();
  if (number >= 1 && static_cast<std::size_t>(number) <= count) {
    return static_cast<std::uint32_t>(number - 1);
  }
  return refuse(
      "BT1103", atom.span,
      fmt::format("`{}` has no process {}", atom.component, number), "",
      fmt::format("there are {}: state variables first, then the nodes in "
                  "post-order",
                  count));
}

Expression node_in_location(const Network& network, NodeId node,
                            LocationRole role) {
  const Automaton& automaton = network.automaton(node);
  if (role == LocationRole::Inner) return Expression::constant(0);
  auto found = automaton.find_location(role);
  return found ? equals(automaton.location, static_cast<int>(index(*found)))
               : Expression::constant(0);
}

// The whole tree; of several trees all must succeed, one suffices to fail.
Binder::Bound Binder::root_event(const Atom& atom) {
  if (atom.word == "ended") return all_roots_ended(tree_, network_);
  if (atom.word == "active") return negation(all_roots_ended(tree_, network_));
  if (atom.word == "halted" || atom.word == "done") {
    return refuse("BT1104", atom.word_span,
                  fmt::format("the root is never in `{}`", atom.word), "",
                  "`root.ended` says that it has succeeded or failed");
  }
  return of_roots(
      tree_, atom.word == "success" ? Operation::And : Operation::Or,
      [&](NodeId root) {
        return node_in_location(network_, root, role_of_event(atom.word));
      });
}

Binder::Bound Binder::node_event(const Atom& atom) {
  NodeId node{};
  if (atom.process) {
    auto number = process(atom);
    if (!number) return std::nullopt;
    const Automaton& automaton = network_.automata[*number];
    if (automaton.kind != AutomatonKind::Node) {
      const bool is_timer = automaton.kind == AutomatonKind::Timer;
      return refuse(
          "BT1104", atom.word_span,
          fmt::format("process {} is the {} `{}`, not a node", *atom.process,
                      is_timer ? "timer" : "state variable", automaton.name));
    }
    node = automaton.node;
  } else {
    if (equal_ignoring_case(atom.node, "root")) return root_event(atom);
    auto found = find_node(atom.node, atom.node_span);
    if (!found) return std::nullopt;
    node = *found;
  }
  if (atom.word == "active") return is_active(tree_, network_, node);
  if (tree_.node(node).is_root() && atom.word == "ended") {
    return negation(is_active(tree_, network_, node));
  }
  Expression there = node_in_location(network_, node, role_of_event(atom.word));
  if (there == Expression::constant(0)) {
    warn_never(atom, fmt::format("this {} has no such event",
                                 type_name(tree_.node(node).type)));
  }
  return there;
}

Binder::Bound Binder::process_state(const Atom& atom) {
  auto number = process(atom);
  if (!number) return std::nullopt;
  const Automaton& automaton = network_.automata[*number];
  for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
    if (equal_ignoring_case(automaton.locations[i].name, atom.word)) {
      return equals(
          automaton.location,
          network_.variable(automaton.location).min + static_cast<int>(i));
    }
  }
  if (automaton.kind == AutomatonKind::Node &&
      std::ranges::find(kFrameStates, atom.word) != std::end(kFrameStates)) {
    warn_never(atom, fmt::format("process {} is `{}`, which has no such state",
                                 *atom.process, automaton.name));
    return Expression::constant(0);
  }
  return refuse(
      "BT1104", atom.word_span,
      fmt::format("process {} has no state `{}`", *atom.process, atom.word),
      fmt::format("process {} is `{}`", *atom.process, automaton.name),
      did_you_mean(atom.word, automaton.location_names()));
}

bool Binder::has_one_root(SourceSpan span) {
  if (tree_.roots.size() == 1) return true;
  refuse("BT1113", span, "the ticks of several trees do not end together",
         fmt::format("there are {} trees", tree_.roots.size()),
         fmt::format("name the tree that is meant: `{}.answer`",
                     tree_.node(tree_.roots[0]).name));
  return false;
}

// The root has answered, and nobody has forgotten yet what was answered.
Binder::Bound Binder::tick_ends(const Atom& atom) {
  if (!has_one_root(atom.span)) return std::nullopt;
  const auto answer = answer_of(network_, tree_.roots[0]);
  assert(answer && "remember_for has been called");
  return differs(*answer, kNoAnswer);
}

Binder::Bound Binder::expression_of(const Atom& atom) {
  switch (atom.kind) {
    case AtomKind::NodeEvent:
      return node_event(atom);
    case AtomKind::Comparison:
      return comparison(atom);
    case AtomKind::Range:
      return range(atom);
    case AtomKind::ProcessState:
      return process_state(atom);
    default:
      break;
  }
  assert(atom.kind == AtomKind::Keyword);
  if (atom.word == "tick.ends") return tick_ends(atom);
  if (atom.word == "tick") {
    return of_roots(tree_, Operation::Or, [&](NodeId root) {
      return node_in_location(network_, root, LocationRole::Tick);
    });
  }
  return refuse("BT1101", atom.span,
                fmt::format("unknown word `{}`", atom.word), "",
                names_.nearest_help(atom.word));
}

std::string past_key(const PropertyFile& file, std::uint32_t number) {
  return fmt::format("{}:{}", number, file.file);
}

// remember_for has added its bit.
std::optional<StatePredicate> Binder::remembered(
    const PropertyFile& file, std::uint32_t number,
    const std::vector<Proposition>& known) {
  const Atom& atom = file.atoms[number];
  if (atom.kind == AtomKind::Previously && !has_one_root(atom.span)) {
    return std::nullopt;
  }
  for (const FormulaId of : {atom.of, atom.since}) {
    const auto predicate = predicate_of(file.formulas, of, known);
    if (!predicate) {
      return refuse("BT1109", atom.span, "this is too large to be remembered");
    }
    if (predicate->when_dead) {
      return refuse("BT1114", atom.span,
                    "`dead` and `stuck` are not remembered",
                    "nothing comes after them");
    }
  }
  const auto bit = past_memory(network_, past_key(file, number));
  assert(bit);
  return StatePredicate{equals(*bit, 1), {}};
}

Proposition Binder::proposition(const PropertyFile& file, std::uint32_t number,
                                const std::vector<Proposition>& known) {
  const Atom& atom = file.atoms[number];
  Proposition made;
  if (atom.kind == AtomKind::Moves) {
    made.kind = PropositionKind::Moves;
    made.movers = movers(atom);
  } else if (atom.kind == AtomKind::Passes) {
    made.kind = PropositionKind::Passes;
  } else if (is_step_event(atom.kind)) {
    made.kind = atom.kind == AtomKind::Enter ? PropositionKind::Enter
                                             : PropositionKind::Leave;
    made.of =
        predicate_of(file.formulas, atom.of, known).value_or(StatePredicate{});
  } else {
    made.of =
        (is_past(atom.kind) ? remembered(file, number, known) : bind(atom))
            .value_or(StatePredicate{});
  }
  return made;
}

std::optional<StatePredicate> Binder::bind(const Atom& atom) {
  const bool is_dead = atom.kind == AtomKind::Keyword && atom.word == "dead";
  const bool is_stuck = atom.kind == AtomKind::Keyword && atom.word == "stuck";
  if (is_dead || is_stuck) {
    Expression when_dead = is_dead ? Expression::constant(1)
                                   : negation(all_roots_ended(tree_, network_));
    // A run that a fault ended is not stuck: it is reported as the fault.
    if (is_stuck && network_.fault) {
      when_dead = both(std::move(when_dead), equals(*network_.fault, 0));
    }
    return StatePredicate{Expression::constant(0), std::move(when_dead)};
  }
  auto expression = expression_of(atom);
  if (!expression) return std::nullopt;
  return StatePredicate{both(given_.where, std::move(*expression)), {}};
}

std::vector<AutomatonId> Binder::movers(const Atom& atom) {
  if (atom.process) {
    const auto number = process(atom);
    if (!number) return {};
    return {AutomatonId{*number}};
  }
  std::vector<AutomatonId> found;
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    if (!equal_ignoring_case(tree_.variables[v].name, atom.node)) continue;
    if (const auto automaton = network_.state_automaton[v]) return {*automaton};
    refuse("BT1104", atom.node_span,
           fmt::format("`{}` is a number and never moves by itself", atom.node),
           "", "name the value: `enter (fls == 3)`");
    return {};
  }
  const auto node = find_node(atom.node, atom.node_span);
  if (!node) return {};
  for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
    const Automaton& automaton = network_.automata[a];
    const bool is_its_own = automaton.kind != AutomatonKind::StateVariable &&
                            automaton.node == *node;
    if (is_its_own) found.push_back(AutomatonId{a});
  }
  return found;
}

}  // namespace btcheck

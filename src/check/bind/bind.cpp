// SPDX-License-Identifier: MIT
//
// Names of variables and values are matched exactly first and without regard
// to case after that, with a warning, as the paper's listings mix cases; how a
// node is named stands in node_names.hpp. A name that fits two nodes is refused
// with the list of what could have been meant. Codes:
//
//   BT1101  no node, variable or symbol of this name
//   BT1102  the name fits several nodes
//   BT1103  no process of this number, or another component's name
//   BT1104  the process has no such location, or the node no such variable
//   BT1105  the sides of a comparison do not fit
//   BT1106  always true or always false (warning)
//   BT1107  another case than declared (warning)
#include "check/bind/bind.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace btcheck {
namespace {

Expression joined(Operation operation, Expression left, Expression right) {
  return left.is_true()
             ? right
             : Expression::binary(operation, std::move(left), std::move(right));
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

}  // namespace

Diagnostic Binder::error(std::string_view code, SourceSpan span,
                         std::string message, std::string label,
                         std::string help) const {
  return source_.diagnostic(Severity::Error, code, span, std::move(message),
                            std::move(label), std::move(help));
}

std::optional<NodeId> Binder::find_node(std::string_view reference,
                                        SourceSpan span,
                                        Findings& findings) const {
  const std::vector<NodeId> found = names_.called(reference);
  if (found.size() == 1) {
    if (names_.differs_in_case(reference)) {
      findings.push_back(source_.diagnostic(
          Severity::Warning, "BT1107", span,
          fmt::format("`{}` differs in case from the node's name `{}`",
                      reference, tree_.node(found[0]).name),
          "matched without regard to case"));
    }
    return found[0];
  }
  if (found.empty()) {
    findings.push_back(
        error("BT1101", span, fmt::format("unknown node `{}`", reference),
              "no node has this name", names_.nearest_help(reference)));
    return std::nullopt;
  }
  std::string candidates;
  for (std::size_t i = 0; i < found.size() && i < NodeNames::kMostCandidates;
       ++i) {
    candidates += fmt::format("{}`{}`", i == 0 ? "" : ", ",
                              names_.reference_to(found[i]));
  }
  if (found.size() > NodeNames::kMostCandidates) candidates += ", …";
  findings.push_back(
      error("BT1102", span,
            fmt::format("`{}` names {} nodes", reference, found.size()),
            "which one is meant?", "write one of " + candidates));
  return std::nullopt;
}

std::optional<std::uint32_t> Binder::process(const Atom& atom,
                                             Findings& findings) const {
  bool is_known = false;
  for (NodeId root : tree_.roots) {
    is_known |= equal_ignoring_case(atom.component, tree_.node(root).name);
  }
  if (!is_known) {
    findings.push_back(
        error("BT1103", atom.span,
              fmt::format("unknown component `{}`", atom.component), "",
              fmt::format("the tree is called `{}`",
                          tree_.node(tree_.roots[0]).name)));
    return std::nullopt;
  }
  const std::int32_t number = *atom.process;
  if (number < 1 ||
      static_cast<std::size_t>(number) > network_.automata.size()) {
    findings.push_back(error(
        "BT1103", atom.span,
        fmt::format("`{}` has no process {}", atom.component, number), "",
        fmt::format("there are {}: state variables first, then the nodes in "
                    "post-order",
                    network_.automata.size())));
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(number - 1);
}

Expression Binder::in_location(NodeId node, LocationRole role) const {
  return node_in_location(network_, node, role);
}

Expression node_in_location(const Network& network, NodeId node,
                            LocationRole role) {
  const Automaton& automaton =
      network.automaton(network.node_automaton[index(node)]);
  if (role == LocationRole::Inner) return Expression::constant(0);
  auto found = automaton.find_location(role);
  return found ? equals(automaton.location, static_cast<int>(index(*found)))
               : Expression::constant(0);
}

// Between being called and giving control back, or running.
Expression Binder::is_active(NodeId node) const {
  if (tree_.node(node).is_root()) {
    return Expression::unary(Operation::Not, has_ended(node));
  }
  const VariableId status = network_.node_status[index(node)];
  Expression runs = equals(status, NodeStatus::Running);
  if (is_engine(network_.profile)) {
    runs = joined(Operation::Or, std::move(runs),
                  equals(status, NodeStatus::SkippedRunning));
  }
  return Expression::binary(Operation::Or,
                            equals(*network_.node_caller[index(node)], 1),
                            std::move(runs));
}

Expression Binder::roots_in(LocationRole role, Operation joining) const {
  Expression together;
  for (NodeId root : tree_.roots) {
    together = joined(joining, std::move(together), in_location(root, role));
  }
  return together;
}

Expression Binder::has_ended(NodeId root) const {
  Expression ended;
  const Automaton& automaton =
      network_.automaton(network_.node_automaton[index(root)]);
  for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
    if (!is_end(automaton.locations[i].role)) continue;
    ended = joined(Operation::Or, std::move(ended),
                   equals(automaton.location, static_cast<int>(i)));
  }
  return ended;
}

Expression Binder::all_roots_ended() const {
  Expression together;
  for (NodeId root : tree_.roots) {
    together = joined(Operation::And, std::move(together), has_ended(root));
  }
  return together;
}

// The whole tree; of several trees all must succeed, one suffices to fail.
std::optional<StatePredicate> Binder::root_event(const Atom& atom,
                                                 Findings& findings) const {
  if (atom.word == "ended") return plain(all_roots_ended());
  if (atom.word == "active") {
    return plain(Expression::unary(Operation::Not, all_roots_ended()));
  }
  const LocationRole role = role_of_event(atom.word);
  if (atom.word == "halted" || atom.word == "done") {
    findings.push_back(
        error("BT1104", atom.word_span,
              fmt::format("the root is never in `{}`", atom.word), "",
              "`root.ended` says that it has succeeded or failed"));
    return std::nullopt;
  }
  return plain(
      roots_in(role, atom.word == "success" ? Operation::And : Operation::Or));
}

std::optional<StatePredicate> Binder::node_event(const Atom& atom,
                                                 Findings& findings) const {
  NodeId node{};
  if (atom.process) {
    auto number = process(atom, findings);
    if (!number) return std::nullopt;
    const Automaton& automaton = network_.automata[*number];
    if (automaton.kind != AutomatonKind::Node) {
      const bool is_timer = automaton.kind == AutomatonKind::Timer;
      findings.push_back(error(
          "BT1104", atom.word_span,
          fmt::format("process {} is the {} `{}`, not a node", *atom.process,
                      is_timer ? "timer" : "state variable", automaton.name)));
      return std::nullopt;
    }
    node = automaton.node;
  } else {
    if (equal_ignoring_case(atom.node, "root")) {
      return root_event(atom, findings);
    }
    auto found = find_node(atom.node, atom.node_span, findings);
    if (!found) return std::nullopt;
    node = *found;
  }
  if (atom.word == "active") return plain(is_active(node));
  if (tree_.node(node).is_root() && atom.word == "ended") {
    return plain(Expression::unary(Operation::Not, is_active(node)));
  }
  const LocationRole role = role_of_event(atom.word);
  Expression there = in_location(node, role);
  if (there == Expression::constant(0)) {
    const std::string_view type = type_name(tree_.node(node).type);
    findings.push_back(
        source_.diagnostic(Severity::Warning, "BT1106", atom.span,
                           fmt::format("`{}` is never true", atom.text),
                           fmt::format("this {} has no such event", type)));
  }
  return plain(std::move(there));
}

std::optional<StatePredicate> Binder::process_state(const Atom& atom,
                                                    Findings& findings) const {
  auto number = process(atom, findings);
  if (!number) return std::nullopt;
  const Automaton& automaton = network_.automata[*number];
  for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
    if (equal_ignoring_case(automaton.locations[i].name, atom.word)) {
      return plain(equals(
          automaton.location,
          network_.variable(automaton.location).min + static_cast<int>(i)));
    }
  }
  // A frame location that this node has no use for is simply never reached.
  if (automaton.kind == AutomatonKind::Node &&
      (atom.word == "success" || atom.word == "failure" ||
       atom.word == "running" || atom.word == "halted" ||
       atom.word == "halt")) {
    findings.push_back(source_.diagnostic(
        Severity::Warning, "BT1106", atom.span,
        fmt::format("`{}` is never true", atom.text),
        fmt::format("process {} is `{}`, which has no such state",
                    *atom.process, automaton.name)));
    return plain(Expression::constant(0));
  }
  auto near = closest_match(atom.word, automaton.location_names());
  findings.push_back(error(
      "BT1104", atom.word_span,
      fmt::format("process {} has no state `{}`", *atom.process, atom.word),
      fmt::format("process {} is `{}`", *atom.process, automaton.name),
      near ? fmt::format("did you mean `{}`?", *near) : ""));
  return std::nullopt;
}

std::optional<StatePredicate> Binder::word(const Atom& atom,
                                           Findings& findings) const {
  if (atom.word == "tick") {
    return plain(roots_in(LocationRole::Tick, Operation::Or));
  }
  if (atom.word == "dead") {
    return StatePredicate{Expression::constant(0), Expression::constant(1)};
  }
  if (atom.word == "stuck") {
    Expression unfinished =
        Expression::unary(Operation::Not, all_roots_ended());
    // A run that a fault ended is not stuck: it is reported as the fault.
    if (network_.fault) {
      unfinished = both(std::move(unfinished), equals(*network_.fault, 0));
    }
    return StatePredicate{Expression::constant(0), std::move(unfinished)};
  }
  findings.push_back(error("BT1101", atom.span,
                           fmt::format("unknown word `{}`", atom.word), "",
                           names_.nearest_help(atom.word)));
  return std::nullopt;
}

std::optional<StatePredicate> Binder::bind(const Atom& atom,
                                           Findings& findings) {
  switch (atom.kind) {
    case AtomKind::NodeEvent:
      return node_event(atom, findings);
    case AtomKind::Comparison:
      return comparison(atom, findings);
    case AtomKind::Range:
      return range(atom, findings);
    case AtomKind::ProcessState:
      return process_state(atom, findings);
    case AtomKind::Keyword:
      return word(atom, findings);
    case AtomKind::Enter:
    case AtomKind::Leave:
    case AtomKind::Moves:
    case AtomKind::Passes:
      break;  // these are no predicates on states
  }
  return std::nullopt;
}

std::vector<AutomatonId> Binder::movers(const Atom& atom,
                                        Findings& findings) const {
  if (atom.process) {
    const auto number = process(atom, findings);
    if (!number) return {};
    return {AutomatonId{*number}};
  }
  std::vector<AutomatonId> found;
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    if (!equal_ignoring_case(tree_.variables[v].name, atom.node)) continue;
    const auto automaton = network_.state_automaton[v];
    if (automaton) return {*automaton};
    findings.push_back(error(
        "BT1104", atom.node_span,
        fmt::format("`{}` is a number and never moves by itself", atom.node),
        "", "name the value: `enter (fls == 3)`"));
    return {};
  }
  const bool is_root = equal_ignoring_case(atom.node, "root");
  const auto node = is_root ? std::optional(tree_.roots[0])
                            : find_node(atom.node, atom.node_span, findings);
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

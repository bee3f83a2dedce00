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
#include "check/bind.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace btcheck {
namespace {

Expression variable_is(VariableId variable, std::int64_t value) {
  return Expression::binary(
      Operation::Equal,
      Expression::variable(static_cast<std::int32_t>(index(variable))),
      Expression::constant(static_cast<std::int32_t>(value)));
}

Expression joined(Operation operation, Expression left, Expression right) {
  return left.is_true()
             ? right
             : Expression::binary(operation, std::move(left), std::move(right));
}

constexpr std::pair<std::string_view, std::string_view> kEventLocations[] = {
    {"ticked", "tick_node"}, {"success", "success"}, {"failure", "failure"},
    {"running", "running"},  {"halted", "halted"},   {"done", "done"}};

std::string_view location_of_event(std::string_view word) {
  for (auto [event, location] : kEventLocations) {
    if (event == word) return location;
  }
  return {};
}

Operation operation_of(Relation relation) {
  switch (relation) {
    case Relation::Equal:
      return Operation::Equal;
    case Relation::NotEqual:
      return Operation::NotEqual;
    case Relation::Less:
      return Operation::Less;
    case Relation::LessEqual:
      return Operation::LessEqual;
    case Relation::Greater:
      return Operation::Greater;
    case Relation::GreaterEqual:
      return Operation::GreaterEqual;
  }
  return Operation::Equal;
}

StatePredicate plain(Expression expression) {
  return {std::move(expression), std::nullopt};
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
    const Node& node = tree_.node(found[i]);
    candidates +=
        fmt::format("{}`{}@{}`", i == 0 ? "" : ", ", node.name, node.span.line);
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

Expression Binder::in_location(NodeId node, std::string_view location) const {
  const Automaton& automaton =
      network_.automaton(network_.node_automaton[index(node)]);
  auto found = automaton.find_location(location);
  return found ? variable_is(automaton.location, index(*found))
               : Expression::constant(0);
}

// Between being called and giving control back, or running.
Expression Binder::is_active(NodeId node) const {
  if (tree_.node(node).is_root()) {
    return Expression::unary(
        Operation::Not,
        Expression::binary(Operation::Or, in_location(node, "success"),
                           in_location(node, "failure")));
  }
  return Expression::binary(Operation::Or,
                            variable_is(*network_.node_caller[index(node)], 1),
                            variable_is(network_.node_status[index(node)],
                                        static_cast<int>(NodeStatus::Running)));
}

Expression Binder::roots_in(std::string_view location,
                            Operation joining) const {
  Expression together;
  for (NodeId root : tree_.roots) {
    together =
        joined(joining, std::move(together), in_location(root, location));
  }
  return together;
}

Expression Binder::all_roots_ended() const {
  Expression together;
  for (NodeId root : tree_.roots) {
    together =
        joined(Operation::And, std::move(together),
               Expression::binary(Operation::Or, in_location(root, "success"),
                                  in_location(root, "failure")));
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
  const std::string_view location = location_of_event(atom.word);
  if (atom.word == "halted" || atom.word == "done") {
    findings.push_back(
        error("BT1104", atom.word_span,
              fmt::format("the root is never in `{}`", atom.word), "",
              "`root.ended` says that it has succeeded or failed"));
    return std::nullopt;
  }
  return plain(roots_in(
      location, atom.word == "success" ? Operation::And : Operation::Or));
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
  const std::string_view location = location_of_event(atom.word);
  Expression there = in_location(node, location);
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
    if (equal_ignoring_case(automaton.locations[i], atom.word)) {
      return plain(variable_is(
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
  auto near = closest_match(atom.word, automaton.locations);
  findings.push_back(error(
      "BT1104", atom.word_span,
      fmt::format("process {} has no state `{}`", *atom.process, atom.word),
      fmt::format("process {} is `{}`", *atom.process, automaton.name),
      near ? fmt::format("did you mean `{}`?", *near) : ""));
  return std::nullopt;
}

std::optional<VariableId> Binder::variable_of_node(
    NodeId node, std::string_view name) const {
  if (name == "status" || name == "rstatus") {
    return network_.node_status[index(node)];
  }
  const Automaton& automaton =
      network_.automaton(network_.node_automaton[index(node)]);
  for (VariableId local : automaton.locals) {
    if (equal_ignoring_case(network_.variable(local).name, name)) return local;
  }
  return std::nullopt;
}

// `node.status`, `node.local`.
std::optional<Binder::Side> Binder::side_of_node(const Operand& operand,
                                                 Findings& findings) const {
  std::optional<NodeId> node;
  if (equal_ignoring_case(operand.node, "root")) {
    node = tree_.roots[0];
  } else {
    node = find_node(operand.node, operand.span, findings);
  }
  if (!node) return std::nullopt;
  auto variable = variable_of_node(*node, operand.name);
  if (variable) return Side{variable, {}, {}};
  std::string known = "status";
  const Automaton& automaton =
      network_.automaton(network_.node_automaton[index(*node)]);
  for (VariableId local : automaton.locals) {
    known += ", " + network_.variable(local).name;
  }
  findings.push_back(error(
      "BT1104", operand.span,
      fmt::format("`{}` has no variable `{}`", operand.node, operand.name), "",
      "it has: " + known));
  return std::nullopt;
}

std::optional<VariableId> Binder::state_variable_called(
    const Operand& operand, Findings& findings) const {
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    if (tree_.variables[v].name == operand.name) {
      return network_.state_variable[v];
    }
  }
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    const std::string& name = tree_.variables[v].name;
    if (!equal_ignoring_case(operand.name, name)) continue;
    findings.push_back(source_.diagnostic(
        Severity::Warning, "BT1107", operand.span,
        fmt::format("`{}` differs in case from the declared `{}`", operand.name,
                    name),
        "matched without regard to case"));
    return network_.state_variable[v];
  }
  return std::nullopt;
}

std::optional<Binder::Side> Binder::side(const Atom& atom,
                                         const Operand& operand,
                                         Findings& findings) const {
  if (operand.is_number) return Side{{}, operand.number, {}};
  if (!operand.node.empty()) return side_of_node(operand, findings);
  if (atom.process) {
    auto number = process(atom, findings);
    if (!number) return std::nullopt;
    const Automaton& scope = network_.automata[*number];
    if (scope.kind == AutomatonKind::Node && operand.name != "status") {
      auto local = variable_of_node(scope.node, operand.name);
      if (local) return Side{local, {}, {}};
    }
  }
  auto variable = state_variable_called(operand, findings);
  if (variable) return Side{variable, {}, {}};
  return Side{{}, {}, operand.name};
}

std::optional<Expression> Binder::value_of_symbol(VariableId variable,
                                                  const Operand& operand,
                                                  Findings& findings) const {
  const Variable& of = network_.variable(variable);
  for (std::size_t i = 0; i < of.value_names.size(); ++i) {
    if (!equal_ignoring_case(of.value_names[i], operand.name)) continue;
    if (of.value_names[i] != operand.name) {
      findings.push_back(source_.diagnostic(
          Severity::Warning, "BT1107", operand.span,
          fmt::format("`{}` differs in case from the declared value `{}`",
                      operand.name, of.value_names[i]),
          "matched without regard to case"));
    }
    return Expression::constant(of.min + static_cast<int>(i));
  }
  if (of.value_names.empty()) {
    findings.push_back(error(
        "BT1105", operand.span,
        fmt::format("`{}` is a number, `{}` is none", of.name, operand.name),
        fmt::format("from {} to {}", of.min, of.max)));
    return std::nullopt;
  }
  auto near = closest_match(operand.name, of.value_names);
  std::string values;
  for (const std::string& name : of.value_names) {
    values += (values.empty() ? "" : ", ") + name;
  }
  findings.push_back(error(
      "BT1105", operand.span,
      fmt::format("`{}` has no value `{}`", of.name, operand.name), "",
      near ? fmt::format("did you mean `{}`?", *near) : "it has: " + values));
  return std::nullopt;
}

void Binder::warn_of_range(const Atom& atom, VariableId variable,
                           std::int64_t constant, Findings& findings) const {
  const Variable& of = network_.variable(variable);
  if (constant >= of.min && constant <= of.max) return;
  const bool is_plain =
      atom.relation == Relation::Equal || atom.relation == Relation::NotEqual;
  // `fls > 3` of a variable in 0..3 is how one asks for the range itself.
  if (!is_plain) return;
  findings.push_back(source_.diagnostic(
      Severity::Warning, "BT1106", atom.span,
      fmt::format("`{}` is {} true", atom.text,
                  atom.relation == Relation::Equal ? "never" : "always"),
      fmt::format("`{}` is from {} to {}", of.name, of.min, of.max)));
}

// One side as an expression; a symbol or number is read as a value of the
// variable on the other side.
std::optional<Expression> Binder::value_of(const Atom& atom, const Side& of,
                                           const Side& other,
                                           const Operand& operand,
                                           Findings& findings) const {
  if (of.variable) {
    return Expression::variable(static_cast<std::int32_t>(index(*of.variable)));
  }
  if (!of.constant) return value_of_symbol(*other.variable, operand, findings);
  const Variable& variable = network_.variable(*other.variable);
  if (!variable.value_names.empty()) {
    findings.push_back(
        error("BT1105", operand.span,
              fmt::format("`{}` has no value {}", variable.name, *of.constant),
              "it is an enumeration"));
    return std::nullopt;
  }
  warn_of_range(atom, *other.variable, *of.constant, findings);
  return Expression::constant(static_cast<std::int32_t>(*of.constant));
}

std::optional<StatePredicate> Binder::comparison(const Atom& atom,
                                                 Findings& findings) const {
  auto left = side(atom, atom.left, findings);
  auto right = side(atom, atom.right, findings);
  if (!left || !right) return std::nullopt;
  if (!left->variable && !right->variable) {
    const Operand& unknown = atom.left.is_number ? atom.right : atom.left;
    findings.push_back(error("BT1101", unknown.span,
                             fmt::format("unknown variable `{}`", unknown.name),
                             "no variable has this name",
                             names_.nearest_help(unknown.name)));
    return std::nullopt;
  }
  auto left_value = value_of(atom, *left, *right, atom.left, findings);
  auto right_value = value_of(atom, *right, *left, atom.right, findings);
  if (!left_value || !right_value) return std::nullopt;
  if (left->variable && right->variable &&
      network_.variable(*left->variable).value_names !=
          network_.variable(*right->variable).value_names) {
    findings.push_back(error("BT1105", atom.span,
                             "these two variables cannot be compared",
                             "they have different values"));
    return std::nullopt;
  }
  return plain(Expression::binary(operation_of(atom.relation),
                                  std::move(*left_value),
                                  std::move(*right_value)));
}

std::optional<StatePredicate> Binder::range(const Atom& atom,
                                            Findings& findings) const {
  auto of = side(atom, atom.left, findings);
  if (!of) return std::nullopt;
  if (!of->variable || !network_.variable(*of->variable).value_names.empty()) {
    findings.push_back(
        error("BT1105", atom.left.span,
              fmt::format("`{}` is not a variable that holds a number",
                          atom.left.name),
              "", of->variable ? "" : names_.nearest_help(atom.left.name)));
    return std::nullopt;
  }
  Expression value =
      Expression::variable(static_cast<std::int32_t>(index(*of->variable)));
  return plain(both(Expression::binary(Operation::GreaterEqual, value,
                                       Expression::constant(atom.low)),
                    Expression::binary(Operation::LessEqual, value,
                                       Expression::constant(atom.high))));
}

std::optional<StatePredicate> Binder::word(const Atom& atom,
                                           Findings& findings) const {
  if (atom.word == "tick") {
    return plain(roots_in("tick_node", Operation::Or));
  }
  if (atom.word == "dead") {
    return StatePredicate{Expression::constant(0), Expression::constant(1)};
  }
  if (atom.word == "stuck") {
    Expression unfinished =
        Expression::unary(Operation::Not, all_roots_ended());
    // A run that a fault ended is not stuck: it is reported as the fault.
    if (network_.fault) {
      unfinished = both(std::move(unfinished), variable_is(*network_.fault, 0));
    }
    return StatePredicate{Expression::constant(0), std::move(unfinished)};
  }
  findings.push_back(error("BT1101", atom.span,
                           fmt::format("unknown word `{}`", atom.word), "",
                           names_.nearest_help(atom.word)));
  return std::nullopt;
}

std::optional<StatePredicate> Binder::bind(const Atom& atom,
                                           Findings& findings) const {
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
  }
  return std::nullopt;
}

}  // namespace btcheck

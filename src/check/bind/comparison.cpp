// SPDX-License-Identifier: MIT
//
// Comparisons in properties: what the names on both sides mean. A name is a
// local of the process in whose scope it stands, else a state variable, else a
// symbol: a value of the variable on the other side. Codes: bind.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "check/bind/bind.hpp"

namespace btcheck {
namespace {

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

// The same with the sides exchanged.
Relation mirrored(Relation relation) {
  switch (relation) {
    case Relation::Less:
      return Relation::Greater;
    case Relation::LessEqual:
      return Relation::GreaterEqual;
    case Relation::Greater:
      return Relation::Less;
    case Relation::GreaterEqual:
      return Relation::LessEqual;
    default:
      return relation;
  }
}

}  // namespace

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
  if (of.variable) return read(*of.variable);
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
                                                 Findings& findings) {
  auto left = side(atom, atom.left, findings);
  auto right = side(atom, atom.right, findings);
  if (!left || !right) return std::nullopt;
  const auto of_left = entry_of(left->variable);
  const auto of_right = entry_of(right->variable);
  if (of_left && of_right) return compared_entries(atom, *of_left, *of_right);
  if (of_left && !right->variable) {
    return compared_entry(atom, *of_left, atom.relation, *right, atom.right,
                          findings);
  }
  if (of_right && !left->variable) {
    return compared_entry(atom, *of_right, mirrored(atom.relation), *left,
                          atom.left, findings);
  }
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
                                            Findings& findings) {
  auto of = side(atom, atom.left, findings);
  if (!of) return std::nullopt;
  const auto entry = entry_of(of->variable);
  if (entry && has_numbers(*entry->of)) {
    return plain(both(compared_number(atom, *entry, Relation::GreaterEqual,
                                      atom.low, findings),
                      compared_number(atom, *entry, Relation::LessEqual,
                                      atom.high, findings)));
  }
  if (!of->variable || !network_.variable(*of->variable).value_names.empty()) {
    findings.push_back(
        error("BT1105", atom.left.span,
              fmt::format("`{}` is not a variable that holds a number",
                          atom.left.name),
              "", of->variable ? "" : names_.nearest_help(atom.left.name)));
    return std::nullopt;
  }
  Expression value = read(*of->variable);
  return plain(both(Expression::binary(Operation::GreaterEqual, value,
                                       Expression::constant(atom.low)),
                    Expression::binary(Operation::LessEqual, value,
                                       Expression::constant(atom.high))));
}

}  // namespace btcheck

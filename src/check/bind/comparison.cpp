// SPDX-License-Identifier: MIT
//
// Comparisons in properties: what the names on both sides mean. A name is a
// local of the process in whose scope it stands, else a state variable, else a
// symbol: a value of the variable on the other side. Codes: bind.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "check/bind/bind.hpp"
#include "check/bind/name_help.hpp"
#include "model/automata/tick_memory.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

// By Relation: the operation, and the relation with the sides exchanged.
struct RelationFacts {
  Operation operation;
  Relation mirrored;
};
constexpr RelationFacts kRelations[] = {
    {Operation::Equal, Relation::Equal},
    {Operation::NotEqual, Relation::NotEqual},
    {Operation::Less, Relation::Greater},
    {Operation::LessEqual, Relation::GreaterEqual},
    {Operation::Greater, Relation::Less},
    {Operation::GreaterEqual, Relation::LessEqual}};

const RelationFacts& facts_of(Relation relation) {
  return kRelations[static_cast<std::size_t>(relation)];
}

std::optional<VariableId> variable_of_node(const Network& network, NodeId node,
                                           std::string_view name) {
  if (name == "status" || name == "rstatus") {
    return network.node_status[index(node)];
  }
  for (VariableId local : network.automaton(node).locals) {
    const bool is_argument =
        std::ranges::find(network.arguments, local, &KeptArgument::variable) !=
        network.arguments.end();
    if (is_argument) continue;
    if (equal_ignoring_case(network.variable(local).name, name)) return local;
  }
  return std::nullopt;
}

constexpr std::int64_t kFar = 2'000'000'000;

// Both values in the finer of the two scales. False where that would not fit.
bool align(const Variable& left, Expression& left_value, const Variable& right,
           Expression& right_value) {
  if (left.scale == right.scale) return true;
  const int decimals = std::max(left.scale.decimals, right.scale.decimals);
  const auto scaled = [&](const Variable& of, Expression& value) {
    const std::int64_t unit = apply(Operation::Multiply, of.scale.step,
                                    power_of_ten(decimals - of.scale.decimals));
    if (apply(Operation::Multiply, of.max, unit) > kFar ||
        apply(Operation::Multiply, of.min, unit) < -kFar) {
      return false;
    }
    if (unit == 1) return true;
    value = Expression::binary(
        Operation::Multiply, std::move(value),
        Expression::constant(static_cast<std::int32_t>(unit)));
    return true;
  };
  return scaled(left, left_value) && scaled(right, right_value);
}

// How the values of an entry become known.
std::string help_for_entry(std::string_view reason, std::string_view name) {
  const std::string values = fmt::format("`(defsv {} :min 0 :max 100)`", name);
  if (reason.starts_with("nothing in the tree")) {
    return fmt::format(
        "say what it begins with, `(defsv {} :init 0)`, or which values it "
        "has, {}, in a file for {}",
        name, values, word(Choice::Leaves));
  }
  if (!reason.starts_with("the port")) {
    return fmt::format("say which values it has, {}, in a file for {}", values,
                       word(Choice::Leaves));
  }
  return fmt::format(
      "say which values it has, {}, or what the leaf writes, `:on-success ((:= "
      "{} 1))`, in a file for {}",
      values, name, word(Choice::Leaves));
}

}  // namespace

// `node.status`, `node.answer`, `node.local`.
std::optional<Binder::Side> Binder::side_of_node(const Operand& operand) {
  const auto node = find_node(operand.node, operand.span);
  if (!node) return std::nullopt;
  const bool is_answer = equal_ignoring_case(operand.name, kAnswerName);
  if (is_answer && equal_ignoring_case(operand.node, "root") &&
      !has_one_root(operand.span)) {
    return std::nullopt;
  }
  const bool is_status = operand.name == "status" || operand.name == "rstatus";
  if (!is_status && !is_answer) {
    const std::size_t before = findings_.size();
    if (auto argument = side_of_argument(*node, operand)) return argument;
    if (findings_.size() > before &&
        findings_.back().severity == Severity::Error) {
      return std::nullopt;
    }
  }
  auto variable = variable_of_node(network_, *node, operand.name);
  if (variable) return Side{variable, {}, {}};
  std::vector<std::string> known = argument_names(*node);
  for (VariableId local : network_.automaton(*node).locals) {
    const std::string& name = network_.variable(local).name;
    if (name == kAnswerName) continue;
    if (std::ranges::find(known, name) == known.end()) known.push_back(name);
  }
  known.insert(known.begin(), {"status", std::string(kAnswerName)});
  return refuse(
      "BT1104", operand.span,
      fmt::format("`{}` has no variable `{}`", operand.node, operand.name), "",
      fmt::format("it has: {}", fmt::join(known, ", ")));
}

std::optional<VariableId> Binder::state_variable_called(
    const Operand& operand) {
  const auto& all = tree_.variables;
  auto found = std::ranges::find(all, operand.name, &StateVariable::name);
  if (found == all.end()) {
    found = std::ranges::find_if(all, [&](const StateVariable& variable) {
      return equal_ignoring_case(operand.name, variable.name);
    });
    if (found == all.end()) return std::nullopt;
    warn_of_case(operand.span, operand.name, "declared", found->name);
  }
  return network_.state_variable[static_cast<std::size_t>(found - all.begin())];
}

std::optional<Binder::Side> Binder::side(const Atom& atom,
                                         const Operand& operand) {
  if (operand.is_number) return Side{{}, operand.number, {}};
  if (!operand.node.empty()) return side_of_node(operand);
  if (atom.process) {
    auto number = process(atom);
    if (!number) return std::nullopt;
    const Automaton& scope = network_.automata[*number];
    if (scope.kind == AutomatonKind::Node && operand.name != "status") {
      auto local = variable_of_node(network_, scope.node, operand.name);
      if (local) return Side{local, {}, {}};
    }
  }
  auto variable = state_variable_called(operand);
  return Side{variable, {}, variable ? "" : operand.name};
}

std::optional<Expression> Binder::value_of_symbol(VariableId variable,
                                                  const Operand& operand) {
  const Variable& of = network_.variable(variable);
  for (std::size_t i = 0; i < of.value_names.size(); ++i) {
    if (!equal_ignoring_case(of.value_names[i], operand.name)) continue;
    if (of.value_names[i] != operand.name) {
      warn_of_case(operand.span, operand.name, "declared value",
                   of.value_names[i]);
    }
    return Expression::constant(of.min + static_cast<int>(i));
  }
  if (of.value_names.empty()) {
    return refuse(
        "BT1105", operand.span,
        fmt::format("`{}` is a number, `{}` is none", of.name, operand.name),
        fmt::format("from {} to {}", of.value_name(of.min),
                    of.value_name(of.max)));
  }
  return refuse(
      "BT1105", operand.span,
      fmt::format("`{}` has no value `{}`", of.name, operand.name), "",
      did_you_mean(operand.name, of.value_names,
                   fmt::format("it has: {}", fmt::join(of.value_names, ", "))));
}

// `fls > 3` of a variable in 0..3 is how one asks for the range itself.
void Binder::warn_of_range(const Atom& atom, const Variable& of,
                           Relation relation, Decimal number) {
  const bool is_equality = relation == Relation::Equal;
  if (!is_equality && relation != Relation::NotEqual) return;
  const auto value = bound_of(Operation::Equal, of.scale, number);
  if (value && *value >= of.min && *value <= of.max) return;
  warn("BT1106", atom.span,
       fmt::format("`{}` is {} true", atom.text,
                   is_equality ? "never" : "always"),
       fmt::format("`{}` is from {} to {}{}", of.name, of.value_name(of.min),
                   of.value_name(of.max),
                   value || of.scale.is_one()
                       ? ""
                       : fmt::format(" in steps of {}", of.scale.text(1))));
}

// Exact: the number is rounded to the side on which it makes no difference.
Binder::Bound Binder::beside_number(const Atom& atom, VariableId variable,
                                    Relation relation, Decimal number,
                                    SourceSpan span) {
  const Variable& of = network_.variable(variable);
  if (!of.value_names.empty()) {
    return refuse("BT1105", span,
                  fmt::format("`{}` has no value {}", of.name,
                              decimal_text(number.digits, number.decimals)),
                  "it is an enumeration");
  }
  warn_of_range(atom, of, relation, number);
  const Operation operation = facts_of(relation).operation;
  auto bound = bound_of(operation, of.scale, number);
  if (!bound) return Expression::constant(relation == Relation::NotEqual);
  if (!of.scale.is_one()) bound = std::clamp(*bound, -kFar, kFar);
  return Expression::binary(
      operation, read(variable),
      Expression::constant(static_cast<std::int32_t>(*bound)));
}

// One side as an expression; a symbol is a value of the variable on the other
// side.
std::optional<Expression> Binder::value_of(const Side& of, const Side& other,
                                           const Operand& operand) {
  if (of.variable) return read(*of.variable);
  return value_of_symbol(*other.variable, operand);
}

// An entry of an XML tree may have no state variable.
std::nullopt_t Binder::refuse_unknown(const Operand& unknown) {
  const auto is_meant = [&](std::string_view name) {
    return equal_ignoring_case(name.substr(name.rfind('/') + 1), unknown.name);
  };
  for (const OpenEntry& entry : tree_.open_entries) {
    if (!is_meant(entry.name)) continue;
    return refuse(
        "BT1101", unknown.span,
        fmt::format("`{}` is left open: its values are not known", entry.name),
        entry.reason, help_for_entry(entry.reason, unknown.name));
  }
  if (std::ranges::any_of(tree_.entries, is_meant)) {
    return refuse("BT1101", unknown.span,
                  fmt::format("`{}` is left open: its values are not known",
                              unknown.name),
                  "no script in the tree reads or writes it",
                  help_for_entry("", unknown.name));
  }
  return refuse("BT1101", unknown.span,
                fmt::format("unknown variable `{}`", unknown.name),
                "no variable has this name",
                variable_help(tree_, names_, unknown.name));
}

namespace {

// What fits an edge's arithmetic in every exported language.
constexpr ValueRange kWords{std::numeric_limits<std::int32_t>::min(),
                            std::numeric_limits<std::int32_t>::max()};

Operation operation_of(Arithmetic calculation) {
  if (calculation == Arithmetic::Multiply) return Operation::Multiply;
  return calculation == Arithmetic::Add ? Operation::Add : Operation::Subtract;
}

}  // namespace

std::optional<Binder::Calculated> Binder::with_decimals(Calculated number,
                                                        int decimals,
                                                        SourceSpan span) {
  if (number.decimals == decimals) return number;
  const std::int64_t power = power_of_ten(decimals - number.decimals);
  number.range = range_of(Operation::Multiply, number.range, {power, power});
  number.decimals = decimals;
  if (!kWords.has(number.range.low) || !kWords.has(number.range.high) ||
      !kWords.has(power)) {
    return refuse("BT1209", span, "this may get out of range",
                  "with all of its decimals",
                  "numbers lie between -2147483648 and 2147483647");
  }
  number.value = Expression::binary(
      Operation::Multiply, std::move(number.value),
      Expression::constant(static_cast<std::int32_t>(power)));
  return number;
}

bool Binder::equalize(Calculated& left, Calculated& right, SourceSpan span) {
  const int decimals = std::max(left.decimals, right.decimals);
  auto scaled_left = with_decimals(std::move(left), decimals, span);
  auto scaled_right = with_decimals(std::move(right), decimals, span);
  if (!scaled_left || !scaled_right) return false;
  left = std::move(*scaled_left);
  right = std::move(*scaled_right);
  return true;
}

Binder::Calculated Binder::calculated(Decimal number) {
  return {Expression::constant(number.digits),
          {number.digits, number.digits},
          number.decimals};
}

// A number, a variable that holds one, or a calculation with them.
std::optional<Binder::Calculated> Binder::calculated(const Atom& atom,
                                                     const Operand& operand) {
  if (operand.calculation == Arithmetic::None) {
    const auto of = side(atom, operand);
    if (!of) return std::nullopt;
    if (of->constant) return calculated(*of->constant);
    if (!of->variable) return refuse_unknown(operand);
    const Variable& variable = network_.variable(*of->variable);
    if (!variable.value_names.empty()) {
      return refuse(
          "BT1105", operand.span,
          fmt::format("`{}` is no number to calculate with", variable.name),
          entry_of(of->variable) ? "values of blackboard entries stand for many"
                                 : "it is an enumeration");
    }
    const std::int64_t step = variable.scale.step;
    Calculated number{read(*of->variable),
                      range_of(Operation::Multiply,
                               {variable.min, variable.max}, {step, step}),
                      variable.scale.decimals};
    if (step == 1) return number;
    number.value =
        Expression::binary(Operation::Multiply, std::move(number.value),
                           Expression::constant(variable.scale.step));
    return number;
  }
  auto left = calculated(atom, operand.parts[0]);
  auto right = calculated(atom, operand.parts[1]);
  if (!left || !right) return std::nullopt;
  const Operation operation = operation_of(operand.calculation);
  const bool is_product = operation == Operation::Multiply;
  if (!is_product && !equalize(*left, *right, operand.span))
    return std::nullopt;
  const ValueRange range = range_of(operation, left->range, right->range);
  if (!kWords.has(range.low) || !kWords.has(range.high)) {
    return refuse("BT1209", operand.span, "this may get out of range",
                  fmt::format("from {} to {}", range.low, range.high),
                  "numbers lie between -2147483648 and 2147483647");
  }
  return Calculated{
      Expression::binary(operation, std::move(left->value),
                         std::move(right->value)),
      range, is_product ? left->decimals + right->decimals : left->decimals};
}

Binder::Bound Binder::calculated_comparison(const Atom& atom) {
  auto left = calculated(atom, atom.left);
  if (!left) return std::nullopt;
  const auto compared = [&](Relation relation, Calculated right) -> Bound {
    Calculated own = *left;
    if (!equalize(own, right, atom.span)) return std::nullopt;
    return Expression::binary(facts_of(relation).operation,
                              std::move(own.value), std::move(right.value));
  };
  if (atom.kind == AtomKind::Range) {
    auto low = compared(Relation::GreaterEqual, calculated(atom.low));
    auto high = compared(Relation::LessEqual, calculated(atom.high));
    if (!low || !high) return std::nullopt;
    return both(std::move(*low), std::move(*high));
  }
  auto right = calculated(atom, atom.right);
  if (!right) return std::nullopt;
  return compared(atom.relation, std::move(*right));
}

Binder::Bound Binder::comparison(const Atom& atom) {
  if (atom.left.calculation != Arithmetic::None ||
      atom.right.calculation != Arithmetic::None) {
    return calculated_comparison(atom);
  }
  auto left = side(atom, atom.left);
  auto right = side(atom, atom.right);
  if (!left || !right) return std::nullopt;
  const auto of_left = entry_of(left->variable);
  const auto of_right = entry_of(right->variable);
  if (of_left && of_right) return compared_entries(atom, *of_left, *of_right);
  if (of_left && !right->variable) {
    return compared_entry(atom, *of_left, atom.relation, *right, atom.right);
  }
  if (of_right && !left->variable) {
    return compared_entry(atom, *of_right, facts_of(atom.relation).mirrored,
                          *left, atom.left);
  }
  if (!left->variable && !right->variable) {
    const Operand& unknown = atom.left.is_number ? atom.right : atom.left;
    return refuse_unknown(unknown);
  }
  if (left->variable && right->constant) {
    return beside_number(atom, *left->variable, atom.relation, *right->constant,
                         atom.right.span);
  }
  if (right->variable && left->constant) {
    return beside_number(atom, *right->variable,
                         facts_of(atom.relation).mirrored, *left->constant,
                         atom.left.span);
  }
  auto left_value = value_of(*left, *right, atom.left);
  auto right_value = value_of(*right, *left, atom.right);
  if (!left_value || !right_value) return std::nullopt;
  const bool are_aligned =
      !left->variable || !right->variable ||
      align(network_.variable(*left->variable), *left_value,
            network_.variable(*right->variable), *right_value);
  if (!are_aligned) {
    return refuse("BT1105", atom.span, "these two cannot be compared",
                  "with all of their decimals they are too large");
  }
  if (left->variable && right->variable &&
      network_.variable(*left->variable).value_names !=
          network_.variable(*right->variable).value_names) {
    return refuse("BT1105", atom.span, "these two variables cannot be compared",
                  "they have different values");
  }
  return Expression::binary(facts_of(atom.relation).operation,
                            std::move(*left_value), std::move(*right_value));
}

Binder::Bound Binder::range(const Atom& atom) {
  if (atom.left.calculation != Arithmetic::None) {
    return calculated_comparison(atom);
  }
  auto of = side(atom, atom.left);
  if (!of) return std::nullopt;
  const auto entry = entry_of(of->variable);
  if (entry && entry->has_numbers()) {
    return both(compared_number(atom, *entry, Relation::GreaterEqual,
                                atom.low.nearest()),
                compared_number(atom, *entry, Relation::LessEqual,
                                atom.high.nearest()));
  }
  if (!of->variable) return refuse_unknown(atom.left);
  if (!network_.variable(*of->variable).value_names.empty()) {
    return refuse("BT1105", atom.left.span,
                  fmt::format("`{}` is not a variable that holds a number",
                              atom.left.name));
  }
  auto low = beside_number(atom, *of->variable, Relation::GreaterEqual,
                           atom.low, atom.left.span);
  auto high = beside_number(atom, *of->variable, Relation::LessEqual, atom.high,
                            atom.left.span);
  return both(std::move(*low), std::move(*high));
}

}  // namespace btcheck

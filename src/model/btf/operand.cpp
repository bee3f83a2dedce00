// SPDX-License-Identifier: MIT
//
// There are four types: numbers, truth values, the states of an enumeration,
// and return statuses. A bare word is none of them yet: beside an enumeration
// it is one of its states, beside a status it is success, failure or running,
// and elsewhere it is a variable. So its meaning is settled only when its
// operator meets its neighbour. An operand with an error in it is Broken and
// nothing more is said about what contains it.
#include "model/btf/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "text/utf8.hpp"

namespace btcheck::btf {
namespace {

// The name of a node in `name.rstatus`, or nothing.
std::optional<std::string_view> status_of(std::string_view word) {
  if (word.starts_with('$')) word.remove_prefix(1);
  if (word.size() <= kStatusSuffix.size()) return std::nullopt;
  const std::size_t at = word.size() - kStatusSuffix.size();
  if (!equal_ignoring_case(word.substr(at), kStatusSuffix)) return std::nullopt;
  return word.substr(0, at);
}

std::optional<int> status_value(std::string_view word) {
  for (const NodeStatus status :
       {NodeStatus::Success, NodeStatus::Failure, NodeStatus::Running}) {
    const auto value = static_cast<std::size_t>(status);
    if (equal_ignoring_case(word, kStatusNames[value])) {
      return static_cast<int>(value);
    }
  }
  return std::nullopt;
}

std::string description(const Operand& value) {
  switch (value.type) {
    case Type::Number:
      return "a number";
    case Type::Truth:
      return "true or false";
    case Type::Status:
      return "a return status";
    case Type::Enumeration:
      return value.variable ? "an enumeration" : "a state";
    default:
      return "unknown";
  }
}

}  // namespace

Operand Operands::atom(FormId id) {
  const Form& word = form(id);
  if (!word.is_word()) {
    return error(word.span, "BT1003",
                 fmt::format("`{}` is not part of an expression", word.text));
  }
  if (looks_numeric(word.text)) return number(id);
  if (scope_.bindings) {
    const auto& named = scope_.bindings->by_key;
    const auto found = named.find(name_key(without_dollar(word.text)));
    if (found != named.end()) return bound(id, found->second);
  }
  if (const auto node = status_of(word.text)) return status(id, *node);
  Operand result;
  result.type = Type::Word;
  result.form = id;
  return word.text.starts_with('$') ? variable(std::move(result))
                                    : std::move(result);
}

Operand Operands::number(FormId id) {
  const Form& word = form(id);
  const auto number = decimal_number(word.text);
  if (number && number->digits >= -kLargest) {
    return constant(id, number->digits, number->decimals);
  }
  return error(word.span, "BT1008",
               fmt::format("`{}` is not a number from {} to {}", word.text,
                           -kLargest, kLargest),
               word.text.find('.') == std::string_view::npos
                   ? ""
                   : "without its point it has to be one as well");
}

Operand Operands::constant(FormId id, int value, int decimals) {
  return {Type::Number, id,    Expression::constant(value),
          std::nullopt, value, decimals};
}

// A word is settled where it stands, as if it had been written there.
Operand Operands::bound(FormId id, const Binding& binding) {
  const Form& word = form(id);
  if (binding.is_open) {
    return error(word.span, "BT1012",
                 fmt::format("the value of `{}` is not known", word.text),
                 fmt::format("line {} hands over what no `defsv` declares",
                             scope_.bindings->line));
  }
  Operand value = binding.value;
  if (value.type != Type::Word) value.form = id;
  return value;
}

Operand Operands::status(FormId id, std::string_view name) {
  const auto node =
      scope_.nodes.find(scope_.reading, form(id), name, scope_.from);
  if (!node) return {};
  const auto number = static_cast<std::int32_t>(index(*node));
  return {Type::Status, id, Expression::status(number), std::nullopt,
          std::nullopt};
}

// A word that can only be a variable.
Operand Operands::variable(Operand word) {
  if (!scope_.variables.declared(form(word.form))) {
    return unknown(form(word.form));
  }
  const auto found = scope_.variables.find(scope_.reading, form(word.form));
  if (!found) return {};
  word.variable = found;
  word.value = Expression::variable(static_cast<std::int32_t>(index(*found)));
  const StateVariable& variable = scope_.variables[*found];
  word.type = variable.is_enumeration() ? Type::Enumeration : Type::Number;
  word.decimals = variable.scale.decimals;
  if (variable.scale.step != 1) {
    word.value = Expression::binary(Operation::Multiply, std::move(word.value),
                                    Expression::constant(variable.scale.step));
  }
  return word;
}

Operand Operands::unknown(const Form& word) {
  if (scope_.is_unused && word.text.starts_with('$')) return {};
  if (!scope_.bindings) {
    scope_.variables.find(scope_.reading, word);
    return {};
  }
  std::vector<std::string> names = scope_.variables.names();
  for (const auto& [key, binding] : scope_.bindings->by_key) {
    names.push_back(key);
  }
  const std::string_view name = without_dollar(word.text);
  return error(
      word.span, "BT1012", fmt::format("unknown state variable `{}`", name),
      scope_.bindings->function || word.span.line == scope_.bindings->line
          ? ""
          : fmt::format("the SubTree on line {} hands over no such argument",
                        scope_.bindings->line),
      names.empty() ? "" : nearest_or_all(name, names));
}

Operand Operands::beside(Operand word, StateVariableId enumeration) {
  const Form& written = form(word.form);
  const auto state =
      scope_.variables.find_state(scope_.reading, enumeration, written);
  if (state) {
    word.type = Type::Enumeration;
    word.value = Expression::constant(*state);
    return word;
  }
  if (scope_.variables.is_broken(enumeration)) return {};
  if (scope_.variables.declared(written)) return variable(std::move(word));
  report_unknown_state(scope_.reading, written, scope_.variables[enumeration]);
  return {};
}

Operand Operands::beside_status(Operand word) {
  const Form& written = form(word.form);
  if (const auto value = status_value(written.text)) {
    word.type = Type::Status;
    word.value = Expression::constant(*value);
    return word;
  }
  return error(written.span, "BT1013",
               fmt::format("`{}` is not a return status", written.text), "",
               "there are `success`, `failure` and `running`");
}

void Operands::settle_words(Operand& left, Operand& right) {
  if (left.type == Type::Broken || right.type == Type::Broken) return;
  if (left.type == Type::Word && right.type == Type::Word) {
    if (scope_.variables.declared(form(right.form)) &&
        (is_state_of(left, right) ||
         !scope_.variables.declared(form(left.form)))) {
      right = variable(std::move(right));
    } else {
      left = variable(std::move(left));
    }
  }
  settle(left, right);
  settle(right, left);
}

// True when the second word is a variable with the first as a state, and
// not the other way round.
bool Operands::is_state_of(const Operand& word, const Operand& variable) const {
  const auto states = [&](const Operand& of, const Operand& state) {
    const auto found = scope_.variables.declared(form(of.form));
    return found && scope_.variables.has_state(*found, form(state.form));
  };
  return states(variable, word) && !states(word, variable);
}

void Operands::settle(Operand& word, const Operand& neighbour) {
  if (word.type != Type::Word || neighbour.type == Type::Broken) return;
  if (neighbour.type == Type::Enumeration && neighbour.variable) {
    word = beside(std::move(word), *neighbour.variable);
  } else if (neighbour.type == Type::Status) {
    word = beside_status(std::move(word));
  } else if (neighbour.type != Type::Word) {
    word = variable(std::move(word));
  }
}

bool Operands::are_comparable(const Operand& left, const Operand& right) {
  const Operand& known = left.variable ? left : right;
  const Operand& other = left.variable ? right : left;
  if (left.type == Type::Truth || right.type == Type::Truth) {
    mismatch(left.type == Type::Truth ? left : right,
             "a number, a state or a status is needed",
             "join truth values with `and`, `or` and `~`");
    return false;
  }
  if (left.type != right.type) {
    mismatch(other, known.type == Type::Enumeration && known.variable
                        ? fmt::format("a state of {} is needed", quoted(known))
                        : fmt::format("{} is needed", description(known)));
    return false;
  }
  return left.type != Type::Enumeration || !known.variable ||
         same_states(other, *known.variable);
}

// A state settled beside its variable always fits; another variable must
// have the same states.
bool Operands::same_states(const Operand& value, StateVariableId of) {
  if (!value.variable) return true;
  const StateVariable& other = scope_.variables[*value.variable];
  const StateVariable& wanted = scope_.variables[of];
  if (scope_.variables.is_broken(of) ||
      scope_.variables.is_broken(*value.variable) ||
      other.states == wanted.states) {
    return true;
  }
  error(form(value.form).span, "BT1015",
        fmt::format("`{}` and `{}` have different states", other.name,
                    wanted.name),
        "",
        fmt::format("the states of `{}` are {}", wanted.name,
                    listed(wanted.states)));
  return false;
}

Operand Operands::wanted(Operand value, Type type) {
  if (value.type == Type::Word) value = variable(std::move(value));
  if (value.type == type || value.type == Type::Broken) return value;
  const bool is_truth = type == Type::Truth;
  const bool has_status = value.type == Type::Status;
  return mismatch(
      value, is_truth ? "true or false is needed" : "a number is needed",
      is_truth && (has_status || value.variable)
          ? fmt::format("compare it: `(= {} ...)`", form(value.form).text)
          : "");
}

Operand Operands::mismatch(const Operand& value, std::string needed,
                           std::string help) {
  return error(form(value.form).span, "BT1015",
               fmt::format("{} is {}", quoted(value), description(value)),
               std::move(needed), std::move(help));
}

std::string Operands::quoted(const Operand& value) const {
  const Form& written = form(value.form);
  if (!written.is_list()) return fmt::format("`{}`", written.text);
  return fmt::format("`({} ...)`", scope_.reading.forms.head(value.form)->text);
}

Operand Operands::error(SourceSpan span, std::string_view code,
                        std::string message, std::string label,
                        std::string help) {
  scope_.reading.error(span, code, std::move(message), std::move(label),
                       std::move(help));
  return {};
}

}  // namespace btcheck::btf

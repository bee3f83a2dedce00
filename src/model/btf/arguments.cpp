// SPDX-License-Identifier: MIT
//
// A list that begins with an operator or a function is an expression, `$name`
// is a variable, a number is a number, and every other word is a symbol, which
// stands for itself. `$name` of no variable belongs to the program around the
// tree (Nav2's `$goal`) unless it looks like a misspelt one. Lists of other
// kinds are the program's as well.
#include "model/btf/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/btf/functions.hpp"
#include "model/tree/value_range.hpp"

namespace btcheck::btf {
namespace {

class ArgumentReader {
 public:
  explicit ArgumentReader(const Scope& scope) : scope_(scope) {}

  Binding read(FormId id) {
    const Form& form = this->form(id);
    if (form.is_list()) return read_list(id);
    if (form.text.starts_with('$')) return read_name(id);
    Binding symbol;
    symbol.value.type = Type::Word;
    symbol.value.form = id;
    if (!form.is_word() || !looks_numeric(form.text)) return symbol;
    const auto number = decimal_number(form.text);
    const bool is_number = number && number->digits >= -kLargest;
    return is_number ? Binding{read_operand(scope_, id)} : symbol;
  }

  std::optional<ArgumentValue> value_of(const Binding& binding) const {
    const Operand& operand = binding.value;
    if (binding.is_open || operand.type == Type::Broken) return std::nullopt;
    ArgumentValue value;
    value.value = operand.value;
    value.decimals = operand.decimals;
    if (operand.type == Type::Number) {
      return within_bounds(operand, value) ? std::optional(value)
                                           : std::nullopt;
    }
    value.names = names_of(operand);
    if (operand.type == Type::Word) value.value = Expression::constant(0);
    value.max = static_cast<int>(value.names.size()) - 1;
    return value;
  }

 private:
  const Form& form(FormId id) const { return scope_.reading.form(id); }

  Binding read_list(FormId id) {
    const Form* head = scope_.reading.forms.head(id);
    const bool is_expression =
        head && (find_operator(head->text) || is_function(*head));
    if (is_expression) return {read_operand(scope_, id)};
    Binding open;
    open.is_open = true;
    const Form& list = form(id);
    for (std::uint32_t at = list.first_token; at < list.end_token; ++at) {
      const Token& token = scope_.reading.forms.tokens[at];
      if (token.text.starts_with('$')) {
        open.is_open &= may_be_open(token.text, token.span);
      }
    }
    return open;
  }

  // A word that looks like the name of a function is one.
  bool is_function(const Form& head) const {
    if (!scope_.functions) return false;
    return closest_match(head.text, scope_.functions->names()).has_value();
  }

  Binding read_name(FormId id) {
    const Form& word = form(id);
    const std::string key = name_key(without_dollar(word.text));
    if (scope_.bindings) {
      const auto bound = scope_.bindings->by_key.find(key);
      if (bound != scope_.bindings->by_key.end()) return bound->second;
    }
    const bool is_known = scope_.variables.declared(word) ||
                          name_key(word.text).ends_with(kStatusSuffix);
    if (is_known) return {read_operand(scope_, id)};
    Binding open;
    open.is_open = may_be_open(word.text, word.span);
    return open;
  }

  // Not misspelt, as far as can be told. An error where it is.
  bool may_be_open(std::string_view word, SourceSpan span) const {
    const std::string_view name = without_dollar(word);
    std::vector<std::string> names = scope_.variables.names();
    if (scope_.bindings) {
      for (const auto& [key, bound] : scope_.bindings->by_key) {
        names.push_back(key);
      }
    }
    const auto nearest = closest_match(name, names);
    if (!nearest || equal_ignoring_case(*nearest, name)) return true;
    scope_.reading.error(span, "BT1012",
                         fmt::format("unknown state variable `{}`", name), "",
                         fmt::format("did you mean `{}`?", *nearest));
    return false;
  }

  // A number that 32 bits hold, whatever the state variables are.
  bool within_bounds(const Operand& operand, ArgumentValue& value) const {
    const auto range = [&](const Term& term) -> ValueRange {
      if (term.operation == Operation::Status) {
        return {0, static_cast<int>(kStatusNames.size()) - 1};
      }
      const auto id = StateVariableId{static_cast<std::uint32_t>(term.operand)};
      const StateVariable& of = scope_.variables[id];
      return {of.min, of.max};
    };
    const auto [low, high] = range_of(value.value.terms(), range);
    const int most = value.decimals > 0 ? kLargestScaled : kLargest;
    if (low >= -most && high <= most) {
      value.min = static_cast<int>(low);
      value.max = static_cast<int>(high);
      return true;
    }
    scope_.reading.error(
        form(operand.form).span, "BT1023", "this argument may get out of range",
        fmt::format("values from {} to {} can be handed over", -most, most),
        value.decimals > 0 ? "use fewer decimals" : "");
    return false;
  }

  std::vector<std::string> names_of(const Operand& operand) const {
    if (operand.type == Type::Truth) return {"false", "true"};
    if (operand.type == Type::Status) {
      return {kStatusNames.begin(), kStatusNames.end()};
    }
    if (operand.variable) return scope_.variables[*operand.variable].states;
    std::string written = scope_.reading.forms.written(operand.form);
    if (written.size() >= 2 && form(operand.form).kind == FormKind::Quoted) {
      written = written.substr(1, written.size() - 2);
    }
    return {std::move(written)};
  }

  const Scope& scope_;
};

}  // namespace

Bindings read_arguments(const Scope& scope, FormId list, Node& node) {
  ArgumentReader reader(scope);
  Bindings bindings;
  bindings.line = node.span.line;
  const std::vector<FormId>& items = scope.reading.form(list).items;
  for (std::size_t i = 0; i < node.arguments.size(); ++i) {
    Argument& argument = node.arguments[i];
    Binding binding = reader.read(items[2 * i + 1]);
    argument.known = reader.value_of(binding);
    bindings.by_key.emplace(name_key(argument.key), std::move(binding));
  }
  return bindings;
}

bool mentions(const Reading& reading, FormId form, const Bindings& bindings) {
  const Form& whole = reading.form(form);
  for (std::uint32_t at = whole.first_token; at < whole.end_token; ++at) {
    const std::string_view word = without_dollar(reading.forms.tokens[at].text);
    if (bindings.by_key.contains(name_key(word))) return true;
  }
  return false;
}

}  // namespace btcheck::btf

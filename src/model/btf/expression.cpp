// SPDX-License-Identifier: MIT
//
// The lists of an expression are walked in post-order, with an explicit stack:
// the operands of each wait on a second one until their operator takes them.
// Arithmetic on constants is done at once, so that a value out of range is
// found here.
#include "model/btf/expression.hpp"
#include "model/btf/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace btcheck::btf {
namespace {

constexpr std::size_t kMany = 1 << 20;
constexpr std::size_t kMostTerms = 20'000;
constexpr int kMostDecimals = 9;
constexpr std::array<Operator, 17> kOperators = {{
    {"=", Operation::Equal, 2, 2},
    {"~=", Operation::NotEqual, 2, 2},
    {"/=", Operation::NotEqual, 2, 2},
    {"!=", Operation::NotEqual, 2, 2},
    {"<", Operation::Less, 2, 2},
    {"<=", Operation::LessEqual, 2, 2},
    {">", Operation::Greater, 2, 2},
    {">=", Operation::GreaterEqual, 2, 2},
    {"and", Operation::And, 1, kMany},
    {"or", Operation::Or, 1, kMany},
    {"~", Operation::Not, 1, 1},
    {"not", Operation::Not, 1, 1},
    {"+", Operation::Add, 1, kMany},
    {"-", Operation::Subtract, 1, 2},
    {"*", Operation::Multiply, 1, kMany},
    {"/", Operation::Divide, 2, 2},
    {"mod", Operation::Modulo, 2, 2},
}};

bool is_logical(Operation operation) {
  return operation == Operation::And || operation == Operation::Or ||
         operation == Operation::Not;
}

Operation mirrored(Operation comparison) {
  switch (comparison) {
    case Operation::Less:
      return Operation::Greater;
    case Operation::LessEqual:
      return Operation::GreaterEqual;
    case Operation::Greater:
      return Operation::Less;
    case Operation::GreaterEqual:
      return Operation::LessEqual;
    default:
      return comparison;
  }
}

// The variable's value, counted, in a relation to a number: no calculation, and
// nothing is rounded.
Expression compared_with(StateVariableId id, const StateVariable& variable,
                         Operation relation, Decimal number) {
  const auto bound = bound_of(relation, variable.scale, number);
  if (!bound) return Expression::constant(relation == Operation::NotEqual);
  // So far out of the range as it may be.
  constexpr std::int64_t kFar = kLargest;
  return Expression::binary(
      relation, Expression::variable(static_cast<std::int32_t>(index(id))),
      Expression::constant(
          static_cast<std::int32_t>(std::clamp(*bound, -kFar, kFar))));
}

// The number is below or above all values of the variable.
bool lies_outside(const StateVariable& variable, Decimal number) {
  return *bound_of(Operation::GreaterEqual, variable.scale, number) >
             variable.max ||
         *bound_of(Operation::LessEqual, variable.scale, number) < variable.min;
}

class Reader {
 public:
  explicit Reader(const Scope& scope) : scope_(scope), words_(scope) {}

  // Of any type.
  Operand any(FormId form) { return operand(form); }

  // A condition: Truth or Broken.
  Operand condition(FormId form) {
    return words_.wanted(operand(form), Type::Truth);
  }

  // What is assigned to a number: Number or Broken.
  Operand number(FormId form) {
    return words_.wanted(operand(form), Type::Number);
  }

  // What is assigned to an enumeration: a state, or a variable like it.
  Operand state(FormId form, StateVariableId of) {
    Operand value = operand(form);
    if (value.type == Type::Word) value = words_.beside(std::move(value), of);
    if (value.type == Type::Broken) return value;
    if (value.type != Type::Enumeration) {
      return words_.mismatch(value, fmt::format("a state of `{}` is needed",
                                                scope_.variables[of].name));
    }
    return words_.same_states(value, of) ? std::move(value) : Operand{};
  }

 private:
  struct Work {
    FormId form{};
    bool operands_are_read = false;
  };

  const Form& form(FormId id) const { return scope_.reading.form(id); }

  Operand operand(FormId root) {
    work_ = {{root, false}};
    while (!work_.empty()) {
      const Work next = work_.back();
      work_.pop_back();
      if (next.operands_are_read) {
        combine_last(next.form);
      } else if (form(next.form).is_list()) {
        open_list(next.form);
      } else {
        done_.push_back(words_.atom(next.form));
      }
    }
    assert(done_.size() == 1);
    Operand result = std::move(done_.back());
    done_.clear();
    return result;
  }

  // The function that a list calls; null when it calls none.
  const Function* function_of(FormId id) const {
    const Form* head = scope_.reading.forms.head(id);
    return head && scope_.functions ? scope_.functions->find(head->text)
                                    : nullptr;
  }

  void open_list(FormId id) {
    const Function* called = function_of(id);
    if (called ? !may_call(id, *called) : !checked_operator(id)) {
      done_.push_back({});
      return;
    }
    work_.push_back({id, true});
    const std::vector<FormId>& items = form(id).items;
    for (std::size_t i = items.size(); i-- > 1;) {
      work_.push_back({items[i], false});
    }
  }

  bool may_call(FormId id, const Function& called) {
    const Form& head = *scope_.reading.forms.head(id);
    const std::size_t wanted = called.parameters.size();
    const std::size_t count = form(id).items.size() - 1;
    if (count != wanted) {
      words_.error(head.span, "BT1009",
                   fmt::format("`{}` takes {} argument{}, not {}", head.text,
                               wanted, wanted == 1 ? "" : "s", count),
                   "",
                   fmt::format("it is defined on line {}", called.span.line));
      return false;
    }
    return scope_.functions->begin_call(scope_, called, head);
  }

  // What the function returns, with these operands in place of its parameters.
  Operand called(FormId id, const Function& function,
                 std::vector<Operand> operands) {
    const Form& head = *scope_.reading.forms.head(id);
    Bindings bindings{{}, head.span.line, &function, scope_.bindings};
    for (std::size_t i = 0; i < operands.size(); ++i) {
      bindings.by_key[function.parameters[i]] = {std::move(operands[i])};
    }
    const std::string use = fmt::format("as called on line {}", bindings.line);
    const Reading reading{scope_.reading.forms, scope_.reading.findings, use};
    const Scope inside{reading,     scope_.variables, scope_.nodes,
                       scope_.from, scope_.functions, &bindings};
    Operand result = Reader(inside).any(function.body);
    if (result.value.terms().size() <= kMostTerms) return result;
    return words_.error(head.span, "BT1002", "the value is too large",
                        fmt::format("more than {} operations", kMostTerms));
  }

  // The operator of a list with the right number of operands, or an error.
  const Operator* checked_operator(FormId id) {
    const Form* head = scope_.reading.forms.head(id);
    const Operator* known = head ? find_operator(head->text) : nullptr;
    if (!known) {
      report_operator(id, head);
      return nullptr;
    }
    const std::size_t count = form(id).items.size() - 1;
    if (count >= known->least && count <= known->most) return known;
    words_.error(head->span, "BT1009",
                 fmt::format("`{}` takes {}, not {}", head->text,
                             operand_count(*known), count),
                 "",
                 is_comparison(known->operation) && count > 2
                     ? "join comparisons: `(and (< 0 x) (< x 3))`"
                     : "");
    return nullptr;
  }

  static std::string operand_count(const Operator& known) {
    if (known.most == kMany) return "at least 1 operand";
    if (known.least < known.most) return "1 or 2 operands";
    return known.least == 1 ? "1 operand" : "2 operands";
  }

  void report_operator(FormId id, const Form* head) {
    if (!head) {
      words_.error(form(id).span, "BT1004", "an operator must stand here", "",
                   "write `(= battery Low)`, operator first");
    } else if (head->text == ":=") {
      words_.error(head->span, "BT1016", "`:=` stands inside an expression", "",
                   "an assignment is the whole of an Eval: `(Eval (:= v e))`");
    } else {
      const std::string operators =
          "there are `= ~= < <= > >= and or ~ + - * / mod`";
      words_.error(
          head->span, "BT1004",
          fmt::format("unknown operator `{}`", head->text), "",
          scope_.functions
              ? did_you_mean(head->text, scope_.functions->names(), operators)
              : operators);
    }
  }

  // Takes the operands of a list whose items are all read, leaves its value.
  void combine_last(FormId id) {
    const std::size_t count = form(id).items.size() - 1;
    const auto first = done_.end() - static_cast<std::ptrdiff_t>(count);
    std::vector<Operand> operands(std::make_move_iterator(first),
                                  std::make_move_iterator(done_.end()));
    done_.erase(first, done_.end());
    Operand result = combined(id, std::move(operands));
    if (result.type != Type::Word) result.form = id;
    done_.push_back(std::move(result));
  }

  Operand combined(FormId id, std::vector<Operand> operands) {
    if (const Function* function = function_of(id)) {
      return called(id, *function, std::move(operands));
    }
    const Operator& known = *find_operator(scope_.reading.forms.head(id)->text);
    if (!is_comparison(known.operation)) {
      return folded(known.operation, std::move(operands));
    }
    return compared(known.operation, std::move(operands[0]),
                    std::move(operands[1]));
  }

  // Gives all of them the same number of decimals.
  static void align(std::vector<Operand>& operands) {
    int most = 0;
    for (const Operand& each : operands) most = std::max(most, each.decimals);
    for (Operand& each : operands) {
      if (each.decimals == most) continue;
      const auto power =
          static_cast<std::int32_t>(power_of_ten(most - each.decimals));
      const bool is_constant = each.constant.has_value();
      each.value =
          Expression::binary(Operation::Multiply, std::move(each.value),
                             Expression::constant(power));
      each.decimals = most;
      each.variable.reset();
      each.constant.reset();
      if (is_constant) each = evaluated(std::move(each));
    }
  }

  // What the decimals of the result are; less than 0 after an error.
  int decimals(Operation operation, std::vector<Operand>& operands) {
    if (operation == Operation::Multiply) {
      int sum = 0;
      for (const Operand& each : operands) sum += each.decimals;
      if (sum <= kMostDecimals) return sum;
      words_.error(form(operands[0].form).span, "BT1023",
                   "this product has too many decimals",
                   fmt::format("at most {} are told apart", kMostDecimals));
      return -1;
    }
    align(operands);
    const int each = operands[0].decimals;
    if (each == 0 || !divides(operation)) return each;
    words_.error(
        form(operands[0].form).span, "BT1015", "decimals are divided here",
        "`/` and `mod` are of whole numbers", "multiply instead: `(* 0.5 x)`");
    return -1;
  }

  // Logic and arithmetic, from left to right.
  Operand folded(Operation operation, std::vector<Operand> operands) {
    const Type type = is_logical(operation) ? Type::Truth : Type::Number;
    bool is_broken = false;
    bool is_constant = type == Type::Number;
    for (Operand& each : operands) {
      each = words_.wanted(std::move(each), type);
      is_broken |= each.type == Type::Broken;
      is_constant &= each.constant.has_value();
    }
    if (is_broken || divides_by_zero(operation, operands)) return {};
    const int behind = decimals(operation, operands);
    if (behind < 0) return {};
    Operand result = std::move(operands.front());
    result.decimals = behind;
    const bool is_unary = operands.size() == 1;
    if (is_unary &&
        (operation == Operation::Not || operation == Operation::Subtract)) {
      result.value = Expression::unary(
          operation == Operation::Not ? Operation::Not : Operation::Negate,
          std::move(result.value));
    }
    for (std::size_t i = 1; i < operands.size(); ++i) {
      result.value = Expression::binary(operation, std::move(result.value),
                                        std::move(operands[i].value));
    }
    result.variable.reset();
    result.constant.reset();
    return is_constant ? evaluated(std::move(result)) : std::move(result);
  }

  bool divides_by_zero(Operation operation,
                       const std::vector<Operand>& operands) {
    if (!divides(operation) || operands[1].constant != 0) return false;
    words_.error(form(operands[1].form).span, "BT1015", "a division by zero");
    return true;
  }

  // Arithmetic on constants only is a constant.
  static Operand evaluated(Operand operand) {
    const auto value =
        operand.value.evaluate([](const Term&) { return std::int64_t{0}; });
    if (value < -kLargest || value > kLargest) return operand;
    return Operands::constant(operand.form, static_cast<int>(value),
                              operand.decimals);
  }

  Operand compared(Operation operation, Operand left, Operand right) {
    const bool ordered = !is_equality(operation);
    if (ordered) {
      left = words_.wanted(std::move(left), Type::Number);
      right = words_.wanted(std::move(right), Type::Number);
    } else {
      words_.settle_words(left, right);
    }
    if (left.type == Type::Broken || right.type == Type::Broken) return {};
    if (!ordered && !words_.are_comparable(left, right)) return {};
    Operand result;
    result.type = Type::Truth;
    if (auto counted = beside_number(operation, left, right)) {
      result.value = *std::move(counted);
      return result;
    }
    if (left.decimals != right.decimals) {
      std::vector<Operand> sides = {std::move(left), std::move(right)};
      align(sides);
      left = std::move(sides[0]);
      right = std::move(sides[1]);
    }
    result.value = Expression::binary(operation, std::move(left.value),
                                      std::move(right.value));
    return result;
  }

  // A variable beside a constant; nothing for everything else.
  std::optional<Expression> beside_number(Operation operation,
                                          const Operand& left,
                                          const Operand& right) {
    const Operand& known = left.variable ? left : right;
    const Operand& other = left.variable ? right : left;
    if (!known.variable || !other.constant) return std::nullopt;
    const StateVariable& variable = scope_.variables[*known.variable];
    const Operation relation = left.variable ? operation : mirrored(operation);
    const Decimal number{*other.constant, other.decimals};
    Expression counted =
        compared_with(*known.variable, variable, relation, number);
    warn_if_constant(counted, *known.variable, number, other.form);
    if (!variable.scale.is_one() || number.decimals > 0) return counted;
    return Expression::binary(operation, left.value, right.value);
  }

  // A number beside a constant that is outside of its range, or between two of
  // its steps.
  void warn_if_constant(const Expression& counted, StateVariableId id,
                        Decimal number, FormId at) {
    const StateVariable& variable = scope_.variables[id];
    const bool is_between = counted.only(Operation::Constant).has_value();
    if (scope_.variables.is_broken(id) ||
        (!is_between && !lies_outside(variable, number))) {
      return;
    }
    const bool outcome =
        counted.evaluate([&](const Term&) { return variable.min; }) != 0;
    const std::string range = fmt::format(
        "`{}` ranges from {} to {}", variable.name,
        variable.value_name(variable.min), variable.value_name(variable.max));
    scope_.reading.findings.warning(
        form(at).span,
        {"BT1017", fmt::format("this comparison is always {}", outcome),
         is_between
             ? fmt::format("{} in steps of {}", range, variable.scale.text(1))
             : range,
         ""});
  }

  const Scope& scope_;
  Operands words_;
  std::vector<Work> work_;
  std::vector<Operand> done_;
};

// What is assigned to a number, counted in its steps; nothing after an error.
std::optional<Counted> counted_value(const Reading& reading,
                                     const StateVariable& target,
                                     const Operand& value) {
  const auto refuse = [&](std::string label) {
    const std::string what = value.constant
                                 ? decimal_text(*value.constant, value.decimals)
                                 : "what is calculated here";
    reading.error(reading.form(value.form).span, "BT1016",
                  fmt::format("`{}` cannot become {}", target.name, what),
                  std::move(label));
    return std::nullopt;
  };
  Counted counted = counted_in(target.scale, value.value, value.decimals);
  if (counted.is == OnSteps::TooFine) {
    return refuse("it has too many decimals to be told apart");
  }
  if (counted.is == OnSteps::Never) {
    return refuse(target.scale.is_one()
                      ? std::string("its values are whole numbers")
                      : fmt::format("its values are multiples of {}",
                                    target.scale.text(1)));
  }
  if (!value.constant) return counted;
  const auto known =
      counted.value.evaluate([](const Term&) { return std::int64_t{0}; });
  if (known < target.min || known > target.max) {
    return refuse(fmt::format("its range is {} to {}",
                              target.value_name(target.min),
                              target.value_name(target.max)));
  }
  counted.value = Expression::constant(static_cast<std::int32_t>(known));
  return counted;
}

}  // namespace

const Operator* find_operator(std::string_view sign) {
  const auto found =
      std::ranges::find_if(kOperators, [&](const Operator& known) {
        return equal_ignoring_case(known.sign, sign);
      });
  return found == kOperators.end() ? nullptr : &*found;
}

bool is_assignment(const Reading& reading, FormId form) {
  const Form* head = reading.forms.head(form);
  return head && head->text == ":=";
}

Operand read_operand(const Scope& scope, FormId form) {
  return Reader(scope).any(form);
}

std::optional<Expression> read_condition(const Scope& scope, FormId form) {
  Operand value = Reader(scope).condition(form);
  if (value.type == Type::Broken) return std::nullopt;
  return std::move(value.value);
}

std::optional<StateAssignment> read_assignment(const Scope& scope,
                                               FormId form) {
  const Reading& reading = scope.reading;
  assert(is_assignment(reading, form));
  const std::vector<FormId>& items = reading.form(form).items;
  if (items.size() != 3 || !reading.form(items[1]).is_word()) {
    reading.error(reading.forms.head(form)->span, "BT1009",
                  "`:=` takes a variable and a value", "",
                  "write `(:= level (+ level 1))`");
    return std::nullopt;
  }
  const Form& name = reading.form(items[1]);
  if (scope.bindings &&
      scope.bindings->by_key.contains(name_key(without_dollar(name.text)))) {
    reading.error(name.span, "BT1016",
                  fmt::format("`{}` cannot be assigned", name.text),
                  "it is an argument of the SubTree");
    return std::nullopt;
  }
  const auto variable = scope.variables.find(reading, name);
  if (!variable) return std::nullopt;
  const StateVariable& target = scope.variables[*variable];
  Reader reader(scope);
  Operand value = target.is_enumeration() ? reader.state(items[2], *variable)
                                          : reader.number(items[2]);
  if (value.type == Type::Broken) return std::nullopt;
  if (target.is_enumeration() || scope.variables.is_broken(*variable)) {
    return StateAssignment{*variable, std::move(value.value), name.span};
  }
  auto counted = counted_value(reading, target, value);
  if (!counted) return std::nullopt;
  return StateAssignment{*variable, std::move(counted->value), name.span,
                         std::move(counted->fits)};
}

}  // namespace btcheck::btf

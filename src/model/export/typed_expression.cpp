// SPDX-License-Identifier: MIT
//
// Expressions of a network in languages that tell truth, numbers and
// enumerations apart.
//
// Here everything is an integer; there each part has a kind, and where another
// one is needed it is converted: a number to truth by `x != 0`, truth to a
// number by `t ? 1 : 0`. An enumeration stays one only where it is compared
// with its own values; elsewhere it becomes its number. A division by zero is 0
// here and an error there, so a divisor that can be zero is replaced. Ranges
// are kept as in promela_expression.cpp, for the same reason.
#include "model/export/typed_expression.hpp"

#include <fmt/format.h>

#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "model/export/value_range.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kLongest = 200'000;  // characters
constexpr int kOr = 1;
constexpr int kAnd = 2;
constexpr int kComparison = 3;
constexpr int kSum = 4;
constexpr int kProduct = 5;
constexpr int kUnary = 6;
constexpr int kOperand = 7;

enum class Kind : std::uint8_t { Truth, Number, Enumeration };

struct Part {
  std::string text;
  int tightness = kOperand;
  Kind kind = Kind::Number;
  ValueRange range;
  VariableId variable{};                 // Enumeration
  std::optional<std::int64_t> constant;  // Number
};

std::string enclosed(const Part& part, int tighter_than) {
  return part.tightness > tighter_than ? part.text : "(" + part.text + ")";
}

bool is_comparison(Operation operation) {
  return operation >= Operation::Equal && operation <= Operation::GreaterEqual;
}

class Printer {
 public:
  Printer(const Network& network, const TypedLanguage& language)
      : network_(network), language_(language), signs_(language.signs()) {}

  // False when something in it cannot be said exactly.
  bool run(const Expression& expression) {
    if (expression.is_true()) {
      stack_.push_back(constant(1));
      return true;
    }
    for (const Term& term : expression.terms()) {
      push(term);
      const Part& made = stack_.back();
      if (!made.range.fits() || made.text.size() > kLongest) return false;
    }
    assert(stack_.size() == 1);
    return true;
  }

  std::string condition() { return truth(pop()).text; }

  std::string value(VariableId of) {
    const Part made = pop();
    if (!language_.is_enumeration(of)) return number(made).text;
    if (made.constant && in_domain(of, *made.constant)) {
      return language_.value(of, static_cast<int>(*made.constant));
    }
    if (made.kind == Kind::Enumeration && same_domain(made.variable, of)) {
      return made.text;
    }
    return language_.value_of(of, number(made).text);
  }

 private:
  static Part constant(std::int64_t value) {
    return {std::to_string(value), value < 0 ? kUnary : kOperand,
            Kind::Number,          {value, value},
            VariableId{},          value};
  }

  Part variable(VariableId id) const {
    const Variable& read = network_.variable(id);
    return {language_.variable(id),
            kOperand,
            language_.is_enumeration(id) ? Kind::Enumeration : Kind::Number,
            {read.min, read.max},
            id,
            std::nullopt};
  }

  bool in_domain(VariableId id, std::int64_t value) const {
    return value >= network_.variable(id).min &&
           value <= network_.variable(id).max;
  }

  // Two variables whose values are the same by name.
  bool same_domain(VariableId a, VariableId b) const {
    return a == b || (network_.variable(a).role == VariableRole::Status &&
                      network_.variable(b).role == VariableRole::Status);
  }

  Part truth(const Part& part) const {
    if (part.kind == Kind::Truth) return part;
    Part made{"", kOperand, Kind::Truth, {0, 1}, {}, {}};
    if (part.constant) {
      made.text = *part.constant != 0 ? signs_.truth : signs_.falsehood;
      return made;
    }
    return compared(Operation::NotEqual, part, constant(0));
  }

  Part number(const Part& part) const {
    Part made = part;
    made.kind = Kind::Number;
    if (part.kind == Kind::Truth) {
      made.text = "(" + part.text + " ? 1 : 0)";
      made.tightness = kOperand;
    } else if (part.kind == Kind::Enumeration) {
      made.text = language_.number_of(part.variable);
      made.tightness = kOperand;
    }
    return made;
  }

  Part negated(const Part& part) const {
    return {std::string(signs_.negation) + enclosed(part, kUnary),
            kUnary,
            Kind::Truth,
            {0, 1},
            {},
            {}};
  }

  Part joined(Operation operation, const Part& a, const Part& b) const {
    const bool is_and = operation == Operation::And;
    const int tightness = is_and ? kAnd : kOr;
    // A chain needs no parentheses; & within | gets them all the same.
    const auto side = [&](const Part& part) {
      return part.tightness == tightness ? part.text : enclosed(part, kAnd);
    };
    return {side(truth(a)) +
                std::string(is_and ? signs_.conjunction : signs_.disjunction) +
                side(truth(b)),
            tightness,
            Kind::Truth,
            {0, 1},
            {},
            {}};
  }

  Part compared(Operation operation, Part a, Part b) const {
    const bool is_equality =
        operation == Operation::Equal || operation == Operation::NotEqual;
    const bool are_alike = a.kind == b.kind && a.kind != Kind::Enumeration;
    if (!is_equality || !(are_alike || named(a, b) || named(b, a))) {
      a = number(a);
      b = number(b);
    }
    const bool is_negated =
        operation == Operation::NotEqual && signs_.differs.empty();
    Part made{enclosed(a, kComparison) +
                  comparison_sign(is_negated ? Operation::Equal : operation) +
                  enclosed(b, kComparison),
              kComparison,
              Kind::Truth,
              {0, 1},
              {},
              {}};
    return is_negated ? negated(made) : made;
  }

  std::string comparison_sign(Operation operation) const {
    switch (operation) {
      case Operation::NotEqual:
        return std::string(signs_.differs);
      case Operation::Less:
        return " < ";
      case Operation::LessEqual:
        return " <= ";
      case Operation::Greater:
        return " > ";
      case Operation::GreaterEqual:
        return " >= ";
      default:
        return " = ";
    }
  }

  // An enumeration beside one of its values, which gets its name, or beside
  // another variable with the same values.
  bool named(const Part& enumeration, Part& other) const {
    if (enumeration.kind != Kind::Enumeration) return false;
    if (other.kind == Kind::Enumeration) {
      return same_domain(enumeration.variable, other.variable);
    }
    const VariableId id = enumeration.variable;
    if (!other.constant || !in_domain(id, *other.constant)) return false;
    other.text = language_.value(id, static_cast<int>(*other.constant));
    other.tightness = kOperand;
    return true;
  }

  Part calculated(Operation operation, const Part& left,
                  const Part& right) const {
    const Part a = number(left);
    Part b = number(right);
    Part made{"",
              operation == Operation::Add || operation == Operation::Subtract
                  ? kSum
                  : kProduct,
              Kind::Number,
              range_of(operation, a.range, b.range),
              {},
              {}};
    const bool divides =
        operation == Operation::Divide || operation == Operation::Modulo;
    const std::string divisor = enclosed(b, kComparison);
    const bool may_fail = divides && b.range.has_zero();
    if (may_fail) {
      b.text = fmt::format("({0} = 0 ? 1 : {0})", divisor);
      b.tightness = kOperand;
    }
    made.text = enclosed(a, made.tightness - 1) + sign(operation) +
                enclosed(b, made.tightness);
    if (may_fail) {
      made.text = fmt::format("({} = 0 ? 0 : {})", divisor, made.text);
      made.tightness = kOperand;
    }
    return made;
  }

  std::string sign(Operation operation) const {
    switch (operation) {
      case Operation::Add:
        return " + ";
      case Operation::Subtract:
        return " - ";
      case Operation::Multiply:
        return " * ";
      case Operation::Divide:
        return " / ";
      default:
        return std::string(signs_.modulo);
    }
  }

  void push(const Term& term) {
    if (term.operation == Operation::Constant) {
      stack_.push_back(constant(term.operand));
    } else if (term.operation == Operation::Variable) {
      stack_.push_back(
          variable(VariableId{static_cast<std::uint32_t>(term.operand)}));
    } else if (term.operation == Operation::Not) {
      stack_.push_back(negated(truth(pop())));
    } else if (term.operation == Operation::Negate) {
      const Part of = number(pop());
      stack_.push_back({"-" + enclosed(of, kUnary),
                        kUnary,
                        Kind::Number,
                        range_of(Operation::Negate, {}, of.range),
                        {},
                        {}});
    } else {
      const Part right = pop();
      const Part left = pop();
      stack_.push_back(binary(term.operation, left, right));
    }
  }

  Part binary(Operation operation, const Part& left, const Part& right) const {
    if (operation == Operation::And || operation == Operation::Or) {
      return joined(operation, left, right);
    }
    return is_comparison(operation) ? compared(operation, left, right)
                                    : calculated(operation, left, right);
  }

  Part pop() {
    Part top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  const Network& network_;
  const TypedLanguage& language_;
  TypedLanguage::Signs signs_;
  std::vector<Part> stack_;
};

}  // namespace

TypedExpression typed_condition(const Network& network,
                                const TypedLanguage& language,
                                const Expression& expression) {
  Printer printer(network, language);
  if (!printer.run(expression)) return {"", false};
  return {printer.condition()};
}

TypedExpression typed_value(const Network& network,
                            const TypedLanguage& language,
                            const Expression& expression, VariableId of) {
  Printer printer(network, language);
  if (!printer.run(expression)) return {"", false};
  return {printer.value(of)};
}

}  // namespace btcheck

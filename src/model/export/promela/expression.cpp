// SPDX-License-Identifier: MIT
//
// Expressions of a network in Promela's syntax.
//
// Both languages truncate division towards zero, and truth is 1. Two things
// differ. Promela computes in 32 bits that wrap, we in 64 that saturate: so
// the range of every part is computed along with its text (value_range.hpp),
// and where all ranges fit both agree. And a division
// by zero, which is 0 here, would end SPIN: where the divisor can be zero, d
// becomes d + (d == 0), and the quotient is multiplied by (d != 0).
#include "model/export/promela/expression.hpp"

#include <cassert>

#include "model/export/value_range.hpp"

namespace btcheck {
namespace {

// How an operation is written: tighter binds tighter.
struct Sign {
  std::string_view text;
  int tightness;
};
constexpr std::size_t kLongest = 200'000;  // characters
constexpr int kLogical = 2;
constexpr int kComparison = 3;
constexpr int kUnary = 6;
constexpr int kOperand = 7;

Sign sign_of(Operation operation) {
  switch (operation) {
    case Operation::Or:
      return {" || ", 1};
    case Operation::And:
      return {" && ", kLogical};
    case Operation::Equal:
      return {" == ", kComparison};
    case Operation::NotEqual:
      return {" != ", kComparison};
    case Operation::Less:
      return {" < ", kComparison};
    case Operation::LessEqual:
      return {" <= ", kComparison};
    case Operation::Greater:
      return {" > ", kComparison};
    case Operation::GreaterEqual:
      return {" >= ", kComparison};
    case Operation::Add:
      return {" + ", 4};
    case Operation::Subtract:
      return {" - ", 4};
    case Operation::Multiply:
      return {" * ", 5};
    case Operation::Divide:
      return {" / ", 5};
    case Operation::Modulo:
      return {" % ", 5};
    case Operation::Negate:
      return {"-", kUnary};
    case Operation::Not:
      return {"!", kUnary};
    default:
      assert(false && "an operation with operands");
      return {"", kOperand};
  }
}

struct Part {
  std::string text;
  int tightness = kOperand;
  ValueRange range;
  const Term* term = nullptr;  // its only one, if it has only one
};

std::string enclosed(const Part& part, int tighter_than) {
  return part.tightness > tighter_than ? part.text : "(" + part.text + ")";
}

Part quotient(Operation operation, const Part& left, const Part& right) {
  const Sign sign = sign_of(operation);
  std::string divisor = enclosed(right, sign.tightness);
  std::string factor;
  if (right.range.has_zero()) {
    const std::string compared = enclosed(right, kComparison);
    divisor = "(" + compared + " + (" + compared + " == 0))";
    // What is left over after division by 1 is 0 as it is.
    if (operation == Operation::Divide) factor = " * (" + compared + " != 0)";
  }
  return {enclosed(left, sign.tightness - 1) + std::string(sign.text) +
              divisor + factor,
          sign.tightness, range_of(operation, left.range, right.range)};
}

Part binary(Operation operation, const Part& left, const Part& right) {
  if (operation == Operation::Divide || operation == Operation::Modulo) {
    return quotient(operation, left, right);
  }
  const Sign sign = sign_of(operation);
  const bool is_comparison = sign.tightness == kComparison;
  // gcc warns of && within || without parentheses, not of a chain.
  const int around = operation == Operation::Or ? kLogical : sign.tightness;
  const bool continues = left.tightness == sign.tightness && !is_comparison;
  return {(continues ? left.text : enclosed(left, around)) +
              std::string(sign.text) + enclosed(right, around),
          sign.tightness, range_of(operation, left.range, right.range)};
}

class Printer {
 public:
  Printer(const Network& network, const PromelaNames& names)
      : network_(network), names_(names) {}

  PromelaExpression run(const Expression& expression) {
    if (expression.is_true()) return {"1"};
    for (const Term& term : expression.terms()) {
      push(term);
      const Part& made = stack_.back();
      if (!made.range.fits() || made.text.size() > kLongest) {
        return {"", false};
      }
    }
    assert(stack_.size() == 1);
    return {std::move(stack_.back().text)};
  }

 private:
  void push(const Term& term) {
    if (term.operation == Operation::Constant) {
      stack_.push_back({std::to_string(term.operand),
                        term.operand < 0 ? kUnary : kOperand,
                        {term.operand, term.operand},
                        &term});
    } else if (term.operation == Operation::Variable) {
      const Variable& variable = network_.variable(id_of(term));
      stack_.push_back({names_.variable(id_of(term)),
                        kOperand,
                        {variable.min, variable.max},
                        &term});
    } else if (arity(term.operation) == 1) {
      const Part of = pop();
      stack_.push_back(
          {std::string(sign_of(term.operation).text) + enclosed(of, kUnary),
           kUnary, range_of(term.operation, {}, of.range)});
    } else {
      Part right = pop();
      Part left = pop();
      if (sign_of(term.operation).tightness == kComparison) {
        name_value(left, right);
        name_value(right, left);
      }
      stack_.push_back(binary(term.operation, left, right));
    }
  }

  Part pop() {
    Part top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  static VariableId id_of(const Term& term) {
    return VariableId{static_cast<std::uint32_t>(term.operand)};
  }

  // A constant beside a variable gets the name of that variable's value.
  void name_value(const Part& variable, Part& constant) const {
    if (!variable.term || !constant.term ||
        variable.term->operation != Operation::Variable ||
        constant.term->operation != Operation::Constant) {
      return;
    }
    constant.text = names_.value(id_of(*variable.term), constant.term->operand);
  }

  const Network& network_;
  const PromelaNames& names_;
  std::vector<Part> stack_;
};

}  // namespace

PromelaExpression promela_expression(const Network& network,
                                     const PromelaNames& names,
                                     const Expression& expression) {
  return Printer(network, names).run(expression);
}

}  // namespace btcheck

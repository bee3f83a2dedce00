// SPDX-License-Identifier: MIT
//
// Integer and truth-valued expressions over variables, in postfix order.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace btcheck {

// What a term does with the stack. Truth is 1, falsehood 0.
enum class Operation : std::uint8_t {
  Constant,  // pushes operand
  Variable,  // pushes the value of variable number operand
  Status,    // pushes the return status of node number operand (trees only:
             // a network has ordinary variables for them)
  Negate,
  Not,
  Add,
  Subtract,
  Multiply,
  Divide,  // truncates towards zero; 0 when the divisor is 0 (see divisors)
  Modulo,  // has the sign of the dividend; 0 when the divisor is 0
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  And,
  Or,
};

constexpr bool is_equality(Operation operation) {
  return operation == Operation::Equal || operation == Operation::NotEqual;
}
constexpr bool is_comparison(Operation operation) {
  return operation >= Operation::Equal && operation <= Operation::GreaterEqual;
}
constexpr bool divides(Operation operation) {
  return operation == Operation::Divide || operation == Operation::Modulo;
}

struct Term {
  Operation operation = Operation::Constant;
  std::int32_t operand = 0;

  friend bool operator==(const Term&, const Term&) = default;
};

// How many values a term takes from the stack: 0, 1 or 2.
int arity(Operation operation);

// The result of an operation; a unary one ignores `left`. Arithmetic saturates
// at the ends of 64 bits.
std::int64_t apply(Operation operation, std::int64_t left, std::int64_t right);

// An expression as the list of its terms in postfix order, so that nothing
// ever recurses on it. An empty one is the constant true (1).
class Expression {
 public:
  Expression() = default;
  static Expression constant(std::int32_t value);
  static Expression variable(std::int32_t number);
  static Expression status(std::int32_t node);
  static Expression unary(Operation operation, Expression of);
  static Expression binary(Operation operation, Expression left,
                           Expression right);

  std::span<const Term> terms() const { return terms_; }
  bool is_true() const { return terms_.empty(); }
  // The operand of the only term, where that is one of this kind.
  std::optional<std::int32_t> only(Operation kind) const;

  // The value under an assignment of the variables: `read` is called with each
  // Variable or Status term.
  std::int64_t evaluate(
      const std::function<std::int64_t(const Term&)>& read) const;

  // Every Variable and Status term replaced by what `with` makes of it.
  Expression replaced(const std::function<Expression(const Term&)>& with) const;

  // The sub-expressions that stand as divisors, but for numbers other than 0.
  std::vector<Expression> divisors() const;

  // The operands of the outermost conjunction, left to right; the expression
  // itself when it is none, nothing when it is true.
  std::vector<Expression> conjuncts() const;

  // Infix text: `leaf` prints Variable and Status terms; `constant_beside`
  // prints a constant that is compared with that variable (its value's name).
  std::string text(
      const std::function<std::string(const Term&)>& leaf,
      const std::function<std::string(const Term& beside, std::int32_t value)>&
          constant_beside) const;

  friend bool operator==(const Expression&, const Expression&) = default;

 private:
  explicit Expression(std::vector<Term> terms) : terms_(std::move(terms)) {}
  // The sub-expression that ends at terms_[last], and where it starts.
  Expression ending_at(std::size_t last) const;
  std::size_t start_of(std::size_t last) const;

  std::vector<Term> terms_;
};

// The value of terms that are an expression or a part of one, likewise.
std::int64_t value_of(std::span<const Term> terms,
                      const std::function<std::int64_t(const Term&)>& read);

// "1.5" for 15 with one decimal.
std::string decimal_text(std::int64_t value, int decimals);
// 10^exponent, at most 10^18.
std::int64_t power_of_ten(int exponent);

// True for a constant other than 0, and for the empty expression.
bool is_always(const Expression& expression);
// True for the constant 0.
bool is_never(const Expression& expression);

// Conjunction that drops constant-true operands.
Expression both(Expression left, Expression right);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Whether all values of an expression are multiples of a number is told by
// Granger's arithmetical congruences (1989): for each part a residue and a
// modulus, such that all of its values are the one modulo the other. Here the
// modulus always divides the number that is asked for, so that the residue is
// known for certain where both are the same.
#include "model/tree/scale.hpp"

#include <cassert>
#include <limits>
#include <numeric>
#include <vector>

namespace btcheck {
namespace {

std::int64_t floor_of(std::int64_t value, std::int64_t unit) {
  return value / unit - (value % unit < 0 ? 1 : 0);
}

struct Congruence {
  std::int64_t residue = 0;
  std::int64_t modulus = 1;
};

class Multiples {
 public:
  explicit Multiples(std::int64_t of) : of_(of) {}

  OnSteps has(const Expression& expression) {
    for (const Term& term : expression.terms()) push(term);
    assert(stack_.size() == 1);
    const Congruence whole = stack_.back();
    if (whole.residue % whole.modulus != 0) return OnSteps::Never;
    return whole.modulus == of_ ? OnSteps::Always : OnSteps::Sometimes;
  }

 private:
  void push(const Term& term) {
    if (term.operation == Operation::Constant) {
      stack_.push_back({term.operand % of_, of_});
    } else if (arity(term.operation) == 0) {
      stack_.push_back({});
    } else {
      const Congruence right = pop();
      const Congruence left = arity(term.operation) == 1 ? right : pop();
      stack_.push_back(result(term.operation, left, right));
    }
  }

  Congruence result(Operation operation, Congruence left,
                    Congruence right) const {
    const std::int64_t both = std::gcd(left.modulus, right.modulus);
    if (operation == Operation::Negate) return {-right.residue, right.modulus};
    if (operation == Operation::Add) {
      return {(left.residue + right.residue) % of_, both};
    }
    if (operation == Operation::Subtract) {
      return {(left.residue - right.residue) % of_, both};
    }
    if (operation != Operation::Multiply) return {};
    // (a + m i) (b + n j) = a b + a n j + b m i + m n i j
    std::int64_t modulus =
        std::gcd(left.residue * right.modulus, right.residue * left.modulus);
    modulus = std::gcd(modulus, left.modulus * right.modulus % of_);
    return {left.residue * right.residue % of_, std::gcd(modulus, of_)};
  }

  Congruence pop() {
    const Congruence top = stack_.back();
    stack_.pop_back();
    return top;
  }

  std::int64_t of_;
  std::vector<Congruence> stack_;
};

Expression scaled(Operation operation, Expression value, std::int64_t by) {
  if (by == 1) return value;
  return Expression::binary(
      operation, std::move(value),
      Expression::constant(static_cast<std::int32_t>(by)));
}

}  // namespace

std::string Scale::text(std::int64_t n) const {
  return decimal_text(n * step, decimals);
}

std::optional<std::int64_t> bound_of(Operation relation, const Scale& scale,
                                     Decimal number) {
  const std::int64_t unit = scale.step * power_of_ten(number.decimals);
  const std::int64_t wanted = number.digits * power_of_ten(scale.decimals);
  const std::int64_t below = floor_of(wanted, unit);
  if (below * unit == wanted) return below;
  if (is_equality(relation)) return std::nullopt;
  const bool rounds_up =
      relation == Operation::Less || relation == Operation::GreaterEqual;
  return rounds_up ? below + 1 : below;
}

// value / 10^decimals = n * step / 10^scale.decimals, so n = value * up / down.
Counted counted_in(const Scale& scale, const Expression& value, int decimals) {
  std::int64_t up = power_of_ten(scale.decimals);
  std::int64_t down = scale.step * power_of_ten(decimals);
  const std::int64_t common = std::gcd(up, down);
  up /= common;
  down /= common;
  if (down > std::numeric_limits<std::int32_t>::max()) {
    return {OnSteps::TooFine, {}, {}};
  }
  Counted counted{Multiples(down).has(value), value, {}};
  if (counted.is == OnSteps::Sometimes) {
    counted.fits = Expression::binary(Operation::Equal,
                                      scaled(Operation::Modulo, value, down),
                                      Expression::constant(0));
  }
  counted.value =
      scaled(Operation::Multiply,
             scaled(Operation::Divide, std::move(counted.value), down), up);
  return counted;
}

}  // namespace btcheck

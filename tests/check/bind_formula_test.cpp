// SPDX-License-Identifier: MIT
//
// Formulas whose greatest parts without temporal operators become propositions.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/bind/bind.hpp"
#include "check/checked.hpp"

namespace btcheck::bind_formula_test {
namespace {

// p, q, r: whether variable 0, 1, 2 is 1. The fourth atom holds when dead.
std::vector<Proposition> atoms() {
  std::vector<Proposition> made;
  for (std::int32_t v = 0; v < 3; ++v) {
    made.push_back({{Expression::variable(v), {}}, {}, {}});
  }
  made.push_back({{Expression::constant(0), Expression::constant(1)}, {}, {}});
  return made;
}

std::string plain_text(const Expression& expression) {
  return expression.text(
      [](const Term& term) {
        return std::string(1, static_cast<char>('p' + term.operand));
      },
      [](const Term&, std::int32_t value) { return std::to_string(value); });
}

struct Formulas {
  FormulaPool pool;
  FormulaId p = pool.atom(0), q = pool.atom(1), r = pool.atom(2),
            dead = pool.atom(3);

  FormulaId make(FormulaKind kind, FormulaId left) {
    return pool.unary(kind, left);
  }
  FormulaId make(FormulaKind kind, FormulaId left, FormulaId right) {
    return pool.binary(kind, left, right);
  }
};

// The formula over numbered propositions, then each of them.
std::string abstraction(const FormulaPool& pool, FormulaId formula) {
  const auto bound = bind_formula(pool, formula, atoms());
  REQUIRE(bound.has_value());
  std::string text = bound->pool.text(
      bound->formula, [](std::uint32_t n) { return std::to_string(n); });
  for (const Proposition& proposition : bound->propositions) {
    text += "; " + plain_text(proposition.of.expression);
    if (proposition.of.when_dead) {
      text += " | " + plain_text(*proposition.of.when_dead);
    }
  }
  return text;
}

TEST_CASE("what holds no temporal operator is one proposition") {
  Formulas f;
  const FormulaId both =
      f.make(FormulaKind::And, f.p, f.make(FormulaKind::Not, f.q));
  const FormulaId later = f.make(FormulaKind::Eventually, f.r);
  const FormulaId whole =
      f.make(FormulaKind::Always, f.make(FormulaKind::Implies, both, later));
  CHECK(abstraction(f.pool, both) == "0; p and not q");
  CHECK(abstraction(f.pool, later) == "<> 0; r");
  const std::string text = abstraction(f.pool, whole);
  CHECK((text == "[] (0 => <> 1); p and not q; r" ||
         text == "[] (1 => <> 0); r; p and not q"));
}

TEST_CASE("a part that occurs twice is one proposition") {
  Formulas f;
  const FormulaId once = f.make(FormulaKind::Eventually, f.p);
  const FormulaId twice =
      f.make(FormulaKind::Or, once, f.make(FormulaKind::Always, f.p));
  CHECK(abstraction(f.pool, twice) == "<> 0 or [] 0; p");
}

TEST_CASE("every temporal operator is kept") {
  Formulas f;
  for (const FormulaKind kind :
       {FormulaKind::Until, FormulaKind::WeakUntil, FormulaKind::Release}) {
    const auto bound = bind_formula(f.pool, f.make(kind, f.p, f.q), atoms());
    REQUIRE(bound.has_value());
    CHECK(bound->pool[bound->formula].kind == kind);
    CHECK(bound->propositions.size() == 2);
  }
  for (const FormulaKind kind :
       {FormulaKind::Next, FormulaKind::Eventually, FormulaKind::Always}) {
    const auto bound = bind_formula(f.pool, f.make(kind, f.p), atoms());
    REQUIRE(bound.has_value());
    CHECK(bound->pool[bound->formula].kind == kind);
  }
}

TEST_CASE("true and false stay constants") {
  Formulas f;
  const FormulaId always =
      f.make(FormulaKind::Until, f.pool.constant(true), f.pool.constant(false));
  const auto bound = bind_formula(f.pool, always, atoms());
  REQUIRE(bound.has_value());
  CHECK(bound->propositions.empty());
  CHECK(abstraction(f.pool, always) == "true U false");
}

TEST_CASE("a combination with an atom of dead states knows both cases") {
  Formulas f;
  CHECK(abstraction(f.pool, f.make(FormulaKind::And, f.p, f.dead)) ==
        "0; p and 0 | p");
  CHECK(abstraction(f.pool, f.make(FormulaKind::Not, f.dead)) ==
        "0; not 0 | not 1");
  CHECK(abstraction(f.pool, f.make(FormulaKind::Implies, f.dead, f.q)) ==
        "0; not 0 or q | not 1 or q");
}

TEST_CASE("a predicate has the truth of its formula") {
  Formulas f;
  const FormulaKind kinds[] = {FormulaKind::And, FormulaKind::Or,
                               FormulaKind::Implies, FormulaKind::Equivalent};
  for (const FormulaKind kind : kinds) {
    const auto predicate =
        predicate_of(f.pool, f.make(kind, f.p, f.q), atoms());
    REQUIRE(predicate.has_value());
    for (int values = 0; values < 4; ++values) {
      const bool p = (values & 1) != 0, q = (values & 2) != 0;
      const bool expected = kind == FormulaKind::And       ? p && q
                            : kind == FormulaKind::Or      ? p || q
                            : kind == FormulaKind::Implies ? !p || q
                                                           : p == q;
      const std::int64_t value =
          predicate->expression.evaluate([&](const Term& term) -> std::int64_t {
            return term.operand == 0 ? p : q;
          });
      CHECK((value != 0) == expected);
    }
  }
}

TEST_CASE("a formula with too many propositions is refused") {
  FormulaPool pool;
  std::vector<Proposition> many;
  FormulaId all = pool.constant(true);
  for (std::uint32_t n = 0; n < 65; ++n) {
    many.push_back(
        {{Expression::variable(static_cast<std::int32_t>(n)), {}}, {}, {}});
    all = pool.binary(FormulaKind::And, all,
                      pool.unary(FormulaKind::Eventually, pool.atom(n)));
    CHECK(bind_formula(pool, all, many).has_value() == (n < 64));
  }
}

TEST_CASE("a predicate too large to be written out is refused") {
  FormulaPool pool;
  FormulaId deep = pool.atom(0);
  for (int n = 0; n < 20; ++n) {
    deep = pool.binary(FormulaKind::Equivalent, deep,
                       pool.unary(FormulaKind::Not, deep));
  }
  CHECK(!predicate_of(pool, deep, atoms()).has_value());
  CHECK(!bind_formula(pool, pool.unary(FormulaKind::Always, deep), atoms())
             .has_value());
}

}  // namespace
}  // namespace btcheck::bind_formula_test

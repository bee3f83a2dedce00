// SPDX-License-Identifier: MIT
//
// Negation normal form and the laws of rewriting.
#include "ltl/formula/normal_form.hpp"

#include <doctest/doctest.h>

#include "ltl/formula_text.hpp"

namespace btcheck::normal_form_test {

namespace {

// Formulas in the normal form are written with `true U` for <> and `false V`
// for [] in the expectations; this reads both.
FormulaId normal(FormulaPool& pool, std::string_view text) {
  return negation_normal_form(pool, parse(pool, text));
}

// The text of a formula when simplified on its own.
std::string simplified(std::string_view text) {
  FormulaPool pool;
  return pool.text(simplify(pool, parse(pool, text)), [](std::uint32_t atom) {
    return std::string(1, char('a' + int(atom)));
  });
}

}  // namespace

TEST_CASE("negation moves to the atoms") {
  FormulaPool pool;
  CHECK(normal(pool, "!(a U !b)") == parse(pool, "!a V b"));
  CHECK(normal(pool, "!(a && X b)") == parse(pool, "!a || X !b"));
  CHECK(normal(pool, "![]<>a") == parse(pool, "true U (false V !a)"));
  CHECK(normal(pool, "!!a") == parse(pool, "a"));
  CHECK(normal(pool, "!(a -> b)") == parse(pool, "a && !b"));
  CHECK(normal(pool, "a W b") == parse(pool, "b V (a || b)"));
  CHECK(normal(pool, "a <-> b") == parse(pool, "(a && b) || (!a && !b)"));
}

TEST_CASE("nested equivalences stay small as a graph") {
  FormulaPool pool;
  FormulaId id = pool.atom(0);
  for (std::uint32_t i = 1; i < 30; ++i) {
    id = pool.binary(FormulaKind::Equivalent, id, pool.atom(i));
  }
  CHECK(pool.nodes(negation_normal_form(pool, id)).size() < 300);
}

TEST_CASE("rewriting finds the smaller formula") {
  const char* const laws[][2] = {{"<><>a", "<>a"},
                                 {"[][]a", "[]a"},
                                 {"[]<>[]a", "<>[]a"},
                                 {"<>[]<>a", "[]<>a"},
                                 {"X[]<>a", "[]<>a"},
                                 {"[]<>X a", "[]<>a"},
                                 {"a && !a", "false"},
                                 {"a || true", "true"},
                                 {"(a U b) && b", "b"},
                                 {"(a U b) || b", "a U b"},
                                 {"a U (a U b)", "a U b"},
                                 {"<>(a U b)", "<>b"},
                                 {"[](a V b)", "[]b"},
                                 {"!b U b", "<>b"},
                                 {"(a || b) U b", "a U b"},
                                 {"(a && !b) U b", "a U b"},
                                 {"<>a || <>b", "<>(a || b)"},
                                 {"[]a && []b", "[](a && b)"},
                                 {"(a U c) && (b U c)", "(a && b) U c"},
                                 {"X a && X b", "X(a && b)"},
                                 {"X a U X b", "X(a U b)"},
                                 {"<>(a && []<>b)", "[]<>b && <>a"},
                                 {"[](a || []<>b)", "[]<>b || []a"},
                                 {"[]<>(a && <>b)", "[]<>b && []<>a"},
                                 {"[]<>a || []<>b", "[]<>(a || b)"},
                                 {"<>[]a && <>[]b", "<>[](a && b)"},
                                 {"(a W b) && <>b", "a U b"},
                                 {"(a U b) || []a", "a W b"},
                                 {"[]a && <>a", "[]a"},
                                 {"[]a && <>!a", "false"},
                                 {"<>a || []!a", "true"},
                                 {"(a -> b) && a && !b", "false"}};
  for (const auto& [written, expected] : laws) {
    const std::string law = written;
    CAPTURE(law);
    CHECK(simplified(written) == simplified(expected));
    FormulaPool pool;
    CHECK(pool.nodes(simplify(pool, parse(pool, written))).size() <=
          pool.nodes(normal(pool, expected)).size());
  }
}

TEST_CASE("implication is found by syntax") {
  NormalPool pool;
  const FormulaId a = pool.atom(0);
  const FormulaId b = pool.atom(1);
  const FormulaId both = pool.make(FormulaKind::And, a, b);
  const FormulaId until = pool.make(FormulaKind::Until, a, b);
  const FormulaId always =
      pool.make(FormulaKind::Release, pool.constant(false), a);
  CHECK(pool.implies(both, a));
  CHECK(pool.implies(b, until));
  CHECK(pool.implies(always, pool.make(FormulaKind::Next, a, {})));
  CHECK_FALSE(pool.implies(a, both));
  CHECK_FALSE(pool.implies(until, b));
  CHECK(pool.negation(pool.negation(until)) == until);
}

TEST_CASE("deep formulas are rewritten without deep recursion") {
  FormulaPool pool;
  FormulaId id = pool.atom(0);
  for (int i = 0; i < 20000; ++i) {
    id = pool.unary(i % 2 == 0 ? FormulaKind::Next : FormulaKind::Eventually,
                    id);
  }
  CHECK(pool.nodes(simplify(pool, id)).size() <= 40000);
}

}  // namespace btcheck::normal_form_test

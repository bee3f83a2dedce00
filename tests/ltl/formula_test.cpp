// SPDX-License-Identifier: MIT
//
// Formulas: sharing, questions about them, and their text.
#include "ltl/formula/formula.hpp"

#include <doctest/doctest.h>

#include "ltl/formula_text.hpp"

namespace btcheck::formula_test {

namespace {

// The text of a formula with atoms a, b, … and, for atom 25, `fls > 3`.
std::string shown(std::string_view text) {
  FormulaPool pool;
  return pool.text(parse(pool, text), [](std::uint32_t atom) {
    return atom == 25 ? "fls > 3" : std::string(1, char('a' + int(atom)));
  });
}

}  // namespace

TEST_CASE("equal formulas have equal ids") {
  FormulaPool pool;
  const FormulaId first = parse(pool, "[](a -> <>b) U c");
  const std::size_t size = pool.size();
  CHECK(parse(pool, "[](a -> <>b) U c") == first);
  CHECK(pool.size() == size);
  CHECK(parse(pool, "[](a -> <>c) U c") != first);
}

TEST_CASE("a pool keeps its formulas apart when it grows") {
  FormulaPool pool;
  std::vector<FormulaId> ids;
  for (std::uint32_t i = 0; i < 1000; ++i) ids.push_back(pool.atom(i));
  for (std::uint32_t i = 0; i < 1000; ++i) CHECK(pool.atom(i) == ids[i]);
}

TEST_CASE("operands have smaller ids than their operator") {
  FormulaPool pool;
  const FormulaId id = parse(pool, "[](a -> (b U X c))");
  for (const FormulaId inner : pool.nodes(id)) {
    const FormulaNode& node = pool[inner];
    if (node.kind <= FormulaKind::Atom) continue;
    CHECK(index(node.left) < index(inner));
    CHECK(index(node.right) < index(inner));
  }
}

TEST_CASE("the nodes of a formula come once each, operands first") {
  FormulaPool pool;
  const FormulaId unrelated = parse(pool, "<> d");
  const FormulaId id = parse(pool, "(a && b) U (a && b)");
  const std::vector<FormulaId> nodes = pool.nodes(id);
  CHECK(nodes.size() == 4);
  CHECK(nodes.back() == id);
  CHECK(std::find(nodes.begin(), nodes.end(), unrelated) == nodes.end());
}

TEST_CASE("a formula knows its operators and atoms") {
  FormulaPool pool;
  CHECK(pool.is_state_formula(parse(pool, "!a && (b -> c <-> true)")));
  CHECK_FALSE(pool.is_state_formula(parse(pool, "a && <> b")));
  CHECK(pool.has_next(parse(pool, "[](a -> X b)")));
  CHECK_FALSE(pool.has_next(parse(pool, "[](a -> <> b)")));
  CHECK(pool.atoms(parse(pool, "d U (b && d)")) ==
        std::vector<std::uint32_t>{1, 3});
  CHECK(pool.atoms(pool.constant(true)).empty());
}

TEST_CASE("the text of a formula has the parentheses that tools differ on") {
  const char* const cases[][2] = {{"[](a -> <>b)", "[] (a => <> b)"},
                                  {"([]a) -> <>b", "[] a => <> b"},
                                  {"a -> (b -> c)", "a => (b => c)"},
                                  {"(a -> b) -> c", "(a => b) => c"},
                                  {"(a U b) U c", "(a U b) U c"},
                                  {"(a U b) && (c V d)", "(a U b) and (c R d)"},
                                  {"a W (b || c)", "a W (b or c)"},
                                  {"(a && b) || c", "(a and b) or c"},
                                  {"(a && b) && c", "a and b and c"},
                                  {"a && (b && c)", "a and (b and c)"},
                                  {"(a && b) -> (c || d)", "a and b => c or d"},
                                  {"(a && b) <-> c", "a and b <=> c"},
                                  {"!(a && X b)", "not (a and X b)"},
                                  {"!X[]<>a", "not X [] <> a"},
                                  {"[] z", "[] (fls > 3)"},
                                  {"z U a", "(fls > 3) U a"},
                                  {"z && a -> z", "fls > 3 and a => fls > 3"},
                                  {"true U false", "true U false"}};
  for (const auto& [written, expected] : cases) {
    CHECK(shown(written) == expected);
  }
}

TEST_CASE("a deep formula is written without recursion") {
  FormulaPool pool;
  FormulaId id = pool.atom(0);
  for (int i = 0; i < 200000; ++i) id = pool.unary(FormulaKind::Next, id);
  const std::string text =
      pool.text(id, [](std::uint32_t) { return std::string("a"); });
  CHECK(text.size() == 2 * 200000 + 1);
}

}  // namespace btcheck::formula_test

// SPDX-License-Identifier: MIT
//
// Random formulas of CTL: random formulas in which each temporal operator
// stands behind a quantifier. Two operators in three are temporal.
#include "reference/random_ctl.hpp"

#include <cstddef>

namespace btcheck::reference {

namespace {

constexpr FormulaKind kUnaryPath[] = {
    FormulaKind::Next, FormulaKind::Eventually, FormulaKind::Always};
constexpr FormulaKind kBinaryPath[] = {
    FormulaKind::Until, FormulaKind::WeakUntil, FormulaKind::Release};
constexpr FormulaKind kBoolean[] = {FormulaKind::And, FormulaKind::Or,
                                    FormulaKind::Implies,
                                    FormulaKind::Equivalent};

template <std::size_t N>
FormulaKind one_of(std::mt19937& random, const FormulaKind (&kinds)[N]) {
  return kinds[random() % N];
}

FormulaKind quantifier(std::mt19937& random) {
  return random() % 2 == 0 ? FormulaKind::ExistsPath : FormulaKind::ForAllPaths;
}

FormulaId leaf(FormulaPool& pool, std::mt19937& random, std::uint32_t atoms) {
  if (random() % 16 == 0) return pool.constant(random() % 2 == 0);
  return pool.atom(static_cast<std::uint32_t>(random() % atoms));
}

}  // namespace

FormulaId random_ctl(FormulaPool& pool, std::mt19937& random, int size,
                     std::uint32_t atoms) {
  if (size <= 1) return leaf(pool, random, atoms);
  const bool is_temporal = random() % 3 != 0;
  if (size == 2 || random() % 2 == 0) {
    const FormulaId of = random_ctl(pool, random, size - 1, atoms);
    if (!is_temporal) return pool.unary(FormulaKind::Not, of);
    const FormulaId path = pool.unary(one_of(random, kUnaryPath), of);
    return pool.unary(quantifier(random), path);
  }
  const int left_size =
      1 + static_cast<int>(random() % static_cast<unsigned>(size - 2));
  const FormulaId left = random_ctl(pool, random, left_size, atoms);
  const FormulaId right = random_ctl(pool, random, size - 1 - left_size, atoms);
  if (!is_temporal) return pool.binary(one_of(random, kBoolean), left, right);
  const FormulaId path = pool.binary(one_of(random, kBinaryPath), left, right);
  return pool.unary(quantifier(random), path);
}

}  // namespace btcheck::reference

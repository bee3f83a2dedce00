// SPDX-License-Identifier: MIT
//
// Which values of numbers nothing tells apart: the classes of the coarsest
// partition that every condition respects and every assignment keeps (Paige and
// Tarjan, SIAM J. Comput. 16(6), 1987). What holds of one value of a class, in
// any logic, holds of all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/tree/expression.hpp"
#include "model/tree/value_range.hpp"

namespace btcheck {

// An assignment of what is computed from a number.
struct NumberMove {
  std::optional<std::size_t> to;  // another number, or itself
  ValueRange within;              // what the target can hold
  std::vector<Term> value;        // over the number alone

  friend bool operator==(const NumberMove&, const NumberMove&) = default;
};

// A number, and all that is asked of it alone. Every Variable term is the
// number itself.
struct PartitionedNumber {
  ValueRange values;
  std::int64_t initial = 0;
  std::vector<std::vector<Term>> atoms = {};
  std::vector<NumberMove> moves = {};
  std::vector<std::int64_t> constants = {};  // it is assigned
  bool is_whole = false;                     // all its values are told apart

  void add_atom(std::span<const Term> atom);
  void add_move(NumberMove move);
};

// By number: one value of each class, ascending; the initial one, else one that
// is assigned, else the nearest to the initial one. Nothing where all values
// are told apart: where it says so, where the classes take too long to find,
// and where no number of `wanted` depends on it.
std::vector<std::optional<std::vector<int>>> representatives(
    std::vector<PartitionedNumber> numbers,
    std::span<const std::size_t> wanted);

}  // namespace btcheck

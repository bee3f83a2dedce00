// SPDX-License-Identifier: MIT
//
// Tables with a row for each value of an enumeration, as they are checked when
// they are compiled: a row that is forgotten or misplaced does not compile.
#pragma once

#include <cstddef>
#include <functional>

namespace btcheck {

// Whether row i is that of value i, as its column says: a member or a function.
template <class Table, class Column>
constexpr bool is_indexed(const Table& table, Column column) {
  std::size_t at = 0;
  for (const auto& row : table) {
    if (static_cast<std::size_t>(std::invoke(column, row)) != at++)
      return false;
  }
  return true;
}

// Whether no two rows have the same value there.
template <class Table, class Column>
constexpr bool is_unique(const Table& table, Column column) {
  for (const auto& row : table) {
    int count = 0;
    for (const auto& other : table) {
      count += std::invoke(column, row) == std::invoke(column, other) ? 1 : 0;
    }
    if (count != 1) return false;
  }
  return true;
}

}  // namespace btcheck

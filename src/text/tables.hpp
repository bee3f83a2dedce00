// SPDX-License-Identifier: MIT
//
// Tables with a row for each value of an enumeration, as they are checked when
// they are compiled: a row that is forgotten or misplaced does not compile.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>

namespace btcheck {

// Whether row i is that of value i, as this column says.
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
  for (auto row = std::begin(table); row != std::end(table); ++row) {
    for (auto other = std::begin(table); other != row; ++other) {
      if (std::invoke(column, *row) == std::invoke(column, *other)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace btcheck

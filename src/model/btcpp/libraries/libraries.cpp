// SPDX-License-Identifier: MIT
#include "model/btcpp/libraries/libraries.hpp"

#include <algorithm>

namespace btcheck::btcpp {
namespace {

const LibraryType* row_of(std::span<const LibraryType> rows,
                          std::string_view id) {
  const auto found = std::ranges::find(rows, id, &LibraryType::id);
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace

const LibraryType* library_type(std::string_view id, TypeForm form) {
  const LibraryType* row = row_of(behaviortree_ros2_types(), id);
  if (row != nullptr || form == TypeForm::Compact) return row;
  for (const auto rows :
       {moveit_pro_data(), moveit_pro_motion(), moveit_pro_trees()}) {
    row = row_of(rows, id);
    if (row != nullptr) break;
  }
  return row;
}

bool has_port(std::string_view column, std::string_view port) {
  while (!column.empty()) {
    const std::size_t end = std::min(column.find(' '), column.size());
    if (column.substr(0, end) == port) return true;
    column.remove_prefix(std::min(end + 1, column.size()));
  }
  return false;
}

}  // namespace btcheck::btcpp

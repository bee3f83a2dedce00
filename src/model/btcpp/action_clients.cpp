// SPDX-License-Identifier: MIT
#include "model/btcpp/action_clients.hpp"

#include <algorithm>

#include "model/btcpp/known_types.hpp"

namespace btcheck::btcpp {
namespace {

// "action_name", or the same of one of several.
bool names_action(std::string_view port) {
  return port.ends_with("action_name") || port.ends_with("action_server");
}

bool has_action(std::string_view column) {
  while (!column.empty()) {
    const std::size_t end = std::min(column.find(' '), column.size());
    if (names_action(column.substr(0, end))) return true;
    column.remove_prefix(std::min(end + 1, column.size()));
  }
  return false;
}

}  // namespace

bool is_action_client(Profile profile, std::string_view id) {
  if (!is_engine(profile)) return false;
  const NodeTypeRow* row = has_nav2(profile) ? nav2_type(id) : nullptr;
  if (row != nullptr) return row->answers.memory == LeafMemory::Latched;
  const LibraryType* type = library_type(id, TypeForm::Explicit);
  return type != nullptr &&
         (has_action(type->inputs) || has_action(type->both));
}

}  // namespace btcheck::btcpp

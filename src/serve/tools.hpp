// SPDX-License-Identifier: MIT
//
// What an agent can do with trees: answers short enough to be read by it, and
// findings by names that stay as long as the tree does.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "serve/server.hpp"
#include "text/json.hpp"

namespace btcheck {

struct ToolParameter {
  std::string_view name;
  std::string_view type;  // "string", "integer", "texts", "object"
  std::string_view about;
  bool is_needed = false;
};

struct ToolAnswer {
  std::string text;
  Json data = Json::object();  // the same for programs
};

struct ToolRow {
  std::string_view name;
  std::string_view title;
  std::string_view about;
  std::span<const ToolParameter> parameters;
  // Throws RpcError and std::invalid_argument where the call cannot be meant.
  ToolAnswer (*call)(const JsonValue& arguments, Work& work);
};

std::span<const ToolRow> tools();

// The schema of its arguments.
Json schema_of(const ToolRow& tool);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What the tests of the .btf reader share: reading, and asking what was read.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "model/tree/tree.hpp"

namespace btcheck {

// Every diagnostic of a text, rendered one after the other.
inline std::string findings_of(std::string_view text) {
  std::string all;
  for (const Diagnostic& found : read_btf("t.btf", text).diagnostics) {
    all += render(found);
  }
  return all;
}

// The tree of a text that must be readable.
inline BehaviorTree tree_of(std::string_view text) {
  auto result = read_btf("t.btf", text);
  INFO(findings_of(text));
  REQUIRE(result.value);
  return *std::move(result.value);
}

// The same for a text that must give no warning either.
inline BehaviorTree clean_tree_of(std::string_view text) {
  CHECK(findings_of(text) == "");
  return tree_of(text);
}

// The only child of the only root.
inline const Node& first_node(const BehaviorTree& tree) {
  REQUIRE(tree.nodes.size() >= 2);
  return tree.nodes[1];
}

// An expression as text, with the names of the tree.
inline std::string text_of(const BehaviorTree& tree,
                           const Expression& expression) {
  const auto variable = [&](const Term& term) -> const StateVariable& {
    return tree.variables.at(static_cast<std::size_t>(term.operand));
  };
  return expression.text(
      [&](const Term& term) {
        if (term.operation == Operation::Variable) return variable(term).name;
        const NodeId node{static_cast<std::uint32_t>(term.operand)};
        return unique_name(tree, node) + ".rstatus";
      },
      [&](const Term& beside, std::int32_t value) {
        if (beside.operation == Operation::Variable) {
          return variable(beside).value_name(value);
        }
        return std::string(kStatusNames.at(static_cast<std::size_t>(value)));
      });
}

// The text of a file in examples/.
inline std::string example(std::string_view name) {
  std::ifstream file(std::filesystem::path(BTCHECK_EXAMPLES) / name);
  REQUIRE(file.good());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline constexpr std::string_view kExamples[] = {
    "drone1.btf", "drone3.btf",   "drone3-fixed.btf", "mars_rover.btf",
    "train.btf",  "recovery.btf", "roundrobin.btf",   "nav2.btf"};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Two trees, read and compared.
#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/diff/diff.hpp"
#include "model/tree_file.hpp"

namespace btcheck {

// Actions a to d, which run, and conditions p to r, below one root.
inline std::string xml_of(std::string_view tree, std::string_view more = "") {
  return fmt::format(
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">\n"
      "<BehaviorTree ID=\"Main\">\n{}\n</BehaviorTree>\n{}\n<TreeNodesModel>\n"
      "<Action ID=\"a\"/><Action ID=\"b\"/><Action ID=\"c\"/>"
      "<Action ID=\"d\"><input_port name=\"goal\"/></Action>\n"
      "<Condition ID=\"p\"/><Condition ID=\"q\"/><Condition ID=\"r\"/>\n"
      "</TreeNodesModel>\n</root>\n",
      tree, more);
}

inline BehaviorTree tree_of(const std::string& name, const std::string& text) {
  auto read = read_tree(name, FileText(text), {});
  std::string told;
  for (const Diagnostic& each : read.diagnostics) told += render(each);
  REQUIRE_MESSAGE(read.value.has_value(), told);
  return std::move(*read.value);
}

inline Diff compared(const std::string& one, const std::string& other,
                     const DiffOptions& options = {}) {
  const std::string end = one.starts_with('<') ? "xml" : "btf";
  const BehaviorTree first = tree_of("a." + end, one);
  const BehaviorTree second = tree_of("b." + end, other);
  auto found =
      compare_trees({first, SourceText("a." + end, FileText(one))},
                    {second, SourceText("b." + end, FileText(other))}, options);
  REQUIRE(found.value.has_value());
  CHECK(found.value->error == "");
  return std::move(*found.value);
}

// "p asked, p success": what is seen, by the names of the nodes.
inline std::string told(const Diff& diff,
                        const std::vector<SeenEvent>& events) {
  static constexpr std::string_view kWords[] = {
      "asked", "success", "failure", "running", "skipped", "halted", "throws"};
  std::string text;
  for (const SeenEvent& event : events) {
    if (!text.empty()) text += ", ";
    const auto word = kWords[static_cast<std::size_t>(event.what())];
    if (event == kThrown) {
      text += "throws";
      continue;
    }
    const WatchedPair& watched = diff.watched[event.number()];
    const std::size_t side = watched.nodes.one ? 0 : 1;
    const NodeId node = side == 0 ? *watched.nodes.one : *watched.nodes.other;
    text += fmt::format(
        "{} {}",
        watched.is_root ? "root" : diff.sides[side].tree.node(node).name, word);
  }
  return text;
}

}  // namespace btcheck

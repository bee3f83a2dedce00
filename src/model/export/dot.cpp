// SPDX-License-Identifier: MIT
#include "model/export/dot.hpp"

#include <fmt/format.h>

#include <string_view>

#include "model/export/layout.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// Text within double quotes.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string interval_text(const Interval& when) {
  if (when == kAtOnce) return {};
  if (when.upper == kUnbounded) return fmt::format("[{},…[", when.lower);
  return fmt::format("[{},{}]", when.lower, when.upper);
}

std::string edge_label(const Network& network, const Edge& edge) {
  std::string label;
  auto add_line = [&](const std::string& line) {
    if (line.empty()) return;
    if (!label.empty()) label += "\\n";
    label += escaped(line);
  };
  add_line(interval_text(edge.when));
  if (!edge.guard.is_true()) {
    add_line("[" + expression_text(network, edge.guard) + "]");
  }
  for (const Assignment& update : edge.updates) {
    add_line(fmt::format("{} := {}", qualified_name(network, update.variable),
                         assigned_text(network, update)));
  }
  return label;
}

std::string automaton_text(const Network& network, std::size_t number) {
  const Automaton& automaton = network.automata[number];
  std::string text =
      fmt::format("  subgraph cluster_{0} {{\n    label=\"{1} {2}\";\n", number,
                  number + 1, escaped(automaton.name));
  const int initial = network.variable(automaton.location).initial -
                      network.variable(automaton.location).min;
  for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
    text += fmt::format("    a{}_{} [label=\"{}\"{}];\n", number, i,
                        escaped(automaton.locations[i].name),
                        static_cast<int>(i) == initial ? ", penwidth=2" : "");
  }
  for (const Edge& edge : automaton.edges) {
    text += fmt::format("    a{0}_{1} -> a{0}_{2} [label=\"{3}\"];\n", number,
                        index(edge.source), index(edge.target),
                        edge_label(network, edge));
  }
  return text + "  }\n";
}

std::string tree_text(const BehaviorTree& tree, const Network& network) {
  std::string text = "  subgraph cluster_tree {\n    label=\"\";\n";
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    text +=
        fmt::format("    n{} [shape=box, label=\"{}\\n{}\\nprocess {}\"];\n", n,
                    type_name(node.type), escaped(node.name),
                    index(network.node_automaton[n]) + 1);
    for (const NodeId child : node.children) {
      text += fmt::format("    n{} -> n{};\n", n, index(child));
    }
  }
  return text + "  }\n";
}

}  // namespace

std::string dot_text(const BehaviorTree& tree, const Network& network) {
  std::string text = fmt::format(
      "digraph \"{}\" {{\n  fontname=\"Helvetica\";\n"
      "  node [fontname=\"Helvetica\", fontsize=10];\n"
      "  edge [fontname=\"Helvetica\", fontsize=8];\n",
      escaped(tree.node(tree.roots[0]).name));
  text += scale_lines(tree, "  // ");
  text += tree_text(tree, network);
  for (std::size_t a = 0; a < network.automata.size(); ++a) {
    text += automaton_text(network, a);
  }
  return text + "}\n";
}

}  // namespace btcheck

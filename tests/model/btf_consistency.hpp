// SPDX-License-Identifier: MIT
//
// What must hold of everything read_btf returns, whatever the text was. The
// mutation tests and the fuzzer ask the same questions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

inline bool is_expression_of(const BehaviorTree& tree,
                             const Expression& expression) {
  int height = expression.is_true() ? 1 : 0;
  for (const Term& term : expression.terms()) {
    const auto operand = static_cast<std::size_t>(term.operand);
    if (term.operation == Operation::Variable &&
        operand >= tree.variables.size()) {
      return false;
    }
    if (term.operation == Operation::Status && operand >= tree.nodes.size()) {
      return false;
    }
    if (height < arity(term.operation)) return false;
    height += 1 - arity(term.operation);
  }
  return height == 1;
}

inline bool is_assignment_of(const BehaviorTree& tree,
                             const StateAssignment& assignment) {
  return index(assignment.variable) < tree.variables.size() &&
         is_expression_of(tree, assignment.value);
}

// What is wrong with a variable, or "".
inline std::string flaw_of(const StateVariable& variable) {
  if (variable.name.empty()) return "a variable without a name";
  if (variable.min > variable.max) return "an empty range";
  if (variable.initial < variable.min || variable.initial > variable.max) {
    return "an initial value out of range";
  }
  const int count = static_cast<int>(variable.states.size());
  if (count > 0 && (variable.min != 0 || variable.max != count - 1)) {
    return "an enumeration's range is not its states";
  }
  for (const auto& [from, to] : variable.transitions) {
    if (from == to || std::min(from, to) < 0 || std::max(from, to) >= count) {
      return "a transition between no states";
    }
  }
  return "";
}

// What is wrong with the node's place in the tree, or "".
inline std::string misplacement_of(const BehaviorTree& tree, std::size_t i) {
  const Node& node = tree.nodes[i];
  const std::size_t parent = index(node.parent);
  const bool is_root = std::count(tree.roots.begin(), tree.roots.end(),
                                  NodeId{static_cast<std::uint32_t>(i)}) == 1;
  if (is_root != node.is_root()) return "the roots are not the BehaviorTrees";
  if (is_root != (parent == i)) return "only a root is its own parent";
  if (parent > i) return "a parent after its child";
  for (const NodeId child : node.children) {
    if (index(child) <= i || index(child) >= tree.nodes.size() ||
        index(tree.node(child).parent) != i) {
      return "a child with another parent";
    }
  }
  return "";
}

// What is wrong with the node's contents, or "".
inline std::string flaw_of(const BehaviorTree& tree, const Node& node) {
  const NodeTypeInfo& info = kNodeTypes[static_cast<std::size_t>(node.type)];
  const int children = static_cast<int>(node.children.size());
  if (children < info.min_children || children > info.max_children) {
    return "a wrong number of children";
  }
  if (node.name.empty() || node.span.line < 1) return "a node without a name";
  const bool counts =
      node.type == NodeType::Parallel || node.type == NodeType::ParallelAll;
  if (counts && (node.threshold < 1 || node.threshold > children)) {
    return "a threshold that cannot be met";
  }
  const bool assigns = node.assignment.has_value();
  if (assigns && !is_assignment_of(tree, *node.assignment)) {
    return "an assignment to nothing";
  }
  if (node.type == NodeType::SetSV &&
      index(node.variable) >= tree.variables.size()) {
    return "a SetSV of nothing";
  }
  const LeafContract& contract = node.contract;
  if (!is_expression_of(tree, node.expression) ||
      !is_expression_of(tree, contract.requirement) ||
      !is_expression_of(tree, contract.unmet)) {
    return "a broken expression";
  }
  for (const auto* effects : {&contract.on_success, &contract.on_failure}) {
    for (const StateAssignment& effect : *effects) {
      if (!is_assignment_of(tree, effect)) return "an effect on nothing";
    }
  }
  if (!contract.may_succeed && !contract.may_fail && !contract.may_run &&
      !contract.may_skip) {
    return "a leaf that can answer nothing";
  }
  return "";
}

// What is wrong with a result of read_btf, or "".
inline std::string flaw_of(const Result<BehaviorTree>& result) {
  if (result.value.has_value() == has_error(result.diagnostics)) {
    return "not either a value or an error";
  }
  if (result.diagnostics.size() > 41) return "too many diagnostics";
  for (const Diagnostic& found : result.diagnostics) {
    if (found.message.empty() || render(found).empty()) {
      return "a diagnostic without a message";
    }
  }
  if (!result.value) return "";
  const BehaviorTree& tree = *result.value;
  if (tree.roots.empty()) return "no root";
  std::string flaw;
  for (const StateVariable& variable : tree.variables) {
    if (flaw.empty()) flaw = flaw_of(variable);
  }
  for (std::size_t i = 0; i < tree.nodes.size() && flaw.empty(); ++i) {
    flaw = misplacement_of(tree, i);
    if (flaw.empty()) flaw = flaw_of(tree, tree.nodes[i]);
  }
  if (!flaw.empty()) return flaw;
  return post_order(tree).size() == tree.nodes.size() ? "" : "lost nodes";
}

}  // namespace btcheck

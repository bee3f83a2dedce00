// SPDX-License-Identifier: MIT
#include "model/btcpp/children.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "model/btcpp/node_types.hpp"

namespace btcheck::btcpp {
namespace {

struct Arity {
  int min = 0;
  int max = 0;
};

Arity arity_of(BtcppRelease release, const BtcppNode& node) {
  const NodeTypeRow* type = known_type(release, node.id);
  // A model may give a name of Nav2 to a node of another kind.
  if (type != nullptr && type->kind == node.kind) {
    return {type->min_children, type->max_children};
  }
  if (node.kind == BtcppKind::Decorator) return {1, 1};
  if (node.kind == BtcppKind::Control) return {1, kManyChildren};
  return {0, 0};
}

std::string expected(Arity arity) {
  if (arity.max == 0) return "none is allowed";
  if (arity.min == arity.max)
    return fmt::format("exactly {} needed", arity.min);
  if (arity.max == kManyChildren) {
    return fmt::format("at least {} needed", arity.min);
  }
  return fmt::format("{} to {} needed", arity.min, arity.max);
}

std::string advice(const BtcppNode& node, Arity arity, int count) {
  if (node.kind == BtcppKind::SubTree) {
    return "what a SubTree does stands in the tree of its ID";
  }
  if (arity.max == 0) return "put them beside it, under a Sequence";
  if (count > arity.max && arity.max == 1) {
    return "put them into a Sequence or Fallback below it";
  }
  if (node.id.starts_with("Switch")) {
    return "one child for each case, and a last one for all other values";
  }
  if (node.id == "IfThenElse" || node.id == "WhileDoElse") {
    return "condition, then, and else";
  }
  if (node.id == "RecoveryNode") return "the task, and what repairs it";
  return count > arity.max ? "delete some" : "add one, or delete the node";
}

}  // namespace

void check_child_count(BtcppRelease release, const BtcppNode& node,
                       std::span<const ChildTag> children,
                       FileFindings& findings) {
  const Arity arity = arity_of(release, node);
  const int count = static_cast<int>(children.size());
  if (count >= arity.min && count <= arity.max) return;
  findings.error(
      node.place,
      {"BT1607",
       fmt::format("`{}` has {} child{}", node.id.empty() ? node.tag : node.id,
                   count == 0 ? "no" : std::to_string(count),
                   count == 1 ? "" : "ren"),
       expected(arity), advice(node, arity, count)});
}

// VerifyXML of 4.7.0 to 4.10.0 looks the children's tags up among the node
// types, and so does not know those of the explicit form.
void check_reactive_children(BtcppRelease release, const BtcppNode& node,
                             std::span<const ChildTag> children,
                             FileFindings& findings) {
  if (release == BtcppRelease::V3 || node.id != "ReactiveSequence") return;
  int asynchronous = 0;
  for (const ChildTag& child : children) {
    const bool is_explicit =
        child.tag != "SubTree" &&
        std::find(kBtcppKindNames.begin(), kBtcppKindNames.end(), child.tag) !=
            kBtcppKindNames.end();
    if (is_explicit) {
      findings.error(
          child.place,
          {"BT1619",
           fmt::format("`<{}>` directly in a ReactiveSequence", child.tag),
           "BehaviorTree.CPP 4.7 to 4.10 refuse the explicit form here",
           "write the node type as the tag"});
    }
    if (child.tag == "AsyncSequence" && ++asynchronous == 2) {
      findings.error(child.place,
                     {"BT1619", "a second AsyncSequence in a ReactiveSequence",
                      "only one asynchronous child is allowed",
                      "use a Parallel, or put both into one child"});
    }
  }
}

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
#include "check/whatif/faults.hpp"

#include <algorithm>
#include <utility>

#include "check/findings/facts.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// Of the variables that a fault may give another value: so many values.
constexpr int kMostOtherValues = 16;

bool is_condition(const Node& node) {
  return node.type == NodeType::Condition || is_taken_for_condition(node);
}

// All that it has is one answer: nothing of it can break.
bool is_constant(const Node& node) {
  const LeafContract& contract = node.contract;
  return !contract.may_run && contract.may_succeed != contract.may_fail &&
         contract.needed().is_true() && contract.on_success.empty() &&
         contract.on_failure.empty() && contract.measures.empty();
}

bool may_have_faults(const Node& node) {
  if (node.type == NodeType::SetSV) return true;
  return (node.type == NodeType::Action || node.type == NodeType::Condition) &&
         !is_constant(node);
}

bool writes_any(const Node& node) {
  return !node.contract.on_success.empty() || !node.contract.measures.empty();
}

bool can_write_others(const BehaviorTree& tree, const Node& node) {
  const auto& effects = node.contract.on_success;
  return !effects.empty() &&
         std::ranges::all_of(effects, [&](const StateAssignment& effect) {
           const StateVariable& variable = tree.variable(effect.variable);
           const int others = variable.max - variable.min;
           return others > 0 && others < kMostOtherValues;
         });
}

class List {
 public:
  List(const BehaviorTree& tree, const FaultChoices& choices)
      : tree_(tree), choices_(choices) {}

  PossibleFaults take() {
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      const Node& node = tree_.nodes[n];
      if (!may_have_faults(node) || !is_wanted(NodeId{n})) continue;
      if (is_taken_for_condition(node)) found_.guessed.push_back(NodeId{n});
      for (const FaultFacts& facts : kFaults) look_at(NodeId{n}, facts.kind);
    }
    return std::move(found_);
  }

 private:
  bool is_wanted(NodeId leaf) const {
    const auto& below = choices_.below;
    if (below.empty()) return true;
    for (;; leaf = tree_.node(leaf).parent) {
      if (std::ranges::find(below, leaf) != below.end()) return true;
      if (tree_.node(leaf).is_root()) return false;
    }
  }

  void look_at(NodeId leaf, FaultKind kind) {
    const auto& wanted = choices_.kinds;
    if (!wanted.empty() && std::ranges::find(wanted, kind) == wanted.end()) {
      return;
    }
    const Node& node = tree_.node(leaf);
    if (!makes_sense(node, kind)) return;
    const std::string_view why = no_difference(node, kind);
    if (why.empty()) {
      const bool is_late = kind == FaultKind::EndsLate;
      found_.faults.push_back({leaf, {kind, is_late ? choices_.late : 0}});
    } else {
      leave_out(leaf, kind, why);
    }
  }

  static bool makes_sense_for_condition(FaultKind kind) {
    using enum FaultKind;
    return kind == Fails || kind == FailsOnce || kind == Succeeds ||
           kind == Inverted || kind == FlipsOnce;
  }
  static bool makes_sense_for_deed(const Node& node, FaultKind kind) {
    using enum FaultKind;
    if (kind == NeverEnds || kind == EndsLate || kind == Halted) {
      return node.contract.may_run;
    }
    return kind == Fails || kind == FailsOnce || kind == FailsOn;
  }
  bool makes_sense(const Node& node, FaultKind kind) const {
    using enum FaultKind;
    // Leaves of .btf files know no exceptions.
    if (kind == Throws) return is_engine(tree_.profile);
    if (node.type == NodeType::SetSV) return kind == WritesNothing;
    if (kind == WritesNothing || kind == WritesOther) return writes_any(node);
    return is_condition(node) ? makes_sense_for_condition(kind)
                              : makes_sense_for_deed(node, kind);
  }

  // Why nothing is different then; "" where something may be.
  std::string_view no_difference(const Node& node, FaultKind kind) const {
    using enum FaultKind;
    if (kind == WritesOther && !can_write_others(tree_, node)) {
      return node.contract.on_success.empty()
                 ? "the world decides what it writes"
                 : "what it writes has more than 16 values";
    }
    const bool is_once =
        kind == FailsOnce || kind == Inverted || kind == FlipsOnce;
    if (is_condition(node) && is_once && answers_freely(node)) {
      return "the world may answer so at any time";
    }
    // Of an action without a memory of its own nothing is lost by a halt.
    if (kind == Halted && !is_engine(tree_.profile) && !node.duration) {
      return "it has nothing to begin anew";
    }
    return "";
  }

  void leave_out(NodeId leaf, FaultKind kind, std::string_view why) {
    auto same = std::ranges::find(found_.left_out, why, &OmittedFaults::why);
    if (same == found_.left_out.end()) {
      found_.left_out.push_back({{}, {}, std::string(why)});
      same = found_.left_out.end() - 1;
    }
    const auto add = [](auto& to, auto value) {
      if (std::ranges::find(to, value) == to.end()) to.push_back(value);
    };
    add(same->leaves, leaf);
    add(same->kinds, kind);
  }

  const BehaviorTree& tree_;
  const FaultChoices& choices_;
  PossibleFaults found_;
};

// Of these leaves none takes so long that the Timeout above them is over: each
// has an equal part of its time.
void end_in_time(BehaviorTree& tree, const Node& timeout) {
  std::vector<NodeId> leaves;
  std::vector<NodeId> open = timeout.children;
  while (!open.empty()) {
    const NodeId here = open.back();
    open.pop_back();
    const Node& node = tree.node(here);
    open.insert(open.end(), node.children.begin(), node.children.end());
    if (is_deed(node) && node.contract.may_run) leaves.push_back(here);
  }
  for (const NodeId leaf : leaves) {
    Node& node = tree.nodes[index(leaf)];
    const int most = std::max(timeout.duration->min - 1, 0) /
                     static_cast<int>(leaves.size());
    if (!node.duration) node.duration = Duration{0, most};
  }
}

// What a leaf that works does not do.
void let_work(BehaviorTree& tree) {
  for (Node& node : tree.nodes) {
    LeafContract& contract = node.contract;
    if (is_taken_for_condition(node)) contract.may_run = false;
    if (is_deed(node) && contract.may_succeed) contract.may_fail = false;
  }
  // From below: the nearest Timeout is the shortest.
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    const Node& node = tree.nodes[n];
    const bool has_end = node.type == NodeType::Timeout && node.duration &&
                         node.duration->max > 0 &&
                         node.duration->max != kUnboundedTicks;
    if (has_end) end_in_time(tree, Node(node));
  }
}

}  // namespace

bool is_deed(const Node& node) {
  return node.type == NodeType::Action && !is_condition(node);
}

bool answers_freely(const Node& node) {
  const LeafContract& contract = node.contract;
  return is_condition(node) && contract.needed().is_true() &&
         contract.may_succeed && contract.may_fail;
}

bool is_of_world(const Node& node) {
  return node.type == NodeType::SetSV || answers_freely(node);
}

PossibleFaults possible_faults(const BehaviorTree& tree,
                               const FaultChoices& choices) {
  return List(tree, choices).take();
}

BehaviorTree with_faults(const BehaviorTree& tree,
                         std::span<const InjectedFault> faults, Others others) {
  BehaviorTree changed = tree;
  if (others == Others::Work) let_work(changed);
  for (const InjectedFault& each : faults) {
    Node& node = changed.nodes[index(each.leaf)];
    node.fault = each.fault;
    // Beyond what its contract says.
    const bool has_most = node.duration && node.duration->max != kEndless;
    if (each.fault.kind == FaultKind::EndsLate && has_most) {
      node.fault->late += node.duration->max;
    }
  }
  return changed;
}

}  // namespace btcheck

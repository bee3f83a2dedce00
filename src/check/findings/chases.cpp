// SPDX-License-Identifier: MIT
//
// A condition under a ReactiveSequence asks for something, and the branch that
// it guards undoes it as soon as it begins (BT2210). For example, "is the
// battery low?" guards "charge": a moment of charging answers no, and halts it.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

// What a condition asks decides in each tick who goes on: where the answer
// changes back as soon as something is done about it, it is done by halves.
class Chases : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    if (is_limit(id) && !facts_.is_root(id)) {
      look_at_one_limit(id);
      look_at_outer_limit(id);
    }
    const bool asks_first = node.type == NodeType::ReactiveSequence ||
                            node.type == NodeType::WhileDoElse;
    if (asks_first && node.children.size() > 1) look_at_moment(id, node);
  }

 private:
  // A condition with numbers to compare with, and nothing else that it names.
  bool is_limit(NodeId id) const {
    const Node& node = facts_.node(id);
    const bool asks =
        node.type == NodeType::Condition || is_taken_for_condition(node);
    if (!asks || limits_of(node).empty()) return false;
    return std::ranges::all_of(node.arguments, [](const Argument& each) {
      return is_bound(each) || each.value.starts_with('{');
    });
  }
  // "hp_min=200, heat_max=350"
  static std::string limits_of(const Node& node) {
    std::string text;
    for (const Argument& each : node.arguments) {
      if (!is_bound(each)) continue;
      text += fmt::format("{}{}={}", text.empty() ? "" : ", ", each.key,
                          each.value);
    }
    return text;
  }
  static bool is_bound(const Argument& argument) {
    return (bounds_below(argument.key) || bounds_above(argument.key)) &&
           as_number<double>(argument.value).has_value();
  }

  // The node that ticks it again in each tick, and the child that it stands in.
  struct Asked {
    NodeId above{};
    NodeId child{};
  };
  std::optional<Asked> asked_in_each_tick(NodeId id) const {
    for (NodeId at = id; !facts_.is_root(at); at = facts_.parent(at)) {
      const NodeId above = facts_.parent(at);
      const Node& node = facts_.node(above);
      const bool asks = is_reactive(node) || node.type == NodeType::WhileDoElse;
      if (asks && node.children.back() != at) return Asked{above, at};
      if (asks) return std::nullopt;
    }
    return std::nullopt;
  }

  // Fallback(is above the limit, go and get more), asked in each tick: it goes
  // as soon as it is below, and comes back as soon as it is not.
  void look_at_one_limit(NodeId id) {
    const NodeId parent = facts_.parent(id);
    const Node& above = facts_.node(parent);
    const bool tries = info_of(above.type).flow == Flow::OnFailure &&
                       above.children[0] == id && above.children.size() > 1;
    if (!tries) return;
    const NodeId remedy = above.children[1];
    if (!facts_.has_deed(remedy) || has_limit_of_its_own(remedy, id)) return;
    const bool is_own = is_reactive(above) && facts_.may_run(remedy);
    if (!is_own && !asked_in_each_tick(id)) return;
    const std::vector<NodeId> leaves = facts_.leaves(remedy);
    const NodeId deed = *std::ranges::find_if(
        leaves, [&](NodeId leaf) { return facts_.is_deed(leaf); });
    found_.push_back(
        {.finding =
             {.code = "BT2504",
              .severity = Severity::Note,
              .node = id,
              .others = {deed, parent},
              .message = fmt::format("{} is begun and given up at the same "
                                     "level: may the value move about it?",
                                     told(deed)),
              .why = fmt::format("{} is asked in each tick, with one limit for "
                                 "both: {}",
                                 told(id), limits_of(facts_.node(id))),
              .help = fmt::format("ask for more where {} may end than where it "
                                  "has to begin",
                                  told(deed)),
              .rank = 12},
         .shown_by = {{id, LocationRole::Failure}}});
  }

  bool has_limit_of_its_own(NodeId branch, NodeId outer) const {
    const std::vector<NodeId> leaves = facts_.leaves(branch);
    return std::ranges::any_of(leaves, [&](NodeId leaf) {
      return facts_.node(leaf).id == facts_.node(outer).id;
    });
  }

  // WhileDoElse(hp above 350, …, … until hp above 399): the outer one ends the
  // branch before the inner one is met.
  void look_at_outer_limit(NodeId id) {
    for (NodeId at = id; !facts_.is_root(at); at = facts_.parent(at)) {
      const NodeId above = facts_.parent(at);
      const auto outer = ended_by(above, at);
      if (!outer || !is_stricter(facts_.node(id), facts_.node(*outer))) {
        continue;
      }
      found_.push_back(
          {.finding =
               {.code = "BT2504",
                .severity = Severity::Note,
                .node = id,
                .others = {*outer, above},
                .message =
                    fmt::format("{} never gets what it waits for: is its "
                                "limit meant?",
                                told(id)),
                .why = fmt::format(
                    "{} asks for less, and {} halts this branch as soon as it "
                    "succeeds",
                    told(*outer), told(above)),
                .help = fmt::format("ask {} for less than {}, or keep {} from "
                                    "being asked meanwhile",
                                    told(id), told(*outer), told(*outer)),
                .rank = 8},
           .shown_by = {{id, LocationRole::Failure}}});
      return;
    }
  }

  // The condition whose success halts the child of a node.
  std::optional<NodeId> ended_by(NodeId above, NodeId child) const {
    const Node& node = facts_.node(above);
    const bool is_else = node.type == NodeType::WhileDoElse &&
                         node.children.size() == 3 && node.children[2] == child;
    const bool is_behind =
        node.type == NodeType::ReactiveFallback && node.children[0] != child;
    if (!is_else && !is_behind) return std::nullopt;
    const NodeId asked = facts_.core(node.children[0]);
    return is_limit(asked) ? std::optional(asked) : std::nullopt;
  }

  // The same condition, with the same limits or some that are harder to meet.
  static bool is_stricter(const Node& inner, const Node& outer) {
    if (inner.id != outer.id ||
        inner.arguments.size() != outer.arguments.size()) {
      return false;
    }
    bool differs = false;
    for (std::size_t i = 0; i < inner.arguments.size(); ++i) {
      const Argument& in = inner.arguments[i];
      const Argument& out = outer.arguments[i];
      if (in.key != out.key) return false;
      if (in.value == out.value) continue;
      if (!is_bound(in) || !is_bound(out)) return false;
      const double more =
          *as_number<double>(in.value) - *as_number<double>(out.value);
      if (bounds_below(in.key) ? more < 0 : more > 0) return false;
      differs = true;
    }
    return differs;
  }

  // WhileDoElse(is attacked, turn round): what is true for a moment only halts
  // what it has begun.
  void look_at_moment(NodeId id, const Node& node) {
    const NodeId asked = facts_.core(node.children[0]);
    const NodeId branch = node.children[1];
    const Node& condition = facts_.node(asked);
    const bool asks = condition.type == NodeType::Condition ||
                      is_taken_for_condition(condition);
    if (!asks || !tells_of_moment(condition.id)) return;
    if (!facts_.may_run(branch) || !facts_.has_deed(branch)) return;
    const bool is_sequence = node.type == NodeType::ReactiveSequence;
    found_.push_back(
        {.finding = {.code = "BT2504",
                     .severity = Severity::Note,
                     .node = asked,
                     .others = {branch, id},
                     .message =
                         fmt::format("{} is halted when {} is over before "
                                     "it has ended: is that meant?",
                                     told(branch), told(asked)),
                     .why = fmt::format("{} asks in each tick, and this by "
                                        "its name tells of a moment",
                                        told(id)),
                     .help = fmt::format(
                         "ask once: {} instead of {}",
                         is_sequence ? "a Sequence" : "an IfThenElse",
                         told(id)),
                     .repairs = {{ChangeType{
                         place(id), is_sequence ? "Sequence" : "IfThenElse"}}},
                     .rank = 14},
         .shown_by = {
             {asked, LocationRole::Failure, {{branch, NodeStatus::Running}}}}});
  }
};

}  // namespace

void suspect_chases(const TreeFacts& facts, Suspicions& found) {
  Chases look(facts, found);
  look_at_nodes(facts, look);
}

}  // namespace btcheck

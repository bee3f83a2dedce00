// SPDX-License-Identifier: MIT
//
// A decorator or a last resort takes an answer away: ForceSuccess around a deed
// that may fail, an Inverter around one, a Fallback whose last child only notes
// that the others failed (BT2207, BT2209, BT2215).
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

class Swallowed : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    if (info_of(node.type).flow == Flow::OnFailure) look_at_last_resort(id);
    const bool is_forced = node.type == NodeType::ForceSuccess ||
                           node.type == NodeType::ForceFailure;
    if (is_forced) look_at_forced_condition(id, node);
    if (node.type == NodeType::RunOnce) look_at_asked_once(id);
    if (node.type == NodeType::Inverter) look_at_inverted_deed(id, node);
  }

 private:
  // --- The last child of a Fallback only notes that the others failed ------

  void look_at_last_resort(NodeId id) {
    const Node& node = facts_.node(id);
    const NodeId last = facts_.core(node.children.back());
    const auto why = what_it_does(last);
    if (node.children.size() < 2 || !why || !facts_.is_relied_on(id)) return;
    std::vector<NodeId> tried(node.children.begin(), node.children.end() - 1);
    const bool is_script = facts_.node(last).type == NodeType::Script;
    const bool are_attempts =
        is_script ? facts_.has_deed(id)
                  : std::ranges::all_of(
                        tried, [&](NodeId each) { return is_attempt(each); });
    if (!are_attempts || is_remembered(tried, last) ||
        facts_.said(tried, &LeafMeaning::may_be_lost) == true) {
      return;
    }
    Suspicion& made =
        add({.code = "BT2207",
             .node = last,
             .others = {id},
             .message = fmt::format(
                 "{} succeeds although all that it tries fails", told(id)),
             .why = std::string(*why),
             .help = fmt::format("put a ForceFailure around {}", told(last)),
             .repairs = {{WrapNodes{whole(node.children.back()),
                                    whole(node.children.back()),
                                    {"ForceFailure"}}}}});
    Sighting seen{last, LocationRole::Success};
    for (const NodeId child : tried) {
      seen.with.emplace_back(child, NodeStatus::Failure);
    }
    made.shown_by.push_back(std::move(seen));
    made.then = Consequence{id, LocationRole::Success};
  }

  // Nothing where it does something about the failure.
  std::optional<std::string_view> what_it_does(NodeId last) const {
    const Node& of = facts_.node(last);
    const Answers& answers = facts_.answers(last);
    if (of.type == NodeType::Script) {
      if (of.answers_value || is_asked_later(last)) return std::nullopt;
      return "this only notes it, and lets the mission go on";
    }
    if (!facts_.is_deed(last)) return std::nullopt;
    if (!answers.failure && !answers.runs) {
      return "this always succeeds, and lets the mission go on";
    }
    if (!facts_.only_tells(last)) return std::nullopt;
    return "this only tells of it, and lets the mission go on";
  }

  // It begins by doing something that the mission may need.
  bool is_attempt(NodeId child) const {
    const NodeId first = facts_.leaves(child).front();
    const std::string& id = facts_.node(first).id;
    return facts_.is_deed(first) && facts_.answers(first).failure &&
           !facts_.only_tells(first) && !only_looks(id);
  }

  // What a script of the attempt notes of its end is asked for later.
  bool is_remembered(const std::vector<NodeId>& tried, NodeId last) const {
    return std::ranges::any_of(tried, [&](NodeId each) {
      for (NodeId at = each; at < facts_.end_of(each); at = behind(at)) {
        if (is_asked_behind(at, last)) return true;
      }
      return false;
    });
  }
  static NodeId behind(NodeId node) { return NodeId{index(node) + 1}; }

  bool is_asked_behind(NodeId writer, NodeId last) const {
    const auto uses = facts_.uses_of(writer);
    return std::ranges::any_of(uses, [&](const EntryUse* write) {
      if (!write->writes || !write->when) return false;
      const auto of_entry = facts_.uses_of_entry(write->entry);
      return std::ranges::any_of(of_entry, [&](const EntryUse* read) {
        ask_budget();
        return read->reads && !read->is_port && read->node > last;
      });
    });
  }

  // A condition asks for what the script writes.
  bool is_asked_later(NodeId script) const {
    const auto uses = facts_.uses_of(script);
    return std::ranges::any_of(uses, [&](const EntryUse* write) {
      if (!write->writes) return false;
      const auto of_entry = facts_.uses_of_entry(write->entry);
      return std::ranges::any_of(of_entry, [&](const EntryUse* read) {
        ask_budget();
        return read->reads && !read->is_port && read->node != script;
      });
    });
  }

  // --- What a decorator throws away -----------------------------------------

  // The answer of a condition. Where it should interrupt an action, that is
  // told.
  void look_at_forced_condition(NodeId id, const Node& node) {
    const NodeId leaf = facts_.core(node.children[0]);
    if (facts_.node(leaf).type != NodeType::Condition) return;
    const Answers& answers = facts_.answers(leaf);
    if (!answers.success || !answers.failure ||
        facts_.said(leaf, &LeafMeaning::may_be_lost) == true) {
      return;
    }
    const bool succeeds = node.type == NodeType::ForceSuccess;
    const LocationRole lost =
        succeeds ? LocationRole::Failure : LocationRole::Success;
    const std::vector<NodeId> guarded = guarded_by(
        id, succeeds ? NodeType::ReactiveSequence : NodeType::ReactiveFallback);
    // A loop that the failure would have ended.
    const NodeId loop = succeeds ? loop_around(id) : id;
    const bool keeps_going = guarded.empty() && loop != id;
    TreeFinding finding = {
        .code = keeps_going ? "BT2215" : "BT2207",
        .node = keeps_going ? loop : id,
        .others = {id, leaf},
        .message = keeps_going ? fmt::format("{} goes on when {} fails",
                                             told(loop), told(leaf))
                               : fmt::format("what {} answers has no effect",
                                             told(leaf)),
        .why = fmt::format("{} (line {}) turns its answer into {}", told(id),
                           node.span.line, succeeds ? "success" : "failure"),
        .help = fmt::format("take {} away", told(id)),
        .repairs = {{UnwrapNode{place(id)}}}};
    Sighting seen{leaf, lost};
    if (!guarded.empty()) {
      finding.code = "BT2209";
      finding.others.push_back(guarded[0]);
      finding.message =
          fmt::format("{} cannot interrupt {}", told(leaf), told(guarded[0]));
      seen.with.emplace_back(guarded[0], NodeStatus::Running);
    }
    Suspicion& made = add(std::move(finding));
    made.shown_by.push_back(std::move(seen));
    made.then = Consequence{
        id, succeeds ? LocationRole::Success : LocationRole::Failure};
  }

  // What runs to its right, below the reactive node that asks in each tick.
  std::vector<NodeId> guarded_by(NodeId id, NodeType reactive) const {
    std::vector<NodeId> guarded;
    if (facts_.is_root(id)) return guarded;
    const Node& above = facts_.node(facts_.parent(id));
    if (above.type != reactive) return guarded;
    for (std::size_t i = facts_.place_of(id) + 1; i < above.children.size();
         ++i) {
      const NodeId child = above.children[i];
      if (facts_.may_run(child) && facts_.has_deed(child)) {
        guarded.push_back(child);
      }
    }
    return guarded;
  }

  // RunOnce(condition): the first answer is kept for ever.
  void look_at_asked_once(NodeId id) {
    const NodeId leaf = facts_.core(facts_.node(id).children[0]);
    if (facts_.node(leaf).type != NodeType::Condition) return;
    auto guarded = guarded_by(id, NodeType::ReactiveSequence);
    if (guarded.empty()) guarded = guarded_by(id, NodeType::ReactiveFallback);
    if (guarded.empty()) return;
    Suspicion& made =
        add({.code = "BT2209",
             .node = leaf,
             .others = {id, guarded[0]},
             .message = fmt::format("{} cannot interrupt {}", told(leaf),
                                    told(guarded[0])),
             .why = fmt::format("{} asks it once, and not again", told(id)),
             .help = fmt::format("take {} away", told(id)),
             .repairs = {{UnwrapNode{place(id)}}}});
    made.shown_by.push_back(
        {id, LocationRole::Tick, {{guarded[0], NodeStatus::Running}}});
    made.cleared_by.push_back(
        {leaf, LocationRole::Tick, {{guarded[0], NodeStatus::Running}}});
  }

  // The endless loop that a failure of the node would end; else the node.
  NodeId loop_around(NodeId id) const {
    for (NodeId at = id; !facts_.is_root(at); at = facts_.parent(at)) {
      const NodeId parent = facts_.parent(at);
      const Flow flow = info_of(facts_.node(parent).type).flow;
      if (is_endless(facts_.node(parent))) return parent;
      if (flow != Flow::OnSuccess && flow != Flow::AsChild) break;
    }
    return id;
  }

  // Inverter(act): its failure becomes success, and its success failure.
  void look_at_inverted_deed(NodeId id, const Node& node) {
    const NodeId deed = facts_.core(node.children[0]);
    const Answers& answers = facts_.answers(deed);
    if (!facts_.is_deed(deed) || !answers.success || !answers.failure) return;
    if (!facts_.is_relied_on(id)) return;
    const auto said = facts_.said(deed, &LeafMeaning::may_be_lost);
    if (said == true) return;
    TreeFinding& finding = add_inverted(id, deed).finding;
    if (!said) {
      finding.code = "BT2507";
      finding.severity = Severity::Note;
      finding.message = fmt::format(
          "{} succeeds when {} fails: does that only "
          "ask something?",
          told(id), told(deed));
    }
    finding.help =
        fmt::format("take {} away, if {} is no question", told(id), told(deed));
    finding.repairs = {{UnwrapNode{place(id)}}};
    finding.rank = only_looks(facts_.node(deed).id) ? 49 : 16;
  }
};

}  // namespace

void suspect_swallowed(const TreeFacts& facts, Suspicions& found) {
  Swallowed look(facts, found);
  look_at_nodes(facts, look);
}

}  // namespace btcheck

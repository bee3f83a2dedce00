// SPDX-License-Identifier: MIT
//
// What is possible as the tree stands, and its owner may have meant: one
// Parallel child that halts another (BT2502), a failure that nobody hears of
// (BT2503), a limit that decides anew in each tick (BT2504), a loop whose
// rounds may all fall into one tick (BT2505), and an answer that calls work off
// and is its success (BT2506).
//
// The names of leaves make and silence none of these: they change the order in
// which they are asked.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

class OpenQuestions : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    if (!is_engine(facts_.tree().profile)) return;
    if (node.type == NodeType::Parallel) ask_cut_off(id, node);
    if (node.type == NodeType::ForceSuccess) ask_forgiven(id);
    if (is_reactive(node)) ask_limit(id, node);
    if (is_endless(node)) ask_endless_tick(id, node);
    if (node.type == NodeType::ReactiveFallback) ask_called_off(id, node);
  }

 private:
  // --- A child of a Parallel halts another one ------------------------------

  // Does something, and ends.
  bool is_work(NodeId child) const {
    return facts_.has_deed(child) &&
           !is_endless(facts_.node(facts_.core(child)));
  }

  void ask_cut_off(NodeId id, const Node& node) {
    const auto count = static_cast<int>(node.children.size());
    const int needed = threshold_of(node.threshold, count);
    const int allowed = threshold_of(node.failure_threshold, count);
    if (needed == 1 && count > 1) {
      ask_cut_off_by(id, node, LocationRole::Success);
    }
    if (allowed == 1) ask_cut_off_by(id, node, LocationRole::Failure);
  }

  bool may_answer(NodeId child, LocationRole answer) const {
    const Answers& answers = facts_.answers(child);
    return answer == LocationRole::Success ? answers.success : answers.failure;
  }

  // The work of a child is halted since another one has ended so. That a
  // failure ends no more than was to be done by its own side is no loss.
  void ask_cut_off_by(NodeId id, const Node& node, LocationRole answer) {
    const bool succeeds = answer == LocationRole::Success;
    std::size_t most = 0;
    for (const NodeId child : node.children) {
      if (is_work(child) && facts_.may_run(child)) {
        most = std::max(most, facts_.deeds(child));
      }
    }
    for (const NodeId ending : node.children) {
      const bool may_end =
          may_answer(ending, answer) &&
          (is_work(ending) || (succeeds && !is_endless(facts_.node(ending))));
      const std::size_t least = succeeds ? 0 : facts_.deeds(ending);
      if (!may_end || most <= least) continue;
      std::vector<NodeId> halted;
      for (const NodeId child : node.children) {
        ask_budget();
        const bool is_lost = child != ending && is_work(child) &&
                             facts_.may_run(child) &&
                             facts_.deeds(child) > least;
        if (is_lost) halted.push_back(child);
      }
      if (halted.empty()) continue;
      Suspicion& made = add(
          {.code = "BT2502",
           .severity = Severity::Note,
           .node = id,
           .others = {ending},
           .message =
               fmt::format("{} halts {} when {} has {}: may that be cut off?",
                           told(id), facts_.few(halted), told(ending),
                           succeeds ? "succeeded" : "failed"),
           .why = succeeds ? "one success is enough for it"
                           : "it fails with the first of its children",
           .help = succeeds
                       ? "ask for the success of all, if all have to be done"
                       : fmt::format("put a ForceSuccess around {}, if it may "
                                     "fail without harm",
                                     told(ending)),
           .rank = succeeds ? 10 : 15});
      made.finding.others.insert(made.finding.others.end(), halted.begin(),
                                 halted.end());
      const NodeStatus status =
          succeeds ? NodeStatus::Success : NodeStatus::Failure;
      for (const NodeId each : halted) {
        made.shown_by.push_back({each, LocationRole::Halt, {{ending, status}}});
      }
      return;
    }
  }

  // --- An answer that calls work off, and is its success --------------------

  // ReactiveFallback(IsBatteryLow, Drive): a low battery is as good as being
  // there. Of IsThere it is meant.
  void ask_called_off(NodeId id, const Node& node) {
    const NodeId work = node.children.back();
    if (!is_lasting(work)) return;
    for (const NodeId child : node.children) {
      if (child == work) return;
      const NodeId asked = facts_.core(child);
      if (!facts_.is_condition(asked)) continue;
      Suspicion& made =
          add({.code = "BT2506",
               .severity = Severity::Note,
               .node = asked,
               .others = {work, id},
               .message = fmt::format("{} calls {} off, and that counts as its "
                                      "success: is that meant?",
                                      told(asked), told(work)),
               .why = fmt::format("{} succeeds with the first child that does",
                                  told(id)),
               .help = fmt::format("if not, let {} fail then: put an Inverter "
                                   "around {}, under a ReactiveSequence",
                                   told(id), told(asked)),
               .rank = tidings_of(facts_.node(asked).id) == Tidings::Bad ? 13
                                                                         : 45});
      made.shown_by.push_back(
          {child, LocationRole::Success, {{work, NodeStatus::Running}}});
      made.then = Consequence{id, LocationRole::Success};
      return;
    }
  }

  // --- A failure that nobody hears of ---------------------------------------

  // The nearest node above that would do something about a failure, were it
  // passed on.
  std::optional<NodeId> would_help(NodeId id) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const NodeId above = facts_.parent(id);
      const Flow flow = info_of(facts_.node(above).type).flow;
      const bool is_last = facts_.node(above).children.back() == id;
      if (flow == Flow::Retries) return above;
      if ((flow == Flow::OnFailure || flow == Flow::Recovers) && !is_last) {
        return above;
      }
      if (flow != Flow::OnSuccess && flow != Flow::AsChild) return std::nullopt;
    }
    return std::nullopt;
  }

  // Something is done after it, and not just once more in a loop around it.
  bool has_more_behind(NodeId id) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const Node& above = facts_.node(facts_.parent(id));
      const Flow flow = info_of(above.type).flow;
      if (flow != Flow::OnSuccess && flow != Flow::AsChild) return false;
      if (above.children.back() != id) return true;
    }
    return false;
  }

  void ask_forgiven(NodeId id) {
    const NodeId child = facts_.node(id).children[0];
    if (!facts_.has_deed(child) || !facts_.answers(child).failure) return;
    const auto helper = would_help(id);
    if (!helper && !has_more_behind(id)) return;
    Suspicion& made =
        add({.code = "BT2503",
             .severity = Severity::Note,
             .node = id,
             .others = {child},
             .message = helper ? fmt::format("{} may fail, and {} never hears "
                                             "of it: is that meant?",
                                             told(child), told(*helper))
                               : fmt::format("the mission goes on when {} has "
                                             "failed: is that meant?",
                                             told(child)),
             .why = "it turns the failure into success",
             .help = fmt::format("take {} away, if it matters", told(id)),
             .repairs = {{UnwrapNode{place(id)}}},
             .rank = helper ? 20 : 50});
    if (helper) made.finding.others.push_back(*helper);
    made.shown_by.push_back({child, LocationRole::Failure});
    made.then = Consequence{id, LocationRole::Success};
  }

  // --- A limit between two that last ----------------------------------------

  // ReactiveFallback(ReactiveSequence(level < 20, Charge), Patrol): the number
  // is measured while either runs, and each side moves it over the limit.
  void ask_limit(NodeId id, const Node& node) {
    if (info_of(node.type).flow != Flow::OnFailure) return;
    for (std::size_t i = 0; i + 1 < node.children.size(); ++i) {
      const NodeId branch = facts_.core(node.children[i]);
      const Node& guarded = facts_.node(branch);
      const bool is_pair = is_reactive(guarded) &&
                           info_of(guarded.type).flow == Flow::OnSuccess &&
                           guarded.children.size() > 1;
      const NodeId other = node.children[i + 1];
      if (!is_pair || !is_lasting(other)) continue;
      const NodeId limit = facts_.core(guarded.children[0]);
      const NodeId work = guarded.children.back();
      if (!is_lasting(work) || !compares_measured(limit)) continue;
      Suspicion& made = add(
          {.code = "BT2504",
           .severity = Severity::Note,
           .node = limit,
           .others = {work, other, id},
           .message = fmt::format("{} decides in each tick between {} and {}: "
                                  "may the value move about the limit?",
                                  told(limit), told(work), told(other)),
           .why = "each of the two is halted as soon as the value crosses it",
           .help = "let the first go on up to a second limit",
           .rank = 12});
      made.shown_by.push_back(
          {limit, LocationRole::Failure, {{work, NodeStatus::Running}}});
      return;
    }
  }

  bool is_lasting(NodeId id) const {
    return facts_.has_deed(id) && facts_.may_run(id);
  }

  // A script on entries that ports write, and on nothing that scripts of the
  // tree set: `level < 20 || (charging && level < 80)` remembers.
  bool compares_measured(NodeId limit) const {
    const Node& node = facts_.node(limit);
    if (node.type != NodeType::Script || !node.answers_value) return false;
    const std::string_view code = node.own_scripts.at(0).text;
    if (code.find_first_of("<>") == code.npos) return false;
    const auto entries = entries_of(limit, std::nullopt);
    return !entries.empty() &&
           std::ranges::all_of(entries, [&](std::uint32_t entry) {
             return is_measured(entry, facts_.parent(limit));
           });
  }

  // Written by ports, and not below the node.
  bool is_measured(std::uint32_t entry, NodeId below) const {
    bool by_port = false;
    for (const EntryUse* use : facts_.uses_of_entry(entry)) {
      if (use->writes && !use->is_port && facts_.is_in(use->node, below)) {
        return false;
      }
      by_port |= use->writes && use->is_port;
    }
    return by_port;
  }

  // --- All rounds in one tick -----------------------------------------------

  // Ticked as tickOnce does, a loop without end begins its next round at once.
  void ask_endless_tick(NodeId id, const Node& node) {
    const Flow flow = info_of(node.type).flow;
    if (flow != Flow::Repeats && flow != Flow::Retries) return;
    // Version 3 does not wake; and where the root is woken the search tells.
    const BehaviorTree& tree = facts_.tree();
    if (!facts_.has_scripts() || tree.node(tree.roots[0]).wakes) return;
    const NodeId child = node.children[0];
    const LocationRole again =
        flow == Flow::Repeats ? LocationRole::Success : LocationRole::Failure;
    if (!may_answer(child, again) || !may_end_at_once(child)) return;
    Suspicion& made = add(
        {.code = "BT2505",
         .severity = Severity::Note,
         .node = id,
         .others = {child},
         .message = fmt::format("nothing in a round of {} has to take time: "
                                "does some leaf always?",
                                told(id)),
         .why = "else a tick by tickOnce() never returns: each round wakes the "
                "tree for the next one",
         .help = "put a Sleep into the loop, or say by a contract which leaf "
                 "takes time",
         .rank = 30});
    made.shown_by.push_back({child, again});
  }

  bool may_end_at_once(NodeId id) const {
    const Node& node = facts_.node(id);
    const bool is_limit = node.type == NodeType::Timeout;
    if (!is_limit && node.duration && node.duration->min > 0) return false;
    if (is_leaf(node.type)) return true;
    const auto ends = [&](NodeId child) { return may_end_at_once(child); };
    return info_of(node.type).flow == Flow::OnFailure
               ? std::ranges::any_of(node.children, ends)
               : std::ranges::all_of(node.children, ends);
  }
};

}  // namespace

void suspect_open_questions(const TreeFacts& facts, Suspicions& found) {
  OpenQuestions look(facts, found);
  look_at_nodes(facts, look);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A guard is there to interrupt what it guards, and cannot (BT2209): it is
// asked before the work begins and never again, or only in ticks that come too
// late.
#include <fmt/format.h>

#include <algorithm>

#include "check/findings/edits.hpp"
#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/releases.hpp"

namespace btcheck {
namespace {

class Guards : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    look_at_first_look(id);
    if (node.type == NodeType::ReactiveSequence) look_behind(id);
    if (resumes(node)) look_at_not_renewed(id);
    if (node.type == NodeType::Parallel) look_at_watches(id, node);
    if (node.contract.memory == LeafMemory::FirstTickFails) {
      look_at_reset(id);
    }
  }

 private:
  // Whether it may be ticked while some leaf below `node` runs.
  bool may_tick_while(NodeId writer, NodeId node) const {
    const std::vector<NodeId> leaves = facts_.leaves(node);
    return std::ranges::any_of(leaves, [&](NodeId leaf) {
      return facts_.may_run(leaf) &&
             is_ticked_while(facts_.tree(), writer, leaf);
    });
  }

  // _failureIf, _successIf and the `if` of a Precondition are looked at before
  // the node begins; what they read changes while it runs.
  void look_at_first_look(NodeId id) {
    if (!facts_.may_run(id) || !facts_.has_deed(id)) return;
    const Node& node = facts_.node(id);
    if (node.script(ScriptTime::FailureIf)) {
      note_first_look(id, ScriptTime::FailureIf, "_failureIf",
                      NodeStatus::Failure);
    }
    if (node.script(ScriptTime::SuccessIf)) {
      note_first_look(id, ScriptTime::SuccessIf, "_successIf",
                      NodeStatus::Success);
    }
    const bool asks_once = node.type == NodeType::Precondition &&
                           !releases::kPreconditionAsksAlways.has(
                               engine_release(facts_.tree().profile));
    if (asks_once) note_first_look(id, {}, "the `if`", node.otherwise);
  }

  // `ending`: what the node answers instead of going on, if it were asked.
  void note_first_look(NodeId id, std::optional<ScriptTime> when,
                       std::string_view name, NodeStatus ending) {
    for (const NodeId writer : writers_of(entries_of(id, when))) {
      if (facts_.is_in(writer, id) || !may_tick_while(writer, id)) continue;
      Suspicion& made = add(
          {.code = "BT2209",
           .node = id,
           .others = {writer},
           .message =
               fmt::format("{} of {} cannot interrupt it", name, told(id)),
           .why = fmt::format("it is looked at before {} begins; {} writes "
                              "what it reads while that runs",
                              told(id), told(writer)),
           .help = "ask in a ScriptCondition before it, in a reactive node"});
      made.shown_by = {
          {writer, LocationRole::Tick, {{id, NodeStatus::Running}}},
          {id, LocationRole::Tick, {{id, NodeStatus::Running}}}};
      const bool fails = ending == NodeStatus::Failure;
      if (!fails && ending != NodeStatus::Success) return;
      const std::string reactive =
          fails ? "ReactiveSequence" : "ReactiveFallback";
      made.finding.help =
          fmt::format("ask in a ScriptCondition before it, in a {}", reactive);
      made.finding.repairs = {when ? asked_before(id, *when, reactive)
                                   : asked_instead(id, fails, reactive)};
      return;
    }
  }

  // What makes the node fail, or succeed, as a condition to its left.
  Repair asked_before(NodeId id, ScriptTime when,
                      const std::string& reactive) const {
    const bool fails = when == ScriptTime::FailureIf;
    const std::string& asked = facts_.node(id).script(when)->text;
    const NewNode condition{"ScriptCondition",
                            {{"code", fails ? negated_script(asked) : asked}}};
    return {RemoveAttribute{place(id), fails ? "_failureIf" : "_successIf"},
            WrapNodes{whole(id), whole(id), {reactive}, {condition}}};
  }

  // Precondition(act) as ReactiveSequence(condition, act).
  Repair asked_instead(NodeId id, bool fails,
                       const std::string& reactive) const {
    const std::string& asked = facts_.node(id).own_scripts.at(0).text;
    const SourcePlace child = place(facts_.node(id).children[0]);
    const NewNode condition{"ScriptCondition",
                            {{"code", fails ? asked : negated_script(asked)}}};
    return {UnwrapNode{place(id)},
            WrapNodes{child, child, {reactive}, {condition}}};
  }

  // ReactiveSequence(act, condition): the condition is asked when `act` is
  // done.
  void look_behind(NodeId id) {
    const auto& children = facts_.node(id).children;
    std::size_t last_deed = children.size();
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (has_long_deed(children[i])) last_deed = i;
    }
    for (std::size_t i = last_deed + 1; i < children.size(); ++i) {
      const NodeId asked = condition_in(children[i]);
      const bool asks = facts_.node(asked).type == NodeType::Condition &&
                        facts_.is_condition(asked);
      if (!asks) continue;
      const NodeId deed = children[last_deed];
      found_.push_back(
          {.finding =
               {.code = "BT2209",
                .node = asked,
                .others = {deed, id},
                .message = fmt::format("{} cannot interrupt {}", told(asked),
                                       told(deed)),
                .why = fmt::format("it stands behind {}: it is asked when that "
                                   "has succeeded",
                                   told(deed)),
                .help = fmt::format("put it before {}", told(deed)),
                .repairs = {{MoveBefore{whole(children[i]), whole(deed)}}}},
           .shown_by = {{deed, LocationRole::Running}}});
    }
  }

  // Something that takes time and does more than look.
  bool has_long_deed(NodeId id) const {
    const std::vector<NodeId> leaves = facts_.leaves(id);
    return std::ranges::any_of(leaves, [&](NodeId leaf) {
      return facts_.is_deed(leaf) && facts_.may_run(leaf) &&
             !only_looks(facts_.node(leaf).id);
    });
  }

  NodeId condition_in(NodeId id) const {
    id = facts_.core(id);
    if (facts_.node(id).type == NodeType::Inverter) {
      id = facts_.core(facts_.node(id).children[0]);
    }
    return id;
  }

  // Sequence(Decide, Kick _while="decision == 'kick'"): while Kick runs, nobody
  // decides.
  void look_at_not_renewed(NodeId id) {
    std::vector<NodeId> guarded;
    std::vector<NodeId> writers;
    for (const NodeId child : facts_.node(id).children) {
      if (!facts_.node(child).script(ScriptTime::While)) continue;
      if (!facts_.may_run(child)) continue;
      const auto renewing = writers_of(entries_of(child, ScriptTime::While));
      // A script that only gives it a first value leaves the rest to the
      // program; a leaf decides, by its port.
      const bool is_beside = std::ranges::any_of(renewing, [&](NodeId writer) {
        return facts_.is_in(writer, id) && index(writer) < index(child) &&
               decides(writer, child);
      });
      const bool is_renewed = std::ranges::any_of(renewing, [&](NodeId writer) {
        return facts_.is_in(writer, child) || may_tick_while(writer, child);
      });
      if (!is_beside || is_renewed) continue;
      guarded.push_back(child);
      writers = renewing;
    }
    if (guarded.empty()) return;
    Suspicion made{
        .finding = {
            .code = "BT2209",
            .node = guarded[0],
            .others = {guarded.begin() + 1, guarded.end()},
            .message =
                fmt::format("_while cannot interrupt {}", facts_.told(guarded)),
            .why = fmt::format("while {} runs, {} resumes it and does not tick "
                               "{}, which writes what _while reads",
                               guarded.size() == 1 ? "it" : "one of them",
                               told(id), told(writers[0])),
            .help = fmt::format("make {} a ReactiveSequence", told(id)),
            .repairs = {{ChangeType{place(id), "ReactiveSequence"}}}}};
    made.finding.others.push_back(writers[0]);
    for (const NodeId each : guarded) {
      made.shown_by.push_back(
          {each, LocationRole::Tick, {{each, NodeStatus::Running}}});
    }
    found_.push_back(std::move(made));
  }

  bool decides(NodeId leaf, NodeId guarded) const {
    const auto asked = entries_of(guarded, ScriptTime::While);
    return std::ranges::any_of(facts_.uses_of(leaf), [&](const EntryUse* use) {
      return use->is_port && use->writes &&
             std::ranges::count(asked, use->entry) > 0;
    });
  }

  // Parallel(KeepRunningUntilFailure(all is well), act) that waits for more
  // than one failure.
  void look_at_watches(NodeId id, const Node& node) {
    const auto count = static_cast<int>(node.children.size());
    if (!is_engine(facts_.tree().profile) ||
        threshold_of(node.failure_threshold, count) < 2) {
      return;
    }
    for (const NodeId child : node.children) {
      const auto asked = watched_by(child);
      if (!asked) continue;
      for (const NodeId deed : node.children) {
        if (deed == child || !has_long_deed(deed)) continue;
        add_watch(id, child, *asked, deed);
        break;
      }
    }
  }

  // The condition that a child asks for as long as it succeeds.
  std::optional<NodeId> watched_by(NodeId child) const {
    const NodeId core = facts_.core(child);
    const Node& node = facts_.node(core);
    if (!is_endless(node) || node.type == NodeType::RetryUntilSuccessful) {
      return std::nullopt;
    }
    const NodeId asked = condition_in(node.children[0]);
    return facts_.node(asked).type == NodeType::Condition ? std::optional(asked)
                                                          : std::nullopt;
  }

  void add_watch(NodeId id, NodeId watch, NodeId asked, NodeId deed) {
    const bool is_old = is_release_3(facts_.tree().profile);
    const std::string option = is_old ? "failure_threshold" : "failure_count";
    found_.push_back(
        {.finding = {.code = "BT2209",
                     .node = asked,
                     .others = {deed, watch, id},
                     .message = fmt::format("{} cannot interrupt {}",
                                            told(asked), told(deed)),
                     .why = fmt::format(
                         "{} goes on until more than one child has failed",
                         told(id)),
                     .help = fmt::format("set {} to 1", option),
                     .repairs = {{SetAttribute{place(id), option, "1"}}}},
         .shown_by = {
             {deed,
              LocationRole::Tick,
              {{deed, NodeStatus::Running}, {watch, NodeStatus::Failure}}}}});
  }

  // A condition that compares with the last tick, under a reactive node that
  // resets it in each: each tick is its first.
  void look_at_reset(NodeId id) {
    NodeId child = id;
    while (!facts_.is_root(child) &&
           facts_.node(facts_.parent(child)).children.size() == 1) {
      child = facts_.parent(child);
    }
    if (facts_.is_root(child)) return;
    const NodeId above = facts_.parent(child);
    const auto& children = facts_.node(above).children;
    if (!is_reactive(facts_.node(above)) || children.back() == child) return;
    const NodeId deed = children[facts_.place_of(child) + 1];
    found_.push_back(
        {.finding = {.code = "BT2209",
                     .node = id,
                     .others = {deed, above},
                     .message = fmt::format("{} never interrupts {}", told(id),
                                            told(deed)),
                     .why = fmt::format(
                         "{} resets it in each tick, and its first answer "
                         "after a reset is failure",
                         told(above)),
                     .help = "ask a condition that remembers beyond a reset, "
                             "such as GlobalUpdatedGoal",
                     .repairs = {{ChangeType{place(id), "GlobalUpdatedGoal"}}}},
         .shown_by = {{id,
                       LocationRole::Failure,
                       {{deed, NodeStatus::Running}}}},
         .cleared_by = {{id, LocationRole::Success}}});
  }
};

}  // namespace

void suspect_guards(const TreeFacts& facts, Suspicions& found) {
  Guards look(facts, found);
  look_at_nodes(facts, look);
}

}  // namespace btcheck

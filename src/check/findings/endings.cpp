// SPDX-License-Identifier: MIT
//
// Where something ends too late or too early: a loop without a way out
// (BT2215), a Parallel that halts what has not ended (BT2214), and nodes that
// no run ticks (BT2201, BT2212).
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "check/findings/edits.hpp"
#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

class Endings : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    if (is_endless(node) && !is_meant(id)) look_at_loop(id, node);
    if (node.type == NodeType::Parallel) look_at_race(id, node);
    if (node.type == NodeType::Recovery && node.repetitions == 0) {
      look_at_no_retries(id, node);
    }
    look_at_contradiction(id);
  }

 private:
  // The mission is the loop: nothing around it but decorators, and what is done
  // before it.
  bool is_meant(NodeId id) const {
    const bool retries = facts_.node(id).type == NodeType::RetryUntilSuccessful;
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const Node& above = facts_.node(facts_.parent(id));
      if (above.children.size() == 1) continue;
      const bool is_last = info_of(above.type).flow == Flow::OnSuccess &&
                           above.children.back() == id;
      if (retries || !is_last) return false;
    }
    return true;
  }

  bool has_timeout(NodeId id) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const Node& above = facts_.node(facts_.parent(id));
      if (above.type == NodeType::Timeout || is_reactive(above) ||
          may_decide_without(id, above) || above.script(ScriptTime::While)) {
        return true;
      }
    }
    return false;
  }

  // A Parallel that some of its other children are enough for, or that one of
  // them watches.
  bool may_decide_without(NodeId id, const Node& above) const {
    if (info_of(above.type).beside != Beside::Counted) return false;
    const auto count = static_cast<int>(above.children.size());
    const bool waits_for_all = above.type == NodeType::Parallel &&
                               threshold_of(above.threshold, count) == count;
    return !waits_for_all ||
           std::ranges::any_of(above.children, [&](NodeId child) {
             return child != id && !is_task(child) &&
                    facts_.answers(child).failure;
           });
  }

  // What stands behind it and waits for the answer that it never gives.
  std::vector<NodeId> waiting_behind(NodeId id) const {
    if (facts_.is_root(id)) return {};
    const Node& above = facts_.node(facts_.parent(id));
    const bool retries = facts_.node(id).type == NodeType::RetryUntilSuccessful;
    const Flow flow = info_of(above.type).flow;
    if (flow != (retries ? Flow::OnFailure : Flow::OnSuccess)) return {};
    const std::size_t place = facts_.place_of(id);
    return {above.children.begin() + static_cast<std::ptrdiff_t>(place) + 1,
            above.children.end()};
  }

  void look_at_loop(NodeId id, const Node& node) {
    const NodeId child = node.children[0];
    const Answers& answers = facts_.answers(child);
    const bool retries = node.type == NodeType::RetryUntilSuccessful;
    if (has_timeout(id)) return;
    if (retries && answers.failure) {
      add_loop(id, LocationRole::Failure, child,
               fmt::format("{} never gives up while {} fails", told(id),
                           told(child)),
               "without an end to the attempts, a failure that lasts keeps the "
               "mission here",
               "set num_attempts to a number, such as 5",
               {{SetAttribute{place(id), "num_attempts", "5"}}});
    } else if (!retries && !answers.failure) {
      add_loop(id, LocationRole::Success, child,
               fmt::format("nothing ends {}", told(id)),
               fmt::format("{} never fails", told(child)),
               "let a failure below it through, or bound it");
    }
  }

  void add_loop(NodeId id, LocationRole answer, NodeId child,
                std::string message, std::string why, std::string help,
                std::vector<Repair> repairs = {}) {
    std::vector<NodeId> others = waiting_behind(id);
    if (!others.empty()) {
      why += fmt::format("; {} {} never ticked", facts_.told(others),
                         others.size() == 1 ? "is" : "are");
    }
    others.push_back(child);
    found_.push_back({.finding = {.code = "BT2215",
                                  .node = id,
                                  .others = std::move(others),
                                  .message = std::move(message),
                                  .why = std::move(why),
                                  .help = std::move(help),
                                  .repairs = std::move(repairs)},
                      .shown_by = {{child, answer}}});
  }

  // Something that has an end of its own.
  bool is_task(NodeId id) const {
    const Node& core = facts_.node(facts_.core(id));
    return facts_.may_run(id) && facts_.has_deed(id) &&
           facts_.answers(id).success && !is_endless(core) &&
           !goes_on_beside(core.name);
  }

  // Parallel(1 of 2): the first to succeed halts the other.
  void look_at_race(NodeId id, const Node& node) {
    const auto count = static_cast<int>(node.children.size());
    const int needed = threshold_of(node.threshold, count);
    if (needed <= 0 || needed >= count) return;
    std::vector<NodeId> tasks;
    for (const NodeId child : node.children) {
      if (is_task(child)) tasks.push_back(child);
    }
    if (static_cast<int>(tasks.size()) <= needed || !others_watch(node) ||
        facts_.said(tasks, &LeafMeaning::may_be_cut_off) == true) {
      return;
    }
    std::vector<Sighting> seen;
    for (const NodeId each : tasks) {
      seen.push_back(cut_off(each, tasks, static_cast<std::size_t>(needed)));
    }
    found_.push_back(
        {.finding = {.code = "BT2214",
                     .node = id,
                     .others = tasks,
                     .message = fmt::format(
                         "{} halts what has not ended when {} of {} succeeded",
                         told(id), needed, facts_.told(tasks)),
                     .why = fmt::format("{} of its {} children are enough",
                                        needed, count),
                     .help =
                         fmt::format("let it wait for all: {}", tasks.size()),
                     .repairs = {asking_for(facts_, id,
                                            static_cast<int>(tasks.size()))}},
         .shown_by = std::move(seen)});
  }

  // What is no task can not be what the Parallel waits for.
  bool others_watch(const Node& node) const {
    return std::ranges::all_of(node.children, [&](NodeId child) {
      return is_task(child) || !facts_.answers(child).success;
    });
  }

  // The task is halted when as many others have succeeded as are asked for.
  static Sighting cut_off(NodeId task, const std::vector<NodeId>& tasks,
                          std::size_t needed) {
    Sighting seen{task, LocationRole::Halt};
    for (const NodeId other : tasks) {
      if (other != task && seen.with.size() < needed) {
        seen.with.emplace_back(other, NodeStatus::Success);
      }
    }
    return seen;
  }

  void look_at_no_retries(NodeId id, const Node& node) {
    if (node.children.size() < 2) return;
    found_.push_back(
        {.finding = {.code = "BT2201",
                     .node = id,
                     .others = {node.children[1]},
                     .message = fmt::format("{} is never ticked",
                                            told(node.children[1])),
                     .why = fmt::format("with number_of_retries=\"0\" {} fails "
                                        "at the first failure",
                                        told(id)),
                     .help = "set number_of_retries to 1 or more",
                     .repairs = {{SetAttribute{place(id),
                                               is_engine(facts_.tree().profile)
                                                   ? "number_of_retries"
                                                   : "num_retries",
                                               "1"}}}},
         .shown_by = {{node.children[0], LocationRole::Failure}},
         .cleared_by = {{node.children[1], LocationRole::Tick}}});
  }

  // _while="x" in a branch that is only entered while _while="!x".
  void look_at_contradiction(NodeId id) {
    const auto& asked = facts_.node(id).script(ScriptTime::While);
    if (!asked || facts_.is_root(id)) return;
    for (NodeId at = facts_.parent(id);; at = facts_.parent(at)) {
      const auto& above = facts_.node(at).script(ScriptTime::While);
      if (above && are_opposite(asked->text, above->text)) {
        if (is_written_in(at, entries_of(id, ScriptTime::While))) return;
        found_.push_back(
            {.finding = {
                 .code = "BT2212",
                 .node = id,
                 .others = {at},
                 .message = fmt::format("{} is always skipped", told(id)),
                 .why = fmt::format("{} (line {}) is only ticked while the "
                                    "opposite is true",
                                    told(at), facts_.node(at).span.line),
                 .help = "delete it, or move it out"}});
        return;
      }
      if (facts_.is_root(at)) return;
    }
  }

  // Then it may be another value that is asked there.
  bool is_written_in(NodeId above,
                     const std::vector<std::uint32_t>& entries) const {
    return std::ranges::any_of(writers_of(entries), [&](NodeId writer) {
      return facts_.is_in(writer, above);
    });
  }

  static std::string squeezed(std::string_view text) {
    std::string letters;
    for (const char c : text) {
      if (c != ' ' && c != '\t') letters += c;
    }
    return letters;
  }
  // "x" and "!x", "a > b" and "!(a > b)".
  static bool negates(const std::string& text, const std::string& other) {
    const bool is_name = std::ranges::all_of(other, [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_';
    });
    return text == "!(" + other + ")" || (is_name && text == "!" + other);
  }
  static bool are_opposite(std::string_view one, std::string_view other) {
    const std::string left = squeezed(one);
    const std::string right = squeezed(other);
    return negates(left, right) || negates(right, left);
  }
};

}  // namespace

void suspect_endings(const TreeFacts& facts, Suspicions& found) {
  Endings look(facts, found);
  look_at_nodes(facts, look);
}

}  // namespace btcheck

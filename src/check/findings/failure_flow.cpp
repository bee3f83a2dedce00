// SPDX-License-Identifier: MIT
//
// A node answers the opposite of what has happened below it: it succeeds
// although a task failed (BT2207), or fails although the repair succeeded
// (BT2208). For example, a Fallback of "open the door" and "say sorry" succeeds
// with the door shut.
#include <fmt/format.h>

#include <algorithm>

#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

bool is_fallback(const Node& node) {
  return info_of(node.type).flow == Flow::OnFailure;
}

// Both names have a word in common behind the first of the deed: "OpenDoor" and
// "IsDoorOpen".
bool speak_of_one(std::string_view deed, std::string_view condition) {
  const auto of_deed = words_in(deed);
  const auto of_condition = words_in(condition);
  for (std::size_t i = 1; i < of_deed.size(); ++i) {
    if (std::ranges::count(of_condition, of_deed[i]) > 0) return true;
  }
  return false;
}

class FailureFlow : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    if (is_fallback(node)) look_at_fallback(id, node);
    if (node.type == NodeType::Inverter) {
      look_at_inverter(id, node);
      look_at_skipped_step(id, node);
    }
    const bool chooses =
        node.type == NodeType::IfThenElse || node.type == NodeType::WhileDoElse;
    if (chooses && node.children.size() == 2) look_at_no_else(id, node);
    if (node.type == NodeType::RoundRobin) look_at_round_robin(id, node);
    if (node.type == NodeType::ParallelAll) look_at_parallel_all(id, node);
    if (node.type == NodeType::KeepRunningUntilFailure) {
      look_at_loop(id, node);
    }
  }

 private:
  bool is_relied_on(NodeId id) const { return facts_.is_relied_on(id); }

  void look_at_fallback(NodeId id, const Node& node) {
    if (node.children.size() < 2) return;
    look_at_warning(id, node);
    look_at_emergency(id, node);
  }

  // Bad tidings make the Fallback succeed: what it should do counts as done.
  void look_at_warning(NodeId id, const Node& node) {
    if (!is_relied_on(id) && !is_in_loop(id)) return;
    for (std::size_t i = 0; i + 1 < node.children.size(); ++i) {
      const auto [leaf, is_bad, is_turned] = warning_of(node.children[i]);
      if (!is_bad || !facts_.has_deed(node.children.back())) continue;
      Suspicion& made =
          add({.code = "BT2207",
               .node = id,
               .others = {leaf, node.children.back()},
               .message = fmt::format(
                   "{} succeeds when {} says{} that something is wrong",
                   told(id), told(leaf), is_turned ? " by its failure" : ""),
               .why = fmt::format("{} then counts as done without having run",
                                  told(node.children.back())),
               .help = "let the warning fail: a ReactiveSequence with the "
                       "condition first",
               .repairs = warned_first(id, node, i)});
      made.shown_by.push_back({node.children[i], LocationRole::Success});
      made.then = Consequence{id, LocationRole::Success};
    }
  }

  // Fallback(warning, act) as ReactiveSequence(not warning, act).
  std::vector<Repair> warned_first(NodeId id, const Node& node,
                                   std::size_t warning) const {
    if (warning != 0 || node.children.size() != 2) return {};
    const NodeId asked = node.children[0];
    const bool is_turned = facts_.node(asked).type == NodeType::Inverter;
    const TreeEdit turn =
        is_turned
            ? TreeEdit(UnwrapNode{place(asked)})
            : TreeEdit(WrapNodes{whole(asked), whole(asked), {"Inverter"}});
    return {{turn, ChangeType{place(id), "ReactiveSequence"}}};
  }

  bool is_in_loop(NodeId id) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const Node& parent = facts_.node(facts_.parent(id));
      if (is_endless(parent) || parent.type == NodeType::Repeat ||
          parent.type == NodeType::Loop ||
          parent.type == NodeType::OtherDecorator) {
        return true;
      }
    }
    return false;
  }

  struct Warning {
    NodeId leaf{};
    bool is_bad = false;     // where the child succeeds
    bool is_turned = false;  // which it does where the leaf fails
  };
  // A condition, with an Inverter around it or none.
  Warning warning_of(NodeId id) const {
    bool is_turned = false;
    id = facts_.core(id);
    if (facts_.node(id).type == NodeType::Inverter) {
      is_turned = true;
      id = facts_.core(facts_.node(id).children[0]);
    }
    const Node& node = facts_.node(id);
    if (node.type != NodeType::Condition && !facts_.is_condition(id)) return {};
    const Tidings tidings = tidings_of(node.id.empty() ? node.name : node.id);
    return {id, tidings == (is_turned ? Tidings::Good : Tidings::Bad),
            is_turned};
  }

  // Fallback(Sequence(emergency, act), mission): when `act` fails, the mission
  // goes on as if there were no emergency.
  void look_at_emergency(NodeId id, const Node& node) {
    const NodeId branch = facts_.core(node.children[0]);
    const Node& handling = facts_.node(branch);
    const bool is_sequence = info_of(handling.type).flow == Flow::OnSuccess;
    if (!is_sequence || handling.children.size() < 2) return;
    const auto [leaf, is_bad, is_turned] = warning_of(handling.children[0]);
    const NodeId acts = handling.children.back();
    if (!is_bad || !facts_.has_deed(acts) || !facts_.answers(acts).failure) {
      return;
    }
    if (!facts_.has_deed(node.children[1])) return;
    // Of more than two, each is what is done where those before it cannot be: a
    // list of priorities.
    const bool is_list = node.children.size() > 2;
    const auto said = facts_.said(acts, &LeafMeaning::may_be_lost);
    if (said == true) return;
    Suspicion& made = add(
        {.code = is_list && !said ? "BT2507" : "BT2207",
         .severity = is_list && !said ? Severity::Note : Severity::Warning,
         .node = branch,
         .others = {id, leaf},
         .message = fmt::format(
             "the mission goes on although {} {}, when what follows it fails{}",
             told(leaf), is_turned ? "failed" : "succeeded",
             is_list && !said ? ": is that meant?" : ""),
         .why = fmt::format("{} takes this failure for a {} that {}", told(id),
                            told(leaf), is_turned ? "succeeded" : "failed"),
         .help = "retry what follows, or end the mission when it fails",
         .rank = 40});
    made.shown_by.push_back({acts, LocationRole::Failure});
    made.then = Consequence{branch, LocationRole::Failure};
  }

  // An Inverter around something that is done: its failure becomes success.
  void look_at_inverter(NodeId id, const Node& node) {
    const NodeId child = node.children[0];
    const Answers& answers = facts_.answers(child);
    const NodeId core = facts_.core(child);
    const bool is_sequence =
        info_of(facts_.node(core).type).flow == Flow::OnSuccess;
    if (!is_sequence || !answers.success || !answers.failure) return;
    for (const NodeId each : facts_.node(core).children) {
      const NodeId deed = facts_.core(each);
      const Answers& of = facts_.answers(deed);
      if (!facts_.is_deed(deed) || !of.failure || !of.success ||
          facts_.said(deed, &LeafMeaning::may_be_lost) == true) {
        continue;
      }
      TreeFinding& finding = add_inverted(id, deed).finding;
      finding.help =
          "invert the condition alone, in a Fallback before the action";
      finding.repairs = inverted_alone(id, child);
      return;
    }
  }

  // Inverter(Sequence(condition, act)) as Fallback(Inverter(condition), act).
  std::vector<Repair> inverted_alone(NodeId inverter, NodeId sequence) const {
    const auto& children = facts_.node(sequence).children;
    if (children.size() != 2 ||
        !facts_.is_condition(facts_.core(children[0]))) {
      return {};
    }
    const SourcePlace asked = place(children[0]);
    return {{ChangeType{place(inverter), "Fallback"},
             UnwrapNode{place(sequence)},
             WrapNodes{asked, asked, {"Inverter"}}}};
  }

  // Sequence(Sequence(Inverter(is open), open), go through): where it is open
  // already, the mission fails.
  void look_at_skipped_step(NodeId id, const Node& node) {
    const NodeId asked = facts_.core(node.children[0]);
    const Node& condition = facts_.node(asked);
    if (condition.type != NodeType::Condition || facts_.is_root(id) ||
        tidings_of(condition.id) != Tidings::Neither) {
      return;
    }
    const NodeId step = facts_.parent(id);
    if (facts_.is_root(step) || facts_.node(step).children.back() == id) return;
    const NodeId whole = facts_.parent(step);
    const auto is_sequence = [&](NodeId each) {
      return info_of(facts_.node(each).type).flow == Flow::OnSuccess &&
             facts_.node(each).children.size() > 1;
    };
    if (!is_sequence(step) || !is_sequence(whole) || is_reactive_left(step)) {
      return;
    }
    Suspicion& made =
        add({.code = "BT2208",
             .node = id,
             .others = {asked, step, whole},
             .message = fmt::format("{} fails as a whole when {} is so already",
                                    told(whole), told(asked)),
             .why = fmt::format("the step {} is not needed then, and fails",
                                told(step)),
             .help = fmt::format(
                 "make it a Fallback: {}, or what is to be done", told(asked)),
             .repairs = done_unless(id, asked, step)});
    made.shown_by.push_back({asked, LocationRole::Success});
    made.then = Consequence{whole, LocationRole::Failure};
  }

  // Sequence(Inverter(is open), open) as Fallback(is open, open): where the
  // names say that one is about what the other does. Of Sequence(Inverter(is
  // low), drive) nobody knows that it may count as done.
  std::vector<Repair> done_unless(NodeId inverter, NodeId asked,
                                  NodeId step) const {
    const auto leaves = facts_.leaves(step);
    const bool is_about_it = std::ranges::any_of(leaves, [&](NodeId leaf) {
      return facts_.is_deed(leaf) &&
             speak_of_one(facts_.node(leaf).id, facts_.node(asked).id);
    });
    if (!is_about_it) return {};
    return {{ChangeType{place(step), "Fallback"}, UnwrapNode{place(inverter)}}};
  }

  // Sequence(IfThenElse(is shut, open), go through): where it is open already,
  // the mission fails.
  void look_at_no_else(NodeId id, const Node& node) {
    const bool is_bad = warning_of(node.children[0]).is_bad;
    const NodeId asked = facts_.core(node.children[0]);
    if (facts_.node(asked).type != NodeType::Condition &&
        facts_.node(asked).type != NodeType::Script && !is_bad) {
      return;
    }
    if (tidings_of(facts_.node(asked).id) == Tidings::Good) return;
    if (!facts_.has_deed(node.children[1]) || facts_.is_root(id)) return;
    const NodeId whole = facts_.parent(id);
    const Node& above = facts_.node(whole);
    const bool goes_on = info_of(above.type).flow == Flow::OnSuccess &&
                         !is_reactive(above) && above.children.back() != id;
    if (!goes_on) return;
    Suspicion& made = add(
        {.code = "BT2208",
         .node = id,
         .others = {asked, whole},
         .message = fmt::format("{} fails as a whole when {} is not so",
                                told(whole), told(asked)),
         .why = fmt::format("{} is not needed then, and without an else the "
                            "node fails",
                            told(node.children[1])),
         .help = "give it a third child: AlwaysSuccess"});
    made.shown_by.push_back({node.children[0], LocationRole::Failure});
    made.then = Consequence{whole, LocationRole::Failure};
  }

  // A check that a reactive node makes in each tick.
  bool is_reactive_left(NodeId step) const {
    const Node& above = facts_.node(facts_.parent(step));
    return is_reactive(above);
  }

  // Of the releases, only main ends the round so; a tree that names none may
  // come to run there.
  void look_at_round_robin(NodeId id, const Node& node) {
    const NodeId last = node.children.back();
    if (node.option) {
      const bool says = std::ranges::any_of(
          node.arguments,
          [](const Argument& each) { return each.key == "wrap_around"; });
      const Profile profile = facts_.tree().profile;
      const bool may_upgrade = has_nav2(profile) && !is_release_3(profile);
      if (says || !may_upgrade || !wraps_round(profile)) return;
      add({.code = "BT2208",
           .severity = Severity::Note,
           .node = id,
           .others = {last},
           .message = fmt::format("on Nav2 main, {} fails although {} succeeds",
                                  told(id), told(last)),
           .why = "there, its round ends with its last child, whatever that "
                  "answers",
           .help = "set wrap_around=\"true\" before you change to main"});
      return;
    }
    Suspicion& made =
        add({.code = "BT2208",
             .node = id,
             .others = {last},
             .message = fmt::format("{} fails although {} succeeds", told(id),
                                    told(last)),
             .why = "its round ends with its last child, whatever that answers",
             .help = "set wrap_around=\"true\"",
             .repairs = {{SetAttribute{place(id), "wrap_around", "true"}}}});
    made.shown_by.push_back({last, LocationRole::Success});
    made.then = Consequence{id, LocationRole::Failure};
  }

  void look_at_parallel_all(NodeId id, const Node& node) {
    if (node.failure_threshold != 0 || !is_engine(facts_.tree().profile)) {
      return;
    }
    Suspicion& made =
        add({.code = "BT2208",
             .node = id,
             .others = node.children,
             .message =
                 fmt::format("{} fails although no child of it does", told(id)),
             .why = "with max_failures=\"0\" no failure is needed",
             .help = "set max_failures=\"1\" to fail when one child fails",
             .repairs = {{SetAttribute{place(id), "max_failures", "1"}}}});
    made.shown_by.push_back({id, LocationRole::Failure});
  }

  // KeepRunningUntilFailure with a queue: the end of the work is a failure, as
  // is any trouble with it.
  void look_at_loop(NodeId id, const Node& node) {
    if (facts_.is_root(facts_.parent(id)) || !ends_mission(id)) return;
    std::vector<NodeId> ways;
    for (const NodeId leaf : facts_.leaves(id)) {
      if (facts_.answers(leaf).failure && facts_.fails_with(id, leaf)) {
        ways.push_back(leaf);
      }
    }
    const NodeId child = facts_.core(node.children[0]);
    const bool is_sequence =
        info_of(facts_.node(child).type).flow == Flow::OnSuccess;
    if (ways.size() < 2 || !is_sequence) return;
    Suspicion& made = add(
        {.code = "BT2208",
         .node = id,
         .others = ways,
         .message = fmt::format("the mission fails when the work of {} is done",
                                told(id)),
         .why = fmt::format("it can only fail: by {} as by {}", told(ways[0]),
                            told(ways[1])),
         .help = "put an Inverter around the loop, and let trouble fail behind "
                 "it"});
    made.shown_by.push_back({ways[0], LocationRole::Failure});
    made.then = Consequence{id, LocationRole::Failure};
  }

  // The failure of the node is that of the tree.
  bool ends_mission(NodeId id) const {
    auto answer = std::optional(LocationRole::Failure);
    for (; answer && !facts_.is_root(id); id = facts_.parent(id)) {
      answer = facts_.decided(facts_.parent(id), id, *answer);
    }
    return answer == LocationRole::Failure;
  }
};

}  // namespace

void suspect_failure_flow(const TreeFacts& facts, Suspicions& found) {
  FailureFlow look(facts, found);
  look_at_nodes(facts, look);
}

namespace {

bool tries_again(const Node& node) {
  const Flow flow = info_of(node.type).flow;
  return (flow == Flow::Recovers || flow == Flow::Retries) &&
         node.repetitions != 0;
}

// What an event asks for: the last child of the nearest Fallback around it,
// below the nearest node that tries again.
struct AskedWork {
  NodeId retry{};
  NodeId check{};  // the child of the Fallback that the event stands in
  NodeId work{};
};
std::optional<AskedWork> work_asked_by(const TreeFacts& facts, NodeId event) {
  std::optional<AskedWork> asked;
  for (NodeId at = event; !facts.is_root(at); at = facts.parent(at)) {
    const NodeId parent = facts.parent(at);
    const Node& above = facts.node(parent);
    if (is_fallback(above) && above.children.back() != at && !asked) {
      asked = AskedWork{{}, at, facts.core(above.children.back())};
    }
    if (!tries_again(above)) continue;
    if (!asked || above.children[0] != at) return std::nullopt;
    asked->retry = parent;
    return asked;
  }
  return std::nullopt;
}

}  // namespace

// Recovery(Fallback(… GlobalUpdatedGoal …, plan), …): the first attempt sees
// the event and fails in `plan`; the second does not see it any more, and
// succeeds without a plan.
void suspect_lost_events(const TreeFacts& facts, Suspicions& found) {
  const auto& nodes = facts.tree().nodes;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    const NodeId event{n};
    if (nodes[n].contract.memory != LeafMemory::FirstTickOfLifeSucceeds) {
      continue;
    }
    const auto asked = work_asked_by(facts, event);
    if (!asked || !facts.answers(asked->work).failure) continue;
    const auto& [retry, check, work] = *asked;
    found.push_back(
        {.finding = {.code = "BT2207",
                     .node = event,
                     .others = {retry, work},
                     .message =
                         fmt::format("{} succeeds although {} has failed",
                                     facts.told(retry), facts.told(work)),
                     .why = fmt::format("it tells of an event once; the second "
                                        "attempt does without {}",
                                        facts.told(work)),
                     .help = fmt::format("retry {} alone, inside the Fallback",
                                         facts.told(work))},
         .shown_by = {{check, LocationRole::Success, {}, retry}},
         .then = Consequence{retry, LocationRole::Success},
         .after = Consequence{work, LocationRole::Failure}});
  }
}

}  // namespace btcheck

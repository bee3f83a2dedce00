// SPDX-License-Identifier: MIT
//
// What is possible as the tree stands, and its owner may have meant: one
// Parallel child that halts another (BT2502), a failure that nobody hears of
// (BT2503), a limit that decides anew in each tick (BT2504), a loop whose
// rounds may all fall into one tick (BT2505), an answer that calls work off and
// is its success (BT2506), one leaf that two branches command at once (BT2509),
// a guard that halts what it guards by running itself (BT2510), and a loop that
// ends with its first failed round (BT2511).
//
// The names of leaves make and silence none of these: they change the order in
// which they are asked. What their owner has answered (leaf_meaning.hpp) does.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

class OpenQuestions : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    if (!is_engine(facts_.tree().profile)) return;
    if (node.type == NodeType::Parallel) ask_cut_off(id, node);
    const bool begins_before_halting =
        node.type == NodeType::ReactiveSequence ||
        node.type == NodeType::ReactiveFallback;
    if (begins_before_halting || info_of(node.type).beside == Beside::Counted) {
      ask_two_commands(id);
    }
    if (node.type == NodeType::ForceSuccess) ask_forgiven(id);
    if (is_reactive(node)) {
      ask_limit(id, node);
      ask_running_guard(id, node);
    }
    if (info_of(node.type).flow == Flow::Repeats) ask_failed_round(id, node);
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
    CutOff by_success;
    CutOff by_failure;
    if (needed == 1 && count > 1) {
      by_success = cut_off_by(node, LocationRole::Success);
    }
    if (allowed == 1) by_failure = cut_off_by(node, LocationRole::Failure);
    if (by_success.halted.empty()) std::swap(by_success, by_failure);
    if (by_success.halted.empty()) return;
    add_cut_off(id, by_success, by_failure);
  }

  bool may_answer(NodeId child, LocationRole answer) const {
    const Answers& answers = facts_.answers(child);
    return answer == LocationRole::Success ? answers.success : answers.failure;
  }

  struct CutOff {
    NodeId ending{};
    LocationRole answer{};
    std::vector<NodeId> halted;  // empty: nothing is cut off
  };

  // The work of a child is halted since another one has ended so. That a
  // failure ends no more than was to be done by its own side is no loss.
  CutOff cut_off_by(const Node& node, LocationRole answer) const {
    const bool succeeds = answer == LocationRole::Success;
    std::size_t most = 0;
    for (const NodeId child : node.children) {
      if (may_be_lost(child)) most = std::max(most, facts_.deeds(child));
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
        const bool is_lost = child != ending && may_be_lost(child) &&
                             facts_.deeds(child) > least;
        if (is_lost) halted.push_back(child);
      }
      if (!halted.empty()) return {ending, answer, std::move(halted)};
    }
    return {};
  }

  // Work that a halt would cut off, and nobody has said that this may be.
  bool may_be_lost(NodeId child) const {
    return is_work(child) && facts_.may_run(child) &&
           facts_.said(child, &LeafMeaning::may_be_cut_off) != true;
  }

  // `other` is told with it where it halts the same.
  void add_cut_off(NodeId id, const CutOff& first, const CutOff& other) {
    const auto& [ending, answer, halted] = first;
    const bool succeeds = answer == LocationRole::Success;
    const bool is_either =
        other.halted == halted && other.ending == ending && succeeds;
    Suspicion& made = add(asked(
        {.code = "BT2502",
         .node = id,
         .others = {ending},
         .message = fmt::format("{} halts {} when {} has {}", told(id),
                                facts_.few(halted), told(ending),
                                is_either  ? "ended, either way"
                                : succeeds ? "succeeded"
                                           : "failed"),
         .why = succeeds ? "one success is enough for it"
                         : "it fails with the first of its children",
         .help = succeeds
                     ? "ask for the success of all, if all have to be done"
                     : fmt::format("put a ForceSuccess around {}, if it may "
                                   "fail without harm",
                                   told(ending)),
         .rank = succeeds ? 10 : 15},
        "may that be cut off?",
        facts_.said(halted, &LeafMeaning::may_be_cut_off),
        "by a contract it may not be cut off"));
    made.finding.others.insert(made.finding.others.end(), halted.begin(),
                               halted.end());
    const NodeStatus status =
        succeeds ? NodeStatus::Success : NodeStatus::Failure;
    for (const NodeId each : halted) {
      made.shown_by.push_back({each, LocationRole::Halt, {{ending, status}}});
    }
  }

  // --- Two branches command one leaf ----------------------------------------

  // Parallel(… GoTo goal="charger" …, … GoTo goal="a" …): whoever comes last
  // has it. A reactive node begins the one to the left before it halts the
  // other (BehaviorTree.CPP #1031).
  void ask_two_commands(NodeId id) {
    std::unordered_map<std::string_view, std::pair<NodeId, NodeId>> first_of;
    for (const NodeId child : facts_.node(id).children) {
      ask_budget();
      for (const NodeId leaf : facts_.leaves(child)) {
        const Node& node = facts_.node(leaf);
        if (!facts_.is_deed(leaf) || facts_.is_constant(leaf)) continue;
        const auto [known, is_new] =
            first_of.emplace(node.id, std::pair(child, leaf));
        const auto [other_child, other] = known->second;
        const bool clashes = !is_new && other_child != child &&
                             (facts_.may_run(leaf) || facts_.may_run(other)) &&
                             may_clash(node, facts_.node(other));
        // Once of a type of leaf, wherever it is so.
        if (!clashes || !commanded_.insert(node.id).second) continue;
        return add_two_commands(id, other, leaf);
      }
    }
  }

  // They tell the same server different things; the ports are those that
  // BehaviorTree.ROS2 and Nav2 name it by.
  static bool may_clash(const Node& one, const Node& other) {
    constexpr std::string_view kServers[] = {"server_name", "service_name",
                                             "action_name", "topic_name"};
    const auto goes_to = [&](const Node& node, std::string_view port) {
      const auto found =
          std::ranges::find(node.arguments, port, &Argument::key);
      return found == node.arguments.end() ? std::string() : found->value;
    };
    const bool is_one_server =
        std::ranges::all_of(kServers, [&](std::string_view port) {
          return goes_to(one, port) == goes_to(other, port);
        });
    return is_one_server &&
           !std::ranges::equal(one.arguments, other.arguments, {},
                               &Argument::value, &Argument::value);
  }

  void add_two_commands(NodeId id, NodeId one, NodeId other) {
    const bool halts = is_reactive(facts_.node(id));
    Suspicion& made =
        add({.code = "BT2509",
             .severity = Severity::Note,
             .node = one,
             .others = {other, id},
             .message = fmt::format(
                 "{} and {} may be done at once, with different values: does "
                 "one of them take it from the other?",
                 told(one), told(other)),
             .why = halts ? fmt::format("{} begins the one before it halts the "
                                        "other",
                                        told(id))
                          : fmt::format("{} ticks both sides in each tick",
                                        told(id)),
             .help = "if so, let one side wait for the other",
             .rank = halts ? 44 : 11});
    made.shown_by.push_back(
        {one, LocationRole::Tick, {{other, NodeStatus::Running}}});
    if (halts) return;
    made.shown_by.push_back(
        {other, LocationRole::Tick, {{one, NodeStatus::Running}}});
  }

  // --- A guard that halts what it guards by running itself ------------------

  // ReactiveFallback(Sequence(LookAround, is it there), GoOn): while LookAround
  // runs, GoOn is halted.
  void ask_running_guard(NodeId id, const Node& node) {
    for (std::size_t i = 0; i + 1 < node.children.size(); ++i) {
      const NodeId child = node.children[i];
      const NodeId first = facts_.leaves(child).front();
      const NodeId work = node.children[i + 1];
      const bool may_halt = facts_.is_deed(first) && facts_.may_run(first) &&
                            facts_.answers(child).runs && is_lasting(work) &&
                            comes_past(child, node);
      if (!may_halt) continue;
      Suspicion& made =
          add({.code = "BT2510",
               .severity = Severity::Note,
               .node = first,
               .others = {work, id},
               .message = fmt::format("{} is begun again in every tick, and "
                                      "halts {} when it runs itself: does it "
                                      "always answer at once?",
                                      told(first), told(work)),
               .why = fmt::format("{} begins with its first child in each tick",
                                  told(id)),
               .help = fmt::format("if so, say it by a contract: (defaction {} "
                                   ":returns (success failure))",
                                   facts_.node(first).id),
               .rank = facts_.node(first).is_guessed ? 48 : 28});
      const Sighting halted = {
          work, LocationRole::Halt, {{child, NodeStatus::Running}}};
      made.shown_by.push_back(halted);
      add_never_lasts(id, first, work, halted);
      return;
    }
  }

  // On no run is the work ticked a second time: each time that it has begun it
  // is halted by what is asked before it.
  void add_never_lasts(NodeId id, NodeId first, NodeId work,
                       const Sighting& halted) {
    Suspicion& made =
        add({.code = "BT2210",
             .node = id,
             .others = {work, first},
             .message = fmt::format("{} is always halted when it takes more "
                                    "than a tick",
                                    told(work)),
             .why = fmt::format("{} is begun again in the next tick, and runs: "
                                "{} halts what stands behind it",
                                told(first), told(id)),
             .help = fmt::format("let {} answer at once, or ask it once",
                                 told(first))});
    made.shown_by.push_back(halted);
    made.cleared_by.push_back(
        {work, LocationRole::Tick, {{work, NodeStatus::Running}}});
  }

  // The child may give the answer with which the node goes on behind it.
  bool comes_past(NodeId child, const Node& above) const {
    return may_answer(child, info_of(above.type).flow == Flow::OnFailure
                                 ? LocationRole::Failure
                                 : LocationRole::Success);
  }

  // --- A loop that ends with its first failed round -------------------------

  // Repeat(-1, Sequence(NextPoint, Drive)): a point that cannot be reached ends
  // all of it.
  void ask_failed_round(NodeId id, const Node& node) {
    const bool is_short = !is_endless(node) && node.repetitions <= 1 &&
                          node.repetitions != kOpenRounds;
    if (is_short || would_help(id)) return;
    const std::vector<NodeId> ways = deeds_that_fail(id);
    if (ways.empty()) return;
    Suspicion& made =
        add({.code = "BT2511",
             .severity = Severity::Note,
             .node = id,
             .others = ways,
             .message = fmt::format("{} ends for good when {} fails: is there "
                                    "no next round to try?",
                                    told(id), one_of(ways)),
             .why = "a Repeat fails with its child",
             .help = "put a ForceSuccess around what may fail in a round",
             .rank = is_endless(node) ? 22 : 46});
    made.shown_by.push_back({ways.front(), LocationRole::Failure});
    made.then = Consequence{id, LocationRole::Failure};
  }

  std::string one_of(const std::vector<NodeId>& nodes) const {
    if (nodes.size() == 1) return told(nodes[0]);
    return fmt::format("{} or {}", told(nodes[0]),
                       nodes.size() == 2
                           ? told(nodes[1])
                           : fmt::format("one of {} more", nodes.size() - 1));
  }

  // Whose failure ends a round.
  std::vector<NodeId> deeds_that_fail(NodeId loop) const {
    std::vector<NodeId> deeds = facts_.leaves(loop);
    std::erase_if(deeds, [&](NodeId leaf) {
      return !facts_.is_deed(leaf) || !facts_.answers(leaf).failure ||
             facts_.is_constant(leaf) || !facts_.fails_with(loop, leaf);
    });
    return deeds;
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
      const auto said = facts_.said(work, &LeafMeaning::may_be_cut_off);
      if (said == true) return;
      Suspicion& made = add(btcheck::asked(
          {.code = "BT2506",
           .node = asked,
           .others = {work, id},
           .message = fmt::format("{} calls {} off, and that counts as its "
                                  "success",
                                  told(asked), told(work)),
           .why = fmt::format("{} succeeds with the first child that does",
                              told(id)),
           .help = fmt::format("if not, let {} fail then: put an Inverter "
                               "around {}, under a ReactiveSequence",
                               told(id), told(asked)),
           .rank = tidings_of(facts_.node(asked).id) == Tidings::Bad ? 13 : 45},
          "is that meant?", said, "by a contract it may not be cut off"));
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
    const auto said = facts_.said(child, &LeafMeaning::may_be_lost);
    const auto helper = would_help(id);
    if (said == true || (!helper && !has_more_behind(id))) return;
    const bool is_needed = prepares(facts_.node(facts_.core(child)).id);
    Suspicion& made = add(asked(
        {.code = "BT2503",
         .node = id,
         .others = {child},
         .message = helper ? fmt::format("{} may fail, and {} never hears "
                                         "of it",
                                         told(child), told(*helper))
                           : fmt::format("the mission goes on when {} has "
                                         "failed",
                                         told(child)),
         .why = "it turns the failure into success",
         .help = fmt::format("take {} away, if it matters", told(id)),
         .repairs = {{UnwrapNode{place(id)}}},
         .rank = is_needed ? 9
                 : helper  ? 20
                           : 50},
        "is that meant?", said, "by a contract its failure may not be lost"));
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
      const NodeId limit = asked_in(guarded.children[0]);
      const NodeId work = guarded.children.back();
      if (!is_lasting(work) || !is_limit(limit, branch)) continue;
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
      made.shown_by.push_back({guarded.children[0],
                               LocationRole::Failure,
                               {{work, NodeStatus::Running}}});
      return;
    }
  }

  bool is_lasting(NodeId id) const {
    return facts_.has_deed(id) && facts_.may_run(id);
  }

  // With an Inverter around it or none.
  NodeId asked_in(NodeId child) const {
    const NodeId core = facts_.core(child);
    const Node& node = facts_.node(core);
    return node.type == NodeType::Inverter ? facts_.core(node.children[0])
                                           : core;
  }

  // It compares what is measured with a number, and nothing in its branch asks
  // the same with another one.
  bool is_limit(NodeId asked, NodeId branch) const {
    const Node& node = facts_.node(asked);
    if (node.type == NodeType::Script) return compares_measured(asked);
    const bool has_number =
        std::ranges::any_of(node.arguments, [](const Argument& each) {
          return as_number<double>(each.value).has_value();
        });
    if (!facts_.is_condition(asked) || !has_number) return false;
    const std::vector<NodeId> leaves = facts_.leaves(branch);
    return std::ranges::none_of(leaves, [&](NodeId leaf) {
      return leaf != asked && facts_.node(leaf).id == node.id;
    });
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

  std::set<std::string_view> commanded_;  // IDs that two commands are told of
};

}  // namespace

void suspect_open_questions(const TreeFacts& facts, Suspicions& found) {
  OpenQuestions look(facts, found);
  look_at_nodes(facts, look);
}

}  // namespace btcheck

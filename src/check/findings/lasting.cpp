// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// Whether something is done on a way, by the nodes that may be ticked there.
using Undoes = std::function<bool(NodeId)>;

class Lasting : Look {
 public:
  Lasting(const TreeFacts& facts, Suspicions& found) : Look(facts, found) {
    for (const Node& node : facts.tree().nodes) {
      ++count_[node.id];
      words_.insert(words_in(node.id));
    }
  }

  void look_at(NodeId id, const Node& node) {
    if (facts_.is_deed(id)) look_at_pair(id);
    if (node.type == NodeType::Script) look_at_claim(id);
    if (node.type == NodeType::PathLongerOnApproach) look_at_path(id);
  }

  // An entry that a loop changes in one direction only, asked in the loop.
  void look_at_latches() {
    std::set<std::uint32_t> told_of;
    for (const EntryUse& asked : facts_.uses()) {
      if (!is_question(asked) || told_of.contains(asked.entry)) continue;
      for (NodeId at = asked.node; !facts_.is_root(at);
           at = facts_.parent(at)) {
        const NodeId loop = facts_.parent(at);
        if (!goes_round(facts_.node(loop))) continue;
        if (look_at_latch(asked, loop)) {
          told_of.insert(asked.entry);
          break;
        }
      }
    }
  }

 private:
  bool any_in(NodeId above, const Undoes& undoes) const {
    const std::vector<NodeId> nodes = facts_.subtree(above);
    return std::ranges::any_of(nodes, undoes);
  }

  // --- Begun and not ended ---------------------------------------------------

  // A way on which `begun` succeeds, what follows it fails, and the mission
  // ends without a node that undoes it.
  struct Way {
    NodeId failing{};
    NodeId sequence{};
    NodeId ended{};  // the node that would have undone it
  };
  std::optional<Way> open_way(NodeId begun, const Undoes& undoes) const {
    for (NodeId at = begun; !facts_.is_root(at); at = facts_.parent(at)) {
      const NodeId parent = facts_.parent(at);
      const Node& above = facts_.node(parent);
      if (info_of(above.type).flow != Flow::OnSuccess) {
        if (above.children.size() > 1) return std::nullopt;
        continue;
      }
      std::optional<NodeId> failing;
      for (std::size_t i = facts_.place_of(at) + 1; i < above.children.size();
           ++i) {
        const NodeId child = above.children[i];
        if (any_in(child, undoes)) {
          if (!failing || is_undone_above(parent, undoes)) return std::nullopt;
          return Way{*failing, parent, child};
        }
        if (!failing && facts_.answers(child).failure) failing = child;
      }
      if (failing) return std::nullopt;  // undone further up, if at all
    }
    return std::nullopt;
  }

  // After a failure of the node: is it undone before the mission ends?
  bool is_undone_above(NodeId id, const Undoes& undoes) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const Node& above = facts_.node(facts_.parent(id));
      const Flow flow = info_of(above.type).flow;
      const bool goes_on = flow != Flow::OnSuccess && flow != Flow::AsChild &&
                           flow != Flow::Inverts;
      if (!goes_on) continue;
      for (std::size_t i = facts_.place_of(id) + 1; i < above.children.size();
           ++i) {
        if (any_in(above.children[i], undoes)) return true;
      }
      if (flow == Flow::Succeeds &&
          is_undone_behind(facts_.parent(id), undoes)) {
        return true;
      }
    }
    return false;
  }
  bool is_undone_behind(NodeId id, const Undoes& undoes) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const Node& above = facts_.node(facts_.parent(id));
      for (std::size_t i = facts_.place_of(id) + 1; i < above.children.size();
           ++i) {
        if (any_in(above.children[i], undoes)) return true;
      }
    }
    return false;
  }

  // StartVacuum, and StopVacuum that a failure leaves out.
  void look_at_pair(NodeId id) {
    const auto undoing = words_of_undoing(facts_.node(id).id);
    const bool is_alone = undoing.empty() ? count_.at(facts_.node(id).id) < 2
                                          : !words_.contains(undoing);
    if (is_alone) return;
    const Undoes undoes = [&](NodeId node) {
      const Node& other = facts_.node(node);
      return undoing.empty() ? is_switched_back(facts_.node(id), other)
                             : words_in(other.id) == undoing;
    };
    const auto way = open_way(id, undoes);
    if (!way) return;
    const std::vector<NodeId> all = facts_.subtree(way->ended);
    const NodeId ended = *std::ranges::find_if(all, undoes);
    if (is_done_again_behind(id, way->ended)) return;
    found_.push_back(
        {.finding = {.code = "BT2206",
                     .node = id,
                     .others = {ended, way->failing},
                     .message =
                         fmt::format("{} is not ticked after {} when {} fails",
                                     told(ended), told(id), told(way->failing)),
                     .why = "what is begun here goes on when the mission ends",
                     .help =
                         fmt::format("tick {} on the way out of a failure, too",
                                     told(ended)),
                     .repairs = ended_on_failure(*way)},
         .shown_by = {{way->failing, LocationRole::Failure}},
         .then = Consequence{way->sequence, LocationRole::Failure}});
  }

  // <Brush command="on"/>, <Brush command="off"/>: all else is the same.
  static bool is_switched_back(const Node& on, const Node& off) {
    if (on.id != off.id || on.arguments.size() != off.arguments.size()) {
      return false;
    }
    int switched = 0;
    for (std::size_t i = 0; i < on.arguments.size(); ++i) {
      const Argument& begun = on.arguments[i];
      const Argument& ended = off.arguments[i];
      if (begun.key != ended.key) return false;
      if (begun.value == ended.value) continue;
      if (!is_switch(begun.value, ended.value)) return false;
      ++switched;
    }
    return switched == 1;
  }

  static bool is_switch(std::string_view begun, std::string_view ended) {
    constexpr std::array<std::string_view, 5> kOn = {"on", "start", "true",
                                                     "enable", "activate"};
    constexpr std::array<std::string_view, 5> kOff = {"off", "stop", "false",
                                                      "disable", "deactivate"};
    const auto* on = std::ranges::find(kOn, begun);
    return on != kOn.end() &&
           ended == kOff.at(static_cast<std::size_t>(on - kOn.begin()));
  }

  // Sequence(begin, Fallback(act, ForceFailure(end)), end).
  std::vector<Repair> ended_on_failure(const Way& way) const {
    if (facts_.leaves(way.ended).size() != 1) return {};
    const auto& children = facts_.node(way.sequence).children;
    const SourcePlace first = place(way.failing);
    const SourcePlace last = place(children[facts_.place_of(way.ended) - 1]);
    const NewNode ending{"ForceFailure", {}, place(way.ended)};
    Repair repair = {WrapNodes{first, last, {"Fallback"}, {}, {ending}}};
    if (first != last) repair.push_back(WrapNodes{first, last, {"Sequence"}});
    return {repair};
  }

  // OpenHand, CloseHand, OpenHand: a move, not something that goes on.
  bool is_done_again_behind(NodeId begun, NodeId ended) const {
    const Node& first = facts_.node(begun);
    const auto& nodes = facts_.tree().nodes;
    return std::any_of(
        nodes.begin() + index(ended), nodes.end(), [&](const Node& node) {
          return node.id == first.id &&
                 std::ranges::equal(node.arguments, first.arguments, {},
                                    &Argument::value, &Argument::value);
        });
  }

  // --- Entries ---------------------------------------------------------------

  // `lock := 'me'` …, `lock := 'free'`: a failure between leaves it taken.
  void look_at_claim(NodeId id) {
    for (const EntryUse& claim : facts_.uses()) {
      if (claim.node != id || !claim.writes || claim.literal.empty()) continue;
      const Undoes undoes = [&](NodeId node) {
        return std::ranges::any_of(facts_.uses(), [&](const EntryUse& use) {
          return use.node == node && use.entry == claim.entry && use.writes &&
                 use.literal != claim.literal;
        });
      };
      const auto way = open_way(id, undoes);
      if (!way || is_undone_by_handlers(id, way->sequence, undoes)) continue;
      const auto asked = asked_again(way->sequence, claim.entry);
      if (!asked) continue;
      const std::string& entry = facts_.tree().entries[claim.entry];
      found_.push_back(
          {.finding = {.code = "BT2206",
                       .node = id,
                       .others = {way->failing, *asked},
                       .message =
                           fmt::format("`{}` keeps {} when {} fails", entry,
                                       claim.literal, told(way->failing)),
                       .why = fmt::format(
                           "the next attempt finds it so, and {} fails",
                           told(*asked)),
                       .help = fmt::format("set it back in an _onFailure of {}",
                                           told(way->sequence)),
                       .repairs = freed_on_failure(*way, claim.entry)},
           .shown_by = {{way->failing, LocationRole::Failure}},
           .then = Consequence{way->sequence, LocationRole::Failure}});
      return;
    }
  }

  std::vector<Repair> freed_on_failure(const Way& way,
                                       std::uint32_t entry) const {
    if (facts_.node(way.sequence).script(ScriptTime::OnFailure)) return {};
    for (const EntryUse& use : facts_.uses()) {
      const bool frees = use.entry == entry && use.writes &&
                         !use.literal.empty() &&
                         facts_.is_in(use.node, way.ended);
      if (!frees) continue;
      return {{SetAttribute{place(way.sequence), "_onFailure",
                            assigned(entry, use.literal)}}};
    }
    return {};
  }

  std::string assigned(std::uint32_t entry, std::string_view literal) const {
    return fmt::format("{} := {}", facts_.tree().entries[entry], literal);
  }

  // _onFailure and _post of what fails around the claim.
  bool is_undone_by_handlers(NodeId claim, NodeId sequence,
                             const Undoes& undoes) const {
    for (NodeId at = claim; !facts_.is_root(at); at = facts_.parent(at)) {
      if (at != claim && undoes(at) &&
          (facts_.node(at).script(ScriptTime::OnFailure) ||
           facts_.node(at).script(ScriptTime::Post))) {
        return true;
      }
      if (at == sequence) break;
    }
    return false;
  }

  // A condition on the entry before the sequence, that is asked once more by a
  // loop around both.
  std::optional<NodeId> asked_again(NodeId sequence,
                                    std::uint32_t entry) const {
    for (const EntryUse& use : facts_.uses()) {
      const bool is_condition =
          use.entry == entry && use.reads && !use.is_port &&
          index(use.node) < index(sequence) && facts_.is_condition(use.node);
      if (!is_condition) continue;
      for (NodeId at = sequence; !facts_.is_root(at); at = facts_.parent(at)) {
        const Flow flow = info_of(facts_.node(facts_.parent(at)).type).flow;
        const bool again = flow == Flow::Retries || flow == Flow::Recovers;
        if (again && facts_.is_in(use.node, at)) return use.node;
      }
    }
    return std::nullopt;
  }

  bool is_question(const EntryUse& use) const {
    if (!use.reads || use.is_port) return false;
    if (!use.when) return facts_.is_condition(use.node);
    return *use.when <= ScriptTime::While;
  }

  static bool goes_round(const Node& node) {
    return is_endless(node) ||
           (node.type == NodeType::Repeat && node.repetitions != 1);
  }

  bool look_at_latch(const EntryUse& asked, NodeId loop) {
    std::set<std::string> inside;
    std::set<std::string> outside;
    std::optional<NodeId> sets;
    for (const EntryUse& use : facts_.uses()) {
      if (use.entry != asked.entry || !use.writes) continue;
      if (use.is_port) return false;
      const bool is_inside = facts_.is_in(use.node, loop) && use.node != loop;
      (is_inside ? inside : outside).insert(use.literal);
      if (is_inside) sets = use.node;
    }
    if (inside.size() != 1 || outside.size() != 1) return false;
    if (outside.begin()->empty() || *outside.begin() == *inside.begin()) {
      return false;
    }
    if (!asked.when && ends(asked.node, loop)) return false;
    if (is_done_once(asked.node, *sets)) return false;
    const std::string& entry = facts_.tree().entries[asked.entry];
    std::vector<NodeId> others = {*sets, loop};
    add_neighbours(asked.node, loop, others);
    found_.push_back(
        {.finding = {.code = "BT2216",
                     .node = asked.node,
                     .others = std::move(others),
                     .message =
                         fmt::format("`{}` is never set back to {} in {}",
                                     entry, *outside.begin(), told(loop)),
                     .why = fmt::format(
                         "once {} has changed it, the answer here stays the "
                         "same in every later round",
                         told(*sets)),
                     .help = fmt::format("set `{}` to {} at the beginning of "
                                         "each round",
                                         entry, *outside.begin()),
                     .repairs = set_back(
                         loop, assigned(asked.entry, *outside.begin()))},
         .shown_by = {{*sets, LocationRole::Success}}});
    return true;
  }

  // A Script before all else in the loop.
  std::vector<Repair> set_back(NodeId loop, const std::string& script) const {
    if (!facts_.has_scripts()) return {};
    const NodeId body = facts_.core(facts_.node(loop).children[0]);
    const NewNode first{"Script", {{"code", script}}};
    const bool is_sequence =
        info_of(facts_.node(body).type).flow == Flow::OnSuccess &&
        !is_reactive(facts_.node(body));
    if (is_sequence) {
      return {{InsertBefore{place(facts_.node(body).children[0]), first}}};
    }
    return {{WrapNodes{place(body), place(body), {"Sequence"}, {first}}}};
  }

  // Fallback(is set up, Sequence(set up, note it)), or a _skipIf around what
  // notes it: meant to be done once.
  bool is_done_once(NodeId asked, NodeId sets) const {
    const NodeId above = facts_.parent(asked);
    return facts_.is_in(sets, asked) ||
           (info_of(facts_.node(above).type).flow == Flow::OnFailure &&
            facts_.is_in(sets, above));
  }

  // What is affected: a retry around the question, and what stands beside it.
  void add_neighbours(NodeId asked, NodeId loop,
                      std::vector<NodeId>& others) const {
    for (NodeId at = asked; at != loop; at = facts_.parent(at)) {
      const Node& above = facts_.node(facts_.parent(at));
      if (info_of(above.type).flow == Flow::Retries) {
        others.push_back(facts_.parent(at));
      }
      if (info_of(above.type).flow != Flow::OnFailure) continue;
      others.insert(others.end(), above.children.begin(), above.children.end());
    }
  }

  // Whether the failure of the condition ends the loop.
  bool ends(NodeId condition, NodeId loop) const {
    for (NodeId at = condition; at != loop; at = facts_.parent(at)) {
      const NodeId parent = facts_.parent(at);
      const Flow flow = info_of(facts_.node(parent).type).flow;
      if (parent == loop) return true;
      const bool passes = flow == Flow::OnSuccess || flow == Flow::AsChild ||
                          flow == Flow::UntilFailure || flow == Flow::Repeats;
      if (!passes) return false;
    }
    return true;
  }

  // --- Left running
  // ------------------------------------------------------------

  void look_at_path(NodeId id) {
    const NodeId child = facts_.node(id).children[0];
    if (!facts_.may_run(child)) return;
    found_.push_back(
        {.finding = {.code = "BT2206",
                     .node = id,
                     .others = {child},
                     .message =
                         fmt::format("{} is left running when {} succeeds",
                                     told(child), told(id)),
                     .why = "it answers success without halting its child",
                     .help = "end the child by a condition of its own, above "
                             "or beside it"},
         .shown_by = {
             {id, LocationRole::Success, {{child, NodeStatus::Running}}}}});
  }

  std::map<std::string_view, int> count_;  // of the nodes of an ID
  std::set<std::vector<std::string>> words_;
};

}  // namespace

void suspect_lasting(const TreeFacts& facts, Suspicions& found) {
  Lasting lasting(facts, found);
  look_at_nodes(facts, lasting);
  lasting.look_at_latches();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What outlives the work that it was done for: a leaf that goes on running when
// a node above it has decided (BT2206), an entry or a device that is set and
// never set back (BT2216), or not on every way out of the mission (BT2513).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// The nodes that undo something, in pre-order: the first of them from a node to
// before another. So a branch is asked in the time of a look-up, however large
// it is.
using FirstUndoer = std::function<std::optional<NodeId>(NodeId, NodeId)>;

std::optional<NodeId> first_between(const std::vector<NodeId>& sorted,
                                    NodeId begin, NodeId end) {
  const auto found = std::ranges::lower_bound(sorted, begin);
  if (found == sorted.end() || *found >= end) return std::nullopt;
  return *found;
}

class Lasting : Look {
 public:
  Lasting(const TreeFacts& facts, Suspicions& found) : Look(facts, found) {
    const auto& nodes = facts.tree().nodes;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      ask_budget();
      of_words_[words_in(nodes[n].id)].push_back(NodeId{n});
      as_written_[written(nodes[n])].push_back(NodeId{n});
      last_with_values_[values_of(nodes[n])] = NodeId{n};
      if (facts.is_deed(NodeId{n})) note_values(nodes[n], NodeId{n});
    }
    next_failing_.resize(nodes.size());
    for (const Node& node : nodes) {
      std::optional<NodeId> next;
      for (std::size_t i = node.children.size(); i-- > 0;) {
        next_failing_[index(node.children[i])] = next;
        if (facts.answers(node.children[i]).failure) next = node.children[i];
      }
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
  // Behind a child of the node and all that is below it.
  std::optional<NodeId> first_behind(NodeId child,
                                     const FirstUndoer& undoer) const {
    return undoer(facts_.end_of(child), facts_.end_of(facts_.parent(child)));
  }

  // --- Begun and not ended ---------------------------------------------------

  // A way on which `begun` succeeds, what follows it fails, and the mission
  // ends without a node that undoes it.
  struct Way {
    NodeId failing{};
    NodeId sequence{};
    NodeId ended{};  // the node that would have undone it
  };
  std::optional<Way> open_way(NodeId begun, const FirstUndoer& undoer) const {
    for (NodeId at = begun; !facts_.is_root(at); at = facts_.parent(at)) {
      const NodeId parent = facts_.parent(at);
      const Node& above = facts_.node(parent);
      if (info_of(above.type).flow != Flow::OnSuccess) {
        if (above.children.size() > 1) return std::nullopt;
        continue;
      }
      const std::optional<NodeId> failing = next_failing_[index(at)];
      if (const auto ended = first_behind(at, undoer)) {
        const NodeId child = facts_.child_with(parent, *ended);
        if (!failing || *failing >= child || is_undone_above(parent, undoer)) {
          return std::nullopt;
        }
        return Way{*failing, parent, *ended};
      }
      if (failing) return std::nullopt;  // undone further up, if at all
    }
    return std::nullopt;
  }

  // After a failure of the node: is it undone before the mission ends?
  bool is_undone_above(NodeId id, const FirstUndoer& undoer) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      const Node& above = facts_.node(facts_.parent(id));
      const Flow flow = info_of(above.type).flow;
      const bool goes_on = flow != Flow::OnSuccess && flow != Flow::AsChild &&
                           flow != Flow::Inverts;
      if (!goes_on) continue;
      if (first_behind(id, undoer)) return true;
      if (flow == Flow::Succeeds &&
          is_undone_behind(facts_.parent(id), undoer)) {
        return true;
      }
    }
    return false;
  }
  bool is_undone_behind(NodeId id, const FirstUndoer& undoer) const {
    for (; !facts_.is_root(id); id = facts_.parent(id)) {
      if (first_behind(id, undoer)) return true;
    }
    return false;
  }

  // StartVacuum, and StopVacuum that a failure leaves out.
  void look_at_pair(NodeId id) {
    const LeafMeaning& meaning = facts_.node(id).contract.meaning;
    if (meaning.may_stay == true) return;
    const std::vector<NodeId> undoers = undoers_of(id);
    if (undoers.empty()) return look_at_values(id);
    const auto way = way_without(undoers, id);
    if (!way) return;
    const NodeId ended = way->ended;
    if (meaning.undone_by.empty() &&
        is_done_again_behind(id, facts_.child_with(way->sequence, ended))) {
      return;
    }
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

  // By what the owner says, else by the words of its name, else by its values.
  std::vector<NodeId> undoers_of(NodeId id) const {
    const Node& node = facts_.node(id);
    const auto& said = node.contract.meaning.undone_by;
    if (!said.empty()) return named_otherwise(said, node);
    const auto undoing = words_of_undoing(node.id);
    return undoing.empty() ? switched_back(node) : found_in(of_words_, undoing);
  }

  // Leaves of these names that are not written as the node itself is.
  std::vector<NodeId> named_otherwise(const std::vector<std::string>& names,
                                      const Node& node) const {
    const std::string own = written(node);
    std::vector<NodeId> nodes;
    for (std::uint32_t n = 0; n < facts_.tree().nodes.size(); ++n) {
      ask_budget();
      const bool is_meant = is_leaf(facts_.tree().nodes[n].type) &&
                            facts_.is_named(NodeId{n}, names) &&
                            written(facts_.tree().nodes[n]) != own;
      if (is_meant) nodes.push_back(NodeId{n});
    }
    return nodes;
  }

  std::optional<Way> way_without(const std::vector<NodeId>& undoers,
                                 NodeId begun) const {
    return open_way(begun, [&](NodeId begin, NodeId end) {
      return first_between(undoers, begin, end);
    });
  }

  // --- Two values of one leaf, or of an entry --------------------------------

  // The leaves of a type, by what they are given: as far as there are two ways
  // to write them, and where the last one stands.
  struct Values {
    std::vector<std::string> ways = {};  // at most three
    NodeId last{};
    bool are_literals = true;
  };
  void note_values(const Node& node, NodeId id) {
    Values& values = values_[node.id];
    values.last = id;
    values.are_literals =
        values.are_literals && !node.arguments.empty() &&
        std::ranges::none_of(node.arguments, [](const Argument& each) {
          return each.value.find('{') != each.value.npos;
        });
    const std::string way = written(node);
    if (values.ways.size() < 3 && std::ranges::count(values.ways, way) == 0) {
      values.ways.push_back(way);
    }
  }

  // Gripper action="close", …, Gripper action="open": a failure between leaves
  // it closed. By the values that a leaf is given, or that its script gives an
  // entry, whatever they are called.
  void look_at_values(NodeId id) {
    const Node& node = facts_.node(id);
    const Values& values = values_.at(node.id);
    const Node& last = facts_.node(values.last);
    const bool is_switched = values.are_literals && values.ways.size() == 2 &&
                             written(last) != written(node) &&
                             is_switch(id, node, last);
    if (is_switched) {
      const auto way = way_without(as_written_.at(written(last)), id);
      if (!way) return;
      const NodeId ended = facts_.child_with(way->sequence, way->ended);
      if (is_done_again_behind(id, ended)) return;
      return add_left(id, *way, value_left(node, last));
    }
    for (const EntryUse* use : facts_.uses_of(id)) {
      const bool is_set = use->writes && !use->literal.empty() &&
                          use->when == ScriptTime::OnSuccess;
      if (!is_set) continue;
      const auto way = open_way(id, [&](NodeId begin, NodeId end) {
        return first_deed_that_sets_back(*use, begin, end);
      });
      if (!way) continue;
      return add_left(
          id, *way,
          fmt::format("`{}` stays {}", facts_.tree().entries[use->entry],
                      use->literal));
    }
  }

  // It is set back to what it was, or has two values only: not a way from one
  // place to another.
  bool is_switch(NodeId id, const Node& node, const Node& last) const {
    if (as_written_.at(written(last)).front() < id) return true;
    constexpr std::string_view kTwo[] = {"true", "false", "0", "1"};
    return std::ranges::any_of(node.arguments, [&](const Argument& each) {
      const std::string* other = value_of(last, each.key);
      return other != nullptr && *other != each.value &&
             std::ranges::count(kTwo, each.value) > 0 &&
             std::ranges::count(kTwo, *other) > 0;
    });
  }

  static const std::string* value_of(const Node& node, std::string_view port) {
    const auto found = std::ranges::find(node.arguments, port, &Argument::key);
    return found == node.arguments.end() ? nullptr : &found->value;
  }

  std::string value_left(const Node& node, const Node& last) const {
    for (const Argument& own : node.arguments) {
      const std::string* other = value_of(last, own.key);
      if (other != nullptr && *other == own.value) continue;
      return fmt::format("`{}` stays at {}=\"{}\"", node.id, own.key,
                         own.value);
    }
    return fmt::format("`{}` stays as it is", node.id);
  }

  std::optional<NodeId> first_deed_that_sets_back(const EntryUse& set,
                                                  NodeId begin, NodeId end) {
    auto found = first_other(set, begin, end);
    while (found && !facts_.is_deed(*found)) {
      found = first_other(set, NodeId{index(*found) + 1}, end);
    }
    return found;
  }

  void add_left(NodeId id, const Way& way, std::string left) {
    found_.push_back(
        {.finding = asked(
             {.code = "BT2513",
              .node = id,
              .others = {way.ended, way.failing},
              .message = fmt::format("{} when {} fails, and {} is not ticked",
                                     left, told(way.failing), told(way.ended)),
              .why = "what is set here outlasts the mission then",
              .help = fmt::format("tick {} on the way out of a failure, too",
                                  told(way.ended)),
              .repairs = ended_on_failure(way),
              .rank = 26},
             "is that meant?", facts_.node(id).contract.meaning.may_stay,
             "by a contract it may not stay so"),
         .shown_by = {{way.failing, LocationRole::Failure}},
         .then = Consequence{way.sequence, LocationRole::Failure}});
  }

  template <class Nodes, class Key>
  static std::vector<NodeId> found_in(const Nodes& nodes, const Key& key) {
    const auto found = nodes.find(key);
    return found == nodes.end() ? std::vector<NodeId>() : found->second;
  }

  // A node as a text that no other one has, with one value instead of its own.
  using Instead = std::pair<std::size_t, std::string_view>;  // which, and what
  static std::string written(const Node& node,
                             std::optional<Instead> instead = {}) {
    std::string text = node.id;
    for (std::size_t i = 0; i < node.arguments.size(); ++i) {
      const std::string_view value = instead && instead->first == i
                                         ? instead->second
                                         : node.arguments[i].value;
      text += '\0' + node.arguments[i].key + '\0';
      text += value;
    }
    return text;
  }
  static std::string values_of(const Node& node) {
    std::string text = node.id;
    for (const Argument& each : node.arguments) text += '\0' + each.value;
    return text;
  }

  // <Brush command="on"/>, <Brush command="off"/>: all else is the same.
  std::vector<NodeId> switched_back(const Node& on) const {
    std::vector<NodeId> nodes;
    for (std::size_t i = 0; i < on.arguments.size(); ++i) {
      const auto off = switched(on.arguments[i].value);
      if (!off) continue;
      const auto more = found_in(as_written_, written(on, Instead{i, *off}));
      nodes.insert(nodes.end(), more.begin(), more.end());
    }
    std::ranges::sort(nodes);
    return nodes;
  }

  static std::optional<std::string_view> switched(std::string_view begun) {
    constexpr std::array<std::string_view, 5> kOn = {"on", "start", "true",
                                                     "enable", "activate"};
    constexpr std::array<std::string_view, 5> kOff = {"off", "stop", "false",
                                                      "disable", "deactivate"};
    const auto* on = std::ranges::find(kOn, begun);
    if (on == kOn.end()) return std::nullopt;
    return kOff.at(static_cast<std::size_t>(on - kOn.begin()));
  }

  // Sequence(begin, Fallback(act, ForceFailure(end)), end).
  std::vector<Repair> ended_on_failure(const Way& way) const {
    const NodeId whole = facts_.child_with(way.sequence, way.ended);
    if (facts_.leaves(whole).size() != 1) return {};
    const auto& children = facts_.node(way.sequence).children;
    const SourcePlace first = place(way.failing);
    const SourcePlace last = place(children[facts_.place_of(whole) - 1]);
    const NewNode ending{"ForceFailure", {}, place(whole)};
    Repair repair = {WrapNodes{first, last, {"Fallback"}, {}, {ending}}};
    if (first != last) repair.push_back(WrapNodes{first, last, {"Sequence"}});
    return {repair};
  }

  // OpenHand, CloseHand, OpenHand: a move, not something that goes on.
  bool is_done_again_behind(NodeId begun, NodeId ended) const {
    return last_with_values_.at(values_of(facts_.node(begun))) >= ended;
  }

  // --- Entries ---------------------------------------------------------------

  // `lock := 'me'` …, `lock := 'free'`: a failure between leaves it taken.
  void look_at_claim(NodeId id) {
    for (const EntryUse* use : facts_.uses_of(id)) {
      const EntryUse& claim = *use;
      if (!claim.writes || claim.literal.empty()) continue;
      const FirstUndoer undoer = [&](NodeId begin, NodeId end) {
        return first_other(claim, begin, end);
      };
      const auto way = open_way(id, undoer);
      if (!way || is_undone_by_handlers(id, way->sequence, undoer)) continue;
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

  // The first node there that gives the entry of a claim another value.
  std::optional<NodeId> first_other(const EntryUse& claim, NodeId begin,
                                    NodeId end) {
    const std::vector<Write>& writes = writes_of(claim.entry);
    auto at = std::ranges::lower_bound(writes, begin, {}, &Write::node);
    if (at != writes.end() && at->use->literal == claim.literal) {
      at = writes.begin() + static_cast<std::ptrdiff_t>(at->next_other);
    }
    if (at == writes.end() || at->node >= end) return std::nullopt;
    return at->node;
  }

  // What writes an entry, in pre-order.
  struct Write {
    NodeId node{};
    const EntryUse* use = nullptr;
    std::size_t next_other = 0;  // the next one with another value
  };
  const std::vector<Write>& writes_of(std::uint32_t entry) {
    const auto [known, is_new] = writes_.try_emplace(entry);
    std::vector<Write>& writes = known->second;
    if (!is_new) return writes;
    for (const EntryUse* use : facts_.uses_of_entry(entry)) {
      if (use->writes) writes.push_back({use->node, use});
    }
    std::ranges::stable_sort(writes, {}, &Write::node);
    for (std::size_t i = writes.size(); i-- > 0;) {
      const bool goes_on = i + 1 < writes.size() &&
                           writes[i].use->literal == writes[i + 1].use->literal;
      writes[i].next_other = goes_on ? writes[i + 1].next_other : i + 1;
    }
    return writes;
  }

  std::vector<Repair> freed_on_failure(const Way& way,
                                       std::uint32_t entry) const {
    if (facts_.node(way.sequence).script(ScriptTime::OnFailure)) return {};
    const NodeId whole = facts_.child_with(way.sequence, way.ended);
    for (const EntryUse* use : facts_.uses_of_entry(entry)) {
      const bool frees = use->writes && !use->literal.empty() &&
                         facts_.is_in(use->node, whole);
      if (!frees) continue;
      return {{SetAttribute{place(way.sequence), "_onFailure",
                            assigned(entry, use->literal)}}};
    }
    return {};
  }

  std::string assigned(std::uint32_t entry, std::string_view literal) const {
    return fmt::format("{} := {}", facts_.tree().entries[entry], literal);
  }

  // _onFailure and _post of what fails around the claim.
  bool is_undone_by_handlers(NodeId claim, NodeId sequence,
                             const FirstUndoer& undoer) const {
    for (NodeId at = claim; !facts_.is_root(at); at = facts_.parent(at)) {
      if (at != claim && undoer(at, NodeId{index(at) + 1}) &&
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
    for (const EntryUse* each : facts_.uses_of_entry(entry)) {
      ask_budget();
      const EntryUse& use = *each;
      const bool is_condition = use.reads && !use.is_port &&
                                index(use.node) < index(sequence) &&
                                facts_.is_condition(use.node);
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

  bool is_in_inner_loop(NodeId node, NodeId loop) const {
    for (NodeId at = facts_.parent(node); at != loop; at = facts_.parent(at)) {
      const Flow flow = info_of(facts_.node(at).type).flow;
      if (flow == Flow::Retries || flow == Flow::Repeats ||
          flow == Flow::UntilFailure) {
        return true;
      }
    }
    return false;
  }

  bool look_at_latch(const EntryUse& asked, NodeId loop) {
    std::set<std::string> inside;
    std::set<std::string> outside;
    std::optional<NodeId> sets;
    bool is_once = true;
    for (const EntryUse* each : facts_.uses_of_entry(asked.entry)) {
      ask_budget();
      const EntryUse& use = *each;
      if (!use.writes) continue;
      if (use.is_port) return false;
      const bool is_inside = facts_.is_in(use.node, loop) && use.node != loop;
      (is_inside ? inside : outside).insert(use.literal);
      if (!is_inside) continue;
      is_once = is_once && is_done_once(asked.node, use.node);
      sets = use.node;
    }
    if (inside.size() != 1 || outside.size() != 1) return false;
    if (outside.begin()->empty() || *outside.begin() == *inside.begin()) {
      return false;
    }
    // What is counted once in each round is the rounds.
    if (inside.begin()->empty() && !is_in_inner_loop(*sets, loop)) return false;
    if (!asked.when && ends(asked.node, loop)) return false;
    if (is_once) return false;
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
      return {{InsertBefore{whole(facts_.node(body).children[0]), first}}};
    }
    return {{WrapNodes{whole(body), whole(body), {"Sequence"}, {first}}}};
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

  // Nodes in pre-order, by the words of their ID, and as they are written; the
  // last one with an ID and values.
  std::map<std::vector<std::string>, std::vector<NodeId>> of_words_;
  std::unordered_map<std::string, std::vector<NodeId>> as_written_;
  std::unordered_map<std::string, NodeId> last_with_values_;
  std::unordered_map<std::string, Values> values_;  // of deeds, by their ID
  // By node: the next child of its parent that may fail.
  std::vector<std::optional<NodeId>> next_failing_;
  std::map<std::uint32_t, std::vector<Write>> writes_;  // by entry
};

}  // namespace

void suspect_lasting(const TreeFacts& facts, Suspicions& found) {
  Lasting lasting(facts, found);
  look_at_nodes(facts, lasting);
  lasting.look_at_latches();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A reactive node comes past its children in every tick, so what succeeds at
// once is done again and again (BT2211), and a branch that changes its own
// guard halts itself (BT2210).
#include <fmt/format.h>

#include <algorithm>

#include "check/findings/edits.hpp"
#include "check/findings/kinds.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/findings.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

class Restarts : Look {
 public:
  using Look::Look;

  void look_at(NodeId id, const Node& node) {
    const bool is_plain_reactive = node.type == NodeType::ReactiveSequence ||
                                   node.type == NodeType::ReactiveFallback;
    if (is_plain_reactive) look_at_effects(id, node);
    if (node.type == NodeType::ReactiveSequence) look_at_restarts(id, node);
    if (node.type == NodeType::RateController) look_at_rate(id);
    if (node.type == NodeType::KeepRunningUntilFailure) look_at_sending(id);
    look_at_own_scripts(id);
  }

 private:
  bool has_conditions(NodeId id) const {
    const Node& node = facts_.node(id);
    return node.script(ScriptTime::SkipIf) || node.script(ScriptTime::While) ||
           node.script(ScriptTime::FailureIf) ||
           node.script(ScriptTime::SuccessIf);
  }

  bool has_output(NodeId leaf) const {
    return std::ranges::any_of(facts_.uses_of(leaf), [](const EntryUse* use) {
      return use->is_port && use->writes;
    });
  }

  // `visits := visits + 1`: twice is not as good as once.
  bool accumulates(NodeId leaf) const {
    const auto uses = facts_.uses_of(leaf);
    return facts_.node(leaf).type == NodeType::Script &&
           std::ranges::any_of(uses, [&](const EntryUse* write) {
             return write->writes && !write->when &&
                    std::ranges::count(entries_of(leaf, std::nullopt),
                                       write->entry) > 0;
           });
  }

  // The first thing done in a branch whose success asks for it: behind
  // conditions or none.
  std::optional<NodeId> done_at_once(NodeId id) const {
    while (true) {
      if (has_conditions(id)) return std::nullopt;
      const Node& node = facts_.node(id);
      if (is_leaf(node.type)) {
        const bool counts =
            accumulates(id) || (facts_.is_deed(id) && !has_output(id));
        return counts ? std::optional(id) : std::nullopt;
      }
      const Flow flow = info_of(node.type).flow;
      if (flow != Flow::AsChild && flow != Flow::OnSuccess &&
          flow != Flow::Succeeds) {
        return std::nullopt;
      }
      const auto first =
          std::ranges::find_if_not(node.children, [&](NodeId child) {
            return facts_.is_condition(facts_.core(child));
          });
      if (first == node.children.end()) return std::nullopt;
      id = *first;
    }
  }

  static bool is_literal(const Argument& argument) {
    return argument.value.find('{') == argument.value.npos;
  }

  // Text that can be the name of something: neither a number nor a truth value.
  static bool is_name(const Argument& argument) {
    const std::string& text = argument.value;
    return is_literal(argument) && text != "true" && text != "false" &&
           !as_number<double>(text) &&
           std::ranges::any_of(text, [](char c) { return is_letter(c); });
  }

  // SetFlag flag="begun" value="false", where CheckFlag flag="begun"
  // expected="false" asks for what it sets: twice is as good as once. Known by
  // what both are given, not by what they are called.
  bool keeps_value(NodeId deed) const {
    const Node& sets = facts_.node(deed);
    return !sets.arguments.empty() &&
           std::ranges::all_of(sets.arguments, is_literal) &&
           std::ranges::any_of(facts_.tree().nodes, [&](const Node& asks) {
             return is_leaf(asks.type) && asks.id != sets.id &&
                    asks_for_one_of(asks, sets);
           });
  }

  // It names the same thing by the same port, and has a value of it that some
  // leaf of the type of `sets` gives it.
  bool asks_for_one_of(const Node& asks, const Node& sets) const {
    const auto names_it = [&](const Node& node, const Argument& name) {
      return std::ranges::any_of(node.arguments, [&](const Argument& each) {
        return each.key == name.key && each.value == name.value;
      });
    };
    return std::ranges::any_of(sets.arguments, [&](const Argument& name) {
      if (!is_name(name) || !names_it(asks, name)) return false;
      return std::ranges::any_of(asks.arguments, [&](const Argument& value) {
        return value.key != name.key && is_literal(value) &&
               is_set_somewhere(sets.id, name, value.value);
      });
    });
  }

  bool is_set_somewhere(const std::string& type, const Argument& name,
                        const std::string& value) const {
    return std::ranges::any_of(facts_.tree().nodes, [&](const Node& node) {
      if (node.id != type) return false;
      bool is_named = false;
      bool is_given = false;
      for (const Argument& each : node.arguments) {
        if (each.key == name.key)
          is_named = each.value == name.value;
        else
          is_given = is_given || each.value == value;
      }
      return is_named && is_given;
    });
  }

  // ReactiveSequence(act, go): `act` is done anew in each tick while `go` runs.
  void look_at_restarts(NodeId id, const Node& node) {
    for (std::size_t i = 0; i + 1 < node.children.size(); ++i) {
      const NodeId child = node.children[i];
      const auto deed = done_at_once(child);
      if (!deed) continue;
      std::vector<Sighting> seen;
      std::optional<NodeId> beside;
      for (std::size_t j = i + 1; j < node.children.size(); ++j) {
        const NodeId other = node.children[j];
        ask_budget();
        if (!facts_.may_run(other) || !facts_.has_deed(other)) continue;
        if (!beside) beside = other;
        seen.push_back(
            {*deed, LocationRole::Tick, {{other, NodeStatus::Running}}});
      }
      const auto said = facts_.said(*deed, &LeafMeaning::idempotent);
      if (seen.empty() || said == true) continue;
      std::vector<NodeId> others = {*beside, id};
      if (*deed != child) others.insert(others.begin(), *deed);
      // What only looks, or sets what is set already, does no harm.
      const bool only_asks = !said && may_be_harmless(*deed);
      if (only_asks && facts_.may_run(*deed)) continue;  // asked by BT2510
      found_.push_back(
          {.finding = {.code = only_asks ? "BT2508" : "BT2211",
                       .severity =
                           only_asks ? Severity::Note : Severity::Warning,
                       .node = child,
                       .others = std::move(others),
                       .message = fmt::format(
                           "{} is done again in every tick while {} runs{}",
                           told(child), told(*beside),
                           only_asks ? ": is it as good done once?" : ""),
                       .why = fmt::format("{} begins with its first child in "
                                          "each tick",
                                          told(id)),
                       .help = fmt::format(
                           "make {} a Sequence, or put both into one below it",
                           told(id)),
                       .repairs = done_once(id, node, i),
                       .rank = 47},
           .shown_by = std::move(seen)});
    }
  }

  bool may_be_harmless(NodeId deed) const {
    return keeps_value(deed) ||
           (only_looks(facts_.node(deed).id) && !accumulates(deed));
  }

  // KeepRunningUntilFailure(… PubGoal goal="1;2"): the same once more in each
  // round, which is a tick when nothing runs.
  void look_at_sending(NodeId loop) {
    std::vector<NodeId> sending;
    for (const NodeId leaf : facts_.leaves(loop)) {
      const Node& node = facts_.node(leaf);
      const bool is_constant =
          !node.arguments.empty() &&
          std::ranges::none_of(node.arguments, [](const Argument& each) {
            return each.value.find('{') != each.value.npos;
          });
      const bool is_last =
          facts_.node(facts_.parent(leaf)).children.back() == leaf &&
          is_reactive(facts_.node(facts_.parent(leaf)));
      if (is_constant && is_last && only_sends(node.id) &&
          !facts_.may_run(leaf) &&
          facts_.said(leaf, &LeafMeaning::idempotent) != true) {
        sending.push_back(leaf);
      }
    }
    for (const NodeId leaf : sending) {
      found_.push_back(
          {.finding = {.code = "BT2508",
                       .severity = Severity::Note,
                       .node = leaf,
                       .others = {loop},
                       .message = fmt::format(
                           "{} sends the same again in every tick: is that "
                           "meant?",
                           told(leaf)),
                       .why = fmt::format("{} goes round once a tick, and "
                                          "nothing here takes longer",
                                          told(loop)),
                       .help = "send it once, or when it changes",
                       .rank = 24},
           .shown_by = {{leaf, LocationRole::Success}}});
    }
  }

  // With guards before it they stay reactive.
  std::vector<Repair> done_once(NodeId id, const Node& node,
                                std::size_t first) const {
    const Repair in_order = {ChangeType{place(id), "Sequence"}};
    if (first == 0) return {in_order};
    return {{WrapNodes{whole(node.children[first]),
                       whole(node.children.back()),
                       {"Sequence"}}},
            in_order};
  }

  // Pipeline(Recovery(RateController(…))): it is reset, so that it is due at
  // once.
  void look_at_rate(NodeId id) {
    NodeId at = id;
    while (!facts_.is_root(at)) {
      const NodeId parent = facts_.parent(at);
      const Flow flow = info_of(facts_.node(parent).type).flow;
      if (flow == Flow::Recovers || flow == Flow::Retries ||
          flow == Flow::Repeats) {
        if (facts_.node(parent).children[0] == at) note_rate(id, parent);
        return;
      }
      if (facts_.node(parent).children.size() != 1) return;
      at = parent;
    }
  }
  void note_rate(NodeId id, NodeId resets) {
    NodeId at = resets;
    while (!facts_.is_root(at) &&
           !is_reactive(facts_.node(facts_.parent(at)))) {
      at = facts_.parent(at);
    }
    if (facts_.is_root(at)) return;
    found_.push_back(
        {.finding = {.code = "BT2211",
                     .node = id,
                     .others = {resets, facts_.node(id).children[0]},
                     .message = fmt::format(
                         "{} does not slow down what is below it", told(id)),
                     .why = fmt::format(
                         "{} resets it after each success, and it is "
                         "due at once after a reset",
                         told(resets)),
                     .help = fmt::format("put it around {}", told(resets)),
                     .repairs = {{UnwrapNode{place(id)},
                                  WrapNodes{whole(resets), whole(resets),
                                            as_written(id)}}}},
         .shown_by = {{resets, LocationRole::Success}}});
  }

  NewNode as_written(NodeId id) const {
    NewNode made{facts_.type_word(id)};
    for (const Argument& each : facts_.node(id).arguments) {
      made.attributes.emplace_back(each.key, each.value);
    }
    return made;
  }

  // Reactive(IsCharging, Undock): what is asked changes as soon as the action
  // begins, and halts it.
  void look_at_effects(NodeId id, const Node& node) {
    const bool is_fallback = node.type == NodeType::ReactiveFallback;
    for (std::size_t i = 0; i + 1 < node.children.size(); ++i) {
      const NodeId guard = facts_.core(node.children[i]);
      const auto asked = asked_by(guard);
      if (!asked) continue;
      for (std::size_t j = i + 1; j < node.children.size(); ++j) {
        for (const NodeId deed : facts_.leaves(node.children[j])) {
          if (!facts_.is_deed(deed) || !facts_.may_run(deed)) continue;
          if (!undoes_at_once(facts_.node(deed).id, facts_.node(*asked).id) ||
              !is_asked_for(*asked, node.children[i], node.type)) {
            continue;
          }
          found_.push_back(
              {.finding = {.code = "BT2210",
                           .node = id,
                           .others = {deed, *asked},
                           .message = fmt::format(
                               "{} is halted before it has ended", told(deed)),
                           .why = fmt::format(
                               "once it has begun, {} is no longer so, and {} "
                               "halts it",
                               told(*asked), told(id)),
                           .help = fmt::format(
                               "ask {} once: a {} instead of {}", told(*asked),
                               is_fallback ? "Fallback" : "Sequence", told(id)),
                           .repairs = {{ChangeType{
                               place(id),
                               is_fallback ? "Fallback" : "Sequence"}}}},
               .shown_by = {
                   {node.children[i],
                    is_fallback ? LocationRole::Success : LocationRole::Failure,
                    {{deed, NodeStatus::Running}}}}});
          return;
        }
      }
    }
  }

  // Whether the guard is asked by its success in a ReactiveSequence, and by its
  // failure in a ReactiveFallback.
  bool is_asked_for(NodeId leaf, NodeId child, NodeType above_child) const {
    bool is_turned = false;
    for (NodeId at = leaf; at != child; at = facts_.parent(at)) {
      const Node& above = facts_.node(facts_.parent(at));
      if (above.type == NodeType::OtherDecorator) return true;
      if (above.type == NodeType::Inverter) is_turned = !is_turned;
    }
    return is_turned == (above_child == NodeType::ReactiveFallback);
  }

  // The only condition of a child.
  std::optional<NodeId> asked_by(NodeId child) const {
    const std::vector<NodeId> leaves = facts_.leaves(child);
    if (leaves.size() != 1 || !facts_.is_condition(leaves[0])) {
      return std::nullopt;
    }
    return leaves[0];
  }

  // A script in a branch changes what the branch is guarded by.
  void look_at_own_scripts(NodeId id) {
    const Node& node = facts_.node(id);
    if (node.script(ScriptTime::While)) look_at_changes(id, id);
    if (!is_reactive(node) && node.type != NodeType::WhileDoElse) return;
    for (std::size_t i = 0; i + 1 < node.children.size(); ++i) {
      const auto asked = asked_by(node.children[i]);
      if (!asked || facts_.node(*asked).type != NodeType::Script) continue;
      for (std::size_t j = i + 1; j < node.children.size(); ++j) {
        look_at_changes(*asked, node.children[j]);
      }
      if (node.type == NodeType::WhileDoElse) return;
    }
  }

  // The guard's entries, written in the branch, and what runs behind that.
  void look_at_changes(NodeId guard, NodeId branch) {
    for (const EntryUse* asked : facts_.uses_of(guard)) {
      const bool is_asked =
          asked->reads && (guard != branch || asked->when == ScriptTime::While);
      if (!is_asked) continue;
      for (const EntryUse* write : facts_.uses_of_entry(asked->entry)) {
        ask_budget();
        const bool is_own = write->writes && !write->literal.empty() &&
                            write->node != guard &&
                            facts_.is_in(write->node, branch);
        if (is_own && note_change(guard, write->node, branch)) return;
      }
    }
  }

  bool note_change(NodeId guard, NodeId script, NodeId branch) {
    if (is_leaf(facts_.node(branch).type)) return false;
    for (const NodeId deed : facts_.leaves(branch)) {
      if (index(deed) <= index(script) || !facts_.is_deed(deed) ||
          !facts_.may_run(deed)) {
        continue;
      }
      found_.push_back(
          {.finding = {.code = "BT2210",
                       .node = guard,
                       .others = {script, deed},
                       .message = fmt::format(
                           "{} is always halted when it takes more than a tick",
                           told(deed)),
                       .why = fmt::format(
                           "{} has changed what is asked here, so the branch "
                           "ends in the next tick",
                           told(script)),
                       .help = guard == branch
                                   ? "ask once, with _skipIf, or for something "
                                     "that the branch itself does not change"
                                   : "ask once: a Sequence instead of the "
                                     "ReactiveSequence",
                       .repairs = {asked_once(guard, branch)}},
           .shown_by = {{deed,
                         LocationRole::Halt,
                         {{deed, NodeStatus::Running}}},
                        {deed, LocationRole::Running}},
           .cleared_by = {
               {deed, LocationRole::Tick, {{deed, NodeStatus::Running}}}}});
      return true;
    }
    return false;
  }

  // The type that asks once, for what stands above the branch.
  std::string plain(NodeId branch) const {
    const NodeType above = facts_.node(facts_.parent(branch)).type;
    if (above == NodeType::WhileDoElse) return "IfThenElse";
    return above == NodeType::ReactiveFallback ? "Fallback" : "Sequence";
  }

  // _while as a _skipIf; a Sequence in place of the reactive one.
  Repair asked_once(NodeId guard, NodeId branch) const {
    if (guard != branch) {
      return {ChangeType{place(facts_.parent(branch)), plain(branch)}};
    }
    const std::string& asked =
        facts_.node(guard).script(ScriptTime::While)->text;
    return {RemoveAttribute{place(guard), "_while"},
            SetAttribute{place(guard), "_skipIf", negated_script(asked)}};
  }
};

}  // namespace

void suspect_restarts(const TreeFacts& facts, Suspicions& found) {
  Restarts look(facts, found);
  look_at_nodes(facts, look);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "check/questions/answered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>

#include "check/findings/edits.hpp"
#include "check/findings/facts.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/findings.hpp"

namespace btcheck {
namespace {

// From the answers of the search.
class Answered {
 public:
  Answered(const NormalTree& normal, const DefaultReport& report)
      : normal_(normal), facts_(normal), report_(report) {
    const auto& nodes = normal.tree().nodes;
    std::vector<bool> is_beside(nodes.size());
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const Node& node = nodes[n];
      if (!node.is_root()) {
        const Node& above = nodes[index(node.parent)];
        is_beside[n] = is_beside[index(node.parent)] ||
                       (above.children.size() > 1 &&
                        info_of(above.type).beside != Beside::None);
      }
      if (is_leaf(node.type) && is_beside[n]) {
        asking_[node.id].push_back(NodeId{n});
      }
    }
    for (const StaleGuardReport& each : report.stale_guards) {
      StaleGuardReport& stale = stale_guards_.emplace_back(each);
      stale.action = normal.of(stale.action);
      for (NodeId& guard : stale.guards) guard = normal.of(guard);
    }
  }

  std::vector<TreeFinding> find() {
    const std::size_t count = facts_.tree().nodes.size();
    for (std::uint32_t n = 0; n < count; ++n) look_at(NodeId{n});
    look_at_guards();
    look_at_left_running();
    for (TreeFinding& each : found_) normal_.put_back(each);
    ask_of_single_children();
    return std::move(found_);
  }

 private:
  using enum NodeQuestion;

  const Possibility& answer(NodeId node, NodeQuestion question) const {
    return report_.nodes[index(normal_.acting(node))]
        .answers[static_cast<std::size_t>(question)];
  }
  bool never(NodeId node, NodeQuestion question) const {
    return answer(node, question).verdict == Verdict::Violated;
  }
  bool may(NodeId node, NodeQuestion question) const {
    return answer(node, question).verdict == Verdict::Holds;
  }
  std::string told(NodeId node) const { return facts_.told(node); }

  void add(TreeFinding finding) { found_.push_back(std::move(finding)); }

  void look_at(NodeId id) {
    const Node& node = facts_.node(id);
    if (!may(id, Ticked)) {
      const bool is_news = node.is_root() || may(node.parent, Ticked);
      const bool is_told = explained_.contains(id) || is_safety_net(id);
      if (never(id, Ticked) && is_news && !is_told) {
        add_dead(id);
      }
      return;
    }
    const bool is_silent = never(id, Success) && never(id, Failure);
    if (is_silent && never(id, Running) && may(id, Skipped)) {
      return add_skipped(id);
    }
    if (info_of(node.type).flow == Flow::OnFailure) look_at_vain(id);
    if (info_of(node.type).beside == Beside::Counted && never(id, Success) &&
        facts_.answers(id).success) {
      return add_parallel(id);
    }
    const bool asks = (node.type == NodeType::Eval && !node.assignment) ||
                      (node.type == NodeType::Script && node.answers_value);
    if (!asks) return;
    if (never(id, Failure) && may(id, Success)) {
      add({.code = "BT2203",
           .severity = Severity::Warning,
           .node = id,
           .message =
               fmt::format("{} is always true when it is ticked", told(id)),
           .why = "on no run does it fail",
           .help = "look whether it asks for the right value"});
    }
    if (never(id, Success) && may(id, Failure)) add_never_true(id);
  }

  // The last child of a Switch, for values that no case has: the engine wants
  // one, also where all cases are there.
  bool is_safety_net(NodeId id) const {
    if (facts_.is_root(id)) return false;
    const Node& above = facts_.node(facts_.parent(id));
    return above.type == NodeType::Switch && above.children.back() == id &&
           std::ranges::all_of(above.children, [&](NodeId child) {
             return child == id || may(child, Ticked);
           });
  }

  // Fallback(condition, condition, AlwaysSuccess): whatever they answer, the
  // same comes of it.
  void look_at_vain(NodeId id) {
    const Node& node = facts_.node(id);
    if (facts_.answers(node.children.back()).failure || facts_.is_root(id) ||
        !may(id, Success) || !only_asks(id)) {
      return;
    }
    std::vector<NodeId> asked = facts_.leaves(id);
    std::erase_if(asked, [&](NodeId leaf) {
      return !facts_.answers(leaf).failure || !facts_.answers(leaf).success;
    });
    if (asked.empty()) return;
    const NodeId last = node.children.back();
    add({.code = "BT2213",
         .node = id,
         .others = asked,
         .message = fmt::format("{} can never fail: what {} answer{} has no "
                                "effect",
                                told(id), facts_.told(asked),
                                asked.size() == 1 ? "s" : ""),
         .why = fmt::format("its last child, {} (line {}), never fails",
                            told(last), facts_.node(last).span.line),
         .help = fmt::format("take {} away, or ask nothing", told(last))});
  }

  // Nothing below it is done, written or waited for.
  bool only_asks(NodeId id) const {
    return !facts_.may_run(id) && changes_nothing(id);
  }
  bool changes_nothing(NodeId id) const {
    for (NodeId at = id; at < facts_.end_of(id); at = NodeId{index(at) + 1}) {
      const auto uses = facts_.uses_of(at);
      const bool writes = std::ranges::any_of(
          uses, [](const EntryUse* use) { return use->writes; });
      const bool acts = facts_.is_deed(at) && !facts_.is_constant(at);
      if (writes || acts) return false;
    }
    return true;
  }

  // With what stands behind it, which is never ticked then.
  void add_never_true(NodeId id) {
    std::vector<NodeId> dead = dead_behind(id);
    std::string message =
        fmt::format("{} is never true when it is ticked", told(id));
    if (!dead.empty()) {
      message += fmt::format(": {} never ticked", listed_with_verb(dead));
    }
    add({.code = "BT2204",
         .node = id,
         .others = std::move(dead),
         .message = std::move(message),
         .why = "on no run does it succeed",
         .help = "look whether it asks for the right value",
         .repairs = spelt_alike(facts_, id, std::nullopt)});
  }

  std::string listed_with_verb(const std::vector<NodeId>& nodes) const {
    return facts_.told(nodes) + (nodes.size() == 1 ? " is" : " are");
  }

  // The nodes that are never ticked because this one never answers so: to its
  // right, and to the right of what then never answers so either.
  std::vector<NodeId> dead_behind(NodeId id) {
    std::vector<NodeId> dead;
    for (NodeId at = id; !facts_.is_root(at); at = facts_.parent(at)) {
      const Node& above = facts_.node(facts_.parent(at));
      for (std::size_t i = facts_.place_of(at) + 1; i < above.children.size();
           ++i) {
        if (!never(above.children[i], Ticked)) continue;
        dead.push_back(above.children[i]);
        explained_.insert(above.children[i]);
      }
      if (!never(facts_.parent(at), Success) &&
          !never(facts_.parent(at), Failure)) {
        break;
      }
    }
    return dead;
  }

  void add_dead(NodeId id) {
    const Node& node = facts_.node(id);
    std::vector<NodeId> dead = {id};
    std::optional<NodeId> before;
    if (!node.is_root()) {
      const std::size_t place = facts_.place_of(id);
      const auto& children = facts_.node(node.parent).children;
      if (place > 0) {
        before = children[place - 1];
        for (const NodeId each : dead_behind(*before)) {
          if (each != id) dead.push_back(each);
        }
      }
    }
    std::vector<NodeId> others(dead.begin() + 1, dead.end());
    if (before) {
      if (const auto cause = undone_by(*before)) {
        return add_undone(*before, *cause, std::move(dead));
      }
      others.push_back(*before);
    }
    add({.code = "BT2201",
         .node = id,
         .others = std::move(others),
         .message = fmt::format("{} never ticked", listed_with_verb(dead)),
         .why = before ? why_not_behind(*before, node.parent)
                       : fmt::format("{} never comes to it", told(node.parent)),
         .help = before ? "mend what stands before it, or delete it"
                        : "look what lets the tick pass, or delete it"});
  }

  // The last child of a Sequence, which fails after all that the others have
  // done, whatever comes of it.
  std::optional<NodeId> undone_by(NodeId sequence) const {
    sequence = facts_.core(sequence);
    const Node& node = facts_.node(sequence);
    if (info_of(node.type).flow != Flow::OnSuccess) return std::nullopt;
    const NodeId last = node.children.back();
    const bool is_undone = facts_.is_constant(facts_.core(last)) &&
                           never(last, Success) && may(last, Failure);
    return is_undone ? std::optional(last) : std::nullopt;
  }

  void add_undone(NodeId sequence, NodeId cause, std::vector<NodeId> dead) {
    std::string message = fmt::format("{} can never succeed: {} never ticked",
                                      told(sequence), listed_with_verb(dead));
    dead.push_back(cause);
    add({.code = "BT2213",
         .node = sequence,
         .others = std::move(dead),
         .message = std::move(message),
         .why = fmt::format("its last child, {} (line {}), always fails",
                            told(cause), facts_.node(cause).span.line),
         .help = "move that into the branch that it should end"});
  }

  std::string why_not_behind(NodeId before, NodeId above) const {
    const bool waits_for_failure =
        info_of(facts_.node(above).type).flow == Flow::OnFailure;
    const NodeQuestion asked = waits_for_failure ? Failure : Success;
    if (!never(before, asked)) {
      return fmt::format("{} never comes to it", told(above));
    }
    return fmt::format("{} (line {}) never {}", told(before),
                       facts_.node(before).span.line,
                       waits_for_failure ? "fails" : "succeeds");
  }

  void add_skipped(NodeId id) {
    const Node& node = facts_.node(id);
    const bool has_own = node.script(ScriptTime::SkipIf) != nullptr ||
                         node.script(ScriptTime::While) != nullptr;
    if (!has_own) return;
    const bool is_skip = node.script(ScriptTime::SkipIf) != nullptr;
    const auto& script =
        *node.script(is_skip ? ScriptTime::SkipIf : ScriptTime::While);
    for (const NodeId child : node.children) explained_.insert(child);
    add({.code = "BT2212",
         .node = id,
         .others = node.children,
         .message = fmt::format("{} is always skipped", told(id)),
         .why = fmt::format("whenever it is reached, `{}` is {}", script.text,
                            is_skip ? "true" : "false"),
         .help = "look what sets the entries that it asks for",
         .repairs = spelt_alike(
             facts_, id, is_skip ? ScriptTime::SkipIf : ScriptTime::While)});
  }

  void add_parallel(NodeId id) {
    const Node& node = facts_.node(id);
    std::vector<NodeId> stuck;
    for (const NodeId child : node.children) {
      if (never(child, Success)) stuck.push_back(child);
    }
    std::vector<NodeId> others = stuck;
    for (const NodeId dead : dead_behind(id)) others.push_back(dead);
    std::string why = what_it_needs(node);
    if (!stuck.empty()) {
      why += fmt::format(", and {} never {}", facts_.told(stuck),
                         stuck.size() == 1 ? "does" : "do");
    }
    add({.code = "BT2202",
         .node = id,
         .others = std::move(others),
         .message = fmt::format("{} can never succeed", told(id)),
         .why = std::move(why),
         .help = what_would_do(node, stuck.size()),
         .repairs = edits_that_would_do(id, stuck.size())});
  }

  bool counts_failures(const Node& node) const {
    return node.type == NodeType::ParallelAll &&
           is_engine(facts_.tree().profile);
  }

  std::string what_it_needs(const Node& node) const {
    const auto count = static_cast<int>(node.children.size());
    const bool counts = counts_failures(node);
    const int too_many = threshold_of(node.failure_threshold, count);
    if (counts && too_many == 0) return "all its children would have to end";
    const int needed =
        counts ? count - too_many + 1 : threshold_of(node.threshold, count);
    return needed == count
               ? fmt::format("all its {} children would have to", count)
               : fmt::format("{} of its {} children would have to", needed,
                             count);
  }

  std::string what_would_do(const Node& node, std::size_t stuck) const {
    if (stuck == node.children.size()) return "let one of them succeed";
    if (counts_failures(node)) {
      return fmt::format("allow more failures: max_failures=\"{}\"", stuck + 1);
    }
    return fmt::format("ask for fewer successes, {} at most",
                       node.children.size() - stuck);
  }

  std::vector<Repair> edits_that_would_do(NodeId id, std::size_t stuck) const {
    const Node& node = facts_.node(id);
    const std::size_t most = node.children.size() - stuck;
    if (most == 0) return {};
    if (!counts_failures(node)) {
      return {asking_for(facts_, id, static_cast<int>(most))};
    }
    return {{SetAttribute{facts_.place(id), "max_failures",
                          std::to_string(stuck + 1)}}};
  }

  // --- A Fallback with nothing to fall back to -------------------------------

  // Of the tree as it is written: what is done alike has no such node any more.
  void ask_of_single_children() {
    const BehaviorTree& tree = normal_.written();
    if (!is_engine(tree.profile)) return;
    const std::vector<std::string> names = short_names(tree);
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      const Node& node = tree.nodes[n];
      const Possibility& fails =
          report_.nodes[n].answers[static_cast<std::size_t>(Failure)];
      const bool is_alone = info_of(node.type).flow == Flow::OnFailure &&
                            node.children.size() == 1 &&
                            fails.verdict == Verdict::Holds;
      if (!is_alone) continue;
      const NodeId child = node.children[0];
      add({.code = "BT2512",
           .severity = Severity::Note,
           .node = NodeId{n},
           .others = {child},
           .message = fmt::format("`{}` fails when `{}` does: is there nothing "
                                  "else to try?",
                                  names[n], names[index(child)]),
           .why = "it has one child",
           .help =
               "give it another one, AlwaysSuccess perhaps, or take it away",
           .run = fails.run,
           .rank = 17});
    }
  }

  // --- Guards --------------------------------------------------------------

  using ByGuard = std::map<NodeId, std::vector<const StaleGuardReport*>>;

  // By guard: what runs unguarded.
  void look_at_guards() {
    ByGuard by_guard;
    ByGuard asked_once;
    for (const StaleGuardReport& report : stale_guards_) {
      for (const NodeId guard : report.guards) {
        const auto must = must_hold(guard, report.action);
        if (must == false) continue;
        if (must || matters(guard, report.action)) {
          by_guard[guard].push_back(&report);
        } else if (may_matter(guard, report.action)) {
          asked_once[guard].push_back(&report);
        }
      }
    }
    for (const auto& [guard, reports] : by_guard) asked_once.erase(guard);
    ask_of_guards(asked_once);
    std::map<NodeId, TreeFinding*> by_sequence;
    found_.reserve(found_.size() + by_guard.size());
    for (const auto& [guard, reports] : by_guard) {
      const NodeId above =
          fork_of(facts_.tree(), guard, reports[0]->action)->node;
      if (TreeFinding* known = by_sequence[above]) {
        known->others.push_back(guard);
        continue;
      }
      found_.push_back(stale(guard, reports, above));
      by_sequence[above] = &found_.back();
    }
  }

  // What the owner says of it: that it has to hold while the action runs, which
  // nobody asks then, or that it need not.
  std::optional<bool> must_hold(NodeId guard, NodeId action) const {
    const LeafMeaning& meaning = facts_.node(guard).contract.meaning;
    const bool is_named = facts_.is_named(action, meaning.holds_while);
    if (is_named || meaning.asked_once == false) {
      return is_asked_by_another(guard, action) ? std::nullopt
                                                : std::optional(true);
    }
    if (meaning.asked_once == true) return false;
    return std::nullopt;
  }

  // One for what a node resumes, however many guards it has.
  void ask_of_guards(const ByGuard& asked_once) {
    std::map<NodeId, std::vector<NodeId>> below;
    for (const auto& [guard, reports] : asked_once) {
      below[fork_of(facts_.tree(), guard, reports[0]->action)->node].push_back(
          guard);
    }
    for (const auto& [above, guards] : below) {
      add(asked_once_below(above, guards, asked_once.at(guards[0])));
    }
  }

  static std::vector<NodeId> actions_of(
      const std::vector<const StaleGuardReport*>& reports) {
    std::vector<NodeId> actions;
    for (const StaleGuardReport* report : reports) {
      actions.push_back(report->action);
    }
    return actions;
  }

  TreeFinding asked_once_below(
      NodeId above, const std::vector<NodeId>& guards,
      const std::vector<const StaleGuardReport*>& reports) const {
    const std::vector<NodeId> actions = actions_of(reports);
    std::vector<NodeId> others(guards.begin() + 1, guards.end());
    others.insert(others.end(), actions.begin(), actions.end());
    // What is told of the world may change with it; what a name tells is a
    // guess, for the order alone.
    const bool tells =
        tidings_of(facts_.node(guards[0]).id) != Tidings::Neither;
    return {.code = "BT2501",
            .severity = Severity::Note,
            .node = guards[0],
            .others = std::move(others),
            .message = fmt::format(
                "{} asked once, before {}, which may last: "
                "may the answer change meanwhile?",
                facts_.few(guards) + (guards.size() == 1 ? " is" : " are"),
                facts_.few(actions)),
            .why = fmt::format("{} resumes its running child", told(above)),
            .help = facts_.node(above).type == NodeType::IfThenElse
                        ? "if so, make it a WhileDoElse, which asks in each "
                          "tick"
                        : "if so, put both under a reactive node",
            .run = reports[0]->run,
            .rank = (tells ? 25 : 30) + (is_asked_anew(above) ? 10 : 0)};
  }

  // With the other answer something else would be done instead of the action,
  // and no other node asks the same while that runs.
  bool may_matter(NodeId guard, NodeId action) const {
    const auto fork = fork_of(facts_.tree(), guard, action);
    const Node& above = facts_.node(fork->node);
    const NodeId branch = facts_.child_with(fork->node, guard);
    if (is_round_of_loop(fork->node) && has_one_task(branch)) return false;
    if (info_of(above.type).flow == Flow::OnFailure) {
      // Fallback(Sequence(is it so, do this), do that); not, as of what is done
      // only until it is so, Fallback(is it so already, make it so). What never
      // succeeds does not make it so.
      const NodeId done = facts_.child_with(fork->node, action);
      const bool is_other = facts_.has_deed(branch) && leads(guard, branch);
      if (!is_other && facts_.answers(done).success) return false;
    } else if ((info_of(above.type).flow != Flow::OnSuccess &&
                above.type != NodeType::IfThenElse) ||
               !changes_nothing(branch) || !facts_.answers(branch).failure) {
      return false;
    }
    return !is_asked_by_another(guard, action);
  }

  // A loop comes past the guard again as soon as the action has ended.
  bool is_round_of_loop(NodeId at) const {
    while (!facts_.is_root(at)) {
      at = facts_.parent(at);
      if (facts_.node(at).children.size() != 1) return false;
      const Flow flow = info_of(facts_.node(at).type).flow;
      if (flow == Flow::UntilFailure || flow == Flow::Repeats) return true;
    }
    return false;
  }

  // Of what stands behind the branch at most one action may last.
  bool has_one_task(NodeId branch) const {
    std::size_t count = 0;
    const NodeId end = facts_.end_of(facts_.parent(branch));
    for (NodeId at = facts_.end_of(branch); at < end && count < 2;
         at = NodeId{index(at) + 1}) {
      count += facts_.is_deed(at) && facts_.may_run(at);
    }
    return count < 2;
  }

  // Another node asks the same while the action runs.
  bool is_asked_by_another(NodeId guard, NodeId action) const {
    const auto alike = asking_.find(facts_.node(guard).id);
    if (alike == asking_.end()) return false;
    return std::ranges::any_of(alike->second, [&](NodeId other) {
      ask_budget();
      return other != guard &&
             has_same_ports(facts_.node(other), facts_.node(guard)) &&
             is_ticked_while(facts_.tree(), other, action);
    });
  }

  // The branch begins with it: nothing is done before it is asked.
  bool leads(NodeId guard, NodeId branch) const {
    for (NodeId at = branch; at < guard; at = NodeId{index(at) + 1}) {
      if (facts_.is_deed(at)) return false;
    }
    return true;
  }

  static bool has_same_ports(const Node& one, const Node& other) {
    return std::ranges::equal(
        one.arguments, other.arguments, {},
        [](const Argument& each) { return std::pair(each.key, each.value); },
        [](const Argument& each) { return std::pair(each.key, each.value); });
  }

  // A condition that the branch needs all along, not one that lets it begin.
  bool matters(NodeId guard, NodeId action) const {
    const Node& node = facts_.node(guard);
    if (!is_engine(facts_.tree().profile)) return true;
    if (node.type != NodeType::Condition) return false;
    const NodeId parent = facts_.parent(guard);
    const bool is_turned = facts_.node(parent).type == NodeType::Inverter;
    const Tidings tidings = tidings_of(node.id);
    if (tidings != (is_turned ? Tidings::Bad : Tidings::Good)) return false;
    const auto fork = fork_of(facts_.tree(), guard, action);
    const Node& sequence = facts_.node(fork->node);
    if (undoes_at_once(facts_.node(action).id, node.id)) return false;
    if (is_asked_anew(fork->node)) return false;
    if (sequence.type == NodeType::IfThenElse) {
      return facts_.is_in(guard, sequence.children[0]) &&
             facts_.is_in(action, sequence.children[1]);
    }
    if (info_of(sequence.type).flow != Flow::OnSuccess) return false;
    // Directly below it, and not asked again by a reactive node or a loop.
    const NodeId direct = is_turned ? parent : guard;
    return facts_.parent(direct) == fork->node;
  }

  // By a loop, or as a check among others in a reactive node.
  bool is_asked_anew(NodeId at) const {
    for (; !facts_.is_root(at); at = facts_.parent(at)) {
      const Node& above = facts_.node(facts_.parent(at));
      if (is_endless(above) || above.type == NodeType::Repeat) return true;
      if (is_reactive(above) && above.children.back() != at) return true;
    }
    return false;
  }

  TreeFinding stale(NodeId guard,
                    const std::vector<const StaleGuardReport*>& reports,
                    NodeId above) const {
    std::vector<NodeId> actions = actions_of(reports);
    const std::string names = facts_.few(actions);
    const bool is_said = must_hold(guard, reports[0]->action) == true;
    return {
        .code = "BT2205",
        .severity = is_said || is_engine(facts_.tree().profile)
                        ? Severity::Warning
                        : Severity::Note,
        .node = guard,
        .others = std::move(actions),
        .message =
            fmt::format("{} is not asked again while {} run{}", told(guard),
                        names, reports.size() == 1 ? "s" : ""),
        .why = fmt::format(
            "{} resumes its running child{}", told(above),
            is_said ? "; by a contract it has to be asked meanwhile" : ""),
        .help = facts_.node(above).type == NodeType::IfThenElse
                    ? "make it a WhileDoElse, which asks in each tick"
                    : "put it with the actions, in a node of their own, under "
                      "a ReactiveSequence",
        .run = reports[0]->run,
        .repairs = asked_in_each_tick(guard, above)};
  }

  // The guards that stand directly below a Sequence, in a ReactiveSequence, and
  // what they guard in a Sequence of its own.
  std::vector<Repair> asked_in_each_tick(NodeId guard, NodeId above) const {
    const Node& sequence = facts_.node(above);
    if (sequence.type == NodeType::IfThenElse) {
      return {{ChangeType{facts_.place(above), "WhileDoElse"}}};
    }
    if (info_of(sequence.type).flow != Flow::OnSuccess) return {};
    const auto& children = sequence.children;
    const auto asks = [&](NodeId child) {
      const NodeId core = facts_.core(child);
      return facts_.is_condition(
          facts_.node(core).type == NodeType::Inverter
              ? facts_.core(facts_.node(core).children[0])
              : core);
    };
    const auto first = std::ranges::find_if(
        children, [&](NodeId child) { return facts_.is_in(guard, child); });
    const auto rest = std::find_if_not(first, children.end(), asks);
    if (first == rest || rest == children.end()) return {};
    const SourcePlace last = facts_.whole(children.back());
    const TreeEdit work =
        WrapNodes{facts_.whole(*rest), last, {facts_.type_word(above)}};
    const bool is_one = *rest == children.back();
    const bool is_btf = !is_engine(facts_.tree().profile);
    Repair repair;
    if (first == children.begin()) {
      if (!is_one) repair.push_back(work);
      repair.push_back(ChangeType{facts_.place(above), "ReactiveSequence"});
      if (is_btf)
        repair.push_back(SetAttribute{facts_.place(above), "halt", "1"});
      return {repair};
    }
    NewNode reactive{"ReactiveSequence"};
    if (is_btf) reactive.attributes = {{"halt", "1"}};
    repair.push_back(WrapNodes{facts_.whole(*first), last, reactive});
    if (!is_one) repair.push_back(work);
    return {repair};
  }

  void look_at_left_running() {
    for (const LeftRunningReport& left : report_.left_running) {
      const NodeId leaf = normal_.of(left.leaf);
      const NodeId above = normal_.of(left.above);
      add({.code = "BT2206",
           .severity = Severity::Note,
           .node = leaf,
           .others = {above},
           .message = fmt::format(
               "{} is left running when {} has {}", told(leaf), told(above),
               left.decision == NodeStatus::Success ? "succeeded" : "failed"),
           .why = fmt::format("{} does not halt it", told(above)),
           .help = "give the node above `:halt 1`",
           .run = left.run,
           .repairs = {{SetAttribute{facts_.place(above), "halt", "1"}}}});
    }
  }

  const NormalTree& normal_;
  const TreeFacts facts_;
  const DefaultReport& report_;
  std::vector<StaleGuardReport> stale_guards_;
  std::vector<TreeFinding> found_;
  std::set<NodeId> explained_;
  // By ID, the leaves that may be ticked while another one runs.
  std::unordered_map<std::string_view, std::vector<NodeId>> asking_;
};

}  // namespace

std::vector<TreeFinding> findings_in(const NormalTree& normal,
                                     const DefaultReport& report) {
  return Answered(normal, report).find();
}

}  // namespace btcheck

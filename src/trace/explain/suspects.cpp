// SPDX-License-Identifier: MIT
#include "trace/explain/suspects.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "model/sampling.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// Leaves that are looked at together.
constexpr std::size_t kMostTogether = 6;

class Search {
 public:
  Search(const ExplainedTree& tree, const ExplainedLog& log,
         const std::vector<Cause>& causes, const Limits& limits)
      : tree_(tree),
        log_(log),
        causes_(causes),
        limits_(limits),
        possible_(possible_faults(tree.tree, {}).faults) {}

  Suspects take() {
    const auto healthy = follow({});
    if (!healthy) return std::move(found_);
    if (!healthy->refused) {
      look_at_well(healthy->states);
      return std::move(found_);
    }
    found_.refused_in = healthy->tick;
    found_.refused = refused_event(*healthy);
    // A log without marks may have but one tick.
    records_before_refusal_ =
        *healthy->refused + (healthy->refused_answer ? 0 : 1);
    look_at_single();
    if (found_.single.empty() && found_.stopped == StopReason::None) {
      look_at_several();
    }
    return std::move(found_);
  }

 private:
  LogEvent refused_event(const Conformance& healthy) const {
    if (healthy.refused_answer) return *healthy.refused_answer;
    const auto& records = log_.log.transitions;
    const LogTransition& record =
        records[std::min(*healthy.refused, records.size() - 1)];
    return {log_.nodes.node(record.uid), record.after};
  }

  // Nothing where it could not be followed to its end.
  std::optional<Conformance> follow(const std::vector<InjectedFault>& faults) {
    return follow_in(with_faults(tree_.tree, faults, Others::Work));
  }
  std::optional<Conformance> follow_in(const BehaviorTree& tree) {
    ask_budget();
    const auto network = lower_values(tree, tree_.source, tree_.ticks);
    if (!network.value) return std::nullopt;
    Conformance found = Ways(tree, *network.value, limits_).follow(log_);
    if (found.stopped != StopReason::None) {
      found_.stopped = found.stopped;
      return std::nullopt;
    }
    return found;
  }

  bool conforms(const std::vector<InjectedFault>& faults) {
    const auto found = follow(faults);
    return found && found->conforms();
  }

  // --- What leaves did

  std::vector<std::size_t> moments(NodeId leaf) const {
    return log_.moments.of(leaf, 0, log_.moments.all().size());
  }
  std::size_t count(NodeId leaf, Happening what) const {
    const auto all = moments(leaf);
    return static_cast<std::size_t>(std::ranges::count_if(
        all,
        [&](std::size_t each) { return log_.moments.at(each).what == what; }));
  }
  bool is_asked(NodeId leaf) const {
    return log_.nodes.is_logged(leaf) && !moments(leaf).empty();
  }
  bool runs_at_end(NodeId leaf) const {
    const auto all = moments(leaf);
    return !all.empty() &&
           log_.moments.at(all.back()).what == Happening::Running;
  }
  // The moment since which it has been running.
  std::size_t runs_since(NodeId leaf) const {
    const auto all = moments(leaf);
    std::size_t since = all.back();
    for (auto at = all.rbegin(); at != all.rend(); ++at) {
      const Moment& moment = log_.moments.at(*at);
      if (moment.what == Happening::Asked) continue;
      if (moment.what != Happening::Running) break;
      since = *at;
    }
    return since;
  }

  // When it did what this fault has it do.
  std::vector<std::size_t> moments_of_fault(NodeId leaf, FaultKind kind) const {
    using enum FaultKind;
    if (moments(leaf).empty()) return {};
    if (kind == NeverEnds) return {runs_since(leaf)};
    if (kind == Throws) return {moments(leaf).back()};
    const auto is_of_fault = [&](Happening what) {
      switch (kind) {
        case Fails:
        case FailsOnce:
        case FailsOn:
          return what == Happening::Failure;
        case Halted:
          return what == Happening::Halted;
        case EndsLate:
        case Inverted:
        case FlipsOnce:
          return what == Happening::Success || what == Happening::Failure;
        default:
          return what == Happening::Success;
      }
    };
    std::vector<std::size_t> found = moments(leaf);
    std::erase_if(found, [&](std::size_t each) {
      return !is_of_fault(log_.moments.at(each).what);
    });
    return found;
  }

  Suspect suspect(NodeId leaf, std::vector<InjectedFault> faults) const {
    Suspect made{leaf, std::move(faults), {}, 0};
    made.answers =
        count(leaf, Happening::Success) + count(leaf, Happening::Failure);
    if (!made.faults.empty()) {
      made.at = moments_of_fault(leaf, made.faults.front().fault.kind);
    }
    return made;
  }

  bool is_possible(NodeId leaf, FaultKind kind) const {
    return std::ranges::any_of(possible_, [&](const InjectedFault& each) {
      return each.leaf == leaf && each.fault.kind == kind;
    });
  }

  // --- One fault

  // Leaves that the log shows: that which was refused first, then from the
  // refused record backwards.
  std::vector<NodeId> leaves_in_order() const {
    std::vector<NodeId> leaves;
    const auto add = [&](NodeId node) {
      if (is_leaf(tree_.tree.node(node).type) &&
          std::ranges::find(leaves, node) == leaves.end()) {
        leaves.push_back(node);
      }
    };
    if (is_asked(found_.refused->node)) add(found_.refused->node);
    const auto& all = log_.moments.all();
    std::size_t at = 0;
    while (at < all.size() && !(all[at].tick >= found_.refused_in &&
                                all[at].records >= records_before_refusal_ &&
                                all[at].node == found_.refused->node)) {
      ++at;
    }
    for (std::size_t i = std::min(at + 1, all.size()); i-- > 0;) {
      add(all[i].node);
    }
    // In an exception a leaf is asked and says nothing.
    return leaves;
  }

  void look_at_single() {
    for (const NodeId leaf : leaves_in_order()) {
      std::vector<InjectedFault> those;
      for (const InjectedFault& each : possible_) {
        // By how much it is late, only the log knows.
        if (each.leaf != leaf || each.fault.kind == FaultKind::EndsLate) {
          continue;
        }
        if (conforms({each})) those.push_back(each);
        if (found_.stopped != StopReason::None) return;
      }
      if (is_late(leaf, those)) those.push_back({leaf, {FaultKind::EndsLate}});
      if (those.empty() && count(leaf, Happening::Failure) > 0) {
        those = faults_by_answers(leaf);
      }
      if (found_.stopped != StopReason::None) return;
      if (!those.empty()) {
        found_.single.push_back(suspect(leaf, std::move(those)));
      }
    }
  }

  // Besides these faults, if any: the log conforms where this leaf alone may
  // take as long as it likes.
  bool is_late(NodeId leaf, const std::vector<InjectedFault>& besides) {
    const bool may_be =
        std::ranges::all_of(besides, [](const InjectedFault& each) {
          return each.fault.kind == FaultKind::NeverEnds;
        });
    if (!may_be || !is_possible(leaf, FaultKind::EndsLate) ||
        count(leaf, Happening::Running) == 0) {
      return false;
    }
    BehaviorTree tree = with_faults(tree_.tree, {}, Others::Work);
    Node& node = tree.nodes[index(leaf)];
    node.duration.reset();
    node.contract.may_run = true;
    const auto found = follow_in(tree);
    return found && found->conforms();
  }

  // The table's faults fail at once: a leaf may run before it does. Where the
  // log conforms if this leaf alone may fail as it pleases, its answers tell
  // which fault comes nearest; else nothing.
  std::vector<InjectedFault> faults_by_answers(NodeId leaf) {
    if (!is_possible(leaf, FaultKind::Fails)) return {};
    BehaviorTree tree = with_faults(tree_.tree, {}, Others::Work);
    Node& node = tree.nodes[index(leaf)];
    node.contract = tree_.tree.node(leaf).contract;
    node.contract.may_fail = true;
    const auto found = follow_in(tree);
    if (!found || !found->conforms()) return {};
    std::vector<Happening> ends;
    for (const std::size_t each : moments(leaf)) {
      const Happening what = log_.moments.at(each).what;
      if (what == Happening::Success || what == Happening::Failure) {
        ends.push_back(what);
      }
    }
    const std::size_t failed = count(leaf, Happening::Failure);
    const bool never_succeeded = failed == ends.size();
    const bool fails_to_the_end =
        std::find(std::ranges::find(ends, Happening::Failure), ends.end(),
                  Happening::Success) == ends.end();
    std::vector<InjectedFault> faults;
    const auto add = [&](FaultKind kind) {
      faults.push_back({leaf, {kind, 0}});
    };
    if (never_succeeded) add(FaultKind::Fails);
    if (failed == 1 || !fails_to_the_end) add(FaultKind::FailsOnce);
    if (fails_to_the_end) add(FaultKind::FailsOn);
    return faults;
  }

  // --- Several

  // What a leaf has, if its answers alone count.
  std::optional<InjectedFault> own_fault(NodeId leaf) const {
    using enum FaultKind;
    const std::size_t failed = count(leaf, Happening::Failure);
    const std::size_t succeeded = count(leaf, Happening::Success);
    const bool hangs = runs_at_end(leaf);
    FaultKind kind = NeverEnds;
    if (failed > 0) {
      kind = succeeded == 0 ? Fails : failed == 1 ? FailsOnce : FailsOn;
    } else if (!hangs) {
      return std::nullopt;
    }
    if (!is_possible(leaf, kind)) return std::nullopt;
    return InjectedFault{leaf, {kind, 0}};
  }

  void look_at_several() {
    std::vector<InjectedFault> faults;
    for (std::uint32_t n = 0; n < tree_.tree.nodes.size(); ++n) {
      const NodeId leaf{n};
      if (!is_deed(tree_.tree.nodes[n]) || !is_asked(leaf)) continue;
      const auto own = own_fault(leaf);
      if (!own) continue;
      if (own->fault.kind != FaultKind::NeverEnds) {
        found_.failed.push_back(suspect(leaf, {*own}));
      }
      faults.push_back(*own);
    }
    const auto together = [&](const std::vector<InjectedFault>& those) {
      if (those.size() < 2 || those.size() > kMostTogether ||
          !conforms(those)) {
        return false;
      }
      for (const InjectedFault& each : those) {
        found_.together.push_back(suspect(each.leaf, {each}));
      }
      return true;
    };
    auto failing = faults;
    std::erase_if(failing, [](const InjectedFault& each) {
      return each.fault.kind == FaultKind::NeverEnds;
    });
    if (together(failing) || failing.size() == faults.size()) return;
    together(faults);
  }

  // --- None

  void add_if_possible(NodeId leaf, FaultKind kind) {
    if (!is_possible(leaf, kind)) return;
    std::vector<InjectedFault> faults{{leaf, {kind, 0}}};
    // The log does not tell them apart.
    if (kind == FaultKind::NeverEnds &&
        is_possible(leaf, FaultKind::EndsLate)) {
      faults.push_back({leaf, {FaultKind::EndsLate, 0}});
    }
    const bool shows_exceptions = log_.log.marks || is_own(log_.log);
    if (kind == FaultKind::NeverEnds && !shows_exceptions &&
        is_possible(leaf, FaultKind::Throws)) {
      faults.push_back({leaf, {FaultKind::Throws, 0}});
    }
    // A leaf is told once: one that throws may as well never end.
    const auto known = std::ranges::find(found_.single, leaf, &Suspect::leaf);
    if (known != found_.single.end()) {
      *known = suspect(leaf, std::move(faults));
    } else {
      found_.single.push_back(suspect(leaf, std::move(faults)));
    }
  }

  // The tree can have written it with all leaves working.
  void look_at_well(const std::vector<StateVector>& states) {
    switch (log_.moments.last().outcome) {
      case Outcome::Exception:
        look_at_exception(states);
        return;
      case Outcome::Running:
        look_at_running(states);
        break;
      case Outcome::Failure:
        look_at_conditions();
        break;
      case Outcome::Success:
      case Outcome::Nothing:
        break;
    }
    if (found_.single.empty()) look_at_slowest();
  }

  // From where a leaf began to run to what ended that; nothing of one that was
  // asked within one tick alone.
  struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::int64_t length = 0;  // ticks, or microseconds where these are unknown
  };
  Span longest_of(NodeId leaf) const {
    Span longest;
    Span span;
    bool runs = false;
    for (const std::size_t each : moments(leaf)) {
      const Moment& moment = log_.moments.at(each);
      if (moment.what == Happening::Asked) continue;
      const bool goes_on = moment.what == Happening::Running;
      if (!runs && goes_on) span.begin = each;
      if (runs) {
        const Moment& first = log_.moments.at(span.begin);
        span.end = each;
        span.length = log_.moments.knows_ticks() ? moment.tick - first.tick
                                                 : moment.time - first.time;
        if (span.length > longest.length) longest = span;
      }
      runs = goes_on;
    }
    return longest;
  }

  // Nothing else is wrong with it: the leaf that has run longest.
  void look_at_slowest() {
    std::optional<NodeId> slowest;
    Span longest;
    for (std::uint32_t n = 0; n < tree_.tree.nodes.size(); ++n) {
      const NodeId leaf{n};
      if (!is_leaf(tree_.tree.nodes[n].type) || !is_asked(leaf)) continue;
      const Span span = longest_of(leaf);
      if (span.length <= longest.length) continue;
      longest = span;
      slowest = leaf;
    }
    if (!slowest) return;
    std::vector<InjectedFault> faults;
    const Happening end = log_.moments.at(longest.end).what;
    const bool is_ended =
        end == Happening::Success || end == Happening::Failure;
    const auto add = [&](FaultKind kind) {
      if (is_possible(*slowest, kind)) faults.push_back({*slowest, {kind, 0}});
    };
    if (!is_ended) add(FaultKind::NeverEnds);
    add(FaultKind::EndsLate);
    if (faults.empty()) return;
    Suspect made = suspect(*slowest, std::move(faults));
    made.at = {longest.begin, longest.end};
    found_.single.push_back(std::move(made));
  }

  void look_at_next(const std::vector<StateVector>& states,
                    bool one_was_asked) {
    const BehaviorTree tree = with_faults(tree_.tree, {}, Others::Work);
    const auto lowered = lower_values(tree, tree_.source, tree_.ticks);
    if (!lowered.value) return;
    const Ways ways(tree, *lowered.value, limits_);
    for (const NodeId leaf : ways.asked_next(states, one_was_asked)) {
      add_if_possible(leaf, FaultKind::Throws);
    }
  }

  // Release 3 does not tell which nodes were asked.
  void look_at_exception(const std::vector<StateVector>& states) {
    const auto& open = log_.moments.left_by_exception();
    const bool is_known =
        !open.empty() && is_leaf(tree_.tree.node(open.back()).type);
    if (is_known) {
      add_if_possible(open.back(), FaultKind::Throws);
    } else if (log_.log.marks && log_.log.marks->engine == 3) {
      look_at_next(states, true);
    }
  }

  void look_at_running(const std::vector<StateVector>& states) {
    if (!log_.log.marks && !is_own(log_.log)) look_at_next(states, false);
    std::vector<NodeId> running;
    for (std::uint32_t n = 0; n < tree_.tree.nodes.size(); ++n) {
      const NodeId leaf{n};
      if (is_leaf(tree_.tree.nodes[n].type) && is_asked(leaf) &&
          runs_at_end(leaf)) {
        running.push_back(leaf);
      }
    }
    std::ranges::stable_sort(running, {},
                             [&](NodeId leaf) { return runs_since(leaf); });
    for (const NodeId leaf : running) {
      add_if_possible(leaf, FaultKind::NeverEnds);
    }
  }

  // It failed by what conditions said: those that never said anything else.
  void look_at_conditions() {
    for (const NodeId leaf : first_causes(causes_)) {
      const Node& node = tree_.tree.node(leaf);
      if (!is_leaf(node.type) || !is_of_world(node)) continue;
      if (count(leaf, Happening::Success) == 0) {
        add_if_possible(leaf, FaultKind::Fails);
      } else if (count(leaf, Happening::Failure) == 0) {
        add_if_possible(leaf, FaultKind::Succeeds);
      }
    }
  }

  const ExplainedTree& tree_;
  const ExplainedLog& log_;
  const std::vector<Cause>& causes_;
  const Limits& limits_;
  std::vector<InjectedFault> possible_;
  std::size_t records_before_refusal_ = 0;
  Suspects found_;
};

}  // namespace

Suspects suspects_of(const ExplainedTree& tree, const ExplainedLog& log,
                     const std::vector<Cause>& causes, const Limits& limits) {
  return Search(tree, log, causes, limits).take();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What is to be covered are the edges of the nodes' automata: an answer is the
// edge that leads to it, and what a node does about the answer of a child is an
// edge as well. Greedy: the edge that lies deepest first, then on from there to
// the nearest that is not covered, as long as there is one within reach; in the
// end, tests that show nothing of their own are left out.
#include "suites/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/container_hash/hash.hpp>
#include <functional>
#include <map>
#include <unordered_map>

#include "explore/search/reachability.hpp"
#include "suites/names.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr int kMostTicks = 30;        // of a test
constexpr std::size_t kNear = 3'000;  // states looked at for the next edge
constexpr std::size_t kWithinTick = 100'000;  // and for the end of the tick

// The step that leads to an edge first.
struct FirstSteps : ReachabilityVisitor {
  explicit FirstSteps(std::size_t edges) : from(edges) {}

  void stepped(StateId state, Step step, StateId) {
    if (step.edge == kTimeStep || from[step.edge]) return;
    from[step.edge] = state;
    states_until += std::exchange(states_since, 0);
    order.push_back(step.edge);
  }

  // Where nothing new has been found for long, and all that is known to be
  // possible has, the rest is more of the same.
  GoOn expanded(StateId, StateView, bool) {
    ++states_since;
    const std::size_t patience = 100'000 + 4 * states_until;
    return states_since > patience && is_enough() ? GoOn::No : GoOn::Yes;
  }

  std::function<bool()> is_enough;
  std::size_t states_until = 0;  // the last new edge
  std::size_t states_since = 0;
  std::vector<std::optional<StateId>> from;  // by edge
  std::vector<std::uint32_t> order;          // as they were found
};

// A run on its way.
struct PlannedRun {
  std::vector<Step> steps;
  StateVector state;
};

// Goes on by the fewest steps to one that is wanted; false where none is near.
bool go_on(
    const ForcedNetwork& forced, PlannedRun& run, std::size_t most,
    const std::function<bool(const Step&)>& is_wanted,
    const std::function<bool(const Step&)>& is_passed = [](const Step&) {
      return true;
    }) {
  struct Reached {
    const StateVector* state;
    std::size_t from;
    Step step;
  };
  std::unordered_map<StateVector, std::size_t, boost::hash<StateVector>> known;
  std::vector<Reached> reached;
  const auto add = [&](StateVector state, std::size_t from, const Step& step) {
    const auto [at, is_new] = known.emplace(std::move(state), reached.size());
    if (is_new) reached.push_back({&at->first, from, step});
  };
  add(run.state, 0, {});
  for (std::size_t i = 0; i < reached.size() && i < most; ++i) {
    for (const ForcedNetwork::Way& way :
         forced.ways(view_of(*reached[i].state))) {
      if (!is_wanted(way.step)) {
        if (is_passed(way.step)) add(way.after, i, way.step);
        continue;
      }
      std::vector<Step> steps = {way.step};
      for (std::size_t at = i; at != 0; at = reached[at].from) {
        steps.push_back(reached[at].step);
      }
      run.steps.insert(run.steps.end(), steps.rbegin(), steps.rend());
      run.state = way.after;
      return true;
    }
  }
  return false;
}

class SuiteMaker {
 public:
  SuiteMaker(const ForcedNetwork& forced, const ForcedNetwork& asked,
             const DefaultReport& defaults, const Limits& limits)
      : forced_(forced),
        asked_(asked),
        network_(forced.network()),
        defaults_(defaults),
        limits_(limits),
        is_covered_(network_.edge_count()) {}

  Suite make(const std::vector<NamedRun>& also) {
    for (const NodeReport& node : defaults_.nodes) {
      if (forced_.tree().node(node.node).is_root()) continue;
      for (std::size_t q = 1; q < kNodeQuestionCount; ++q) {
        if (node.answers[q].verdict == Verdict::Holds) {
          suite_.proven.insert({node.node, static_cast<NodeQuestion>(q)});
        }
      }
    }
    for (const NamedRun& run : also) {
      auto test = told_test(forced_, run.steps);
      if (!test) continue;
      test->about = run.about;
      test->code = run.code;
      add(std::move(*test));
    }
    suite_.initial = initial_writes(forced_.tree());
    cover();
    drop_idle_tests(suite_.tests);
    name_tests(forced_.tree(), network_, suite_.tests);
    count();
    return std::move(suite_);
  }

 private:
  bool is_of_node(const Step& step) const {
    return step.edge != kTimeStep &&
           network_.owner_of_edge(step.edge).kind == AutomatonKind::Node;
  }

  // All that is proven, as far as single steps show it.
  bool reaches_all(const FirstSteps& first) const {
    std::set<Cell> missing = suite_.proven;
    for (const std::uint32_t edge : first.order) {
      if (!is_of_node({edge})) continue;
      const Automaton& automaton = network_.owner_of_edge(edge);
      const LocationRole role = automaton.target(network_.edge(edge)).role;
      for (std::size_t q = 1; q < kNodeQuestionCount; ++q) {
        if (kNodeQuestionRoles[q] != role) continue;
        missing.erase({automaton.node, static_cast<NodeQuestion>(q)});
      }
    }
    return missing.empty();
  }

  void cover() {
    BreadthFirst<ForcedNetwork> search(forced_, limits_);
    FirstSteps first(network_.edge_count());
    first.is_enough = [&] { return reaches_all(first); };
    const ReachabilityResult result = search.run(first);
    suite_.is_complete =
        result.is_complete || result.stopped == StopReason::None;
    std::vector<std::uint32_t> goals;
    for (const std::uint32_t edge : first.order) {
      if (is_of_node({edge}) && !forced_.is_write({edge})) {
        goals.push_back(edge);
      }
    }
    suite_.forced_edges = goals.size();
    std::reverse(goals.begin(), goals.end());
    for (const std::uint32_t goal : goals) {
      if (is_covered_[goal]) continue;
      ask_budget();
      PlannedRun run;
      for (const RunState& each : search.path_to(*first.from[goal])) {
        run.steps.push_back(each.step);
        run.state = each.state;
      }
      run.steps.erase(run.steps.begin());
      if (!go_on(forced_, run, 1,
                 [&](const Step& step) { return step.edge == goal; })) {
        continue;
      }
      lengthen(run);
      if (auto test = told_test(forced_, run.steps)) add(std::move(*test));
    }
  }

  // On to what is not covered yet, and to the end of the tick.
  void lengthen(PlannedRun& run) const {
    std::vector<bool> is_covered = is_covered_;
    const auto note = [&](std::size_t from) {
      for (std::size_t i = from; i < run.steps.size(); ++i) {
        if (is_of_node(run.steps[i])) is_covered[run.steps[i].edge] = true;
      }
    };
    const auto ends = [&](const Step& step) {
      return ends_tick(forced_.tree(), network_, step);
    };
    note(0);
    for (;;) {
      const PlannedRun kept = run;
      const bool is_open = !ends(run.steps.back());
      // Within a tick first to its end, by what is new if there is any.
      bool is_found = go_on(forced_, run, kNear, [&](const Step& step) {
        return is_of_node(step) && !is_covered[step.edge] &&
               !forced_.is_write(step);
      });
      if (is_found) {
        const auto ticks = std::ranges::count_if(run.steps, ends);
        PlannedRun whole = run;
        const bool is_whole = ends(whole.steps.back()) ||
                              forced_.is_fault(view_of(whole.state)) ||
                              go_on(forced_, whole, kWithinTick, ends);
        is_found = is_whole && ticks < kMostTicks;
        if (!is_found) run = kept;
      }
      if (is_found) {
        note(kept.steps.size());
        continue;
      }
      if (is_open && !forced_.is_fault(view_of(run.state))) {
        go_on(forced_, run, kWithinTick, ends);
      }
      return;
    }
  }

  void add(SuiteTest test) {
    for (const std::uint32_t edge : test.edges) is_covered_[edge] = true;
    suite_.tests.push_back(std::move(test));
  }

  // Of those that are found: what is asked for stays.
  void drop_idle_tests(std::vector<SuiteTest>& tests) const {
    std::map<std::uint32_t, int> counts;
    for (const SuiteTest& test : tests) {
      for (const std::uint32_t edge : test.edges) ++counts[edge];
    }
    std::vector<std::size_t> order(tests.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(
        order, {}, [&](std::size_t i) { return tests[i].edges.size(); });
    std::set<std::size_t> dropped;
    for (const std::size_t i : order) {
      const bool is_idle =
          tests[i].about.empty() &&
          std::ranges::all_of(tests[i].edges, [&](std::uint32_t edge) {
            return counts[edge] > 1 || forced_.is_write({edge});
          });
      if (!is_idle) continue;
      dropped.insert(i);
      for (const std::uint32_t edge : tests[i].edges) --counts[edge];
    }
    std::vector<SuiteTest> kept;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      if (!dropped.contains(i)) kept.push_back(std::move(tests[i]));
    }
    tests = std::move(kept);
  }

  void count() {
    std::set<std::uint32_t> edges;
    for (const SuiteTest& test : suite_.tests) {
      for (const std::uint32_t edge : test.edges) {
        if (!forced_.is_write({edge})) edges.insert(edge);
      }
      for (const Cell& cell : test.cells) {
        suite_.reached.insert(cell);
        suite_.proven.insert(cell);
      }
    }
    suite_.edges = edges.size();
    for (const Cell& cell : suite_.proven) {
      if (suite_.reached.contains(cell)) continue;
      suite_.left_out.push_back({cell, reason_of(cell)});
    }
  }

  // The first step of the witness that nobody can force; one that hangs on the
  // value of an entry only where there is no other.
  std::string reason_of(const Cell& cell) const {
    const auto report =
        std::ranges::find(defaults_.nodes, cell.first, &NodeReport::node);
    if (report == defaults_.nodes.end()) return "not within the limits";
    const auto& run =
        report->answers[static_cast<std::size_t>(cell.second)].run;
    if (!run) return "not within the limits";
    StateVector state;
    asked_.initial_states([&](StateView initial) {
      state.assign(initial.begin(), initial.end());
    });
    std::string reason;
    for (const Step& step : run->steps()) {
      const auto ways = asked_.ways(view_of(state));
      const bool is_forced =
          std::ranges::find(ways, step, &ForcedNetwork::Way::step) !=
          ways.end();
      if (!is_forced) {
        if (!asked_.is_about_entry(step)) return asked_.reason(step);
        if (reason.empty()) reason = asked_.reason(step);
      }
      std::optional<StateVector> next;
      asked_.system().successors(view_of(state),
                                 [&](StateView target, const Step& taken) {
                                   if (taken == step)
                                     next.emplace(target.begin(), target.end());
                                 });
      if (!next) break;
      state = std::move(*next);
    }
    if (!reason.empty()) return reason;
    return suite_.is_complete
               ? "that tick throws, or what follows in it is not known"
               : "not within the limits";
  }

  const ForcedNetwork& forced_;
  const ForcedNetwork& asked_;  // the network of the default report
  const Network& network_;
  const DefaultReport& defaults_;
  const Limits& limits_;
  std::vector<bool> is_covered_;  // by edge
  Suite suite_;
};

}  // namespace

Suite make_suite(const ForcedNetwork& forced, const ForcedNetwork& asked,
                 const DefaultReport& defaults,
                 const std::vector<NamedRun>& also, const Limits& limits) {
  return SuiteMaker(forced, asked, defaults, limits).make(also);
}

std::string suite_summary(const Suite& suite, const BehaviorTree& tree) {
  const std::size_t of = suite.proven.size();
  const std::size_t reached = suite.reached.size();
  std::string text = fmt::format(
      "{} {} {} of {} answers and halts that are proven possible ({} %)",
      suite.tests.size(),
      suite.tests.size() == 1 ? "test reaches" : "tests reach", reached, of,
      of == 0 ? 100 : 100 * reached / of);
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const LeftOut& left : suite.left_out) {
    by_reason[left.reason].push_back(fmt::format(
        "{} {}", short_name(tree, left.cell.first), word_of(left.cell.second)));
  }
  if (!suite.left_out.empty()) {
    text += fmt::format("; left out by name: {}", suite.left_out.size());
  }
  text += '\n';
  for (const auto& [reason, cells] : by_reason) {
    text += fmt::format("  {}:", reason);
    for (const std::string& cell : cells) {
      text += fmt::format("{} {}", &cell == &cells.front() ? "" : ",", cell);
    }
    text += '\n';
  }
  return text;
}

}  // namespace btcheck

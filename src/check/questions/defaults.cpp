// SPDX-License-Identifier: MIT
//
// The paper's default properties (section 4.1) and what a mission's author
// asks next. The paper proves each by a run of the model checker of its own;
// here one breadth-first search watches the edges that fire and the states
// that are reached. Only "can it still end?", "can it still succeed?" and
// "does a tick never return?" need the steps once more; they are kept in a
// graph while there is memory for it.
#include "check/questions/defaults.hpp"

#include <algorithm>

#include "check/questions/default_questions.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/breadth_first.hpp"

namespace btcheck {
namespace {

int ticks_of(const Run& run) {
  int ticks = 0;
  const std::size_t end = run.loop == kNoLoop ? run.steps.size() : run.loop;
  for (std::size_t i = 0; i < end; ++i) ticks += run.steps[i].step.elapsed;
  return ticks;
}

// Turns what the search has noted into answers with replayed runs.
class Reporter {
 public:
  Reporter(const SearchedNetwork& searched,
           const BreadthFirst<ReducedNetwork>& search,
           const ReachabilityResult& result, DefaultReport& report)
      : searched_(searched), search_(search), result_(result), report_(report) {
    report.progress = result.progress;
    report.stopped = result.stopped;
  }

  // A state or a step that was found, if any was.
  template <class First>
  Possibility possibility(const First& first) {
    Possibility answer;
    if (first) {
      answer.verdict = Verdict::Holds;
      answer.run = run_to(*first);
      if (answer.run) answer.ticks = ticks_of(*answer.run);
    } else if (result_.is_complete) {
      answer.verdict = Verdict::Violated;
    }
    return answer;
  }

  // A question answered yes by a state that is found.
  void can(TreeQuestion question, const FirstState& first) {
    Possibility answer = possibility(first);
    report_.tree.push_back(
        {question, answer.verdict, std::move(answer.run), answer.ticks});
  }

  // A question answered no by a state that is found.
  void never(TreeQuestion question, const FirstState& first) {
    can(question, first);
    Verdict& verdict = report_.tree.back().verdict;
    if (verdict != Verdict::Undecided) {
      verdict = verdict == Verdict::Holds ? Verdict::Violated : Verdict::Holds;
    }
  }

  void undecided(TreeQuestion question) {
    report_.tree.push_back({question, Verdict::Undecided, {}, 0});
  }

  // NoZeroTimeLoop, by the states of such a loop, if there is any.
  void never_loops(const std::vector<StateId>& loop) {
    TreeReport answer{TreeQuestion::NoZeroTimeLoop, Verdict::Holds, {}, 0};
    if (!loop.empty()) {
      answer.verdict = Verdict::Violated;
      answer.run = replayed(lasso_through(loop));
      if (answer.run) answer.ticks = ticks_of(*answer.run);
    }
    report_.tree.push_back(std::move(answer));
  }

  std::optional<Run> run_to(StateId state) {
    return replayed({search_.path_to(state), {}, {}});
  }
  // A run on the way that the search found, up to the edge.
  std::optional<Run> run_to(const FoundStep& last) {
    Lasso way = in_single_steps(system(), {search_.path_to(last.from), {}, {}});
    for (RunState& step :
         system().steps_up_to(way.prefix.back().state, last.edge)) {
      way.prefix.push_back(std::move(step));
    }
    return searched_.executed(way, report_.error);
  }

 private:
  const ReducedNetwork& system() const { return searched_.system(); }

  StateVector words_of(StateId state) const {
    StateVector words(system().word_count());
    search_.store().load(state, words);
    return words;
  }

  // The step without time from one state to another; a node's if there is one.
  Step instant_step(const StateVector& from, const StateVector& to) const {
    Step found;
    system().successors(from, [&](StateView target, Step step) {
      const bool leads_there =
          std::equal(target.begin(), target.end(), to.begin());
      if (leads_there && step.elapsed == 0 &&
          (found.edge == kTimeStep || step.progress)) {
        found = step;
      }
    });
    return found;
  }

  // The way to the loop's first state, then once round: a lasso's loop begins
  // one step after its prefix.
  Lasso lasso_through(const std::vector<StateId>& loop) const {
    Lasso lasso;
    lasso.prefix = search_.path_to(loop.front());
    StateVector here = lasso.prefix.back().state;
    for (std::size_t i = 1; i <= loop.size(); ++i) {
      StateVector next = words_of(loop[i % loop.size()]);
      const Step step = instant_step(here, next);
      lasso.cycle.push_back({next, step});
      here = std::move(next);
    }
    lasso.closing = lasso.cycle.front().step;
    return lasso;
  }

  std::optional<Run> replayed(const Lasso& found) {
    return searched_.replayed(found, report_.error);
  }

  const SearchedNetwork& searched_;
  const BreadthFirst<ReducedNetwork>& search_;
  const ReachabilityResult& result_;
  DefaultReport& report_;
};

// The first state from which none of the goal can be reached.
FirstState first_that_cannot(const StoredGraph& graph,
                             const std::vector<bool>& goal) {
  const std::vector<bool> can = graph.can_reach(goal);
  for (std::uint32_t s = 0; s < can.size(); ++s) {
    if (!can[s]) return StateId{s};
  }
  return std::nullopt;
}

std::vector<StateId> zero_time_loop(const StoredGraph& graph) {
  const auto state = graph.on_zero_time_loop();
  return state ? graph.zero_time_loop(*state) : std::vector<StateId>{};
}

// The questions of the tree, in the order of TreeQuestion.
void answer_for_tree(DefaultQuestions& questions, bool is_complete,
                     bool has_time, Reporter& reporter) {
  reporter.can(TreeQuestion::CanSucceed, questions.success());
  reporter.can(TreeQuestion::CanFail, questions.failure());
  const StoredGraph& graph = questions.graph();
  if (is_complete) {
    reporter.never(TreeQuestion::CanAlwaysEnd,
                   first_that_cannot(graph, questions.ended()));
    reporter.never(TreeQuestion::CanAlwaysSucceed,
                   first_that_cannot(graph, questions.succeeded()));
  } else {
    reporter.undecided(TreeQuestion::CanAlwaysEnd);
    reporter.undecided(TreeQuestion::CanAlwaysSucceed);
  }
  reporter.never(TreeQuestion::NeverStuck, questions.stuck());
  reporter.never(TreeQuestion::InRange, questions.fault());
  // Where no time passes at all, every loop is a loop without time.
  if (has_time && is_complete) {
    reporter.never_loops(zero_time_loop(graph));
  } else if (has_time) {
    reporter.undecided(TreeQuestion::NoZeroTimeLoop);
  }
}

// Only what the replayed runs show is reported.
void report_guards(const BehaviorTree& tree, const Network& network,
                   const SecondTickWatch& watch, Reporter& reporter,
                   DefaultReport& report) {
  for (std::size_t i = 0; i < watch.actions().size(); ++i) {
    if (!watch.found(i)) continue;
    const GuardedAction& guarded = watch.actions()[i];
    StaleGuardReport stale{guarded.action, {}, {}, 0};
    stale.run = reporter.run_to(*watch.found(i));
    if (!stale.run) continue;
    stale.guards = stale_guards(tree, network, guarded, *stale.run);
    stale.ticks = ticks_of(*stale.run);
    if (!stale.guards.empty()) report.stale_guards.push_back(std::move(stale));
  }
}

void report_left_running(const LeftRunningWatch& watch, Reporter& reporter,
                         DefaultReport& report) {
  for (const LeftRunningStep& found : watch.found()) {
    LeftRunningReport left{found.leaf, found.above, found.decision, {}, 0};
    left.run = reporter.run_to(found.step);
    if (!left.run) continue;
    left.ticks = ticks_of(*left.run);
    report.left_running.push_back(std::move(left));
  }
}

}  // namespace

DefaultReport check_defaults(const BehaviorTree& tree,
                             const CompiledNetwork& system, Reduction reduction,
                             const Limits& limits) {
  DefaultReport report;
  report.reduction = reduction;
  const SearchedNetwork searched(
      system, seen_by_default(tree, system.network()),
      kept_for_default(tree, system.network()), reduction);
  DefaultQuestions questions(tree, searched.system().network());
  BreadthFirst search(searched.system(), limits);
  const ReachabilityResult result = search.run(questions);
  Reporter reporter(searched, search, result, report);

  if (result.is_complete) questions.graph().close(search.store().size());
  const Network& network = system.network();
  answer_for_tree(questions, result.is_complete,
                  network.ticks != TickSemantics::None, reporter);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    report.nodes.push_back({NodeId{n}, {}});
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      report.nodes.back().answers[q] =
          reporter.possibility(questions.node(n, q));
    }
  }
  report_guards(tree, network, questions.second_ticks(), reporter, report);
  report_left_running(questions.left_running(), reporter, report);
  return report;
}

bool is_fault(const TreeReport& report) {
  switch (report.question) {
    case TreeQuestion::CanSucceed:
    case TreeQuestion::CanFail:
    case TreeQuestion::CanAlwaysSucceed:
      return false;
    default:
      return report.verdict == Verdict::Violated;
  }
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The paper's default properties (section 4.1) and what a mission's author
// asks next. The paper proves each by a run of the model checker of its own;
// here one breadth-first search watches the edges that fire. The first step
// into a node's location `success`, say, answers "can it succeed?", and what
// was never seen when the search is done cannot happen. Only "can it still
// end?" and "does a tick never return?" need the steps once more; they are
// kept in a graph while there is memory for it.
#include "check/defaults.hpp"

#include "check/replay.hpp"
#include "explore/breadth_first.hpp"
#include "explore/stored_graph.hpp"

namespace btcheck {
namespace {

constexpr std::array<std::string_view, kNodeQuestionCount> kLocations = {
    "tick_node", "success", "failure", "running", "halted"};

// A question of the search that is answered by the first state found.
using FirstState = std::optional<StateId>;

class DefaultQuestions : public ReachabilityVisitor {
 public:
  DefaultQuestions(const BehaviorTree& tree, const CompiledNetwork& system)
      : system_(system),
        nodes_(tree.nodes.size()),
        question_of_edge_(system.network().edge_count(), kNone) {
    const Network& network = system.network();
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      watch_node(network.automaton(network.node_automaton[n]), n);
    }
    for (const NodeId root : tree.roots) {
      roots_.push_back(&network.automaton(network.node_automaton[index(root)]));
    }
  }

  void stepped(StateId from, Step step, StateId to) {
    graph_.add(from, step, to);
    if (step.edge == kTimeStep) return;
    const std::uint32_t question = question_of_edge_[step.edge];
    if (question == kNone) return;
    FirstState& first =
        nodes_[question / kNodeQuestionCount][question % kNodeQuestionCount];
    if (!first) first = to;
  }

  GoOn expanded(StateId id, StateView state, bool is_dead) {
    const bool ended = all_roots_in(state, "success", "failure");
    if (!success_ && ended && all_roots_in(state, "success", "success")) {
      success_ = id;
    }
    if (!failure_ && some_root_failed(state)) failure_ = id;
    const std::optional<VariableId> fault = system_.network().fault;
    const bool is_faulty = fault && system_.value(state, *fault) != 0;
    if (is_faulty && !fault_) fault_ = id;
    // A fault ends the run as well; it is reported as such.
    ended_.push_back(ended || is_faulty);
    if (is_dead && !ended && !is_faulty && !stuck_) stuck_ = id;
    return GoOn::Yes;
  }

  std::size_t bytes() const { return graph_.bytes() + ended_.size() / 8; }

  const FirstState& node(std::size_t n, std::size_t question) const {
    return nodes_[n][question];
  }
  const FirstState& success() const { return success_; }
  const FirstState& failure() const { return failure_; }
  const FirstState& fault() const { return fault_; }
  const FirstState& stuck() const { return stuck_; }
  const std::vector<bool>& ended() const { return ended_; }
  StoredGraph& graph() { return graph_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  void watch_node(const Automaton& automaton, std::uint32_t node) {
    for (std::uint32_t q = 0; q < kNodeQuestionCount; ++q) {
      auto location = automaton.find_location(kLocations[q]);
      if (!location) continue;
      for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
        if (automaton.edges[e].target != *location) continue;
        question_of_edge_[automaton.first_edge + e] =
            node * static_cast<std::uint32_t>(kNodeQuestionCount) + q;
      }
    }
  }

  bool root_is_in(const Automaton& root, StateView state,
                  std::string_view location) const {
    auto found = root.find_location(location);
    return found && system_.value(state, root.location) == index(*found);
  }

  bool all_roots_in(StateView state, std::string_view one,
                    std::string_view other) const {
    for (const Automaton* root : roots_) {
      if (!root_is_in(*root, state, one) && !root_is_in(*root, state, other)) {
        return false;
      }
    }
    return true;
  }

  bool some_root_failed(StateView state) const {
    for (const Automaton* root : roots_) {
      if (root_is_in(*root, state, "failure")) return true;
    }
    return false;
  }

  const CompiledNetwork& system_;
  std::vector<std::array<FirstState, kNodeQuestionCount>> nodes_;
  std::vector<std::uint32_t> question_of_edge_;
  std::vector<const Automaton*> roots_;
  std::vector<bool> ended_;  // by state
  FirstState success_;
  FirstState failure_;
  FirstState fault_;
  FirstState stuck_;
  StoredGraph graph_;
};

int ticks_of(const Run& run) {
  int ticks = 0;
  for (const RunStep& step : run.steps) ticks += step.step.elapsed;
  return ticks;
}

// Turns what the search has noted into answers with replayed runs.
class Reporter {
 public:
  Reporter(const CompiledNetwork& system,
           const BreadthFirst<CompiledNetwork>& search,
           const ReachabilityResult& result, DefaultReport& report)
      : system_(system), search_(search), result_(result), report_(report) {
    report.progress = result.progress;
    report.stopped = result.stopped;
  }

  Possibility possibility(const FirstState& first) {
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

 private:
  std::optional<Run> run_to(StateId state) {
    return replay(system_, {search_.path_to(state), {}, {}}, report_.error);
  }

  const CompiledNetwork& system_;
  const BreadthFirst<CompiledNetwork>& search_;
  const ReachabilityResult& result_;
  DefaultReport& report_;
};

FirstState first_that_cannot_end(DefaultQuestions& questions) {
  const std::vector<bool> can_end =
      questions.graph().can_reach(questions.ended());
  for (std::uint32_t s = 0; s < can_end.size(); ++s) {
    if (!can_end[s]) return StateId{s};
  }
  return std::nullopt;
}

}  // namespace

DefaultReport check_defaults(const BehaviorTree& tree,
                             const CompiledNetwork& system,
                             const Limits& limits) {
  DefaultReport report;
  DefaultQuestions questions(tree, system);
  BreadthFirst search(system, limits);
  const ReachabilityResult result = search.run(questions);
  Reporter reporter(system, search, result, report);

  reporter.can(TreeQuestion::CanSucceed, questions.success());
  reporter.can(TreeQuestion::CanFail, questions.failure());
  if (result.is_complete) {
    questions.graph().close(search.store().size());
    reporter.never(TreeQuestion::CanAlwaysEnd,
                   first_that_cannot_end(questions));
  } else {
    reporter.undecided(TreeQuestion::CanAlwaysEnd);
  }
  reporter.never(TreeQuestion::NeverStuck, questions.stuck());
  reporter.never(TreeQuestion::InRange, questions.fault());
  // Where no time passes at all, every loop is a loop without time.
  const bool has_time = system.network().ticks != TickSemantics::None;
  if (has_time && result.is_complete) {
    reporter.never(TreeQuestion::NoZeroTimeLoop,
                   questions.graph().on_zero_time_loop());
  } else if (has_time) {
    reporter.undecided(TreeQuestion::NoZeroTimeLoop);
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    report.nodes.push_back({NodeId{n}, {}});
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      report.nodes.back().answers[q] =
          reporter.possibility(questions.node(n, q));
    }
  }
  return report;
}

bool is_fault(const TreeReport& report) {
  return report.verdict == Verdict::Violated &&
         report.question != TreeQuestion::CanSucceed &&
         report.question != TreeQuestion::CanFail;
}

}  // namespace btcheck

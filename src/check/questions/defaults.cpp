// SPDX-License-Identifier: MIT
//
// The paper's default properties (section 4.1) and what a mission's author asks
// next, all answered by one breadth-first search. Only "can it still end?",
// "can it still succeed?" and "does a tick never return?" need the steps once
// more; they are kept in a graph while there is memory for it. A search that
// takes long is interrupted for random walks: what they see is told at once,
// and stands where the search does not come to it.
#include "check/questions/defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>

#include "check/findings/findings.hpp"
#include "check/questions/answered.hpp"
#include "check/questions/watches.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/random_walks.hpp"
#include "explore/search/reachability.hpp"
#include "explore/search/stored_graph.hpp"

namespace btcheck {
namespace {

// A question of the search that is answered by the first state found.
using FirstState = std::optional<StateId>;
// Or by the first edge taken.
using FirstStep = std::optional<FoundStep>;

// Whether the roots have ended, and how. (A fault is never missed: it is dead.)
// And where rounds of an unknown number begin, so that such a step is told by
// itself.
Observed seen_by_default(const BehaviorTree& tree, const Network& network) {
  Observed seen(network);
  for (const NodeId root : tree.roots) {
    const Automaton& automaton = network.automaton(root);
    for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
      if (!is_end(automaton.locations[i].role)) continue;
      seen.add(equals(automaton.location, static_cast<int>(i)));
    }
  }
  for (const Automaton& automaton : network.automata) {
    for (const Edge& edge : automaton.edges) {
      if (!edge.is_open_round) continue;
      seen.add(equals(automaton.location, static_cast<int>(edge.source)));
    }
  }
  return seen;
}

// Beyond that, which nodes run when some other gives control back or is ticked,
// and what sightings ask. All of them stand below or beside that node, and what
// they do is done by then in whatever order the rest of the tree moves; so it
// need not be seen at once.
Observed kept_for_default(const BehaviorTree& tree, const Network& network,
                          const std::vector<Sighting>& sightings) {
  Observed kept = seen_by_default(tree, network);
  const auto keep = [&](NodeId node) {
    kept.add(equals(network.node_status[index(node)], NodeStatus::Running));
  };
  for (const NodeId node : may_be_left_running(tree, network)) keep(node);
  for (const Sighting& sighting : sightings) {
    for (const auto& [node, status] : sighting.with) {
      kept.add(equals(network.node_status[index(node)], status));
    }
    if (!sighting.retried) continue;
    for (const VariableId local : network.automaton(*sighting.retried).locals) {
      kept.add(equals(local, 0));
    }
  }
  return kept;
}

// Watches the edges that fire for the questions of single nodes, the states for
// those of the tree, and keeps every step for those that need steps twice.
struct DefaultQuestions : public ReachabilityVisitor {
  DefaultQuestions(const BehaviorTree& tree, const CompiledNetwork& system,
                   const std::vector<Sighting>& watched)
      : nodes(tree.nodes.size()),
        left_running(tree, system),
        sightings(watched, system),
        system_(system),
        question_of_edge_(system.network().edge_count(), nullptr),
        is_open_round_(system.network().edge_count(), false) {
    const Network& network = system.network();
    for (const Automaton& automaton : network.automata) {
      for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
        is_open_round_[automaton.first_edge + e] =
            automaton.edges[e].is_open_round;
      }
    }
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      watch_node(network.automaton(NodeId{n}), nodes[n]);
    }
    for (const NodeId root : tree.roots) {
      roots_.push_back(&network.automaton(root));
    }
  }

  void passed(StateId from, StateView before, Step step, StateView /*after*/) {
    left_running.passed(from, before, step);
    sightings.passed(from, before, step);
    if (step.edge == kTimeStep) return;
    FirstStep* first = question_of_edge_[step.edge];
    if (first != nullptr && !*first) *first = FoundStep{from, step.edge};
  }

  // Rounds of an unknown number come to an end, as time does: they are no part
  // of a loop that takes none.
  void stepped(StateId from, Step step, StateId to) {
    if (step.edge != kTimeStep && is_open_round_[step.edge]) step.elapsed = 1;
    graph.add(from, step, to);
  }

  GoOn expanded(StateId id, StateView state, bool is_dead) {
    const auto role = [&](const Automaton* root) {
      return root->locations[system_.value(state, root->location)].role;
    };
    const bool has_ended = std::ranges::all_of(roots_, is_end, role);
    const bool has_succeeded =
        has_ended && std::ranges::count(roots_, LocationRole::Success, role) ==
                         std::ssize(roots_);
    if (!success && has_succeeded) success = id;
    if (!failure &&
        std::ranges::count(roots_, LocationRole::Failure, role) > 0) {
      failure = id;
    }
    const std::optional<VariableId> fault_bit = system_.network().fault;
    const bool is_faulty = fault_bit && system_.value(state, *fault_bit) != 0;
    if (is_faulty && !fault) fault = id;
    // A fault ends the run as well; it is reported as such.
    ended.push_back(has_ended || is_faulty);
    succeeded.push_back(has_succeeded);
    if (is_dead && !has_ended && !is_faulty && !stuck) stuck = id;
    if (pause && ended.size() % kPollInterval == 0) pause(ended.size());
    return GoOn::Yes;
  }

  std::size_t bytes() const {
    return graph.bytes() + (ended.size() + succeeded.size()) / 8 + beside;
  }

  std::vector<std::array<FirstStep, kNodeQuestionCount>> nodes;
  LeftRunningWatch left_running;
  SightingWatch sightings;
  std::vector<bool> ended;      // by state
  std::vector<bool> succeeded;  // by state: all roots have
  FirstState success;
  FirstState failure;
  FirstState fault;
  FirstState stuck;
  StoredGraph graph;
  // Called now and then with the number of states that were expanded.
  std::function<void(std::size_t)> pause;
  std::size_t beside = 0;  // bytes held by what is done then

 private:
  void watch_node(const Automaton& automaton,
                  std::array<FirstStep, kNodeQuestionCount>& questions) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const auto location = automaton.find_location(kNodeQuestionRoles[q]);
      for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
        if (automaton.edges[e].target != location) continue;
        question_of_edge_[automaton.first_edge + e] = &questions[q];
      }
    }
  }

  const CompiledNetwork& system_;
  std::vector<FirstStep*> question_of_edge_;  // null: none
  std::vector<bool> is_open_round_;           // by edge
  std::vector<const Automaton*> roots_;
};

// Turns what the search has noted into answers with replayed runs.
class Reporter {
 public:
  Reporter(const SearchedNetwork& searched,
           const Reachability<ReducedNetwork>& search, bool is_complete,
           const Network& network, const Limits& limits, DefaultReport& report)
      : searched_(searched),
        search_(search),
        is_complete_(is_complete),
        limits_(limits),
        report_(report),
        network_(network),
        interpreter_(network),
        replayer_(searched.replayer()),
        runs_(std::make_shared<RunTree>(network)) {}

  // A state or a step that was found, if any was.
  template <class First>
  Possibility possibility(const First& first) {
    Possibility answer;
    if (first) {
      answer.run = run_to(*first);
      if (answer.run) answer.verdict = Verdict::Holds;
    } else if (is_complete_) {
      answer.verdict = Verdict::Violated;
    }
    return answer;
  }

  // NoZeroTimeLoop, by the states of such a loop, if there is any.
  void never_loops(const std::vector<StateId>& loop) {
    TreeReport answer{
        {Verdict::Holds, {}}, TreeQuestion::NoZeroTimeLoop, false};
    if (!loop.empty()) {
      answer.verdict = Verdict::Violated;
      const auto run = searched_.replayed(lasso_through(loop), report_.error);
      if (run) answer.run = kept(*run);
    }
    report_.tree.push_back(std::move(answer));
  }

  // Nothing where a step could not be replayed, or no time is left to do it.
  std::optional<KeptRun> run_to(StateId state) {
    return run_to(place_of(state));
  }
  // A run on the way that the search found, up to the edge.
  std::optional<KeptRun> run_to(const FoundStep& last) {
    return run_to(place_behind(last));
  }
  // The same, and on from there until the node has answered; nothing where it
  // answers otherwise, or the world outside has a say.
  std::optional<KeptRun> run_to(const FoundStep& last,
                                const Consequence& then) {
    std::optional<Place> place = place_behind(last);
    if (!place) return std::nullopt;
    Valuation state = runs_->state(*place);
    for (int i = 0; i < kMostFollowed; ++i) {
      const auto edge = only_edge(state);
      if (!edge) return std::nullopt;
      const Step step{.edge = *edge};
      interpreter_.take(state, step);
      place = runs_->follow(*place, step, state);
      const Automaton& mover = network_.owner_of_edge(*edge);
      if (mover.kind != AutomatonKind::Node || mover.node != then.node) {
        continue;
      }
      const LocationRole role = mover.target(network_.edge(*edge)).role;
      if (role == then.answer) return run_to(place);
      if (is_answer(role)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  using Place = RunTree::Place;

  std::optional<KeptRun> run_to(std::optional<Place> place) const {
    if (!place) return std::nullopt;
    return KeptRun(runs_, *place);
  }

  std::optional<Place> place_behind(const FoundStep& last) {
    const auto place = place_of(last.from);
    if (!place) return std::nullopt;
    return executed(*place, system().steps_up_to(words_of(last.from), last.edge,
                                                 last.before));
  }

  // The step that comes next; nothing where it is not the tree's to decide.
  std::optional<std::uint32_t> only_edge(const Valuation& state) const {
    for (std::uint32_t edge = 0; edge < network_.edge_count(); ++edge) {
      if (!interpreter_.may_fire(state, edge)) continue;
      if (network_.edge(edge).asks_world) return std::nullopt;
      return edge;
    }
    return std::nullopt;
  }

  const ReducedNetwork& system() const { return searched_.system(); }

  StateVector words_of(StateId state) const {
    StateVector words(system().word_count());
    search_.store().load(state, words);
    return words;
  }

  // Where the run to a state of the search ends. All runs come from one search,
  // so what they share is executed once.
  std::optional<Place> place_of(StateId state) {
    if (!report_.error.empty() || !has_time()) return std::nullopt;
    std::vector<StateId> way;
    for (; !places_.contains(index(state));
         state = search_.tree().parent(state)) {
      way.push_back(state);
      if (search_.tree().parent(state) != state) continue;
      if (!replayer_.begin(words_of(state))) return failed();
      at_ = Place{0};
      places_.emplace(index(state), *at_);
      way.pop_back();
      break;
    }
    Place place = places_.at(index(state));
    StateVector here = words_of(state);
    for (; !way.empty(); way.pop_back()) {
      StateVector next = words_of(way.back());
      const auto reached = executed(place, steps_between(here, next));
      if (!reached) return std::nullopt;
      place = *reached;
      places_.emplace(index(way.back()), place);
      here = std::move(next);
    }
    return place;
  }

  std::vector<RunState> steps_between(const StateVector& from,
                                      const StateVector& to) const {
    const Step step = step_between(system(), from, to);
    if (!system().is_reduced()) return {{to, step}};
    return system().single_steps(from, step, to);
  }

  // From a place on, with these steps.
  std::optional<Place> executed(Place place,
                                const std::vector<RunState>& steps) {
    if (at_ != place) replayer_.go_on_from(runs_->state(place));
    for (const RunState& each : steps) {
      if (!replayer_.take(each.step, each.state)) return failed();
      place = runs_->follow(place, each.step, replayer_.state());
    }
    at_ = place;
    return place;
  }

  std::nullopt_t failed() {
    report_.error = replayer_.error();
    return std::nullopt;
  }

  bool has_time() {
    if (is_late_ || ++asked_ % kPlacesPerPoll != 0) return !is_late_;
    is_late_ = !limits_.may_tell();
    if (is_late_ && report_.stopped == StopReason::None) {
      report_.stopped = limits_.reached(report_.progress);
    }
    return !is_late_;
  }

  KeptRun kept(const Run& run) {
    Place place = 0;
    for (const RunStep& step : std::span(run.steps).first(run.loop)) {
      place = runs_->follow(place, step.step, step.after);
    }
    std::vector<Step> loop;
    for (const RunStep& step : run.loop_steps()) loop.push_back(step.step);
    return {runs_, place, std::move(loop)};
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

  static constexpr std::uint32_t kPlacesPerPoll = 16;
  static constexpr int kMostFollowed = 1000;

  const SearchedNetwork& searched_;
  const Reachability<ReducedNetwork>& search_;
  bool is_complete_;
  const Limits& limits_;
  DefaultReport& report_;
  const Network& network_;
  NetworkInterpreter interpreter_;
  Replayer replayer_;
  std::shared_ptr<RunTree> runs_;
  std::unordered_map<std::uint32_t, Place> places_;  // by StateId
  std::optional<Place> at_;                          // where replayer_ is
  std::uint32_t asked_ = 0;
  bool is_late_ = false;
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

// What a search has seen, and who tells it.
struct Seen {
  const DefaultQuestions& questions;
  Reporter& reporter;
};

// What all have seen, the one whose runs are shortest first.
class Evidence {
 public:
  void add(Seen seen) { seen_.push_back(seen); }

  // `first` gives the state or step that the questions have noted.
  template <class First>
  Possibility possibility(First first) const {
    Possibility answer;
    for (const Seen& each : seen_) {
      answer = each.reporter.possibility(std::invoke(first, each.questions));
      if (answer.verdict != Verdict::Undecided) break;
    }
    return answer;
  }

  bool has_sighting(std::size_t i) const {
    return std::ranges::any_of(seen_, [&](const Seen& each) {
      return each.questions.sightings.found(i).has_value();
    });
  }

  // A run up to the sighting, and on until what has to follow.
  std::optional<KeptRun> run_to(
      std::size_t sighting, const std::optional<Consequence>& then = {}) const {
    for (const auto& [questions, reporter] : seen_) {
      const auto& found = questions.sightings.found(sighting);
      if (!found) continue;
      auto run =
          then ? reporter.run_to(*found, *then) : reporter.run_to(*found);
      if (run) return run;
    }
    return std::nullopt;
  }

 private:
  std::vector<Seen> seen_;
};

// The questions of the tree, in the order of TreeQuestion.
void answer_for_tree(DefaultQuestions& questions, bool is_complete,
                     bool has_time, Reporter& reporter,
                     const Evidence& evidence, DefaultReport& report) {
  const auto add = [&](TreeQuestion question, Possibility answer) {
    report.tree.push_back({std::move(answer), question, false});
  };
  // Answered no by what is found.
  const auto never = [&](TreeQuestion question, Possibility answer) {
    if (answer.verdict != Verdict::Undecided) {
      answer.verdict =
          answer.verdict == Verdict::Holds ? Verdict::Violated : Verdict::Holds;
    }
    add(question, std::move(answer));
  };
  add(TreeQuestion::CanSucceed,
      evidence.possibility(&DefaultQuestions::success));
  add(TreeQuestion::CanFail, evidence.possibility(&DefaultQuestions::failure));
  const auto can_always = [&](TreeQuestion question,
                              const std::vector<bool>& goal) {
    if (!is_complete) return add(question, {});
    never(question,
          reporter.possibility(first_that_cannot(questions.graph, goal)));
  };
  can_always(TreeQuestion::CanAlwaysEnd, questions.ended);
  can_always(TreeQuestion::CanAlwaysSucceed, questions.succeeded);
  never(TreeQuestion::NeverStuck,
        evidence.possibility(&DefaultQuestions::stuck));
  never(TreeQuestion::InRange, evidence.possibility(&DefaultQuestions::fault));
  // Where no time passes at all, every loop is a loop without time.
  if (!has_time) return;
  if (!is_complete) return add(TreeQuestion::NoZeroTimeLoop, {});
  const StoredGraph& graph = questions.graph;
  const auto state = graph.on_zero_time_loop();
  reporter.never_loops(state ? graph.zero_time_loop(*state)
                             : std::vector<StateId>());
}

// Only what the replayed runs show is reported.
void report_guards(const BehaviorTree& tree, const Network& network,
                   const std::vector<NodeId>& actions, std::size_t first,
                   const Evidence& evidence, DefaultReport& report) {
  for (const NodeId action : actions) {
    const auto run = evidence.run_to(first++);
    if (!run) continue;
    auto guards = stale_guards(tree, network, action, run->steps());
    if (guards.empty()) continue;
    report.stale_guards.push_back({action, std::move(guards), run});
  }
}

void report_left_running(const LeftRunningWatch& watch, Reporter& reporter,
                         DefaultReport& report) {
  for (const LeftRunningStep& found : watch.found()) {
    const auto run = reporter.run_to(found.step);
    if (!run) continue;
    report.left_running.push_back(
        {found.leaf, found.above, found.decision, run});
  }
}

// The sightings of all suspicions in a row: first those that show one, then
// those that clear it.
std::vector<Sighting> sightings_of(const std::vector<Suspicion>& suspicions) {
  std::vector<Sighting> all;
  for (const Suspicion& each : suspicions) {
    all.insert(all.end(), each.shown_by.begin(), each.shown_by.end());
    all.insert(all.end(), each.cleared_by.begin(), each.cleared_by.end());
  }
  return all;
}

// Decides suspicions one after the other.
class Judge {
 public:
  Judge(const Evidence& evidence, bool is_complete)
      : evidence_(evidence), is_complete_(is_complete) {}

  // Whether it is so; then with the run that shows it.
  bool confirm(Suspicion& suspicion) {
    const std::size_t shown = next_;
    const std::size_t cleared = shown + suspicion.shown_by.size();
    next_ = cleared + suspicion.cleared_by.size();
    for (std::size_t i = cleared; i < next_; ++i) {
      if (!is_complete_ || evidence_.has_sighting(i)) return false;
    }
    if (suspicion.shown_by.empty()) return true;
    for (std::size_t i = shown; i < cleared; ++i) {
      suspicion.finding.run = evidence_.run_to(i, suspicion.then);
      if (suspicion.finding.run && is_after(suspicion)) return true;
    }
    return false;
  }

 private:
  static bool is_after(const Suspicion& suspicion) {
    if (!suspicion.after) return true;
    const KeptRun& run = *suspicion.finding.run;
    return std::ranges::any_of(run.steps(), [&](const Step& step) {
      return step.edge != kTimeStep &&
             node_entering(run.network(), step.edge, suspicion.after->answer) ==
                 suspicion.after->node;
    });
  }

  const Evidence& evidence_;
  bool is_complete_;
  std::size_t next_ = 0;
};

// Random walks beside a search, of at most a quarter as many steps as it has
// expanded states.
class Samples {
 public:
  Samples(const BehaviorTree& tree, const SearchedNetwork& searched,
          const std::vector<Sighting>& sightings, const Network& network,
          const Limits& limits, DefaultReport& report)
      : limits_(limits),
        walks_(searched.system(), limits,
               successes(tree, searched.system().network().network())),
        questions_(tree, searched.system().network(), sightings),
        reporter_(searched, walks_, false, network, limits, report) {
    evidence_.add(seen());
  }

  // When the search has come so far, or half of its time is over.
  bool is_due(std::size_t expanded) const {
    return !is_taken_ && (expanded >= kLong || !limits_.has_spare());
  }

  void take(std::size_t expanded) {
    is_taken_ = true;
    SearchProgress progress;
    progress.states = progress.expanded = expanded;
    walks_.run(questions_, std::min(expanded / 4, kMostSteps),
               [&] { return limits_.reached(progress) == StopReason::None; });
  }

  // Lines that say what was seen.
  std::string told(std::vector<Suspicion> suspicions) const {
    std::string lines;
    const auto success = evidence_.possibility(&DefaultQuestions::success);
    if (success.run) {
      lines +=
          fmt::format("seen so far: the mission can succeed, after {} tick{}\n",
                      success.ticks(), success.ticks() == 1 ? "" : "s");
    }
    Judge judge(evidence_, false);
    for (Suspicion& each : suspicions) {
      if (!judge.confirm(each)) continue;
      lines += fmt::format("seen so far: {}: {}\n", each.finding.code,
                           each.finding.message);
    }
    return lines;
  }

  bool is_taken() const { return is_taken_; }
  Seen seen() { return {questions_, reporter_}; }
  std::size_t bytes() const { return walks_.bytes(); }

 private:
  // By edge: a leaf succeeds.
  static std::vector<bool> successes(const BehaviorTree& tree,
                                     const Network& network) {
    std::vector<bool> found(network.edge_count(), false);
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      if (!tree.nodes[n].children.empty()) continue;
      const Automaton& leaf = network.automaton(NodeId{n});
      for (std::uint32_t e = 0; e < leaf.edges.size(); ++e) {
        found[leaf.first_edge + e] =
            leaf.target(leaf.edges[e]).role == LocationRole::Success;
      }
    }
    return found;
  }

  static constexpr std::size_t kLong = std::size_t{1} << 17;
  static constexpr std::size_t kMostSteps = std::size_t{1} << 16;

  const Limits& limits_;
  RandomWalks<ReducedNetwork> walks_;
  DefaultQuestions questions_;
  Reporter reporter_;
  Evidence evidence_;
  bool is_taken_ = false;
};

}  // namespace

DefaultReport check_defaults(const BehaviorTree& tree,
                             const CompiledNetwork& system, Reduction reduction,
                             const Limits& limits, Sampling sampling) {
  DefaultReport report;
  report.reduction = reduction;
  std::vector<Suspicion> suspicions = suspicions_of(tree);
  // Behind those of the suspicions: each guarded action, ticked while it runs.
  const std::vector<NodeId> guarded = guarded_actions(tree, system.network());
  std::vector<Sighting> sightings = sightings_of(suspicions);
  for (const NodeId action : guarded) {
    sightings.push_back(
        {action, LocationRole::Tick, {{action, NodeStatus::Running}}});
  }
  const SearchedNetwork searched(
      system, seen_by_default(tree, system.network()),
      kept_for_default(tree, system.network(), sightings), reduction);
  DefaultQuestions questions(tree, searched.system().network(), sightings);
  BreadthFirst search(searched.system(), limits);
  const Network& network = system.network();
  Samples samples(tree, searched, sightings, network, limits, report);
  if (sampling == Sampling::WhenLong) {
    questions.pause = [&](std::size_t expanded) {
      if (!samples.is_due(expanded)) return;
      samples.take(expanded);
      questions.beside = samples.bytes();
      if (limits.monitor != nullptr) {
        limits.monitor->found(samples.told(suspicions));
      }
    };
  }
  const ReachabilityResult result = search.run(questions);
  report.progress = result.progress;
  report.stopped = result.stopped;
  Reporter reporter(searched, search, result.is_complete, network, limits,
                    report);
  Evidence evidence;
  evidence.add({questions, reporter});
  if (samples.is_taken() && !result.is_complete) evidence.add(samples.seen());

  if (result.is_complete) questions.graph.close(search.store().size());
  answer_for_tree(questions, result.is_complete,
                  network.ticks != TickSemantics::None, reporter, evidence,
                  report);
  const bool runs_on = is_meant_to_run_on(tree);
  for (TreeReport& answer : report.tree) {
    answer.is_meant =
        runs_on && answer.question <= TreeQuestion::CanAlwaysSucceed;
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    report.nodes.push_back({NodeId{n}, {}});
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      report.nodes.back().answers[q] = evidence.possibility(
          [&](const DefaultQuestions& seen) { return seen.nodes[n][q]; });
    }
  }
  report_guards(tree, network, guarded, sightings.size() - guarded.size(),
                evidence, report);
  report_left_running(questions.left_running, reporter, report);
  report.findings = findings_in(tree, report);
  Judge judge(evidence, result.is_complete);
  for (Suspicion& each : suspicions) {
    if (judge.confirm(each)) report.findings.push_back(std::move(each.finding));
  }
  rank(report.findings, tree);
  return report;
}

bool is_fault(const TreeReport& report) {
  return report.verdict == Verdict::Violated && !report.is_meant &&
         report.question != TreeQuestion::CanSucceed &&
         report.question != TreeQuestion::CanFail &&
         report.question != TreeQuestion::CanAlwaysSucceed;
}

}  // namespace btcheck

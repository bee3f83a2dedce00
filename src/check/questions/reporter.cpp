// SPDX-License-Identifier: MIT
#include "check/questions/reporter.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace btcheck {
namespace {

constexpr std::uint32_t kStepsPerPoll = 256;
constexpr int kMostFollowed = 1000;

}  // namespace

Reporter::Reporter(const SearchedNetwork& searched,
                   const Reachability<ReducedNetwork>& search, bool is_complete,
                   const Network& network, const Limits& limits,
                   DefaultReport& report)
    : searched_(searched),
      search_(search),
      is_complete_(is_complete),
      limits_(limits),
      report_(report),
      network_(network),
      interpreter_(network),
      replayer_(searched.replayer()),
      runs_(std::make_shared<RunTree>(network)) {}

Reporter::~Reporter() { runs_->close(); }

void Reporter::look_up(std::vector<StateId> states) {
  // A breadth-first search numbers them as it finds them.
  std::ranges::sort(states, {}, [](StateId state) { return index(state); });
  for (const StateId state : states) place_of(state);
}

void Reporter::never_loops(const std::vector<StateId>& loop) {
  TreeReport answer{{Verdict::Holds, {}}, TreeQuestion::NoZeroTimeLoop, false};
  if (!loop.empty()) {
    answer.verdict = Verdict::Violated;
    const auto run = searched_.replayed(lasso_through(loop), report_.error);
    if (run) answer.run = kept(*run);
  }
  report_.tree.push_back(std::move(answer));
}

std::optional<KeptRun> Reporter::run_to(StateId state) {
  auto place = place_of(state);
  if (!place) return std::nullopt;
  // Where nothing can happen any more, nothing is left to be done.
  if (at_ != place) replayer_.go_on_from(runs_->state(*place));
  replayer_.settle(following(*place));
  at_ = place;
  return run_to(place);
}
std::optional<KeptRun> Reporter::run_to(const FoundStep& last) {
  return run_to(place_behind(last));
}
std::optional<KeptRun> Reporter::run_to(const FoundStep& last,
                                        const Consequence& then) {
  const std::optional<Place> place = place_behind(last);
  return place ? run_on(*place, then) : std::nullopt;
}

std::optional<KeptRun> Reporter::run_on(const KeptRun& run,
                                        const Consequence& then) {
  Place place = 0;
  Valuation state = interpreter_.initial();
  for (const Step& step : run.steps()) {
    interpreter_.take(state, step);
    place = runs_->follow(place, step, state);
  }
  return run_on(place, then);
}

std::optional<KeptRun> Reporter::run_on(Place place, const Consequence& then) {
  Valuation state = runs_->state(place);
  for (int i = 0; i < kMostFollowed; ++i) {
    const auto edge = only_edge(state);
    if (!edge) return std::nullopt;
    const Step step{.edge = *edge};
    interpreter_.take(state, step);
    place = runs_->follow(place, step, state);
    const Automaton& mover = network_.owner_of_edge(*edge);
    if (mover.kind != AutomatonKind::Node || mover.node != then.node) {
      continue;
    }
    const LocationRole role = mover.target(network_.edge(*edge)).role;
    if (role == then.answer) return KeptRun(runs_, place);
    if (is_answer(role)) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<KeptRun> Reporter::run_to(std::optional<Place> place) const {
  if (!place) return std::nullopt;
  return KeptRun(runs_, *place);
}

std::optional<RunTree::Place> Reporter::place_behind(const FoundStep& last) {
  const auto place = place_of(last.from);
  if (!place) return std::nullopt;
  return executed(*place, system().steps_up_to(words_of(last.from), last.edge,
                                               last.before));
}

std::optional<std::uint32_t> Reporter::only_edge(const Valuation& state) const {
  for (const Automaton& automaton : network_.automata) {
    const bool is_called =
        !automaton.gate || state.variables[index(*automaton.gate)] != 0;
    if (!is_called || automaton.kind == AutomatonKind::StateVariable) continue;
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      const std::uint32_t edge = automaton.first_edge + e;
      if (!interpreter_.may_fire(state, edge)) continue;
      // Beside it another branch of a Parallel may go on.
      if (is_choice(network_, state.variables, edge)) break;
      return edge;
    }
  }
  return std::nullopt;
}

StateVector Reporter::words_of(StateId state) const {
  StateVector words(system().word_count());
  search_.store().load(state, words);
  return words;
}

std::optional<RunTree::Place> Reporter::place_of(StateId state) {
  if (!report_.error.empty()) return std::nullopt;
  if (is_late_ && !places_.contains(index(state))) return std::nullopt;
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
    if (!has_time()) return std::nullopt;
    StateVector next = words_of(way.back());
    const auto reached = executed(place, steps_between(here, next));
    if (!reached) return std::nullopt;
    place = *reached;
    places_.emplace(index(way.back()), place);
    here = std::move(next);
  }
  return place;
}

std::vector<RunState> Reporter::steps_between(const StateVector& from,
                                              const StateVector& to) const {
  const Step step = step_between(system(), from, to);
  if (!system().is_reduced()) return {{to, step}};
  return system().single_steps(from, step, to);
}

std::optional<RunTree::Place> Reporter::executed(
    Place place, const std::vector<RunState>& steps) {
  if (at_ != place) replayer_.go_on_from(runs_->state(place));
  for (const RunState& each : steps) {
    if (!replayer_.take(each.step, each.state, following(place))) {
      return failed();
    }
  }
  at_ = place;
  return place;
}

Replayer::Taken Reporter::following(Place& place) {
  return [this, &place](const Step& step, const Valuation& after) {
    place = runs_->follow(place, step, after);
  };
}

std::nullopt_t Reporter::failed() {
  report_.error = replayer_.error();
  return std::nullopt;
}

bool Reporter::has_time() {
  if (is_late_ || ++asked_ % kStepsPerPoll != 0) return !is_late_;
  is_late_ = !limits_.may_tell();
  if (is_late_ && report_.stopped == StopReason::None) {
    report_.stopped = limits_.reached(report_.progress);
  }
  return !is_late_;
}

KeptRun Reporter::kept(const Run& run) {
  Place place = 0;
  for (const RunStep& step : std::span(run.steps).first(run.loop)) {
    place = runs_->follow(place, step.step, step.after);
  }
  std::vector<Step> loop;
  for (const RunStep& step : run.loop_steps()) loop.push_back(step.step);
  return {runs_, place, std::move(loop)};
}

Step Reporter::instant_step(const StateVector& from,
                            const StateVector& to) const {
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

Lasso Reporter::lasso_through(const std::vector<StateId>& loop) const {
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

}  // namespace btcheck

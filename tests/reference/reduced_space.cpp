// SPDX-License-Identifier: MIT
//
// The states that a reduction leaves, written out, and what can be learned
// from a space whether it was reduced or not.
//
// The unreduced side is naive_network's alone. After a fault nothing moves any
// more, so a step that the reduction puts in front of the one that fails is
// taken in the reduced space and missing in some states of the whole: of these
// only what a question sees is the same.
#include "reference/reduced_space.hpp"

#include <algorithm>
#include <deque>
#include <utility>

namespace btcheck::reference {
namespace {

// The fewest units of time to each state.
std::vector<int> times(const NaiveSpace& space) {
  constexpr int kUnseen = 1 << 30;
  std::vector<int> time(space.states.size(), kUnseen);
  time[0] = 0;
  std::deque<std::size_t> open{0};
  while (!open.empty()) {
    const std::size_t here = open.front();
    open.pop_front();
    for (const NaiveSpace::Step& step : space.steps[here]) {
      const int there = time[here] + (step.edge ? 0 : 1);
      if (there >= time[step.target]) continue;
      time[step.target] = there;
      if (step.edge) {
        open.push_front(step.target);
      } else {
        open.push_back(step.target);
      }
    }
  }
  return time;
}

// One step of a run, on the naive network.
std::string step_flaw(const NaiveNetwork& naive, NaiveState& state, Step step) {
  if (step.edge == kTimeStep) {
    if (!naive.may_wait(state)) return "time may not pass";
    state = naive.waited(state);
    return {};
  }
  const auto enabled = naive.enabled(state);
  if (std::find(enabled.begin(), enabled.end(), step.edge) == enabled.end()) {
    return "edge " + std::to_string(step.edge) + " is not enabled";
  }
  const Network& network = naive.network();
  state = naive.after(state, network.owner_of_edge(step.edge),
                      network.edge(step.edge));
  return {};
}

// The places of a path that lead round to its place `from` again.
Lasso round_trip(const std::vector<RunState>& path, std::size_t from,
                 Step back) {
  const auto start = path.begin() + static_cast<std::ptrdiff_t>(from);
  Lasso run;
  run.prefix.assign(path.begin(), start + 1);
  run.cycle.assign(start + 1, path.end());
  run.cycle.push_back({start->state, back});
  run.closing = run.cycle.front().step;
  return run;
}

}  // namespace

NaiveState unpacked(const CompiledNetwork& system, StateView state) {
  NaiveState naive;
  const Network& network = system.network();
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    naive.values.push_back(
        static_cast<int>(system.value(state, VariableId{v})));
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    naive.clocks.push_back(
        static_cast<int>(system.clock(state, AutomatonId{a})));
  }
  return naive;
}

std::vector<RunState> ReducedSpace::path_to(std::size_t state) const {
  std::vector<RunState> path;
  for (std::size_t at = state;; at = parents[at]) {
    path.push_back({vectors[at], steps[at]});
    if (at == 0) break;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Lasso> ReducedSpace::runs(std::size_t most) const {
  std::vector<Lasso> all;
  std::size_t dead = 0, rounds = 0;
  for (std::size_t i = vectors.size(); i-- > 0;) {
    if (space.dead[i] && dead++ < most) {
      all.push_back({path_to(i), {}, {}});
    }
    for (const NaiveSpace::Step& step : space.steps[i]) {
      const auto path = path_to(i);
      for (std::size_t at = 0; at < path.size() && rounds < most; ++at) {
        if (path[at].state != vectors[step.target]) continue;
        const Step back{step.edge.value_or(kTimeStep),
                        static_cast<std::uint8_t>(step.edge ? 0 : 1),
                        step.progress};
        all.push_back(round_trip(path, at, back));
        ++rounds;
      }
    }
  }
  return all;
}

std::optional<ReducedSpace> reduced_space(const ReducedNetwork& system,
                                          std::size_t most) {
  const CompiledNetwork& network = system.network();
  ReducedSpace reduced;
  std::map<StateVector, std::size_t> numbers;
  const auto number_of = [&](StateView state, std::size_t parent, Step step) {
    StateVector vector(state.begin(), state.end());
    const auto [place, is_new] = numbers.emplace(vector, numbers.size());
    if (is_new) {
      reduced.space.states.push_back(unpacked(network, state));
      reduced.space.dead.push_back(!network.enabled(state).any);
      reduced.vectors.push_back(std::move(vector));
      reduced.parents.push_back(parent);
      reduced.steps.push_back(step);
    }
    return place->second;
  };
  system.initial_states([&](StateView state) { number_of(state, 0, {}); });
  for (std::size_t i = 0; i < reduced.vectors.size(); ++i) {
    if (reduced.vectors.size() > most) return std::nullopt;
    std::vector<NaiveSpace::Step> steps;
    const StateVector from = reduced.vectors[i];
    system.successors(
        from,
        [&](StateView target, Step step) {
          NaiveSpace::Step made{number_of(target, i, step), step.edge,
                                step.progress};
          if (step.edge == kTimeStep) made.edge.reset();
          steps.push_back(made);
        },
        [&](StateView, Step step, StateView) {
          if (step.edge != kTimeStep) reduced.edges.insert(step.edge);
        });
    reduced.space.steps.push_back(std::move(steps));
  }
  return reduced;
}

std::set<std::uint32_t> edges_of(const NaiveSpace& space) {
  std::set<std::uint32_t> edges;
  for (const auto& steps : space.steps) {
    for (const NaiveSpace::Step& step : steps) {
      if (step.edge) edges.insert(*step.edge);
    }
  }
  return edges;
}

Findings findings(const Network& network, const Questions& questions,
                  const NaiveSpace& space, std::set<std::uint32_t> edges) {
  const NaiveNetwork naive(network);
  const std::vector<int> time = times(space);
  Findings found;
  found.edges = std::move(edges);
  for (std::size_t i = 0; i < space.states.size(); ++i) {
    const NaiveState& state = space.states[i];
    const Answers here = answers(questions, state, space.dead[i]);
    const auto [place, is_new] = found.time_to.emplace(here, time[i]);
    if (!is_new) place->second = std::min(place->second, time[i]);
    if (!space.dead[i]) continue;
    found.answers_dead.insert(here);
    if (!naive.is_faulty(state)) found.dead.insert(state);
  }
  return found;
}

std::string difference(const Findings& whole, const Findings& reduced) {
  if (whole.edges != reduced.edges) return "other edges are taken";
  if (whole.dead != reduced.dead) return "other states are dead";
  if (whole.answers_dead != reduced.answers_dead) {
    return "dead states are seen otherwise";
  }
  for (const auto& [answer, time] : whole.time_to) {
    const auto found = reduced.time_to.find(answer);
    if (found == reduced.time_to.end()) return "something is never seen";
    if (found->second != time) return "something is seen at another time";
  }
  return whole.time_to.size() == reduced.time_to.size()
             ? ""
             : "something is seen that is not there";
}

std::string run_flaw(const CompiledNetwork& system, const Lasso& run) {
  const NaiveNetwork naive(system.network());
  NaiveState state = naive.initial();
  if (state != unpacked(system, run.prefix.front().state)) {
    return "it begins elsewhere";
  }
  const auto walk = [&](Step step, const StateVector& to) {
    const std::string wrong = step_flaw(naive, state, step);
    if (!wrong.empty()) return wrong;
    return std::string(state == unpacked(system, to) ? "" : "it goes astray");
  };
  std::string wrong;
  for (std::size_t i = 1; i < run.prefix.size() && wrong.empty(); ++i) {
    wrong = walk(run.prefix[i].step, run.prefix[i].state);
  }
  for (std::size_t i = 0; i < run.cycle.size() && wrong.empty(); ++i) {
    wrong = walk(run.cycle[i].step, run.cycle[i].state);
  }
  if (wrong.empty() && !run.cycle.empty()) {
    wrong = walk(run.closing, run.cycle.front().state);
  }
  return wrong;
}

namespace {

using Pair = std::pair<NaiveState, NaiveState>;

std::string pair_flaw(const Pair& pair, const LiveNetwork& live,
                      const Questions& questions) {
  if (pair.first.clocks != pair.second.clocks) return "a clock differs";
  for (std::size_t v = 0; v < live.forgotten.size(); ++v) {
    if (!live.forgotten[v] && pair.first.values[v] != pair.second.values[v]) {
      return "a variable differs that is not forgotten";
    }
  }
  for (const bool is_dead : {false, true}) {
    if (answers(questions, pair.first, is_dead) !=
        answers(questions, pair.second, is_dead)) {
      return "an observed value is forgotten";
    }
  }
  return {};
}

}  // namespace

Bisimulation walk_both(const Network& network, const LiveNetwork& live,
                       const Questions& questions, std::size_t most) {
  const NaiveNetwork one(network), other(live.network);
  Bisimulation walked;
  std::set<Pair> seen;
  std::set<NaiveState> states, live_states;
  std::vector<const Pair*> open;
  const auto reach = [&](Pair pair) {
    const auto [place, is_new] = seen.insert(std::move(pair));
    if (!is_new) return;
    states.insert(place->first);
    live_states.insert(place->second);
    open.push_back(&*place);
  };
  reach({one.initial(), other.initial()});
  while (!open.empty() && walked.flaw.empty() && seen.size() < most) {
    const Pair& here = *open.back();
    open.pop_back();
    walked.flaw = pair_flaw(here, live, questions);
    const auto enabled = one.enabled(here.first);
    const bool waits = one.may_wait(here.first);
    if (enabled != other.enabled(here.second) ||
        waits != other.may_wait(here.second)) {
      walked.flaw = "other steps are possible";
      break;
    }
    for (const std::uint32_t edge : enabled) {
      reach({one.after(here.first, network.owner_of_edge(edge),
                       network.edge(edge)),
             other.after(here.second, live.network.owner_of_edge(edge),
                         live.network.edge(edge))});
    }
    if (waits) reach({one.waited(here.first), other.waited(here.second)});
  }
  walked.states = states.size();
  walked.live_states = live_states.size();
  return walked;
}

}  // namespace btcheck::reference

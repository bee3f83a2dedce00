// SPDX-License-Identifier: MIT
#include "trace/run/recorded_run.hpp"

#include <algorithm>
#include <cassert>

namespace btcheck {
namespace {

// The step back begins a tick where a root that was idle is ticked in the state
// it leads to.
bool back_begins_tick(const RecordedRun& run) {
  const RecordedState& last = run.states.back();
  const RecordedState& first = run.states[run.loop];
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const bool was_active = is_active(last.phases[n]);
    if (!run.nodes[n].parent && !was_active && is_active(first.phases[n])) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string shown_phase(const RecordedState& state, std::size_t node) {
  if (state.phases[node] == Phase::Unvisited) return {};
  const std::string name(phase_name(state.phases[node]));
  return state.is_stale[node] ? "(" + name + ")" : name;
}

Children children_of(const RecordedRun& run) {
  Children children(run.nodes.size());
  for (std::uint32_t n = 0; n < run.nodes.size(); ++n) {
    if (const auto parent = run.nodes[n].parent) {
      assert(*parent < n);
      children[*parent].push_back(n);
    }
  }
  return children;
}

std::vector<Passing> unrolled(const RecordedRun& run, int passes) {
  assert(!run.states.empty());
  std::vector<Passing> passings;
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    passings.push_back({i, run.states[i].tick});
  }
  if (run.loop == kNoState) return passings;
  const int period = run.states.back().tick - run.states[run.loop].tick +
                     (back_begins_tick(run) ? 1 : 0);
  for (int pass = 1; pass < passes; ++pass) {
    for (std::size_t i = run.loop; i < run.states.size(); ++i) {
      passings.push_back({i, run.states[i].tick + pass * period});
    }
  }
  return passings;
}

std::vector<std::size_t> tick_ends(const RecordedRun& run) {
  assert(!run.states.empty());
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    const bool is_last = i + 1 == run.states.size();
    if (is_last || run.states[i].tick != run.states[i + 1].tick) {
      ends.push_back(i);
    }
  }
  // Before the first tick nothing has been visited.
  if (ends.size() > 1 && run.states[ends.front()].tick == 0) {
    ends.erase(ends.begin());
  }
  return ends;
}

std::size_t shown_state(const RecordedRun& run) {
  assert(!run.states.empty());
  return run.lost != kNoState ? std::min(run.lost, run.states.size() - 1)
                              : run.states.size() - 1;
}

}  // namespace btcheck

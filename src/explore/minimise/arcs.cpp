// SPDX-License-Identifier: MIT
//
// States on one silent cycle are equivalent, and become one; that they are on a
// cycle is then a step of its own that leads back.
#include "explore/minimise/arcs.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <unordered_map>

#include "explore/search/strong_components.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// Labels as numbers from 0 on, in the order in which they are asked for.
class DenseLabels {
 public:
  std::uint32_t of(std::uint32_t label) {
    if (label == last_) return last_number_;
    last_ = label;
    last_number_ = numbers_.try_emplace(label, count_).first->second;
    count_ = std::max(count_, last_number_ + 1);
    return last_number_;
  }
  std::uint32_t fresh() { return count_++; }
  std::uint32_t count() const { return count_; }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_{
      {LabelledGraph::kSilent, 0}};
  std::uint32_t count_ = 1;
  std::uint32_t last_ = LabelledGraph::kSilent;
  std::uint32_t last_number_ = 0;
};

// visit(from, label, to, diverges) for every arc of the collapsed graph; a
// divergence once for each component.
template <class Visit>
void each_collapsed(const LabelledGraph& graph,
                    const std::vector<std::uint32_t>& component,
                    std::uint32_t states, Visit visit) {
  std::vector<bool> diverges(states, false);
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    ask_budget();
    const std::uint32_t from = component[s];
    for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
      const std::uint32_t to = component[arc.target];
      const bool is_loop = arc.label == LabelledGraph::kSilent && from == to;
      if (is_loop && diverges[from]) continue;
      if (is_loop) diverges[from] = true;
      visit(from, arc.label, to, is_loop);
    }
  }
}

template <class Visit>
void each_as_it_is(const LabelledGraph& graph, Visit visit) {
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    ask_budget();
    for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
      visit(s, arc.label, arc.target, false);
    }
  }
}

// From the numbers of things by key, which stand one place behind it, to the
// first place of each key.
void add_up(std::vector<std::uint32_t>& counts) {
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
}

// After each first place has been counted up to the first of the next key.
void step_back(std::vector<std::uint32_t>& first) {
  std::copy_backward(first.begin(), first.end() - 1, first.end());
  first.front() = 0;
}

void turn_round(Arcs& arcs) {
  arcs.first_in.assign(arcs.states + 1, 0);
  for (const std::uint32_t target : arcs.target) ++arcs.first_in[target + 1];
  add_up(arcs.first_in);
  arcs.incoming.resize(arcs.size());
  for (const bool silent : {true, false}) {
    for (std::uint32_t arc = 0; arc < arcs.size(); ++arc) {
      ask_budget();
      if (arcs.is_silent[arc] != silent) continue;
      arcs.incoming[arcs.first_in[arcs.target[arc]]++] = arc;
    }
  }
  step_back(arcs.first_in);
}

template <class Each>
Arcs filled(std::uint32_t states, bool passes_silently, Each each) {
  Arcs made;
  made.states = states;
  made.first_out.assign(states + 1, 0);
  std::size_t count = 0;
  each([&](std::uint32_t from, std::uint32_t, std::uint32_t, bool) {
    ++made.first_out[from + 1];
    ++count;
  });
  assert(count < kNoNumber);
  add_up(made.first_out);
  made.source.resize(count);
  made.target.resize(count);
  made.label.resize(count);
  made.is_silent.resize(count);
  DenseLabels labels;
  const std::uint32_t divergence = labels.fresh();
  each([&](std::uint32_t from, std::uint32_t label, std::uint32_t to,
           bool diverges) {
    const std::uint32_t arc = made.first_out[from]++;
    made.source[arc] = from;
    made.target[arc] = to;
    made.label[arc] = diverges ? divergence : labels.of(label);
    made.is_silent[arc] =
        passes_silently && !diverges && label == LabelledGraph::kSilent;
  });
  step_back(made.first_out);
  made.labels = labels.count();
  turn_round(made);
  return made;
}

}  // namespace

std::vector<std::uint32_t> silent_components(const LabelledGraph& graph) {
  const auto arcs = [&](std::uint32_t state) { return graph.arcs(state); };
  ComponentSearch<decltype(arcs)> search(graph.size(), arcs);
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    ask_budget();
    search.search_from(s, [&](const LabelledGraph::Arc& arc) {
      ask_budget();
      return arc.label == LabelledGraph::kSilent
                 ? arc.target
                 : ComponentSearch<decltype(arcs)>::kOutside;
    });
  }
  return search.take_components();
}

Arcs arcs_of(const LabelledGraph& graph, Equivalence equivalence,
             const std::vector<std::uint32_t>& component) {
  if (equivalence == Equivalence::Strong) {
    return filled(static_cast<std::uint32_t>(graph.size()), false,
                  [&](auto visit) { each_as_it_is(graph, visit); });
  }
  std::uint32_t states = 0;
  for (const std::uint32_t each : component) {
    states = std::max(states, each + 1);
  }
  return filled(states, true, [&](auto visit) {
    each_collapsed(graph, component, states, visit);
  });
}

}  // namespace btcheck

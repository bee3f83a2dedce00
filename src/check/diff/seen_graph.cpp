// SPDX-License-Identifier: MIT
//
// A step of the search may have several events: they become steps of their own,
// and equal rests of steps with equal targets share their states. Where a step
// is a choice, and nothing is seen of its beginning, the choice becomes a
// silent step of its own: what is seen later does not yet tell how it came out.
#include "check/diff/seen_graph.hpp"

#include <algorithm>
#include <map>

#include "explore/minimise/arcs.hpp"
#include "explore/reduce/ample_sets.hpp"
#include "explore/state/step.hpp"
#include "text/budget.hpp"

namespace btcheck {

Reduction exact_reduction(const Network& network) {
  const bool is_alone = !CompiledNetwork(network).has_free_moves() &&
                        AmpleSets(network, Observed(network)).is_sequential();
  return is_alone ? Reduction::Full : Reduction::Live;
}

SeenGraph::SeenGraph(const AnswerGraph& answers,
                     std::span<const std::optional<std::uint32_t>> number_of) {
  using Arc = LabelledGraph::Arc;
  std::vector<Arc> between;  // the only step of each further state
  std::map<Arc, std::uint32_t> known;
  std::vector<Arc> arcs;
  for (std::uint32_t s = 0; s < answers.size(); ++s) {
    ask_budget();
    arcs.clear();
    const auto steps = answers.arcs(s);
    for (std::uint32_t i = 0; i < steps.size(); ++i) {
      std::vector<std::uint32_t> labels;
      const auto events = answers.events(steps[i]);
      for (const NodeEvent& event : events) {
        const auto number = number_of[index(event.node())];
        if (!number) continue;
        labels.push_back(SeenEvent(*number, event.what()).label());
      }
      const bool is_settled_first = steps.size() > 1 &&
                                    steps[i].is_single == 0 &&
                                    (steps[i].begins_with_event == 0 ||
                                     !number_of[index(events.front().node())]);
      const std::uint32_t target = steps[i].target;
      if (answers.ending(target) == Ending::Exception &&
          answers.ending(s) != Ending::Exception) {
        labels.push_back(kThrown.label());
      }
      if (labels.empty() || is_settled_first) {
        labels.insert(labels.begin(), LabelledGraph::kSilent);
      }
      Arc arc{labels.back(), target};
      for (std::size_t k = labels.size() - 1; k-- > 0;) {
        const auto next =
            static_cast<std::uint32_t>(answers.size() + between.size());
        const auto [found, is_new] = known.emplace(arc, next);
        if (is_new) between.push_back(arc);
        arc = {labels[k], found->second};
      }
      arcs.push_back(arc);
      arc_of_.push_back(answers.first_arc(s) + i);
      is_progress_.push_back(steps[i].is_progress != 0);
    }
    graph_.add_state(arcs);
  }
  for (const Arc& arc : between) graph_.add_state({&arc, 1});
}

LabelledGraph SeenGraph::fair() const {
  const std::vector<std::uint32_t> component = silent_components(graph_);
  std::vector<std::uint32_t> number(graph_.size(), kNoNumber);
  std::vector<std::vector<std::uint32_t>> states;  // by number
  for (std::uint32_t s = 0; s < graph_.size(); ++s) {
    std::uint32_t& known = number[component[s]];
    if (known == kNoNumber) {
      known = static_cast<std::uint32_t>(states.size());
      states.emplace_back();
    }
    states[known].push_back(s);
  }
  LabelledGraph made;
  std::vector<LabelledGraph::Arc> arcs;
  const LabelledGraph::Arc* const begin = graph_.arcs(0).data();
  for (std::uint32_t n = 0; n < states.size(); ++n) {
    ask_budget();
    arcs.clear();
    for (const std::uint32_t s : states[n]) {
      for (const LabelledGraph::Arc& arc : graph_.arcs(s)) {
        const std::uint32_t target = number[component[arc.target]];
        const auto place = static_cast<std::size_t>(&arc - begin);
        const bool is_idling = arc.label == LabelledGraph::kSilent &&
                               target == n && place < is_progress_.size() &&
                               !is_progress_[place];
        if (!is_idling) arcs.push_back({arc.label, target});
      }
    }
    std::ranges::sort(arcs);
    arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
    made.add_state(arcs);
  }
  return made;
}

std::optional<std::vector<std::uint32_t>> SeenGraph::run_of(
    std::span<const SeenEvent> events) const {
  // Breadth first over states and how many events are done.
  struct Reached {
    std::uint32_t state = 0;
    std::uint32_t done = 0;
    std::uint32_t from = 0;         // an index into these
    std::uint32_t arc = kNoNumber;  // of the answers
  };
  std::vector<Reached> reached = {{}};
  std::vector<std::vector<bool>> seen(events.size() + 1);
  for (auto& each : seen) each.resize(graph_.size());
  seen[0][0] = true;
  const LabelledGraph::Arc* const begin = graph_.arcs(0).data();
  std::uint32_t last = kNoNumber;
  if (events.empty()) last = 0;
  for (std::uint32_t i = 0; i < reached.size() && last == kNoNumber; ++i) {
    ask_budget();
    const Reached at = reached[i];
    for (const LabelledGraph::Arc& arc : graph_.arcs(at.state)) {
      const bool is_seen = arc.label != LabelledGraph::kSilent;
      if (is_seen && arc.label != events[at.done].label()) continue;
      const std::uint32_t done = at.done + (is_seen ? 1 : 0);
      if (seen[done][arc.target]) continue;
      seen[done][arc.target] = true;
      const auto place = static_cast<std::size_t>(&arc - begin);
      reached.push_back({arc.target, done, i,
                         place < arc_of_.size() ? arc_of_[place] : kNoNumber});
      if (done < events.size()) continue;
      last = static_cast<std::uint32_t>(reached.size() - 1);
      break;
    }
  }
  if (last == kNoNumber) return std::nullopt;
  std::vector<std::uint32_t> arcs;
  for (; last != 0; last = reached[last].from) {
    if (reached[last].arc != kNoNumber) arcs.push_back(reached[last].arc);
  }
  std::ranges::reverse(arcs);
  return arcs;
}

}  // namespace btcheck

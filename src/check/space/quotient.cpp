// SPDX-License-Identifier: MIT
#include "check/space/quotient.hpp"

#include <cstdint>
#include <unordered_map>
#include <utility>

#include "explore/search/reachability.hpp"
#include "explore/state/spent.hpp"
#include "explore/state/step.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// The labels as numbers: that of an edge is looked up once.
class LabelNumbers {
 public:
  LabelNumbers(const Network& network, SeenAnswers seen)
      : labels_(network, seen), number_(network.edge_count() + 1, kUnknown) {}

  std::uint32_t of(std::uint32_t edge) {
    std::uint32_t& number = edge == kTimeStep ? number_.back() : number_[edge];
    if (number == kUnknown) number = number_of(labels_.of(edge));
    return number;
  }
  std::vector<std::string> take_names() { return std::move(names_); }

 private:
  static constexpr std::uint32_t kUnknown = 0xffffffff;

  std::uint32_t number_of(const std::string& label) {
    if (label.empty()) return LabelledGraph::kSilent;
    const auto next = static_cast<std::uint32_t>(names_.size());
    const auto [at, is_new] = known_.try_emplace(label, next);
    if (is_new) names_.push_back(label);
    return at->second;
  }

  StepLabels labels_;
  std::vector<std::uint32_t> number_;  // by edge; then time
  std::unordered_map<std::string, std::uint32_t> known_;
  std::vector<std::string> names_{std::string(kHiddenLabel)};
};

// A breadth-first search expands states in the order of their numbers.
struct GraphMaker : public ReachabilityVisitor {
  explicit GraphMaker(LabelNumbers& numbers) : labels(numbers) {}

  void stepped(StateId from, Step step, StateId to) {
    if (step.edge == kTimeStep && from == to) return;
    arcs.push_back({labels.of(step.edge), index(to)});
  }
  GoOn expanded(StateId, StateView, bool) {
    graph.add_state(arcs);
    arcs.clear();
    return GoOn::Yes;
  }
  std::size_t bytes() const { return graph.bytes(); }

  LabelNumbers& labels;
  LabelledGraph graph;
  std::vector<LabelledGraph::Arc> arcs;
};

// What minimising numbers with 32 bits.
constexpr std::uint64_t kMostArcs = 0xfffffff0;

}  // namespace

SpaceQuotient quotient_of_space(const Network& network, Equivalence equivalence,
                                SeenAnswers seen, const Limits& limits) {
  SpaceQuotient made;
  made.equivalence = equivalence;
  made.seen = seen;
  LabelNumbers labels(network, seen);
  GraphMaker maker(labels);
  {
    // Its states are gone when the blocks are looked for.
    const CompiledNetwork system(network);
    BreadthFirst search(system, limits);
    const ReachabilityResult found = search.run(maker);
    made.whole = found.progress;
    made.stopped = found.stopped;
  }
  if (made.stopped == StopReason::None && maker.graph.arc_count() > kMostArcs) {
    made.stopped = StopReason::Memory;
  }
  if (made.stopped != StopReason::None) return made;
  try {
    const Stage stage("states were compared");
    made.graph = quotient(
        maker.graph, coarsest_partition(maker.graph, equivalence), equivalence);
    made.labels = labels.take_names();
  } catch (const BudgetSpent& spent) {
    made.stopped = stop_reason(spent.spent());
  }
  return made;
}

}  // namespace btcheck

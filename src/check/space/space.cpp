// SPDX-License-Identifier: MIT
//
// The figures of TINA's sift: classes (our states), markings, transitions.
// Aldebaran's format is that of CADP (Garavel, Lang, Mateescu and Serwe, STTT
// 2013). Equal input gives an equal graph: the sequential breadth-first search
// numbers states the same way each time.
#include "check/space/space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "check/search/searched_network.hpp"
#include "explore/halves/cut.hpp"
#include "explore/halves/interned_system.hpp"
#include "explore/halves/split_network.hpp"
#include "explore/large/disk_breadth_first.hpp"
#include "explore/large/markings.hpp"
#include "explore/large/parallel_breadth_first.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

// Counts the states that differ in more than their clocks. A state whose
// clocks are all 0 is its own marking; only the markings of the others, which
// are few, are kept.
class Markings : public ReachabilityVisitor {
 public:
  explicit Markings(const CompiledNetwork& system)
      : system_(system),
        cleared_(system.word_count()),
        words_(system.word_count()) {}

  GoOn expanded(StateId, StateView state, bool is_dead) {
    dead_ += is_dead;
    std::ranges::copy(state, words_.begin());
    system_.clear_clocks(words_);
    if (std::equal(state.begin(), state.end(), words_.begin())) {
      ++clockless_;
    } else {
      cleared_.insert(words_);
    }
    return GoOn::Yes;
  }
  std::size_t bytes() const { return cleared_.bytes(); }
  std::uint64_t dead() const { return dead_; }

  // To be asked when the search is over.
  std::uint64_t count(const StateStore& store) {
    std::uint64_t markings = clockless_;
    for (std::uint32_t i = 0; i < cleared_.size(); ++i) {
      cleared_.load(StateId{i}, words_);
      markings += !store.find(words_).has_value();
    }
    return markings;
  }

 private:
  const CompiledNetwork& system_;
  StateStore cleared_;
  StateVector words_;
  std::uint64_t clockless_ = 0;
  std::uint64_t dead_ = 0;
};

template <class Counted>
SpaceReport taken_from(const ParallelResult& result, const Counted& markings) {
  SpaceReport report;
  report.result = result.reachability;
  report.dead_states = markings.dead();
  report.largest_frontier = result.largest_frontier;
  report.bytes = result.peak_bytes;
  report.bytes_on_disk = result.peak_bytes_on_disk;
  return report;
}

template <PairSet Set, PairSystem System>
SpaceReport measured_in(System& system, const SpaceOptions& options,
                        const Limits& limits) {
  PairMarkings<System, Set> markings(system);
  ParallelBreadthFirst<System, Set> search(system, limits, options.threads);
  SpaceReport report = taken_from(search.run(markings), markings);
  report.markings =
      markings.count([&](Word pair) { return search.is_visited(pair); });
  return report;
}

template <PairSystem System>
SpaceReport measured_on_disk(System& system, const SpaceOptions& options,
                             const Limits& limits) {
  const Scratch scratch = options.scratch.within(limits.max_bytes);
  DiskMarkings<System> markings(system, scratch,
                                scratch.words_within(limits.max_bytes / 16));
  DiskBreadthFirst<System> search(system, limits, options.threads, scratch);
  SpaceReport report = taken_from(search.run(markings), markings);
  try {
    report.markings = markings.count(search.visited());
  } catch (const ScratchFault&) {
    report.result.stopped = StopReason::Disk;
    report.result.is_complete = false;
  }
  return report;
}

template <PairSystem System>
SpaceReport measured_in_parallel(System& system, const SpaceOptions& options,
                                 const Limits& limits) {
  const SpaceReport report =
      options.store == StateSetKind::Exact
          ? measured_in<ExactPairSet>(system, options, limits)
          : measured_in<CompressedPairSet>(system, options, limits);
  return report.result.stopped == StopReason::Memory &&
                 !options.scratch.folder.empty()
             ? measured_on_disk(system, options, limits)
             : report;
}

// With nothing to be observed: as far as any search is reduced.
SpaceReport measure_reduced(const Network& network, const SpaceOptions& options,
                            const Limits& limits) {
  const CompiledNetwork system(network);
  const SearchedNetwork searched(system, Observed(network), options.reduce);
  const ReducedNetwork& reduced = searched.system();
  if (options.search == SearchOrder::DepthFirst) {
    DepthFirst search(reduced, limits);
    Markings markings(reduced.network());
    SpaceReport report;
    report.vector_bits = reduced.network().layout().bits;
    report.result = search.run(markings);
    report.markings = markings.count(search.store());
    report.dead_states = markings.dead();
    report.bytes = report.result.progress.bytes - markings.bytes();
    return report;
  }
  InternedSystem interned(reduced, reduced.network());
  SpaceReport report = measured_in_parallel(interned, options, limits);
  report.vector_bits = reduced.network().layout().bits;
  return report;
}

struct GraphStep {
  std::uint32_t from = 0;
  Step step;
  std::uint32_t to = 0;
};

// Keeps every step but the idle ones, as long as the states are few.
struct Collector : public ReachabilityVisitor {
  explicit Collector(std::uint64_t limit) : most(limit) {}

  void stepped(StateId from, Step step, StateId to) {
    is_too_large |= index(to) >= most;
    if (step.edge == kTimeStep && from == to) return;
    steps.push_back({index(from), step, index(to)});
  }
  GoOn expanded(StateId, StateView, bool) {
    return is_too_large ? GoOn::No : GoOn::Yes;
  }
  std::size_t bytes() const { return steps.capacity() * sizeof(GraphStep); }

  const std::uint64_t most;
  bool is_too_large = false;
  std::vector<GraphStep> steps;
};

// Within double quotes, on one line.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + '"';
}

// What the edge assigns to state variables and its label does not tell, from
// which the values along a path follow.
std::string assignments_of(const Network& network, const Edge& edge) {
  std::string text;
  for (const Assignment& update : edge.updates) {
    const Variable& variable = network.variable(update.variable);
    if (variable.role != VariableRole::State) continue;
    const std::string told =
        fmt::format("{} := {}", variable.name, assigned_text(network, update));
    if (told != edge.label) text += ", " + told;
  }
  return text;
}

std::string label_of(const Network& network, std::uint32_t number) {
  if (number == kTimeStep) return "time";
  const Automaton& owner = network.owner_of_edge(number);
  const Edge& edge = network.edge(number);
  const std::string text =
      fmt::format("{}.{} -> {}", owner.name, owner.source(edge).name,
                  owner.target(edge).name);
  return text + (edge.label.empty() ? "" : ", " + edge.label) +
         assignments_of(network, edge);
}

// The steps of a graph with their labels; that of a reduction names each of the
// single steps that it stands for.
class GraphLabels {
 public:
  GraphLabels(const Network& network, const ReducedNetwork& system,
              const StateStore& store)
      : network_(network),
        system_(system),
        store_(store),
        from_(system.word_count()),
        to_(system.word_count()) {}

  std::string of(const GraphStep& step) {
    if (!system_.is_reduced()) return label_of(network_, step.step.edge);
    store_.load(StateId{step.from}, from_);
    store_.load(StateId{step.to}, to_);
    std::string text;
    for (const RunState& single : system_.single_steps(from_, step.step, to_)) {
      text += text.empty() ? "" : "; ";
      text += label_of(network_, single.step.edge);
    }
    return text;
  }

 private:
  const Network& network_;
  const ReducedNetwork& system_;
  const StateStore& store_;
  StateVector from_;
  StateVector to_;
};

std::string aldebaran_text(GraphLabels& labels,
                           const std::vector<GraphStep>& steps,
                           std::uint64_t states) {
  std::string text = fmt::format("des (0, {}, {})\n", steps.size(), states);
  for (const GraphStep& step : steps) {
    text += fmt::format("({}, {}, {})\n", step.from, quoted(labels.of(step)),
                        step.to);
  }
  return text;
}

std::string drawn_text(GraphLabels& labels, const std::vector<GraphStep>& steps,
                       std::uint64_t states) {
  std::vector<bool> is_dead(states, true);
  for (const GraphStep& step : steps) is_dead[step.from] = false;
  std::string text =
      "digraph \"states\" {\n"
      "  node [shape=circle, fontname=\"Helvetica\", fontsize=10];\n"
      "  edge [fontname=\"Helvetica\", fontsize=8];\n"
      "  0 [penwidth=2];\n";
  for (std::uint64_t state = 0; state < states; ++state) {
    if (is_dead[state]) text += fmt::format("  {} [shape=box];\n", state);
  }
  for (const GraphStep& step : steps) {
    text += fmt::format("  {} -> {} [label={}];\n", step.from, step.to,
                        quoted(labels.of(step)));
  }
  return text + "}\n";
}

}  // namespace

SpaceReport measure_space(const Network& network, const SpaceOptions& options,
                          const Limits& limits) {
  if (options.search == SearchOrder::DepthFirst ||
      options.reduce != Reduction::None) {
    return measure_reduced(network, options, limits);
  }
  const std::size_t cut = best_cut(CompiledNetwork(network), options.threads);
  const CompiledNetwork system(network, StateLayout(network, cut));
  SplitNetwork split(system);
  SpaceReport report = measured_in_parallel(split, options, limits);
  report.vector_bits = system.layout().bits;
  return report;
}

Result<std::string> space_graph(const Network& network, GraphFormat format,
                                const Limits& limits, std::string_view file,
                                Reduction reduce) {
  const bool is_drawn = format == GraphFormat::Dot;
  const CompiledNetwork system(network);
  const SearchedNetwork searched(system, Observed(network), reduce);
  const ReducedNetwork& reduced = searched.system();
  Collector collector(is_drawn ? 2'000 : 100'000);
  BreadthFirst search(reduced, limits);
  const ReachabilityResult found = search.run(collector);
  if (found.is_complete && !collector.is_too_large) {
    const auto text = is_drawn ? drawn_text : aldebaran_text;
    GraphLabels labels(network, reduced, search.store());
    return {text(labels, collector.steps, found.progress.states), {}};
  }
  Diagnostic refusal;
  refusal.code = "BT0007";
  refusal.file = file;
  if (!collector.is_too_large) {
    refusal.message = "a limit was reached before all states were found";
    refusal.help =
        fmt::format("give {}, {} or {} more", word(Choice::MaxStates),
                    word(Choice::Memory), word(Choice::Timeout));
  } else if (is_drawn) {
    refusal.message =
        "the state space has more than 2,000 states, too many for a drawing";
    refusal.help = word(Choice::Export, "aut") + " takes up to 100,000 states";
  } else {
    refusal.message =
        "the state space has more than 100,000 states, too many for a text of "
        "each step";
  }
  return {std::nullopt, {std::move(refusal)}};
}

}  // namespace btcheck

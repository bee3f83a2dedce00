// SPDX-License-Identifier: MIT
//
// Aldebaran's format is that of CADP (Garavel, Lang, Mateescu and Serwe, STTT
// 2013). Its first line has the counts, so the search comes first; the steps
// are then made again rather than kept, which takes no memory and about as long
// as the search. Equal input gives an equal graph: the sequential breadth-first
// search numbers states the same way each time.
#include "check/space/graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "check/search/searched_network.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

// Which states are dead, as long as there are few enough to be drawn.
struct DeadStates : public ReachabilityVisitor {
  explicit DeadStates(std::uint64_t limit) : most(limit) {}

  void stepped(StateId, Step, StateId to) { is_too_large |= index(to) >= most; }
  GoOn expanded(StateId, StateView, bool dead) {
    if (most == kMostDrawn) is_dead.push_back(dead);
    return is_too_large ? GoOn::No : GoOn::Yes;
  }

  const std::uint64_t most;
  bool is_too_large = false;
  std::vector<bool> is_dead;
};

// Adds a text within double quotes, on one line.
void add_quoted(std::string_view text, std::string& to) {
  to += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') to += '\\';
    to += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  to += '"';
}

// The lines of a graph, handed on in large pieces.
class GraphLines {
 public:
  GraphLines(GraphFormat format, const GraphSink& sink)
      : is_drawn_(format == GraphFormat::Dot), sink_(sink) {}

  // `is_dead` by state, of a drawing.
  void begin(std::uint64_t steps, std::uint64_t states,
             const std::vector<bool>& is_dead) {
    if (!is_drawn_) {
      text_ += fmt::format("des (0, {}, {})\n", steps, states);
      return;
    }
    text_ +=
        "digraph \"states\" {\n"
        "  node [shape=circle, fontname=\"Helvetica\", fontsize=10];\n"
        "  edge [fontname=\"Helvetica\", fontsize=8];\n"
        "  0 [penwidth=2];\n";
    for (std::size_t state = 0; state < is_dead.size(); ++state) {
      if (is_dead[state]) text_ += fmt::format("  {} [shape=box];\n", state);
    }
  }
  void step(std::uint32_t from, std::string_view label, std::uint32_t to) {
    const auto end = std::back_inserter(text_);
    if (is_drawn_) {
      fmt::format_to(end, "  {} -> {} [label=", from, to);
      add_quoted(label, text_);
      text_ += "];\n";
    } else {
      fmt::format_to(end, "({}, ", from);
      add_quoted(label, text_);
      fmt::format_to(end, ", {})\n", to);
    }
    if (text_.size() >= kPiece) hand_on();
  }
  void end() {
    if (is_drawn_) text_ += "}\n";
    hand_on();
  }
  // Nobody takes any more.
  bool is_closed() const { return is_closed_; }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 16;

  void hand_on() {
    is_closed_ = is_closed_ || !sink_(text_);
    text_.clear();
  }

  bool is_drawn_;
  bool is_closed_ = false;
  const GraphSink& sink_;
  std::string text_;
};

// Writes the steps of stored states, which are made again.
class StoredSteps {
 public:
  StoredSteps(const ReducedNetwork& system, const StateStore& store,
              StepLabels& labels)
      : system_(system),
        store_(store),
        labels_(labels),
        from_(system.word_count()),
        to_(system.word_count()) {}

  void write(std::uint32_t state, GraphLines& lines) {
    store_.load(StateId{state}, from_);
    system_.successors(from_, [&](StateView target, Step step, auto&&...) {
      const std::uint32_t to = index(store_.find(target).value());
      if (step.edge == kTimeStep && to == state) return;
      lines.step(state, label_of(step, target), to);
    });
  }

 private:
  // That of a reduction names each of the single steps that it stands for.
  std::string_view label_of(Step step, StateView target) {
    if (!system_.is_reduced()) {
      const std::string& label = labels_.of(step.edge);
      return label.empty() ? kHiddenLabel : label;
    }
    std::ranges::copy(target, to_.begin());
    joined_.clear();
    for (const RunState& single : system_.single_steps(from_, step, to_)) {
      joined_ += joined_.empty() ? "" : "; ";
      joined_ += labels_.of(single.step.edge);
    }
    return joined_;
  }

  const ReducedNetwork& system_;
  const StateStore& store_;
  StepLabels& labels_;
  StateVector from_;
  StateVector to_;
  std::string joined_;
};

Diagnostic refusal_of(std::string_view file, std::string message,
                      std::string help) {
  Diagnostic refusal;
  refusal.code = "BT0007";
  refusal.file = file;
  refusal.message = std::move(message);
  refusal.help = std::move(help);
  return refusal;
}

Diagnostic stopped_while(std::string_view file, std::string_view what) {
  return refusal_of(
      file, fmt::format("a limit was reached before all {}", what),
      fmt::format("give {}, {} or {} more", word(Choice::MaxStates),
                  word(Choice::Memory), word(Choice::Timeout)));
}

Diagnostic too_large_to_draw(std::string_view file, std::string_view what) {
  return refusal_of(
      file,
      fmt::format("the {} has more than 2,000 states, too many for a drawing",
                  what),
      word(Choice::Export, "aut") + " takes any number");
}

}  // namespace

std::vector<Diagnostic> write_space_graph(const Network& network,
                                          const GraphOptions& options,
                                          const Limits& limits,
                                          std::string_view file,
                                          const GraphSink& sink) {
  const CompiledNetwork system(network);
  const SearchedNetwork searched(system, Observed(network), options.reduce);
  const ReducedNetwork& reduced = searched.system();
  DeadStates dead(options.format == GraphFormat::Dot ? kMostDrawn : UINT64_MAX);
  BreadthFirst search(reduced, limits);
  const ReachabilityResult found = search.run(dead);
  if (dead.is_too_large) return {too_large_to_draw(file, "state space")};
  if (!found.is_complete) return {stopped_while(file, "states were found")};

  StepLabels labels(network, options.seen);
  StoredSteps steps(reduced, search.store(), labels);
  GraphLines lines(options.format, sink);
  lines.begin(found.progress.transitions, found.progress.states, dead.is_dead);
  for (std::uint32_t s = 0; s < found.progress.states && !lines.is_closed();
       ++s) {
    if (s % kPollInterval == 0 && limits.monitor != nullptr &&
        limits.monitor->observe(found.progress) != StopReason::None) {
      return {stopped_while(file, "steps were written")};
    }
    steps.write(s, lines);
  }
  lines.end();
  return {};
}

std::vector<Diagnostic> write_quotient(const SpaceQuotient& quotient,
                                       GraphFormat format,
                                       std::string_view file,
                                       const GraphSink& sink) {
  if (quotient.stopped != StopReason::None) {
    return {stopped_while(file, "states were found")};
  }
  const LabelledGraph& graph = quotient.graph;
  std::vector<bool> is_dead;
  if (format == GraphFormat::Dot) {
    if (graph.size() > kMostDrawn) return {too_large_to_draw(file, "quotient")};
    for (std::uint32_t s = 0; s < graph.size(); ++s) {
      is_dead.push_back(graph.arcs(s).empty());
    }
  }
  GraphLines lines(format, sink);
  lines.begin(graph.arc_count(), graph.size(), is_dead);
  for (std::uint32_t s = 0; s < graph.size() && !lines.is_closed(); ++s) {
    ask_budget();
    for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
      lines.step(s, quotient.labels[arc.label], arc.target);
    }
  }
  lines.end();
  return {};
}

}  // namespace btcheck

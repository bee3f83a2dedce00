// SPDX-License-Identifier: MIT
//
// Small state spaces as graphs for other programs.
//
// The sequential breadth-first search numbers states the same way each time, so
// equal input gives an equal text. The text is made when all is known: a space
// that turns out to be too large leaves nothing behind. Aldebaran's format is
// that of CADP (Garavel, Lang, Mateescu and Serwe, STTT 2013).
#include "check/space/space_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"

namespace btcheck {
namespace {

struct GraphStep {
  std::uint32_t from = 0;
  std::uint32_t edge = kTimeStep;
  std::uint32_t to = 0;
};

// Keeps every step but the idle ones, as long as the states are few.
class Collector : public ReachabilityVisitor {
 public:
  explicit Collector(std::uint64_t most) : most_(most) {}

  void stepped(StateId from, Step step, StateId to) {
    is_too_large_ |= index(to) >= most_;
    if (step.edge == kTimeStep && from == to) return;
    steps_.push_back({index(from), step.edge, index(to)});
  }
  GoOn expanded(StateId, StateView, bool) {
    return is_too_large_ ? GoOn::No : GoOn::Yes;
  }
  std::size_t bytes() const { return steps_.capacity() * sizeof(GraphStep); }

  bool is_too_large() const { return is_too_large_; }
  const std::vector<GraphStep>& steps() const { return steps_; }

 private:
  std::uint64_t most_;
  bool is_too_large_ = false;
  std::vector<GraphStep> steps_;
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

std::string label_of(const Network& network, std::uint32_t number) {
  if (number == kTimeStep) return "time";
  const Automaton& owner = network.owner_of_edge(number);
  const Edge& edge = network.edge(number);
  const std::string text =
      fmt::format("{}.{} -> {}", owner.name, owner.source(edge).name,
                  owner.target(edge).name);
  return edge.label.empty() ? text : text + ", " + edge.label;
}

std::string aldebaran_text(const Network& network,
                           const std::vector<GraphStep>& steps,
                           std::uint64_t states) {
  std::string text = fmt::format("des (0, {}, {})\n", steps.size(), states);
  for (const GraphStep& step : steps) {
    text += fmt::format("({}, {}, {})\n", step.from,
                        quoted(label_of(network, step.edge)), step.to);
  }
  return text;
}

std::string dot_text(const Network& network,
                     const std::vector<GraphStep>& steps,
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
                        quoted(label_of(network, step.edge)));
  }
  return text + "}\n";
}

std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

Diagnostic refusal(std::string_view file, std::string message,
                   std::string help) {
  Diagnostic finding;
  finding.code = "BT0007";
  finding.message = std::move(message);
  finding.file = file;
  finding.help = std::move(help);
  return finding;
}

}  // namespace

std::uint64_t most_states(GraphFormat format) {
  return format == GraphFormat::Dot ? 2'000 : 100'000;
}

Result<std::string> space_graph(const Network& network, GraphFormat format,
                                const Limits& limits, std::string_view file) {
  const bool is_drawn = format == GraphFormat::Dot;
  const CompiledNetwork system(network);
  Collector collector(most_states(format));
  const ReachabilityResult found = BreadthFirst(system, limits).run(collector);
  Result<std::string> result;
  if (collector.is_too_large()) {
    result.diagnostics.push_back(
        refusal(file,
                fmt::format("the state space has more than {} states, too many "
                            "for {}",
                            with_commas(most_states(format)),
                            is_drawn ? "a drawing" : "a text of each step"),
                is_drawn ? "--export aut takes up to 100,000 states" : ""));
  } else if (!found.is_complete) {
    result.diagnostics.push_back(
        refusal(file, "a limit was reached before all states were found",
                "give --max-states, --memory or --timeout more"));
  } else {
    result.value =
        is_drawn
            ? dot_text(network, collector.steps(), found.progress.states)
            : aldebaran_text(network, collector.steps(), found.progress.states);
  }
  return result;
}

}  // namespace btcheck

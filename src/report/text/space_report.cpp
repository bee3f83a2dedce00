// SPDX-License-Identifier: MIT
//
// The table has the order of TINA's sift: classes, markings, transitions. The
// advice changes nothing of the mission.
#include "report/text/space_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/tree/node_types.hpp"
#include "report/text/report.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

// One line of the table.
std::string row(std::string_view name, const std::string& figure,
                std::string_view unit = "") {
  return fmt::format("  {:<17} {:>15}{}\n", name, figure, unit);
}

std::string advice_for(const Node& node) {
  if (node.type == NodeType::RateController) {
    return "its timer counts ticks: raise :hz, or scale all times down";
  }
  if (node.duration && node.duration->max > 0) {
    return "count in larger units, or give it a fixed :duration";
  }
  if (node.type == NodeType::Action && node.contract.may_run) {
    return "it may run for any number of ticks: :SF if it never runs";
  }
  if (node.type == NodeType::Action) {
    return "defaction … :returns, if some answer is impossible";
  }
  if (node.type == NodeType::Condition) {
    return "defcondition … :returns, if some answer is impossible";
  }
  if (node.type == NodeType::Repeat || node.type == NodeType::Recovery ||
      node.type == NodeType::RetryUntilSuccessful) {
    return "it counts its rounds: two often show what ten would";
  }
  if (info_of(node.type).beside == Beside::Counted) {
    return fmt::format("its children interleave; {} explores one order",
                       word(Choice::Reduce, "full"));
  }
  return "it remembers where it was and what it answered";
}

std::string advice_for(const BehaviorTree& tree, StateVariableId id) {
  const StateVariable& variable = tree.variable(id);
  if (moves_freely(tree, id)) {
    return "it moves at any instant: :moves sampled, if only the tree looks";
  }
  return variable.is_enumeration() ? "merge values that no node tells apart"
                                   : "narrow :min and :max";
}

std::string part_name(const BehaviorTree& tree, const Contribution& part) {
  if (part.variable) return tree.variable(*part.variable).name;
  return fmt::format("{} ({})", typed_name(tree.node(*part.node)),
                     line_of(tree, *part.node));
}

// Below the figures of the whole.
std::string quotient_text(const SpaceQuotient& quotient,
                          const SearchProgress& whole) {
  constexpr std::array<std::string_view, 3> kSeen = {
      "the root's answers", "the leaves' answers", "each node's answers"};
  std::string text =
      fmt::format("Modulo {}; seen: {}, time\n",
                  quotient.equivalence == Equivalence::Strong
                      ? "strong bisimilarity"
                      : "branching bisimilarity with divergence",
                  kSeen[static_cast<std::size_t>(quotient.seen)]);
  if (quotient.stopped != StopReason::None) {
    return text + fmt::format("UNDECIDED  not minimised, {}\n",
                              stop_text(quotient.stopped, quotient.whole));
  }
  const LabelledGraph& graph = quotient.graph;
  return text +
         row("states", grouped(graph.size()),
             fmt::format(" of {}", grouped(whole.states))) +
         row("transitions", grouped(graph.arc_count()),
             fmt::format(" of {}", grouped(whole.transitions))) +
         row("labels seen", grouped(quotient.labels.size() - 1));
}

}  // namespace

std::string_view seen_word(SeenAnswers seen) {
  constexpr std::array<std::string_view, 3> kWords = {"root", "leaves", "all"};
  return kWords[static_cast<std::size_t>(seen)];
}

std::string_view reduction_asked(const SpaceContext& context) {
  if (context.modulo) {
    return *context.modulo == Equivalence::Strong ? "strong" : "bisimulation";
  }
  return reduction_word(context.options.reduce);
}

std::string_view reduction_word(Reduction reduction) {
  constexpr std::array<std::string_view, 3> kWords = {"none", "live", "full"};
  return kWords[static_cast<std::size_t>(reduction)];
}

double per(std::uint64_t count, double unit) {
  return static_cast<double>(count) / std::max(unit, 1e-9);
}

double bytes_per_state(const SpaceReport& report) {
  return per(report.bytes, static_cast<double>(report.result.progress.states));
}

std::string space_text(const SpaceReport& report, const SpaceContext& context) {
  const SearchProgress& progress = report.result.progress;
  std::string text = fmt::format(
      "{}: {} automata; profile {}, tick {}, reduce {}\n", context.tree,
      context.network.automata.size(), profile_name(context.network.profile),
      tick_name(context.network.ticks), reduction_asked(context));
  text += row("states", grouped(progress.states));
  text += row("markings", grouped(report.markings));
  text += row("transitions", grouped(progress.transitions));
  text += row("dead states", grouped(report.dead_states));
  text += row("depth", grouped(progress.depth));
  if (context.options.search == SearchOrder::BreadthFirst) {
    text += row("largest frontier", grouped(report.largest_frontier));
    text += row("threads", grouped(context.options.threads));
  }
  text += row("state vector", grouped(report.vector_bits), " bits");
  text += row("memory", fmt::format("{:.1f}", bytes_per_state(report)),
              " bytes per state");
  if (report.bytes_on_disk > 0) {
    text += row("on disk", grouped(report.bytes_on_disk >> 20), " MB");
  }
  text += row("peak of process", grouped(context.peak_bytes >> 20), " MB");
  text += row("time", fmt::format("{:.2f}", context.seconds),
              fmt::format(" s, {:.2f} M states/s, {:.2f} M transitions/s",
                          per(progress.states, context.seconds) / 1e6,
                          per(progress.transitions, context.seconds) / 1e6));
  if (!report.result.is_complete) {
    text += fmt::format("UNDECIDED  not all states, {}\n",
                        stop_text(report.result.stopped, progress));
  }
  if (context.quotient != nullptr) {
    text += quotient_text(*context.quotient, progress);
  }
  return text;
}

std::string contribution_text(const BehaviorTree& tree,
                              std::span<const Contribution> parts) {
  constexpr std::size_t kMostShown = 6;
  constexpr double kLeastShown = 1.3;
  std::string text;
  for (const Contribution& part :
       parts.first(std::min(parts.size(), kMostShown))) {
    if (part.factor < kLeastShown) break;
    text += fmt::format("  x {:>6.1f}  {}\n             {}\n", part.factor,
                        part_name(tree, part),
                        part.variable ? advice_for(tree, *part.variable)
                                      : advice_for(tree.node(*part.node)));
  }
  if (text.empty()) return text;
  return "What multiplies the states, and what would help\n" + text;
}

}  // namespace btcheck

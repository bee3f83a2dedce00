// SPDX-License-Identifier: MIT
#include "model/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "model/automata/regions.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

std::int64_t values_of(const StateVariable& variable) {
  return std::int64_t{variable.max} - variable.min + 1;
}

// The numbers of more values that a SetSV writes, or that move by themselves,
// ascending.
std::vector<StateVariableId> large_numbers(const BehaviorTree& tree,
                                           std::int64_t most) {
  std::vector<StateVariableId> large;
  for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
    const StateVariable& variable = tree.variables[v];
    if (variable.is_enumeration() || values_of(variable) <= most) continue;
    const StateVariableId number{v};
    const bool is_set = std::ranges::any_of(tree.nodes, [&](const Node& node) {
      return node.type == NodeType::SetSV && node.variable == number;
    });
    if (is_set || moves_freely(tree, number)) large.push_back(number);
  }
  return large;
}

SampledValues first_values(const BehaviorTree& tree,
                           std::span<const StateVariableId> numbers) {
  SampledValues samples(tree.variables.size());
  for (const StateVariableId number : numbers) {
    samples[index(number)] = {tree.variable(number).initial};
  }
  return samples;
}

// At the first SetSV of each such variable, else where it is declared.
template <class Help>
std::vector<Diagnostic> refusals(const BehaviorTree& tree,
                                 const SourceText& source,
                                 std::span<const StateVariableId> numbers,
                                 Help help) {
  std::vector<Diagnostic> found;
  for (const StateVariableId number : numbers) {
    const StateVariable& variable = tree.variable(number);
    const auto at = std::ranges::find_if(tree.nodes, [&](const Node& node) {
      return node.type == NodeType::SetSV && node.variable == number;
    });
    const bool is_set = at != tree.nodes.end();
    found.push_back(source.diagnostic(
        Severity::Error, "BT1008", is_set ? at->span : variable.span,
        fmt::format("`{}` has too many values to {} any", variable.name,
                    is_set ? "be set to" : "move to"),
        fmt::format("{} values, of which at most {} can be told apart",
                    values_of(variable), kMostSampled),
        help(number)));
  }
  return found;
}

std::string reason_of(const Network& network, const Regions& regions,
                      StateVariableId number) {
  const auto found =
      std::ranges::find(regions.unsplit, number, &UnsplitNumber::variable);
  if (found == regions.unsplit.end() || !found->beside) {
    return "comparisons and assignments tell too many values apart: give it a "
           "smaller range";
  }
  return fmt::format(
      "it is compared or computed with `{}`: compare each of the two with "
      "constants, or give it a smaller range",
      qualified_name(network, *found->beside));
}

}  // namespace

Lowering lowering(const BehaviorTree& tree, TickSemantics ticks) {
  return [&tree, ticks](const SampledValues& samples) {
    return lower(tree, ticks, samples);
  };
}

Network lower_to_bind(const BehaviorTree& tree, const Lowering& lowered,
                      std::int64_t most_whole) {
  return lowered(first_values(tree, large_numbers(tree, most_whole)));
}

std::vector<Diagnostic> sample_regions(const BehaviorTree& tree,
                                       const SourceText& source,
                                       std::span<const Expression> asked,
                                       const Lowering& lowered,
                                       Network& network,
                                       std::int64_t most_whole) {
  const std::vector<StateVariableId> large = large_numbers(tree, most_whole);
  if (large.empty()) return {};
  const Regions regions = regions_of(network, large, asked);
  std::vector<StateVariableId> refused;
  for (const StateVariableId number : large) {
    const auto count =
        static_cast<std::int64_t>(regions.samples[index(number)].size());
    const std::int64_t values =
        count > 0 ? count : values_of(tree.variable(number));
    if (values > kMostSampled) refused.push_back(number);
  }
  if (refused.empty()) {
    network = lowered(regions.samples);
  }
  return refusals(tree, source, refused, [&](StateVariableId number) {
    return reason_of(network, regions, number);
  });
}

Result<Network> lower_values(const BehaviorTree& tree, const SourceText& source,
                             TickSemantics ticks) {
  const auto large = large_numbers(tree, kMostSampled);
  auto found = refusals(tree, source, large, [](StateVariableId) {
    return "here all of them are kept; `btcheck check` needs one for each "
           "region that the tree and the rules tell apart";
  });
  if (!found.empty()) return {std::nullopt, std::move(found)};
  return {lower(tree, ticks), {}};
}

}  // namespace btcheck

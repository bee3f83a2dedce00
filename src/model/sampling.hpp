// SPDX-License-Identifier: MIT
//
// What SetSV may measure: every value of a small number, of a large one a value
// of each region (model/automata/regions.hpp). Regions depend on the rules, and
// rules are bound to a network: so it is lowered twice, and what is bound to
// the first network fits the second, which has more edges and nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "model/automata/network.hpp"
#include "model/automata/regions.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A number of no more values keeps them all.
inline constexpr std::int64_t kMostWhole = 16;
// A SetSV has no more edges.
inline constexpr std::int64_t kMostSampled = 4096;

// Lowers a tree, with all that is to be remembered for rules.
using Lowering = std::function<Network(const SampledValues&)>;
// The tree must outlive it.
Lowering lowering(const BehaviorTree& tree, TickSemantics ticks);

// For rules to be bound to: a number of more than `most_whole` values is set to
// one of them only.
Network lower_to_bind(const BehaviorTree& tree, const Lowering& lowered,
                      std::int64_t most_whole = kMostWhole);

// Lowers it again, with a value of each region: of what the tree and `asked`,
// conditions over the network's variables, can tell apart. An error at each
// SetSV with more than kMostSampled of them.
std::vector<Diagnostic> sample_regions(const BehaviorTree& tree,
                                       const SourceText& source,
                                       std::span<const Expression> asked,
                                       const Lowering& lowered,
                                       Network& network,
                                       std::int64_t most_whole = kMostWhole);

// With all values. An error at each SetSV with more than kMostSampled of them.
Result<Network> lower_values(const BehaviorTree& tree, const SourceText& source,
                             TickSemantics ticks);

}  // namespace btcheck

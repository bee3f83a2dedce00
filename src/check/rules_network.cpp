// SPDX-License-Identifier: MIT
#include "check/rules_network.hpp"

#include <iterator>
#include <utility>

#include "check/bind/remembered.hpp"
#include "model/lowering.hpp"

namespace btcheck {

Result<RulesNetwork> network_for(const BehaviorTree& tree,
                                 const SourceText& tree_source,
                                 const PropertyFile& rules,
                                 const SourceText& source, TickSemantics ticks,
                                 ExtraAssumption extra, std::int64_t most_whole,
                                 const std::function<void(Network&)>& change) {
  const Lowering lowered = [&](const SampledValues& samples) {
    Network network = lower(tree, ticks, samples);
    remember_for(tree, rules, network);
    if (change) change(network);
    return network;
  };
  RulesNetwork made{
      std::make_unique<Network>(lower_to_bind(tree, lowered, most_whole)), {}};
  auto bound = bind_properties(tree, *made.network, rules, source, extra);
  Result<RulesNetwork> result{std::nullopt, std::move(bound.diagnostics)};
  if (!bound.value) return result;
  made.bound = std::move(*bound.value);
  auto unsplit = sample_regions(tree, tree_source, made.bound.atoms, lowered,
                                *made.network, most_whole);
  result.diagnostics.insert(result.diagnostics.end(),
                            std::make_move_iterator(unsplit.begin()),
                            std::make_move_iterator(unsplit.end()));
  if (!has_error(result.diagnostics)) result.value = std::move(made);
  return result;
}

}  // namespace btcheck

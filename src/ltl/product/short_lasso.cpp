// SPDX-License-Identifier: MIT
//
// Closed walks made shorter, and turned to where they are entered.
#include "ltl/product/short_lasso.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {

namespace {

// Longer walks are left as they are: looking at all pairs would take long.
constexpr std::size_t kLongestWalkToCut = 4096;

// One past the longest turn that begins with hop `begin` and can be left out,
// or `begin` itself.
std::size_t end_of_useless_turn(std::span<const Hop> cycle, std::size_t begin,
                                AcceptanceSet all_sets,
                                const MarkTable& table) {
  Passage kept(table);  // before and after the turn
  for (const Hop& hop : cycle.first(begin)) kept.add(hop);
  for (std::size_t end = cycle.size(); end > begin; --end) {
    const bool is_turn =
        cycle[end - 1].to == cycle[begin].from && end - begin < cycle.size();
    if (is_turn && kept.is_enough(all_sets)) return end;
    kept.add(cycle[end - 1]);
  }
  return begin;
}

}  // namespace

void cut_useless_turns(std::vector<Hop>& cycle, AcceptanceSet all_sets,
                       const MarkTable& table) {
  if (cycle.size() > kLongestWalkToCut) return;
  for (std::size_t begin = 0; begin < cycle.size(); ++begin) {
    const std::size_t end = end_of_useless_turn(cycle, begin, all_sets, table);
    cycle.erase(cycle.begin() + static_cast<std::ptrdiff_t>(begin),
                cycle.begin() + static_cast<std::ptrdiff_t>(end));
  }
}

void begin_cycle_at_entry(Lasso& lasso) {
  if (lasso.prefix.size() < 2 ||
      lasso.prefix.back().state != lasso.cycle.back().state) {
    return;
  }
  lasso.closing = lasso.cycle.back().step;
  lasso.cycle.pop_back();
  lasso.cycle.insert(lasso.cycle.begin(), std::move(lasso.prefix.back()));
  lasso.prefix.pop_back();
}

}  // namespace btcheck

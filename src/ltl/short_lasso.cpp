// SPDX-License-Identifier: MIT
//
// Closed walks made shorter, and turned to where they are entered.
#include "ltl/short_lasso.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {

namespace {

// Longer walks are left as they are: looking at all pairs would take long.
constexpr std::size_t kLongestWalkToCut = 4096;

// One past the longest turn that begins with hop `begin` and can be left out,
// or `begin` itself.
std::size_t end_of_useless_turn(std::span<const Hop> cycle, std::size_t begin,
                                AcceptanceSet sets) {
  const AcceptanceSet before = union_of_sets(cycle.first(begin));
  AcceptanceSet after = 0;
  for (std::size_t end = cycle.size(); end > begin; --end) {
    const bool is_turn =
        cycle[end - 1].to == cycle[begin].from && end - begin < cycle.size();
    if (is_turn && ((before | after) & sets) == sets) return end;
    after |= cycle[end - 1].sets;
  }
  return begin;
}

}  // namespace

AcceptanceSet union_of_sets(std::span<const Hop> hops) {
  AcceptanceSet sets = 0;
  for (const Hop& hop : hops) sets |= hop.sets;
  return sets;
}

void cut_useless_turns(std::vector<Hop>& cycle, AcceptanceSet sets) {
  if (cycle.size() > kLongestWalkToCut) return;
  for (std::size_t begin = 0; begin < cycle.size(); ++begin) {
    const std::size_t end = end_of_useless_turn(cycle, begin, sets);
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

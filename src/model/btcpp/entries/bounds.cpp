// SPDX-License-Identifier: MIT
#include "model/btcpp/entries/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <set>

namespace btcheck::btcpp {
namespace {

void widen(ScriptDomain& domain, double number) {
  domain.lowest = std::min(domain.lowest, std::floor(number));
  domain.highest = std::max(domain.highest, std::ceil(number));
}

ScriptDomain* domain_of(ScriptWorld& world, const EntryName& entry) {
  const auto found = world.of.find(entry);
  if (found == world.of.end()) return nullptr;
  return &world.domains[index(found->second)];
}

std::set<double> numbers_in(const ScriptTree& tree) {
  std::set<double> numbers;
  for (const ScriptTerm& term : tree.terms) {
    if (term.operation == ScriptOperation::Number && term.number) {
      numbers.insert(*term.number);
    }
    if (term.operation != ScriptOperation::Negate) continue;
    const ScriptTerm& of = tree.terms[term.operands[0]];
    if (of.number) numbers.insert(-*of.number);
  }
  return numbers;
}

void widen_by(const BtcppExpansion& expansion, const PlacedScript& script,
              ScriptWorld& world) {
  const std::set<double> numbers = numbers_in(script.syntax.tree);
  if (numbers.empty()) return;
  for (const ScriptName& name : script.syntax.names) {
    ScriptDomain* domain =
        domain_of(world, entry_of(expansion, script.subtree, name.name));
    if (domain == nullptr) continue;
    widen(*domain, *numbers.begin());
    widen(*domain, *numbers.rbegin());
  }
}

// What is mentioned together may be copied or compared: then the numbers of
// one matter for the other.
void share(const std::vector<std::vector<EntryName>>& all, ScriptWorld& world) {
  std::vector<std::size_t> next(world.domains.size());
  std::iota(next.begin(), next.end(), std::size_t{0});
  const auto first_of = [&](std::size_t i) {
    while (next[i] != i) i = next[i] = next[next[i]];
    return i;
  };
  for (const auto& mentioned : all) {
    std::optional<std::size_t> first;
    for (const EntryName& entry : mentioned) {
      const auto found = world.of.find(entry);
      if (found == world.of.end()) continue;
      const std::size_t one = first_of(index(found->second));
      if (first) next[one] = first_of(*first);
      first = one;
    }
  }
  for (std::size_t i = 0; i < next.size(); ++i) {
    widen(world.domains[first_of(i)], world.domains[i].lowest);
    widen(world.domains[first_of(i)], world.domains[i].highest);
  }
  for (std::size_t i = 0; i < next.size(); ++i) {
    world.domains[i].lowest = world.domains[first_of(i)].lowest;
    world.domains[i].highest = world.domains[first_of(i)].highest;
  }
}

}  // namespace

void find_bounds(const BtcppExpansion& expansion, const ScriptWriters& writers,
                 const std::vector<std::vector<EntryName>>& mentioned,
                 ScriptWorld& world) {
  for (const PlacedScript& script : writers.scripts) {
    widen_by(expansion, script, world);
  }
  for (const auto& [entry, value] : writers.literals) {
    ScriptDomain* domain = domain_of(world, entry);
    if (domain != nullptr && value.is_number()) widen(*domain, value.number);
  }
  share(mentioned, world);
}

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// A set of the states that differ without a part would be needed for each part.
// HyperLogLog (Flajolet, Fusy, Gandouet, Meunier 2007) takes 4 kB: of the hash
// values in each of 4,096 classes it keeps the longest run of leading zeros.
#include "check/space/contribution.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <map>

#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"

namespace btcheck {
namespace {

// How many different hash values it was shown, give or take two percent.
class DistinctCount {
 public:
  void add(std::uint64_t hash) {
    auto& longest = longest_[hash >> (64 - kBits)];
    const int zeros = std::countl_zero(hash << kBits | 1) + 1;
    longest = std::max(longest, static_cast<std::uint8_t>(zeros));
  }

  double estimate() const {
    double sum = 0;
    int empty = 0;
    for (const std::uint8_t longest : longest_) {
      sum += std::ldexp(1.0, -longest);
      empty += longest == 0;
    }
    const double estimate =
        0.7213 / (1 + 1.079 / kClasses) * kClasses * kClasses / sum;
    // Few values are better counted by the classes that none fell into.
    return estimate > 2.5 * kClasses || empty == 0
               ? estimate
               : kClasses * std::log(double{kClasses} / empty);
  }

 private:
  static constexpr int kBits = 12;
  static constexpr int kClasses = 1 << kBits;

  std::array<std::uint8_t, kClasses> longest_{};
};

std::uint64_t mixed(std::uint64_t hash) {
  hash ^= hash >> 32;
  hash *= 0xd6e8feb86659fd93ull;
  hash ^= hash >> 29;
  hash *= 0x9e3779b97f4a7c15ull;
  return hash ^ (hash >> 32);
}

// The hash of a state is the sum of its words', so that what a part adds to it
// can be taken out without a look at the others.
std::uint64_t hash_of(std::size_t word, Word value) {
  return mixed(value ^ mixed(word + 1));
}

// What is left of a state without one part.
struct Rest {
  Contribution part;
  std::map<std::uint32_t, Word> taken_out;  // by word: a mask
  DistinctCount states;
};

// Counts, for each part, the states that differ in the rest.
class RestCounts : public ReachabilityVisitor {
 public:
  explicit RestCounts(const CompiledNetwork& system) : system_(system) {
    const Network& network = system.network();
    for (std::uint32_t n = 0; n < network.node_automaton.size(); ++n) {
      add_node(NodeId{n});
    }
    for (std::uint32_t v = 0; v < network.state_variable.size(); ++v) {
      Rest& rest = add();
      rest.part.variable = StateVariableId{v};
      take_out(rest, network.state_variable[v]);
      if (const auto moved = network.state_automaton[v]) {
        take_clock_out(rest, *moved);
      }
    }
    add();  // takes nothing out
  }

  GoOn expanded(StateId, StateView state, bool /*is_dead*/) {
    std::uint64_t whole = 0;
    for (std::size_t w = 0; w < state.size(); ++w) {
      whole += hash_of(w, state[w]);
    }
    for (Rest& rest : rests_) {
      std::uint64_t hash = whole;
      for (const auto& [word, mask] : rest.taken_out) {
        hash += hash_of(word, state[word] & ~mask) - hash_of(word, state[word]);
      }
      rest.states.add(mixed(hash));
    }
    return GoOn::Yes;
  }

  std::vector<Contribution> contributions() const {
    std::vector<Contribution> all;
    const double states = rests_.back().states.estimate();
    for (auto rest = rests_.begin(); rest + 1 != rests_.end(); ++rest) {
      all.push_back(rest->part);
      all.back().factor = std::max(1.0, states / rest->states.estimate());
    }
    std::ranges::stable_sort(all, std::ranges::greater(),
                             &Contribution::factor);
    return all;
  }

 private:
  Rest& add() { return rests_.emplace_back(); }

  void add_node(NodeId node) {
    const Network& network = system_.network();
    Rest& rest = add();
    rest.part.node = node;
    take_out(rest, network.node_status[index(node)]);
    const AutomatonId own = network.node_automaton[index(node)];
    for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
      const Automaton& automaton = network.automata[a];
      const bool is_its_timer =
          automaton.kind == AutomatonKind::Timer && automaton.node == node;
      if (AutomatonId{a} != own && !is_its_timer) continue;
      take_out(rest, automaton.location);
      if (automaton.gate) take_out(rest, *automaton.gate);
      for (const VariableId local : automaton.locals) take_out(rest, local);
      take_clock_out(rest, AutomatonId{a});
    }
  }

  void take_clock_out(Rest& rest, AutomatonId automaton) const {
    if (const auto& clock = system_.layout().clocks[index(automaton)]) {
      rest.taken_out[clock->word] |= clock->mask();
    }
  }

  void take_out(Rest& rest, VariableId variable) const {
    const Field& field = system_.layout().fields[index(variable)];
    rest.taken_out[field.word] |= field.mask();
  }

  const CompiledNetwork& system_;
  std::vector<Rest> rests_;  // the last one: the whole state
};

}  // namespace

std::vector<Contribution> measure_contributions(const Network& network,
                                                const Limits& limits) {
  const CompiledNetwork system(network);
  RestCounts counts(system);
  const bool is_complete = BreadthFirst(system, limits).run(counts).is_complete;
  return is_complete ? counts.contributions() : std::vector<Contribution>{};
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What a network does, by itself: whatever its automata and variables are
// called, and wherever they stand.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "explore/components/component_store.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Automata and variables are numbered as they are first spoken of. Two networks
// with the same content have the same runs, in these numbers.
class NetworkContent {
 public:
  explicit NetworkContent(const Network& network);

  // Of a question of the network, in such numbers.
  ContentHash of(std::span<const std::int32_t> question) const;
  // -1 of those that never move, and that nobody speaks of who does.
  std::int32_t number(AutomatonId automaton) const {
    return number(index(automaton), automata_);
  }
  std::int32_t number(VariableId variable) const {
    return number(index(variable), variables_);
  }

 private:
  using Numbers = std::unordered_map<std::uint32_t, std::int32_t>;

  static std::int32_t number(std::uint32_t name, const Numbers& numbers) {
    const auto known = numbers.find(name);
    return known == numbers.end() ? -1 : known->second;
  }

  ContentHash hash_;
  Numbers automata_;
  Numbers variables_;
};

}  // namespace btcheck

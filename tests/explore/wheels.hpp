// SPDX-License-Identifier: MIT
//
// A network of any size that threads meet in.
#pragma once

#include "toy.hpp"

namespace btcheck {

// Automata that go round, each on its own but for the last, which follows the
// first.
inline Network wheels(std::size_t count, std::uint32_t size) {
  toy::Draft draft;
  const std::vector<std::string> locations(size, "at");
  std::vector<AutomatonId> wheels;
  for (std::size_t i = 0; i < count; ++i) {
    wheels.push_back(draft.automaton(AutomatonKind::Node, "wheel", locations));
    for (std::uint32_t from = 0; from < size; ++from) {
      const bool follows = i + 1 == count;
      draft.edge(
          wheels[i], from, (from + 1) % size, {0, kUnbounded},
          follows ? toy::is(draft.location(wheels[0]), static_cast<int>(from))
                  : Expression());
    }
  }
  return draft.finish();
}

}  // namespace btcheck

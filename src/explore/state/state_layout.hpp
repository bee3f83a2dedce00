// SPDX-License-Identifier: MIT
//
// Which bits of the packed state vector hold what.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// A run of bits within one word. A field of width 0 holds a constant.
struct Field {
  std::uint32_t word = 0;
  std::uint8_t shift = 0;
  std::uint8_t width = 0;
  std::int32_t base = 0;  // the value of all bits zero

  Word mask() const {
    return width == 0 ? 0 : (~Word{0} >> (64 - width)) << shift;
  }
  Word bits(std::int64_t value) const {
    return static_cast<Word>(value - base) << shift;
  }
  std::int64_t get(const Word* state) const {
    return base + static_cast<std::int64_t>((state[word] & mask()) >> shift);
  }
  void put(Word* state, std::int64_t value) const {
    state[word] = (state[word] & ~mask()) | bits(value);
  }

  friend bool operator==(const Field&, const Field&) = default;
};

// Consecutive gate bits in one word: bit shift + k gates automata[k].
struct GateGroup {
  std::uint32_t word = 0;
  Word mask = 0;
  std::vector<AutomatonId> automaton_of_bit;  // indexed by bit, 64 entries
};

enum class Half : std::uint8_t { Low, High };
constexpr std::size_t index(Half half) {
  return static_cast<std::size_t>(half);
}

// The vector is cut into two halves of whole words, each with the variables
// of neighbouring automata (StateStore keeps each half once). The gate bits of
// a half come first in it, side by side, so that the automata that can move
// are found by scanning the bits that are set.
struct StateLayout {
  // `low_groups`: how many automata go into the low half, counted with the
  // variables that belong to none, which come first. Absent: such that both
  // halves have about as many bits.
  explicit StateLayout(const Network& network,
                       std::optional<std::size_t> low_groups = std::nullopt);

  std::size_t words = 0;
  std::size_t low_words = 0;  // of these, in the low half: words / 2
  std::uint32_t bits = 0;     // in use
  std::vector<Field> fields;  // by VariableId
  // By AutomatonId: the time since its location was entered, up to what its
  // intervals can tell apart. Absent where no interval needs a clock.
  std::vector<std::optional<Field>> clocks;
  std::vector<GateGroup> gates;
  // What is never torn apart, in order: the fields that belong to no automaton,
  // then those of each automaton.
  std::vector<std::vector<Field>> groups;

  Half half_of(const Field& field) const {
    return field.word < low_words ? Half::Low : Half::High;
  }

  // The vector of the network's initial values.
  StateVector initial(const Network& network) const;

 private:
  void collect_gates(const Network& network);
};

}  // namespace btcheck

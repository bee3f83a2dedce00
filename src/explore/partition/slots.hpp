// SPDX-License-Identifier: MIT
//
// A packed state as a vector of integers, as engines have it that search
// whatever a language module gives them.
#pragma once

#include <boost/dynamic_bitset.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/step.hpp"

namespace btcheck {

// A set of slots, by number.
using SlotSet = boost::dynamic_bitset<>;

enum class SlotKind : std::uint8_t {
  Variables,  // one for each variable and each clock that can change
  Packed      // the packed state itself, two for each of its words
};

// One integer of the vector. A variable whose values have names is counted
// from 0, any other has its own value.
struct Slot {
  Field field;
  std::optional<VariableId> variable;  // that it holds
  std::optional<AutomatonId> clock;    // whose clock it holds
};

class Slots {
 public:
  // At least two: an engine for several machines asks for that.
  Slots(const CompiledNetwork& system, SlotKind kind);

  std::size_t size() const { return slots_.size(); }
  const Slot& operator[](std::size_t number) const { return slots_[number]; }
  SlotSet none() const { return SlotSet(size()); }
  // Those that hold some bit of the field.
  void add(const Field& field, SlotSet& to) const;

  void pack(const int* from, Word* to) const {
    for (std::size_t w = 0; w < words_; ++w) to[w] = 0;
    for (std::size_t s = 0; s < slots_.size(); ++s) {
      const Field& field = slots_[s].field;
      to[field.word] |= field.bits(from[s]) & masks_[s];
    }
  }
  void unpack(const Word* from, int* to) const {
    for (std::size_t s = 0; s < slots_.size(); ++s) {
      to[s] = static_cast<int>(slots_[s].field.get(from));
    }
  }
  // `to` has the integers of one state and gets those of the other.
  void unpack_changes(const Word* of, const Word* other, int* to) const {
    for (std::size_t w = 0; w < words_; ++w) {
      Word differs = of[w] ^ other[w];
      while (differs != 0) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(differs));
        const std::uint32_t slot = slot_of_bit_[64 * w + bit];
        to[slot] = static_cast<int>(slots_[slot].field.get(other));
        differs &= ~masks_[slot];
      }
    }
  }

 private:
  void place(const Slot& slot);

  std::size_t words_ = 0;
  std::vector<Slot> slots_;
  std::vector<Word> masks_;                 // by slot
  std::vector<std::uint32_t> slot_of_bit_;  // by bit of the packed state
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "explore/partition/slots.hpp"

#include <bit>

namespace btcheck {
namespace {

// The values of names are counted from 0, so that they number their names.
Field counted(const Field& field, const Variable& variable) {
  Field result = field;
  if (!variable.value_names.empty()) result.base = 0;
  return result;
}

std::vector<Slot> slots_of_variables(const CompiledNetwork& system) {
  const Network& network = system.network();
  const StateLayout& layout = system.layout();
  std::vector<Slot> slots;
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    if (layout.fields[v].width == 0) continue;
    slots.push_back(
        {counted(layout.fields[v], network.variables[v]), VariableId{v}, {}});
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const auto& clock = layout.clocks[a];
    if (clock && clock->width > 0)
      slots.push_back({*clock, {}, AutomatonId{a}});
  }
  return slots;
}

std::vector<Slot> slots_of_words(const CompiledNetwork& system) {
  std::vector<Slot> slots;
  for (std::uint32_t w = 0; w < system.word_count(); ++w) {
    slots.push_back({Field{w, 0, 32, 0}, {}, {}});
    slots.push_back({Field{w, 32, 32, 0}, {}, {}});
  }
  return slots;
}

}  // namespace

Slots::Slots(const CompiledNetwork& system, SlotKind kind)
    : words_(system.word_count()),
      slot_of_bit_(64 * system.word_count(), UINT32_MAX) {
  const auto all = kind == SlotKind::Packed ? slots_of_words(system)
                                            : slots_of_variables(system);
  for (const Slot& slot : all) place(slot);
  while (size() < 2) place({});
}

void Slots::place(const Slot& slot) {
  const auto number = static_cast<std::uint32_t>(slots_.size());
  slots_.push_back(slot);
  masks_.push_back(slot.field.mask());
  for (Word bits = masks_.back(); bits != 0; bits &= bits - 1) {
    const auto bit = static_cast<std::size_t>(std::countr_zero(bits));
    slot_of_bit_[64 * slot.field.word + bit] = number;
  }
}

void Slots::add(const Field& field, SlotSet& to) const {
  for (Word bits = field.mask(); bits != 0; bits &= bits - 1) {
    const auto bit = static_cast<std::size_t>(std::countr_zero(bits));
    to.set(slot_of_bit_[64 * field.word + bit]);
  }
}

}  // namespace btcheck

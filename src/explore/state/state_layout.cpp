// SPDX-License-Identifier: MIT
//
// Each variable takes just the bits its domain needs and no field crosses a
// word. Automata keep their order, which is post-order over the tree, so each
// half of the vector belongs to neighbouring subtrees: most steps change one
// half only, and halves repeat far more often than whole states.
#include "explore/state/state_layout.hpp"

#include <algorithm>
#include <bit>

namespace btcheck {
namespace {

std::uint8_t width_of(std::int64_t domain_size) {
  return static_cast<std::uint8_t>(
      std::bit_width(static_cast<std::uint64_t>(domain_size - 1)));
}

// The greatest clock value that an automaton's intervals can tell apart.
int greatest_clock(const Automaton& automaton) {
  int greatest = 0;
  for (const Edge& edge : automaton.edges) {
    greatest = std::max(greatest, edge.when.greatest_clock());
  }
  return greatest;
}

// One half under construction: fields are given the first word with room.
class HalfLayout {
 public:
  Field place(std::uint8_t width, std::int32_t base) {
    if (width == 0) return {0, 0, 0, base};
    std::size_t word = 0;
    while (word < used_.size() && used_[word] + width > 64) ++word;
    if (word == used_.size()) used_.push_back(0);
    Field field{static_cast<std::uint32_t>(word),
                static_cast<std::uint8_t>(used_[word]), width, base};
    used_[word] += width;
    return field;
  }
  std::size_t words() const { return used_.size(); }

 private:
  std::vector<std::uint32_t> used_;  // bits, by word
};

// The variables of each automaton, its clock, and what belongs to none.
struct Group {
  std::optional<VariableId> gate;
  std::vector<VariableId> variables;
  int clock = 0;
  std::uint32_t bits = 0;
};

std::vector<Group> groups_of(const Network& network) {
  std::vector<Group> groups(network.automata.size() + 1);
  std::vector<bool> placed(network.variables.size(), false);
  auto take = [&](Group& group, VariableId id) {
    if (placed[index(id)]) return;
    placed[index(id)] = true;
    group.variables.push_back(id);
    group.bits += width_of(network.variable(id).domain_size());
  };
  for (std::size_t i = 0; i < network.automata.size(); ++i) {
    const Automaton& automaton = network.automata[i];
    Group& group = groups[i];
    group.gate = automaton.gate;
    if (automaton.gate) placed[index(*automaton.gate)] = true;
    group.bits += automaton.gate ? 1 : 0;
    take(group, automaton.location);
    if (automaton.kind == AutomatonKind::Node) {
      take(group, network.node_status[index(automaton.node)]);
    }
    for (VariableId local : automaton.locals) take(group, local);
    group.clock = greatest_clock(automaton);
    group.bits += width_of(group.clock + 1);
  }
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    take(groups.back(), VariableId{v});
  }
  // Shared variables that belong to no automaton come first.
  std::rotate(groups.begin(), groups.end() - 1, groups.end());
  return groups;
}

// How many of the groups go into the low half: about half of the bits.
std::size_t cut_of(const std::vector<Group>& groups, std::uint32_t bits) {
  std::size_t cut = 0;
  for (std::uint32_t low = 0; cut < groups.size() && low * 2 < bits; ++cut) {
    low += groups[cut].bits;
  }
  return cut;
}

}  // namespace

StateLayout::StateLayout(const Network& network,
                         std::optional<std::size_t> low_groups)
    : fields(network.variables.size()), clocks(network.automata.size()) {
  const std::vector<Group> all = groups_of(network);
  for (const Group& group : all) bits += group.bits;
  const std::size_t cut = low_groups.value_or(cut_of(all, bits));

  HalfLayout halves[2];
  std::vector<Field*> high;  // fields of the high half, still to be moved up
  const auto place = [&](std::size_t group, Field& field, std::uint8_t width,
                         std::int32_t base) {
    field = halves[group < cut ? 0 : 1].place(width, base);
    if (group >= cut && width > 0) high.push_back(&field);
  };
  for (std::size_t g = 0; g < all.size(); ++g) {
    if (all[g].gate) place(g, fields[index(*all[g].gate)], 1, 0);
  }
  for (std::size_t g = 0; g < all.size(); ++g) {
    for (const VariableId id : all[g].variables) {
      const Variable& variable = network.variable(id);
      place(g, fields[index(id)], width_of(variable.domain_size()),
            variable.min);
    }
    if (all[g].clock == 0) continue;
    // Group 0 is what belongs to no automaton.
    place(g, clocks[g - 1].emplace(), width_of(all[g].clock + 1), 0);
  }

  // Both halves get the same number of words; a vector of one word has no low
  // half.
  const std::size_t half_words = std::max(halves[0].words(), halves[1].words());
  const bool is_single = halves[0].words() + halves[1].words() <= 1;
  words = is_single ? 1 : 2 * half_words;
  low_words = words / 2;
  for (Field* field : high) {
    if (!is_single) field->word += static_cast<std::uint32_t>(half_words);
  }
  collect_gates(network);
  for (std::size_t g = 0; g < all.size(); ++g) {
    std::vector<Field>& own = groups.emplace_back();
    if (all[g].gate) own.push_back(fields[index(*all[g].gate)]);
    for (const VariableId id : all[g].variables) {
      own.push_back(fields[index(id)]);
    }
    if (g > 0 && clocks[g - 1]) own.push_back(*clocks[g - 1]);
  }
}

void StateLayout::collect_gates(const Network& network) {
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (!network.automata[a].gate) continue;
    const Field& gate = fields[index(*network.automata[a].gate)];
    auto known = std::find_if(
        gates.begin(), gates.end(),
        [&](const GateGroup& group) { return group.word == gate.word; });
    if (known == gates.end()) {
      gates.push_back({gate.word, 0, std::vector<AutomatonId>(64)});
      known = gates.end() - 1;
    }
    known->mask |= gate.mask();
    known->automaton_of_bit[gate.shift] = AutomatonId{a};
  }
}

StateVector StateLayout::initial(const Network& network) const {
  StateVector state(words, 0);
  for (std::size_t v = 0; v < fields.size(); ++v) {
    if (fields[v].width > 0) {
      fields[v].put(state.data(), network.variables[v].initial);
    }
  }
  return state;
}

}  // namespace btcheck

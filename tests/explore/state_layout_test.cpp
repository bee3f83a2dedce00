// SPDX-License-Identifier: MIT
//
// Every variable and clock has bits of its own, and keeps its value in them.
#include "explore/state/state_layout.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <set>
#include <vector>

#include "explore/toy.hpp"
#include "model/btf_text.hpp"
#include "model/lowering.hpp"

namespace btcheck::state_layout_test {
namespace {

std::vector<Field> all_fields(const StateLayout& layout) {
  std::vector<Field> fields = layout.fields;
  for (const auto& clock : layout.clocks) {
    if (clock) fields.push_back(*clock);
  }
  return fields;
}

// No two fields share a bit, none crosses a word, and all bits are counted.
void check_places(const StateLayout& layout) {
  std::vector<Word> used(layout.words, 0);
  std::uint32_t bits = 0;
  for (const Field& field : all_fields(layout)) {
    REQUIRE(field.word < layout.words);
    REQUIRE(field.shift + field.width <= 64);
    CHECK(std::popcount(field.mask()) == field.width);
    CHECK((used[field.word] & field.mask()) == 0);
    used[field.word] |= field.mask();
    bits += field.width;
  }
  CHECK(bits == layout.bits);
}

// A value put into a field comes back, and no other bit has changed.
bool round_trips(const Field& field, std::int64_t value, StateVector state) {
  const StateVector before = state;
  field.put(state.data(), value);
  if (field.get(state.data()) != value) return false;
  for (std::size_t w = 0; w < state.size(); ++w) {
    const Word own = w == field.word ? field.mask() : 0;
    if ((state[w] & ~own) != (before[w] & ~own)) return false;
  }
  return true;
}

void check_values(const Network& network, const StateLayout& layout,
                  std::mt19937_64& random) {
  for (std::size_t v = 0; v < network.variables.size(); ++v) {
    const Variable& variable = network.variables[v];
    StateVector state(layout.words);
    for (Word& word : state) word = random();
    const int last = std::min(variable.max, variable.min + 40);
    bool keeps_all = round_trips(layout.fields[v], variable.max, state);
    for (int value = variable.min; value <= last; ++value) {
      keeps_all &= round_trips(layout.fields[v], value, state);
    }
    CAPTURE(v);
    CHECK(keeps_all);
  }
}

// Each gate is a bit of its group, and the bits of a group are neighbours.
void check_gates(const Network& network, const StateLayout& layout) {
  std::set<std::uint32_t> found;
  for (const GateGroup& group : layout.gates) {
    const Word shifted = group.mask >> std::countr_zero(group.mask);
    CHECK((shifted & (shifted + 1)) == 0);
    REQUIRE(group.automaton_of_bit.size() == 64);
    for (Word open = group.mask; open != 0; open &= open - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(open));
      const AutomatonId gated = group.automaton_of_bit[bit];
      const Field& gate = layout.fields[index(*network.automaton(gated).gate)];
      CHECK(gate.word == group.word);
      CHECK(gate.shift == bit);
      CHECK(found.insert(index(gated)).second);
    }
  }
  const auto gated = std::count_if(
      network.automata.begin(), network.automata.end(),
      [](const Automaton& automaton) { return automaton.gate.has_value(); });
  CHECK(found.size() == static_cast<std::size_t>(gated));
}

void check_layout(const Network& network) {
  std::mt19937_64 random(1);
  const StateLayout layout(network);
  check_places(layout);
  check_values(network, layout, random);
  check_gates(network, layout);
  const StateVector initial = layout.initial(network);
  CHECK(initial.size() == layout.words);
  for (std::size_t v = 0; v < network.variables.size(); ++v) {
    CHECK(layout.fields[v].get(initial.data()) == network.variables[v].initial);
  }
  for (const auto& clock : layout.clocks) {
    if (clock) CHECK(clock->get(initial.data()) == 0);
  }
}

TEST_CASE("the fields of every example have bits of their own") {
  for (const std::string_view name : kExamples) {
    const BehaviorTree tree = tree_of(example(name));
    for (const TickSemantics ticks :
         {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
          TickSemantics::None}) {
      CAPTURE(name);
      CAPTURE(tick_name(ticks));
      check_layout(lower(tree, ticks));
    }
  }
}

Network random_network(std::mt19937& random) {
  toy::Draft draft;
  for (std::size_t n = random() % 12; n > 0; --n) {
    const int min = static_cast<int>(random() % 2000) - 1000;
    const int size = 1 + static_cast<int>(random() % (1u << (random() % 24)));
    draft.variable("x", min, min + size - 1,
                   min + static_cast<int>(random() % size));
  }
  for (std::size_t n = random() % 90; n > 0; --n) {
    std::optional<VariableId> gate;
    if (random() % 4 != 0) {
      gate = draft.variable("caller", 0, 1, 0, VariableRole::Caller);
    }
    const auto kind =
        random() % 5 == 0 ? AutomatonKind::Timer : AutomatonKind::Node;
    std::vector<std::string> places(1 + random() % 20, "here");
    const AutomatonId made = draft.automaton(kind, "a", places, gate);
    const int upper = static_cast<int>(random() % 70);
    if (random() % 3 == 0) draft.edge(made, 0, 0, {upper / 2, upper});
    if (random() % 9 == 0) draft.edge(made, 0, 0, {upper, kUnbounded});
  }
  return draft.finish();
}

TEST_CASE("the fields of random networks have bits of their own") {
  std::mt19937 random(20);
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    check_layout(random_network(random));
  }
}

TEST_CASE("a constant takes no bits, and nothing at all is one word") {
  toy::Draft draft;
  const VariableId constant = draft.variable("c", 7, 7, 7);
  const Network network = draft.finish();
  const StateLayout layout(network);
  CHECK(layout.words == 1);
  CHECK(layout.bits == 0);
  const StateVector state = layout.initial(network);
  CHECK(state == StateVector{0});
  CHECK(layout.fields[index(constant)].get(state.data()) == 7);
}

TEST_CASE("a field is just as wide as its domain needs") {
  toy::Draft draft;
  const VariableId two = draft.variable("two", 0, 1);
  const VariableId eight = draft.variable("eight", -3, 4);
  const VariableId nine = draft.variable("nine", 0, 8);
  const StateLayout layout(draft.finish());
  CHECK(layout.fields[index(two)].width == 1);
  CHECK(layout.fields[index(eight)].width == 3);
  CHECK(layout.fields[index(nine)].width == 4);
  CHECK(layout.bits == 8);
}

TEST_CASE("a clock counts as far as its intervals can tell") {
  toy::Draft draft;
  const auto kind = AutomatonKind::Timer;
  const AutomatonId urgent = draft.automaton(kind, "u", {"x"});
  draft.edge(urgent, 0, 0, kAtOnce);
  draft.edge(urgent, 0, 0, kAnyTime);
  const AutomatonId bounded = draft.automaton(kind, "b", {"x"});
  draft.edge(bounded, 0, 0, {1, 4});
  const AutomatonId open = draft.automaton(kind, "o", {"x"});
  draft.edge(open, 0, 0, {7, kUnbounded});
  const StateLayout layout(draft.finish());
  CHECK(!layout.clocks[index(urgent)].has_value());
  REQUIRE(layout.clocks[index(bounded)].has_value());
  CHECK(layout.clocks[index(bounded)]->width == 3);
  REQUIRE(layout.clocks[index(open)].has_value());
  CHECK(layout.clocks[index(open)]->width == 3);
}

TEST_CASE("a vector of several words has two halves of equal length") {
  toy::Draft draft;
  for (int i = 0; i < 7; ++i) draft.variable("x", 0, (1 << 30) - 1);
  for (int i = 0; i < 3; ++i) {
    std::vector<std::string> places(1000, "here");
    draft.automaton(AutomatonKind::Node, "a", places);
  }
  const StateLayout layout(draft.finish());
  CHECK(layout.words % 2 == 0);
  CHECK(layout.words * 64 >= layout.bits);
}

}  // namespace
}  // namespace btcheck::state_layout_test

// SPDX-License-Identifier: MIT
//
// What is said of groups, slots and guards beforehand, against all states of
// random networks and what their steps do: a slot that is not read may have any
// value without a difference, one that is not written keeps its own, a guard
// becomes true by nothing that cannot make it so, and groups that accord lead
// to the same state in either order.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "explore/partition/guards.hpp"
#include "explore/store/state_store.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"
#include "reference/reduction_cases.hpp"

namespace btcheck::reference::partition_cross_check_test {
namespace {

using Integers = std::vector<int>;

// All that a case needs, and its reachable states as integers.
struct Parted {
  Parted(const Network& network, SlotKind kind)
      : system(network),
        slots(system, kind),
        groups(system, slots),
        guards(system, slots, groups) {
    StateStore store(system.word_count());
    system.initial_states([&](StateView state) { store.insert(state); });
    StateVector words(system.word_count());
    for (std::uint32_t i = 0; i < store.size(); ++i) {
      store.load(StateId{i}, words);
      states.push_back(unpacked(words));
      system.successors(words, [&](StateView to, const Step&) {
        ++steps;
        store.insert(to);
      });
    }
  }

  Integers unpacked(StateView words) const {
    Integers integers(slots.size());
    slots.unpack(words.data(), integers.data());
    return integers;
  }
  StateVector packed(const Integers& state) const {
    StateVector words(system.word_count());
    slots.pack(state.data(), words.data());
    return words;
  }
  // Where the group leads to; nothing where it has no step.
  std::optional<Integers> after(std::uint32_t group,
                                const Integers& state) const {
    StateVector next(system.word_count());
    if (!groups.step(group, packed(state), next)) return std::nullopt;
    return unpacked(next);
  }
  // The same without idle steps.
  std::optional<Integers> moved(std::uint32_t group,
                                const Integers& state) const {
    auto to = after(group, state);
    if (to && group == groups.time() && *to == state) to.reset();
    return to;
  }
  bool holds(std::uint32_t guard, const Integers& state) const {
    return guards.holds(guard, packed(state));
  }

  CompiledNetwork system;
  Slots slots;
  Groups groups;
  Guards guards;
  std::vector<Integers> states;
  std::uint64_t steps = 0;
};

// The state, with all slots that are not in the set as in the other one.
Integers mixed(const Integers& state, const Integers& other,
               const SlotSet& kept) {
  Integers result = other;
  for (std::size_t s = 0; s < state.size(); ++s) {
    if (kept[s]) result[s] = state[s];
  }
  return result;
}

// What is wrong, "" for nothing.
std::string flaw_of_steps(const Parted& of) {
  std::uint64_t steps = 0;
  for (const Integers& state : of.states) {
    if (of.unpacked(of.packed(state)) != state) return "packed otherwise";
    std::map<std::uint32_t, Integers> told;
    of.system.successors(of.packed(state), [&](StateView to, const Step& step) {
      told[of.groups.of(step)] = of.unpacked(to);
    });
    for (std::uint32_t group = 0; group < of.groups.size(); ++group) {
      const auto to = of.after(group, state);
      steps += to.has_value();
      const auto found = told.find(group);
      if (to.has_value() != (found != told.end()) ||
          (to && *to != found->second)) {
        return fmt::format("group {} has another step than the network", group);
      }
    }
  }
  return steps == of.steps
             ? ""
             : "groups tell another number of steps than the network";
}

std::string flaw_of_slots(const Parted& of, const Integers& state,
                          const Integers& other, std::uint32_t group) {
  const GroupSlots& slots = of.groups.slots(group);
  const Integers changed = mixed(state, other, slots.reads);
  const auto to = of.after(group, state);
  const auto there = of.after(group, changed);
  if (to.has_value() != there.has_value()) {
    return fmt::format("group {} reads more than it says", group);
  }
  if (!to) return {};
  for (std::size_t s = 0; s < to->size(); ++s) {
    if (!slots.may_write[s] &&
        ((*to)[s] != state[s] || (*there)[s] != changed[s])) {
      return fmt::format("group {} writes slot {}", group, s);
    }
    const bool is_kept = slots.reads[s] || slots.must_write[s];
    if (slots.may_write[s] && is_kept && (*to)[s] != (*there)[s]) {
      return fmt::format("group {} writes something else to slot {}", group, s);
    }
  }
  return {};
}

// Of slots that hold a variable each. Halves of words are written in part.
std::string flaw_of_matrices(const Parted& of, SplitMix64& random) {
  for (const Integers& state : of.states) {
    const Integers& other = of.states[static_cast<std::size_t>(
        random.below(static_cast<int>(of.states.size())))];
    for (std::uint32_t group = 0; group < of.groups.size(); ++group) {
      const std::string wrong = flaw_of_slots(of, state, other, group);
      if (!wrong.empty()) return wrong;
    }
  }
  return {};
}

std::string flaw_of_guards(const Parted& of, const Integers& state) {
  std::vector<bool> before;
  for (std::uint32_t g = 0; g < of.guards.size(); ++g) {
    before.push_back(of.holds(g, state));
  }
  for (std::uint32_t one = 0; one < before.size(); ++one) {
    for (std::uint32_t other = 0; other < before.size(); ++other) {
      if (before[one] && before[other] && !of.guards.may_coincide(one, other)) {
        return fmt::format("guards {} and {} do coincide", one, other);
      }
    }
  }
  for (std::uint32_t group = 0; group < of.groups.size(); ++group) {
    const auto to = of.moved(group, state);
    const bool is_open =
        std::ranges::all_of(of.guards.of(group),
                            [&](std::uint32_t guard) { return before[guard]; });
    if (is_open != to.has_value()) {
      return fmt::format("the guards of group {} say something else", group);
    }
    if (!to) continue;
    for (std::uint32_t g = 0; g < before.size(); ++g) {
      const bool holds = of.holds(g, *to);
      if (holds && !before[g] && !of.guards.may_enable(g, group)) {
        return fmt::format("group {} makes guard {} true", group, g);
      }
      if (!holds && before[g] && !of.guards.may_disable(g, group)) {
        return fmt::format("group {} makes guard {} false", group, g);
      }
    }
  }
  return {};
}

std::string flaw_of_pairs(const Parted& of, const Integers& state) {
  std::vector<std::pair<std::uint32_t, Integers>> open;
  for (std::uint32_t group = 0; group < of.groups.size(); ++group) {
    if (auto to = of.moved(group, state)) open.emplace_back(group, *to);
  }
  for (const auto& [one, after_one] : open) {
    for (const auto& [other, after_other] : open) {
      if (one == other || !of.guards.accord(one, other)) continue;
      const auto end = of.moved(other, after_one);
      if (!end || end != of.moved(one, after_other)) {
        return fmt::format("groups {} and {} do not accord", one, other);
      }
    }
  }
  return {};
}

std::string flaw_of(const Network& network, SlotKind kind, SplitMix64& random) {
  const Parted of(network, kind);
  std::string wrong = flaw_of_steps(of);
  if (wrong.empty() && kind == SlotKind::Variables) {
    wrong = flaw_of_matrices(of, random);
  }
  for (const Integers& state : of.states) {
    if (!wrong.empty()) break;
    if (random.percent(70)) continue;
    wrong = flaw_of_guards(of, state);
    if (wrong.empty()) wrong = flaw_of_pairs(of, state);
  }
  return wrong;
}

TEST_CASE("groups and guards do what is said of them beforehand") {
  ReductionCensus census;
  SplitMix64 random(seed_or(21));
  for_reduction_cases(2100, by_effort(40, 600), [&](const ReductionCase& each) {
    census.count(each);
    for (const SlotKind kind : {SlotKind::Variables, SlotKind::Packed}) {
      const std::string wrong = flaw_of(each.network, kind, random);
      INFO(each.text);
      REQUIRE(wrong == "");
    }
    return GoOn::Yes;
  });
  CHECK_COVERED(census.xml_trees > 0);
  CHECK_COVERED(census.untimed > 0);
  CHECK_COVERED(census.fixed_timers > 0);
  CHECK_COVERED(census.ranged_timers > 0);
  CHECK_COVERED(census.faults > 0);
}

}  // namespace
}  // namespace btcheck::reference::partition_cross_check_test

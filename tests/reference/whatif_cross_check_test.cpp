// SPDX-License-Identifier: MIT
//
// Each row of `btcheck whatif` on random XML trees against faults put in by
// hand: functions called tick by tick, with every answer of every leaf.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/whatif/effects.hpp"
#include "check/whatif/whatif.hpp"
#include "model/tree/node_types.hpp"
#include "reference/effort.hpp"
#include "reference/naive_faults.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"

namespace btcheck::reference::whatif_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 600;
constexpr std::array<Profile, 5> kProfiles = {
    Profile::Btcpp38, Profile::Btcpp4, Profile::Nav2Humble, Profile::Nav2Jazzy,
    Profile::Nav2Main};

struct RandomMission {
  std::string text;
  WhatIfInput input;
};
std::optional<RandomMission> mission(std::uint64_t seed) {
  const Profile profile = kProfiles[seed % kProfiles.size()];
  TreeInput tree("t.xml", FileText(random_xml_tree(seed, profile)));
  tree.reading.profile = profile;
  auto input = what_if_input(tree, {});
  if (!input.value) return std::nullopt;
  return RandomMission{std::string(tree.text), std::move(*input.value)};
}

// A .btf tree, of which nothing moves by itself.
std::optional<RandomMission> btf_mission(std::uint64_t seed) {
  RandomTreeWeights weights;
  weights.contract = 70;
  weights.decided = 50;
  weights.duration = 30;
  weights.sampled = 100;
  weights.leaving_range = 10;
  weights.looping_root = 0;
  weights.max_parallels = 0;
  TreeInput tree("t.btf", FileText(random_tree(seed, weights)));
  auto input = what_if_input(tree, {});
  if (!input.value || input.value->tree.roots.size() != 1) return std::nullopt;
  for (std::uint32_t v = 0; v < input.value->tree.variables.size(); ++v) {
    if (moves_freely(input.value->tree, StateVariableId{v})) {
      return std::nullopt;
    }
  }
  return RandomMission{std::string(tree.text), std::move(*input.value)};
}

std::vector<NaiveFault> naive(const std::vector<InjectedFault>& faults) {
  std::vector<NaiveFault> same;
  for (const InjectedFault& each : faults) {
    same.push_back({each.leaf, each.fault.kind, each.fault.late});
  }
  return same;
}

// Nav2's conditions that look once have their say before a fault does.
bool has_simple_memory(const BehaviorTree& tree, const FaultRow& row) {
  return std::ranges::all_of(row.faults, [&](const InjectedFault& fault) {
    const LeafMemory memory = tree.node(fault.leaf).contract.memory;
    return memory == LeafMemory::None || memory == LeafMemory::Latched ||
           memory == LeafMemory::Unknown;
  });
}

std::string told(const BehaviorTree& tree,
                 const std::vector<InjectedFault>& faults) {
  std::string text;
  for (const InjectedFault& each : faults) {
    text += fmt::format("{} {}, ", tree.node(each.leaf).name,
                        facts_of(each.fault.kind).word);
  }
  return text;
}

std::string word(bool strikes, bool succeeds, bool fails, bool throws,
                 bool hangs) {
  return fmt::format("strikes {} succeeds {} fails {} throws {} hangs {}",
                     strikes, succeeds, fails, throws, hangs);
}
std::string word(const Effect& e) {
  return word(e.strikes, e.succeeds, e.fails, e.throws, e.hangs);
}
std::string word(const NaiveEffect& e) {
  return word(e.strikes, e.succeeds, e.fails, e.throws, e.hangs);
}

std::string asked_text(const std::set<NodeId>& asked) {
  std::string text;
  for (const NodeId node : asked) text += fmt::format(" {}", index(node));
  return text;
}
std::string asked_text(const BehaviorTree& tree, const std::vector<bool>& all) {
  std::set<NodeId> asked;
  for (std::uint32_t n = 0; n < all.size(); ++n) {
    const NodeType type = tree.nodes[n].type;
    const bool counts = type == NodeType::Action ||
                        type == NodeType::Condition || type == NodeType::SetSV;
    if (all[n] && counts) asked.insert(NodeId{n});
  }
  return asked_text(asked);
}

WhatIfOptions options(int order) {
  WhatIfOptions how;
  how.choices.late = 2;
  how.order = order;
  how.limits.max_states = 50'000;
  return how;
}

// By the harm that they do, how many rows were compared.
using Counts = std::map<Harm, std::size_t>;
std::string told(const Counts& counts) {
  std::string text;
  for (const auto& [harm, count] : counts) {
    text += fmt::format(" {} {}", facts_of(harm).word, count);
  }
  return text;
}

// What differs first, or "".
std::string difference(const RandomMission& mission, Counts& counts) {
  const auto result = what_if(mission.input, options(1));
  if (!result.value) return "it is refused";
  const BehaviorTree& tree = mission.input.tree;
  const auto healthy = naive_effect(tree, {}, kMostStates);
  if (!healthy) return "";
  if (word(*healthy) != word(result.value->healthy)) {
    return fmt::format("without faults: naive {}\n  search {}", word(*healthy),
                       word(result.value->healthy));
  }
  for (const FaultRow& row : result.value->rows) {
    if (!has_simple_memory(tree, row)) continue;
    const auto expected = naive_effect(tree, naive(row.faults), kMostStates);
    if (!expected) continue;
    if (word(*expected) != word(row.effect)) {
      return fmt::format("{}: naive  {}\n  search {}", told(tree, row.faults),
                         word(*expected), word(row.effect));
    }
    std::vector<bool> naively(tree.nodes.size(), false);
    for (const NodeId node : expected->asked) naively[index(node)] = true;
    if (asked_text(tree, naively) != asked_text(tree, row.asked)) {
      return fmt::format("{}: naive asks {}, search asks {}",
                         told(tree, row.faults), asked_text(tree, naively),
                         asked_text(tree, row.asked));
    }
    ++counts[row.harm];
  }
  return "";
}

// Sets of faults as texts.
using Sets = std::set<std::set<std::string>>;
std::set<std::string> named(const BehaviorTree& tree,
                            const std::vector<InjectedFault>& faults) {
  std::set<std::string> names;
  for (const InjectedFault& each : faults) names.insert(told(tree, {each}));
  return names;
}

bool naive_happens(const TopEvent& event, const NaiveEffect& effect) {
  if (!effect.strikes) return false;
  switch (event.kind) {
    case TopEvent::Kind::Fails:
      return effect.fails;
    case TopEvent::Kind::CannotSucceed:
      return !effect.succeeds;
    case TopEvent::Kind::NeverEnds:
      return effect.hangs;
    case TopEvent::Kind::Throws:
      return effect.throws;
    case TopEvent::Kind::Rule:
      return false;
  }
  return false;
}

// Cut sets by trying every pair.
std::string cut_set_difference(const RandomMission& mission,
                               std::size_t& pairs) {
  const auto result = what_if(mission.input, options(2));
  const BehaviorTree& tree = mission.input.tree;
  const auto& faults = result.value->possible.faults;
  std::vector<std::vector<InjectedFault>> all;
  for (std::size_t i = 0; i < faults.size(); ++i) {
    all.push_back({faults[i]});
  }
  for (std::size_t i = 0; i < faults.size(); ++i) {
    for (std::size_t j = i + 1; j < faults.size(); ++j) {
      if (faults[i].leaf != faults[j].leaf) {
        all.push_back({faults[i], faults[j]});
      }
    }
  }
  std::vector<NaiveEffect> effects;
  for (const auto& set : all) {
    FaultRow row;
    row.faults = set;
    if (!has_simple_memory(tree, row)) return "";
    const auto effect = naive_effect(tree, naive(set), kMostStates);
    if (!effect) return "";
    effects.push_back(*effect);
  }
  pairs += all.size() - faults.size();
  for (const CutSets& cut : result.value->cut_sets) {
    Sets expected;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!naive_happens(cut.event, effects[i])) continue;
      const auto names = named(tree, all[i]);
      const bool is_least = std::ranges::none_of(names, [&](const auto& name) {
        return names.size() > 1 && expected.contains({name});
      });
      if (is_least) expected.insert(names);
    }
    Sets found;
    for (const auto& set : cut.sets) found.insert(named(tree, set));
    if (found == expected) continue;
    for (const auto& [one, other, which] :
         {std::tuple(expected, found, "search lacks"),
          std::tuple(found, expected, "search has too much:")}) {
      for (const auto& set : one) {
        if (other.contains(set)) continue;
        return fmt::format("event {}: {} {}", static_cast<int>(cut.event.kind),
                           which, fmt::join(set, " + "));
      }
    }
  }
  return "";
}

// Losses that nobody notices, by runs of a few ticks.
std::string silence_difference(const RandomMission& mission,
                               std::size_t& compared, std::size_t& silent) {
  constexpr int kTicks = 3;
  constexpr std::size_t kMostRuns = 4000;
  const auto result = what_if(mission.input, options(1));
  const BehaviorTree& tree = mission.input.tree;
  for (const FaultRow& row : result.value->rows) {
    const InjectedFault& fault = row.faults[0];
    using enum FaultKind;
    const bool is_simple = fault.fault.kind == Fails ||
                           fault.fault.kind == FailsOnce ||
                           fault.fault.kind == FailsOn;
    if (!is_simple || !is_deed(tree.node(fault.leaf)) ||
        !has_simple_memory(tree, row)) {
      continue;
    }
    const auto well = naive_successes(tree, {}, fault.leaf, kTicks, kMostRuns);
    const auto ill =
        naive_successes(tree, naive(row.faults), fault.leaf, kTicks, kMostRuns);
    if (!well || !ill) continue;
    const bool expected = std::ranges::any_of(*ill, [&](const SeenRun& run) {
      if (run.leaf_has_succeeded || !run.has_struck) return false;
      bool is_seen = false;
      for (const SeenRun& each : *well) {
        if (each.answers != run.answers) continue;
        if (!each.leaf_has_succeeded) return false;
        is_seen = true;
      }
      return is_seen;
    });
    ++compared;
    const bool found = row.harm == Harm::Silent;
    silent += found ? 1 : 0;
    if (expected && !found) {
      return fmt::format("{}: nobody notices", told(tree, row.faults));
    }
    if (found && !expected && row.ended_in <= kTicks) {
      return fmt::format("{}: somebody notices", told(tree, row.faults));
    }
  }
  return "";
}

// What stands below some node is not heard: the same rows of all others, but
// that fewer may notice.
std::string unheard_difference(const RandomMission& mission, Counts& counts) {
  const BehaviorTree& tree = mission.input.tree;
  const auto whole = what_if(mission.input, options(1));
  if (!whole.value) return "it is refused";
  for (std::uint32_t top = 1; top < tree.nodes.size(); ++top) {
    if (is_leaf(tree.nodes[top].type)) continue;
    WhatIfOptions how = options(1);
    how.heard.resize(tree.nodes.size(), true);
    for (std::uint32_t n = top + 1; n < tree.nodes.size(); ++n) {
      const NodeId above = tree.nodes[n].parent;
      how.heard[n] = tree.nodes[n].is_root() ||
                     (index(above) != top && how.heard[index(above)]);
    }
    const auto part = what_if(mission.input, how);
    if (!part.value) return "it is refused";
    const auto at = [&] { return fmt::format("below {}, ", top); };
    if (word(part.value->healthy) != word(whole.value->healthy)) {
      return at() + fmt::format("without faults: {}\n  whole {}",
                                word(part.value->healthy),
                                word(whole.value->healthy));
    }
    if (!part.value->error.empty()) return at() + part.value->error;
    std::size_t expected = 0;
    for (const FaultRow& row : whole.value->rows) {
      if (!how.heard[index(row.faults[0].leaf)]) continue;
      ++expected;
      const auto same =
          std::ranges::find(part.value->rows, row.faults, &FaultRow::faults);
      if (same == part.value->rows.end()) {
        return at() + told(tree, row.faults) + "is missing";
      }
      std::vector<bool> asked = row.asked;
      for (std::size_t n = 0; n < asked.size(); ++n) {
        asked[n] = asked[n] && how.heard[n];
      }
      const bool may_differ =
          same->harm == Harm::Silent || row.harm == Harm::LeftOn;
      if (word(row.effect) != word(same->effect) ||
          asked_text(tree, asked) != asked_text(tree, same->asked) ||
          (row.harm != same->harm && !may_differ)) {
        return at() + fmt::format("{}: {}, {}\n  whole {}, {}",
                                  told(tree, row.faults),
                                  facts_of(same->harm).word, word(same->effect),
                                  facts_of(row.harm).word, word(row.effect));
      }
      ++counts[same->harm];
    }
    if (part.value->rows.size() != expected) return at() + "too many rows";
  }
  return "";
}

// Small, and with no timer of an hour.
bool is_small(const BehaviorTree& tree) {
  return tree.nodes.size() <= 10 &&
         std::ranges::none_of(tree.nodes, [](const Node& node) {
           return node.duration && node.duration->max > 60 &&
                  node.duration->max != kUnboundedTicks;
         });
}

template <class Difference>
void compare(std::uint64_t first, std::uint64_t count, Difference difference,
             std::optional<RandomMission> (*draw)(std::uint64_t) = mission) {
  int differences = 0;
  for (std::uint64_t i = 0; i < count && differences < 3; ++i) {
    const auto drawn = draw(first * 1'000'003 + i);
    if (!drawn || !is_small(drawn->input.tree)) continue;
    const std::string found = difference(*drawn);
    if (found.empty()) continue;
    ++differences;
    FAIL_CHECK(drawn->text << found << " (seed " << i << ")");
  }
}

}  // namespace

TEST_CASE("each fault does what it does when it is put in by hand") {
  Counts counts;
  compare(
      seed_or(1), by_effort<std::uint64_t>(100, 2000),
      [&](const RandomMission& drawn) { return difference(drawn, counts); });
  MESSAGE("rows:" << told(counts));
  for (const Harm harm : {Harm::NeverEnds, Harm::Throws, Harm::Fails,
                          Harm::MayFail, Harm::Survives, Harm::NotAsked}) {
    CHECK_COVERED(counts[harm] > 5);
  }
}

TEST_CASE("so it is in .btf trees, with what leaves write") {
  Counts counts;
  std::size_t compared = 0;
  compare(
      seed_or(3), by_effort<std::uint64_t>(150, 3000),
      [&](const RandomMission& drawn) { return difference(drawn, counts); },
      btf_mission);
  for (const auto& [harm, count] : counts) compared += count;
  MESSAGE(compared << " rows");
  CHECK_COVERED(compared > 300);
}

TEST_CASE("a part that is seen from outside leaves the rows of all others") {
  Counts counts;
  for (auto* draw : {mission, btf_mission}) {
    compare(
        seed_or(7), by_effort<std::uint64_t>(100, 2000),
        [&](const RandomMission& drawn) {
          return unheard_difference(drawn, counts);
        },
        draw);
  }
  MESSAGE("rows:" << told(counts));
  for (const Harm harm : {Harm::Silent, Harm::NeverEnds, Harm::Throws,
                          Harm::Fails, Harm::MayFail, Harm::Survives}) {
    CHECK_COVERED(counts[harm] > 5);
  }
}

TEST_CASE("cut sets are those of every pair") {
  std::size_t pairs = 0;
  compare(seed_or(5), by_effort<std::uint64_t>(30, 600),
          [&](const RandomMission& drawn) {
            return cut_set_difference(drawn, pairs);
          });
  MESSAGE(pairs << " pairs");
  CHECK_COVERED(pairs > 200);
}

TEST_CASE("a loss is silent where no answer differs from a healthy run's") {
  std::size_t compared = 0;
  std::size_t silent = 0;
  compare(seed_or(9), by_effort<std::uint64_t>(60, 1000),
          [&](const RandomMission& drawn) {
            return silence_difference(drawn, compared, silent);
          });
  MESSAGE(compared << " faults, " << silent << " silent");
  CHECK_COVERED(silent > 5);
}

}  // namespace btcheck::reference::whatif_cross_check_test

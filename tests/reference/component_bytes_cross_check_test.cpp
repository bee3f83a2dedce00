// SPDX-License-Identifier: MIT
//
// Components of random trees as bytes, and back: the same component; of what is
// cut off or changed none; and of what somebody has changed on purpose, with a
// seal that is right, none that leads out of itself.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "explore/components/component.hpp"
#include "explore/components/component_bytes.hpp"
#include "explore/components/composition.hpp"
#include "explore/state/split_mix.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/kept_bytes.hpp"
#include "reference/reduction_cases.hpp"

namespace btcheck::reference::component_bytes_cross_check_test {
namespace {

constexpr std::size_t kSealBytes = 16;
// What is made up may have as many states as it is let.
constexpr ComponentTable::Limits kLimits = {.states = 2'000};

struct Census {
  std::size_t components = 0;
  std::size_t nothings = 0;
  std::size_t changed = 0;
  std::size_t believed = 0;  // changed, and still a component
  std::size_t fitting = 0;   // that who asks takes as well
};

// All components of the network; nothing else is asked of them.
void ask_for_all(const Network& network, ComponentStore& store) {
  ComponentTable table(network,
                       std::vector<bool>(network.variables.size(), false),
                       kLimits, &store);
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (network.automata[a].kind != AutomatonKind::Node) continue;
    table.of(AutomatonId{a});
    table.of(AutomatonId{a}, PartSide::Outside);
  }
}

// Composed, compiled, and looked at.
void compose(const Network& network, ComponentStore& store) {
  ComponentTable table(network,
                       std::vector<bool>(network.variables.size(), false),
                       kLimits, &store);
  std::vector<bool> kept(network.automata.size(), false);
  for (const AutomatonId root : table.roots()) kept[index(root)] = true;
  const Composition composition(table, kept, true);
  const CompiledNetwork compiled(composition.network());
}

std::string difference(const Component& one, const Component& other) {
  if (one.content != other.content) return "content";
  if (one.spoken_of != other.spoken_of) return "spoken_of";
  if (one.later != other.later) return "later";
  if (one.is_instant != other.is_instant) return "is_instant";
  if (one.size() != other.size()) return "size";
  if (one.place_count() != other.place_count()) return "place_count";
  if (one.bytes() != other.bytes()) return "bytes";
  if (one.automaton.location_names() != other.automaton.location_names()) {
    return "locations";
  }
  if (one.automaton.locals != other.automaton.locals) return "locals";
  return {};
}

std::string flaw_of(ComponentStore& store, const KeptBytes& kept,
                    Census& census) {
  for (const auto& [key, bytes] : kept.all) {
    const ContentHash content{key.first, key.second};
    const auto known = store.find(content);
    const auto again = component_in(bytes, content);
    if (!known || !again) return "what is known is not read";
    if ((*known == nullptr) != (*again == nullptr)) return "none";
    if (component_in(bytes, {content.high, content.low + 1})) {
      return "of another content";
    }
    if (*again == nullptr) {
      ++census.nothings;
      continue;
    }
    ++census.components;
    if (bytes_of(again->get(), content) != bytes) return "other bytes";
    const std::string other = difference(**known, **again);
    if (!other.empty()) return other;
  }
  return {};
}

}  // namespace

TEST_CASE("components are what they were once they have been bytes") {
  Census census;
  for_reduction_cases(331, by_effort(60, 800), [&](const auto& each) {
    ComponentStore store;
    const auto kept = std::make_shared<KeptBytes>();
    store.keep_in(kept);
    ask_for_all(each.network, store);
    const std::string wrong = flaw_of(store, *kept, census);
    CHECK(kept->refused == 0);
    if (wrong.empty()) return GoOn::Yes;
    FAIL(fmt::format("seed {}, tick {}\n{}\n{}", each.seed,
                     tick_name(each.ticks), each.text, wrong));
    return GoOn::No;
  });
  MESSAGE(census.components << " components, " << census.nothings
                            << " parts that are none");
  CHECK_COVERED(census.components > 500);
}

// Which random trees hardly have.
TEST_CASE("a round of an unknown number is one once it has been bytes") {
  const auto tree = read_tree(
      "t.xml",
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">"
      "<BehaviorTree ID=\"T\"><Sequence><Repeat num_cycles=\"-1\">"
      "<Fallback><Action ID=\"Go\"/><Action ID=\"Wait\"/></Fallback></Repeat>"
      "<Action ID=\"End\"/></Sequence></BehaviorTree></root>",
      {});
  REQUIRE(tree.value);
  const Network network = lower(*tree.value, TickSemantics::Root);
  ComponentStore store;
  const auto kept = std::make_shared<KeptBytes>();
  store.keep_in(kept);
  ask_for_all(network, store);
  Census census;
  CHECK(flaw_of(store, *kept, census) == "");
  std::size_t rounds = 0;
  for (const auto& [key, bytes] : kept->all) {
    const auto known = component_in(bytes, {key.first, key.second});
    REQUIRE(known);
    if (*known == nullptr) continue;
    for (const Edge& edge : (*known)->automaton.edges) {
      rounds += edge.is_like_time;
    }
  }
  CHECK(rounds > 0);
}

TEST_CASE("bytes that are cut off or changed are no component") {
  std::size_t tried = 0;
  for_reduction_cases(332, by_effort(3, 30), [&](const auto& each) {
    ComponentStore store;
    const auto kept = std::make_shared<KeptBytes>();
    store.keep_in(kept);
    ask_for_all(each.network, store);
    for (const auto& [key, bytes] : kept->all) {
      if (bytes.size() > 3000) continue;
      const ContentHash content{key.first, key.second};
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        CHECK_FALSE(
            component_in(std::string_view(bytes).substr(0, size), content));
      }
      CHECK_FALSE(component_in(bytes + '\0', content));
      for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
        CHECK_FALSE(component_in(changed, content));
        ++tried;
      }
    }
    return GoOn::Yes;
  });
  CHECK_COVERED(tried > 10'000);
}

// With a seal as if they had been written so. What a component does is believed
// then; a sanitizer sees where it has a number of what is not there.
TEST_CASE("bytes that are made up lead nowhere") {
  Census census;
  SplitMix64 random(shifted_seed(333));
  for_reduction_cases(333, by_effort(25, 300), [&](const auto& each) {
    ComponentStore store;
    const auto kept = std::make_shared<KeptBytes>();
    store.keep_in(kept);
    ask_for_all(each.network, store);
    for (int round = 0; round < 8; ++round) {
      const auto made_up = std::make_shared<KeptBytes>();
      for (const auto& [key, bytes] : kept->all) {
        const ContentHash content{key.first, key.second};
        std::string changed = bytes.substr(0, bytes.size() - kSealBytes);
        const std::size_t times = random.below(3);
        for (std::size_t i = 0; i < times; ++i) {
          const auto at = static_cast<std::size_t>(
              random.below(static_cast<int>(changed.size())));
          const std::size_t way = random.below(4);
          if (way == 0) {
            changed[at] = static_cast<char>(random.below(256));
          } else if (way == 1) {
            ++changed[at];
          } else if (way == 2) {
            changed.erase(at, 1);
          } else {
            changed.insert(at, 1, static_cast<char>(random.below(256)));
          }
          if (changed.empty()) break;
        }
        changed = sealed(std::move(changed), content);
        ++census.changed;
        const auto known = component_in(changed, content);
        census.believed += known && *known != nullptr;
        made_up->all[key] = std::move(changed);
      }
      ComponentStore believing;
      believing.keep_in(made_up);
      ask_for_all(each.network, believing);
      compose(each.network, believing);
      census.fitting += made_up->found - made_up->refused;
    }
    return GoOn::Yes;
  });
  MESSAGE(census.changed << " contents, " << census.believed << " components, "
                         << census.fitting << " taken");
  CHECK_COVERED(census.believed > 1000);
  CHECK_COVERED(census.fitting > 100);
}

}  // namespace btcheck::reference::component_bytes_cross_check_test

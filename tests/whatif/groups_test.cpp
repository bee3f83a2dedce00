// SPDX-License-Identifier: MIT
//
// Groups stand for what was grouped, no more and no less.
#include "report/whatif/groups.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace btcheck::whatif_groups_test {
namespace {

using Sets = std::multiset<std::vector<std::pair<std::uint32_t, int>>>;

std::pair<std::uint32_t, int> plain(NodeId leaf, FaultKind kind) {
  return {index(leaf), static_cast<int>(kind)};
}

InjectedFault fault(std::uint32_t leaf, int kind) {
  return {NodeId{leaf}, {static_cast<FaultKind>(kind), 0}};
}

Sets as_they_are(const FaultSets& sets, std::size_t size) {
  Sets all;
  for (const auto& set : sets) {
    if (set.size() != size) continue;
    std::vector<std::pair<std::uint32_t, int>> added;
    for (const InjectedFault& each : set) {
      added.push_back(plain(each.leaf, each.fault.kind));
    }
    all.insert(added);
  }
  return all;
}

Sets expanded(const std::vector<FaultGroup>& groups) {
  Sets all;
  for (const FaultGroup& group : groups) {
    for (const NodeId leaf : group.leaves) {
      for (const FaultKind kind : group.kinds) all.insert({plain(leaf, kind)});
    }
    CHECK(group.places.size() == group.leaves.size() * group.kinds.size());
  }
  return all;
}

Sets expanded(const std::vector<PairGroup>& groups) {
  Sets all;
  for (const PairGroup& group : groups) {
    for (const NodeId one : group.first.leaves) {
      for (const FaultKind kind : group.first.kinds) {
        for (const NodeId other : group.second.leaves) {
          for (const FaultKind more : group.second.kinds) {
            all.insert({plain(one, kind), plain(other, more)});
          }
        }
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("groups expand to what was grouped") {
  std::mt19937 random(7);
  std::size_t fewer = 0;
  for (int round = 0; round < 300; ++round) {
    const auto below = [&](std::uint32_t most) {
      return static_cast<int>(random() % most);
    };
    std::set<std::vector<std::pair<std::uint32_t, int>>> chosen;
    const auto leaves = static_cast<std::uint32_t>(2 + below(3u));
    for (int i = 0; i < 20; ++i) {
      const auto one = static_cast<std::uint32_t>(below(leaves));
      const auto other = leaves + static_cast<std::uint32_t>(below(leaves));
      if (below(2) == 0) {
        chosen.insert({{one, below(3)}});
      } else {
        chosen.insert({{one, below(3)}, {other, below(3)}});
      }
    }
    FaultSets sets;
    for (const auto& each : chosen) {
      sets.emplace_back();
      for (const auto& [leaf, kind] : each) {
        sets.back().push_back(fault(leaf, kind));
      }
    }
    std::ranges::shuffle(sets, random);
    std::vector<std::string> said;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      said.push_back(below(3) == 0 ? "a" : "b");
    }
    const auto singles = grouped_singles(sets, said);
    const auto pairs = grouped_pairs(sets, said);
    CHECK(expanded(singles) == as_they_are(sets, 1));
    CHECK(expanded(pairs) == as_they_are(sets, 2));
    fewer += singles.size() + pairs.size() < sets.size();
    // What is grouped says the same.
    for (const FaultGroup& group : singles) {
      for (const std::size_t place : group.places) {
        CHECK(said[place] == said[group.places[0]]);
        CHECK(sets[place].size() == 1);
      }
    }
    std::set<std::size_t> places;
    for (const PairGroup& group : pairs) {
      for (const std::size_t place : group.places) {
        CHECK(said[place] == said[group.places[0]]);
        CHECK(places.insert(place).second);
      }
    }
  }
  CHECK(fewer > 250);
}

TEST_CASE("numbers of rows are told as ranges") {
  CHECK(ranges_text({}, 0) == "");
  CHECK(ranges_text({0}, 0) == "1");
  CHECK(ranges_text({4, 0, 1, 2}, 0) == "1-3, 5");
  CHECK(ranges_text({0, 1}, 78) == "79-80");
}

}  // namespace btcheck::whatif_groups_test

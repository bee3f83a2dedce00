// SPDX-License-Identifier: MIT
#include "report/whatif/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace btcheck {
namespace {

void append(std::vector<std::size_t>& to,
            const std::vector<std::size_t>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

template <class Value>
void add_new(std::vector<Value>& to, Value value) {
  if (std::ranges::find(to, value) == to.end()) to.push_back(value);
}

template <class Group>
struct Said {
  std::string text;
  Group group;
};

// Puts together what is alike, at the place of the first.
template <class Group, class IsAlike, class Join>
std::vector<Said<Group>> joined(std::vector<Said<Group>> all, IsAlike is_alike,
                                Join join) {
  std::vector<Said<Group>> kept;
  for (Said<Group>& each : all) {
    const auto found =
        std::ranges::find_if(kept, [&](const Said<Group>& other) {
          return other.text == each.text && is_alike(other.group, each.group);
        });
    if (found == kept.end()) {
      kept.push_back(std::move(each));
    } else {
      join(found->group, each.group);
      append(found->group.places, each.group.places);
    }
  }
  return kept;
}

template <class Group>
std::vector<Group> without_words(std::vector<Said<Group>> all) {
  std::vector<Group> groups;
  for (Said<Group>& each : all) groups.push_back(std::move(each.group));
  return groups;
}

FaultGroup group_of(const InjectedFault& fault) {
  return {{fault.leaf}, {fault.fault.kind}, {}};
}

bool has_same_leaves(const FaultGroup& one, const FaultGroup& other) {
  return one.leaves == other.leaves;
}
bool has_same_kinds(const FaultGroup& one, const FaultGroup& other) {
  return one.kinds == other.kinds;
}
void add_kinds(FaultGroup& to, const FaultGroup& more) {
  for (const FaultKind kind : more.kinds) add_new(to.kinds, kind);
}
void add_leaves(FaultGroup& to, const FaultGroup& more) {
  for (const NodeId leaf : more.leaves) add_new(to.leaves, leaf);
}

}  // namespace

std::vector<FaultGroup> grouped_singles(const FaultSets& sets,
                                        const std::vector<std::string>& said) {
  std::vector<Said<FaultGroup>> all;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i].size() != 1) continue;
    all.push_back({said[i], group_of(sets[i][0])});
    all.back().group.places = {i};
  }
  all = joined(std::move(all), has_same_leaves, add_kinds);
  return without_words(joined(std::move(all), has_same_kinds, add_leaves));
}

std::vector<PairGroup> grouped_pairs(const FaultSets& sets,
                                     const std::vector<std::string>& said) {
  using Group = PairGroup;
  std::vector<Said<Group>> all;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i].size() != 2) continue;
    all.push_back({said[i], {group_of(sets[i][0]), group_of(sets[i][1]), {i}}});
  }
  const auto join = [&](auto same_first, auto same_second, auto add) {
    all = joined(
        std::move(all),
        [&](const Group& one, const Group& other) {
          return same_first(one.first, other.first) &&
                 same_second(one.second, other.second);
        },
        add);
  };
  const auto is_same = [](const FaultGroup& one, const FaultGroup& other) {
    return has_same_leaves(one, other) && has_same_kinds(one, other);
  };
  join(is_same, has_same_leaves,
       [](Group& to, const Group& more) { add_kinds(to.second, more.second); });
  join(has_same_leaves, is_same,
       [](Group& to, const Group& more) { add_kinds(to.first, more.first); });
  join(is_same, has_same_kinds, [](Group& to, const Group& more) {
    add_leaves(to.second, more.second);
  });
  join(has_same_kinds, is_same,
       [](Group& to, const Group& more) { add_leaves(to.first, more.first); });
  return without_words(std::move(all));
}

std::string ranges_text(std::vector<std::size_t> places, std::size_t before) {
  std::ranges::sort(places);
  std::string text;
  for (std::size_t i = 0; i < places.size();) {
    std::size_t last = i;
    while (last + 1 < places.size() && places[last + 1] == places[last] + 1) {
      ++last;
    }
    if (!text.empty()) text += ", ";
    text += fmt::format("{}", before + places[i] + 1);
    if (last > i) text += fmt::format("-{}", before + places[last] + 1);
    i = last + 1;
  }
  return text;
}

}  // namespace btcheck

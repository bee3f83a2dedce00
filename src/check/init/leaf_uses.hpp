// SPDX-License-Identifier: MIT
//
// How the trees of a project use their leaves: what most of them do may well be
// what is meant in all of them.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "model/tree/tree.hpp"

namespace btcheck {

class LeafUses {
 public:
  void add(const BehaviorTree& tree);

  // Contracts that say what is done in most places, at least in two: a
  // condition that is asked as long as an action runs, a failure that nobody
  // hears of. Each is a comment, with how often it is so; "" where there are
  // none.
  std::string proposals() const;

 private:
  struct Count {
    std::size_t yes = 0;
    std::size_t all = 0;

    bool is_mostly_so() const { return yes >= 2 && 2 * yes > all; }
    bool operator==(const Count&) const = default;
  };
  void add_guards(const BehaviorTree& tree, const Node& above);

  // By condition and action: where both stand below one node, the condition is
  // asked as long as the action runs. By action: it is forgiven.
  std::map<std::pair<std::string, std::string>, Count> asked_;
  std::map<std::string, Count> forgiven_;
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The ways to name a node in a property.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck {

// Looks nodes up by what a user writes: the name or :ID, the end of a path
// (`fail_mission/land`), a name with its line (`land@23`), a unique name
// (`land_btn12`), a pre-order number (`btn12`), or the paper's process number
// (`drone/8`). Matches in the same case go before others.
class NodeNames {
 public:
  // The tree must outlive it.
  explicit NodeNames(const BehaviorTree& tree);

  // Every node that a reference fits.
  std::vector<NodeId> called(std::string_view reference) const;

  // True when it fits some only without regard to case.
  bool differs_in_case(std::string_view reference) const;

  // "did you mean `land`? there are 3: …", or "" when nothing is near; looks
  // at the names of state variables as well.
  std::string nearest_help(std::string_view reference) const;
  // How a property may name the nodes: "`land@23`, `land@31`, …".
  std::string references_to(const std::vector<NodeId>& nodes) const;

 private:
  std::vector<NodeId> matches(std::string_view reference, bool any_case) const;
  std::optional<NodeId> by_process(std::string_view reference) const;

  const BehaviorTree& tree_;
  std::vector<NodeId> in_post_order_;
  std::size_t first_process_ = 1;  // the number of in_post_order_[0]
};

}  // namespace btcheck

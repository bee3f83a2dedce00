// SPDX-License-Identifier: MIT
//
// Which node a name means, seen from another node.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btf/keywords.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

class NodeNames {
 public:
  explicit NodeNames(const BehaviorTree& tree);

  // The node that `word` (a name, or a unique name such as `land_btn12`) means
  // inside the tree form that `from` belongs to: the innermost one that has
  // the name, then those around it, then the whole file. Errors: BT1014 at
  // `place`, when there is none or more than one.
  std::optional<NodeId> find(const Reading& reading, const Form& place,
                             std::string_view word, NodeId from) const;

 private:
  std::optional<NodeId> find_unique_name(std::string_view word) const;
  std::vector<NodeId> candidates(const std::vector<NodeId>& all,
                                 std::string_view word, NodeId from) const;
  void report_unknown(const Reading& reading, const Form& place,
                      std::string_view word) const;
  void report_ambiguous(const Reading& reading, const Form& place,
                        std::string_view word,
                        const std::vector<NodeId>& candidates) const;

  const BehaviorTree& tree_;
  std::map<std::string, std::vector<NodeId>, std::less<>> by_name_;
  std::vector<NodeId> scope_;  // the SubTree or root a node stands in
  std::vector<NodeId> end_;    // the node after the last below it
};

}  // namespace btcheck::btf

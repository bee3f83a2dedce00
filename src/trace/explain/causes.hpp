// SPDX-License-Identifier: MIT
//
// The answers that decided how a run ended, from the root down.
#pragma once

#include <cstddef>
#include <vector>

#include "trace/explain/moments.hpp"

namespace btcheck {

// A node did that, because nodes below it did what they did.
struct Cause {
  NodeId node{};
  Happening what{};
  std::vector<std::size_t> at;  // moments, ascending
  std::vector<Cause> because;   // in the order of the tree
};

// Of the last mission of the log. What a node answered is put down to those
// children that had answered the same last, while it worked; where there are
// none, to what children answered at all, and then to those that were halted.
// Why it runs still, or was left by an exception, to those that did, too.
// Nothing where the log has no record.
std::vector<Cause> causes_of(const LogMoments& moments);

// Nodes at the end of the chain, each once, in their order.
std::vector<NodeId> first_causes(const std::vector<Cause>& causes);

}  // namespace btcheck

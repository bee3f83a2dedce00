// SPDX-License-Identifier: MIT
//
// The steps of a stored graph, backwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "explore/search/stored_graph.hpp"

namespace btcheck {

// By state, where its steps come from: 4 bytes a step, 8 a state.
class Predecessors {
 public:
  explicit Predecessors(const StoredGraph& graph);

  std::span<const std::uint32_t> of(std::size_t state) const {
    return {sources_.data() + first_[state],
            sources_.data() + first_[state + 1]};
  }
  std::size_t bytes() const {
    return first_.capacity() * sizeof(std::uint64_t) +
           sources_.capacity() * sizeof(std::uint32_t);
  }

  // The states with a step into `target`.
  StateSet before(const StateSet& target) const;

  // The states from which a path leads into `target` all of whose states but
  // the last are in `hold`; those of `target` among them.
  StateSet leading_to(const StateSet& hold, const StateSet& target) const;

 private:
  std::vector<std::uint64_t> first_;  // by state: its first source
  std::vector<std::uint32_t> sources_;
};

}  // namespace btcheck

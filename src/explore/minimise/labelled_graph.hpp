// SPDX-License-Identifier: MIT
//
// A graph of which nothing is known but the labels of its steps: what is
// compared and minimised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace btcheck {

// States 0, 1, …, the first of them where runs begin; steps by source. A label
// is a number that says what an observer sees of a step; what it stands for is
// its maker's business.
class LabelledGraph {
 public:
  // Of a step that nobody sees ("tau").
  static constexpr std::uint32_t kSilent = 0;

  struct Arc {
    std::uint32_t label = kSilent;
    std::uint32_t target = 0;

    friend auto operator<=>(const Arc&, const Arc&) = default;
  };

  LabelledGraph() { first_.push_back(0); }

  // One more state, of which `arcs` are the steps. They may lead to states that
  // are added later.
  void add_state(std::span<const Arc> arcs) {
    arcs_.insert(arcs_.end(), arcs.begin(), arcs.end());
    first_.push_back(arcs_.size());
  }

  std::size_t size() const { return first_.size() - 1; }
  std::size_t arc_count() const { return arcs_.size(); }
  std::size_t bytes() const {
    return first_.capacity() * sizeof(first_[0]) +
           arcs_.capacity() * sizeof(Arc);
  }
  std::span<const Arc> arcs(std::uint32_t state) const {
    return {arcs_.data() + first_[state], arcs_.data() + first_[state + 1]};
  }

  friend bool operator==(const LabelledGraph&, const LabelledGraph&) = default;

 private:
  std::vector<std::uint64_t> first_;  // by state: its first arc
  std::vector<Arc> arcs_;
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The strongly connected components of a graph: Tarjan's (1972), with an
// explicit stack and one number for each state, as Pearce does it (2016): open
// states count upwards from 1, components downwards from the greatest number,
// so one comparison also tells whether a state is already in a component.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace btcheck {

// `ArcsOf`: callable as arcs_of(state), a span.
template <class ArcsOf>
class ComponentSearch {
 public:
  // Instead of a component: the state was never entered.
  static constexpr std::uint32_t kOutside = 0xffffffff;

  ComponentSearch(std::size_t states, ArcsOf arcs_of)
      : arcs_of_(std::move(arcs_of)), number_(states, kUnseen) {}

  // `target_of(arc)`: kOutside where the arc is not to be followed.
  template <class TargetOf>
  void search_from(std::uint32_t start, TargetOf target_of) {
    if (number_[start] != kUnseen) return;
    enter(start);
    while (!path_.empty()) {
      Frame& frame = path_.back();
      if (frame.next == end_of(frame.state)) {
        leave();
        continue;
      }
      const std::uint32_t target = target_of(*frame.next);
      if (target == kOutside) {
        ++frame.next;
      } else if (number_[target] == kUnseen) {
        enter(target);  // and look at this arc once more afterwards
      } else {
        ++frame.next;
        if (number_[target] < number_[frame.state]) {
          number_[frame.state] = number_[target];
          frame.is_root = false;
        }
      }
    }
  }

  // By state. A component that another leads to has the smaller number, and the
  // numbers begin at 0.
  std::vector<std::uint32_t> take_components() {
    for (std::uint32_t& number : number_) number = ~number;
    return std::move(number_);
  }

 private:
  using Arcs = std::invoke_result_t<ArcsOf, std::uint32_t>;
  static constexpr std::uint32_t kUnseen = 0;
  static_assert(~kUnseen == kOutside);

  struct Frame {
    typename Arcs::pointer next;
    std::uint32_t state;
    bool is_root;  // nothing older was found to be reachable
  };

  void enter(std::uint32_t state) {
    number_[state] = ++last_seen_;
    path_.push_back({arcs_of_(state).data(), state, true});
  }

  typename Arcs::pointer end_of(std::uint32_t state) const {
    const Arcs arcs = arcs_of_(state);
    return arcs.data() + arcs.size();
  }

  void leave() {
    const std::uint32_t state = path_.back().state;
    const bool is_root = path_.back().is_root;
    path_.pop_back();
    if (!is_root) {
      open_.push_back(state);
      return;
    }
    while (!open_.empty() && number_[open_.back()] >= number_[state]) {
      number_[open_.back()] = next_component_;
      open_.pop_back();
    }
    number_[state] = next_component_--;
  }

  ArcsOf arcs_of_;
  std::vector<std::uint32_t> number_;  // by state
  std::vector<std::uint32_t> open_;    // left, and in no component yet
  std::vector<Frame> path_;
  std::uint32_t last_seen_ = kUnseen;
  std::uint32_t next_component_ = ~std::uint32_t{0};
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Whether somebody notices a fault: the tree is watched from outside, and the
// first answer that no healthy run could have given there is a notice.
//
// The leaf that has the fault is not listened to. So the healthy runs that may
// be going on are followed as a set of places in their graph (a subset
// construction), along each run with the fault.
#pragma once

#include <array>
#include <boost/container_hash/hash.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "check/whatif/answer_graph.hpp"
#include "check/whatif/faults.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// The healthy runs that look the same so far to all but one leaf. What is found
// out for one fault of the leaf is known for the next.
class HealthyRuns {
 public:
  using Places = std::uint32_t;

  // Both must outlive it.
  HealthyRuns(const BehaviorTree& tree, const AnswerGraph& healthy,
              NodeId leaf);

  NodeId leaf() const { return leaf_; }
  static constexpr Places kStart = 0;
  // Behind one more event; nothing where no healthy run has it.
  std::optional<Places> after(Places places, NodeEvent event);
  // Whether the leaf's last answer was success on each of them that ends the
  // mission well.
  bool is_done(Places places) const;
  // Whether it is an answer of the leaf's tree, by another node.
  bool is_heard(NodeEvent event) const {
    return is_answer(event.what()) && event.node() != leaf_ &&
           is_in_tree_[index(event.node())];
  }

 private:
  // An arc, how far its events are done, and whether the leaf has succeeded in
  // its last answer; or the end of the mission.
  using Place = std::uint64_t;
  static constexpr Place kEnd = Place{1} << 63;
  static constexpr std::size_t kMostEvents = 1u << 20;
  static Place place(std::uint32_t arc, std::size_t done, bool succeeded) {
    return Place{arc} << 21 | Place{done} << 1 | (succeeded ? 1 : 0);
  }
  struct Read {
    const AnswerGraph::Arc& arc;
    std::span<const NodeEvent> events;
    std::size_t done;
    bool succeeded;
  };
  Read read(Place place) const;
  bool is_before(Place place, NodeEvent event) const;
  Places intern(std::vector<Place> places);
  void add_from(std::uint32_t state, bool succeeded,
                std::vector<Place>& places);
  void go_on(Read at, std::uint32_t arc, std::vector<Place>& places,
             std::vector<std::pair<std::uint32_t, bool>>& open) const;

  const AnswerGraph& healthy_;
  NodeId leaf_;
  std::vector<bool> is_in_tree_;  // by node
  // By state and `succeeded`: the closure that came there.
  std::array<std::vector<std::uint32_t>, 2> seen_;
  std::uint32_t closure_ = 0;
  std::unordered_map<std::vector<Place>, Places,
                     boost::hash<std::vector<Place>>>
      known_;
  std::vector<const std::vector<Place>*> sets_;  // by number
  std::unordered_map<std::uint64_t, std::optional<Places>> after_;
};

struct Silence {
  // A run on which the mission succeeds, what the leaf is for was not done, and
  // nobody notices: the numbers of its arcs.
  std::optional<std::vector<std::uint32_t>> run;
  // From when the fault strikes until somebody notices, or the mission ends:
  // the most ticks; nothing where there is no such number.
  std::optional<int> within;
  bool is_known = true;  // false: too many sets to follow
};

// `faulty` is the graph of the tree with that one fault, of the leaf that
// `healthy` does not listen to.
Silence silence_of(const BehaviorTree& tree, HealthyRuns& healthy,
                   const AnswerGraph& faulty, const InjectedFault& fault);

// Who notices on a run, and when.
struct Notice {
  NodeId node{};
  Happening what{};
  int ticks = 0;  // since the fault has struck; 0: in the same tick
};
std::optional<Notice> notice_on(const BehaviorTree& tree, HealthyRuns& healthy,
                                const std::vector<NodeEvent>& run);

}  // namespace btcheck

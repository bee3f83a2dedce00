// SPDX-License-Identifier: MIT
//
// A log as what the nodes of its tree have done, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/whatif/answer_graph.hpp"
#include "model/tree/tree.hpp"
#include "trace/conform/conform.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {

struct Moment {
  NodeId node{};
  Happening what{};
  std::int64_t tick = 0;    // from 1
  std::int64_t time = 0;    // microseconds since the log began
  std::size_t records = 0;  // that the log has by then, its own included
};

enum class Outcome : std::uint8_t {
  Nothing,  // the log has no record
  Success,
  Failure,
  Exception,  // an exception left the tree
  Running     // the log ends before the tree does
};

// From where the tree began to where it ended, in moments.
struct Mission {
  std::size_t begin = 0;
  std::size_t end = 0;
  Outcome outcome = Outcome::Nothing;
};

class LogMoments {
 public:
  LogMoments(const BehaviorLog& log, const LoggedNodes& nodes,
             const LogReading& reading);

  const std::vector<Moment>& all() const { return moments_; }
  const Moment& at(std::size_t moment) const { return moments_[moment]; }
  // A tree that is ticked again after its end has several. The last is that
  // which is asked about: what is left of the log behind an end, if it is no
  // more than nodes being halted, is none.
  const std::vector<Mission>& missions() const { return missions_; }
  const Mission& last() const { return missions_.back(); }

  std::int64_t last_tick() const { return last_tick_; }
  bool knows_ticks() const { return knows_ticks_; }
  // The node that all others are below.
  std::optional<NodeId> top() const { return top_; }
  // Nodes right below one, in their order.
  const std::vector<NodeId>& children(NodeId node) const {
    return children_[index(node)];
  }
  // That have begun and not answered when an exception left the tree: from the
  // top down.
  const std::vector<NodeId>& left_by_exception() const { return open_; }
  const std::string& exception() const { return exception_; }

  // Moments of a node from `begin` up to `end`, ascending.
  std::vector<std::size_t> of(NodeId node, std::size_t begin,
                              std::size_t end) const;
  // The last of them before `end`; nothing where there is none.
  std::optional<std::size_t> last_of(NodeId node, std::size_t begin,
                                     std::size_t end) const;

 private:
  class Reader;
  void part();

  std::vector<Moment> moments_;
  std::vector<Mission> missions_;
  std::vector<std::vector<NodeId>> children_;         // by node
  std::vector<std::vector<std::size_t>> moments_of_;  // by node
  std::vector<NodeId> open_;
  std::optional<NodeId> top_;
  std::string exception_;
  std::int64_t last_tick_ = 0;
  bool knows_ticks_ = false;
  bool is_left_ = false;
};

// The log as it was after so many records.
BehaviorLog first_records(const BehaviorLog& log, std::size_t records);

}  // namespace btcheck

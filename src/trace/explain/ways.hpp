// SPDX-License-Identifier: MIT
//
// Where a run could still have ended well, and how.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "check/whatif/answer_graph.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "trace/explain/moments.hpp"

namespace btcheck {

// A log, and the tree that is held to have written it.
struct ExplainedLog {
  const BehaviorLog& log;
  const LoggedNodes& nodes;
  const LogReading& reading;
  const LogMoments& moments;
};

// After so many records of its last mission a log could still go on to a
// success of the tree, and after one more it could not.
struct LastWay {
  std::size_t records = 0;
  // What decided it: of a leaf, where one did something there; else of another
  // node. Nothing where the log could go on so at its end, too.
  std::optional<std::size_t> moment;
  // From there a shortest way to success: what the leaves answer.
  std::vector<NodeEvent> way;
  int ticks = 0;  // that begin on it
};

class Ways {
 public:
  Ways(const BehaviorTree& tree, const Network& network, const Limits& limits);

  // Nothing where it could not succeed from the beginning of the mission on,
  // where a limit was reached, or where the tree cannot have written the log.
  std::optional<LastWay> last_way(const ExplainedLog& log);
  // Whether it was reached there, or no way was there at all.
  StopReason stopped() const { return stopped_; }
  bool is_hopeless() const { return is_hopeless_; }

  Conformance follow(const ExplainedLog& log) const;

  // Leaves that can be asked next, with nothing in between that a log shows;
  // unless it is known that one was asked, none where the tick may end before.
  std::vector<NodeId> asked_next(std::span<const StateVector> states,
                                 bool one_was_asked) const;

 private:
  struct Way {
    std::vector<NodeEvent> events;
    int ticks = 0;
  };
  std::optional<Way> way_to_success(std::span<const StateVector> states);
  std::optional<Way> way_after(const ExplainedLog& log, std::size_t records);
  std::optional<NodeEvent> told_by(std::uint32_t edge) const;

  const BehaviorTree& tree_;
  CompiledNetwork system_;
  const Limits& limits_;
  std::vector<std::optional<NodeEvent>> events_;  // by edge
  StopReason stopped_ = StopReason::None;
  bool is_hopeless_ = false;
};

}  // namespace btcheck

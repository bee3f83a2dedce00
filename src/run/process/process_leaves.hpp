// SPDX-License-Identifier: MIT
//
// Leaves in any language: a process that answers in lines of JSON
// (docs/run.md). Each question is answered once, one after the other.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "explore/state/step.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/leaves.hpp"
#include "run/process/line_process.hpp"
#include "run/process/message.hpp"

namespace btcheck {

struct ProcessPlan {
  std::string command;
  std::chrono::milliseconds within{1000};  // for an answer
  int tick_ms = 100;                       // that it is told
  std::optional<std::uint64_t> seed;       // likewise
};

// Tree and system must outlive it.
class ProcessLeaves : public Leaves {
 public:
  ProcessLeaves(const BehaviorTree& tree, const CompiledNetwork& system,
                ProcessPlan plan);

  // Starts the process and waits for it to be ready, ten seconds at most.
  // Returns what went wrong, or "".
  std::string begin();
  // Says how the run has ended, and waits for the process to end.
  void end(const std::string& how);

  Reply ask(const LeafQuestion& question) override;
  void halt(NodeId node) override;
  void await_halted() override;
  std::optional<VariableMove> next_move(int tick, StateView now) override;
  std::optional<Complaint> complaint() override;

 private:
  using Clock = LineProcess::Clock;

  // What has become of a question.
  struct Heard {
    std::optional<LeafMessage> answer;  // an AnswerMessage or a ValueMessage
    BreachKind breach = BreachKind::NoAnswer;  // else why there is none
    std::string text;
  };

  std::string question_line(std::uint64_t id, std::string_view what,
                            NodeId node) const;
  Heard exchange(std::uint64_t id, const std::string& line,
                 const std::string& who, std::chrono::milliseconds within);
  std::optional<Heard> take(const LeafMessage& message, std::uint64_t id,
                            const std::string& who);
  void hear_halted();
  void give_up_halts(BreachKind kind);
  void take_halted(const LeafMessage& message, const std::string& name);
  Reply reply_to(const LeafQuestion& question, const LeafMessage& message);
  void take_set(const SetMessage& message);
  void take_get(const GetMessage& message);
  void complain(BreachKind kind, std::string text);
  std::string gone_text();

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  ProcessPlan plan_;
  std::optional<LineProcess> process_;
  std::uint64_t last_id_ = 0;
  std::set<std::uint64_t> late_;  // questions given up
  // That are to halt: asked one after the other, and waited for together.
  struct Halt {
    std::uint64_t id = 0;
    std::string name;
  };
  std::vector<Halt> halts_;
  Clock::time_point halted_by_{};
  std::deque<Complaint> complaints_;
  bool has_gone_ = false;  // and that has been told
  std::deque<VariableMove> moves_;
  std::size_t left_for_tick_ = 0;  // of the moves
  int moved_in_tick_ = 0;
  StateVector state_;  // for `get`
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "reference/naive_engine.hpp"
#include "model/tree/node_types.hpp"

#include <algorithm>
#include <utility>

namespace btcheck::reference {
namespace {

using enum EngineStatus;

bool is_active(EngineStatus status) {
  return status != Idle && status != Skipped;
}
bool is_completed(EngineStatus status) {
  return status == Success || status == Failure;
}

bool is_decorator(const BehaviorTree&, const Node& node) {
  switch (node.type) {
    case NodeType::Inverter:
    case NodeType::ForceSuccess:
    case NodeType::ForceFailure:
    case NodeType::KeepRunningUntilFailure:
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
    case NodeType::RateController:
    case NodeType::SubTree:
    case NodeType::Precondition:
    case NodeType::Timeout:
    case NodeType::Delay:
    case NodeType::RunOnce:
    case NodeType::Loop:
    case NodeType::WhenUpdated:
    case NodeType::WhenDue:
    case NodeType::GoalUpdater:
    case NodeType::PathLongerOnApproach:
    case NodeType::SingleTrigger:
      return true;
    default:
      return false;
  }
}

EngineStatus of(NodeStatus status) {
  switch (status) {
    case NodeStatus::Success:
      return Success;
    case NodeStatus::Running:
      return Running;
    case NodeStatus::Skipped:
      return Skipped;
    default:
      return Failure;
  }
}

EngineStatus answer_named(const std::string& word) {
  if (word == "success") return Success;
  if (word == "failure") return Failure;
  if (word == "running") return Running;
  throw std::logic_error("no answer of a leaf: " + word);
}

}  // namespace

std::string status_word(EngineStatus status) {
  switch (status) {
    case Idle:
      return "idle";
    case Running:
      return "running";
    case Success:
      return "success";
    case Failure:
      return "failure";
    case Skipped:
      return "skipped";
  }
  return "";
}

NaiveEngine::NaiveEngine(const BehaviorTree& tree, Ask ask, Tell tell)
    : tree_(tree),
      ask_(std::move(ask)),
      tell_(std::move(tell)),
      status_(tree.nodes.size(), Idle),
      memory_(tree.nodes.size()) {}

EngineStatus NaiveEngine::tick_root(int tick) {
  now_ = tick;
  const NodeId top = node(tree_.roots[0]).children[0];
  const EngineStatus answer = execute(top);
  if (is_completed(answer)) status_[index(top)] = Idle;
  return answer;
}

std::vector<int> NaiveEngine::words() const {
  std::vector<int> words;
  for (std::size_t n = 0; n < status_.size(); ++n) {
    const Memory& known = memory_[n];
    const auto& duration = tree_.nodes[n].duration;
    // A timer that has run out has run out.
    const int most = duration ? duration->max : 0;
    const int since = known.since < 0 ? -1 : std::min(now_ - known.since, most);
    for (const int word :
         {static_cast<int>(status_[n]), static_cast<int>(known.child),
          known.count, known.failures, known.skipped, known.running_child,
          known.flag ? 1 : 0, known.other_flag ? 1 : 0, since}) {
      words.push_back(word);
    }
  }
  return words;
}

bool NaiveEngine::is_due(NodeId id) const {
  const Memory& known = memory_[index(id)];
  return known.since >= 0 && now_ - known.since >= node(id).duration->max;
}

EngineStatus NaiveEngine::execute(NodeId id) {
  called(id);
  const EngineStatus before = status(id);
  std::optional<EngineStatus> answer;
  if (!is_active(before)) {
    if (has(id, ScriptTime::FailureIf) && asks_true(id)) answer = Failure;
    if (!answer && has(id, ScriptTime::SuccessIf) && asks_true(id)) {
      answer = Success;
    }
    if (!answer && has(id, ScriptTime::SkipIf) && asks_true(id)) {
      answer = Skipped;
    }
    if (!answer && has(id, ScriptTime::While) && !asks_true(id)) {
      answer = Skipped;
    }
  } else if (before == Running && has(id, ScriptTime::While)) {
    if (!asks_true(id)) {
      halt(id);
      status_[index(id)] = Idle;
      answer = Skipped;
    }
  }
  if (!answer) answer = run(id);
  if (is_decorator(tree_, node(id)) &&
      is_completed(status(node(id).children[0]))) {
    status_[index(node(id).children[0])] = Idle;
  }
  if (*answer != Skipped) status_[index(id)] = *answer;
  tell_(id, status_word(*answer));
  return *answer;
}

void NaiveEngine::reset(NodeId id) {
  if (status(id) == Running) halt(id);
  status_[index(id)] = Idle;
}

void NaiveEngine::reset_children(NodeId id) {
  for (const NodeId child : node(id).children) reset(child);
}

EngineStatus NaiveEngine::after_reset(NodeId id, EngineStatus answer) {
  reset_children(id);
  return answer;
}

void NaiveEngine::halt(NodeId id) {
  Memory& known = memory(id);
  switch (node(id).type) {
    case NodeType::SequenceWithMemory:
      if (is_3()) known.child = 0;
      break;
    case NodeType::PersistentSequence:
    case NodeType::Precondition:
    case NodeType::RunOnce:
    case NodeType::PathLongerOnApproach:
    case NodeType::Action:
    case NodeType::Condition:
    case NodeType::Loop:
    case NodeType::RateController:
      break;
    case NodeType::Timeout:
      if (!is_3()) {
        known = Memory{};
      } else if (is_due(id) && node(id).duration->max > 0 && !known.flag) {
        // The timer was first, and the node has not said so.
        known.flag = true;
        known.other_flag = status(node(id).children[0]) == Running;
      }
      break;
    case NodeType::TryCatch:
      if (node(id).option && !known.flag && is_active(status(id))) {
        const auto& children = node(id).children;
        for (std::size_t i = 0; i + 1 < children.size(); ++i) {
          reset(children[i]);
        }
        if (execute(children.back()) == Running) reset(children.back());
      }
      known = Memory{};
      break;
    default:
      known = Memory{};
  }
  reset_children(id);
  tell_(id, "halted");
}

EngineStatus NaiveEngine::run(NodeId id) {
  const auto begin = [&] { status_[index(id)] = Running; };
  switch (node(id).type) {
    case NodeType::Sequence:
    case NodeType::Fallback:
    case NodeType::AsyncSequence:
    case NodeType::AsyncFallback:
    case NodeType::SequenceWithMemory:
    case NodeType::PersistentSequence:
      return sequence(id);
    case NodeType::ReactiveSequence:
    case NodeType::ReactiveFallback:
      begin();
      return reactive(id);
    case NodeType::Parallel:
      begin();
      return is_3() ? parallel_3(id) : parallel(id);
    case NodeType::ParallelAll:
      begin();
      return parallel_all(id);
    case NodeType::IfThenElse:
      begin();
      return if_then_else(id);
    case NodeType::WhileDoElse:
      begin();
      return while_do_else(id);
    case NodeType::Switch:
      return switch_node(id);
    case NodeType::TryCatch:
      return try_catch(id);
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
      begin();
      return repeat(id);
    case NodeType::Precondition:
      return precondition(id);
    case NodeType::RunOnce:
      return run_once(id);
    case NodeType::Loop:
      return loop(id);
    case NodeType::WhenUpdated:
      return when_updated(id);
    case NodeType::Timeout:
      begin();
      return timeout(id);
    case NodeType::Delay:
      begin();
      return delay(id);
    case NodeType::Wait:
      return sleep(id);
    case NodeType::RateController:
      return rate_controller(id);
    case NodeType::WhenDue:
      return when_due(id);
    case NodeType::PathLongerOnApproach:
      begin();
      return path_longer(id);
    case NodeType::SingleTrigger:
      return single_trigger(id);
    case NodeType::Recovery:
      begin();
      return recovery(id);
    case NodeType::RoundRobin:
      begin();
      return round_robin(id);
    case NodeType::PipelineSequence:
      return pipeline(id);
    case NodeType::NonblockingSequence:
      return nonblocking(id);
    case NodeType::Action:
    case NodeType::Condition:
      return leaf(id);
    case NodeType::GoalUpdater:
      return decorator(id);
    case NodeType::SubTree:
      if (status(id) == Idle) begin();
      return decorator(id);
    default:
      begin();
      return decorator(id);
  }
}

EngineStatus NaiveEngine::leaf(NodeId id) {
  Memory& known = memory(id);
  switch (node(id).contract.memory) {
    case LeafMemory::Latched:
      if (is_completed(status(id))) return status(id);
      break;
    case LeafMemory::FirstTickFails:
      if (!is_active(status(id))) return Failure;
      break;
    case LeafMemory::FirstTickOfLifeFails:
    case LeafMemory::FirstTickOfLifeSucceeds:
      if (!std::exchange(known.flag, true)) {
        return node(id).contract.memory == LeafMemory::FirstTickOfLifeFails
                   ? Failure
                   : Success;
      }
      break;
    case LeafMemory::Unknown:
      if (is_completed(status(id))) {
        const std::string said = ask_(id);
        return said == "has ended already" ? status(id) : answer_named(said);
      }
      break;
    default:
      break;
  }
  return answer_named(ask_(id));
}

EngineStatus NaiveEngine::sequence(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const bool is_fallback =
      self.type == NodeType::Fallback || self.type == NodeType::AsyncFallback;
  const bool is_persistent = self.type == NodeType::PersistentSequence;
  const bool with_memory = self.type == NodeType::SequenceWithMemory;
  const bool yields = self.type == NodeType::AsyncSequence ||
                      self.type == NodeType::AsyncFallback ||
                      (with_memory && !is_3());
  if (!is_active(status(id))) known.skipped = 0;
  status_[index(id)] = Running;
  const EngineStatus goes_on = is_fallback ? Failure : Success;
  while (known.child < self.children.size()) {
    const NodeId child = self.children[known.child];
    const bool was_idle = status(child) == Idle;
    const EngineStatus answer = execute(child);
    if (answer == Running) return Running;
    if (answer == Skipped) {
      ++known.child;
      ++known.skipped;
      continue;
    }
    if (answer != goes_on) {
      if (with_memory) {
        for (std::size_t i = known.child; i < self.children.size(); ++i) {
          reset(self.children[i]);
        }
      } else {
        reset_children(id);
        known.child = 0;
      }
      return answer;
    }
    ++known.child;
    if (yields && was_idle && known.child < self.children.size()) {
      return Running;
    }
  }
  const bool all_skipped =
      !is_persistent && known.skipped == static_cast<int>(self.children.size());
  reset_children(id);
  known.child = 0;
  known.skipped = 0;
  return all_skipped ? Skipped : goes_on;
}

EngineStatus NaiveEngine::reactive(NodeId id) {
  const Node& self = node(id);
  const bool is_fallback = self.type == NodeType::ReactiveFallback;
  const EngineStatus goes_on = is_fallback ? Failure : Success;
  bool all_skipped = true;
  for (const NodeId child : self.children) {
    const EngineStatus answer = execute(child);
    all_skipped = all_skipped && answer == Skipped;
    if (answer == Running) {
      for (const NodeId other : self.children) {
        if (other != child) reset(other);
      }
      return Running;
    }
    if (answer == Skipped) {
      reset(child);
    } else if (answer != goes_on) {
      return after_reset(id, answer);
    }
  }
  return after_reset(id, all_skipped ? Skipped : goes_on);
}

EngineStatus NaiveEngine::parallel(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const int count = static_cast<int>(self.children.size());
  const auto meant = [&](int written) {
    return written < 0 ? std::max(count + written + 1, 0) : written;
  };
  const int enough = meant(self.threshold);
  int skipped = 0;
  for (const NodeId child : self.children) {
    if (!is_completed(status(child))) {
      const EngineStatus answer = execute(child);
      skipped += answer == Skipped;
      known.count += answer == Success;
      known.failures += answer == Failure;
    }
    std::optional<EngineStatus> decision;
    if (known.count >= enough ||
        (self.threshold < 0 && known.count + skipped >= enough)) {
      decision = Success;
    } else if (count - known.failures < enough ||
               known.failures == meant(self.failure_threshold)) {
      decision = Failure;
    }
    if (decision) {
      known = Memory{};
      return after_reset(id, *decision);
    }
  }
  return skipped == count ? Skipped : Running;
}

EngineStatus NaiveEngine::parallel_3(NodeId id) {
  const Node& self = node(id);
  const int count = static_cast<int>(self.children.size());
  const auto meant = [&](int written) {
    return written < 0 ? std::max(count + written + 1, 0) : written;
  };
  const int enough = meant(self.threshold);
  int successes = 0;
  int failures = 0;
  for (const NodeId child : self.children) {
    const EngineStatus answer =
        is_completed(status(child)) ? status(child) : execute(child);
    if (answer == Success && ++successes == enough) {
      return after_reset(id, Success);
    }
    if (answer == Failure) {
      ++failures;
      if (failures > count - enough ||
          failures == meant(self.failure_threshold)) {
        return after_reset(id, Failure);
      }
    }
  }
  return Running;
}

EngineStatus NaiveEngine::parallel_all(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const int count = static_cast<int>(self.children.size());
  const int most = self.failure_threshold < 0
                       ? std::max(count + self.failure_threshold + 1, 0)
                       : self.failure_threshold;
  int skipped = 0;
  int completed = 0;
  for (const NodeId child : self.children) {
    if (!is_completed(status(child))) {
      const EngineStatus answer = execute(child);
      skipped += answer == Skipped;
      known.failures += answer == Failure;
    }
    completed += is_completed(status(child));
  }
  if (skipped == count) return Skipped;
  if (skipped + completed < count) return Running;
  const EngineStatus answer = known.failures >= most ? Failure : Success;
  known = Memory{};
  return after_reset(id, answer);
}

EngineStatus NaiveEngine::if_then_else(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  if (known.child == 0) {
    const EngineStatus answer = execute(self.children[0]);
    if (answer == Running) return Running;
    if (answer == Skipped) throw EngineThrows("IfThenElse");
    if (answer == Success) known.child = 1;
    if (answer == Failure) {
      if (self.children.size() == 2) return Failure;
      known.child = 2;
    }
  }
  const EngineStatus answer = execute(self.children[known.child]);
  if (answer == Running) return Running;
  known.child = 0;
  return after_reset(id, answer);
}

EngineStatus NaiveEngine::while_do_else(NodeId id) {
  const Node& self = node(id);
  const bool has_else = self.children.size() == 3;
  const EngineStatus condition = execute(self.children[0]);
  if (condition == Running) return Running;
  if (condition == Skipped) {
    reset_children(id);
    throw EngineThrows("WhileDoElse");
  }
  EngineStatus answer = Failure;
  if (condition == Success) {
    if (has_else) reset(self.children[2]);
    answer = execute(self.children[1]);
  } else if (has_else) {
    reset(self.children[1]);
    answer = execute(self.children[2]);
  }
  if (answer == Running) return Running;
  return after_reset(id, answer);
}

EngineStatus NaiveEngine::switch_node(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  std::size_t match = self.children.size() - 1;
  for (std::size_t i = 0; i + 1 < self.children.size(); ++i) {
    if (asks_true(id)) {
      match = i;
      break;
    }
  }
  if (known.running_child >= 0 &&
      known.running_child != static_cast<int>(match)) {
    reset(self.children[static_cast<std::size_t>(known.running_child)]);
  }
  const EngineStatus answer = execute(self.children[match]);
  if (answer == Skipped) {
    known.running_child = -1;
  } else if (answer == Running) {
    known.running_child = static_cast<int>(match);
  } else {
    known.running_child = -1;
    reset_children(id);
  }
  return answer;
}

EngineStatus NaiveEngine::try_catch(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const std::size_t tries = self.children.size() - 1;
  if (!is_active(status(id))) {
    known.skipped = 0;
    known.flag = false;
  }
  status_[index(id)] = Running;
  while (!known.flag && known.child < tries) {
    const EngineStatus answer = execute(self.children[known.child]);
    if (answer == Running) return Running;
    if (answer == Failure) {
      reset_children(id);
      known.child = 0;
      known.flag = true;
    } else {
      ++known.child;
      known.skipped += answer == Skipped;
    }
  }
  if (known.flag) {
    if (execute(self.children.back()) == Running) return Running;
    reset_children(id);
    known.child = 0;
    known.flag = false;
    return Failure;
  }
  const bool all_skipped = known.skipped == static_cast<int>(tries);
  reset_children(id);
  known.child = 0;
  known.skipped = 0;
  return all_skipped ? Skipped : Success;
}

EngineStatus NaiveEngine::repeat(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const bool repeats = self.type == NodeType::Repeat;
  const EngineStatus again = repeats ? Success : Failure;
  const NodeId child = self.children[0];
  const auto goes_on = [&] {
    return known.count < self.repetitions || self.repetitions == kEndlessRounds;
  };
  while (goes_on()) {
    const bool was_idle = status(child) == Idle;
    const EngineStatus answer = execute(child);
    if (answer == Running) return Running;
    reset(child);
    if (answer == Skipped) return Skipped;
    if (answer != again) {
      known.count = 0;
      return answer;
    }
    if (self.repetitions != kEndlessRounds) ++known.count;
    if (!is_3() && was_idle && goes_on()) return Running;
  }
  known.count = 0;
  return again;
}

EngineStatus NaiveEngine::decorator(NodeId id) {
  const Node& self = node(id);
  const EngineStatus answer = execute(self.children[0]);
  switch (self.type) {
    case NodeType::Inverter:
      if (answer == Success) return Failure;
      return answer == Failure ? Success : answer;
    case NodeType::ForceSuccess:
      return is_completed(answer) ? Success : answer;
    case NodeType::ForceFailure:
      return is_completed(answer) ? Failure : answer;
    case NodeType::KeepRunningUntilFailure:
      return answer == Failure ? Failure : Running;
    default:
      return answer;
  }
}

EngineStatus NaiveEngine::precondition(NodeId id) {
  Memory& known = memory(id);
  if (!known.flag) known.flag = asks_true(id);
  if (!known.flag) return of(node(id).otherwise);
  const EngineStatus answer = execute(node(id).children[0]);
  if (is_completed(answer)) known.flag = false;
  return answer;
}

EngineStatus NaiveEngine::run_once(NodeId id) {
  Memory& known = memory(id);
  if (known.flag) {
    if (node(id).option) return Skipped;
    return known.other_flag ? Success : Failure;
  }
  status_[index(id)] = Running;
  const EngineStatus answer = execute(node(id).children[0]);
  if (is_completed(answer)) {
    known.flag = true;
    known.other_flag = answer == Success;
  }
  return answer;
}

EngineStatus NaiveEngine::loop(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  if (status(id) == Idle) {
    known.flag = false;
    known.count = self.repetitions;
  }
  if (!known.flag) {
    if (known.count == 0) return of(self.otherwise);
    --known.count;
  }
  status_[index(id)] = Running;
  const EngineStatus answer = execute(self.children[0]);
  known.flag = answer == Running;
  return answer == Failure ? Failure : Running;
}

EngineStatus NaiveEngine::when_updated(NodeId id) {
  Memory& known = memory(id);
  if (!known.flag && ask_(id) == "the entry is as it was") {
    return of(node(id).otherwise);
  }
  if (known.flag) ask_(id);  // says that it has been, which nothing looks at
  const EngineStatus answer = execute(node(id).children[0]);
  known.flag = answer == Running;
  return answer;
}

EngineStatus NaiveEngine::timeout(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const NodeId child = self.children[0];
  const bool limited = self.duration->max > 0;
  if (known.other_flag) {
    known = Memory{};
    return Failure;
  }
  if (known.since < 0) {
    known.since = now_;
  } else if (limited && !known.flag && is_due(id)) {
    // The timer has fired meanwhile, once.
    known.flag = true;
    if (status(child) == Running) {
      reset(child);
      known = Memory{};
      return Failure;
    }
  }
  const EngineStatus answer = execute(child);
  if (is_completed(answer)) known = Memory{};
  return answer;
}

EngineStatus NaiveEngine::delay(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  if (self.duration->max > 0) {
    if (known.since < 0) known.since = now_;
    if (!is_due(id)) return Running;
  }
  const EngineStatus answer = execute(self.children[0]);
  if (is_completed(answer)) known.since = -1;
  return answer;
}

EngineStatus NaiveEngine::sleep(NodeId id) {
  Memory& known = memory(id);
  if (is_completed(status(id))) return status(id);
  if (node(id).duration->max == 0) return Success;
  if (known.since < 0) known.since = now_;
  if (!is_due(id)) return Running;
  known.since = -1;
  return Success;
}

EngineStatus NaiveEngine::rate_controller(NodeId id) {
  Memory& known = memory(id);
  const NodeId child = node(id).children[0];
  const bool first = !is_active(status(id));
  if (first) known.since = now_;
  status_[index(id)] = Running;
  // A period that was never set is as long as the world says.
  const bool is_lost = known.since < 0;
  if (!first && status(child) != Running &&
      !(is_lost ? ask_(id) == "its unset period has passed" : is_due(id))) {
    return Running;
  }
  const EngineStatus answer = execute(child);
  if (answer == Success && !is_lost) known.since = now_;
  return answer;
}

EngineStatus NaiveEngine::when_due(NodeId id) {
  const NodeId child = node(id).children[0];
  status_[index(id)] = Running;
  const std::string said = ask_(id);
  if (said == "knows no pose") return Failure;
  if (said == "not yet") return Running;
  const EngineStatus answer = execute(child);
  // DistanceController looks at the pose once more.
  if (answer != Success || !node(id).contract.may_fail) return answer;
  return ask_(id) == "knows no pose" ? Failure : Success;
}

EngineStatus NaiveEngine::path_longer(NodeId id) {
  Memory& known = memory(id);
  if (ask_(id) == "the path is no longer than before") {
    known.flag = true;
    return Success;
  }
  if (!known.flag) throw std::logic_error("there is no path yet");
  return execute(node(id).children[0]);
}

EngineStatus NaiveEngine::single_trigger(NodeId id) {
  Memory& known = memory(id);
  if (!is_active(status(id))) known.flag = false;
  status_[index(id)] = Running;
  if (known.flag) return Failure;
  const EngineStatus answer = execute(node(id).children[0]);
  known.flag = is_completed(answer);
  return answer;
}

EngineStatus NaiveEngine::recovery(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const auto ends = [&](EngineStatus answer) {
    reset_children(id);
    known = Memory{};
    if (answer == Skipped) status_[index(id)] = Idle;
    return answer;
  };
  while (true) {
    const EngineStatus answer = execute(self.children[known.child]);
    if (answer == Running) return Running;
    if (known.child == 0) {
      if (answer != Failure) return ends(answer);
      if (known.count >= self.repetitions) return ends(Failure);
      reset(self.children[0]);
      known.child = 1;
    } else {
      if (answer == Failure) return ends(Failure);
      known.child = 0;
      reset(self.children[1]);
      if (answer == Skipped) return Failure;
      ++known.count;
    }
  }
}

EngineStatus NaiveEngine::round_robin(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  const int count = static_cast<int>(self.children.size());
  int skipped = 0;
  while (known.failures + skipped < count) {
    const EngineStatus answer = execute(self.children[known.child]);
    if (answer == Running) return Running;
    skipped += answer == Skipped;
    ++known.child;
    if (known.child == self.children.size()) {
      known.child = 0;
      // Behind the last child, whatever it has answered.
      if (!self.option) break;
    }
    if (answer == Success) {
      known.failures = 0;
      return after_reset(id, Success);
    }
    known.failures += answer == Failure;
  }
  reset_children(id);
  known = Memory{};
  if (skipped == count) {
    status_[index(id)] = Idle;
    return Skipped;
  }
  return Failure;
}

EngineStatus NaiveEngine::pipeline(NodeId id) {
  const Node& self = node(id);
  Memory& known = memory(id);
  bool all_skipped = true;
  for (std::size_t i = 0; i < self.children.size(); ++i) {
    const EngineStatus answer = execute(self.children[i]);
    all_skipped = all_skipped && answer == Skipped;
    if (answer == Failure) {
      known.child = 0;
      return after_reset(id, Failure);
    }
    if (answer == Running && i >= known.child) {
      known.child = i;
      return Running;
    }
  }
  known.child = 0;
  return after_reset(id, all_skipped ? Skipped : Success);
}

EngineStatus NaiveEngine::nonblocking(NodeId id) {
  bool all_succeed = true;
  for (const NodeId child : node(id).children) {
    const EngineStatus answer = execute(child);
    if (answer == Skipped) throw EngineThrows("NonblockingSequence");
    if (answer == Failure) return after_reset(id, Failure);
    all_succeed = all_succeed && answer == Success;
  }
  return all_succeed ? after_reset(id, Success) : Running;
}

}  // namespace btcheck::reference

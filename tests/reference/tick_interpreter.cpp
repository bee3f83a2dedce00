// SPDX-License-Identifier: MIT
//
// What one tick of a behavior tree does, told by recursion: a second opinion.
//
// The checker gives every node type a table of locations and edges. A wrong
// table would be explored, drawn, exported and replayed without anybody
// noticing, since all of them read it. So here is the same meaning once more,
// written from the sentences of docs/semantics.md alone: a node is ticked by
// calling a function, which ticks its children by calling theirs. There is
// one run only: children of a Parallel are ticked left to right, free
// variables move between two ticks, timers are due before the tree is ticked
// at the same instant. Everything else that may happen is chosen by a Script.
#include "reference/tick_interpreter.hpp"
#include "model/tree/node_types.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace btcheck::reference {
namespace {

EventKind event_of(NodeStatus answer) {
  switch (answer) {
    case NodeStatus::Success:
      return EventKind::Success;
    case NodeStatus::Failure:
      return EventKind::Failure;
    case NodeStatus::Running:
      return EventKind::Running;
    default:
      throw std::logic_error("a node answered neither of the three words");
  }
}

// Two operands, a divisor not being 0; truth is 1, and every number but 0 is
// taken for it.
std::int64_t combine(Operation operation, std::int64_t a, std::int64_t b) {
  switch (operation) {
    case Operation::Add:
      return a + b;
    case Operation::Subtract:
      return a - b;
    case Operation::Multiply:
      return a * b;
    case Operation::Divide:
      return a / b;
    case Operation::Modulo:
      return a % b;
    case Operation::Equal:
      return a == b;
    case Operation::NotEqual:
      return a != b;
    case Operation::Less:
      return a < b;
    case Operation::LessEqual:
      return a <= b;
    case Operation::Greater:
      return a > b;
    case Operation::GreaterEqual:
      return a >= b;
    case Operation::And:
      return a != 0 && b != 0;
    case Operation::Or:
      return a != 0 || b != 0;
    default:
      throw std::logic_error("not an operation of two operands");
  }
}

// Whether any number of the pairs lead from one value to the other.
bool leads_to(std::span<const std::pair<int, int>> pairs, int from, int to) {
  std::vector<int> reached = {from};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const auto& [source, target] : pairs)
      if (source == reached[i] &&
          std::ranges::find(reached, target) == reached.end())
        reached.push_back(target);
  return std::ranges::find(reached, to) != reached.end();
}

}  // namespace

std::string_view event_name(EventKind kind) {
  static constexpr std::array<std::string_view, 5> kNames = {
      "ticked", "success", "failure", "running", "halted"};
  return kNames[static_cast<std::size_t>(kind)];
}

TickInterpreter::TickInterpreter(const BehaviorTree& tree, Script script)
    : tree_(&tree), script_(std::move(script)), root_(tree.roots.at(0)) {
  memories_.resize(tree.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    memories_[i].finished.assign(tree.nodes[i].children.size(), false);
  for (const StateVariable& variable : tree.variables)
    variables_.push_back(variable.initial);
  lasted_.assign(tree.variables.size(), 0);
}

// The root: one unit of time, then its child; success or failure for ever,
// unless it loops.
TickResult TickInterpreter::tick() {
  events_.clear();
  if (fault_) return state();
  advance_timers();
  move_in_time();
  move_free_variables();
  if (ended_) return state();
  try {
    const NodeStatus answer = tick_node(root_);
    ended_ = answer != NodeStatus::Running && !node(root_).loop;
  } catch (const ModelFault&) {
    fault_ = true;
  }
  TickResult result = state();
  result.events = events_;
  return result;
}

TickResult TickInterpreter::state() const {
  TickResult result;
  result.root = memory(root_).status;
  result.variables = variables_;
  result.fault = fault_;
  for (std::uint32_t i = 0; i < memories_.size(); ++i) {
    const Memory& own = memories_[i];
    result.statuses.push_back(own.status);
    for (const LocalValue& local : locals(NodeId{i}))
      result.locals.push_back(local);
    if (has_timer(NodeId{i}))
      result.timers.push_back({NodeId{i}, own.timer.phase, own.timer.elapsed});
  }
  return result;
}

// The table of local variables. Children count from 1. A Parallel's `finished`
// is the set of children that have ended in this activation (child i is bit
// i-1), a reactive node's `decision` the remembered status, no_ret_status if
// there is none.
std::vector<LocalValue> TickInterpreter::locals(NodeId id) const {
  const Memory& own = memory(id);
  switch (node(id).type) {
    case NodeType::Sequence:
    case NodeType::SequenceWithMemory:
      return {{id, "next_seq", own.next}};
    case NodeType::Fallback:
      return {{id, "next_fb", own.next}};
    case NodeType::ReactiveSequence:
    case NodeType::ReactiveFallback:
      return {
          {id, "decision",
           static_cast<int>(own.decision.value_or(NodeStatus::NoRetStatus))}};
    case NodeType::Parallel:
    case NodeType::ParallelAll: {
      int finished = 0;
      for (std::size_t i = 0; i < own.finished.size(); ++i)
        finished |= own.finished[i] ? 1 << i : 0;
      return {{id, "finished", finished}};
    }
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
      return {{id, "count", own.count}};
    case NodeType::Recovery:
      return {{id, "retry", own.count}, {id, "next", own.next}};
    case NodeType::RoundRobin:
      return {{id, "next", own.next}, {id, "failed", own.failed}};
    case NodeType::PipelineSequence:
      return {{id, "furthest", own.next}};
    default:
      return {};
  }
}

NodeStatus TickInterpreter::status(NodeId id) const {
  return memory(id).status;
}

int TickInterpreter::local(NodeId id, std::string_view name) const {
  for (const LocalValue& local : locals(id))
    if (local.name == name) return local.value;
  throw std::logic_error("the node has no such local variable");
}

NodeId TickInterpreter::child(NodeId id, int number) const {
  return node(id).children.at(static_cast<std::size_t>(number - 1));
}

int TickInterpreter::child_count(NodeId id) const {
  return static_cast<int>(node(id).children.size());
}

void TickInterpreter::record(NodeId id, EventKind kind) {
  events_.push_back({id, kind});
}

// The frame of every node: no_ret_status while it works, then its answer.
NodeStatus TickInterpreter::tick_node(NodeId id) {
  record(id, EventKind::Ticked);
  memory(id).status = NodeStatus::NoRetStatus;
  const NodeStatus answer = evaluate_node(id);
  memory(id).status = answer;
  record(id, event_of(answer));
  return answer;
}

NodeStatus TickInterpreter::evaluate_node(NodeId id) {
  switch (node(id).type) {
    case NodeType::BehaviorTree:
    case NodeType::SubTree:
      return tick_node(child(id, 1));
    case NodeType::Sequence:
    case NodeType::SequenceWithMemory:
      return tick_sequence(id);
    case NodeType::Fallback:
      return tick_fallback(id);
    case NodeType::ReactiveSequence:
      return tick_reactive(id, NodeStatus::Failure);
    case NodeType::ReactiveFallback:
      return tick_reactive(id, NodeStatus::Success);
    case NodeType::Parallel:
    case NodeType::ParallelAll:
      return tick_parallel(id);
    case NodeType::Inverter:
      return tick_inverter(id);
    case NodeType::ForceSuccess:
      return tick_force(id, NodeStatus::Success);
    case NodeType::ForceFailure:
      return tick_force(id, NodeStatus::Failure);
    case NodeType::KeepRunningUntilFailure:
      return tick_keep_running(id);
    case NodeType::Repeat:
      return tick_repeat(id);
    case NodeType::RetryUntilSuccessful:
      return tick_retry(id);
    case NodeType::RateController:
      return tick_rate_controller(id);
    case NodeType::Timeout:
      return tick_timeout(id);
    case NodeType::Recovery:
      return tick_recovery(id);
    case NodeType::RoundRobin:
      return tick_round_robin(id);
    case NodeType::PipelineSequence:
      return tick_pipeline(id);
    case NodeType::Action:
    case NodeType::Condition:
      return tick_action(id);
    case NodeType::SetSV:
      return tick_set_sv(id);
    case NodeType::Eval:
      return tick_eval(id);
    case NodeType::Wait:
      return tick_wait(id);
    default:
      throw std::logic_error("no node of .btf trees");
  }
}

// --- Halting -------------------------------------------------------------

bool TickInterpreter::any_child_runs(NodeId id) const {
  return std::ranges::any_of(node(id).children, [&](NodeId child) {
    return memory(child).status == NodeStatus::Running;
  });
}

void TickInterpreter::halt_running_children(NodeId id) {
  for (const NodeId child : node(id).children)
    if (memory(child).status == NodeStatus::Running) halt_node(child);
}

// A node passes the halt down first, and ends with failure.
void TickInterpreter::halt_node(NodeId id) {
  if (script_.halted && is_leaf(node(id).type)) script_.halted(id);
  memory(id).status = NodeStatus::HaltMe;
  halt_running_children(id);
  forget(id);
  memory(id).status = NodeStatus::Failure;
  record(id, EventKind::Halted);
}

// What a halted node no longer knows. Only SequenceWithMemory keeps anything:
// its next_seq.
void TickInterpreter::forget(NodeId id) {
  Memory& own = memory(id);
  if (node(id).type != NodeType::SequenceWithMemory) own.next = 1;
  own.count = 0;
  own.failed = 0;
  own.decision.reset();
  own.finished.assign(own.finished.size(), false);
  own.timer = {};
}

// --- Control nodes -------------------------------------------------------

// Resumes at next_seq. A failure goes back to the first child, or stays with
// the failing one when the Sequence has memory.
NodeStatus TickInterpreter::tick_sequence(NodeId id) {
  const bool with_memory = node(id).type == NodeType::SequenceWithMemory;
  int& next_seq = memory(id).next;
  for (int i = next_seq; i <= child_count(id); ++i) {
    const NodeStatus answer = tick_node(child(id, i));
    if (answer == NodeStatus::Running) {
      next_seq = i;
      return NodeStatus::Running;
    }
    if (answer == NodeStatus::Failure) {
      next_seq = with_memory ? i : 1;
      return NodeStatus::Failure;
    }
  }
  next_seq = 1;
  return NodeStatus::Success;
}

NodeStatus TickInterpreter::tick_fallback(NodeId id) {
  int& next_fb = memory(id).next;
  for (int i = next_fb; i <= child_count(id); ++i) {
    const NodeStatus answer = tick_node(child(id, i));
    if (answer == NodeStatus::Running) {
      next_fb = i;
      return NodeStatus::Running;
    }
    if (answer == NodeStatus::Success) {
      next_fb = 1;
      return NodeStatus::Success;
    }
  }
  next_fb = 1;
  return NodeStatus::Failure;
}

// Starts at the first child every tick; `deciding` is failure for a
// ReactiveSequence, success for a ReactiveFallback. With a remembered
// decision it only waits for the children that still run.
NodeStatus TickInterpreter::tick_reactive(NodeId id, NodeStatus deciding) {
  Memory& own = memory(id);
  if (own.decision) {
    for (const NodeId child : node(id).children)
      if (memory(child).status == NodeStatus::Running) tick_node(child);
    if (any_child_runs(id)) return NodeStatus::Running;
    return *std::exchange(own.decision, std::nullopt);
  }
  for (const NodeId child : node(id).children) {
    const NodeStatus answer = tick_node(child);
    if (answer == NodeStatus::Running) return NodeStatus::Running;
    if (answer != deciding) continue;
    if (node(id).halt) {
      halt_running_children(id);
    } else if (node(id).wait && any_child_runs(id)) {
      own.decision = deciding;
      return NodeStatus::Running;
    }
    return deciding;
  }
  return deciding == NodeStatus::Failure ? NodeStatus::Success
                                         : NodeStatus::Failure;
}

// Ticks whoever has not finished in this activation; then at least m
// successes decide, or more than n - m failures.
NodeStatus TickInterpreter::tick_parallel(NodeId id) {
  std::vector<bool>& finished = memory(id).finished;
  const int n = child_count(id);
  const int m = node(id).type == NodeType::ParallelAll ? n : node(id).threshold;
  int successes = 0;
  int failures = 0;
  for (int i = 1; i <= n; ++i) {
    const auto place = static_cast<std::size_t>(i - 1);
    if (!finished[place])
      finished[place] = tick_node(child(id, i)) != NodeStatus::Running;
    if (!finished[place]) continue;
    if (status(child(id, i)) == NodeStatus::Success)
      ++successes;
    else
      ++failures;
  }
  if (successes < m && failures <= n - m) return NodeStatus::Running;
  if (node(id).halt)
    halt_running_children(id);
  else if (node(id).wait && any_child_runs(id))
    return NodeStatus::Running;
  finished.assign(finished.size(), false);
  return successes >= m ? NodeStatus::Success : NodeStatus::Failure;
}

NodeStatus TickInterpreter::tick_inverter(NodeId id) {
  const NodeStatus answer = tick_node(child(id, 1));
  if (answer == NodeStatus::Success) return NodeStatus::Failure;
  if (answer == NodeStatus::Failure) return NodeStatus::Success;
  return NodeStatus::Running;
}

NodeStatus TickInterpreter::tick_force(NodeId id, NodeStatus forced) {
  const NodeStatus answer = tick_node(child(id, 1));
  return answer == NodeStatus::Running ? NodeStatus::Running : forced;
}

NodeStatus TickInterpreter::tick_keep_running(NodeId id) {
  const NodeStatus answer = tick_node(child(id, 1));
  return answer == NodeStatus::Failure ? NodeStatus::Failure
                                       : NodeStatus::Running;
}

// n successes, one after another, are a success; one failure is a failure.
NodeStatus TickInterpreter::tick_repeat(NodeId id) {
  int& rounds = memory(id).count;
  while (true) {
    const NodeStatus answer = tick_node(child(id, 1));
    if (answer == NodeStatus::Running) return NodeStatus::Running;
    const bool last = ++rounds >= node(id).repetitions;
    if (answer == NodeStatus::Success && !last) continue;
    rounds = 0;
    return answer;
  }
}

// n failures, one after another, are a failure; one success is a success.
NodeStatus TickInterpreter::tick_retry(NodeId id) {
  int& attempts = memory(id).count;
  while (true) {
    const NodeStatus answer = tick_node(child(id, 1));
    if (answer == NodeStatus::Running) return NodeStatus::Running;
    const bool last = ++attempts >= node(id).repetitions;
    if (answer == NodeStatus::Failure && !last) continue;
    attempts = 0;
    return answer;
  }
}

// The period is counted from the tick that activated the child.
NodeStatus TickInterpreter::tick_rate_controller(NodeId id) {
  const NodeId only = child(id, 1);
  if (status(only) == NodeStatus::Running) return tick_node(only);
  if (memory(id).timer.phase == TimerPhase::Counting)
    return NodeStatus::Running;
  start_timer(id);
  return tick_node(only);
}

// The time is counted from the first tick of an activation. When it is up, a
// tick halts the child and is not passed on.
NodeStatus TickInterpreter::tick_timeout(NodeId id) {
  TimerPhase& phase = memory(id).timer.phase;
  if (phase == TimerPhase::Due) {
    halt_running_children(id);
    phase = TimerPhase::Idle;
    return NodeStatus::Failure;
  }
  if (phase == TimerPhase::Idle) start_timer(id);
  const NodeStatus answer = tick_node(child(id, 1));
  if (answer != NodeStatus::Running) memory(id).timer = {};
  return answer;
}

NodeStatus TickInterpreter::tick_recovery(NodeId id) {
  int& retry = memory(id).count;
  int& present = memory(id).next;
  while (true) {
    const NodeStatus answer = tick_node(child(id, present));
    if (answer == NodeStatus::Running) return NodeStatus::Running;
    if (present == 1 && answer == NodeStatus::Failure &&
        retry < node(id).repetitions) {
      present = 2;
    } else if (present == 2 && answer == NodeStatus::Success) {
      ++retry;
      present = 1;
    } else {
      retry = 0;
      present = 1;
      return answer;
    }
  }
}

// The turn passes on with every success and every failure, the last failure
// of a round included: the next round begins where this one began.
NodeStatus TickInterpreter::tick_round_robin(NodeId id) {
  Memory& own = memory(id);
  while (true) {
    const NodeStatus answer = tick_node(child(id, own.next));
    if (answer == NodeStatus::Running) return NodeStatus::Running;
    own.next = own.next % child_count(id) + 1;
    if (answer == NodeStatus::Failure && ++own.failed < child_count(id))
      continue;
    own.failed = 0;
    return answer;
  }
}

NodeStatus TickInterpreter::tick_pipeline(NodeId id) {
  int& furthest = memory(id).next;
  for (int i = 1; i <= child_count(id); ++i) {
    furthest = std::max(furthest, i);
    const NodeStatus answer = tick_node(child(id, i));
    if (answer == NodeStatus::Running && i == furthest)
      return NodeStatus::Running;
    if (answer == NodeStatus::Failure) {
      halt_running_children(id);
      furthest = 1;
      return NodeStatus::Failure;
    }
  }
  halt_running_children(id);
  furthest = 1;
  return NodeStatus::Success;
}

// --- Leaves --------------------------------------------------------------

// A false requirement leaves failure only, before everything else. Then a
// :duration leaves running only until it is due, and never afterwards.
std::vector<NodeStatus> TickInterpreter::allowed_answers(NodeId id) const {
  const LeafContract& contract = node(id).contract;
  if (evaluate(contract.requirement) == 0) return {NodeStatus::Failure};
  const bool timed = node(id).duration.has_value();
  if (timed && memory(id).timer.phase == TimerPhase::Counting)
    return {NodeStatus::Running};
  std::vector<NodeStatus> allowed;
  const bool is_decided = !contract.decision.is_true();
  const bool decision = evaluate(contract.decision) != 0;
  if (contract.may_succeed && decision) allowed.push_back(NodeStatus::Success);
  if (is_decided ? !decision : contract.may_fail)
    allowed.push_back(NodeStatus::Failure);
  if (contract.may_run && !timed && node(id).type == NodeType::Action)
    allowed.push_back(NodeStatus::Running);
  return allowed;
}

NodeStatus TickInterpreter::tick_action(NodeId id) {
  if (script_.ill) {
    const Script::Ill ill =
        script_.ill(id, [&] { return allowed_answers(id); });
    if (ill.answer || ill.begins_anew) memory(id).timer = {};
    if (ill.answer) return answered(id, *ill.answer);
  }
  if (has_timer(id) && memory(id).timer.phase == TimerPhase::Idle)
    start_timer(id);
  const std::vector<NodeStatus> allowed = allowed_answers(id);
  if (allowed.empty()) throw std::logic_error("the leaf may answer nothing");
  const NodeStatus answer =
      script_.action ? script_.action(id, allowed) : allowed.front();
  if (std::ranges::find(allowed, answer) == allowed.end())
    throw std::logic_error("the leaf may not answer that");
  return answered(id, answer);
}

NodeStatus TickInterpreter::answered(NodeId id, NodeStatus answer) {
  if (answer == NodeStatus::Running) return answer;
  memory(id).timer = {};
  const LeafContract& contract = node(id).contract;
  if (answer != NodeStatus::Success) {
    assign(contract.on_failure);
    return answer;
  }
  if (!script_.writes) {
    assign(contract.on_success);
    return answer;
  }
  for (const StateAssignment& effect : contract.on_success) {
    const auto other =
        script_.writes(id, effect.variable, variables_[index(effect.variable)],
                       static_cast<int>(evaluate(effect.value)));
    if (other) {
      variables_[index(effect.variable)] = *other;
    } else {
      assign({&effect, 1});
    }
  }
  return answer;
}

// The present value first; a number may take every value of its range.
std::vector<int> TickInterpreter::allowed_values(
    StateVariableId variable) const {
  const StateVariable& declared = tree_->variable(variable);
  const int present = variables_[index(variable)];
  std::vector<int> values = {present};
  if (!declared.is_enumeration()) {
    for (int value = declared.min; value <= declared.max; ++value)
      if (value != present) values.push_back(value);
    return values;
  }
  for (const auto& [from, to] : declared.transitions)
    if (from == present && std::ranges::find(values, to) == values.end())
      values.push_back(to);
  return values;
}

NodeStatus TickInterpreter::tick_set_sv(NodeId id) {
  const StateVariableId variable = node(id).variable;
  const std::vector<int> allowed = allowed_values(variable);
  const int value =
      script_.set_sv ? script_.set_sv(id, allowed) : allowed.front();
  if (std::ranges::find(allowed, value) == allowed.end())
    throw std::logic_error("the variable may not take that value");
  variables_[index(variable)] = value;
  return NodeStatus::Success;
}

NodeStatus TickInterpreter::tick_eval(NodeId id) {
  if (node(id).assignment) {
    assign({&*node(id).assignment, 1});
    return NodeStatus::Success;
  }
  return evaluate(node(id).expression) != 0 ? NodeStatus::Success
                                            : NodeStatus::Failure;
}

NodeStatus TickInterpreter::tick_wait(NodeId id) {
  Timer& timer = memory(id).timer;
  if (timer.phase == TimerPhase::Idle) start_timer(id);
  if (timer.phase == TimerPhase::Counting) return NodeStatus::Running;
  timer = {};
  return NodeStatus::Success;
}

// --- Expressions ---------------------------------------------------------

// A division by zero, wherever it stands, is a fault of the model.
std::int64_t TickInterpreter::evaluate(const Expression& expression) const {
  if (expression.is_true()) return 1;
  std::vector<std::int64_t> stack;
  const auto pop = [&stack] {
    const std::int64_t top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const Term& term : expression.terms()) {
    const auto place = static_cast<std::uint32_t>(term.operand);
    if (term.operation == Operation::Constant) {
      stack.push_back(term.operand);
    } else if (term.operation == Operation::Variable) {
      stack.push_back(variables_.at(place));
    } else if (term.operation == Operation::Status) {
      stack.push_back(static_cast<int>(memories_.at(place).status));
    } else if (term.operation == Operation::Negate) {
      stack.push_back(-pop());
    } else if (term.operation == Operation::Not) {
      stack.push_back(pop() == 0);
    } else {
      const std::int64_t right = pop();
      const std::int64_t left = pop();
      if (right == 0 && (term.operation == Operation::Divide ||
                         term.operation == Operation::Modulo))
        throw ModelFault{};
      stack.push_back(combine(term.operation, left, right));
    }
  }
  assert(stack.size() == 1);
  return stack.back();
}

// In order, each seeing the ones before it. A value outside the range of its
// variable ends the run, and then all variables keep the values they had: the
// assignments are one step.
void TickInterpreter::assign(std::span<const StateAssignment> assignments) {
  const std::vector<int> before = variables_;
  try {
    for (const StateAssignment& assignment : assignments) {
      const StateVariable& declared = tree_->variable(assignment.variable);
      const std::int64_t value = evaluate(assignment.value);
      if (value < declared.min || value > declared.max) throw ModelFault{};
      variables_[index(assignment.variable)] = static_cast<int>(value);
    }
  } catch (const ModelFault&) {
    variables_ = before;
    throw;
  }
}

// --- Time ----------------------------------------------------------------

bool TickInterpreter::has_timer(NodeId id) const {
  const NodeType type = node(id).type;
  return type == NodeType::Wait || type == NodeType::RateController ||
         type == NodeType::Timeout ||
         (type == NodeType::Action && node(id).duration.has_value());
}

// In which ticks after its start the timer becomes due.
Duration TickInterpreter::timer_window(NodeId id) const {
  if (node(id).type == NodeType::RateController) {
    const int period = static_cast<int>(std::lround(10 / node(id).rate_hz));
    return {std::max(1, period), std::max(1, period)};
  }
  return node(id).duration.value();
}

void TickInterpreter::start_timer(NodeId id) {
  memory(id).timer = {TimerPhase::Counting, 0};
  check_due(id);
}

void TickInterpreter::check_due(NodeId id) {
  Timer& timer = memory(id).timer;
  const Duration window = timer_window(id);
  if (timer.elapsed < window.min) return;
  if (timer.elapsed >= window.max ||
      (script_.due && script_.due(id, timer.elapsed)))
    timer = {TimerPhase::Due, 0};
}

void TickInterpreter::advance_timers() {
  for (std::uint32_t i = 0; i < memories_.size(); ++i) {
    if (memories_[i].timer.phase != TimerPhase::Counting) continue;
    // Without an end nothing tells later times apart.
    const Duration window = timer_window(NodeId{i});
    int& elapsed = memories_[i].timer.elapsed;
    if (window.max != kEndless || elapsed < window.min) ++elapsed;
    check_due(NodeId{i});
  }
}

// A transition may be taken when its state has lasted as long as it says; one
// whose time would be over before the next tick leaves no choice to stay.
std::vector<int> TickInterpreter::timely_values(
    StateVariableId variable) const {
  const StateVariable& declared = tree_->variable(variable);
  const int present = variables_[index(variable)];
  const int lasted = lasted_[index(variable)];
  std::vector<int> values = {present};
  for (std::size_t i = 0; i < declared.transitions.size(); ++i) {
    const auto& [from, to] = declared.transitions[i];
    const Duration time = declared.lasting[i];
    if (from != present) continue;
    if (time.max != kEndless && lasted > time.max)
      throw std::logic_error("a state has lasted too long");
    if (lasted >= time.min) values.push_back(to);
  }
  for (std::size_t i = 0; i < declared.transitions.size(); ++i)
    if (declared.transitions[i].first == present &&
        declared.lasting[i].max == lasted)
      return {values.begin() + 1, values.end()};
  return values;
}

void TickInterpreter::move_in_time() {
  for (std::uint32_t i = 0; i < variables_.size(); ++i) {
    if (tree_->variables[i].lasting.empty()) continue;
    ++lasted_[i];
    const std::vector<int> allowed = timely_values(StateVariableId{i});
    const int value = script_.timely_move
                          ? script_.timely_move(StateVariableId{i}, allowed)
                          : allowed.front();
    if (std::ranges::find(allowed, value) == allowed.end())
      throw std::logic_error("the variable may not become that now");
    if (value != variables_[i]) lasted_[i] = 0;
    variables_[i] = value;
  }
}

void TickInterpreter::move_free_variables() {
  if (!script_.free_moves) return;
  const std::vector<int> before = variables_;
  script_.free_moves(variables_);
  for (std::uint32_t i = 0; i < variables_.size(); ++i) {
    const StateVariable& declared = tree_->variables[i];
    if (variables_[i] < declared.min || variables_[i] > declared.max)
      throw std::logic_error("a free variable left its range");
    if (variables_[i] == before[i]) continue;
    if (!moves_freely(*tree_, StateVariableId{i}) || !declared.lasting.empty())
      throw std::logic_error("a variable moved that does not move freely");
    if (declared.is_enumeration() &&
        !leads_to(declared.transitions, before[i], variables_[i]))
      throw std::logic_error("a free variable left its transitions");
  }
}

}  // namespace btcheck::reference

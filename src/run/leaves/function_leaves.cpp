// SPDX-License-Identifier: MIT
#include "run/leaves/function_leaves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostMoves = 64;  // for which there is room beforehand
constexpr double kOnStep = 1e-6;        // of a step: what doubles leave over

run::Argument told(const GivenArgument& given) {
  const Argument& argument = *given.argument;
  run::Argument told{argument.key, run::Argument::Kind::Written, 0,
                     argument.value};
  if (!argument.known) return told;
  const ArgumentValue& known = *argument.known;
  if (known.names.empty()) {
    told.kind = run::Argument::Kind::Number;
    told.number = static_cast<double>(given.value) /
                  static_cast<double>(power_of_ten(known.decimals));
  } else {
    told.kind = run::Argument::Kind::Word;
    told.text = known.names[static_cast<std::size_t>(given.value - known.min)];
  }
  return told;
}

int status_number(run::Status status) {
  switch (status) {
    case run::Status::Success:
      return static_cast<int>(NodeStatus::Success);
    case run::Status::Failure:
      return static_cast<int>(NodeStatus::Failure);
    case run::Status::Running:
      return static_cast<int>(NodeStatus::Running);
    case run::Status::Halted:
      break;
  }
  throw WrongValue("halted, which nobody can answer");
}

std::string range_text(const StateVariable& variable) {
  if (!variable.is_enumeration()) {
    return fmt::format("a number from {} to {}",
                       variable.value_name(variable.min),
                       variable.value_name(variable.max));
  }
  return fmt::format("{}", fmt::join(variable.states, ", "));
}

}  // namespace

std::optional<int> value_of(const StateVariable& variable,
                            const run::Value& value) {
  if (value.is_word()) {
    const auto state =
        std::ranges::find_if(variable.states, [&](const std::string& known) {
          return equal_ignoring_case(known, value.word());
        });
    if (state == variable.states.end()) return std::nullopt;
    return static_cast<int>(state - variable.states.begin());
  }
  if (variable.is_enumeration()) return std::nullopt;
  // Counted in steps; a number between two of them is none of its values.
  const double one = static_cast<double>(variable.scale.step) /
                     static_cast<double>(power_of_ten(variable.scale.decimals));
  const double steps = value.number() / one;
  const double whole = std::round(steps);
  const bool is_value = std::abs(steps - whole) < kOnStep &&
                        whole >= variable.min && whole <= variable.max;
  if (!is_value) return std::nullopt;
  return static_cast<int>(whole);
}

double number_of(const StateVariable& variable, int value) {
  return static_cast<double>(value) * variable.scale.step /
         static_cast<double>(power_of_ten(variable.scale.decimals));
}

FunctionLeaves::FunctionLeaves(const BehaviorTree& tree,
                               std::chrono::milliseconds within)
    : tree_(tree), within_(within), leaves_(tree.nodes.size()) {
  moves_.reserve(kMostMoves);
  taken_.reserve(kMostMoves);
}

void FunctionLeaves::give(NodeId id, LeafFunction function) {
  const Node& node = tree_.node(id);
  auto leaf = std::make_unique<Leaf>();
  leaf->function = std::move(function);
  leaf->name = short_name(tree_, id);
  leaf->arguments.resize(node.arguments.size());
  leaf->may_run = node.type == NodeType::Action && node.contract.may_run &&
                  !(node.duration && node.duration->max == 0);
  leaves_[index(id)] = std::move(leaf);
}

void FunctionLeaves::begin() {
  for (std::uint32_t n = 0; n < leaves_.size(); ++n) {
    Leaf* leaf = leaves_[n].get();
    if (leaf == nullptr || leaf->function.is_polled() ||
        leaf->function.where == run::Runs::InTick) {
      continue;
    }
    leaf->task = std::make_unique<Task>(
        [this, n, leaf](const TaskCall& with, const std::stop_token& stop) {
          return call(NodeId{n}, *leaf, with, stop);
        },
        leaf->arguments.size(), within_);
  }
}

bool FunctionLeaves::end() {
  bool have_left = true;
  for (const auto& leaf : leaves_) {
    if (leaf && leaf->task) leaf->task->stop();
  }
  for (const auto& leaf : leaves_) {
    if (leaf && leaf->task) have_left &= leaf->task->end();
  }
  return have_left;
}

// --- Calling -------------------------------------------------------------

int FunctionLeaves::call(NodeId node, Leaf& leaf, const TaskCall& with,
                         const std::stop_token& stop) const {
  std::ranges::transform(with.arguments, leaf.arguments.begin(), told);
  const run::Call as_told(tree_.node(node).id, leaf.name, with.tick,
                          leaf.arguments);
  const auto status = [](bool is_success) {
    return static_cast<int>(is_success ? NodeStatus::Success
                                       : NodeStatus::Failure);
  };
  if (const auto* act =
          std::get_if<run::ActionFunction>(&leaf.function.function)) {
    return status((*act)(as_told, stop) == run::Answer::Success);
  }
  if (const auto* holds =
          std::get_if<run::ConditionFunction>(&leaf.function.function)) {
    return status((*holds)(as_told));
  }
  const auto& measure = std::get<run::MeasureFunction>(leaf.function.function);
  const StateVariable& variable = tree_.variable(tree_.node(node).variable);
  const run::Value found = measure(as_told);
  const auto value = value_of(variable, found);
  if (!value) {
    throw WrongValue(
        fmt::format("{}, which is not {}", found.text(), range_text(variable)));
  }
  return *value;
}

int FunctionLeaves::poll(const Leaf& leaf, const run::Call& with,
                         run::Turn turn) const {
  return status_number(
      std::get<run::PolledFunction>(leaf.function.function)(with, turn));
}

Reply FunctionLeaves::ask(const LeafQuestion& question) {
  Leaf& leaf = *leaves_[index(question.node)];
  return leaf.task ? ask_task(question.node, leaf, question)
                   : ask_in_tick(question.node, leaf, question);
}

Reply FunctionLeaves::ask_in_tick(NodeId node, Leaf& leaf,
                                  const LeafQuestion& question) {
  const TaskCall with{question.arguments, question.tick};
  return reply_to(
      leaf, result_of([&] {
        if (!leaf.function.is_polled()) return call(node, leaf, with, {});
        std::ranges::transform(with.arguments, leaf.arguments.begin(), told);
        const run::Call as_told(tree_.node(node).id, leaf.name, with.tick,
                                leaf.arguments);
        return poll(
            leaf, as_told,
            question.asked == Asked::Anew ? run::Turn::Start : run::Turn::Poll);
      }));
}

// An action that may answer running is not waited for.
Reply FunctionLeaves::ask_task(NodeId node, Leaf& leaf,
                               const LeafQuestion& question) {
  const bool is_action = tree_.node(node).type == NodeType::Action;
  if (question.asked == Asked::Anew) {
    if (!is_action && leaf.task->is_busy()) {
      return Reply::broken(
          BreachKind::NoAnswer,
          fmt::format("`{}` has not returned since it was asked before",
                      leaf.name));
    }
    leaf.task->start({question.arguments, question.tick});
  }
  const auto result =
      leaf.task->result(leaf.may_run ? std::chrono::milliseconds(0) : within_);
  if (result) return reply_to(leaf, *result);
  if (leaf.may_run) return Reply::answer(NodeStatus::Running);
  if (!is_action) leaf.task->stop();
  return Reply::broken(BreachKind::NoAnswer,
                       fmt::format("`{}` has not answered within {} ms",
                                   leaf.name, within_.count()));
}

Reply FunctionLeaves::reply_to(const Leaf& leaf,
                               const TaskResult& result) const {
  if (!result.thrown) return Reply::answer(result.value);
  if (result.is_wrong_value) {
    return Reply::broken(
        BreachKind::WrongAnswer,
        fmt::format("`{}` answered {}", leaf.name, *result.thrown));
  }
  return Reply::broken(
      BreachKind::Threw,
      fmt::format("`{}` threw: {}", leaf.name, *result.thrown));
}

void FunctionLeaves::halt(NodeId node) {
  Leaf& leaf = *leaves_[index(node)];
  if (leaf.task) {
    leaf.task->stop();
    if (leaf.task->is_busy()) leaf.halted_by = Clock::now() + within_;
    return;
  }
  if (!leaf.function.is_polled()) return;
  const run::Call as_told(tree_.node(node).id, leaf.name, 0, leaf.arguments);
  static_cast<void>(
      result_of([&] { return poll(leaf, as_told, run::Turn::Halt); }));
}

void FunctionLeaves::await_halted() {
  for (const auto& leaf : leaves_) {
    if (leaf && leaf->halted_by) leaf->task->wait_until(*leaf->halted_by);
  }
}

// --- What comes without a question ---------------------------------------

void FunctionLeaves::set(const VariableMove& move) {
  const std::lock_guard lock(moves_mutex_);
  moves_.push_back(move);
}

// What is set while the engine goes through them is for the next tick.
std::optional<VariableMove> FunctionLeaves::next_move(int tick, StateView) {
  if (moved_in_tick_ != tick) {
    moved_in_tick_ = tick;
    taken_.clear();
    next_move_ = 0;
    const std::lock_guard lock(moves_mutex_);
    std::swap(taken_, moves_);
  }
  if (next_move_ == taken_.size()) return std::nullopt;
  return taken_[next_move_++];
}

std::optional<Complaint> FunctionLeaves::complaint() {
  for (std::uint32_t n = 0; n < leaves_.size(); ++n) {
    Leaf* leaf = leaves_[n].get();
    if (leaf == nullptr || !leaf->halted_by) continue;
    if (!leaf->task->is_busy()) {
      leaf->halted_by.reset();
    } else if (Clock::now() >= *leaf->halted_by) {
      leaf->halted_by.reset();
      return Complaint{BreachKind::NotHalted, NodeId{n},
                       fmt::format("`{}` was halted and has not returned "
                                   "within {} ms",
                                   leaf->name, within_.count())};
    }
  }
  return std::nullopt;
}

}  // namespace btcheck

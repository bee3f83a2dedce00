// SPDX-License-Identifier: MIT
//
// No theory of causes is at work here (Beer et al., "Explaining
// counterexamples using causality", 2009, has one): a few patterns in which
// the semantics of behavior trees surprises people are looked for, the most
// specific first, and the first one that is really there is told. A fault goes
// before all others, because it is what ends the run.
//
// Here are the explanations from values, and, where neither a rule of the tree
// nor a choice that makes the difference is to be blamed, the last thing that
// the world chose.
#include "trace/why/why.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "model/tree/node_types.hpp"
#include "model/tree/reads.hpp"
#include "text/findings.hpp"
#include "trace/run/record.hpp"
#include "trace/why/nearest.hpp"
#include "trace/why/story.hpp"

namespace btcheck {
namespace {

// Expressions of a node evaluated in one state of the run, with assignments
// executed on the way.
class Evaluation {
 public:
  Evaluation(const Story& story, std::size_t state)
      : story_(story), state_(state) {
    for (std::uint32_t v = 0; v < story.tree.variables.size(); ++v) {
      values_.push_back(story.value(state, StateVariableId{v}));
    }
  }

  std::int64_t value(const Expression& expression) const {
    return expression.evaluate([this](const Term& term) -> std::int64_t {
      const auto number = static_cast<std::uint32_t>(term.operand);
      if (term.operation == Operation::Variable) return values_[number];
      return static_cast<std::int64_t>(story_.status(state_, NodeId{number}));
    });
  }
  bool divides_by_zero(const Expression& expression) const {
    return std::ranges::any_of(
        expression.divisors(),
        [&](const Expression& divisor) { return value(divisor) == 0; });
  }
  void assign(StateVariableId variable, std::int64_t to) {
    values_[index(variable)] = to;
  }

 private:
  const Story& story_;
  std::size_t state_;
  std::vector<std::int64_t> values_;  // by StateVariableId
};

// The first of the assignments that goes wrong, in words.
std::string fault_of(const Story& story, Evaluation evaluation,
                     const std::string& name,
                     const std::vector<StateAssignment>& assignments) {
  for (const StateAssignment& assignment : assignments) {
    const StateVariable& variable = story.tree.variable(assignment.variable);
    if (evaluation.divides_by_zero(assignment.value)) {
      return fmt::format("{} divides by zero to set {}", name, variable.name);
    }
    if (evaluation.value(assignment.fits) == 0) {
      return fmt::format("{} would set {} to a value between two of its steps",
                         name, variable.name);
    }
    const std::int64_t to = evaluation.value(assignment.value);
    if (to < variable.min || to > variable.max) {
      return fmt::format("{} would set {} to {}, outside its range {} to {}",
                         name, variable.name, variable.scale.text(to),
                         variable.scale.text(variable.min),
                         variable.scale.text(variable.max));
    }
    evaluation.assign(assignment.variable, to);
  }
  return "";
}

// What goes wrong in a leaf that ends in `error`. Of an action with effects
// on success and on failure it cannot be told which were meant, if both fail.
std::string fault_of(const Story& story, NodeId id, std::size_t state) {
  const Node& node = story.tree.node(id);
  const std::string name = story.name(id);
  const Evaluation evaluation(story, state);
  if (evaluation.divides_by_zero(node.expression) ||
      evaluation.divides_by_zero(node.contract.needed())) {
    return name + " divides by zero";
  }
  if (node.assignment) {
    return fault_of(story, evaluation, name, {*node.assignment});
  }
  const std::string on_success =
      fault_of(story, evaluation, name, node.contract.on_success);
  const std::string on_failure =
      fault_of(story, evaluation, name, node.contract.on_failure);
  if (on_success.empty()) return on_failure;
  return on_failure.empty() ? on_success : "";
}

// The leaf that looks at the variable in this step, to decide by it.
std::optional<NodeId> looks_at(const Story& story, std::size_t step,
                               StateVariableId variable) {
  const Automaton* mover = story.mover(step);
  if (!mover || mover->kind != AutomatonKind::Node ||
      !is_answer(story.target(step).role)) {
    return std::nullopt;
  }
  const Node& node = story.tree.node(mover->node);
  const bool decides =
      (node.type == NodeType::Eval && !node.assignment &&
       reads(node.expression, variable)) ||
      (is_leaf(node.type) && reads(node.contract.needed(), variable));
  return decides ? std::optional(mover->node) : std::nullopt;
}

// The last look at a variable, its last move, and the next action after it.
struct Change {
  std::size_t looked = 0;
  std::optional<NodeId> looker;
  std::size_t moved = 0;
  std::optional<NodeId> used;
};

std::optional<std::size_t> last_move(const Story& story,
                                     StateVariableId variable) {
  for (std::size_t i = story.all().end; i > 0; --i) {
    const Automaton* mover = story.mover(i - 1);
    if (mover && mover->kind == AutomatonKind::StateVariable &&
        mover->state_variable == variable) {
      return i - 1;
    }
  }
  return std::nullopt;
}

// Nothing where the variable is looked at again afterwards, has its old value,
// or moves in the loop.
std::optional<Change> change_of(const Story& story, StateVariableId variable) {
  const auto moved = last_move(story, variable);
  if (!moved || (story.loop() && *moved >= story.loop()->begin)) {
    return std::nullopt;
  }
  Change change;
  change.moved = *moved;
  for (std::size_t i = 0; i < story.all().end; ++i) {
    const auto looker = looks_at(story, i, variable);
    if (looker && i > *moved) return std::nullopt;
    if (looker) {
      change.looked = i;
      change.looker = looker;
    }
    const auto ticked = story.entering(i, LocationRole::Tick);
    if (ticked && i > *moved && !change.used &&
        story.tree.node(*ticked).type == NodeType::Action) {
      change.used = ticked;
    }
  }
  const bool differs =
      story.value(change.looked, variable) != story.value(*moved + 1, variable);
  const bool stays = story.value(*moved + 1, variable) ==
                     story.value(story.run.steps.size(), variable);
  if (!change.looker || !differs || !stays) return std::nullopt;
  return change;
}

std::string ends_in_fault(const Case& about) {
  for (std::size_t i = about.all().end; i > 0; --i) {
    const auto node = about.entering(i - 1, LocationRole::Error);
    if (!node) continue;
    std::string fault = fault_of(about, *node, i - 1);
    return fault.empty() ? "" : fault + "; the run ends there.";
  }
  return "";
}

std::string changes_meanwhile(const Case& about) {
  for (std::uint32_t v = 0; v < about.tree.variables.size(); ++v) {
    const StateVariableId variable{v};
    const auto change = change_of(about, variable);
    if (!change) continue;
    const bool concerns_node =
        change->used && contains(about.subjects.nodes, *change->used);
    if (!concerns_node && !contains(about.subjects.variables, variable))
      continue;
    const std::string then =
        change->used
            ? fmt::format(" and before {} is ticked", about.name(*change->used))
            : "";
    const StateVariable& of = about.tree.variable(variable);
    return fmt::format("{} changes from {} to {} after {} has looked at it{}.",
                       of.name,
                       of.value_name(about.value(change->looked, variable)),
                       of.value_name(about.value(change->moved + 1, variable)),
                       about.name(*change->looker), then);
  }
  return "";
}

// A choice of the run, in words.
struct Choice {
  std::size_t step = 0;
  std::string told;
};

std::vector<Choice> choices_of(const Case& about) {
  std::vector<Choice> choices;
  for (std::size_t i = 0; i < about.all().end; ++i) {
    const auto event = event_of(about.tree, about.network, about.run.state(i),
                                about.run.steps[i]);
    if (!event || !event->is_chosen) continue;
    const bool is_timer = about.mover(i)->kind == AutomatonKind::Timer;
    choices.push_back({i, (is_timer ? "that " : "") + event->text});
  }
  return choices;
}

std::string with_time(const Case& about, const Choice& choice) {
  const std::string when = about.when(choice.step);
  return when.empty() ? choice.told : choice.told + " " + when;
}

std::string only_choice(const Case& about) {
  const std::vector<Choice> choices = choices_of(about);
  const bool is_only = choices.size() == 1 &&
                       (!about.loop() || choices[0].step < about.loop()->begin);
  if (!is_only) return "";
  return fmt::format("It takes no more than {}.", with_time(about, choices[0]));
}

std::string last_choice(const Case& about) {
  const std::vector<Choice> choices = choices_of(about);
  if (choices.empty() || about.loop()) return "";
  const bool is_end = choices.back().step + 1 == about.all().end;
  return fmt::format("The last choice is {}{}.",
                     with_time(about, choices.back()),
                     is_end ? "" : "; the rest the tree does by itself");
}

// What keeps a run in its loop: the choices that come in every round, or that
// there is none any more.
std::string keeps_in_loop(const Case& about) {
  if (!about.loop()) return "";
  const std::vector<Choice> choices = choices_of(about);
  const auto first = std::ranges::find_if(choices, [&](const Choice& choice) {
    return choice.step >= about.loop()->begin;
  });
  std::vector<std::string> repeated;
  for (auto at = first; at != choices.end(); ++at) {
    if (!contains(repeated, at->told)) repeated.push_back(at->told);
  }
  constexpr std::size_t kMost = 3;
  if (repeated.size() > kMost) {
    const std::size_t more = repeated.size() - kMost + 1;
    repeated.resize(kMost);
    repeated.back() = fmt::format("{} others", more);
  }
  if (!repeated.empty()) {
    return fmt::format("Every round of the loop needs {}.",
                       enumerated(repeated));
  }
  if (choices.empty()) return "Nothing is chosen: the tree goes so by itself.";
  return fmt::format(
      "After {} nothing is chosen any more: the tree goes on so "
      "by itself.",
      with_time(about, choices.back()));
}

StepRange part_to_explain(const Story& story,
                          std::optional<std::size_t> trigger_state) {
  if (story.loop()) return *story.loop();
  StepRange part = story.all();
  if (trigger_state) {
    part.begin = *trigger_state;
    return part;
  }
  for (std::size_t i = 0; i < part.end; ++i) {
    if (story.run.steps[i].step.elapsed > 0) part.begin = i + 1;
  }
  return part;
}

}  // namespace

std::string Story::when(std::size_t step) const {
  if (network.ticks == TickSemantics::None) return "";
  int time = 0;
  for (std::size_t i = 0; i <= step; ++i) time += run.steps[i].step.elapsed;
  const bool is_tick = network.ticks == TickSemantics::Root;
  if (time == 0) return "at the start";
  return fmt::format("{} {}", is_tick ? "in tick" : "at time", time);
}

std::string Story::names(const std::vector<NodeId>& nodes) const {
  std::vector<std::string> all;
  for (const NodeId node : nodes) all.push_back(name(node));
  return enumerated(all);
}

std::string why(const BehaviorTree& tree, const Network& network,
                const Run& run, const Subjects& subjects,
                std::optional<std::size_t> trigger_state,
                const BrokenRule& broken) {
  const Story story{tree, network, run};
  const Case about{story, subjects, part_to_explain(story, trigger_state)};
  const auto nearest = [&](const Case&) {
    return broken.rule ? nearest_right(story, broken, trigger_state)
                       : std::string();
  };
  const std::function<std::string(const Case&)> all_reasons[] = {
      ends_in_fault,
      reasons::runs_for_ever,
      reasons::passes_over,
      reasons::halts_sibling,
      reasons::is_skipped,
      changes_meanwhile,
      nearest,
      reasons::has_ended,
      reasons::nobody_moves,
      only_choice,
      last_choice,
      keeps_in_loop};
  for (const auto& reason : all_reasons) {
    std::string sentence = reason(about);
    if (!sentence.empty()) return sentence;
  }
  return "";
}

std::vector<NodeId> running_for_ever(const BehaviorTree& tree,
                                     const Network& network, const Run& run) {
  const Story story{tree, network, run};
  std::vector<NodeId> found;
  if (!story.loop()) return found;
  const StepRange loop = *story.loop();
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const NodeId node{n};
    if (tree.nodes[n].type != NodeType::Action || tree.nodes[n].duration) {
      continue;
    }
    const auto enters = [&](LocationRole role) {
      return story.enters(loop, node, role);
    };
    using enum LocationRole;
    const bool ends = enters(Success) || enters(Failure) || enters(Halted);
    if (!ends && enters(Tick) && enters(Running)) found.push_back(node);
  }
  return found;
}

}  // namespace btcheck

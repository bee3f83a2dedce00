// SPDX-License-Identifier: MIT
//
// Explanations from values: an assignment that leaves its range, a variable
// that moves between the look at it and the deed; and, where no rule of the
// tree is to be blamed, the last thing that the world chose.
#include <fmt/format.h>

#include <algorithm>

#include "model/tree/node_types.hpp"
#include "trace/run/event.hpp"
#include "trace/why/rules.hpp"

namespace btcheck::reasons {
namespace {

// Expressions of a node evaluated in one state of the run, with assignments
// executed on the way.
class Evaluation {
 public:
  Evaluation(const Story& story, std::size_t state)
      : story_(story), state_(state) {
    for (std::uint32_t v = 0; v < story.tree().variables.size(); ++v) {
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
    const std::vector<Expression> divisors = expression.divisors();
    return std::any_of(
        divisors.begin(), divisors.end(),
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
    const StateVariable& variable = story.tree().variable(assignment.variable);
    if (evaluation.divides_by_zero(assignment.value)) {
      return fmt::format("{} divides by zero to set {}", name, variable.name);
    }
    const std::int64_t to = evaluation.value(assignment.value);
    if (to < variable.min || to > variable.max) {
      return fmt::format("{} would set {} to {}, outside its range {} to {}",
                         name, variable.name, to, variable.min, variable.max);
    }
    evaluation.assign(assignment.variable, to);
  }
  return "";
}

// What goes wrong in a leaf that ends in `error`. Of an action with effects
// on success and on failure it cannot be told which were meant, if both fail.
std::string fault_of(const Story& story, NodeId id, std::size_t state) {
  const Node& node = story.tree().node(id);
  const std::string name = short_name(story.tree(), id);
  const Evaluation evaluation(story, state);
  if (evaluation.divides_by_zero(node.expression) ||
      evaluation.divides_by_zero(node.contract.requirement)) {
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

bool reads(const Expression& expression, StateVariableId variable) {
  const auto terms = expression.terms();
  return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
    return term.operation == Operation::Variable &&
           static_cast<std::uint32_t>(term.operand) == index(variable);
  });
}

// The leaf that looks at the variable in this step, to decide by it.
std::optional<NodeId> looks_at(const Story& story, std::size_t step,
                               StateVariableId variable) {
  const Automaton* mover = story.mover(step);
  if (!mover || mover->kind != AutomatonKind::Node ||
      !story.answers(step, mover->node)) {
    return std::nullopt;
  }
  const Node& node = story.tree().node(mover->node);
  const bool decides =
      (node.type == NodeType::Eval && !node.assignment &&
       reads(node.expression, variable)) ||
      (is_leaf(node.type) && reads(node.contract.requirement, variable));
  return decides ? std::optional(mover->node) : std::nullopt;
}

// The last look at a variable, its last move, and the next action after it.
struct Change {
  std::size_t looked = 0;
  NodeId looker{};
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
  bool is_looked_at = false;
  for (std::size_t i = 0; i < story.all().end; ++i) {
    const auto looker = looks_at(story, i, variable);
    if (looker && i > *moved) return std::nullopt;
    if (looker) {
      change.looked = i;
      change.looker = *looker;
      is_looked_at = true;
    }
    const auto ticked = story.entering(i, LocationRole::Tick);
    if (ticked && i > *moved && !change.used &&
        story.tree().node(*ticked).type == NodeType::Action) {
      change.used = ticked;
    }
  }
  const bool differs =
      story.value(change.looked, variable) != story.value(*moved + 1, variable);
  const bool stays = story.value(*moved + 1, variable) ==
                     story.value(story.run().steps.size(), variable);
  if (!is_looked_at || !differs || !stays) return std::nullopt;
  return change;
}

}  // namespace

std::string ends_in_fault(const Case& about) {
  const Story& story = about.story;
  for (std::size_t i = story.all().end; i > 0; --i) {
    const auto node = story.entering(i - 1, LocationRole::Error);
    if (!node) continue;
    std::string fault = fault_of(story, *node, i - 1);
    return fault.empty() ? "" : fault + "; the run ends there.";
  }
  return "";
}

std::string changes_meanwhile(const Case& about) {
  const Story& story = about.story;
  const Subjects& subjects = about.subjects;
  for (std::uint32_t v = 0; v < story.tree().variables.size(); ++v) {
    const StateVariableId variable{v};
    const auto change = change_of(story, variable);
    if (!change) continue;
    const auto is_in = [](const auto& ids, auto id) {
      return std::find(ids.begin(), ids.end(), id) != ids.end();
    };
    const bool concerns_node =
        change->used && is_in(subjects.nodes, *change->used);
    if (!concerns_node && !is_in(subjects.variables, variable)) continue;
    const std::string then =
        change->used ? fmt::format(" and before {} is ticked",
                                   short_name(story.tree(), *change->used))
                     : "";
    return fmt::format("{} changes from {} to {} after {} has looked at it{}.",
                       story.tree().variable(variable).name,
                       story.value_name(change->looked, variable),
                       story.value_name(change->moved + 1, variable),
                       short_name(story.tree(), change->looker), then);
  }
  return "";
}

std::string last_choice(const Case& about) {
  const Story& story = about.story;
  std::string last;
  std::size_t step = 0;
  std::size_t choices = 0;
  for (std::size_t i = 0; i < story.all().end; ++i) {
    const auto event = event_of(story.tree(), story.network(),
                                story.run().state(i), story.run().steps[i]);
    if (!event || !event->is_chosen) continue;
    if (story.loop() && i >= story.loop()->begin) return "";
    const bool is_timer = story.mover(i)->kind == AutomatonKind::Timer;
    last = (is_timer ? "that " : "") + event->text;
    step = i;
    ++choices;
  }
  if (choices == 0) return "";
  // On a run without an end the choice that matters may have come before.
  if (story.loop() && choices > 1) return "";
  const std::string when = story.when(step);
  const std::string told = when.empty() ? last : last + " " + when;
  if (choices == 1) return fmt::format("It takes no more than {}.", told);
  const bool is_end = step + 1 == story.all().end;
  return fmt::format("The last choice is {}{}.", told,
                     is_end ? "" : "; the rest the tree does by itself");
}

}  // namespace btcheck::reasons

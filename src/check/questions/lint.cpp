// SPDX-License-Identifier: MIT
//
// How a node can end is worked out from its children, from the leaves upwards.
// Where that depends on more than its children's answers, both ends are taken
// to be possible, so that what is ruled out is ruled out for certain.
#include "check/questions/lint.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace btcheck {
namespace {

// The answer of a child after which the next child is ticked: success under a
// Sequence, failure under a Fallback. Other nodes may tick any child.
enum class PassesOn : std::uint8_t { OnSuccess, OnFailure, Otherwise };

PassesOn passes_on(NodeType type) {
  switch (type) {
    case NodeType::Sequence:
    case NodeType::SequenceWithMemory:
    case NodeType::ReactiveSequence:
    case NodeType::PipelineSequence:
      return PassesOn::OnSuccess;
    case NodeType::Fallback:
    case NodeType::ReactiveFallback:
      return PassesOn::OnFailure;
    default:
      return PassesOn::Otherwise;
  }
}

bool lets_pass(PassesOn how, const Outcomes& child) {
  switch (how) {
    case PassesOn::OnSuccess:
      return child.may_succeed;
    case PassesOn::OnFailure:
      return child.may_fail;
    case PassesOn::Otherwise:
      break;
  }
  return true;
}

// Which child of the node is the last that a tick can get to.
std::size_t last_reached(const Node& node,
                         const std::vector<Outcomes>& outcomes) {
  const PassesOn how = passes_on(node.type);
  std::size_t last = 0;
  while (last + 1 < node.children.size() &&
         lets_pass(how, outcomes[index(node.children[last])])) {
    ++last;
  }
  return last;
}

// Of a Sequence: the last child that is reached succeeds, or one before it
// fails. A Fallback is the same the other way round.
Outcomes in_order(const Node& node, const std::vector<Outcomes>& outcomes,
                  bool Outcomes::*passing, bool Outcomes::*stopping) {
  const std::size_t last = last_reached(node, outcomes);
  Outcomes made;
  made.*stopping = false;
  for (std::size_t i = 0; i <= last; ++i) {
    made.*stopping |= outcomes[index(node.children[i])].*stopping;
  }
  made.*passing = outcomes[index(node.children[last])].*passing;
  return made;
}

Outcomes of_leaf(const Node& node) {
  const LeafContract& contract = node.contract;
  switch (node.type) {
    case NodeType::Action:
    case NodeType::Condition:
      return {contract.may_succeed,
              contract.may_fail || !contract.requirement.is_true()};
    case NodeType::SetSV:
      return {true, false};
    case NodeType::Eval:
      return {true, !node.assignment.has_value()};
    default:
      return {};
  }
}

Outcomes of_inner(const Node& node, const std::vector<Outcomes>& outcomes) {
  const Outcomes first = outcomes[index(node.children[0])];
  const bool ends = first.may_succeed || first.may_fail;
  switch (node.type) {
    case NodeType::BehaviorTree:
    case NodeType::SubTree:
      return first;
    case NodeType::Inverter:
      return {first.may_fail, first.may_succeed};
    case NodeType::ForceSuccess:
      return {ends, false};
    case NodeType::ForceFailure:
      return {false, ends};
    default:
      break;
  }
  switch (passes_on(node.type)) {
    case PassesOn::OnSuccess:
      return in_order(node, outcomes, &Outcomes::may_succeed,
                      &Outcomes::may_fail);
    case PassesOn::OnFailure:
      return in_order(node, outcomes, &Outcomes::may_fail,
                      &Outcomes::may_succeed);
    case PassesOn::Otherwise:
      break;
  }
  return {};
}

// Every expression of a node and of its contract.
template <class Visit>
void for_each_expression(const Node& node, const Visit& visit) {
  visit(node.expression);
  visit(node.contract.requirement);
  if (node.assignment) visit(node.assignment->value);
  for (const auto* effects :
       {&node.contract.on_success, &node.contract.on_failure}) {
    for (const StateAssignment& effect : *effects) visit(effect.value);
  }
}

class Linter {
 public:
  Linter(const BehaviorTree& tree, const SourceText& source)
      : tree_(tree), source_(source) {}

  void look_at_assignments();
  void look_at_dead_nodes();
  void look_at_reactive_nodes();
  void look_at_variables(const std::vector<const PropertyFile*>& rules);

  // A subtree that stands in several places is one text.
  std::vector<Diagnostic> take() {
    const auto key = [](const Diagnostic& of) {
      return std::tie(of.span.line, of.span.column, of.code, of.message);
    };
    std::stable_sort(
        found_.begin(), found_.end(),
        [&](const auto& one, const auto& two) { return key(one) < key(two); });
    found_.erase(std::unique(found_.begin(), found_.end(),
                             [&](const auto& one, const auto& two) {
                               return key(one) == key(two);
                             }),
                 found_.end());
    return std::move(found_);
  }

 private:
  void warn(std::string_view code, SourceSpan span, std::string message,
            std::string label, std::string help) {
    found_.push_back(source_.diagnostic(Severity::Warning, code, span,
                                        std::move(message), std::move(label),
                                        std::move(help)));
  }
  // The same at a node, whose file may be an included one.
  void warn_at(NodeId node, std::string_view code, std::string message,
               std::string label, std::string help) {
    warn(code, tree_.node(node).span, std::move(message), std::move(label),
         std::move(help));
    if (tree_.node(node).included == 0) return;
    found_.back().file = tree_.file_of(node);
    found_.back().source_line.clear();
  }
  void look_at(const StateAssignment& assignment);
  bool is_measured(StateVariableId variable) const;
  bool is_read(StateVariableId variable) const;

  const BehaviorTree& tree_;
  const SourceText& source_;
  std::vector<Diagnostic> found_;
};

bool Linter::is_measured(StateVariableId variable) const {
  return std::any_of(
      tree_.nodes.begin(), tree_.nodes.end(), [&](const Node& node) {
        return node.type == NodeType::SetSV && node.variable == variable;
      });
}

bool Linter::is_read(StateVariableId variable) const {
  bool is_read = false;
  for (const Node& node : tree_.nodes) {
    for_each_expression(node, [&](const Expression& expression) {
      for (const Term& term : expression.terms()) {
        is_read |= term.operation == Operation::Variable &&
                   term.operand == static_cast<std::int32_t>(index(variable));
      }
    });
  }
  return is_read;
}

// Of a variable whose transitions are never asked, it is said there.
void Linter::look_at(const StateAssignment& assignment) {
  const StateVariable& variable = tree_.variable(assignment.variable);
  const auto terms = assignment.value.terms();
  const bool is_constant =
      terms.size() == 1 && terms[0].operation == Operation::Constant;
  const bool are_asked = is_measured(assignment.variable) ||
                         moves_freely(tree_, assignment.variable);
  if (!is_constant || !are_asked || variable.transitions.empty()) return;
  const int value = terms[0].operand;
  const bool is_led_to =
      std::any_of(variable.transitions.begin(), variable.transitions.end(),
                  [&](const auto& pair) { return pair.second == value; });
  if (is_led_to) return;
  warn("BT2301", assignment.span,
       fmt::format("no transition of `{}` leads to `{}`", variable.name,
                   variable.value_name(value)),
       "assigned all the same",
       fmt::format("add a pair to `:transitions` on line {}, or assign another "
                   "state",
                   variable.span.line));
}

void Linter::look_at_assignments() {
  for (const Node& node : tree_.nodes) {
    if (node.assignment) look_at(*node.assignment);
    for (const auto* effects :
         {&node.contract.on_success, &node.contract.on_failure}) {
      for (const StateAssignment& effect : *effects) look_at(effect);
    }
  }
}

// The reader of XML trees has found them, with what its scripts say (BT1629).
void Linter::look_at_dead_nodes() {
  if (is_engine(tree_.profile)) return;
  for (const NodeId id : dead_nodes(tree_)) {
    const Node& node = tree_.node(id);
    const Node& parent = tree_.node(node.parent);
    const auto place =
        std::find(parent.children.begin(), parent.children.end(), id);
    const Node& before = tree_.node(*std::prev(place));
    const std::string_view never =
        passes_on(parent.type) == PassesOn::OnSuccess ? "succeeds" : "fails";
    warn("BT2302", node.span,
         fmt::format("`{}` can never be ticked", node.name),
         fmt::format("`{}` on line {} never {}", before.name, before.span.line,
                     never),
         "delete it, or look what the node before it is meant to answer");
  }
}

// Which nodes of an XML tree may answer running because a leaf below does.
std::vector<bool> runners(const BehaviorTree& tree) {
  std::vector<bool> runs(tree.nodes.size(), false);
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Node& node = tree.nodes[i];
    runs[i] = (node.type == NodeType::Action && node.contract.may_run) ||
              node.type == NodeType::Wait ||
              std::any_of(node.children.begin(), node.children.end(),
                          [&](NodeId child) { return runs[index(child)]; });
  }
  return runs;
}

// On each tick all children up to the one that runs are ticked: one before it
// begins anew, and halts it when it runs in its turn.
void Linter::look_at_reactive_nodes() {
  if (!is_engine(tree_.profile)) return;
  const std::vector<bool> runs = runners(tree_);
  for (const Node& node : tree_.nodes) {
    if (node.type != NodeType::ReactiveSequence &&
        node.type != NodeType::ReactiveFallback) {
      continue;
    }
    std::vector<NodeId> running;
    std::copy_if(node.children.begin(), node.children.end(),
                 std::back_inserter(running),
                 [&](NodeId child) { return runs[index(child)]; });
    if (running.size() < 2) continue;
    const std::string first = tree_.node(running[0]).name;
    warn_at(running[1], "BT2305",
            fmt::format("`{}` and `{}` can both run under `{}`", first,
                        tree_.node(running[1]).name, node.name),
            fmt::format("halted whenever `{}` runs again", first),
            fmt::format("let one child of a {} run; conditions and actions "
                        "that end at once may stand before it",
                        type_name(node.type)));
  }
}

bool names(const PropertyFile& rules, const StateVariable& variable) {
  return std::any_of(
      rules.atoms.begin(), rules.atoms.end(), [&](const Atom& atom) {
        return equal_ignoring_case(atom.left.name, variable.name) ||
               equal_ignoring_case(atom.right.name, variable.name) ||
               equal_ignoring_case(atom.node, variable.name);
      });
}

// Of entries, the ports of leaves that read them are not in the tree.
void Linter::look_at_variables(const std::vector<const PropertyFile*>& rules) {
  if (is_engine(tree_.profile)) return;
  for (std::uint32_t i = 0; i < tree_.variables.size(); ++i) {
    const StateVariableId id{i};
    const StateVariable& variable = tree_.variable(id);
    const bool is_named =
        std::any_of(rules.begin(), rules.end(),
                    [&](const auto* file) { return names(*file, variable); });
    if (!is_written(tree_, id) && !is_read(id) && !is_named) {
      warn("BT2303", variable.span,
           fmt::format("nothing reads or writes `{}`", variable.name),
           moves_freely(tree_, id) ? "it moves, and multiplies the states" : "",
           "delete it, or name the rules that speak of it by --prop");
    } else if (!variable.transitions.empty() && is_written(tree_, id) &&
               !moves_freely(tree_, id) && !is_measured(id)) {
      warn("BT2304", variable.span,
           fmt::format("the `:transitions` of `{}` have no effect",
                       variable.name),
           "only `:=` writes it, which does not ask them",
           "delete them, or measure the variable with SetSV");
    }
  }
}

}  // namespace

std::vector<Outcomes> possible_outcomes(const BehaviorTree& tree) {
  std::vector<Outcomes> outcomes(tree.nodes.size());
  // Children have larger numbers than their parents.
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Node& node = tree.nodes[i];
    outcomes[i] =
        node.children.empty() ? of_leaf(node) : of_inner(node, outcomes);
  }
  return outcomes;
}

std::vector<NodeId> dead_nodes(const BehaviorTree& tree) {
  const std::vector<Outcomes> outcomes = possible_outcomes(tree);
  std::vector<bool> is_dead(tree.nodes.size(), false);
  std::vector<NodeId> dead;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& node = tree.nodes[i];
    if (node.children.empty()) continue;
    const std::size_t last = last_reached(node, outcomes);
    for (std::size_t c = 0; c < node.children.size(); ++c) {
      const NodeId child = node.children[c];
      is_dead[index(child)] = is_dead[i] || c > last;
      if (!is_dead[i] && c == last + 1) dead.push_back(child);
    }
  }
  return dead;
}

std::vector<Diagnostic> lint(const BehaviorTree& tree, const SourceText& source,
                             const std::vector<const PropertyFile*>& rules) {
  Linter linter(tree, source);
  linter.look_at_assignments();
  linter.look_at_dead_nodes();
  linter.look_at_reactive_nodes();
  linter.look_at_variables(rules);
  return linter.take();
}

}  // namespace btcheck

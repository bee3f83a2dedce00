// SPDX-License-Identifier: MIT
#include "check/questions/lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "check/findings/words.hpp"
#include "check/questions/interruptions.hpp"
#include "model/tree/answers.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/reads.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

// Those of a node and of its contract.
template <class Visit>
void for_each_assignment(const Node& node, const Visit& visit) {
  if (node.assignment) visit(*node.assignment);
  for (const auto* effects :
       {&node.contract.on_success, &node.contract.on_failure}) {
    for (const StateAssignment& effect : *effects) visit(effect);
  }
}

bool names(const PropertyFile& rules, const StateVariable& variable) {
  return std::ranges::any_of(rules.atoms, [&](const Atom& atom) {
    bool is_named = equal_ignoring_case(atom.node, variable.name);
    visit_leaves(atom, [&](const Operand& each) {
      is_named |= equal_ignoring_case(each.name, variable.name);
    });
    return is_named;
  });
}

class Linter {
 public:
  Linter(const BehaviorTree& tree, const SourceText& source)
      : tree_(tree), source_(source) {
    for (const Node& node : tree.nodes) {
      if (node.type == NodeType::SetSV) measured_.insert(node.variable);
    }
  }

  std::vector<Diagnostic> findings(
      const std::vector<const PropertyFile*>& rules) {
    look_at_assignments();
    look_at_dead_nodes();
    look_at_reactive_nodes();
    look_at_variables(rules);
    // A subtree that stands in several places is one text.
    const auto key = [](const Diagnostic& of) {
      return std::tie(of.span.line, of.span.column, of.code, of.message);
    };
    std::ranges::stable_sort(found_, {}, key);
    const auto is_same = [&](const Diagnostic& one, const Diagnostic& other) {
      return key(one) == key(other);
    };
    found_.erase(std::unique(found_.begin(), found_.end(), is_same),
                 found_.end());
    return std::move(found_);
  }

 private:
  void look_at_assignments() {
    for (const Node& node : tree_.nodes) {
      for_each_assignment(node,
                          [&](const StateAssignment& each) { look_at(each); });
    }
  }

  // The reader of XML trees has found them, with what its scripts say (BT1629).
  void look_at_dead_nodes() {
    if (is_engine(tree_.profile)) return;
    for (const NeverTicked& found : never_ticked(tree_)) {
      const Node& node = tree_.node(found.node);
      warn("BT2302", node.span,
           fmt::format("`{}` can never be ticked", node.name), found.why,
           "delete it, or look what the node before it is meant to answer");
    }
  }

  // Guesses are told once for all.
  void look_at_reactive_nodes() {
    std::set<std::tuple<std::uint32_t, int, int>> places;  // of guesses
    std::size_t first_guess = 0;
    for (const Interruption& found : interruptions(tree_)) {
      const Node& node = tree_.node(found.node);
      const bool is_first = places.empty();
      if (found.is_guessed) {
        places.emplace(node.included, node.span.line, node.span.column);
      }
      if (found.is_guessed && !is_first) continue;
      if (found.is_guessed) first_guess = found_.size();
      tell_interruption(found);
    }
    const std::size_t guesses = places.size();
    if (guesses == 0) return;
    Diagnostic& guess = found_[first_guess];
    guess.severity = Severity::Note;
    if (guesses == 1) {
      guess.message += ", if their leaves do";
    } else {
      guess.message +=
          fmt::format(", if their leaves do; so can children of {} more node{}",
                      guesses - 1, guesses == 2 ? "" : "s");
    }
    guess.help = fmt::format(
        "no model tells of these leaves: say which end at once, in "
        "`<TreeNodesModel>` or by {}",
        word(Choice::Leaves));
  }

  void tell_interruption(const Interruption& found) {
    const Node& node = tree_.node(found.node);
    const std::string& first = tree_.node(found.first).name;
    warn_at(found.second, "BT2305",
            fmt::format("`{}` and `{}` can both run under `{}`", first,
                        tree_.node(found.second).name, node.name),
            fmt::format("halted whenever `{}` runs again", first),
            fmt::format("let one child of a {} run; conditions and actions "
                        "that end at once may stand before it",
                        in_words_of(tree_.profile, type_name(node.type))));
  }

  // Of entries, the ports of leaves that read them are not in the tree.
  void look_at_variables(const std::vector<const PropertyFile*>& rules) {
    if (is_engine(tree_.profile)) return;
    for (std::uint32_t i = 0; i < tree_.variables.size(); ++i) {
      const StateVariableId id{i};
      const StateVariable& variable = tree_.variable(id);
      const bool is_named = std::ranges::any_of(
          rules, [&](const auto* file) { return names(*file, variable); });
      if (!is_written(tree_, id) && !is_read(id) && !is_named) {
        warn("BT2303", variable.span,
             fmt::format("nothing reads or writes `{}`", variable.name),
             moves_freely(tree_, id) ? "it moves, and multiplies the states"
                                     : "",
             fmt::format("delete it, or name the rules that speak of it by {}",
                         word(Choice::Rules)));
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

  // Of a variable whose transitions are never asked, it is said there.
  void look_at(const StateAssignment& assignment) {
    const StateVariable& variable = tree_.variable(assignment.variable);
    const auto terms = assignment.value.terms();
    const bool is_constant =
        terms.size() == 1 && terms[0].operation == Operation::Constant;
    if (!is_constant || variable.transitions.empty()) return;
    const bool are_asked = is_measured(assignment.variable) ||
                           moves_freely(tree_, assignment.variable);
    if (!are_asked) return;
    const int value = terms[0].operand;
    const bool is_led_to = std::ranges::any_of(
        variable.transitions,
        [&](const auto& pair) { return pair.second == value; });
    if (is_led_to) return;
    warn("BT2301", assignment.span,
         fmt::format("no transition of `{}` leads to `{}`", variable.name,
                     variable.value_name(value)),
         "assigned all the same",
         fmt::format(
             "add a pair to `:transitions` on line {}, or assign another "
             "state",
             variable.span.line));
  }

  bool is_measured(StateVariableId variable) const {
    return measured_.contains(variable);
  }

  bool is_read(StateVariableId variable) const {
    bool is_read = false;
    for (const Node& node : tree_.nodes) {
      is_read |= reads(node.expression, variable) ||
                 reads(node.contract.needed(), variable);
      for_each_assignment(node, [&](const StateAssignment& assignment) {
        is_read |= reads(assignment.value, variable);
      });
    }
    return is_read;
  }

  const BehaviorTree& tree_;
  const SourceText& source_;
  std::set<StateVariableId> measured_;  // by a SetSV
  std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> lint(const BehaviorTree& tree, const SourceText& source,
                             const std::vector<const PropertyFile*>& rules) {
  const Stage stage("mistakes were looked for");
  return Linter(tree, source).findings(rules);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Arguments of nodes in comparisons: `goto_waypoint@39.z > 6`. Such a
// comparison speaks of the value that the node was given; while there is none
// it is neither true nor false. Codes: bind.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "check/bind/bind.hpp"
#include "check/bind/bound_property.hpp"
#include "model/automata/kept_arguments.hpp"

namespace btcheck {
namespace {

// Exactly spelled before in another case.
std::optional<std::size_t> argument_called(const Node& node,
                                           std::string_view name) {
  const auto& all = node.arguments;
  auto found = std::ranges::find(all, name, &Argument::key);
  if (found == all.end()) {
    found = std::ranges::find_if(all, [&](const Argument& each) {
      return equal_ignoring_case(each.key, name);
    });
  }
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

void ask(const BehaviorTree& tree, const NodeNames& names,
         const Operand& operand, AskedArguments& asked) {
  if (operand.node.empty() || operand.name == "status") return;
  const std::vector<NodeId> nodes = names.called(operand.node);
  if (nodes.size() != 1) return;
  const Node& node = tree.node(nodes[0]);
  const auto number = argument_called(node, operand.name);
  if (number && node.arguments[*number].known) asked[nodes[0]].insert(*number);
}

// A condition on single states while the nodes whose arguments it asks for are
// neither ticked nor running; what else it asks for is not known.
class WithoutArguments {
 public:
  WithoutArguments(const FormulaPool& formulas, FormulaId condition,
                   const std::vector<Atom>& atoms,
                   const std::vector<GivenArguments>& given,
                   const NodeNames& names)
      : formulas_(formulas),
        condition_(condition),
        atoms_(atoms),
        given_(given),
        names_(names) {
    for (const std::uint32_t atom : formulas.atoms(condition)) {
      if (atom >= given.size()) continue;
      nodes_.insert(given[atom].nodes.begin(), given[atom].nodes.end());
    }
  }

  // Certainly so.
  bool is(bool value) const {
    if (nodes_.empty()) return false;
    std::map<FormulaId, Truth> known;
    for (const FormulaId part : formulas_.nodes(condition_)) {
      const FormulaNode& node = formulas_[part];
      if (is_leaf(node.kind)) {
        known[part] = of_leaf(node);
      } else {
        const Truth left = known.at(node.left);
        known[part] = combined(
            node.kind, left, is_unary(node.kind) ? left : known.at(node.right));
      }
    }
    const Truth& whole = known.at(condition_);
    return value ? !whole.may_be_false : !whole.may_be_true;
  }

 private:
  struct Truth {
    bool may_be_true = true;
    bool may_be_false = true;
  };

  Truth of_leaf(const FormulaNode& node) const {
    if (node.kind != FormulaKind::Atom) {
      return {node.kind == FormulaKind::True, node.kind == FormulaKind::False};
    }
    if (node.atom >= given_.size()) return {};
    if (!given_[node.atom].nodes.empty()) return {false, true};
    const Atom& atom = atoms_[node.atom];
    if (atom.kind != AtomKind::NodeEvent || atom.process) return {};
    const std::vector<NodeId> of = names_.called(atom.node);
    const bool is_asked = of.size() == 1 && nodes_.contains(of[0]);
    return is_asked ? Truth{false, true} : Truth{};
  }

  static Truth combined(FormulaKind kind, Truth left, Truth right) {
    const auto opposite = [](Truth of) {
      return Truth{of.may_be_false, of.may_be_true};
    };
    const auto either = [](Truth one, Truth other) {
      return Truth{one.may_be_true || other.may_be_true,
                   one.may_be_false && other.may_be_false};
    };
    switch (kind) {
      case FormulaKind::Not:
        return opposite(left);
      case FormulaKind::And:
        return opposite(either(opposite(left), opposite(right)));
      case FormulaKind::Or:
        return either(left, right);
      case FormulaKind::Implies:
        return either(opposite(left), right);
      default:
        return {};
    }
  }

  const FormulaPool& formulas_;
  FormulaId condition_;
  const std::vector<Atom>& atoms_;
  const std::vector<GivenArguments>& given_;
  const NodeNames& names_;
  std::set<NodeId> nodes_;
};

}  // namespace

void keep_asked_arguments(const BehaviorTree& tree,
                          std::span<const PropertyFile* const> files,
                          Network& network) {
  if (is_engine(tree.profile)) return;
  const NodeNames names(tree);
  AskedArguments asked;
  for (const PropertyFile* file : files) {
    for (const Atom& atom : file->atoms) {
      visit_leaves(atom,
                   [&](const Operand& each) { ask(tree, names, each, asked); });
    }
  }
  if (!asked.empty()) keep_arguments(tree, asked, network);
}

std::optional<FormulaId> false_without_arguments(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Atom>& atoms, const std::vector<GivenArguments>& given,
    const NodeNames& names) {
  std::map<FormulaId, bool> is_of_states;
  for (const FormulaId id : formulas.nodes(formula)) {
    const FormulaNode& node = formulas[id];
    is_of_states[id] = is_leaf(node.kind) ||
                       (!is_temporal(node.kind) && is_of_states.at(node.left) &&
                        (is_unary(node.kind) || is_of_states.at(node.right)));
    const bool value = node.kind == FormulaKind::Eventually;
    if ((node.kind != FormulaKind::Always && !value) ||
        !is_of_states.at(node.left)) {
      continue;
    }
    if (WithoutArguments(formulas, node.left, atoms, given, names).is(value)) {
      return id;
    }
  }
  return std::nullopt;
}

std::vector<std::string> Binder::argument_names(NodeId node) const {
  std::vector<std::string> names;
  if (is_engine(tree_.profile)) return names;
  for (const Argument& each : tree_.node(node).arguments) {
    names.push_back(each.key);
  }
  return names;
}

// Nothing without a refusal where the node has no such argument.
std::optional<Binder::Side> Binder::side_of_argument(NodeId node,
                                                     const Operand& operand) {
  const Node& of = tree_.node(node);
  const auto number = argument_called(of, operand.name);
  if (!number || is_engine(tree_.profile)) return std::nullopt;
  const Argument& argument = of.arguments[*number];
  if (argument.key != operand.name) {
    warn_of_case(operand.span, operand.name, "argument", argument.key);
  }
  if (!argument.known) {
    return refuse("BT1111", operand.span,
                  fmt::format("nothing is known of the argument `{}` of `{}`",
                              argument.key, of.name),
                  fmt::format("it is `{}`, on line {}", argument.value,
                              argument.span.line),
                  argument.value.starts_with('$')
                      ? fmt::format("the program around the tree gives it; "
                                    "declare it: `(defsv {} ...)`",
                                    argument.value.substr(1))
                      : "only numbers, words, `$variables` and expressions "
                        "can be asked for");
  }
  const auto variable = kept_argument(network_, node, *number);
  if (!variable) return std::nullopt;
  given_.where = both(std::move(given_.where), has_arguments(network_, node));
  given_.nodes.push_back(node);
  return Side{variable, {}, {}};
}

}  // namespace btcheck

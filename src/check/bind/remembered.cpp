// SPDX-License-Identifier: MIT
#include "check/bind/remembered.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/node_names.hpp"
#include "model/automata/past_memory.hpp"
#include "model/automata/tick_memory.hpp"

namespace btcheck {
namespace {

class Remembered {
 public:
  Remembered(const BehaviorTree& tree, const Network& network)
      : tree_(tree), network_(network), names_(tree) {}

  std::vector<NodeId> nodes(std::span<const PropertyFile* const> files) {
    for (const PropertyFile* const file : files) {
      for (const Atom& atom : file->atoms) {
        if (atom.word == "tick.ends" || atom.kind == AtomKind::Previously) {
          add(tree_.roots[0]);
        }
        visit_leaves(atom,
                     [&](const Operand& side) { add_answer_of(atom, side); });
      }
    }
    return nodes_;
  }

 private:
  void add(NodeId node) {
    if (std::ranges::find(nodes_, node) == nodes_.end()) nodes_.push_back(node);
  }

  void add_answer_of(const Atom& atom, const Operand& side) {
    if (!equal_ignoring_case(side.name, kAnswerName)) return;
    if (equal_ignoring_case(side.node, "root")) return add(tree_.roots[0]);
    if (side.node.empty()) {
      const auto own = process_of(atom);
      if (own) add(*own);
      return;
    }
    const std::vector<NodeId> called = names_.called(side.node);
    if (called.size() == 1) add(called[0]);
  }

  // The node in whose `value (...)` the name stands.
  std::optional<NodeId> process_of(const Atom& atom) const {
    const auto count = network_.automata.size();
    if (!atom.process || *atom.process < 1 ||
        static_cast<std::size_t>(*atom.process) > count) {
      return std::nullopt;
    }
    const Automaton& automaton =
        network_.automata[static_cast<std::size_t>(*atom.process) - 1];
    if (automaton.kind != AutomatonKind::Node) return std::nullopt;
    return automaton.node;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  NodeNames names_;
  std::vector<NodeId> nodes_;
};

PastOperator operator_of(AtomKind kind) {
  if (kind == AtomKind::Since) return PastOperator::Since;
  return kind == AtomKind::Once ? PastOperator::Once : PastOperator::Previously;
}

// A bit for each atom of the past. What is wrong with the names in it is said
// when the rules are bound.
void remember_past_of(const BehaviorTree& tree, const PropertyFile& file,
                      Network& network) {
  if (!std::ranges::any_of(file.atoms, is_past, &Atom::kind)) return;
  const SourceText nowhere("", "");
  std::vector<Diagnostic> ignored;
  Binder binder(tree, network, nowhere, ignored);
  std::vector<Proposition> known;
  const auto meant = [&](FormulaId formula) {
    auto predicate = predicate_of(file.formulas, formula, known);
    return predicate && !predicate->when_dead ? std::move(predicate->expression)
                                              : Expression::constant(0);
  };
  for (std::uint32_t number = 0; number < file.atoms.size(); ++number) {
    const Atom& atom = file.atoms[number];
    if (is_past(atom.kind)) {
      remember_past(
          tree,
          {operator_of(atom.kind), meant(atom.of),
           atom.kind == AtomKind::Since ? meant(atom.since) : Expression()},
          past_key(file, number), network);
    }
    known.push_back(binder.proposition(file, number, known));
    binder.take_given();
  }
}

}  // namespace

void remember_for(const BehaviorTree& tree,
                  std::span<const PropertyFile* const> files,
                  Network& network) {
  keep_asked_arguments(tree, files, network);
  const std::vector<NodeId> nodes = Remembered(tree, network).nodes(files);
  if (!nodes.empty()) remember_answers(tree, nodes, network);
  for (const PropertyFile* const file : files) {
    remember_past_of(tree, *file, network);
  }
}

}  // namespace btcheck

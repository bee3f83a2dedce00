// SPDX-License-Identifier: MIT
//
// Random properties of a tree: their text, and what it means.
//
// Text and meaning are made side by side. Formulas are printed in full and so
// say little about precedence, which has tests of its own.
#include "reference/random_property.hpp"

#include <fmt/format.h>

#include "model/tree/node_types.hpp"
#include "reference/random_pattern.hpp"

namespace btcheck::reference {

std::string text_of(const RandomProperty& property, FormulaId formula) {
  return "(" + property.pool.text(formula, [&](std::uint32_t atom) {
    return "(" + property.atoms[atom].text + ")";
  }) + ")";
}

namespace {

// never, always, possible, deadlockfree.
void make_state_property(RandomProperty& made, AtomMaker& maker) {
  made.formula =
      maker.state_formula(made.pool, 1 + static_cast<int>(maker.number(4)));
  const std::string text = text_of(made, made.formula);
  const std::uint32_t kind = maker.number(10);
  if (kind < 4) {
    made.form = PropertyForm::Never;
    made.body = (kind < 2 ? "never " : "absent ") + text;
  } else if (kind < 7) {
    made.form = PropertyForm::Invariant;
    made.body = "always " + text;
  } else if (kind < 9) {
    made.form = PropertyForm::Possible;
    made.body = "possible " + text;
  } else {
    made.form = PropertyForm::DeadlockFree;
    made.body = "deadlockfree";
  }
}

// A formula, or a form that stands for one.
void make_ltl_property(RandomProperty& made, AtomMaker& maker,
                       int most_temporal) {
  made.kind = PropertyKind::Ltl;
  made.form = PropertyForm::Ltl;
  FormulaPool& pool = made.pool;
  if (maker.number(10) < 6) {
    made.formula = maker.temporal_formula(pool, most_temporal);
    made.body = "ltl " + text_of(made, made.formula);
    return;
  }
  const FormulaId left = maker.state_formula(pool, 2);
  const FormulaId right = maker.state_formula(pool, 2);
  const FormulaId later = pool.unary(FormulaKind::Eventually, right);
  if (most_temporal < 2 || maker.number(5) == 0) {
    made.formula = later;
    made.body = "eventually " + text_of(made, right);
  } else if (maker.number(4) == 0) {
    made.formula = pool.unary(FormulaKind::Always, later);
    made.body = "infinitelyOften " + text_of(made, right);
  } else {
    made.formula = pool.unary(FormulaKind::Always,
                              pool.binary(FormulaKind::Implies, left, later));
    made.body = text_of(made, left) + " leadsto " + text_of(made, right);
  }
}

void make_branching_property(RandomProperty& made, AtomMaker& maker) {
  made.kind = PropertyKind::Branching;
  made.form = PropertyForm::Branching;
  FormulaPool& pool = made.pool;
  if (maker.percent(15)) {
    const FormulaId p = maker.state_formula(pool, 2);
    made.body = "live " + text_of(made, p);
    made.formula = pool.unary(
        FormulaKind::ForAllPaths,
        pool.unary(FormulaKind::Always,
                   pool.unary(FormulaKind::ExistsPath,
                              pool.unary(FormulaKind::Eventually, p))));
    return;
  }
  made.formula = maker.branching_formula(pool);
  made.body = text_of(made, made.formula);
}

// Some atoms become events of steps.
void make_event_property(RandomProperty& made, AtomMaker& maker,
                         int most_temporal) {
  made.kind = PropertyKind::Event;
  made.form = PropertyForm::Ltl;
  const std::uint32_t events = 1 + maker.number(2);
  for (std::uint32_t i = 0; i < events; ++i) made.atoms[i] = maker.step_atom();
  FormulaPool& pool = made.pool;
  if (maker.percent(25)) {
    const FormulaId event = maker.state_formula(pool, 2);
    made.body = "never " + text_of(made, event);
    made.formula =
        pool.unary(FormulaKind::Always, pool.unary(FormulaKind::Not, event));
    return;
  }
  made.formula = maker.temporal_formula(pool, most_temporal);
  made.body = "ltl " + text_of(made, made.formula);
}

// p => q of recurrences, or q alone; as LTL also where it is checked otherwise.
void assume_fairness(RandomProperty& property, AtomMaker& maker) {
  FormulaPool& pool = property.pool;
  const FormulaId q = maker.state_formula(pool, 2, 3);
  const std::string granted = "[] <> " + text_of(property, q);
  if (maker.percent(40)) {
    property.assumption.fairness.push_back({pool.constant(true), q});
    property.assumption.text += "assume " + granted + "\n";
    return;
  }
  const FormulaId p = maker.state_formula(pool, 2, 3);
  property.assumption.fairness.push_back({p, q});
  property.assumption.text += fmt::format("assume fair: ([] <> {}) => {}\n",
                                          text_of(property, p), granted);
}

void assume_formula(RandomProperty& property, AtomMaker& maker) {
  FormulaPool& pool = property.pool;
  const FormulaId p = maker.state_formula(pool, 2, 3);
  const std::string text = text_of(property, p);
  FormulaId claim = pool.unary(FormulaKind::Always, p);
  switch (maker.number(4)) {
    case 0:
      property.assumption.text += "assume always " + text + "\n";
      break;
    case 1:
      claim = pool.unary(FormulaKind::Always, pool.unary(FormulaKind::Not, p));
      property.assumption.text += "assume never " + text + "\n";
      break;
    case 2:
      claim = pool.unary(FormulaKind::Eventually, p);
      property.assumption.text += "assume end is <> " + text + "\n";
      break;
    default:
      claim = pool.unary(FormulaKind::Eventually, claim);
      property.assumption.text += "assume ltl <> [] " + text + "\n";
  }
  property.assumption.formula = claim;
}

std::size_t action_count(const BehaviorTree& tree) {
  std::size_t actions = 0;
  for (const Node& node : tree.nodes) {
    actions += node.type == NodeType::Action ? 1 : 0;
  }
  return actions;
}

}  // namespace

RandomProperty random_property(const BehaviorTree& tree, const Network& network,
                               SplitMix64& random,
                               const PropertyWeights& weights) {
  AtomMaker maker(tree, network, random);
  RandomProperty made;
  for (int i = 0; i < 3; ++i) made.atoms.push_back(maker.atom());
  const int kind = random.below(100);
  if (kind < 18 && weights.most_temporal > 0) {
    make_ltl_property(made, maker, weights.most_temporal);
  } else if (kind < 28 && weights.response) {
    make_response(made, maker);
  } else if (kind < 44 && weights.most_temporal > 0) {
    make_pattern(made, maker, weights.most_temporal);
  } else if (kind < 60 && weights.timed) {
    make_timed_pattern(made, maker);
  } else if (kind < 70 && weights.branching) {
    make_branching_property(made, maker);
  } else if (kind < 80 && weights.most_temporal > 0) {
    make_event_property(made, maker, weights.most_temporal);
  } else {
    make_state_property(made, maker);
  }
  return made;
}

void assume_something(RandomProperty& property, const BehaviorTree& tree,
                      const Network& network, SplitMix64 stream) {
  AtomMaker maker(tree, network, stream);
  for (int i = 0; i < 3; ++i) property.atoms.push_back(maker.atom());
  const std::size_t actions = action_count(tree);
  const std::uint32_t kind = maker.number(10);
  if (kind < 4 && actions > 0 && actions < 4) {
    property.assumption.actions_end = true;
    property.assumption.by_option = maker.percent(50);
    if (!property.assumption.by_option) {
      property.assumption.text = "assume every action eventually ends\n";
    }
    if (maker.percent(20)) assume_fairness(property, maker);
  } else if (kind < 8) {
    assume_fairness(property, maker);
  } else {
    assume_formula(property, maker);
    if (maker.percent(30)) assume_fairness(property, maker);
  }
}

}  // namespace btcheck::reference

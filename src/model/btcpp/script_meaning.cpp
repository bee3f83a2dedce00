// SPDX-License-Identifier: MIT
//
// A script is run twice: as a whole, for the conditions, and statement by
// statement from any state, for the assignments. So a statement's assignments
// only have to be put into an order among themselves, and most have one.
#include "model/btcpp/script_meaning.hpp"

#include <algorithm>
#include <utility>

#include "model/btcpp/script.hpp"
#include "model/btcpp/script_run.hpp"
#include "model/btcpp/script_writers.hpp"

namespace btcheck::btcpp {
namespace {

Expression constant(std::size_t value) {
  return Expression::constant(static_cast<std::int32_t>(value));
}

Expression sum(Expression left, Expression right) {
  if (left.is_true()) return right;
  return Expression::binary(Operation::Add, std::move(left), std::move(right));
}

// The value that an entry gets: where several are possible, 0.
Expression value_expression(const ScriptDomain& domain,
                            const ScriptOptions& options) {
  std::vector<ScriptGuard> guards;
  Expression value;  // of those that are possible, the sum
  Expression count;
  for (const auto& [each, where] : options) {
    guards.push_back(where);
    count = sum(std::move(count), where.expression());
    const std::size_t state = domain.index_of(each);
    if (state == 0) continue;
    Expression part =
        where.is_always()
            ? constant(state)
            : Expression::binary(Operation::Multiply, where.expression(),
                                 constant(state));
    value = sum(std::move(value), std::move(part));
  }
  if (value.is_true()) return constant(0);
  if (ScriptGuard::are_apart(guards)) return value;
  return Expression::binary(
      Operation::Multiply,
      Expression::binary(Operation::Equal, std::move(count), constant(1)),
      std::move(value));
}

bool reads(const StateAssignment& assignment, StateVariableId variable) {
  const auto terms = assignment.value.terms();
  return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
    return term.operation == Operation::Variable &&
           term.operand == static_cast<std::int32_t>(variable);
  });
}

// Adds assignments that all read the state before the first of them: an entry
// is assigned to after those that read it. What read each other in a circle
// become unknown.
void add_in_order(std::vector<StateAssignment> left,
                  std::vector<StateAssignment>& all) {
  while (!left.empty()) {
    const auto is_read = [&](const StateAssignment& one) {
      return std::any_of(left.begin(), left.end(), [&](const auto& other) {
        return other.variable != one.variable && reads(other, one.variable);
      });
    };
    const auto next = std::find_if_not(left.begin(), left.end(), is_read);
    if (next == left.end()) {
      for (StateAssignment& each : left) each.value = constant(0);
      continue;
    }
    all.push_back(std::move(*next));
    left.erase(next);
  }
}

void add_assignments(const ScriptWorld& world, const ScriptRun& run,
                     std::vector<StateAssignment>& all) {
  std::vector<StateAssignment> together;
  for (const auto& [variable, options] : run.entries()) {
    together.push_back(
        {variable,
         value_expression(world.domains[index(variable)], options),
         {}});
  }
  add_in_order(std::move(together), all);
}

// Of a script that is too deep: anything.
ScriptMeaning anything(const BtcppExpansion& expansion,
                       const ScriptWorld& world, std::uint32_t subtree,
                       const std::vector<ScriptName>& names) {
  const Expression maybe = constant(1);
  ScriptMeaning meaning{{}, maybe, maybe, maybe, maybe, maybe};
  for (const ScriptName& name : names) {
    if (name.use == ScriptUse::Read) continue;
    const auto found = world.of.find(entry_of(expansion, subtree, name.name));
    if (found == world.of.end()) continue;
    meaning.assignments.push_back({found->second, constant(0), {}});
  }
  return meaning;
}

bool is_too_deep(const ScriptTree& tree) {
  return std::any_of(tree.terms.begin(), tree.terms.end(),
                     [](const auto& t) { return t.depth > kMostScriptDepth; });
}

}  // namespace

ScriptMeaning compile_script(const BtcppExpansion& expansion,
                             const ScriptWorld& world, std::uint32_t subtree,
                             std::string_view script) {
  const ScriptSyntax syntax = parse_script(script);
  const ScriptTree& tree = syntax.tree;
  if (!syntax.flaw.empty() || is_too_deep(tree)) {
    return anything(expansion, world, subtree, syntax.names);
  }
  ScriptMeaning meaning;
  ScriptRun whole(expansion, world, subtree);
  for (const std::uint32_t statement : tree.statements) {
    ScriptRun alone(expansion, world, subtree);
    alone.execute(tree, statement);
    add_assignments(world, alone, meaning.assignments);
    whole.execute(tree, statement);
  }
  meaning.may_end = whole.completes().expression();
  meaning.may_throw = whole.throws().expression();
  const ScriptTruthGuards truth = whole.last_truth();
  meaning.may_hold = truth.hold.expression();
  meaning.may_fail = truth.fail.expression();
  meaning.may_be_no_truth = truth.no_truth.expression();
  return meaning;
}

ScriptMeaning compile_set_blackboard(const BtcppExpansion& expansion,
                                     const ScriptWorld& world,
                                     const BtcppInstance& node) {
  const auto setting = setting_of(expansion, node);
  // What it writes is not known, or it throws; and nothing is modelled then.
  if (!setting) {
    const Expression maybe = constant(1);
    return {{}, maybe, maybe, maybe, maybe, constant(0)};
  }
  ScriptMeaning meaning;
  ScriptGuard may_fail;
  ScriptGuard yields = ScriptGuard::always();
  ScriptRun run(expansion, world, node.subtree);
  if (setting->source) {
    ScriptRun reading(expansion, world, node.subtree);
    yields = {};
    const auto source = world.of.find(*setting->source);
    const bool may_be_empty = source != world.of.end() &&
                              world.domains[index(source->second)].may_be_empty;
    for (const auto& [value, where] : reading.read(*setting->source)) {
      yields = either(yields, where);
      const bool is_known = value.is_number() || value.kind == ScriptKind::Text;
      if (is_known && !(value.is_text() && may_be_empty)) continue;
      may_fail = either(may_fail, where);
    }
  }
  const auto entry = world.of.find(setting->entry);
  if (entry != world.of.end()) {
    run.set(entry->second, *setting);
    add_assignments(world, run, meaning.assignments);
  }
  meaning.may_hold = yields.expression();
  meaning.may_fail = may_fail.expression();
  meaning.may_end = either(yields, may_fail).expression();
  // A type that something else has given the entry may refuse the text.
  meaning.may_throw = constant(1);
  meaning.may_be_no_truth = constant(0);
  return meaning;
}

ScriptMeaning compile_unset_blackboard(const BtcppExpansion& expansion,
                                       const ScriptWorld& world,
                                       const BtcppInstance& node) {
  const Expression no = constant(0);
  ScriptMeaning meaning{{}, constant(1), no, constant(1), no, no};
  const auto entry = unset_by(expansion, node);
  if (!entry) return meaning;
  const auto found = world.of.find(*entry);
  if (found == world.of.end()) return meaning;
  const ScriptDomain& domain = world.domains[index(found->second)];
  meaning.assignments.push_back(
      {found->second, constant(domain.index_of(ScriptValue::unset())), {}});
  return meaning;
}

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// A script is run twice: as a whole, for the conditions, and statement by
// statement from any state, for the assignments. So only the assignments of one
// statement have to be put into an order, and most need none.
#include "model/btcpp/entries/meaning.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "model/btcpp/entries/regions.hpp"
#include "model/btcpp/entries/run.hpp"
#include "model/tree/reads.hpp"

namespace btcheck::btcpp {
namespace {

Expression constant(std::size_t value) {
  return Expression::constant(static_cast<std::int32_t>(value));
}

Expression sum(Expression left, Expression right) {
  if (left.is_true()) return right;
  return Expression::binary(Operation::Add, std::move(left), std::move(right));
}

Expression product(const ScriptGuard& where, Expression value) {
  if (where.is_always()) return value;
  return Expression::binary(Operation::Multiply, where.expression(),
                            std::move(value));
}

// A value that depends on one variable, the same or another: all states that
// are equally far from that variable's share one term, as in `x + 1`. Nothing
// where that is no shorter.
std::optional<Expression> shifted_value(const ScriptDomain& domain,
                                        const ScriptOptions& options) {
  std::optional<StateVariableId> variable;
  std::map<std::ptrdiff_t, ScriptGuard::Among> by_shift;
  for (const auto& [each, where] : options) {
    const auto values = where.of_one_variable();
    if (!values || (variable && *variable != values->variable)) {
      return std::nullopt;
    }
    variable = values->variable;
    const ScriptGuard::Among& among = *values->among;
    const auto state = static_cast<std::ptrdiff_t>(domain.index_of(each));
    for (std::size_t i = 0; i < among.size(); ++i) {
      if (!among[i]) continue;
      auto& same = by_shift[state - static_cast<std::ptrdiff_t>(i)];
      same.resize(among.size());
      same[i] = true;
    }
  }
  if (!variable || by_shift.size() * 2 > options.size()) return std::nullopt;
  Expression value;
  for (auto& [shift, among] : by_shift) {
    const Expression now =
        Expression::variable(static_cast<std::int32_t>(index(*variable)));
    Expression moved = Expression::binary(
        Operation::Add, now,
        Expression::constant(static_cast<std::int32_t>(shift)));
    value = sum(std::move(value),
                product(ScriptGuard::is_among(*variable, std::move(among)),
                        std::move(moved)));
  }
  return value;
}

// The value that an entry gets: where several are possible, Any.
Expression value_expression(const ScriptDomain& domain,
                            const ScriptOptions& options) {
  const bool is_sure = !is_ambiguous(options);
  if (is_sure) {
    if (auto shifted = shifted_value(domain, options)) return *shifted;
  }
  Expression value;  // of those that are possible, the sum
  Expression count;
  for (const auto& [each, where] : options) {
    if (!is_sure) count = sum(std::move(count), where.expression());
    const std::size_t state = domain.index_of(each);
    if (state == 0) continue;
    value = sum(std::move(value), product(where, constant(state)));
  }
  if (value.is_true()) value = constant(0);
  if (is_sure) return value;
  const Expression is_one =
      Expression::binary(Operation::Equal, std::move(count), constant(1));
  value = Expression::binary(Operation::Multiply, is_one, std::move(value));
  const std::size_t any = domain.index_of(merged(options));
  if (any == 0) return value;
  return sum(std::move(value),
             Expression::binary(Operation::Multiply,
                                Expression::unary(Operation::Not, is_one),
                                constant(any)));
}

// Adds assignments that all read the state before the first of them: an entry
// is assigned to after those that read it. Those that read each other in a
// circle give Any.
void add_in_order(const ScriptWorld& world, const ScriptRun& run,
                  std::vector<StateAssignment> left,
                  std::vector<StateAssignment>& all) {
  while (!left.empty()) {
    const auto is_read = [&](const StateAssignment& one) {
      return std::ranges::any_of(left, [&](const auto& other) {
        return other.variable != one.variable &&
               reads(other.value, one.variable);
      });
    };
    const auto next = std::ranges::find_if_not(left, is_read);
    if (next == left.end()) {
      for (StateAssignment& each : left) {
        const ScriptValue any = merged(run.entries().at(each.variable));
        each.value = constant(world.domain(each.variable).index_of(any));
      }
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
        {variable, value_expression(world.domain(variable), options), {}});
  }
  add_in_order(world, run, std::move(together), all);
}

// Where the last value may be true, and false, in any case of what is open.
// Known less well where that would take conditions that are too large.
ScriptTruthGuards truth_in_cases(const BtcppExpansion& expansion,
                                 const ScriptWorld& world,
                                 std::uint32_t subtree, const ScriptTree& tree,
                                 bool is_of_contract, const ScriptRun& whole) {
  const std::vector<ScriptCase> cases =
      cases_of(expansion, world, subtree, tree);
  ScriptTruthGuards all = whole.last_truth();
  if (cases.size() == 1) return all;
  const std::uint64_t given_up = ScriptGuard::given_up();
  ScriptTruthGuards closer = all;
  closer.hold = closer.fail = {};
  for (const ScriptCase& each : cases) {
    ScriptRun run(expansion, world, subtree, is_of_contract);
    run.take_for_open(each);
    for (const std::uint32_t statement : tree.statements) {
      run.execute(tree, statement);
    }
    const ScriptTruthGuards truth = run.last_truth();
    closer.hold = either(closer.hold, truth.hold);
    closer.fail = either(closer.fail, truth.fail);
  }
  return ScriptGuard::given_up() == given_up ? closer : all;
}

// Of a script that is too deep: anything.
ScriptMeaning anything(const BtcppExpansion& expansion,
                       const ScriptWorld& world, std::uint32_t subtree,
                       const std::vector<ScriptName>& names) {
  const Expression maybe = constant(1);
  ScriptMeaning meaning{{},    maybe,       maybe,       maybe, maybe,
                        maybe, constant(0), constant(0), true};
  for (const ScriptName& name : names) {
    if (name.use == ScriptUse::Read) continue;
    const auto found =
        world.variable_of(entry_of(expansion, subtree, name.name));
    if (!found) continue;
    const std::size_t any =
        world.domain(*found).index_of(ScriptValue::lost().as(EntryType::Other));
    meaning.assignments.push_back({*found, constant(any), {}});
  }
  return meaning;
}

}  // namespace

ScriptMeaning compile_script(const BtcppExpansion& expansion,
                             const ScriptWorld& world, std::uint32_t subtree,
                             const ScriptSyntax& syntax, bool is_of_contract) {
  const ScriptTree& tree = syntax.tree;
  if (!syntax.flaw.empty() || is_too_deep(tree)) {
    return anything(expansion, world, subtree, syntax.names);
  }
  ScriptMeaning meaning;
  const std::uint64_t given_up = ScriptGuard::given_up();
  ScriptRun whole(expansion, world, subtree, is_of_contract);
  for (const std::uint32_t statement : tree.statements) {
    ScriptRun alone(expansion, world, subtree, is_of_contract);
    alone.execute(tree, statement);
    add_assignments(world, alone, meaning.assignments);
    whole.execute(tree, statement);
  }
  meaning.may_end = whole.completes().expression();
  meaning.may_throw = whole.throws().expression();
  meaning.may_lack = whole.lacks().expression();
  meaning.may_leave = whole.leaves().expression();
  meaning.is_simplified = ScriptGuard::given_up() != given_up;
  meaning.is_rough = whole.is_rough() || meaning.is_simplified;
  const ScriptTruthGuards truth =
      truth_in_cases(expansion, world, subtree, tree, is_of_contract, whole);
  meaning.may_hold = truth.hold.expression();
  meaning.may_fail = truth.fail.expression();
  meaning.may_be_no_truth = truth.no_truth.expression();
  return meaning;
}

std::vector<StateAssignment> compile_port_writes(
    const ScriptWorld& world, const std::vector<PortWrite>& writes,
    bool is_sure) {
  std::vector<StateAssignment> all;
  for (const PortWrite& write : writes) {
    const auto variable = world.variable_of(write.entry);
    if (!variable) continue;
    const ScriptDomain& domain = world.domain(*variable);
    if (domain.limits) continue;
    ScriptGuard::Among known(domain.values.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
      known[i] = is_sure || domain.values[i].is_something();
    }
    all.push_back({*variable,
                   product(ScriptGuard::is_among(*variable, std::move(known)),
                           constant(domain.index_of(write.value))),
                   {}});
  }
  return all;
}

ScriptMeaning compile_set_blackboard(const BtcppExpansion& expansion,
                                     const ScriptWorld& world,
                                     const BtcppInstance& node) {
  const auto setting = setting_of(expansion, node);
  const Expression no = constant(0);
  // What it writes is not known, or it throws; and nothing is modelled then.
  if (!setting) {
    const Expression maybe = constant(1);
    return {{}, maybe, maybe, maybe, maybe, no, no, no};
  }
  ScriptMeaning meaning;
  ScriptRun run(expansion, world, node.subtree);
  const auto guards = run.set(world.variable_of(setting->entry), *setting);
  add_assignments(world, run, meaning.assignments);
  meaning.may_hold = guards.succeeds.expression();
  meaning.may_fail = guards.fails.expression();
  meaning.may_end = either(guards.succeeds, guards.fails).expression();
  meaning.may_throw = run.throws().expression();
  meaning.may_be_no_truth = no;
  meaning.may_lack = run.lacks().expression();
  meaning.may_leave = run.leaves().expression();
  meaning.is_rough = run.is_rough();
  return meaning;
}

ScriptMeaning compile_unset_blackboard(const BtcppExpansion& expansion,
                                       const ScriptWorld& world,
                                       const BtcppInstance& node) {
  const Expression no = constant(0);
  ScriptMeaning meaning{{}, constant(1), no, constant(1), no, no, no, no};
  const auto entry = unset_by(expansion, node);
  if (!entry) return meaning;
  const auto found = world.variable_of(*entry);
  if (!found) return meaning;
  const std::size_t unset = world.domain(*found).index_of(ScriptValue::unset());
  meaning.assignments.push_back({*found, constant(unset), {}});
  return meaning;
}

}  // namespace btcheck::btcpp

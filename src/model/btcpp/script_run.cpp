// SPDX-License-Identifier: MIT
//
// A value is a list of what it may be, each with the states where it may be
// that. An operator goes over all combinations; `&&`, `||` and comparisons in
// a chain work on the guards, so that long conditions stay small.
#include "model/btcpp/script_run.hpp"

#include <cmath>
#include <utility>

namespace btcheck::btcpp {
namespace {

using Operation = ScriptOperation;

void add(ScriptOptions& options, const ScriptValue& value,
         const ScriptGuard& where) {
  if (where.is_never()) return;
  ScriptGuard& guard = options[value];
  guard = either(guard, where);
}

ScriptOptions under(const ScriptGuard& where, const ScriptOptions& options) {
  ScriptOptions all;
  for (const auto& [value, guard] : options) {
    add(all, value, both(where, guard));
  }
  return all;
}

// Where one of the values is possible that are asked for.
template <class Wanted>
ScriptGuard anywhere(const ScriptOptions& options, Wanted wanted) {
  ScriptGuard all;
  for (const auto& [value, guard] : options) {
    if (wanted(value)) all = either(all, guard);
  }
  return all;
}

// Whether an entry of one value may refuse another. What the program around
// the tree put there is taken to fit.
bool may_refuse(const ScriptValue& held, const ScriptValue& value) {
  if (value.kind == ScriptKind::Unknown) return true;
  if (held.kind == ScriptKind::Text) return value.kind != ScriptKind::Text;
  if (!held.is_number()) return false;
  if (value.kind != ScriptKind::Number) return !value.is_number();
  return value.number != std::nearbyint(value.number);
}

}  // namespace

// The outcomes of an operator for all combinations of its operands.
struct ScriptRun::Collected {
  Result result;
  ScriptGuard throws;

  void add(const ScriptOutcome& outcome, const ScriptGuard& where) {
    for (const ScriptValue& each : outcome.values) {
      btcpp::add(result.options, each, where);
    }
    if (!outcome.values.empty()) result.yields = either(result.yields, where);
    if (outcome.may_throw) throws = either(throws, where);
  }

  template <class Apply>
  void add_pairs(const ScriptOptions& left, const ScriptOptions& right,
                 Apply apply) {
    for (const auto& [one, where] : left) {
      for (const auto& [other, elsewhere] : right) {
        const ScriptGuard guard = both(where, elsewhere);
        if (!guard.is_never()) add(apply(one, other), guard);
      }
    }
  }
};

void ScriptRun::execute(const ScriptTree& tree, std::uint32_t statement) {
  last_ = evaluate(tree, statement);
  completes_ = both(completes_, last_.yields);
  path_ = completes_;
}

ScriptRun::Result ScriptRun::evaluate(const ScriptTree& tree,
                                      std::uint32_t index) {
  const ScriptTerm& term = tree.terms[index];
  const auto constant = [](ScriptValue value) {
    return Result{{{std::move(value), ScriptGuard::always()}},
                  ScriptGuard::always()};
  };
  switch (term.operation) {
    case Operation::Number:
      return constant(term.number ? ScriptValue::of(*term.number)
                                  : ScriptValue{});
    case Operation::Text:
      return constant(ScriptValue::of(term.text));
    case Operation::Name:
      return reading(entry_of(expansion_, subtree_, term.text));
    case Operation::Negate:
    case Operation::Complement:
    case Operation::Not:
      return prefix(tree, term);
    case Operation::And:
    case Operation::Or:
      return logic(tree, term);
    case Operation::Compare:
      return comparison(tree, term);
    case Operation::Choose:
      return choice(tree, term);
    default:
      return is_assignment(term.operation) ? assignment(tree, term)
                                           : binary(tree, term);
  }
}

ScriptRun::Result ScriptRun::prefix(const ScriptTree& tree,
                                    const ScriptTerm& term) {
  const Result of = evaluate(tree, term.operands[0]);
  Collected all;
  for (const auto& [value, where] : of.options) {
    all.add(apply_prefix(term.operation, value), where);
  }
  may_throw(all.throws);
  return std::move(all.result);
}

ScriptRun::Result ScriptRun::binary(const ScriptTree& tree,
                                    const ScriptTerm& term) {
  const Result left = evaluate(tree, term.operands[0]);
  const Result right = evaluate(tree, term.operands[1]);
  Collected all;
  all.add_pairs(left.options, right.options,
                [&](const ScriptValue& one, const ScriptValue& other) {
                  return apply_binary(term.operation, one, other);
                });
  may_throw(all.throws);
  return std::move(all.result);
}

ScriptRun::Result ScriptRun::logic(const ScriptTree& tree,
                                   const ScriptTerm& term) {
  const Result left = evaluate(tree, term.operands[0]);
  const Result right = evaluate(tree, term.operands[1]);
  const ScriptTruthGuards one = truth(left, truth_of);
  const ScriptTruthGuards other = truth(right, truth_of);
  may_throw(either(one.no_truth, other.no_truth));
  const ScriptGuard yields = both(one.yields, other.yields);
  if (term.operation == Operation::And) {
    return from_truth(
        both(one.hold, other.hold),
        either(both(one.fail, other.yields), both(one.yields, other.fail)),
        yields);
  }
  return from_truth(
      either(both(one.hold, other.yields), both(one.yields, other.hold)),
      both(one.fail, other.fail), yields);
}

ScriptRun::Result ScriptRun::compare(ScriptComparison by, const Result& left,
                                     const Result& right) {
  Collected all;
  all.add_pairs(left.options, right.options,
                [&](const ScriptValue& one, const ScriptValue& other) {
                  return apply_comparison(by, one, other);
                });
  may_throw(all.throws);
  return std::move(all.result);
}

// The chain ends at the first comparison that fails, and what stands behind is
// not evaluated.
ScriptRun::Result ScriptRun::comparison(const ScriptTree& tree,
                                        const ScriptTerm& term) {
  Result left = evaluate(tree, term.operands[0]);
  ScriptGuard goes_on = ScriptGuard::always();
  ScriptGuard fails;
  bool always_yields = true;
  const ScriptGuard path = path_;
  for (std::size_t i = 0; i < term.comparisons.size(); ++i) {
    const Entries before = entries_;
    const int kept = kept_;
    path_ = both(path, goes_on);
    Result right = evaluate(tree, term.operands[i + 1]);
    if (i > 0 && kept != kept_) join(goes_on, Entries(entries_), fails, before);
    Result step = compare(term.comparisons[i], left, right);
    fails = either(fails, both(goes_on, step.options[ScriptValue::of(false)]));
    goes_on = both(goes_on, step.options[ScriptValue::of(true)]);
    always_yields = always_yields && step.yields.is_always();
    left = std::move(right);
  }
  path_ = path;
  return from_truth(
      goes_on, fails,
      always_yields ? ScriptGuard::always() : either(goes_on, fails));
}

ScriptRun::Result ScriptRun::choice(const ScriptTree& tree,
                                    const ScriptTerm& term) {
  const Result condition = evaluate(tree, term.operands[0]);
  const ScriptTruthGuards when = truth(condition, choice_of);
  may_throw(when.no_truth);
  const ScriptGuard path = path_;
  const Entries before = entries_;
  const int kept = kept_;
  path_ = both(path, when.hold);
  const Result one = evaluate(tree, term.operands[1]);
  const Entries after_one = std::exchange(entries_, before);
  path_ = both(path, when.fail);
  const Result other = evaluate(tree, term.operands[2]);
  if (kept != kept_) {
    join(when.hold, after_one, when.fail, Entries(entries_));
  }
  path_ = path;
  Result result{under(when.hold, one.options), {}};
  for (const auto& [value, where] : under(when.fail, other.options)) {
    add(result.options, value, where);
  }
  const bool always_yields = one.yields.is_always() && other.yields.is_always();
  result.yields = always_yields ? when.yields
                                : either(both(when.hold, one.yields),
                                         both(when.fail, other.yields));
  return result;
}

ScriptRun::Result ScriptRun::assignment(const ScriptTree& tree,
                                        const ScriptTerm& term) {
  const Result value = evaluate(tree, term.operands[1]);
  const EntryName entry =
      entry_of(expansion_, subtree_, tree.terms[term.operands[0]].text);
  const auto found = world_.of.find(entry);
  if (found == world_.of.end()) return foreign_assignment(term, value);
  Result kept = term.operation > Operation::Set
                    ? changed(found->second, term.operation, value)
                    : replaced(found->second, term.operation, value);
  keep(found->second, kept);
  return kept;
}

ScriptRun::Result ScriptRun::replaced(StateVariableId entry,
                                      ScriptOperation operation,
                                      const Result& value) {
  const ScriptDomain& domain = world_.domains[index(entry)];
  const ScriptOptions held = values_of(entry);
  ScriptGuard present = ScriptGuard::always();
  if (operation == Operation::Set) {
    present = anywhere(held, [](const ScriptValue& each) {
      return each.kind != ScriptKind::Unset;
    });
    may_throw(anywhere(held, [](const ScriptValue& each) {
      return each.kind <= ScriptKind::Unset;  // or Unknown
    }));
  }
  Result result{{}, both(present, value.yields)};
  for (const auto& [each, where] : value.options) {
    const bool is_text = each.kind == ScriptKind::Text;
    const bool is_lost = is_text && !domain.is_text;
    if (is_lost || (is_text && domain.may_be_empty)) may_throw(where);
    may_throw(both(where, anywhere(held, [&, &by = each](const auto& now) {
                     return may_refuse(now, by);
                   })));
    add(result.options, is_lost ? ScriptValue{} : each, both(present, where));
  }
  return result;
}

ScriptRun::Result ScriptRun::changed(StateVariableId entry,
                                     ScriptOperation operation,
                                     const Result& by) {
  const bool keeps_text = world_.domains[index(entry)].is_text;
  Collected all;
  all.add_pairs(values_of(entry), by.options,
                [&](const ScriptValue& held, const ScriptValue& value) {
                  auto outcome = apply_change(operation, held, value);
                  for (ScriptValue& each : outcome.values) {
                    const bool is_text = each.kind == ScriptKind::Text;
                    if (is_text && !keeps_text) each = {};
                  }
                  return outcome;
                });
  may_throw(all.throws);
  return std::move(all.result);
}

// To an entry that is not modelled: a number stays one, or is refused.
ScriptRun::Result ScriptRun::foreign_assignment(const ScriptTerm& term,
                                                const Result& value) {
  may_throw(value.yields);
  Result result{{}, value.yields};
  for (const auto& [each, where] : value.options) {
    const bool is_kept =
        each.is_number() && term.operation <= ScriptOperation::Set;
    add(result.options, is_kept ? each : ScriptValue{}, where);
  }
  return result;
}

ScriptRun::Result ScriptRun::reading(const EntryName& entry) {
  Result result{read(entry), {}};
  result.yields =
      anywhere(result.options, [](const ScriptValue&) { return true; });
  return result;
}

ScriptOptions ScriptRun::read(const EntryName& entry) {
  const auto found = world_.of.find(entry);
  if (found == world_.of.end()) {
    may_throw(ScriptGuard::always());
    return {{ScriptValue{}, ScriptGuard::always()}};
  }
  ScriptOptions options = values_of(found->second);
  const bool may_be_empty = world_.domains[index(found->second)].may_be_empty;
  for (const auto& [value, where] : options) {
    const bool is_text = value.kind == ScriptKind::Text;
    if (value.kind == ScriptKind::Unset || (is_text && may_be_empty)) {
      may_throw(where);
    }
  }
  options.erase(ScriptValue::unset());
  return options;
}

// What the entry holds now; before it is assigned to, each value where the
// variable has it.
ScriptOptions ScriptRun::values_of(StateVariableId entry) const {
  const auto assigned = entries_.find(entry);
  return assigned != entries_.end() ? assigned->second : at_first(entry);
}

ScriptOptions ScriptRun::at_first(StateVariableId entry) const {
  const auto& values = world_.domains[index(entry)].values;
  ScriptOptions options;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<bool> only(values.size());
    only[i] = true;
    add(options, values[i], ScriptGuard::is_among(entry, std::move(only)));
  }
  return options;
}

void ScriptRun::keep(StateVariableId entry, const Result& values) {
  const ScriptDomain& domain = world_.domains[index(entry)];
  ++kept_;
  ScriptOptions kept;
  for (const auto& [value, where] : values.options) {
    const ScriptValue each = domain.kept(value);
    if (on_keep_) on_keep_(entry, each);
    const bool is_known = domain.index_of(each) != 0;
    add(kept, is_known ? each : ScriptValue{}, where);
  }
  entries_[entry] = std::move(kept);
}

void ScriptRun::set(StateVariableId entry, const Setting& setting) {
  const Result value =
      setting.source
          ? reading(*setting.source)
          : Result{{{ScriptValue::of(setting.text), ScriptGuard::always()}},
                   ScriptGuard::always()};
  keep(entry, replaced(entry, Operation::Create, value));
}

void ScriptRun::join(const ScriptGuard& where, const Entries& one,
                     const ScriptGuard& elsewhere, const Entries& other) {
  const auto values_in = [&](const Entries& entries, StateVariableId id) {
    const auto found = entries.find(id);
    return found != entries.end() ? found->second : at_first(id);
  };
  Entries joined = one;
  joined.insert(other.begin(), other.end());
  for (auto& [entry, options] : joined) {
    options = under(where, values_in(one, entry));
    for (const auto& [value, guard] :
         under(elsewhere, values_in(other, entry))) {
      add(options, value, guard);
    }
  }
  entries_ = std::move(joined);
}

void ScriptRun::may_throw(const ScriptGuard& where) {
  throws_ = either(throws_, both(path_, where));
}

ScriptTruthGuards ScriptRun::truth(
    const Result& of, ScriptTruth (*judge)(const ScriptValue&)) const {
  ScriptTruthGuards guards;
  bool always_yields = true;
  for (const auto& [value, where] : of.options) {
    const ScriptTruth truth = judge(value);
    if (truth.may_hold) guards.hold = either(guards.hold, where);
    if (truth.may_fail) guards.fail = either(guards.fail, where);
    if (truth.may_throw) guards.no_truth = either(guards.no_truth, where);
    always_yields = always_yields && (truth.may_hold || truth.may_fail);
  }
  guards.yields = always_yields ? of.yields : either(guards.hold, guards.fail);
  return guards;
}

ScriptRun::Result ScriptRun::from_truth(const ScriptGuard& hold,
                                        const ScriptGuard& fail,
                                        const ScriptGuard& yields) {
  Result result{{}, yields};
  add(result.options, ScriptValue::of(true), hold);
  add(result.options, ScriptValue::of(false), fail);
  return result;
}

ScriptTruthGuards ScriptRun::last_truth() const {
  ScriptTruthGuards guards = truth(last_, truth_of);
  guards.hold = both(completes_, guards.hold);
  guards.fail = both(completes_, guards.fail);
  guards.no_truth = both(completes_, guards.no_truth);
  return guards;
}

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// A value is a list of options. An operator is applied to all pairs of them;
// `&&`, `||` and chains of comparisons work on the guards alone, so that long
// conditions stay small.
#include "model/btcpp/entries/run.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "model/tree/releases.hpp"
#include "text/budget.hpp"

namespace btcheck::btcpp {
namespace {

// Where there are very many pairs, the result is left unknown.
bool are_too_many(const ScriptOptions& left, const ScriptOptions& right) {
  constexpr std::size_t kMostPairs = 2048;
  constexpr std::size_t kFew = 8;
  return left.size() * right.size() > kMostPairs &&
         std::min(left.size(), right.size()) > kFew;
}

ScriptResult surely(const ScriptValue& value) {
  return {{{value, ScriptGuard::always()}}, ScriptGuard::always()};
}

// Whether an operator is certain to throw, or to give one value that is not
// vague.
bool is_plain(const ScriptOutcome& outcome) {
  if (outcome.values.empty()) return outcome.may_throw;
  const ScriptValue& first = outcome.values[0];
  return outcome.values.size() == 1 && !outcome.may_throw && !is_open(first) &&
         !first.is_any_number();
}

// All values that an entry treats alike when it is assigned to.
ScriptValue likeness(const ScriptValue& value) {
  if (value.is_text()) return ScriptValue::any_text().as(value.noted);
  if (!value.is_number()) return value;
  ScriptValue zero = ScriptValue::integer(0).as(value.noted);
  zero.type = value.type == NumberType::Whole ? NumberType::Real : value.type;
  return zero;
}

// What a leaf has written is taken to be what an operator needs, if anything
// is.
bool throws_of_itself(const ScriptOutcome& outcome, const ScriptValue& one,
                      const ScriptValue& other) {
  const bool is_taken =
      !outcome.values.empty() && (one.is_outside() || other.is_outside());
  return outcome.may_throw && !is_taken;
}

// And when SetBlackboard writes it.
ScriptValue type_alone(const ScriptValue& value) {
  const bool may_be_none =
      value.kind == ScriptKind::Unset || value.kind == ScriptKind::Unknown;
  return may_be_none ? value : ScriptValue::any().as(value.noted);
}

template <class Judge>
ScriptTruthGuards truth(const ScriptResult& of, Judge judge) {
  ScriptTruthGuards guards;
  bool always_yields = true;
  for (const auto& [value, where] : of.options) {
    const ScriptTruth truth = judge(value);
    if (truth.may_hold) guards.hold = either(guards.hold, where);
    if (truth.may_fail) guards.fail = either(guards.fail, where);
    if (truth.may_throw && !value.is_outside()) {
      guards.no_truth = either(guards.no_truth, where);
    }
    always_yields = always_yields && (truth.may_hold || truth.may_fail);
  }
  guards.yields = always_yields ? of.yields : either(guards.hold, guards.fail);
  return guards;
}

ScriptResult from_truth(const ScriptGuard& hold, const ScriptGuard& fail,
                        const ScriptGuard& yields) {
  ScriptResult result{{}, yields};
  add_option(result.options, ScriptValue::of(true), hold);
  add_option(result.options, ScriptValue::of(false), fail);
  return result;
}

}  // namespace

bool is_too_deep(const ScriptTree& tree) {
  return std::ranges::any_of(tree.terms, [](const ScriptTerm& term) {
    return term.depth > kMostScriptDepth;
  });
}

template <class Apply>
ScriptResult ScriptRun::paired(const ScriptOptions& left,
                               const ScriptOptions& right, Apply apply) {
  ScriptResult result;
  ScriptGuard throws;
  const auto add = [&](const ScriptOutcome& outcome, const ScriptGuard& where) {
    for (const ScriptValue& each : outcome.values) {
      add_option(result.options, each, where);
    }
    if (!outcome.values.empty()) result.yields = either(result.yields, where);
  };
  if (are_too_many(left, right)) {
    is_rough_ = true;
    add({{ScriptValue::lost()}, true}, ScriptGuard::always());
    throws = ScriptGuard::always();
  } else {
    for (const auto& [one, where] : left) {
      for (const auto& [other, elsewhere] : right) {
        const ScriptGuard guard = both(where, elsewhere);
        if (guard.is_never()) continue;
        const ScriptOutcome outcome = apply(one, other);
        is_rough_ |= !is_plain(outcome) && !is_open(one) && !is_open(other);
        add(outcome, guard);
        if (throws_of_itself(outcome, one, other)) {
          throws = either(throws, guard);
        }
      }
    }
  }
  may_throw(throws);
  return result;
}

void ScriptRun::execute(const ScriptTree& tree, std::uint32_t statement) {
  last_ = evaluate(tree, statement);
  completes_ = both(completes_, last_.yields);
  path_ = completes_;
}

ScriptResult ScriptRun::evaluate(const ScriptTree& tree, std::uint32_t index) {
  ask_budget();
  const ScriptTerm& term = tree.terms[index];
  switch (term.operation) {
    case ScriptOperation::Number:
      if (!term.number) return surely(ScriptValue::any());
      return surely(term.is_integer
                        ? read_in(tree, ScriptValue::integer(*term.number))
                        : ScriptValue::real(*term.number));
    case ScriptOperation::Text:
      return surely(ScriptValue::of(term.text));
    case ScriptOperation::Name:
      return reading(tree, entry_of(expansion_, subtree_, term.text));
    case ScriptOperation::Negate:
    case ScriptOperation::Complement:
    case ScriptOperation::Not:
      return prefix(tree, term);
    case ScriptOperation::And:
    case ScriptOperation::Or:
      return logic(tree, term);
    case ScriptOperation::Compare:
      return comparison(tree, term);
    case ScriptOperation::Choose:
      return choice(tree, term);
    default:
      return is_assignment(term.operation) ? assignment(tree, term)
                                           : binary(tree, term);
  }
}

ScriptResult ScriptRun::prefix(const ScriptTree& tree, const ScriptTerm& term) {
  const ScriptOptions nothing = {{ScriptValue::unset(), ScriptGuard::always()}};
  return paired(evaluate(tree, term.operands[0]).options, nothing,
                [&](const ScriptValue& of, const ScriptValue&) {
                  return prefix_in(tree, term.operation, of);
                });
}

ScriptResult ScriptRun::binary(const ScriptTree& tree, const ScriptTerm& term) {
  const ScriptResult left = evaluate(tree, term.operands[0]);
  const ScriptResult right = evaluate(tree, term.operands[1]);
  return paired(left.options, right.options,
                [&](const ScriptValue& one, const ScriptValue& other) {
                  return apply_binary(term.operation, one, other);
                });
}

ScriptResult ScriptRun::logic(const ScriptTree& tree, const ScriptTerm& term) {
  const ScriptResult left = evaluate(tree, term.operands[0]);
  const ScriptResult right = evaluate(tree, term.operands[1]);
  const ScriptTruthGuards one = truth(left, truth_of);
  const ScriptTruthGuards other = truth(right, truth_of);
  may_throw(either(one.no_truth, other.no_truth));
  const ScriptGuard yields = both(one.yields, other.yields);
  if (term.operation == ScriptOperation::And) {
    return from_truth(
        both(one.hold, other.hold),
        either(both(one.fail, other.yields), both(one.yields, other.fail)),
        yields);
  }
  return from_truth(
      either(both(one.hold, other.yields), both(one.yields, other.hold)),
      both(one.fail, other.fail), yields);
}

ScriptResult ScriptRun::compare(const ScriptTree& tree, ScriptComparison by,
                                const ScriptResult& left,
                                const ScriptResult& right) {
  ScriptResult result =
      paired(left.options, right.options,
             [&](const ScriptValue& one, const ScriptValue& other) {
               return compare_in(tree, by, one, other);
             });
  auto unknown = result.options.extract(ScriptValue::lost());
  if (!unknown.empty()) {
    add_option(result.options, ScriptValue::of(false), unknown.mapped());
    add_option(result.options, ScriptValue::of(true), unknown.mapped());
  }
  return result;
}

// The chain ends at the first comparison that fails, and what stands behind is
// not evaluated.
ScriptResult ScriptRun::comparison(const ScriptTree& tree,
                                   const ScriptTerm& term) {
  ScriptResult left = evaluate(tree, term.operands[0]);
  ScriptGuard goes_on = ScriptGuard::always();
  ScriptGuard fails;
  bool always_yields = true;
  const ScriptGuard path = path_;
  for (std::size_t i = 0; i < term.comparisons.size(); ++i) {
    const Entries before = entries_;
    const int kept = kept_;
    path_ = both(path, goes_on);
    ScriptResult right = evaluate(tree, term.operands[i + 1]);
    if (i > 0 && kept != kept_) join(goes_on, Entries(entries_), fails, before);
    ScriptResult step = compare(tree, term.comparisons[i], left, right);
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

ScriptResult ScriptRun::choice(const ScriptTree& tree, const ScriptTerm& term) {
  const ScriptResult condition = evaluate(tree, term.operands[0]);
  const ScriptTruthGuards when =
      truth(condition,
            [&](const ScriptValue& value) { return choice_in(tree, value); });
  may_throw(when.no_truth);
  const ScriptGuard path = path_;
  const Entries before = entries_;
  const int kept = kept_;
  path_ = both(path, when.hold);
  const ScriptResult one = evaluate(tree, term.operands[1]);
  const Entries after_one = std::exchange(entries_, before);
  path_ = both(path, when.fail);
  const ScriptResult other = evaluate(tree, term.operands[2]);
  if (kept != kept_) {
    join(when.hold, after_one, when.fail, Entries(entries_));
  }
  path_ = path;
  ScriptResult result{under(when.hold, one.options), {}};
  for (const auto& [value, where] : under(when.fail, other.options)) {
    add_option(result.options, value, where);
  }
  const bool always_yields = one.yields.is_always() && other.yields.is_always();
  result.yields = always_yields ? when.yields
                                : either(both(when.hold, one.yields),
                                         both(when.fail, other.yields));
  return result;
}

void ScriptRun::may_throw(const ScriptGuard& where) {
  throws_ = either(throws_, both(path_, where));
}

void ScriptRun::may_lack(const ScriptGuard& where) {
  lacks_ = either(lacks_, both(path_, where));
}

ScriptTruthGuards ScriptRun::last_truth() const {
  ScriptTruthGuards guards = truth(last_, truth_of);
  guards.hold = both(completes_, guards.hold);
  guards.fail = both(completes_, guards.fail);
  guards.no_truth = both(completes_, guards.no_truth);
  return guards;
}

ScriptResult ScriptRun::assignment(const ScriptTree& tree,
                                   const ScriptTerm& term) {
  const std::string& name = tree.terms[term.operands[0]].text;
  const EntryName entry = entry_of(expansion_, subtree_, name);
  const auto variable = world_.variable_of(entry);
  // That the entry exists is asked before the value is computed.
  ScriptGuard present = ScriptGuard::always();
  if (variable && term.operation != ScriptOperation::Create &&
      !is_of_contract_) {
    present = presence(*variable, term.operation);
  }
  const ScriptResult value = evaluate(tree, term.operands[1]);
  if (!variable) return foreign_assignment(term, value);
  ScriptResult kept = value;
  if (term.operation > ScriptOperation::Set) {
    kept = paired(held(*variable), value.options,
                  [&](const ScriptValue& now, const ScriptValue& by) {
                    return apply_change(term.operation, now, by);
                  });
  } else if (!is_of_contract_) {
    kept = paired(grouped(held(*variable), likeness), value.options,
                  [&](const ScriptValue& now, const ScriptValue& by) {
                    return assign_in(tree, now, by);
                  });
  } else {
    kept = written(*variable, is_own_name(entry, subtree_, name), value);
  }
  if (!present.is_always()) {
    kept = {under(present, kept.options), both(present, kept.yields)};
  }
  kept = within(*variable, std::move(kept));
  keep(*variable, kept);
  return kept;
}

// By a leaf. What it cannot write ends the run, as what is not declared does.
ScriptResult ScriptRun::written(StateVariableId entry, bool is_own,
                                const ScriptResult& value) {
  const ScriptDomain& domain = world_.domain(entry);
  ScriptResult kept;
  ScriptGuard refused;
  for (const auto& [now, where] : grouped(held(entry), likeness)) {
    const bool exists = now.kind == ScriptKind::Unknown
                            ? domain.exists
                            : now.kind != ScriptKind::Unset;
    for (const auto& [by, elsewhere] : value.options) {
      const ScriptGuard guard = both(where, elsewhere);
      if (guard.is_never()) continue;
      // Of any other its type does not matter.
      const bool is_typed = domain.is_typed_by_leaves || has_type(now);
      const ScriptOutcome outcome =
          is_typed ? written_by_leaf(now, {exists, is_own}, by)
                   : ScriptOutcome{{by}, false};
      is_rough_ |= outcome.may_throw && !outcome.values.empty();
      for (const ScriptValue& each : outcome.values) {
        add_option(kept.options, each, guard);
      }
      if (outcome.may_throw) refused = either(refused, guard);
    }
  }
  leaves_ = either(leaves_, both(path_, refused));
  kept.yields = refused.is_never() ? value.yields
                                   : both(value.yields, anywhere(kept.options));
  return kept;
}

ScriptResult ScriptRun::within(StateVariableId entry, ScriptResult values) {
  const auto& limits = world_.domain(entry).limits;
  if (!limits) return values;
  ScriptResult inside;
  ScriptGuard outside;
  for (const auto& [value, where] : values.options) {
    const auto held = limits->held(value);
    if (held) add_option(inside.options, *held, where);
    const bool may_leave = DeclaredDomain::may_leave(value);
    is_rough_ |= may_leave;
    if (!held || may_leave) outside = either(outside, where);
  }
  leaves_ = either(leaves_, both(path_, outside));
  inside.yields = outside.is_never()
                      ? values.yields
                      : both(values.yields, anywhere(inside.options));
  return inside;
}

ScriptGuard ScriptRun::presence(StateVariableId entry,
                                ScriptOperation operation) {
  const ScriptOptions now = held(entry);
  const auto is_absent = [](const ScriptValue& each) {
    return each.kind == ScriptKind::Unset;
  };
  may_throw(anywhere(now, is_absent));
  const bool needs_value = operation > ScriptOperation::Set;
  if (needs_value || !world_.domain(entry).exists) {
    may_lack(anywhere(now, [](const ScriptValue& each) {
      return each.kind == ScriptKind::Unknown;
    }));
  }
  return anywhere(now,
                  [&](const ScriptValue& each) { return !is_absent(each); });
}

// What the entry holds now, with the type that it has before the tree has
// written it.
ScriptOptions ScriptRun::held(StateVariableId entry) const {
  ScriptOptions options = values_of(entry, entries_);
  auto unknown = options.extract(ScriptValue{});
  if (!unknown.empty()) {
    const EntryType type = world_.domain(entry).declared;
    add_option(options, ScriptValue{}.as(type), unknown.mapped());
  }
  return options;
}

// To an entry that is not modelled: a number stays one, or is refused.
ScriptResult ScriptRun::foreign_assignment(const ScriptTerm& term,
                                           const ScriptResult& value) {
  may_throw(value.yields);
  ScriptResult result{{}, value.yields};
  for (const auto& [each, where] : value.options) {
    const bool is_kept =
        each.is_number() && term.operation <= ScriptOperation::Set;
    add_option(result.options, is_kept ? each : ScriptValue::any(), where);
  }
  return result;
}

// What can be read: a read of an entry that is not there throws.
ScriptResult ScriptRun::reading(const ScriptTree& tree,
                                const EntryName& entry) {
  ScriptResult result;
  const auto variable = world_.variable_of(entry);
  if (!variable) {
    may_throw(ScriptGuard::always());
    return surely(open_value(entry, ScriptValue::any()));
  }
  for (const auto& [value, where] : values_of(*variable, entries_)) {
    if (value.kind == ScriptKind::Unset) {
      may_throw(where);
    } else if (value.kind == ScriptKind::Unknown) {
      may_lack(where);
      add_option(result.options, open_value(entry, ScriptValue::any()), where);
    } else {
      const ScriptValue read = read_in(tree, value.as(EntryType::Free));
      add_option(result.options,
                 value.is_of_any_kind() ? open_value(entry, read) : read,
                 where);
    }
  }
  result.yields = anywhere(result.options);
  return result;
}

ScriptValue ScriptRun::open_value(const EntryName& entry,
                                  ScriptValue value) const {
  if (taken_ == nullptr) return value;
  const auto found = taken_->find(entry);
  return found == taken_->end() ? value : found->second;
}

// What the entry holds among these; before it is assigned to, each value where
// the variable has it.
ScriptOptions ScriptRun::values_of(StateVariableId entry,
                                   const Entries& among) const {
  const auto assigned = among.find(entry);
  if (assigned != among.end()) return assigned->second;
  const auto& values = world_.domain(entry).values;
  ScriptOptions options;
  const std::size_t first = entry == restricted_ ? first_value_ : 0;
  for (std::size_t i = first; i < values.size(); ++i) {
    add_option(options, values[i], ScriptGuard::is(entry, i, values.size()));
  }
  return options;
}

void ScriptRun::keep(StateVariableId entry, const ScriptResult& values) {
  const ScriptDomain& domain = world_.domain(entry);
  ++kept_;
  ScriptOptions kept;
  for (const auto& [value, where] : values.options) {
    const ScriptValue each = domain.kept(value);
    if (on_keep_) on_keep_(entry, each);
    const bool is_known = on_keep_ || domain.index_of(each) != 0;
    add_option(kept, is_known ? each : merged({{each, where}}), where);
  }
  entries_[entry] = std::move(kept);
}

// What SetBlackboard copies, or writes.
ScriptRun::Source ScriptRun::source_of(const Setting& setting) {
  if (!setting.source) {
    // A new entry becomes one of texts.
    return {{{ScriptValue::of(setting.text).as(EntryType::Text),
              ScriptGuard::always()}},
            {}};
  }
  const auto variable = world_.variable_of(*setting.source);
  if (!variable) {
    return {{{ScriptValue::any(), ScriptGuard::always()}},
            ScriptGuard::always()};
  }
  Source source;
  const bool copies = releases::copies_anything(engine());
  const bool is_read = releases::copies_text(engine());
  for (const auto& [value, where] : held(*variable)) {
    if (value.kind == ScriptKind::Unset || (is_read && value.is_nothing())) {
      may_throw(where);
    } else if (value.kind == ScriptKind::Empty && !copies) {
      source.fails = either(source.fails, where);
    } else {
      if (value.kind == ScriptKind::Unknown) {
        if (is_read) may_lack(where);
        source.fails = either(source.fails, where);
      }
      add_option(source.values, value, where);
    }
  }
  if (copies || is_read) source.fails = {};
  return source;
}

// Of an entry that is written in release 3 the value is replaced as a whole.
ScriptResult ScriptRun::stored(StateVariableId entry,
                               const ScriptOptions& values,
                               const Setting& setting) {
  if (engine() < releases::kFirst4) {
    return {values, anywhere(values)};
  }
  const bool exists = world_.domain(entry).exists;
  return paired(grouped(held(entry), type_alone), values,
                [&](const ScriptValue& now, const ScriptValue& value) {
                  const bool is_there = now.kind == ScriptKind::Unknown
                                            ? exists
                                            : now.kind != ScriptKind::Unset;
                  return apply_setting_in(engine(), setting.source.has_value(),
                                          now, {is_there, setting.is_own},
                                          value);
                });
}

ScriptRun::SettingGuards ScriptRun::set(std::optional<StateVariableId> entry,
                                        const Setting& setting) {
  const Source source = source_of(setting);
  if (!entry) {
    may_throw(ScriptGuard::always());
    return {anywhere(source.values), source.fails};
  }
  const ScriptResult result =
      within(*entry, stored(*entry, source.values, setting));
  keep(*entry, result);
  return {result.yields, source.fails};
}

void ScriptRun::join(const ScriptGuard& where, const Entries& one,
                     const ScriptGuard& elsewhere, const Entries& other) {
  Entries joined = one;
  joined.insert(other.begin(), other.end());
  for (auto& [entry, options] : joined) {
    options = under(where, values_of(entry, one));
    for (const auto& [value, guard] :
         under(elsewhere, values_of(entry, other))) {
      add_option(options, value, guard);
    }
  }
  entries_ = std::move(joined);
}

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// A value is a list of what it may be, each with the states where it may be
// that. An operator goes over all combinations; `&&`, `||` and comparisons in
// a chain work on the guards, so that long conditions stay small.
#include "model/btcpp/entries/run.hpp"

#include <utility>

namespace btcheck::btcpp {

namespace {

using Operation = ScriptOperation;

}  // namespace

void ScriptRun::execute(const ScriptTree& tree, std::uint32_t statement) {
  last_ = evaluate(tree, statement);
  completes_ = both(completes_, last_.yields);
  path_ = completes_;
}

ScriptResult ScriptRun::evaluate(const ScriptTree& tree, std::uint32_t index) {
  const ScriptTerm& term = tree.terms[index];
  const auto constant = [](ScriptValue value) {
    return ScriptResult{{{std::move(value), ScriptGuard::always()}},
                        ScriptGuard::always()};
  };
  switch (term.operation) {
    case Operation::Number:
      if (!term.number) return constant(ScriptValue::any());
      return constant(term.is_integer ? ScriptValue::integer(*term.number)
                                      : ScriptValue::real(*term.number));
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

ScriptResult ScriptRun::prefix(const ScriptTree& tree, const ScriptTerm& term) {
  const ScriptOptions nothing = {{ScriptValue::unset(), ScriptGuard::always()}};
  return paired(evaluate(tree, term.operands[0]).options, nothing,
                [&](const ScriptValue& of, const ScriptValue&) {
                  return apply_prefix(term.operation, of);
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

ScriptResult ScriptRun::compare(ScriptComparison by, const ScriptResult& left,
                                const ScriptResult& right) {
  ScriptResult result =
      paired(left.options, right.options,
             [&](const ScriptValue& one, const ScriptValue& other) {
               return apply_comparison(by, one, other);
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
    ScriptResult step = compare(term.comparisons[i], left, right);
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
  const ScriptTruthGuards when = truth(condition, choice_of);
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

bool is_open(const ScriptValue& value) {
  return value.kind == ScriptKind::Unknown || value.kind == ScriptKind::Any ||
         value.kind == ScriptKind::AnyText;
}

ScriptTruthGuards ScriptRun::truth(
    const ScriptResult& of, ScriptTruth (*judge)(const ScriptValue&)) const {
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

ScriptResult ScriptRun::from_truth(const ScriptGuard& hold,
                                   const ScriptGuard& fail,
                                   const ScriptGuard& yields) {
  ScriptResult result{{}, yields};
  add_option(result.options, ScriptValue::of(true), hold);
  add_option(result.options, ScriptValue::of(false), fail);
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

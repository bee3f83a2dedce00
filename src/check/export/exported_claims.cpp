// SPDX-License-Identifier: MIT
//
// Bound properties as claims of exported models.
//
// One property may be said in several ways; each language gets the plainest it
// has. For runs the assumptions A of the file become A => F, as in a search;
// what a search keeps apart (strong fairness) is written out here. What a
// language cannot say is left out with a warning: a model with fewer claims is
// of use, one with other claims is not.
#include "check/export/exported_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <utility>

#include "check/export/formula_spelling.hpp"
#include "model/export/fiacre/language.hpp"
#include "model/export/layout.hpp"
#include "model/export/names.hpp"

namespace btcheck {
namespace {

// A formula of linear time over propositions, which every run has to satisfy.
struct LinearClaim {
  FormulaPool pool;
  FormulaId formula{};
  std::vector<Proposition> propositions;
};

FormulaId add_proposition(LinearClaim& claim, Proposition proposition) {
  claim.propositions.push_back(std::move(proposition));
  return claim.pool.atom(
      static_cast<std::uint32_t>(claim.propositions.size() - 1));
}

FormulaId add_state(LinearClaim& claim, const StatePredicate& predicate) {
  return add_proposition(claim, {predicate, PropositionKind::State, {}});
}

// Infinitely often requested implies infinitely often granted; what is always
// requested is not mentioned.
FormulaId fairness(LinearClaim& claim, const FairnessPair& pair) {
  const auto recurs = [&](const StatePredicate& predicate) {
    return claim.pool.unary(
        FormulaKind::Always,
        claim.pool.unary(FormulaKind::Eventually, add_state(claim, predicate)));
  };
  if (pair.requested.expression == Expression::constant(1)) {
    return recurs(pair.granted);
  }
  const FormulaId requested = recurs(pair.requested);
  return claim.pool.binary(FormulaKind::Implies, requested,
                           recurs(pair.granted));
}

LinearClaim copied(const BoundFormula& formula) {
  return {formula.pool, formula.formula, formula.propositions};
}

// What every run has to satisfy; of `possible`, what some run must violate.
LinearClaim linear_claim(const BoundProperty& bound,
                         const BoundAssumptions& assumptions) {
  LinearClaim claim;
  if (bound.assumed) {
    claim = copied(bound.assumed->formula);
  } else if (bound.form == PropertyForm::Ltl) {
    claim = copied(bound.formula);
  } else {
    FormulaId state = add_state(claim, bound.predicate);
    if (bound.form != PropertyForm::Invariant) {
      state = claim.pool.unary(FormulaKind::Not, state);
    }
    claim.formula = claim.pool.unary(FormulaKind::Always, state);
  }
  for (const FairnessPair& pair : assumptions.strong) {
    const FormulaId assumed = fairness(claim, pair);
    claim.formula =
        claim.pool.binary(FormulaKind::Implies, assumed, claim.formula);
  }
  return claim;
}

bool speaks_of_single_states(const BoundProperty& bound) {
  return !bound.assumed && (bound.form == PropertyForm::Never ||
                            bound.form == PropertyForm::Invariant ||
                            bound.form == PropertyForm::Possible ||
                            bound.form == PropertyForm::DeadlockFree);
}

bool has_steps(const LinearClaim& claim) {
  return std::ranges::any_of(
      claim.propositions, [](const Proposition& proposition) {
        return proposition.kind != PropositionKind::State;
      });
}

bool asks_death(const std::vector<Proposition>& propositions) {
  return std::ranges::any_of(propositions, [](const Proposition& proposition) {
    return proposition.of.when_dead.has_value();
  });
}

// Why linear time over single states cannot say it; "" where it can.
std::string_view beyond_stutter(const LinearClaim& claim) {
  if (has_steps(claim)) return "it speaks of steps";
  if (claim.pool.has_next(claim.formula)) return "it speaks of the next state";
  if (asks_death(claim.propositions)) return "it asks for dead or stuck states";
  return {};
}

std::vector<std::string> remarks_of(const Property& property,
                                    std::string_view also = {}) {
  std::vector<std::string> remarks;
  if (!property.title.empty()) remarks.push_back(property.title);
  remarks.push_back(property.text);
  if (!also.empty()) remarks.emplace_back(also);
  return remarks;
}

constexpr std::string_view kTurned =
    "the property holds exactly when this is violated";

std::vector<Expression> expressions_of(const LinearClaim& claim) {
  std::vector<Expression> expressions;
  for (const Proposition& proposition : claim.propositions) {
    expressions.push_back(proposition.of.expression);
  }
  return expressions;
}

// Turns the properties of a file into claims, one after the other.
template <class Claim>
class Exporter {
 public:
  Exporter(const BoundFile& bound, const SourceText& source)
      : assumptions_(bound.assumptions), source_(source) {}

  ExportedClaims<Claim> take() { return std::move(exported_); }

 protected:
  const BoundAssumptions& assumptions() const { return assumptions_; }

  std::string unique(const std::string& wanted) {
    std::string name = wanted;
    for (int number = 2; !used_.insert(name).second; ++number) {
      name = fmt::format("{}_{}", wanted, number);
    }
    return name;
  }

  void add(const Property& property, Claim claim, std::string_view language) {
    if (claim.formula.empty()) {
      return leave_out(property, "its formula would be too long", language);
    }
    exported_.claims.push_back(std::move(claim));
  }

  void leave_out(const Property& property, std::string_view why,
                 std::string_view language, std::string_view code = "BT0006") {
    exported_.left_out.push_back(
        source_.diagnostic(Severity::Warning, code, property.span,
                           fmt::format("`{}` is not exported to {}: {}",
                                       property.name, language, why)));
  }

 private:
  const BoundAssumptions& assumptions_;
  const SourceText& source_;
  std::set<std::string> used_;
  ExportedClaims<Claim> exported_;
};

class PromelaExporter : public Exporter<PromelaClaim> {
 public:
  using Exporter::Exporter;

  void run(const BoundProperty& bound) {
    const Property& property = *bound.property;
    if (const auto why = reason(bound); !why.empty()) {
      return leave_out(property, why, "Promela");
    }
    const LinearClaim claim = linear_claim(bound, assumptions());
    if (const auto why = beyond_stutter(claim); !why.empty()) {
      return leave_out(property, why, "Promela");
    }
    const bool is_turned = bound.form == PropertyForm::Possible;
    add(property,
        {unique("rule_" + as_identifier(property.name)),
         linear_spelling(claim.pool, claim.formula, kSpinSigns),
         expressions_of(claim),
         remarks_of(property, is_turned ? kTurned : std::string_view())},
        "Promela");
  }

 private:
  static std::string_view reason(const BoundProperty& bound) {
    if (bound.form == PropertyForm::Timed) return "it speaks of real time";
    if (bound.form == PropertyForm::Branching) return "it is branching time";
    return {};
  }
};

// `enter P` is true where P is false and true in the next state.
std::string step_event(const Proposition& proposition, std::size_t number) {
  return proposition.kind == PropositionKind::Enter
             ? fmt::format("(!p{0} & X p{0})", number)
             : fmt::format("(p{0} & X !p{0})", number);
}

class SmvExporter : public Exporter<SmvClaim> {
 public:
  using Exporter::Exporter;

  void run(const BoundProperty& bound) {
    const Property& property = *bound.property;
    if (bound.form == PropertyForm::Timed) {
      return leave_out(property, "it speaks of real time", "SMV");
    }
    SmvClaim claim;
    claim.name = unique("rule_" + as_identifier(property.name));
    claim.remarks = remarks_of(property);
    if (bound.form == PropertyForm::Branching) {
      if (!assumptions().empty()) {
        return leave_out(property, "it is branching time under assumptions",
                         "SMV");
      }
      claim.kind = SmvClaim::Kind::Branching;
      claim.formula =
          smv_branching_spelling(bound.formula.pool, bound.formula.formula);
      claim.propositions = propositions_of(bound.formula.propositions);
    } else if (speaks_of_single_states(bound)) {
      ask_states(bound, claim);
    } else {
      ask_runs(bound, claim);
    }
    add(property, std::move(claim), "SMV");
  }

 private:
  static SmvProposition proposition_of(const Proposition& proposition) {
    SmvProposition made;
    made.condition = proposition.of.expression;
    made.when_dead = proposition.of.when_dead;
    made.movers = proposition.movers;
    if (proposition.kind == PropositionKind::Moves) {
      made.kind = SmvProposition::Kind::Moves;
    } else if (proposition.kind == PropositionKind::Passes) {
      made.kind = SmvProposition::Kind::Passes;
    }
    return made;
  }

  static std::vector<SmvProposition> propositions_of(
      const std::vector<Proposition>& propositions) {
    std::vector<SmvProposition> made;
    for (const Proposition& proposition : propositions) {
      made.push_back(proposition_of(proposition));
    }
    return made;
  }

  static void ask_states(const BoundProperty& bound, SmvClaim& claim) {
    claim.propositions = propositions_of(
        {Proposition{bound.predicate, PropositionKind::State, {}}});
    if (bound.form == PropertyForm::Possible) {
      claim.kind = SmvClaim::Kind::Branching;
      claim.formula = "EF p0";
    } else {
      claim.formula = bound.form == PropertyForm::Invariant ? "p0" : "!p0";
    }
  }

  void ask_runs(const BoundProperty& bound, SmvClaim& claim) const {
    const LinearClaim linear = linear_claim(bound, assumptions());
    claim.kind = SmvClaim::Kind::Linear;
    claim.propositions = propositions_of(linear.propositions);
    claim.formula = with_propositions(
        linear_spelling(linear.pool, linear.formula, kSmvSigns),
        [&](std::size_t number) {
          const Proposition& asked = linear.propositions.at(number);
          const bool is_change = asked.kind == PropositionKind::Enter ||
                                 asked.kind == PropositionKind::Leave;
          return is_change ? step_event(asked, number)
                           : fmt::format("p{}", number);
        });
    if (bound.form == PropertyForm::Possible) {
      claim.remarks = remarks_of(*bound.property, kTurned);
    }
  }
};

// Fiacre's compiler frac reads less than its papers have: what is joined stands
// in parentheses, also behind `ltl`; formulas have no constants, so a process
// observes them; a scope stands before a time; intervals are closed and have an
// end; there is no `first`.
class FiacreExporter : public Exporter<FiacreClaim> {
 public:
  using Exporter::Exporter;

  void run(const BoundProperty& bound) {
    const Property& property = *bound.property;
    FiacreClaim claim;
    claim.name = unique(fiacre_identifier(property.name));
    claim.remarks = remarks_of(property);
    std::string_view why;
    if (bound.form == PropertyForm::Timed) {
      why = ask_time(bound, claim);
    } else if (bound.form == PropertyForm::Branching) {
      why = "it is branching time";
    } else if (bound.form == PropertyForm::DeadlockFree && !bound.assumed) {
      claim.formula = "deadlockfree";
    } else {
      why = ask_runs(bound, claim);
    }
    if (!why.empty()) return leave_out(property, why, "Fiacre");
    if (const auto missing = beyond_frac(bound); !missing.empty()) {
      return leave_out(property, missing, "Fiacre", "BT0008");
    }
    add(property, std::move(claim), "Fiacre");
  }

 private:
  std::string_view ask_runs(const BoundProperty& bound,
                            FiacreClaim& claim) const {
    const LinearClaim linear = linear_claim(bound, assumptions());
    if (const auto why = beyond_stutter(linear); !why.empty()) return why;
    claim.propositions = expressions_of(linear);
    if (bound.form == PropertyForm::Possible) {
      claim.remarks = remarks_of(*bound.property, kTurned);
    }
    if (speaks_of_single_states(bound)) {
      claim.formula =
          bound.form == PropertyForm::Invariant ? "always p0" : "absent p0";
    } else {
      ask_formula(linear, claim);
    }
    return {};
  }

  static void ask_formula(const LinearClaim& linear, FiacreClaim& claim) {
    const auto constant = [&](int value) {
      claim.propositions.push_back(Expression::constant(value));
      return fmt::format("p{}", claim.propositions.size() - 1);
    };
    const std::string truth = constant(1);
    const std::string falsehood = constant(0);
    LinearSigns signs = kFiacreSigns;
    signs.truth = truth;
    signs.falsehood = falsehood;
    const std::string text =
        linear_spelling(linear.pool, linear.formula, signs);
    if (text.empty()) return;
    const FormulaKind top = linear.pool[linear.formula].kind;
    const bool is_joined = !is_leaf(top) && !is_unary(top);
    claim.formula = is_joined ? "ltl (" + text + ")" : "ltl " + text;
  }

  static std::string_view beyond_frac(const BoundProperty& bound) {
    const TimedPattern& pattern = bound.timed.pattern;
    if (bound.form != PropertyForm::Timed) return {};
    // From age 0 on no answer comes too early: the first is as good as any.
    if (pattern.demand == Demand::FirstAnswer && pattern.from > 0) {
      return "frac 2.3.0 has no `first`";
    }
    const bool has_end = pattern.to != kNoEnd;
    return has_end ? "" : "frac 2.3.0 has no interval without an end";
  }

  // The patterns that Fiacre has (Abid, Dal Zilio and Le Botlan 2012).
  static std::string_view ask_time(const BoundProperty& bound,
                                   FiacreClaim& claim) {
    const TimedPattern& pattern = bound.timed.pattern;
    if (bound.assumed) return "it speaks of real time under assumptions";
    for (const StatePredicate& predicate : bound.timed.predicates) {
      if (predicate.when_dead) return "it asks for dead or stuck states";
      claim.propositions.push_back(predicate.expression);
    }
    const bool is_absence = pattern.demand == Demand::NoAnswer;
    if (pattern.demand == Demand::Lasting || pattern.must_open ||
        (is_absence && pattern.trigger != 0)) {
      return "Fiacre has no such pattern, or reads it in dense time only";
    }
    claim.formula = pattern.trigger != 0 ? place(pattern.trigger) + " leadsto "
                    : is_absence         ? "absent "
                                         : "present ";
    claim.formula += place(pattern.answer);
    if (pattern.opening != 0) {
      claim.formula += " after " + place(pattern.opening);
    }
    if (pattern.closing != 0) {
      claim.formula += " before " + place(pattern.closing);
    }
    claim.formula += fmt::format(" within [{},{}]", pattern.from, pattern.to);
    return {};
  }

  static std::string place(PropositionSet bit) {
    return fmt::format("p{}", std::countr_zero(bit));
  }
};

template <class Exporter>
auto exported(const BoundFile& bound, const SourceText& source) {
  Exporter exporter(bound, source);
  for (const BoundProperty& property : bound.properties) {
    exporter.run(property);
  }
  return exporter.take();
}

}  // namespace

ExportedClaims<PromelaClaim> promela_claims(const BoundFile& bound,
                                            const SourceText& source) {
  return exported<PromelaExporter>(bound, source);
}

ExportedClaims<SmvClaim> smv_claims(const BoundFile& bound,
                                    const SourceText& source) {
  return exported<SmvExporter>(bound, source);
}

ExportedClaims<FiacreClaim> fiacre_claims(const BoundFile& bound,
                                          const SourceText& source) {
  return exported<FiacreExporter>(bound, source);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Each language gets the plainest form it has. For runs, assumptions A become A
// => F, and strong fairness, which a search keeps apart, is written out. What a
// language cannot say is left out with a warning: a model with fewer claims is
// of use, one with other claims is not.
#include "check/export/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "ltl/formula/formula.hpp"
#include "model/export/fiacre/process.hpp"
#include "model/export/layout.hpp"
#include "model/export/names.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

// Operands come before operators in a pool, so one pass makes all texts, and
// nothing recurses. Each operator gets its parentheses: how tightly operators
// bind is where tools differ.
using Texts = std::map<FormulaId, std::string>;
constexpr std::size_t kLongest = 200'000;  // characters

// The operators of linear time, and what each tool writes for them; prefix
// operators stand before "(…)". Without a sign for it, equivalence is two
// implications. Weak until is written with release: a W b is b R (a or b), on
// which all tools agree.
constexpr std::array kOperators = {
    FormulaKind::Not,     FormulaKind::Always,     FormulaKind::Eventually,
    FormulaKind::Next,    FormulaKind::And,        FormulaKind::Or,
    FormulaKind::Implies, FormulaKind::Equivalent, FormulaKind::Until,
    FormulaKind::Release, FormulaKind::True,       FormulaKind::False};
using LinearSigns = std::array<std::string_view, kOperators.size()>;
constexpr LinearSigns kSpinSigns = {"!",  "[] ", "<> ", "X ", "&&",   "||",
                                    "->", "<->", "U",   "V",  "true", "false"};
constexpr LinearSigns kLtsminSigns = {"!",  "[] ", "<> ",  "X ",
                                      "&&", "||",  "->",   "<->",
                                      "U",  "R",   "true", "false"};
constexpr LinearSigns kSmvSigns = {"!",  "G ",  "F ", "X ", "&",    "|",
                                   "->", "<->", "U",  "V",  "TRUE", "FALSE"};
constexpr LinearSigns kFiacreSigns = {"not ",  "[] ",     "<> ",  "() ",
                                      "and",   "or",      "=>",   "",
                                      "until", "release", "true", "false"};

std::string_view sign_of(FormulaKind kind, const LinearSigns& signs) {
  const auto at = std::ranges::find(kOperators, kind);
  assert(at != kOperators.end());
  return signs[static_cast<std::size_t>(at - kOperators.begin())];
}

// Without the parentheses around all of it.
std::string opened(const FormulaNode& node, const std::string& text) {
  return is_leaf(node.kind) || text.empty() ? text
                                            : text.substr(1, text.size() - 2);
}

// A part without path quantifiers around it; the operands are known.
std::string linear_part(const FormulaNode& node, const Texts& texts,
                        const LinearSigns& signs) {
  if (node.kind == FormulaKind::Atom) return fmt::format("p{}", node.atom);
  if (is_leaf(node.kind)) return std::string(sign_of(node.kind, signs));
  const std::string& left = texts.at(node.left);
  if (is_unary(node.kind)) {
    return fmt::format("({}{})", sign_of(node.kind, signs), left);
  }
  const std::string& right = texts.at(node.right);
  if (node.kind == FormulaKind::WeakUntil) {
    return fmt::format("({1} {2} ({0} {3} {1}))", left, right,
                       sign_of(FormulaKind::Release, signs),
                       sign_of(FormulaKind::Or, signs));
  }
  const std::string_view sign = sign_of(node.kind, signs);
  if (node.kind == FormulaKind::Equivalent && sign.empty()) {
    return fmt::format("(({0} {2} {1}) {3} ({1} {2} {0}))", left, right,
                       sign_of(FormulaKind::Implies, signs),
                       sign_of(FormulaKind::And, signs));
  }
  return fmt::format("({} {} {})", left, sign, right);
}

// E or A before the operator of a path.
std::string quantified(char letter, const FormulaNode& path,
                       const Texts& texts) {
  const std::string& left = texts.at(path.left);
  if (is_unary(path.kind)) {
    const char sign = path.kind == FormulaKind::Always       ? 'G'
                      : path.kind == FormulaKind::Eventually ? 'F'
                                                             : 'X';
    return fmt::format("({}{} {})", letter, sign, left);
  }
  const std::string& right = texts.at(path.right);
  if (path.kind == FormulaKind::Until) {
    return fmt::format("{} [{} U {}]", letter, left, right);
  }
  // By duality: A (a R b) is not E (not a U not b), and E likewise.
  const char dual = letter == 'A' ? 'E' : 'A';
  if (path.kind == FormulaKind::Release) {
    return fmt::format("(!{} [(!{}) U (!{})])", dual, left, right);
  }
  return fmt::format("(!{0} [(!{2}) U ((!{1}) & (!{2}))])", dual, left, right);
}

// The text of a formula, part by part; "" where it would be longer than anyone
// reads: W, and equivalence without a sign, say an operand twice.
template <class Write>
std::string spelled(const FormulaPool& pool, FormulaId formula, Write write) {
  Texts texts;
  for (const FormulaId part : pool.nodes(formula)) {
    texts[part] = write(pool[part], texts);
    if (texts[part].size() > kLongest) return {};
  }
  return texts.at(formula);
}

// Without path quantifiers: atom i is `pi`, every operator but the outermost
// has its parentheses.
std::string linear_spelling(const FormulaPool& pool, FormulaId formula,
                            const LinearSigns& signs) {
  return opened(
      pool[formula],
      spelled(pool, formula, [&](const FormulaNode& node, const Texts& texts) {
        return linear_part(node, texts, signs);
      }));
}

// A formula of CTL as SMV writes it. W and R, which its CTL does not have, are
// written by what it has.
std::string smv_branching_spelling(const FormulaPool& pool, FormulaId formula) {
  return spelled(
      pool, formula, [&](const FormulaNode& node, const Texts& texts) {
        if (is_path_operator(node.kind)) {
          return std::string();  // its quantifier writes it
        }
        return is_path_quantifier(node.kind)
                   ? quantified(
                         node.kind == FormulaKind::ExistsPath ? 'E' : 'A',
                         pool[node.left], texts)
                   : linear_part(node, texts, kSmvSigns);
      });
}

// --- What every language has -------------------------------------------------

FormulaId add_state(BoundFormula& claim, const StatePredicate& predicate) {
  claim.propositions.push_back({predicate, PropositionKind::State, {}});
  return claim.pool.atom(
      static_cast<std::uint32_t>(claim.propositions.size() - 1));
}

// Infinitely often requested implies infinitely often granted; what is always
// requested is not mentioned.
FormulaId fairness(BoundFormula& claim, const FairnessPair& pair) {
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

bool speaks_of_single_states(const BoundProperty& bound) {
  return !bound.is_assumed && asks_of_states(bound.form);
}

// What every run has to satisfy; of `possible`, what some run must violate.
BoundFormula linear_claim(const BoundProperty& bound,
                          const BoundAssumptions& assumptions) {
  BoundFormula claim = bound.formula;
  if (speaks_of_single_states(bound)) {
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

// Why linear time over single states cannot say it; "" where it can.
std::string_view beyond_stutter(const BoundFormula& claim) {
  const auto some = [&](auto&& is_so) {
    return std::ranges::any_of(claim.propositions, is_so);
  };
  if (some([](const Proposition& proposition) {
        return proposition.kind != PropositionKind::State;
      })) {
    return "it speaks of steps";
  }
  if (claim.pool.has_next(claim.formula)) return "it speaks of the next state";
  if (some([](const Proposition& proposition) {
        return proposition.of.when_dead.has_value();
      })) {
    return "it asks for dead or stuck states";
  }
  return {};
}

std::vector<Expression> expressions_of(const BoundFormula& claim) {
  std::vector<Expression> expressions;
  for (const Proposition& proposition : claim.propositions) {
    expressions.push_back(proposition.of.expression);
  }
  return expressions;
}

// Why a property is not exported; no words where it is.
struct Omission {
  std::string_view why;
  std::string_view code = "BT0006";
};

// A run can only be asked for what it must not be.
template <class Claim>
void remark_turned(const BoundProperty& bound, Claim& claim) {
  if (bound.form != PropertyForm::Possible) return;
  claim.remarks.emplace_back(
      "the property holds exactly when this is violated");
}

Omission in_promela(const BoundProperty& bound,
                    const BoundAssumptions& assumptions, ExportClaim& claim) {
  if (bound.form == PropertyForm::Timed) return {"it speaks of real time"};
  if (bound.form == PropertyForm::Branching) return {"it is branching time"};
  const BoundFormula linear = linear_claim(bound, assumptions);
  claim.formula = linear_spelling(linear.pool, linear.formula, kSpinSigns);
  claim.propositions = expressions_of(linear);
  remark_turned(bound, claim);
  return {beyond_stutter(linear)};
}

// `enter P` is true where P is false and true in the next state.
std::string step_event(const Proposition& proposition, std::size_t number) {
  return proposition.kind == PropositionKind::Enter
             ? fmt::format("(!p{0} & X p{0})", number)
             : fmt::format("(p{0} & X !p{0})", number);
}

std::vector<SmvProposition> propositions_of(
    const std::vector<Proposition>& propositions) {
  using Kind = SmvProposition::Kind;
  std::vector<SmvProposition> made;
  for (const Proposition& proposition : propositions) {
    SmvProposition& next = made.emplace_back();
    next.condition = proposition.of.expression;
    next.when_dead = proposition.of.when_dead;
    next.movers = proposition.movers;
    if (proposition.kind == PropositionKind::Moves) next.kind = Kind::Moves;
    if (proposition.kind == PropositionKind::Passes) next.kind = Kind::Passes;
  }
  return made;
}

void ask_runs(const BoundProperty& bound, const BoundAssumptions& assumptions,
              SmvClaim& claim) {
  const BoundFormula linear = linear_claim(bound, assumptions);
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
  remark_turned(bound, claim);
}

Omission in_smv(const BoundProperty& bound, const BoundAssumptions& assumptions,
                SmvClaim& claim) {
  if (bound.form == PropertyForm::Timed) return {"it speaks of real time"};
  if (bound.form == PropertyForm::Branching) {
    if (!assumptions.empty()) {
      return {"it is branching time under assumptions"};
    }
    claim.kind = SmvClaim::Kind::Branching;
    claim.formula =
        smv_branching_spelling(bound.formula.pool, bound.formula.formula);
    claim.propositions = propositions_of(bound.formula.propositions);
  } else if (!speaks_of_single_states(bound)) {
    ask_runs(bound, assumptions, claim);
  } else {
    claim.propositions = propositions_of(
        {Proposition{bound.predicate, PropositionKind::State, {}}});
    claim.formula = bound.form == PropertyForm::Invariant  ? "p0"
                    : bound.form == PropertyForm::Possible ? "EF p0"
                                                           : "!p0";
    if (bound.form == PropertyForm::Possible) {
      claim.kind = SmvClaim::Kind::Branching;
    }
  }
  return {};
}

Omission in_ltsmin(const BoundProperty& bound,
                   const BoundAssumptions& assumptions, LtsminClaim& claim) {
  constexpr std::size_t kMostPropositions = 30;
  if (bound.form == PropertyForm::Timed) return {"it speaks of real time"};
  if (bound.form == PropertyForm::Branching) return {"it is branching time"};
  claim.is_invariant = speaks_of_single_states(bound);
  if (claim.is_invariant) {
    claim.propositions = {{bound.predicate, PropositionKind::State, {}}};
    claim.formula = bound.form == PropertyForm::Invariant ? "p0" : "!p0";
  } else {
    BoundFormula linear = linear_claim(bound, assumptions);
    claim.formula = linear_spelling(linear.pool, linear.formula, kLtsminSigns);
    claim.propositions = std::move(linear.propositions);
  }
  remark_turned(bound, claim);
  if (claim.propositions.size() > kMostPropositions) {
    return {"it has more than 30 propositions"};
  }
  return {};
}

// Fiacre's compiler frac reads less than its papers have: what is joined stands
// in parentheses, also behind `ltl`; formulas have no constants, so a process
// observes them; a scope stands before a time; intervals are closed and have an
// end; there is no `first`.
Omission ask_runs(const BoundProperty& bound,
                  const BoundAssumptions& assumptions, ExportClaim& claim) {
  const BoundFormula linear = linear_claim(bound, assumptions);
  if (const auto why = beyond_stutter(linear); !why.empty()) return {why};
  claim.propositions = expressions_of(linear);
  remark_turned(bound, claim);
  if (speaks_of_single_states(bound)) {
    claim.formula =
        bound.form == PropertyForm::Invariant ? "always p0" : "absent p0";
    return {};
  }
  const std::string truth = fmt::format("p{}", claim.propositions.size());
  const std::string falsehood =
      fmt::format("p{}", claim.propositions.size() + 1);
  claim.propositions.push_back(Expression::constant(1));
  claim.propositions.push_back(Expression::constant(0));
  LinearSigns signs = kFiacreSigns;
  signs[signs.size() - 2] = truth;
  signs[signs.size() - 1] = falsehood;
  const std::string text = linear_spelling(linear.pool, linear.formula, signs);
  if (text.empty()) return {};
  const FormulaKind top = linear.pool[linear.formula].kind;
  const bool is_joined = !is_leaf(top) && !is_unary(top);
  claim.formula = is_joined ? "ltl (" + text + ")" : "ltl " + text;
  return {};
}

std::string place(PropositionSet bit) {
  return fmt::format("p{}", std::countr_zero(bit));
}

// The patterns that Fiacre has (Abid, Dal Zilio and Le Botlan 2012).
Omission ask_time(const BoundProperty& bound, ExportClaim& claim) {
  const TimedPattern& pattern = bound.timed.pattern;
  if (bound.is_assumed) return {"it speaks of real time under assumptions"};
  for (const StatePredicate& predicate : bound.timed.predicates) {
    if (predicate.when_dead) return {"it asks for dead or stuck states"};
    claim.propositions.push_back(predicate.expression);
  }
  const bool is_absence = pattern.demand == Demand::NoAnswer;
  if (pattern.demand == Demand::Lasting || pattern.must_open ||
      (is_absence && pattern.trigger != 0)) {
    return {"Fiacre has no such pattern, or reads it in dense time only"};
  }
  claim.formula = pattern.trigger != 0 ? place(pattern.trigger) + " leadsto "
                  : is_absence         ? "absent "
                                       : "present ";
  claim.formula += place(pattern.answer);
  if (pattern.opening != 0) claim.formula += " after " + place(pattern.opening);
  if (pattern.closing != 0) {
    claim.formula += " before " + place(pattern.closing);
  }
  claim.formula += fmt::format(" within [{},{}]", pattern.from, pattern.to);
  // From age 0 on no answer comes too early: the first is as good as any.
  if (pattern.demand == Demand::FirstAnswer && pattern.from > 0) {
    return {"frac 2.3.0 has no `first`", "BT0008"};
  }
  if (pattern.to == kNoEnd) {
    return {"frac 2.3.0 has no interval without an end", "BT0008"};
  }
  return {};
}

Omission in_fiacre(const BoundProperty& bound,
                   const BoundAssumptions& assumptions, ExportClaim& claim) {
  if (bound.form == PropertyForm::Timed) return ask_time(bound, claim);
  if (bound.form == PropertyForm::Branching) return {"it is branching time"};
  if (bound.form == PropertyForm::DeadlockFree && !bound.is_assumed) {
    claim.formula = "deadlockfree";
    return {};
  }
  return ask_runs(bound, assumptions, claim);
}

// --- A file ------------------------------------------------------------------

// `say` writes the formula of a claim, or says why it cannot.
template <class Claim, class Say>
ExportedClaims<Claim> exported(const BoundFile& bound, const SourceText& source,
                               std::string_view language, Say say) {
  ExportedClaims<Claim> exported;
  std::set<std::string> used;
  for (const BoundProperty& each : bound.properties) {
    const Property& property = *each.property;
    Claim claim;
    if (!property.title.empty()) claim.remarks.push_back(property.title);
    claim.remarks.push_back(property.text);
    Omission omission = say(each, bound.assumptions, claim);
    if (omission.why.empty() && claim.formula.empty()) {
      omission.why = "its formula would be too long";
    }
    if (!omission.why.empty()) {
      exported.left_out.push_back(source.diagnostic(
          Severity::Warning, omission.code, property.span,
          fmt::format("`{}` is not exported to {}: {}", property.name, language,
                      omission.why)));
      continue;
    }
    claim.name = unused_name(
        used, language == "Fiacre" ? fiacre_identifier(property.name)
                                   : "rule_" + as_identifier(property.name));
    exported.claims.push_back(std::move(claim));
  }
  return exported;
}

}  // namespace

ExportedClaims<ExportClaim> promela_claims(const BoundFile& bound,
                                           const SourceText& source) {
  return exported<ExportClaim>(bound, source, "Promela", in_promela);
}

ExportedClaims<LtsminClaim> ltsmin_claims(const BoundFile& bound,
                                          const SourceText& source) {
  return exported<LtsminClaim>(bound, source, "LTSmin", in_ltsmin);
}

ExportedClaims<SmvClaim> smv_claims(const BoundFile& bound,
                                    const SourceText& source) {
  return exported<SmvClaim>(bound, source, "SMV", in_smv);
}

ExportedClaims<ExportClaim> fiacre_claims(const BoundFile& bound,
                                          const SourceText& source) {
  return exported<ExportClaim>(bound, source, "Fiacre", in_fiacre);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Random patterns with scopes and times.
//
// The words are put together here, what they mean is copied from elsewhere:
// without a time from the catalogue (pattern_catalogue.hpp), with one as the
// roles that conditions play in a metric temporal formula
// (timed_definition.hpp).
#include "reference/random_pattern.hpp"

#include <fmt/format.h>

#include <array>

#include "reference/pattern_catalogue.hpp"

namespace btcheck::reference {

namespace {

// The conditions of a pattern and of its scope, as formulas and as text.
struct Conditions {
  Conditions(RandomProperty& made, AtomMaker& maker) {
    for (std::size_t i = 0; i < 4; ++i) {
      const int size = maker.percent(70) ? 1 : 2;
      ids[i] = maker.state_formula(made.pool, size);
      texts[i] = text_of(made, ids[i]);
    }
  }
  const std::string& p() const { return texts[0]; }
  const std::string& q() const { return texts[1]; }
  const std::string& a() const { return texts[2]; }
  const std::string& r() const { return texts[3]; }

  std::array<FormulaId, 4> ids{};
  std::array<std::string, 4> texts;
};

std::string claim_text(Pattern pattern, const Conditions& of,
                       AtomMaker& maker) {
  const std::uint32_t spelling = maker.number(3);
  switch (pattern) {
    case Pattern::Absence:
      return (spelling == 0 ? "absent " : "never ") + of.p();
    case Pattern::Universality:
      return "always " + of.p();
    case Pattern::Existence:
      return (spelling == 0 ? "eventually " : "present ") + of.p();
    case Pattern::Response:
      return spelling == 0 ? "whenever " + of.p() + " then " + of.q()
                           : of.p() + " leadsto " + of.q();
    case Pattern::Precedence:
      if (spelling == 0) return of.q() + " requires " + of.p();
      return of.p() + (spelling == 1 ? " precedes " : " before ") + of.q();
    case Pattern::Exclusion:
      break;
  }
  return of.p() + " forbids " + of.q();
}

std::string scope_text(ScopeKind scope, const Conditions& of) {
  switch (scope) {
    case ScopeKind::Globally:
      return "globally";
    case ScopeKind::Before:
      return "before " + of.r();
    case ScopeKind::After:
      return "after " + of.a();
    case ScopeKind::Between:
      return "between " + of.a() + " and " + of.r();
    case ScopeKind::AfterUntil:
      break;
  }
  return "after " + of.a() + " until " + of.r();
}

std::string in_scope(const std::string& claim, ScopeKind scope,
                     const Conditions& of, AtomMaker& maker) {
  if (scope == ScopeKind::Globally && maker.percent(60)) return claim;
  const std::string where = scope_text(scope, of);
  return maker.percent(40) ? where + ", " + claim : claim + " " + where;
}

// `absentAfter P Q` and its kind.
std::string macro_text(Pattern pattern, ScopeKind scope, const Conditions& of,
                       AtomMaker& maker) {
  constexpr std::array<const char*, 5> kPatterns = {
      "absent", "always", "present", "leadsto", "precedes"};
  constexpr std::array<const char*, 5> kScopes = {"", "Before", "After",
                                                  "Between", "AfterUntil"};
  const bool is_short = scope == ScopeKind::AfterUntil && maker.percent(50);
  std::vector<std::string> operands = {of.p()};
  if (pattern >= Pattern::Response) operands.push_back(of.q());
  if (scope != ScopeKind::Before) operands.push_back(of.a());
  if (scope != ScopeKind::After) operands.push_back(of.r());
  const bool is_list = maker.percent(50);
  return fmt::format(
      "{}{} {}{}{}", kPatterns[static_cast<std::size_t>(pattern)],
      is_short ? "Until" : kScopes[static_cast<std::size_t>(scope)],
      is_list ? "(" : "", fmt::join(operands, is_list ? ", " : " "),
      is_list ? ")" : "");
}

// An interval as text; some ends are open, some missing.
std::string random_interval(TimedClaim& claim, AtomMaker& maker) {
  claim.from = static_cast<int>(maker.number(3));
  claim.to = claim.from + static_cast<int>(maker.number(3));
  const bool is_left_open = claim.from > 0 && maker.percent(30);
  const std::string left = is_left_open ? fmt::format("]{}", claim.from - 1)
                                        : fmt::format("[{}", claim.from);
  if (maker.percent(20)) {
    claim.to = kNoEnd;
    return left + (maker.percent(50) ? ",...[" : ",inf[");
  }
  const bool is_right_open = maker.percent(30);
  return left + (is_right_open ? fmt::format(",{}[", claim.to + 1)
                               : fmt::format(",{}]", claim.to));
}

std::string within(TimedClaim& claim, AtomMaker& maker) {
  if (!maker.percent(25)) return "within " + random_interval(claim, maker);
  claim.to = static_cast<int>(maker.number(4));
  return fmt::format("within {} ticks", claim.to);
}

std::string for_time(TimedClaim& claim, AtomMaker& maker) {
  if (!maker.percent(25)) return "for " + random_interval(claim, maker);
  claim.to = static_cast<int>(maker.number(4));
  return fmt::format("for {}", claim.to);
}

// A claim that may be about what follows an `a`.
std::string perhaps_after(TimedClaim& claim, const std::string& text,
                          const std::string& time, const Conditions& of,
                          AtomMaker& maker) {
  if (maker.percent(50)) return text + " " + time;
  claim.opening = of.ids[2];
  const std::string scope = "after " + of.a();
  switch (maker.number(3)) {
    case 0:
      return scope + ", " + text + " " + time;
    case 1:
      return text + " " + scope + " " + time;
    default:
      return text + " " + time + " " + scope;
  }
}

// P leadsto Q, the first Q, P forbids Q.
std::string timed_response(TimedClaim& claim, const Conditions& of,
                           AtomMaker& maker) {
  claim.trigger = of.ids[0];
  claim.answer = of.ids[1];
  const std::string time = within(claim, maker);
  if (maker.percent(30)) {
    claim.demand = Demand::NoAnswer;
    return perhaps_after(claim, of.p() + " forbids " + of.q(), time, of, maker);
  }
  const bool is_first = maker.percent(40);
  claim.demand = is_first ? Demand::FirstAnswer : Demand::Answer;
  const std::string answer = (is_first ? "first " : "") + of.q();
  const std::string text = maker.percent(30)
                               ? "whenever " + of.p() + " then " + answer
                               : of.p() + " leadsto " + answer;
  if (maker.percent(65)) return perhaps_after(claim, text, time, of, maker);
  claim.closing = of.ids[3];
  const std::string scope = "before " + of.r();
  return maker.percent(50) ? scope + ", " + text + " " + time
                           : text + " " + time + " " + scope;
}

// present P, the first P, absent P.
std::string timed_occurrence(TimedClaim& claim, const Conditions& of,
                             FormulaPool& pool, AtomMaker& maker) {
  claim.answer = of.ids[0];
  if (maker.percent(40)) {
    claim.demand = Demand::NoAnswer;
    const bool is_always = maker.percent(30);
    if (is_always) claim.answer = pool.unary(FormulaKind::Not, of.ids[0]);
    const std::string word = is_always ? "always " : "absent ";
    return perhaps_after(claim, word + of.p(), for_time(claim, maker), of,
                         maker);
  }
  const bool is_first = maker.percent(40);
  claim.demand = is_first ? Demand::FirstAnswer : Demand::Answer;
  return perhaps_after(claim,
                       (is_first ? "present first " : "present ") + of.p(),
                       within(claim, maker), of, maker);
}

// absent P before R for d, present P lasting d.
std::string timed_duration(TimedClaim& claim, const Conditions& of,
                           AtomMaker& maker) {
  const int length = 1 + static_cast<int>(maker.number(3));
  claim.to = length - 1;
  if (maker.percent(50)) {
    claim.demand = Demand::Lasting;
    claim.opening = claim.answer = of.ids[0];
    claim.must_open = true;
    return fmt::format("present {} lasting {}", of.p(), length);
  }
  claim.demand = Demand::NoAnswer;
  claim.trigger = of.ids[0];
  claim.answer = of.ids[3];
  claim.closing = of.ids[3];
  return fmt::format("absent {} before {} for {}", of.p(), of.r(), length);
}

}  // namespace

void make_response(RandomProperty& made, AtomMaker& maker) {
  made.kind = PropertyKind::Response;
  made.form = PropertyForm::Timed;
  TimedClaim& claim = made.timed;
  claim.trigger = maker.state_formula(made.pool, 1);
  claim.answer = maker.state_formula(made.pool, 2);
  claim.from = static_cast<int>(maker.number(3));
  claim.to = claim.from + static_cast<int>(maker.number(3));
  made.body =
      fmt::format("{} leadsto {} within [{},{}]", text_of(made, *claim.trigger),
                  text_of(made, claim.answer), claim.from, claim.to);
}

void make_pattern(RandomProperty& made, AtomMaker& maker, int most_temporal) {
  made.kind = PropertyKind::Pattern;
  made.form = PropertyForm::Ltl;
  while (true) {
    const auto pattern = static_cast<Pattern>(maker.number(6));
    const auto scope = static_cast<ScopeKind>(maker.number(5));
    const Conditions of(made, maker);
    made.formula = catalogued(made.pool, pattern, scope, of.ids[0], of.ids[1],
                              of.ids[2], of.ids[3]);
    if (temporal_count(made.pool, made.formula) > most_temporal) continue;
    const bool may_be_macro =
        pattern != Pattern::Exclusion && scope != ScopeKind::Globally;
    made.body =
        may_be_macro && maker.percent(25)
            ? macro_text(pattern, scope, of, maker)
            : in_scope(claim_text(pattern, of, maker), scope, of, maker);
    return;
  }
}

void make_timed_pattern(RandomProperty& made, AtomMaker& maker) {
  made.kind = PropertyKind::Timed;
  made.form = PropertyForm::Timed;
  const Conditions of(made, maker);
  const std::uint32_t kind = maker.number(10);
  if (kind < 5) {
    made.body = timed_response(made.timed, of, maker);
  } else if (kind < 8) {
    made.body = timed_occurrence(made.timed, of, made.pool, maker);
  } else {
    made.body = timed_duration(made.timed, of, maker);
  }
}

}  // namespace btcheck::reference

// SPDX-License-Identifier: MIT
//
// Patterns with a time: which of them take which, and what they then claim.
//
// Each becomes one TimedClaim (ltl/rules/property.hpp), which says what opens
// the wait, what is waited for and when it is due; ltl/timed/timed_pattern.hpp
// tells how it is searched for. The patterns are those of Abid, Dal Zilio and
// Le Botlan (FMICS 2012). Not every pattern takes a time in every scope:
// combinations that theirs do not have are refused here, and nothing is
// approximated.
#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

class TimedReader {
 public:
  TimedReader(PropertyParser& in, Property& property, const Tail& tail)
      : in_(in), property_(property), tail_(tail), timing_(*tail.timing) {}

  bool claim(Pattern pattern, const Phrase& p, const Phrase& q);

 private:
  bool set_occurrence(Pattern pattern);
  bool set_lasting(FormulaId p);
  bool set_absence_before(FormulaId p);
  bool set_response(Pattern pattern, FormulaId trigger);
  bool refuse_time(std::string_view why);

  PropertyParser& in_;
  Property& property_;
  const Tail& tail_;
  const Timing& timing_;
};

bool TimedReader::claim(Pattern pattern, const Phrase& p, const Phrase& q) {
  constexpr std::string_view kWho = "a pattern with a time";
  constexpr std::string_view kHelp = "without the time it may be any formula";
  if (!require_state_predicate(in_, p, kWho, kHelp) ||
      !require_state_predicate(in_, q, kWho, kHelp)) {
    return false;
  }
  property_.form = PropertyForm::Timed;
  TimedClaim& claim = property_.timed;
  claim.from = timing_.from;
  claim.to = timing_.to;
  claim.answer = q.id;
  switch (pattern) {
    case Pattern::Universality:
      claim.answer = in_.formulas().unary(FormulaKind::Not, p.id);
      [[fallthrough]];
    case Pattern::Absence:
      if (tail_.scope.kind == ScopeKind::Before) {
        return set_absence_before(claim.answer);
      }
      return set_occurrence(Pattern::Absence);
    case Pattern::Existence:
      if (timing_.kind == TimeKind::Lasting) {
        return set_lasting(p.id);
      }
      return set_occurrence(pattern);
    case Pattern::Response:
    case Pattern::Exclusion:
      return set_response(pattern, p.id);
    case Pattern::Precedence:
      break;
  }
  return refuse_time("this pattern takes no time");
}

// present P [after Q] within I, absent P [after Q] for I.
bool TimedReader::set_occurrence(Pattern pattern) {
  if (timing_.kind == TimeKind::Lasting) {
    return refuse_time("`lasting` goes with `present`");
  }
  if (pattern == Pattern::Existence && timing_.kind == TimeKind::For) {
    return refuse_time("`present` takes `within` or `lasting`");
  }
  if (tail_.scope.kind == ScopeKind::After) {
    property_.timed.opening = tail_.scope.opening;
  } else if (tail_.scope.kind != ScopeKind::Globally) {
    return refuse_time("with this scope the pattern takes no time");
  }
  property_.timed.demand = pattern == Pattern::Absence ? Demand::NoAnswer
                           : tail_.asks_for_first      ? Demand::FirstAnswer
                                                       : Demand::Answer;
  return true;
}

// present P lasting d: the first P lasts d units of time.
bool TimedReader::set_lasting(FormulaId p) {
  if (tail_.scope.kind != ScopeKind::Globally || tail_.asks_for_first) {
    return refuse_time("`lasting` takes neither a scope nor `first`");
  }
  if (timing_.from != 0 || timing_.to == 0 || timing_.to == kNoEnd) {
    return refuse_time("`lasting` takes one number above 0");
  }
  property_.timed.opening = property_.timed.answer = p;
  property_.timed.to = timing_.to - 1;
  property_.timed.demand = Demand::Lasting;
  property_.timed.must_open = true;
  return true;
}

// absent P before R for d: none in the last d units of time before R.
bool TimedReader::set_absence_before(FormulaId p) {
  if (timing_.kind != TimeKind::For || timing_.from != 0 || timing_.to == 0 ||
      timing_.to == kNoEnd) {
    return refuse_time("before R it takes `for` and a number above 0");
  }
  property_.timed.trigger = p;
  property_.timed.answer = tail_.scope.closing;
  property_.timed.closing = tail_.scope.closing;
  property_.timed.to = timing_.to - 1;
  property_.timed.demand = Demand::NoAnswer;
  return true;
}

// P leadsto [first] Q within I, P forbids Q within I.
bool TimedReader::set_response(Pattern pattern, FormulaId trigger) {
  if (timing_.kind != TimeKind::Within) {
    return refuse_time("this pattern takes `within`");
  }
  TimedClaim& claim = property_.timed;
  claim.trigger = trigger;
  claim.demand = pattern == Pattern::Exclusion ? Demand::NoAnswer
                 : tail_.asks_for_first        ? Demand::FirstAnswer
                                               : Demand::Answer;
  if (tail_.scope.kind == ScopeKind::After) {
    claim.opening = tail_.scope.opening;
    return true;
  }
  const bool may_close = pattern == Pattern::Response;
  if (tail_.scope.kind == ScopeKind::Before && may_close) {
    claim.closing = tail_.scope.closing;
    return true;
  }
  if (tail_.scope.kind == ScopeKind::Globally) return true;
  return refuse_time("with this scope the pattern takes no time");
}

bool TimedReader::refuse_time(std::string_view why) {
  return in_.error("BT1222", timing_.span, std::string(why), {},
                   "docs/properties.md lists the patterns with their times");
}

}  // namespace

bool claim_timed(PropertyParser& in, Property& property, Pattern pattern,
                 const Phrase& p, const Phrase& q, const Tail& tail) {
  return TimedReader(in, property, tail).claim(pattern, p, q);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What may follow a pattern: where it must hold, and when, in either order.
//
// Fiacre writes both behind the pattern; a scope may also open the property,
// with a comma behind it. `between Q and R` and `after Q until R` use words
// that are operators elsewhere: they end Q unless parentheses hide them.
//
// A pattern with a time becomes one TimedClaim (ltl/timed/timed_pattern.hpp).
// The patterns are those of Abid, Dal Zilio and Le Botlan (FMICS 2012). They do
// not have every pattern with a time in every scope: the other combinations are
// refused here, and nothing is approximated.
#include <fmt/format.h>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

constexpr std::int32_t kMaxBound = 1'000'000;

bool at_scope(const PropertyParser& in) {
  return in.at_word("globally") || in.at_word("before") ||
         in.at_word("after") || in.at_word("between");
}

// A condition on single states that a scope is bounded by.
std::optional<FormulaId> read_bound(PropertyParser& in, std::string_view scope,
                                    std::string_view stop = {}) {
  in.stop_word = stop;
  const auto phrase = read_formula(in);
  in.stop_word = {};
  if (!phrase ||
      !require_state_predicate(in, *phrase, fmt::format("`{}`", scope),
                               "write the property as LTL: `ltl ...`")) {
    return std::nullopt;
  }
  if (scope == "between" && phrase->join != kNoToken) {
    return in.error("BT1205", in.span(phrase->first, phrase->end),
                    "the ends of `between ... and ...` need parentheses",
                    "where does the first end?",
                    fmt::format("write `({})`", in.text(*phrase)));
  }
  return phrase->id;
}

bool read_scope(PropertyParser& in, Tail& tail) {
  Scope& scope = tail.scope;
  tail.has_scope = true;
  tail.scope_span = in.here();
  const auto close = [&](ScopeKind kind, std::string_view name) {
    const auto closing = read_bound(in, name);
    if (!closing) return false;
    scope.kind = kind;
    scope.closing = *closing;
    return true;
  };
  if (in.accept_word("globally")) return true;
  if (in.accept_word("before")) return close(ScopeKind::Before, "before");
  const bool is_between = in.accept_word("between");
  if (!is_between) in.take();  // `after`
  const auto opening = is_between ? read_bound(in, "between", "and")
                                  : read_bound(in, "after", "until");
  if (!opening) return false;
  scope.opening = *opening;
  if (is_between) {
    if (in.accept_word("and")) return close(ScopeKind::Between, "between");
    return in.unexpected("`between` has two ends", "expected `and`",
                         "write `between Q and R`");
  }
  if (in.accept_word("until")) return close(ScopeKind::AfterUntil, "until");
  scope.kind = ScopeKind::After;
  return true;
}

// within 2 ticks, within ]0,4], for 3, lasting 3
class TimeReader {
 public:
  TimeReader(PropertyParser& in, Timing& timing) : in_(in), timing_(timing) {}

  bool read() {
    const Token& word = in_.take();
    timing_.kind = equal_ignoring_case(word.text, "within") ? TimeKind::Within
                   : equal_ignoring_case(word.text, "for")  ? TimeKind::For
                                                            : TimeKind::Lasting;
    const bool is_interval =
        in_.at(TokenKind::LeftBracket) || in_.at(TokenKind::RightBracket);
    return is_interval ? read_interval() : read_duration(word.text);
  }

 private:
  bool read_duration(std::string_view word) {
    const std::size_t first = in_.position();
    if (!in_.at(TokenKind::Number)) {
      return in_.unexpected(
          "a bound is missing", "expected a number or `[`",
          fmt::format("write `{0} 2 ticks` or `{0} [0,2]`", word));
    }
    const auto ticks = read_number(in_);
    if (!ticks || !set(first, 0, *ticks)) return false;
    if (!in_.at_item() &&
        (in_.accept_word("ticks") || in_.accept_word("tick"))) {
      return true;
    }
    // Fiacre's durations are bare numbers; after `within` a unit is asked for.
    if (timing_.kind != TimeKind::Within) return true;
    return in_.unexpected("a bound counts ticks", "expected `ticks`",
                          fmt::format("write `within {} ticks`", *ticks));
  }

  bool read_interval() {
    const std::size_t first = in_.position();
    const bool is_left_open = in_.take().kind == TokenKind::RightBracket;
    const auto low = read_number(in_);
    std::optional<std::int32_t> high;
    if (!low || !read_upper(high)) return false;
    const bool is_right_open = in_.at(TokenKind::LeftBracket);
    if (!is_right_open && !in_.at(TokenKind::RightBracket)) {
      return in_.unexpected("this interval is never closed", "expected `]`",
                            "bounds are whole numbers, as in `[0,2]`");
    }
    in_.take();
    const std::int64_t to =
        high ? std::int64_t{*high} - is_right_open : std::int64_t{kNoEnd};
    return set(first, std::int64_t{*low} + is_left_open, to);
  }

  // The comma and the upper end; none when the interval has no end.
  bool read_upper(std::optional<std::int32_t>& high) {
    if (!in_.accept(TokenKind::Comma)) {
      return in_.unexpected("an interval has two ends", "expected `,`",
                            "bounds are whole numbers, as in `[0,2]`");
    }
    if (in_.accept(TokenKind::Ellipsis) || in_.accept_word("inf") ||
        in_.accept_word("infinity") || in_.accept_word("∞")) {
      return true;
    }
    high = read_number(in_);
    return high.has_value();
  }

  bool set(std::size_t first, std::int64_t from, std::int64_t to) {
    const SourceSpan span = in_.span(first, in_.position());
    if (from < 0 || from > kMaxBound || (to > kMaxBound && to != kNoEnd)) {
      return in_.error("BT1215", span, "this bound is out of range", {},
                       fmt::format("bounds lie between 0 and {}", kMaxBound));
    }
    if (from > to) {
      const bool is_turned = to + 2 <= from;
      return in_.error(
          "BT1215", span, "this interval is empty",
          is_turned ? "it ends before it begins" : "no whole number lies in it",
          is_turned ? fmt::format("write `[{},{}]`", to, from) : std::string());
    }
    timing_.from = static_cast<std::int32_t>(from);
    timing_.to = static_cast<std::int32_t>(to);
    timing_.span = span;
    return true;
  }

  PropertyParser& in_;
  Timing& timing_;
};

// What a pattern with a time claims.
class TimedReader {
 public:
  TimedReader(PropertyParser& in, TimedClaim& claim, const Tail& tail)
      : in_(in), claim_(claim), tail_(tail), timing_(*tail.timing) {}

  bool claim(Pattern pattern, const Phrase& p, const Phrase& q) {
    constexpr std::string_view kWho = "a pattern with a time";
    constexpr std::string_view kHelp = "without the time it may be any formula";
    if (!require_state_predicate(in_, p, kWho, kHelp) ||
        !require_state_predicate(in_, q, kWho, kHelp)) {
      return false;
    }
    claim_.from = timing_.from;
    claim_.to = timing_.to;
    claim_.answer = q.id;
    switch (pattern) {
      case Pattern::Universality:
        claim_.answer = in_.formulas().unary(FormulaKind::Not, p.id);
        [[fallthrough]];
      case Pattern::Absence:
        if (tail_.scope.kind == ScopeKind::Before) {
          return set_absence_before(claim_.answer);
        }
        return set_occurrence(Pattern::Absence);
      case Pattern::Existence:
        if (timing_.kind == TimeKind::Lasting) return set_lasting(p.id);
        return set_occurrence(pattern);
      case Pattern::Response:
      case Pattern::Exclusion:
        return set_response(pattern, p.id);
      case Pattern::Precedence:
        break;
    }
    return refuse_time("this pattern takes no time");
  }

 private:
  // present P [after Q] within I, absent P [after Q] for I.
  bool set_occurrence(Pattern pattern) {
    if (timing_.kind == TimeKind::Lasting) {
      return refuse_time("`lasting` goes with `present`");
    }
    if (pattern == Pattern::Existence && timing_.kind == TimeKind::For) {
      return refuse_time("`present` takes `within` or `lasting`");
    }
    set_demand(pattern == Pattern::Absence);
    return set_scope();
  }

  void set_demand(bool is_absence) {
    claim_.demand = is_absence             ? Demand::NoAnswer
                    : tail_.asks_for_first ? Demand::FirstAnswer
                                           : Demand::Answer;
  }

  bool set_scope() {
    if (tail_.scope.kind == ScopeKind::Globally) return true;
    if (tail_.scope.kind != ScopeKind::After) {
      return refuse_time("with this scope the pattern takes no time");
    }
    claim_.opening = tail_.scope.opening;
    return true;
  }

  // A length of time above 0, such as 3 or [0,3].
  bool has_length() const {
    return timing_.from == 0 && timing_.to > 0 && timing_.to != kNoEnd;
  }

  // present P lasting d: the first P lasts d units of time.
  bool set_lasting(FormulaId p) {
    if (tail_.scope.kind != ScopeKind::Globally || tail_.asks_for_first) {
      return refuse_time("`lasting` takes neither a scope nor `first`");
    }
    if (!has_length()) {
      return refuse_time("`lasting` takes one number above 0");
    }
    claim_.opening = claim_.answer = p;
    claim_.to = timing_.to - 1;
    claim_.demand = Demand::Lasting;
    claim_.must_open = true;
    return true;
  }

  // absent P before R for d: none in the last d units of time before R.
  bool set_absence_before(FormulaId p) {
    if (timing_.kind != TimeKind::For || !has_length()) {
      return refuse_time("before R it takes `for` and a number above 0");
    }
    claim_.trigger = p;
    claim_.answer = tail_.scope.closing;
    claim_.closing = tail_.scope.closing;
    claim_.to = timing_.to - 1;
    claim_.demand = Demand::NoAnswer;
    return true;
  }

  // P leadsto [first] Q within I, P forbids Q within I.
  bool set_response(Pattern pattern, FormulaId trigger) {
    if (timing_.kind != TimeKind::Within) {
      return refuse_time("this pattern takes `within`");
    }
    claim_.trigger = trigger;
    set_demand(pattern == Pattern::Exclusion);
    const bool may_close = pattern == Pattern::Response;
    if (tail_.scope.kind != ScopeKind::Before || !may_close) return set_scope();
    claim_.closing = tail_.scope.closing;
    return true;
  }

  bool refuse_time(std::string_view why) {
    return in_.error("BT1222", timing_.span, std::string(why), {},
                     "docs/properties.md lists the patterns with their times");
  }

  PropertyParser& in_;
  TimedClaim& claim_;
  const Tail& tail_;
  const Timing& timing_;
};

}  // namespace

bool read_tail(PropertyParser& in, Tail& tail) {
  while (!in.at_item()) {
    if (at_scope(in)) {
      if (tail.has_scope) {
        return in.error("BT1222", in.here(), "a second scope",
                        "a pattern holds in one scope");
      }
      if (!read_scope(in, tail)) return false;
    } else if (in.at_word("within") || in.at_word("for") ||
               in.at_word("lasting")) {
      if (tail.timing) {
        return in.error("BT1222", in.here(), "a second time",
                        "a pattern takes one");
      }
      tail.timing.emplace();
      if (!TimeReader(in, *tail.timing).read()) return false;
    } else {
      break;
    }
  }
  return true;
}

bool read_leading_scope(PropertyParser& in, Tail& tail) {
  if (!at_scope(in) || in.continues_name()) return true;
  const bool is_global = in.at_word("globally");
  if (!is_global && !in.starts_operand(1)) return true;
  if (!read_scope(in, tail)) return false;
  if (in.accept(TokenKind::Comma) || is_global) return true;
  return in.unexpected("a scope in front is followed by a comma",
                       "expected `,`", "write `after Q, never P`");
}

bool claim_timed(PropertyParser& in, TimedClaim& claim, Pattern pattern,
                 const Phrase& p, const Phrase& q, const Tail& tail) {
  return TimedReader(in, claim, tail).claim(pattern, p, q);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What a property claims: the words people say, turned into one of six forms.
//
// Most words are abbreviations of LTL (the right column of kForms). Three are
// kept as forms of their own when their condition speaks of single states,
// because a search of the reachable states then answers them without an
// automaton: never, always, possible. A bound turns `leadsto` and `whenever`
// into the timed form. A body's word takes everything up to the body's end:
// `always P => Q` is `always (P => Q)`, unlike `[] P => Q`, and is warned about
// for that reason.
#include <fmt/format.h>

#include <array>

#include "ltl/property_parser.hpp"

namespace btcheck {
namespace {

constexpr std::int32_t kMaxBound = 1'000'000;

class BodyReader {
 public:
  BodyReader(PropertyParser& in, Property& property)
      : in_(in), property_(property) {}

  bool read();

 private:
  using Reader = bool (BodyReader::*)(std::string_view word);
  struct Form {
    std::string_view word;
    Reader read;
  };
  static const std::array<Form, 10> kForms;

  bool read_on_states(std::string_view word);   // one form per word
  bool read_always(std::string_view word);      // [] P
  bool read_eventually(std::string_view word);  // <> P
  bool read_infinitely(std::string_view word);  // [] <> P
  bool read_mortal(std::string_view word);      // <> [] not P
  bool read_deadlock_free(std::string_view word);
  bool read_ltl(std::string_view word);
  bool read_whenever(std::string_view word);  // [] (P => <> Q)
  bool read_condition();                      // LTL, or P leadsto Q
  bool read_answer(const Phrase& trigger);
  bool read_within();
  bool read_interval();
  bool read_upper(std::optional<std::int32_t>& high);
  bool set_interval(std::size_t first, std::int32_t from, std::int32_t to);
  void warn_of_reach(std::string_view word, const Phrase& phrase);

  bool claim(FormulaKind kind, FormulaId of) {
    property_.form = PropertyForm::Ltl;
    property_.formula = in_.formulas().unary(kind, of);
    return true;
  }

  PropertyParser& in_;
  Property& property_;
};

const std::array<BodyReader::Form, 10> BodyReader::kForms = {{
    {"never", &BodyReader::read_on_states},
    {"absent", &BodyReader::read_on_states},
    {"possible", &BodyReader::read_on_states},
    {"always", &BodyReader::read_always},
    {"eventually", &BodyReader::read_eventually},
    {"present", &BodyReader::read_eventually},
    {"infinitelyOften", &BodyReader::read_infinitely},
    {"mortal", &BodyReader::read_mortal},
    {"deadlockfree", &BodyReader::read_deadlock_free},
    {"ltl", &BodyReader::read_ltl},
}};

bool BodyReader::read() {
  if (refuse_later_body(in_)) return false;
  if (in_.at_keyword("whenever")) {
    in_.take();
    return read_whenever("whenever");
  }
  for (const Form& form : kForms) {
    if (!in_.at_keyword(form.word)) continue;
    in_.take();
    return (this->*form.read)(form.word);
  }
  return read_condition();
}

bool BodyReader::read_on_states(std::string_view word) {
  const auto phrase = read_formula(in_);
  if (!phrase || refuse_later_suffix(in_, word)) return false;
  property_.form =
      word == "possible" ? PropertyForm::Possible : PropertyForm::Never;
  property_.formula = phrase->id;
  return require_state_predicate(in_, *phrase, fmt::format("`{}`", word),
                                 "write the property as LTL: `ltl ...`");
}

bool BodyReader::read_always(std::string_view word) {
  const bool is_recurrence =
      in_.at_keyword("eventually") && in_.accept_word("eventually");
  const auto phrase = read_formula(in_);
  if (!phrase || refuse_later_suffix(in_, word)) return false;
  warn_of_reach(is_recurrence ? "always eventually" : "always", *phrase);
  if (is_recurrence) {
    return claim(FormulaKind::Always,
                 in_.formulas().unary(FormulaKind::Eventually, phrase->id));
  }
  if (phrase->temporal != kNoToken) {
    return claim(FormulaKind::Always, phrase->id);
  }
  property_.form = PropertyForm::Invariant;
  property_.formula = phrase->id;
  return true;
}

bool BodyReader::read_eventually(std::string_view word) {
  const bool is_persistence = word == "eventually" &&
                              in_.at_keyword("always") &&
                              in_.accept_word("always");
  const auto phrase = read_formula(in_);
  const std::string_view form = is_persistence ? "eventually always" : word;
  if (!phrase || refuse_later_suffix(in_, form)) return false;
  return claim(FormulaKind::Eventually,
               is_persistence
                   ? in_.formulas().unary(FormulaKind::Always, phrase->id)
                   : phrase->id);
}

bool BodyReader::read_infinitely(std::string_view word) {
  const auto phrase = read_formula(in_);
  if (!phrase || refuse_later_suffix(in_, word)) return false;
  return claim(FormulaKind::Always,
               in_.formulas().unary(FormulaKind::Eventually, phrase->id));
}

bool BodyReader::read_mortal(std::string_view word) {
  const auto phrase = read_formula(in_);
  if (!phrase || refuse_later_suffix(in_, word)) return false;
  FormulaPool& formulas = in_.formulas();
  return claim(FormulaKind::Eventually,
               formulas.unary(FormulaKind::Always,
                              formulas.unary(FormulaKind::Not, phrase->id)));
}

bool BodyReader::read_deadlock_free(std::string_view word) {
  property_.form = PropertyForm::DeadlockFree;
  return !refuse_later_suffix(in_, word);
}

bool BodyReader::read_ltl(std::string_view) {
  const auto phrase = read_formula(in_);
  if (!phrase) return false;
  property_.form = PropertyForm::Ltl;
  property_.formula = phrase->id;
  return true;
}

bool BodyReader::read_whenever(std::string_view) {
  const auto trigger = read_formula(in_);
  if (!trigger) return false;
  if (!in_.accept_word("then")) {
    if (infix_here(in_) || in_.at_end() || in_.at_item()) {
      return in_.unexpected("`whenever` has no `then`", "expected `then` here",
                            "write `whenever P then Q`");
    }
    return refuse_leftover(in_);
  }
  return read_answer(*trigger);
}

bool BodyReader::read_condition() {
  const auto phrase = read_formula(in_);
  if (!phrase) return false;
  if (in_.accept_word("leadsto")) return read_answer(*phrase);
  if (refuse_later_suffix(in_, "")) return false;
  property_.form = PropertyForm::Ltl;
  property_.formula = phrase->id;
  return true;
}

// What follows `leadsto` or `then`.
bool BodyReader::read_answer(const Phrase& trigger) {
  if (in_.at_keyword("first") && in_.starts_operand(1)) {
    return in_.not_yet(in_.here(), "`leadsto first`",
                       "without `first` any later Q is an answer");
  }
  const auto answer = read_formula(in_);
  if (!answer) return false;
  FormulaPool& formulas = in_.formulas();
  if (!in_.at_word("within")) {
    return !refuse_later_suffix(in_, "leadsto") &&
           claim(FormulaKind::Always,
                 formulas.binary(
                     FormulaKind::Implies, trigger.id,
                     formulas.unary(FormulaKind::Eventually, answer->id)));
  }
  property_.form = PropertyForm::Response;
  property_.formula = trigger.id;
  property_.answer = answer->id;
  constexpr std::string_view kWho = "a response within a time";
  constexpr std::string_view kHelp = "without `within` it may be any formula";
  return require_state_predicate(in_, trigger, kWho, kHelp) &&
         require_state_predicate(in_, *answer, kWho, kHelp) && read_within() &&
         !refuse_later_suffix(in_, "leadsto");
}

bool BodyReader::read_within() {
  in_.take();
  if (in_.at(TokenKind::LeftBracket) || in_.at(TokenKind::RightBracket)) {
    return read_interval();
  }
  const std::size_t first = in_.position();
  if (!in_.at(TokenKind::Number)) {
    return in_.unexpected("a bound is missing", "expected a number or `[`",
                          "write `within 2 ticks` or `within [0,2]`");
  }
  const auto ticks = read_number(in_);
  if (!ticks || !set_interval(first, 0, *ticks)) return false;
  if (!in_.at_item() && (in_.accept_word("ticks") || in_.accept_word("tick"))) {
    return true;
  }
  return in_.unexpected("a bound counts ticks", "expected `ticks`",
                        fmt::format("write `within {} ticks`", *ticks));
}

bool BodyReader::read_interval() {
  const std::size_t first = in_.position();
  const bool is_left_open = in_.take().kind == TokenKind::RightBracket;
  const auto low = read_number(in_);
  if (!low) return false;
  std::optional<std::int32_t> high;
  if (!read_upper(high)) return false;
  const bool is_right_open = in_.at(TokenKind::LeftBracket);
  if (!is_right_open && !in_.at(TokenKind::RightBracket)) {
    return in_.unexpected("this interval is never closed", "expected `]`",
                          "bounds are whole numbers, as in `[0,2]`");
  }
  in_.take();
  if (!high) {
    return in_.not_yet(in_.span(first, in_.position()),
                       "an interval without an end",
                       *low == 0 && !is_left_open
                           ? "leave `within` out: the answer may then come at "
                             "any time"
                           : "");
  }
  if (!is_left_open && !is_right_open) return set_interval(first, *low, *high);
  const std::int64_t from = std::int64_t{*low} + is_left_open;
  const std::int64_t to = std::int64_t{*high} - is_right_open;
  return in_.not_yet(
      in_.span(first, in_.position()), "an open interval",
      from <= to
          ? fmt::format("time is counted in whole units: write `[{},{}]`", from,
                        to)
          : "");
}

// The comma and the upper end; none when the interval has no end.
bool BodyReader::read_upper(std::optional<std::int32_t>& high) {
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

bool BodyReader::set_interval(std::size_t first, std::int32_t from,
                              std::int32_t to) {
  const SourceSpan span = in_.span(first, in_.position());
  if (from < 0 || to > kMaxBound) {
    return in_.error("BT1215", span, "this bound is out of range", {},
                     fmt::format("bounds lie between 0 and {}", kMaxBound));
  }
  if (from > to) {
    return in_.error("BT1215", span, "this interval is empty",
                     "it ends before it begins",
                     fmt::format("write `[{},{}]`", to, from));
  }
  property_.from = from;
  property_.to = to;
  return true;
}

// `always P => Q`, whose two readings `[] P => Q` makes people mix up.
void BodyReader::warn_of_reach(std::string_view word, const Phrase& phrase) {
  if (phrase.join == kNoToken || phrase.joined_by != FormulaKind::Implies) {
    return;
  }
  const std::string_view arrow = in_.token(phrase.join).text;
  const std::string_view symbols = word == "always" ? "[]" : "[] <>";
  in_.warn("BT1203", in_.token(phrase.join).span,
           fmt::format("`{}` covers this `{}`, which `{}` would not", word,
                       arrow, symbols),
           fmt::format("read as `{} (...)`", word),
           fmt::format("write `{0} ({1})` to keep this reading,\n"
                       "or `({2} {3}) {4} {5}` for the other one",
                       word, in_.text(phrase), symbols,
                       in_.text(phrase.first, phrase.join, kShownText), arrow,
                       in_.text(phrase.join + 1, phrase.end, kShownText)));
}

bool require_end(PropertyParser& in) {
  return in.at_end() || in.at_item() || refuse_leftover(in);
}

bool require_few_atoms(PropertyParser& in, const Property& property) {
  const std::size_t count = in.take_used_atoms().size();
  if (count <= kMaxAtoms) return true;
  return in.error(
      "BT1211", property.span,
      fmt::format("this property has {} different conditions", count),
      fmt::format("more than {}", kMaxAtoms),
      "split it into several properties");
}

void warn_of_next(PropertyParser& in) {
  if (in.first_next == kNoToken) return;
  const Token& next = in.token(in.first_next);
  in.warn("BT1204", next.span,
          fmt::format("`{}` speaks of a single step of the composed automata",
                      next.text),
          "which node takes that step is open",
          "name the event that is waited for, as in `P leadsto Q`");
}

}  // namespace

bool read_body(PropertyParser& in, Property& property) {
  const std::size_t first = in.position();
  in.first_next = kNoToken;
  in.take_used_atoms();
  if (!BodyReader(in, property).read()) return false;
  property.text = in.text(first, in.position());
  warn_of_next(in);
  return require_end(in) && require_few_atoms(in, property);
}

bool require_state_predicate(PropertyParser& in, const Phrase& phrase,
                             std::string_view who, std::string_view help) {
  if (phrase.temporal == kNoToken) return true;
  const Token& token = in.token(phrase.temporal);
  return in.error("BT1214", token.span,
                  fmt::format("{} takes a condition on single states", who),
                  fmt::format("`{}` speaks of a whole run", token.text),
                  std::string(help));
}

bool refuse_leftover(PropertyParser& in) {
  const Token& token = in.peek();
  if (token.kind == TokenKind::RightParen) {
    return in.unexpected("this `)` closes nothing", "no `(` before it");
  }
  if (token.kind == TokenKind::Eventually) {
    return in.unexpected("`<>` means eventually", "not a comparison",
                         "write `~=` or `!=` for not equal");
  }
  if (in.at_word("within")) {
    return in.unexpected("`within` has nothing to bound",
                         "no answer is waited for",
                         "it belongs behind `P leadsto Q` or "
                         "`whenever P then Q`");
  }
  const std::string otherwise = "conditions are joined with `and`, `or`, `=>`";
  return in.unexpected(
      fmt::format("`{}` cannot follow a complete condition", token.text),
      "expected an operator or the end of the property",
      token.kind == TokenKind::Word
          ? suggestion(token.text, joining_words(), otherwise)
          : otherwise);
}

}  // namespace btcheck

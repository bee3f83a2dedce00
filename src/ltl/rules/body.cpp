// SPDX-License-Identifier: MIT
//
// What a property claims: the words people say, turned into one of seven forms.
//
// Most words are abbreviations of LTL (ltl/formula/pattern.hpp has the patterns
// with their scopes). Three are kept as forms of their own when their condition
// speaks of single states, because a search of the reachable states then
// answers them without an automaton: never, always, possible. A time turns a
// pattern into the timed form (property_timed.cpp). A body's word takes
// everything up to the body's end: `always P => Q` is `always (P => Q)`, unlike
// `[] P => Q`, and is warned about for that reason.
#include <fmt/format.h>

#include <array>

#include "ltl/formula/ctl_syntax.hpp"
#include "ltl/formula/pattern.hpp"
#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

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
  static const std::array<Form, 11> kForms;

  bool read_never(std::string_view word);
  bool read_possible(std::string_view word);
  bool read_always(std::string_view word);
  bool read_eventually(std::string_view word);
  bool read_infinitely(std::string_view word);  // [] <> P
  bool read_mortal(std::string_view word);      // <> [] not P
  bool read_deadlock_free(std::string_view word);
  bool read_live(std::string_view word);  // AG EF P
  bool read_ltl(std::string_view word);
  bool read_whenever(std::string_view word);  // each P is followed by Q
  bool read_macro();                          // absentAfter P Q
  bool read_condition();                      // a formula, or P leadsto Q
  bool read_answer(const Phrase& trigger);
  bool read_precedence(const Phrase& left, std::string_view word);

  bool claim(Pattern pattern, const Phrase& p, const Phrase& q,
             const Tail& tail);
  bool claim_formula(FormulaId formula);
  bool refuse_tail(const Tail& tail, std::string_view word);
  void warn_of_reach(std::string_view word, const Phrase& phrase);

  PropertyParser& in_;
  Property& property_;
  Tail tail_;  // begins with the scope in front, if there is one
};

const std::array<BodyReader::Form, 11> BodyReader::kForms = {{
    {"never", &BodyReader::read_never},
    {"absent", &BodyReader::read_never},
    {"possible", &BodyReader::read_possible},
    {"always", &BodyReader::read_always},
    {"eventually", &BodyReader::read_eventually},
    {"present", &BodyReader::read_eventually},
    {"infinitelyOften", &BodyReader::read_infinitely},
    {"mortal", &BodyReader::read_mortal},
    {"deadlockfree", &BodyReader::read_deadlock_free},
    {"live", &BodyReader::read_live},
    {"ltl", &BodyReader::read_ltl},
}};

bool BodyReader::read() {
  if (!read_leading_scope(in_, tail_)) return false;
  if (in_.at_keyword("whenever")) {
    in_.take();
    return read_whenever("whenever");
  }
  for (const Form& form : kForms) {
    if (!in_.at_keyword(form.word)) continue;
    in_.take();
    return (this->*form.read)(form.word);
  }
  if (at_macro(in_)) return read_macro();
  return read_condition();
}

bool BodyReader::read_never(std::string_view) {
  const auto phrase = read_formula(in_);
  return phrase && read_tail(in_, tail_) &&
         claim(Pattern::Absence, *phrase, *phrase, tail_);
}

bool BodyReader::read_possible(std::string_view word) {
  const auto phrase = read_formula(in_);
  if (!phrase || !read_tail(in_, tail_) || !refuse_tail(tail_, word)) {
    return false;
  }
  property_.form = PropertyForm::Possible;
  property_.formula = phrase->id;
  return require_state_predicate(in_, *phrase, "`possible`",
                                 "branching time may be what you mean: "
                                 "`EF (P and EF Q)`");
}

bool BodyReader::read_always(std::string_view) {
  const bool is_recurrence =
      in_.at_keyword("eventually") && in_.accept_word("eventually");
  const auto phrase = read_formula(in_);
  if (!phrase || !read_tail(in_, tail_)) return false;
  warn_of_reach(is_recurrence ? "always eventually" : "always", *phrase);
  if (!is_recurrence) {
    return claim(Pattern::Universality, *phrase, *phrase, tail_);
  }
  FormulaPool& pool = in_.formulas();
  return refuse_tail(tail_, "always eventually") &&
         claim_formula(
             pool.unary(FormulaKind::Always,
                        pool.unary(FormulaKind::Eventually, phrase->id)));
}

bool BodyReader::read_eventually(std::string_view word) {
  const bool is_persistence = word == "eventually" &&
                              in_.at_keyword("always") &&
                              in_.accept_word("always");
  if (word == "present" && in_.at_keyword("first") && in_.starts_operand(1)) {
    in_.take();
    tail_.asks_for_first = true;
  }
  const auto phrase = read_formula(in_);
  if (!phrase || !read_tail(in_, tail_)) return false;
  if (!is_persistence) {
    return claim(Pattern::Existence, *phrase, *phrase, tail_);
  }
  FormulaPool& pool = in_.formulas();
  return refuse_tail(tail_, "eventually always") &&
         claim_formula(pool.unary(FormulaKind::Eventually,
                                  pool.unary(FormulaKind::Always, phrase->id)));
}

bool BodyReader::read_infinitely(std::string_view word) {
  const auto phrase = read_formula(in_);
  if (!phrase || !read_tail(in_, tail_)) return false;
  FormulaPool& pool = in_.formulas();
  return refuse_tail(tail_, word) &&
         claim_formula(
             pool.unary(FormulaKind::Always,
                        pool.unary(FormulaKind::Eventually, phrase->id)));
}

bool BodyReader::read_mortal(std::string_view word) {
  const auto phrase = read_formula(in_);
  if (!phrase || !read_tail(in_, tail_)) return false;
  FormulaPool& pool = in_.formulas();
  return refuse_tail(tail_, word) &&
         claim_formula(
             pool.unary(FormulaKind::Eventually,
                        pool.unary(FormulaKind::Always,
                                   pool.unary(FormulaKind::Not, phrase->id))));
}

bool BodyReader::read_deadlock_free(std::string_view word) {
  property_.form = PropertyForm::DeadlockFree;
  return read_tail(in_, tail_) && refuse_tail(tail_, word);
}

bool BodyReader::read_live(std::string_view word) {
  const auto phrase = read_formula(in_);
  if (!phrase || !read_tail(in_, tail_) || !refuse_tail(tail_, word)) {
    return false;
  }
  FormulaPool& pool = in_.formulas();
  const FormulaId reachable = pool.unary(
      FormulaKind::ExistsPath, pool.unary(FormulaKind::Eventually, phrase->id));
  return require_state_predicate(in_, *phrase, "`live`",
                                 "write it out: `AG EF ...`") &&
         claim_formula(pool.unary(FormulaKind::ForAllPaths,
                                  pool.unary(FormulaKind::Always, reachable)));
}

bool BodyReader::read_ltl(std::string_view word) {
  const auto phrase = read_formula(in_);
  return phrase && read_tail(in_, tail_) && refuse_tail(tail_, word) &&
         claim_formula(phrase->id);
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

// absentAfter P Q: the pattern, then the ends of its scope.
bool BodyReader::read_macro() {
  const Macro macro = *at_macro(in_);
  const Token& word = in_.take();
  std::array<Phrase, 4> operands;
  if (!read_macro_operands(in_, word, macro, operands)) return false;
  std::size_t next = 0;
  const Phrase first = operands[next++];
  const Phrase second = macro.takes_two ? operands[next++] : first;
  tail_.scope.kind = macro.scope;
  tail_.has_scope = true;
  const bool opens = macro.scope != ScopeKind::Before;
  if (opens) tail_.scope.opening = operands[next++].id;
  if (macro.scope != ScopeKind::After) {
    tail_.scope.closing = operands[next].id;
  }
  return claim(macro.pattern, first, second, tail_);
}

// A condition on single states that no temporal operator stands above.
bool looks_at_first_state(const FormulaPool& pool, FormulaId whole) {
  std::vector<FormulaId> waiting{whole};
  while (!waiting.empty()) {
    const FormulaNode& node = pool[waiting.back()];
    waiting.pop_back();
    if (node.kind == FormulaKind::Atom) return true;
    if (is_leaf(node.kind) || is_temporal(node.kind)) continue;
    waiting.push_back(node.left);
    if (!is_unary(node.kind)) waiting.push_back(node.right);
  }
  return false;
}

bool BodyReader::read_condition() {
  const auto phrase = read_formula(in_);
  if (!phrase) return false;
  if (in_.accept_word("leadsto")) return read_answer(*phrase);
  for (const std::string_view word :
       {"before", "precedes", "requires", "forbids"}) {
    if (in_.accept_word(word)) return read_precedence(*phrase, word);
  }
  const bool has_scope_here =
      in_.at_word("after") || in_.at_word("between") || in_.at_word("globally");
  if (has_scope_here || tail_.has_scope) {
    const SourceSpan span = has_scope_here ? in_.here() : tail_.scope_span;
    return in_.error("BT1222", span, "a scope belongs to a pattern", "of what?",
                     fmt::format("write `always {}`, or `present`, `absent`, "
                                 "and the scope",
                                 in_.text(*phrase)));
  }
  if (!in_.is_warned_of_reach &&
      looks_at_first_state(in_.formulas(), phrase->id)) {
    in_.conditions_alone.push_back(*phrase);
  }
  return claim_formula(phrase->id);
}

// What follows `leadsto` or `then`.
bool BodyReader::read_answer(const Phrase& trigger) {
  if (in_.at_keyword("first") && in_.starts_operand(1)) {
    in_.take();
    tail_.asks_for_first = true;
  }
  const auto answer = read_formula(in_);
  return answer && read_tail(in_, tail_) &&
         claim(Pattern::Response, trigger, *answer, tail_);
}

// P before Q, P precedes Q: no Q without a P before it; P requires Q is the
// same the other way round.
bool BodyReader::read_precedence(const Phrase& left, std::string_view word) {
  const auto right = read_formula(in_);
  if (!right || !read_tail(in_, tail_)) return false;
  if (word == "forbids") return claim(Pattern::Exclusion, left, *right, tail_);
  if (word == "requires") {
    return claim(Pattern::Precedence, *right, left, tail_);
  }
  return claim(Pattern::Precedence, left, *right, tail_);
}

// The pattern in its scope, or with its time.
bool BodyReader::claim(Pattern pattern, const Phrase& p, const Phrase& q,
                       const Tail& tail) {
  if (tail.timing) {
    return claim_timed(in_, property_, pattern, p, q, tail);
  }
  if (tail.asks_for_first) {
    return in_.unexpected("`first` asks for a time", "expected `within`",
                          "write `within 2 ticks`, or leave `first` out");
  }
  FormulaPool& pool = in_.formulas();
  const bool is_global = tail.scope.kind == ScopeKind::Globally;
  const bool is_plain = p.temporal == kNoToken && is_global;
  if (is_plain && pattern == Pattern::Absence) {
    property_.form = PropertyForm::Never;
    property_.formula = p.id;
    return true;
  }
  if (is_plain && pattern == Pattern::Universality) {
    property_.form = PropertyForm::Invariant;
    property_.formula = p.id;
    return true;
  }
  // Events of steps may stand here, `never enter P`; formulas may not, as
  // `[] not F` says it better.
  if (pattern == Pattern::Absence && !pool.is_state_formula(p.id)) {
    return require_state_predicate(in_, p, "`never`",
                                   "write the property as LTL: `ltl ...`");
  }
  property_.scope_ends = {tail.scope.opening, tail.scope.closing};
  return claim_formula(pattern_formula(pool, pattern, p.id, q.id, tail.scope));
}

bool BodyReader::claim_formula(FormulaId formula) {
  property_.form = in_.formulas().is_branching(formula)
                       ? PropertyForm::Branching
                       : PropertyForm::Ltl;
  property_.formula = formula;
  return true;
}

bool BodyReader::refuse_tail(const Tail& tail, std::string_view word) {
  if (tail.has_scope) {
    return in_.error("BT1222", tail.scope_span,
                     fmt::format("`{}` takes no scope", word), {},
                     "scopes go with never, always, present, leadsto, "
                     "precedes, requires and forbids");
  }
  if (!tail.timing) return true;
  return in_.error("BT1222", tail.timing->span,
                   fmt::format("`{}` takes no time", word), {},
                   "a time goes behind `P leadsto Q`, `whenever P then Q`, "
                   "`present P` or `absent P`");
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

// Branching time has no E and A apart from X F G U W R.
bool require_ctl(PropertyParser& in, const Property& property,
                 SourceSpan span) {
  if (property.form != PropertyForm::Branching ||
      !first_non_ctl(in.formulas(), property.formula)) {
    return true;
  }
  return in.error("BT1223", span, "branching and linear time are mixed",
                  "each X, F, G, U, W, R needs an A or E in front of it",
                  "write for instance `AG EF P` or `A [P U Q]`");
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
  in.is_warned_of_reach = false;
  in.take_used_atoms();
  if (!BodyReader(in, property).read()) return false;
  property.text = in.text(first, in.position());
  warn_of_next(in);
  return require_end(in) && require_few_atoms(in, property) &&
         require_ctl(in, property, in.span(first, in.position()));
}

bool require_state_predicate(PropertyParser& in, const Phrase& phrase,
                             std::string_view who, std::string_view help) {
  if (phrase.temporal == kNoToken) return true;
  const Token& token = in.token(phrase.temporal);
  return in.error("BT1214", token.span,
                  fmt::format("{} takes a condition on single states", who),
                  fmt::format("`{}` speaks of more than one state", token.text),
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
  if (in.at_word("causes")) {
    return in.unexpected("`causes` is no pattern", {}, "write `P leadsto Q`");
  }
  if (in.at_word("implies")) {
    return in.unexpected("`implies` is no operator", {}, "write `=>`");
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

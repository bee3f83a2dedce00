// SPDX-License-Identifier: MIT
//
// What a property claims: its words and patterns, turned into one of the forms.
//
// Most words are abbreviations of LTL (ltl/formula/pattern.hpp has the patterns
// with their scopes). never, always and possible are forms of their own when
// their condition speaks of single states, because a search of the reachable
// states then answers them without an automaton. A time turns a pattern into
// the timed form. A body's word takes everything up to the body's end:
// `always P => Q` is `always (P => Q)`, unlike `[] P => Q`; a warning says so.
//
// selt's library names a pattern and its scope in one word, with the operands
// behind it, first those of the pattern, then those of the scope:
// `absentAfter P Q` is `absent P after Q`. Each operand is an atom, or stands
// in parentheses; `absentAfter (P, Q)` is read too.
#include <fmt/format.h>

#include <array>
#include <initializer_list>
#include <span>
#include <utility>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

// `absentAfter`: a pattern and its scope in one word.
struct Macro {
  Pattern pattern = Pattern::Absence;
  std::size_t operands = 1;  // of the pattern; those of the scope follow
  ScopeKind scope = ScopeKind::Before;
};

constexpr std::pair<std::string_view, Macro> kMacroPatterns[] = {
    {"absent", {Pattern::Absence, 1}},
    {"always", {Pattern::Universality, 1}},
    {"present", {Pattern::Existence, 1}},
    {"leadsto", {Pattern::Response, 2}},
    {"precedes", {Pattern::Precedence, 2}}};

constexpr std::pair<std::string_view, ScopeKind> kMacroScopes[] = {
    {"before", ScopeKind::Before},
    {"after", ScopeKind::After},
    {"between", ScopeKind::Between},
    {"until", ScopeKind::AfterUntil},
    {"afterUntil", ScopeKind::AfterUntil}};

std::optional<Macro> macro_here(const PropertyParser& in) {
  if (!in.at(TokenKind::Identifier) || in.continues_name() ||
      !in.starts_operand(1)) {
    return std::nullopt;
  }
  const std::string_view word = in.peek().text;
  for (auto [pattern_word, macro] : kMacroPatterns) {
    const std::size_t length = pattern_word.size();
    if (!equal_ignoring_case(word.substr(0, length), pattern_word)) continue;
    for (const auto& [scope_word, scope] : kMacroScopes) {
      if (!equal_ignoring_case(word.substr(length), scope_word)) continue;
      macro.scope = scope;
      return macro;
    }
  }
  return std::nullopt;
}

// `(P, Q)`: a comma stands in the parenthesis that opens here.
bool at_list(const PropertyParser& in) {
  if (!in.at(TokenKind::LeftParen)) return false;
  std::size_t depth = 0;
  for (std::size_t ahead = 0;; ++ahead) {
    const TokenKind kind = in.peek(ahead).kind;
    if (kind == TokenKind::End) return false;
    if (kind == TokenKind::Comma && depth == 1) return true;
    depth += kind == TokenKind::LeftParen;
    depth -= kind == TokenKind::RightParen;
    if (depth == 0) return false;
  }
}

// The operands of a macro, as many as `operands` has.
bool read_operands(PropertyParser& in, const Token& word,
                   std::span<Phrase> operands) {
  const bool is_list = at_list(in);
  if (is_list) in.take();
  for (std::size_t i = 0; i < operands.size(); ++i) {
    if (is_list && i > 0 && !in.accept(TokenKind::Comma)) {
      return in.unexpected("a condition is missing", "expected `,`");
    }
    if (!in.starts_operand()) {
      return in.unexpected(
          fmt::format("`{}` takes {} conditions", word.text, operands.size()),
          fmt::format("expected condition {}", i + 1));
    }
    const auto phrase = is_list ? read_formula(in) : read_single_operand(in);
    if (!phrase ||
        !require_state_predicate(in, *phrase, fmt::format("`{}`", word.text),
                                 "write the property as LTL")) {
      return false;
    }
    operands[i] = *phrase;
  }
  return !is_list || in.accept(TokenKind::RightParen) ||
         in.unexpected("this list is never closed", "expected `)`");
}

// An atom has no temporal operator above it.
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

class BodyReader {
 public:
  BodyReader(PropertyParser& in, Property& property)
      : in_(in), property_(property) {}

  bool read() {
    if (!read_leading_scope(in_, tail_)) return false;
    if (const auto ticks = read_tick_words(in_)) return read_ticks(*ticks);
    if (in_.accept_keyword("whenever")) return read_whenever();
    if (in_.accept_keyword("never") || in_.accept_keyword("absent")) {
      return read_pattern(Pattern::Absence);
    }
    if (in_.accept_keyword("possible")) return read_possible();
    if (in_.accept_keyword("always")) return read_always();
    if (in_.accept_keyword("eventually")) return read_eventually();
    if (in_.accept_keyword("present")) {
      accept_first();
      return read_pattern(Pattern::Existence);
    }
    if (in_.accept_keyword("infinitelyOften")) {
      return read_prefixed("infinitelyOften",
                           {FormulaKind::Eventually, FormulaKind::Always});
    }
    if (in_.accept_keyword("mortal")) {
      return read_prefixed("mortal", {FormulaKind::Not, FormulaKind::Always,
                                      FormulaKind::Eventually});
    }
    if (in_.accept_keyword("deadlockfree")) {
      property_.form = PropertyForm::DeadlockFree;
      return read_tail(in_, tail_) && refuse_tail("deadlockfree");
    }
    if (in_.accept_keyword("live")) return read_live();
    if (in_.accept_keyword("ltl")) return read_prefixed("ltl", {});
    if (const auto macro = macro_here(in_)) return read_macro(*macro);
    return read_condition();
  }

 private:
  // Unary operators from the operand outwards: {Always, Eventually} is <> [].
  using Operators = std::initializer_list<FormulaKind>;

  // never P, always P, present P
  bool read_pattern(Pattern pattern) {
    const auto phrase = read_formula(in_);
    return phrase && read_tail(in_, tail_) && claim(pattern, *phrase, *phrase);
  }

  // P alone, behind a word that takes neither a scope nor a time.
  std::optional<Phrase> read_without_tail(std::string_view word) {
    const auto phrase = read_formula(in_);
    if (!phrase || !read_tail(in_, tail_) || !refuse_tail(word)) {
      return std::nullopt;
    }
    return phrase;
  }

  // An abbreviation: P below some operators.
  bool read_prefixed(std::string_view word, Operators operators) {
    const auto phrase = read_without_tail(word);
    return phrase && claim_prefixed(*phrase, operators);
  }

  bool read_possible() {
    const auto phrase = read_without_tail("possible");
    if (!phrase) return false;
    property_.form = PropertyForm::Possible;
    property_.formula = phrase->id;
    return require_state_predicate(in_, *phrase, "`possible`",
                                   "branching time may be what you mean: "
                                   "`EF (P and EF Q)`");
  }

  bool read_live() {
    const auto phrase = read_without_tail("live");
    return phrase &&
           require_state_predicate(in_, *phrase, "`live`",
                                   "write it out: `AG EF ...`") &&
           claim_prefixed(*phrase,
                          {FormulaKind::Eventually, FormulaKind::ExistsPath,
                           FormulaKind::Always, FormulaKind::ForAllPaths});
  }

  // every tick: P, in no tick: P, in some tick: P
  bool read_ticks(TickWords ticks) {
    const SourceSpan word = in_.token(in_.position() - 1).span;
    if (!in_.accept(TokenKind::Colon)) {
      return in_.unexpected("a rule about ticks is missing", "expected `:`",
                            "write `every tick: P` or `in no tick: P`");
    }
    auto phrase = read_formula(in_);
    if (!phrase || !read_tail(in_, tail_)) return false;
    phrase->id = at_tick_ends(in_, ticks, word, phrase->id);
    if (ticks != TickWords::Some) {
      return claim(
          ticks == TickWords::No ? Pattern::Absence : Pattern::Universality,
          *phrase, *phrase);
    }
    property_.form = PropertyForm::Possible;
    property_.formula = phrase->id;
    return refuse_tail("in some tick") &&
           require_state_predicate(in_, *phrase, "`in some tick`",
                                   "branching time may be what you mean: "
                                   "`EF (P and EF Q)`");
  }

  bool read_always() {
    const bool is_recurrence = in_.accept_keyword("eventually");
    const auto phrase = read_formula(in_);
    if (!phrase || !read_tail(in_, tail_)) return false;
    warn_of_reach(is_recurrence ? "always eventually" : "always", *phrase);
    if (!is_recurrence) return claim(Pattern::Universality, *phrase, *phrase);
    return refuse_tail("always eventually") &&
           claim_prefixed(*phrase,
                          {FormulaKind::Eventually, FormulaKind::Always});
  }

  bool read_eventually() {
    if (!in_.accept_keyword("always")) return read_pattern(Pattern::Existence);
    return read_prefixed("eventually always",
                         {FormulaKind::Always, FormulaKind::Eventually});
  }

  bool read_whenever() {
    const auto trigger = read_formula(in_);
    if (!trigger) return false;
    if (in_.accept_word("then")) return read_answer(*trigger);
    if (!in_.infix_here() && !in_.at_item_end()) return refuse_leftover(in_);
    return in_.unexpected("`whenever` has no `then`", "expected `then` here",
                          "write `whenever P then Q`");
  }

  // absentAfter P Q: the pattern, then the ends of its scope.
  bool read_macro(const Macro& macro) {
    const bool opens = macro.scope != ScopeKind::Before;
    const bool closes = macro.scope != ScopeKind::After;
    const Token& word = in_.take();
    std::array<Phrase, 4> all;
    const std::size_t count = macro.operands + opens + closes;
    if (!read_operands(in_, word, std::span(all).first(count))) return false;
    tail_.has_scope = true;
    tail_.scope.kind = macro.scope;
    if (opens) tail_.scope.opening = all[macro.operands].id;
    if (closes) tail_.scope.closing = all[count - 1].id;
    return claim(macro.pattern, all[0], all[macro.operands - 1]);
  }

  // A formula, P leadsto Q, P before Q.
  bool read_condition() {
    const auto phrase = read_formula(in_);
    if (!phrase) return false;
    if (in_.accept_word("leadsto")) return read_answer(*phrase);
    // No Q without a P before it; `requires` is the same the other way round.
    if (in_.accept_word("before") || in_.accept_word("precedes")) {
      return read_second(Pattern::Precedence, *phrase, false);
    }
    if (in_.accept_word("requires")) {
      return read_second(Pattern::Precedence, *phrase, true);
    }
    if (in_.accept_word("forbids")) {
      return read_second(Pattern::Exclusion, *phrase, false);
    }
    return read_plain_formula(*phrase);
  }

  bool read_plain_formula(const Phrase& phrase) {
    const bool has_scope_here = in_.at_word("after") ||
                                in_.at_word("between") ||
                                in_.at_word("globally");
    if (has_scope_here || tail_.has_scope) {
      return in_.error("BT1222", has_scope_here ? in_.here() : tail_.scope_span,
                       "a scope belongs to a pattern", "of what?",
                       fmt::format("write `always {}`, or `present`, `absent`, "
                                   "and the scope",
                                   in_.text(phrase)));
    }
    if (!in_.is_warned_of_reach &&
        looks_at_first_state(in_.formulas(), phrase.id)) {
      in_.conditions_alone.push_back(phrase);
    }
    return claim_prefixed(phrase, {});
  }

  // What follows `leadsto` or `then`.
  bool read_answer(const Phrase& trigger) {
    accept_first();
    return read_second(Pattern::Response, trigger, false);
  }

  void accept_first() {
    if (!in_.at_keyword("first") || !in_.starts_operand(1)) return;
    in_.take();
    tail_.asks_for_first = true;
  }

  // The right side of a pattern over two conditions.
  bool read_second(Pattern pattern, const Phrase& left, bool is_swapped) {
    const auto right = read_formula(in_);
    if (!right || !read_tail(in_, tail_)) return false;
    return is_swapped ? claim(pattern, *right, left)
                      : claim(pattern, left, *right);
  }

  // The pattern in its scope, or with its time.
  bool claim(Pattern pattern, const Phrase& p, const Phrase& q) {
    if (tail_.timing) {
      property_.form = PropertyForm::Timed;
      return claim_timed(in_, property_.timed, pattern, p, q, tail_);
    }
    if (tail_.asks_for_first) {
      return in_.unexpected("`first` asks for a time", "expected `within`",
                            "write `within 2 ticks`, or leave `first` out");
    }
    const bool is_plain =
        p.temporal == kNoToken && tail_.scope.kind == ScopeKind::Globally &&
        (pattern == Pattern::Absence || pattern == Pattern::Universality);
    if (is_plain) {
      property_.form = pattern == Pattern::Absence ? PropertyForm::Never
                                                   : PropertyForm::Invariant;
      property_.formula = p.id;
      return true;
    }
    FormulaPool& pool = in_.formulas();
    // Events of steps may stand here, `never enter P`; formulas may not, as
    // `[] not F` says it better.
    if (pattern == Pattern::Absence && !pool.is_state_formula(p.id)) {
      return require_state_predicate(in_, p, "`never`",
                                     "write the property as LTL: `ltl ...`");
    }
    property_.scope_ends = {tail_.scope.opening, tail_.scope.closing};
    return claim_formula(
        pattern_formula(pool, pattern, p.id, q.id, tail_.scope));
  }

  bool claim_prefixed(const Phrase& phrase, Operators operators) {
    FormulaId formula = phrase.id;
    for (const FormulaKind kind : operators) {
      formula = in_.formulas().unary(kind, formula);
    }
    return claim_formula(formula);
  }

  bool claim_formula(FormulaId formula) {
    property_.form = in_.formulas().is_branching(formula)
                         ? PropertyForm::Branching
                         : PropertyForm::Ltl;
    property_.formula = formula;
    return true;
  }

  bool refuse_tail(std::string_view word) {
    if (tail_.has_scope) {
      return in_.error("BT1222", tail_.scope_span,
                       fmt::format("`{}` takes no scope", word), {},
                       "scopes go with never, always, present, leadsto, "
                       "precedes, requires and forbids");
    }
    if (!tail_.timing) return true;
    return in_.error("BT1222", tail_.timing->span,
                     fmt::format("`{}` takes no time", word), {},
                     "a time goes behind `P leadsto Q`, `whenever P then Q`, "
                     "`present P` or `absent P`");
  }

  // `always P => Q` does not mean what `[] P => Q` does.
  void warn_of_reach(std::string_view word, const Phrase& phrase) {
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

  PropertyParser& in_;
  Property& property_;
  Tail tail_;  // begins with the scope in front, if there is one
};

bool require_few_atoms(PropertyParser& in, const Property& property) {
  const std::size_t count = in.used_atoms.size();
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
          "any node may take that step",
          "name the event that is waited for, as in `P leadsto Q`");
}

}  // namespace

bool read_body(PropertyParser& in, Property& property) {
  const std::size_t first = in.position();
  in.first_next = kNoToken;
  in.is_warned_of_reach = false;
  in.used_atoms.clear();
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

namespace {

// Words that join, and what takes them where they stand in vain.
constexpr std::pair<std::string_view, std::string_view> kTakenBy[] = {
    {"then",
     "it belongs to `whenever P then Q`; that some run comes to Q after P is "
     "`EF (P and EF Q)`"},
    {"leadsto", "`P leadsto Q` stands alone, without a word in front"},
    {"precedes", "`P precedes Q` stands alone, without a word in front"},
    {"requires", "`P requires Q` stands alone, without a word in front"},
    {"forbids", "`P forbids Q` stands alone, without a word in front"},
    {"before",
     "`P before Q` stands alone, without a word in front; `never P before R` "
     "is a pattern with its scope"},
    {"after", "scopes go with never, always, present, leadsto, precedes"},
    {"between", "scopes go with never, always, present, leadsto, precedes"},
    {"globally", "scopes go with never, always, present, leadsto, precedes"},
    {"for", "a time goes behind `always P` or `absent P`"},
    {"lasting", "a time goes behind `present P`"},
    {"in", "it compares a variable with a range of numbers"},
    {"and", ""},
    {"or", ""},
    {"until", ""},
    {"release", ""},
    {"within", ""}};

// Who takes the word, or which word was meant.
std::string help_for_leftover(const Token& token) {
  const std::string otherwise = "conditions are joined with `and`, `or`, `=>`";
  if (token.kind != TokenKind::Identifier) return otherwise;
  std::vector<std::string> words;
  for (const auto& [word, taken_by] : kTakenBy) {
    if (equal_ignoring_case(token.text, word) && !taken_by.empty()) {
      return std::string(taken_by);
    }
    words.emplace_back(word);
  }
  return did_you_mean(token.text, words, otherwise);
}

}  // namespace

Refused refuse_leftover(PropertyParser& in) {
  const Token& token = in.peek();
  if (token.kind == TokenKind::RightParen) {
    return in.unexpected("this `)` closes nothing", "no `(` before it");
  }
  if (in.at_symbol(FormulaKind::Eventually)) {
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
  return in.unexpected(
      fmt::format("`{}` cannot follow a complete condition", token.text),
      "expected an operator or the end of the property",
      help_for_leftover(token));
}

bool require_end(PropertyParser& in) {
  return in.at_item_end() || refuse_leftover(in);
}

}  // namespace btcheck

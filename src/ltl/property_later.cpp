// SPDX-License-Identifier: MIT
//
// Forms that this release knows by name only.
//
// Each is recognised where its first word stands, so that nobody takes it for a
// spelling mistake, and refused with what to write instead when LTL or a form
// of this release says the same. The formulas are those of Dwyer, Avrunin and
// Corbett's pattern catalogue. A release that learns a form deletes its row.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ltl/property_parser.hpp"

namespace btcheck {
namespace {

struct Row {
  std::string_view word;
  std::string_view help;
};

template <std::size_t N>
const Row* find(const std::array<Row, N>& rows, std::string_view word) {
  const auto found = std::find_if(
      rows.begin(), rows.end(),
      [&](const Row& row) { return equal_ignoring_case(row.word, word); });
  return found == rows.end() ? nullptr : &*found;
}

// Path quantifiers, written in capitals only: `af` is a name.
constexpr auto kBranching = std::to_array<Row>({
    {"AG", "for a condition P on single states, write `always P`"},
    {"EF", "for a condition P on single states, write `possible P`"},
    {"AF", "for a condition P on single states, write `eventually P`"},
    {"EG", ""},
    {"AX", ""},
    {"EX", ""},
    {"AU", ""},
    {"EU", ""},
});

constexpr auto kOperands = std::to_array<Row>({
    {"enter", "name the state that is entered: `drone/5/state done`"},
    {"leave", "name the state that is left: `drone/5/state done`"},
    {"live", "`possible P` asks for one run that reaches P from the start"},
});

constexpr auto kPatterns = std::to_array<Row>({
    {"before", "the same in LTL: `(not Q) W P` for `P before Q`"},
    {"precedes", "the same in LTL: `(not Q) W P` for `P precedes Q`"},
    {"requires", "the same in LTL: `(not P) W Q` for `P requires Q`"},
    {"forbids", "the same in LTL: `[] (P => [] not Q)` for `P forbids Q`"},
    {"causes", "write `P leadsto Q`"},
});

// Scopes of a pattern: `absent P after Q` and so on, in LTL.
constexpr auto kScopes = std::to_array<Row>({
    {"absent before", "`<> R => ((not P) U R)`"},
    {"absent after", "`[] (Q => [] not P)`"},
    {"absent between", "`[] ((Q and not R and <> R) => ((not P) U R))`"},
    {"absent afterUntil", "`[] ((Q and not R) => ((not P) W R))`"},
    {"always before", "`<> R => (P U R)`"},
    {"always after", "`[] (Q => [] P)`"},
    {"always between", "`[] ((Q and not R and <> R) => (P U R))`"},
    {"always afterUntil", "`[] ((Q and not R) => (P W R))`"},
    {"present before", "`(not R) W (P and not R)`"},
    {"present after", "`[] not Q or <> (Q and <> P)`"},
    {"present between", "`[] ((Q and not R) => ((not R) W (P and not R)))`"},
    {"present afterUntil", "`[] ((Q and not R) => ((not R) U (P and not R)))`"},
    {"leadsto before", "`<> R => ((P => ((not R) U (S and not R))) U R)`"},
    {"leadsto after", "`[] (Q => [] (P => <> S))`"},
    {"leadsto between",
     "`[] ((Q and not R and <> R) => "
     "((P => ((not R) U (S and not R))) U R))`"},
    {"leadsto afterUntil",
     "`[] ((Q and not R) => ((P => ((not R) U (S and not R))) W R))`"},
    {"precedes before", "`<> R => ((not P) U (S or R))`"},
    {"precedes after", "`[] not Q or <> (Q and ((not P) W S))`"},
});

constexpr std::array<std::string_view, 9> kMacroScopes = {
    "before", "after", "between", "until", "afterUntil",
    "within", "first", "lasting", "for"};
constexpr std::array<std::string_view, 5> kMacros = {
    "absent", "always", "present", "leadsto", "precedes"};

// True when a time follows, which no LTL formula can express.
bool is_timed(const PropertyParser& in) {
  return in.item_mentions("within") || in.item_mentions("for") ||
         in.item_mentions("lasting");
}

std::string scope_help(const PropertyParser& in, std::string_view pattern,
                       std::string_view scope) {
  if (is_timed(in)) return {};
  if (equal_ignoring_case(scope, "after") && in.item_mentions("until")) {
    scope = "afterUntil";
  }
  if (pattern == "never") pattern = "absent";
  if (pattern == "eventually") pattern = "present";
  if (equal_ignoring_case(scope, "until")) scope = "afterUntil";
  const Row* row = find(kScopes, fmt::format("{} {}", pattern, scope));
  if (row == nullptr) return {};
  return fmt::format("the same in LTL: {}", row->help);
}

// absentAfter, leadstoBetween and their kind.
bool refuse_macro(PropertyParser& in) {
  const std::string_view word = in.peek().text;
  for (const std::string_view macro : kMacros) {
    if (word.size() <= macro.size() ||
        !equal_ignoring_case(word.substr(0, macro.size()), macro)) {
      continue;
    }
    const std::string_view scope = word.substr(macro.size());
    const bool is_scope = std::any_of(
        kMacroScopes.begin(), kMacroScopes.end(), [&](std::string_view known) {
          return equal_ignoring_case(known, scope);
        });
    if (!is_scope) continue;
    in.not_yet(in.here(), fmt::format("`{}`", word),
               scope_help(in, macro, scope));
    return true;
  }
  return false;
}

// A [p U q], E (p U q)
bool at_path_quantifier(const PropertyParser& in) {
  const TokenKind next = in.peek(1).kind;
  return (in.peek().text == "A" || in.peek().text == "E") &&
         (next == TokenKind::LeftBracket || next == TokenKind::LeftParen);
}

}  // namespace

bool refuse_later_body(PropertyParser& in) {
  if (!in.at(TokenKind::Word) || in.continues_name() || !in.starts_operand(1)) {
    return false;
  }
  if (in.at_word("globally")) {
    in.not_yet(in.here(), "the scope `globally`",
               "leave it out: every property is global");
    return true;
  }
  for (const std::string_view scope : {"before", "after", "between"}) {
    if (!in.at_word(scope)) continue;
    in.not_yet(in.here(), fmt::format("the scope `{}`", scope), {});
    return true;
  }
  return refuse_macro(in);
}

bool refuse_later_operand(PropertyParser& in) {
  if (!in.at(TokenKind::Word) || in.continues_name()) return false;
  const std::string_view word = in.peek().text;
  const Row* branching = find(kBranching, word);
  const bool is_branching =
      branching != nullptr && branching->word == word && in.starts_operand(1);
  if (is_branching || at_path_quantifier(in)) {
    const bool is_alone =
        is_branching && find(kBranching, in.peek(1).text) == nullptr;
    in.not_yet(in.here(), fmt::format("branching time (`{}`)", word),
               is_alone ? std::string(branching->help) : std::string());
    return true;
  }
  const Row* operand = find(kOperands, word);
  if (operand == nullptr || !in.starts_operand(1)) return false;
  in.not_yet(in.here(), fmt::format("`{}`", word), std::string(operand->help));
  return true;
}

bool refuse_later_suffix(PropertyParser& in, std::string_view pattern) {
  if (!in.at(TokenKind::Word)) return false;
  const std::string_view word = in.peek().text;
  const SourceSpan span = in.here();
  const std::string quoted = fmt::format("`{}`", word);
  if (pattern.empty()) {
    const Row* row = find(kPatterns, word);
    if (row == nullptr) return false;
    const bool has_help = row->word == "causes" || !is_timed(in);
    in.not_yet(span, quoted, has_help ? std::string(row->help) : std::string());
    return true;
  }
  if (in.at_word("before") || in.at_word("after") || in.at_word("between")) {
    in.not_yet(span, fmt::format("the scope {}", quoted),
               scope_help(in, pattern, word));
    return true;
  }
  if (in.at_word("globally")) {
    in.not_yet(span, "the scope `globally`",
               "leave it out: every property is global");
    return true;
  }
  if (in.at_word("within") || in.at_word("for") || in.at_word("lasting")) {
    in.not_yet(span, fmt::format("`{} ... {}`", pattern, word));
    return true;
  }
  return false;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Patterns by their macro names: `absentAfter P Q` is `absent P after Q`.
//
// selt's library has the pattern and its scope in one word and the operands
// behind it, first those of the pattern, then those of the scope. Each operand
// is an atom, or stands in parentheses; `absentAfter (P, Q)` is read too.
#include <fmt/format.h>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

struct PatternWord {
  std::string_view word;
  Pattern pattern;
  bool takes_two;
};
constexpr PatternWord kPatterns[] = {{"absent", Pattern::Absence, false},
                                     {"always", Pattern::Universality, false},
                                     {"present", Pattern::Existence, false},
                                     {"leadsto", Pattern::Response, true},
                                     {"precedes", Pattern::Precedence, true}};

struct ScopeWord {
  std::string_view word;
  ScopeKind scope;
};
constexpr ScopeWord kScopes[] = {{"before", ScopeKind::Before},
                                 {"after", ScopeKind::After},
                                 {"between", ScopeKind::Between},
                                 {"until", ScopeKind::AfterUntil},
                                 {"afterUntil", ScopeKind::AfterUntil}};

std::size_t operand_count(const Macro& macro) {
  const bool has_two_ends =
      macro.scope == ScopeKind::Between || macro.scope == ScopeKind::AfterUntil;
  return (macro.takes_two ? 2u : 1u) + (has_two_ends ? 2u : 1u);
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

}  // namespace

std::optional<Macro> at_macro(const PropertyParser& in) {
  const std::string_view word = in.peek().text;
  if (!in.at(TokenKind::Word) || in.continues_name() || !in.starts_operand(1)) {
    return std::nullopt;
  }
  for (const PatternWord& pattern : kPatterns) {
    if (word.size() <= pattern.word.size() ||
        !equal_ignoring_case(word.substr(0, pattern.word.size()),
                             pattern.word)) {
      continue;
    }
    for (const ScopeWord& scope : kScopes) {
      if (equal_ignoring_case(word.substr(pattern.word.size()), scope.word)) {
        return Macro{pattern.pattern, pattern.takes_two, scope.scope};
      }
    }
  }
  return std::nullopt;
}

bool read_macro_operands(PropertyParser& in, const Token& word,
                         const Macro& macro, std::span<Phrase> operands) {
  const bool is_list = at_list(in);
  if (is_list) in.take();
  const std::size_t count = operand_count(macro);
  for (std::size_t i = 0; i < count; ++i) {
    if (!in.starts_operand() || in.at_item()) {
      return in.unexpected(
          fmt::format("`{}` takes {} conditions", word.text, count),
          fmt::format("expected condition {}", i + 1));
    }
    const auto phrase = is_list ? read_formula(in) : read_single_operand(in);
    if (!phrase ||
        !require_state_predicate(in, *phrase, fmt::format("`{}`", word.text),
                                 "write the property as LTL")) {
      return false;
    }
    operands[i] = *phrase;
    const bool is_last = i + 1 == count;
    if (is_list && !is_last && !in.accept(TokenKind::Comma)) {
      return in.unexpected("a condition is missing", "expected `,`");
    }
  }
  return !is_list || in.accept(TokenKind::RightParen) ||
         in.unexpected("this list is never closed", "expected `)`");
}

}  // namespace btcheck

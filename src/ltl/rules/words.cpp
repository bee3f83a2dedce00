// SPDX-License-Identifier: MIT
//
// The vocabulary: one table per role a word or symbol can play.
//
// Words are compared without regard to case, except the single letters: G F X
// U W R V and T are operators and a constant, never names, while their small
// counterparts are ordinary names. No operator is ever a name; a word that
// opens or joins the forms of a body may be one where it goes on like one:
// `always.ticked` is an event of a node called always.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

struct WordOperator {
  std::string_view word;
  FormulaKind kind;
};

constexpr auto kPrefixWords = std::to_array<WordOperator>({
    {"not", FormulaKind::Not},
    {"G", FormulaKind::Always},
    {"F", FormulaKind::Eventually},
    {"X", FormulaKind::Next},
});

constexpr auto kInfixWords = std::to_array<WordOperator>({
    {"and", FormulaKind::And},
    {"or", FormulaKind::Or},
    {"until", FormulaKind::Until},
    {"release", FormulaKind::Release},
    {"U", FormulaKind::Until},
    {"W", FormulaKind::WeakUntil},
    {"R", FormulaKind::Release},
    {"V", FormulaKind::Release},
});

// Words that can only follow a complete condition, besides the operators.
constexpr auto kJoiningWords = std::to_array<std::string_view>(
    {"leadsto", "then", "within", "before", "after", "between", "precedes",
     "requires", "forbids", "causes", "for", "lasting", "globally"});

// Words that open a body, an item, or a line of a file.
constexpr auto kOtherWords = std::to_array<std::string_view>(
    {"never",      "absent",   "always",       "possible",
     "eventually", "present",  "deadlockfree", "infinitelyOften",
     "mortal",     "live",     "enter",        "leave",
     "ltl",        "whenever", "true",         "false",
     "in",         "property", "prove",        "assert",
     "let",        "expect",   "tree",         "assume",
     "is",         "tick",     "dead",         "stuck",
     "root",       "T"});

bool means(std::string_view text, std::string_view word) {
  return word.size() == 1 ? text == word : equal_ignoring_case(text, word);
}

template <std::size_t N>
std::optional<FormulaKind> find(const std::array<WordOperator, N>& table,
                                std::string_view text) {
  const auto found = std::find_if(
      table.begin(), table.end(),
      [&](const WordOperator& entry) { return means(text, entry.word); });
  if (found == table.end()) return std::nullopt;
  return found->kind;
}

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& table,
              std::string_view text) {
  return std::any_of(table.begin(), table.end(),
                     [&](std::string_view word) { return means(text, word); });
}

}  // namespace

std::optional<FormulaKind> prefix_here(const PropertyParser& in) {
  const Token& token = in.peek();
  switch (token.kind) {
    case TokenKind::Not:
    case TokenKind::Minus:
      return FormulaKind::Not;
    case TokenKind::Always:
      return FormulaKind::Always;
    case TokenKind::Eventually:
      return FormulaKind::Eventually;
    case TokenKind::Next:
      return FormulaKind::Next;
    case TokenKind::Word:
      return find(kPrefixWords, token.text);
    default:
      return std::nullopt;
  }
}

std::optional<PathPrefix> path_prefix_here(const PropertyParser& in) {
  const std::string_view text = in.peek().text;
  if (!in.at(TokenKind::Word) || text.size() != 2 || in.continues_name() ||
      !in.starts_operand(1) || (text[0] != 'A' && text[0] != 'E')) {
    return std::nullopt;
  }
  const auto kind = find(kPrefixWords, text.substr(1));
  if (!kind || *kind == FormulaKind::Not) return std::nullopt;
  return PathPrefix{
      text[0] == 'A' ? FormulaKind::ForAllPaths : FormulaKind::ExistsPath,
      *kind};
}

std::optional<FormulaKind> path_quantifier_here(const PropertyParser& in) {
  const std::string_view text = in.peek().text;
  const TokenKind next = in.peek(1).kind;
  if (!in.at(TokenKind::Word) || (text != "A" && text != "E") ||
      (next != TokenKind::LeftBracket && next != TokenKind::LeftParen)) {
    return std::nullopt;
  }
  return text == "A" ? FormulaKind::ForAllPaths : FormulaKind::ExistsPath;
}

std::optional<FormulaKind> infix_here(const PropertyParser& in,
                                      std::size_t ahead) {
  const Token& token = in.peek(ahead);
  switch (token.kind) {
    case TokenKind::And:
      return FormulaKind::And;
    case TokenKind::Or:
      return FormulaKind::Or;
    case TokenKind::Implies:
      return FormulaKind::Implies;
    case TokenKind::Equivalent:
      return FormulaKind::Equivalent;
    case TokenKind::Word:
      return find(kInfixWords, token.text);
    default:
      return std::nullopt;
  }
}

std::optional<Relation> relation_here(const PropertyParser& in,
                                      std::size_t ahead) {
  switch (in.peek(ahead).kind) {
    case TokenKind::Equal:
      return Relation::Equal;
    case TokenKind::NotEqual:
      return Relation::NotEqual;
    case TokenKind::Less:
      return Relation::Less;
    case TokenKind::LessEqual:
      return Relation::LessEqual;
    case TokenKind::Greater:
      return Relation::Greater;
    case TokenKind::GreaterEqual:
      return Relation::GreaterEqual;
    default:
      return std::nullopt;
  }
}

bool ends_operand(std::string_view word) {
  return find(kInfixWords, word).has_value() || contains(kJoiningWords, word);
}

bool is_reserved(std::string_view word) {
  return find(kPrefixWords, word).has_value() || ends_operand(word) ||
         contains(kOtherWords, word);
}

std::span<const std::string> opening_words() {
  static const std::vector<std::string> words = {
      "never",      "absent",   "always",       "possible",
      "eventually", "present",  "deadlockfree", "infinitelyOften",
      "mortal",     "whenever", "not",          "true",
      "false",      "stuck",    "dead",         "ltl",
      "tick",       "live",     "enter",        "leave"};
  return words;
}

std::span<const std::string> joining_words() {
  static const std::vector<std::string> words = {
      "and",      "or",      "until",    "release",  "leadsto", "then",
      "within",   "in",      "before",   "precedes", "after",   "between",
      "requires", "forbids", "globally", "for",      "lasting"};
  return words;
}

std::optional<std::string_view> entry_of(std::span<const std::string_view> list,
                                         std::string_view word) {
  const auto found = std::find_if(
      list.begin(), list.end(),
      [&](std::string_view entry) { return equal_ignoring_case(word, entry); });
  if (found == list.end()) return std::nullopt;
  return *found;
}

std::string suggestion(std::string_view word,
                       std::span<const std::string> candidates,
                       std::string otherwise) {
  const auto nearest = closest_match(word, candidates);
  return nearest ? fmt::format("did you mean `{}`?", *nearest)
                 : std::move(otherwise);
}

}  // namespace btcheck

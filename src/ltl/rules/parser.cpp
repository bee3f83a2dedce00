// SPDX-License-Identifier: MIT
//
// Looking ahead, skipping, quoting, reporting, numbering atoms. Of the grammar,
// only two questions are answered here: does a word at this place go on as a
// name (`always.ticked` is a node called always), and does a new item begin
// here (recovery stops there).
#include "ltl/rules/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace btcheck {
namespace {

bool is_item_word(std::string_view word) {
  constexpr std::string_view kItems[] = {"property", "prove", "assert", "let",
                                         "expect",   "tree",  "assume"};
  return std::ranges::any_of(kItems, [&](std::string_view item) {
    return equal_ignoring_case(word, item);
  });
}

std::string key_of(Decimal number) {
  return fmt::format("{}e-{}", number.digits, number.decimals);
}

// What makes two atoms the same, whatever their places in the text.
std::string key_of(const Operand& operand) {
  std::string key = fmt::format(
      "{}\1{}\1{}\1{}\1{}", operand.is_number, key_of(operand.number),
      operand.node, operand.name, static_cast<int>(operand.calculation));
  for (const Operand& part : operand.parts) key += "\2" + key_of(part);
  return key;
}

std::string key_of(const Atom& atom) {
  return fmt::format("{}\1{}\1{}\1{}\1{}\1{}\1{}\1{}\1{}\1{}\1{}\1{}",
                     static_cast<int>(atom.kind), atom.node, atom.word,
                     atom.component, atom.process.value_or(-1),
                     static_cast<int>(atom.relation), key_of(atom.left),
                     key_of(atom.right), key_of(atom.low), key_of(atom.high),
                     index(atom.of), index(atom.since));
}

}  // namespace

PropertyParser::PropertyParser(const SourceText& source, TokenList tokens,
                               PropertyFile& file)
    : source_(source),
      tokens_(std::move(tokens.tokens)),
      titles_(std::move(tokens.titles)),
      findings_(std::move(tokens.findings)),
      file_(file),
      errors_(findings_.size()) {
  assert(!tokens_.empty() && tokens_.back().kind == TokenKind::End);
  for (std::size_t i = 0; i + 1 < tokens_.size(); ++i) {
    const bool is_let = tokens_[i].kind == TokenKind::Identifier &&
                        equal_ignoring_case(tokens_[i].text, "let") &&
                        tokens_[i + 1].is_name();
    if (!is_let) continue;
    announced.try_emplace(std::string(tokens_[i + 1].text),
                          tokens_[i].span.line);
  }
}

bool PropertyParser::continues_name(std::size_t ahead) const {
  const TokenKind next = peek(ahead + 1).kind;
  return next == TokenKind::Dot || next == TokenKind::Slash ||
         next == TokenKind::At || next == TokenKind::Relation ||
         (at_word("in", ahead + 1) && !at_ticks(*this, ahead + 1));
}

bool PropertyParser::starts_operand(std::size_t ahead) const {
  switch (peek(ahead).kind) {
    case TokenKind::LeftParen:
    case TokenKind::Minus:
    case TokenKind::Number:
    case TokenKind::Quoted:
      return true;
    case TokenKind::Operator:
      return is_unary(peek(ahead).operation);
    case TokenKind::Identifier:
      return !infix_here(ahead) && !at_item(ahead) &&
             (continues_name(ahead) || !ends_operand(peek(ahead).text));
    default:
      return false;
  }
}

std::optional<FormulaKind> PropertyParser::infix_here(std::size_t ahead) const {
  const FormulaKind operation = peek(ahead).operation;
  if (is_leaf(operation) || is_unary(operation)) return std::nullopt;
  return operation;
}

bool PropertyParser::at_item(std::size_t ahead) const {
  const Token& token = peek(ahead);
  if (token.kind != TokenKind::Identifier || continues_name(ahead)) {
    return false;
  }
  if (is_item_word(token.text)) return true;
  // `tick nodes`, not the condition tick: no word but an operator follows that.
  const Token& next = peek(ahead + 1);
  return at_word("tick", ahead) && next.kind == TokenKind::Identifier &&
         !next.is_first_on_line && !ends_operand(next.text) &&
         !is_item_word(next.text) && !at_word("tick", ahead + 1);
}

SourceSpan PropertyParser::span(std::size_t first, std::size_t end) const {
  assert(first < end && end <= tokens_.size());
  const Token& left = tokens_[first];
  const Token& right = tokens_[end - 1];
  if (left.span.line != right.span.line) {
    return source_.span(left.begin, right.end);
  }
  return {left.span.line, left.span.column,
          right.span.column + right.span.length - left.span.column};
}

std::string PropertyParser::text(std::size_t first, std::size_t end,
                                 std::size_t limit) const {
  std::string result;
  for (std::size_t i = first; i < end; ++i) {
    const Token& token = tokens_[i];
    const bool has_gap = i > first && tokens_[i - 1].end < token.begin;
    if (has_gap) result += ' ';
    result += source_.text().substr(token.begin, token.end - token.begin);
    if (limit != kNoToken && result.size() > limit) {
      return result.substr(0, result.rfind(' ', limit)) + " ...";
    }
  }
  return result;
}

std::string PropertyParser::title_above(int line) const {
  std::string title;
  auto at = std::ranges::lower_bound(titles_, line, {}, &TitleLine::line);
  while (at != titles_.begin() && std::prev(at)->line == line - 1) {
    --at;
    --line;
    title = std::string(at->text) + (title.empty() ? "" : " ") + title;
  }
  return title;
}

Refused PropertyParser::add(Severity severity, std::string_view code,
                            SourceSpan span, std::string message,
                            std::string label, std::string help) {
  std::size_t& count = severity == Severity::Error ? errors_ : warnings_;
  if (count++ < kMostFindings) {
    findings_.push_back(source_.diagnostic(severity, code, span,
                                           std::move(message), std::move(label),
                                           std::move(help)));
  }
  return {};
}

Refused PropertyParser::unexpected(std::string message, std::string label,
                                   std::string help) {
  if (at(TokenKind::Unknown)) return {};
  SourceSpan span = here();
  // What is missing at the end of an item is missing behind its last token.
  if (at_ > 0 && (at_end() || (peek().is_first_on_line && at_item()))) {
    const SourceSpan last = tokens_[at_ - 1].span;
    span = {last.line, last.column + last.length, 1};
  }
  return error("BT1201", span, std::move(message), std::move(label),
               std::move(help));
}

std::vector<Diagnostic> PropertyParser::take_findings() {
  sort_by_place(findings_);
  return std::move(findings_);
}

std::uint32_t PropertyParser::number_of(Atom atom) {
  const auto next = static_cast<std::uint32_t>(file_.atoms.size());
  const auto [entry, is_new] = atom_numbers_.try_emplace(key_of(atom), next);
  if (is_new) file_.atoms.push_back(std::move(atom));
  return entry->second;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Lines are the author's: what `##` stands above, and where a list of tags
// ends, hangs on them. An item that begins a line has no indentation, the line
// behind it four columns, and those that follow keep their distance to it.
#include "style/rules.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "ltl/rules/parser.hpp"
#include "text/utf8.hpp"

namespace btcheck::style {
namespace {

constexpr int kBodyIndent = 4;

std::size_t rule_comment(std::string_view text) {
  if (text.starts_with("/*")) {
    const std::size_t close = text.find("*/", 2);
    return close == text.npos ? text.size() : close + 2;
  }
  const bool begins =
      text.starts_with('#') || text.starts_with("//") || text.starts_with(';');
  return begins ? std::min(text.find('\n'), text.size()) : 0;
}

bool joins_two(const Token& token) {
  return token.kind == TokenKind::Relation ||
         (token.kind == TokenKind::Operator && !is_leaf(token.operation) &&
          !is_unary(token.operation));
}

class RulesWriter {
 public:
  explicit RulesWriter(const SourceText& source)
      : text_(source.text()),
        tokens_(tokenize(source)),
        parser_(source, tokens_, file_),
        lines_(text_) {}

  std::string write() {
    std::size_t at = 0;
    for (std::size_t i = 0; i < tokens_.tokens.size(); ++i) {
      const Token& token = tokens_.tokens[i];
      const bool is_end = token.kind == TokenKind::End;
      const std::size_t begin = is_end ? text_.size() : token.begin;
      const Gap gap = gap_in(text_, {at, begin}, rule_comment);
      const bool is_item = parser_.at_item() || is_end;
      add_comments(gap, is_item);
      if (is_end) break;
      if (gap.breaks > 0 || lines_.is_empty()) {
        begin_line(is_item, begin, gap.breaks);
      } else if (!gap.comments.empty() ||
                 (i > 0 && is_apart(i, gap.is_blank))) {
        lines_.add(" ");
      }
      note_tags(i);
      lines_.add(text_.substr(token.begin, token.end - token.begin));
      at = token.end;
      parser_.take();
    }
    return lines_.take();
  }

 private:
  void add_comments(const Gap& gap, bool is_item) {
    for (const Comment& comment : gap.comments) {
      if (comment.breaks > 0 || lines_.is_empty()) {
        const auto begin =
            static_cast<std::size_t>(comment.text.data() - text_.data());
        begin_line(is_item, begin, comment.breaks);
        lines_.add(comment.text);
      } else {
        add_behind(lines_, comment);
      }
    }
  }

  void begin_line(bool is_item, std::size_t at, int breaks) {
    if (is_item) {
      moved_by_.reset();
      return lines_.begin(0, breaks);
    }
    const int column = column_at(text_, at).value_or(kBodyIndent);
    if (!moved_by_) moved_by_ = kBodyIndent - column;
    lines_.begin(std::max(kBodyIndent, column + *moved_by_), breaks);
  }

  // `property NAME [`: what is in the brackets stays as it is.
  void note_tags(std::size_t i) {
    const auto& tokens = tokens_.tokens;
    if (in_tags_) {
      in_tags_ = tokens[i].kind != TokenKind::RightBracket;
    } else if (i > 1 && tokens[i].kind == TokenKind::LeftBracket) {
      in_tags_ = equal_ignoring_case(tokens[i - 2].text, "property");
    }
  }

  // Whether there is a blank before a word in its line.
  bool is_apart(std::size_t i, bool is_blank) const {
    const Token& before = tokens_.tokens[i - 1];
    const Token& token = tokens_.tokens[i];
    if (in_tags_) return is_blank;
    const bool is_opened = before.kind == TokenKind::LeftParen ||
                           before.kind == TokenKind::LeftBracket;
    const bool is_closed = token.kind == TokenKind::RightParen ||
                           token.kind == TokenKind::RightBracket ||
                           token.kind == TokenKind::Comma;
    // Together two of them would be another sign, `[]`.
    if (is_opened || is_closed) return is_opened && is_closed && is_blank;
    return is_blank || joins_two(before) || joins_two(token);
  }

  std::string_view text_;
  TokenList tokens_;
  PropertyFile file_;
  PropertyParser parser_;  // tells where items begin
  Lines lines_;
  std::optional<int> moved_by_;  // the lines of this item
  bool in_tags_ = false;
};

}  // namespace

std::string styled_rules(const SourceText& source) {
  return RulesWriter(source).write();
}

std::vector<std::string> words_of_rules(const SourceText& source) {
  const TokenList read = tokenize(source);
  const std::string_view text = source.text();
  std::vector<std::string> words;
  std::size_t at = 0;
  for (const Token& token : read.tokens) {
    const bool is_end = token.kind == TokenKind::End;
    const std::size_t begin = is_end ? text.size() : token.begin;
    for (const Comment& comment :
         gap_in(text, {at, begin}, rule_comment).comments) {
      words.emplace_back(comment.text);
    }
    if (token.is_first_on_line) words.emplace_back("\n");
    words.emplace_back(text.substr(token.begin, token.end - token.begin));
    at = token.end;
  }
  for (const TitleLine& title : read.titles) words.emplace_back(title.text);
  return words;
}

}  // namespace btcheck::style

// SPDX-License-Identifier: MIT
//
// Characters to words, in one pass.
//
// A word ends at a blank, a parenthesis, a quote or a comment; nothing else
// separates, so that paths such as global_costmap/clear, numbers and operators
// are single words. Lines and columns are counted along the way. Characters
// that a terminal would obey are refused here, so that no name can carry them
// into a report. A copy from the paper's LaTeX source brings line labels
// between (*@ and @*): they are named for what they are and skipped.
#include "model/btf/lexer.hpp"

#include <algorithm>

#include "text/utf8.hpp"

namespace btcheck::btf {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' ||
         c == '\v';
}

bool ends_word(char c) {
  return is_blank(c) || c == '(' || c == ')' || c == ';' || c == '"';
}

class Lexer {
 public:
  Lexer(std::string_view text, Findings& findings)
      : text_(text), findings_(findings) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
  }

  std::vector<Token> run() {
    while (at_ < text_.size()) next();
    return std::move(tokens_);
  }

 private:
  void next() {
    const char c = text_[at_];
    if (is_blank(c)) {
      advance(at_ + 1);
    } else if (c == ';') {
      advance(end_of_line());
    } else if (text_.substr(at_).starts_with("(*@")) {
      skip_latex();
    } else if (c == '(' || c == ')') {
      add(c == '(' ? TokenKind::Open : TokenKind::Close, at_ + 1);
    } else if (c == '[') {
      add_enclosed(TokenKind::Interval, ']', "this bracket is never closed");
    } else if (c == '"') {
      add_enclosed(TokenKind::Quoted, '"', "this quote is never closed");
    } else {
      add_word();
    }
  }

  void add_word() {
    const auto end = std::find_if(text_.begin() + offset(at_), text_.end(),
                                  [](char c) { return ends_word(c); });
    const bool is_keyword = text_[at_] == ':' && at_ + 1 < text_.size() &&
                            text_[at_ + 1] != '=' && !ends_word(text_[at_ + 1]);
    add(is_keyword ? TokenKind::Keyword : TokenKind::Word,
        static_cast<std::size_t>(end - text_.begin()));
  }

  // What stands between two signs on one line.
  void add_enclosed(TokenKind kind, char closing, std::string_view complaint) {
    const std::size_t line_end = end_of_line();
    const std::string_view line = text_.substr(at_, line_end - at_);
    const std::size_t length = line.find(closing, 1);
    if (length != std::string_view::npos) {
      add(kind, at_ + length + 1);
      return;
    }
    findings_.error(
        span_until(at_ + 1),
        {"BT1003", std::string(complaint), "opened here",
         kind == TokenKind::Interval ? "write an interval as `[2,5]`"
                                     : "close it on the same line"});
    advance(line_end);
  }

  void skip_latex() {
    const std::size_t line_end = end_of_line();
    const std::string_view line = text_.substr(at_, line_end - at_);
    const std::size_t length = line.find("@*)");
    const std::size_t end =
        length == std::string_view::npos ? line_end : at_ + length + 3;
    findings_.error(span_until(end),
                    {"BT1003", "`(*@ ... @*)` is not part of the language",
                     "a line label of a LaTeX listing", "delete it"});
    advance(end);
  }

  void add(TokenKind kind, std::size_t end) {
    const std::string_view word = text_.substr(at_, end - at_);
    const SourceSpan span = span_until(end);
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (continues_character(word[i]) || !is_harmful(decode(word, i).value)) {
        continue;
      }
      findings_.error(span, {"BT1003", "a control character in a word",
                             "shown as `?`", "delete it"});
      break;
    }
    tokens_.push_back({kind, word, span});
    advance(end);
  }

  SourceSpan span_until(std::size_t end) const {
    const auto begin = text_.begin();
    const auto length =
        std::count_if(begin + offset(at_), begin + offset(end),
                      [](char c) { return !continues_character(c); });
    return {line_, column_, std::max(static_cast<int>(length), 1)};
  }

  void advance(std::size_t end) {
    for (; at_ < end; ++at_) {
      if (text_[at_] == '\n') {
        ++line_;
        column_ = 1;
      } else if (!continues_character(text_[at_])) {
        ++column_;
      }
    }
  }

  std::size_t end_of_line() const {
    return std::min(text_.find('\n', at_), text_.size());
  }

  static std::ptrdiff_t offset(std::size_t at) {
    return static_cast<std::ptrdiff_t>(at);
  }

  std::string_view text_;
  Findings& findings_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> split_words(std::string_view text, Findings& findings) {
  return Lexer(text, findings).run();
}

}  // namespace btcheck::btf

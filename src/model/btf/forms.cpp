// SPDX-License-Identifier: MIT
//
// A word ends at a blank, a parenthesis, a quote or a comment; nothing else
// separates, so that paths such as global_costmap/clear, numbers and operators
// are single words. Characters that a terminal would obey are refused here, so
// that no name can carry them into a report. A copy from the paper's LaTeX
// source brings line labels between (*@ and @*): they are reported by name and
// skipped.
//
// The lists that are open stand on a stack. A single wrong parenthesis can ruin
// the sense of everything after it. Therefore `(BehaviorTree`, `(defsv`,
// `(defaction`, `(defcondition` and `(defun`, which never stand inside anything
// but the list that encloses the file, prove that what was open before them
// should have been closed: the error names that form, and reading starts
// afresh.
#include "model/btf/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "text/utf8.hpp"

namespace btcheck::btf {
namespace {

constexpr std::size_t kDeepestForm = 500;
constexpr std::size_t kMostTokens = 1'000'000;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' ||
         c == '\v';
}

bool ends_word(char c) {
  return is_blank(c) || c == '(' || c == ')' || c == ';' || c == '"';
}

// Splits a text into its words. Comments, blanks and what cannot be a word are
// left out, the latter with an error.
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
      add(c == '(' ? FormKind::List : FormKind::Close, at_ + 1);
    } else if (c == '[') {
      add_enclosed(FormKind::Interval, ']', "this bracket is never closed");
    } else if (c == '"') {
      add_enclosed(FormKind::Quoted, '"', "this quote is never closed");
    } else {
      add_word();
    }
  }

  void add_word() {
    const bool is_keyword = text_[at_] == ':' && at_ + 1 < text_.size() &&
                            text_[at_ + 1] != '=' && !ends_word(text_[at_ + 1]);
    std::size_t end = at_;
    while (end < text_.size() && !ends_word(text_[end])) ++end;
    add(is_keyword ? FormKind::Keyword : FormKind::Word, end);
  }

  // What stands between two signs on one line.
  void add_enclosed(FormKind kind, char closing, std::string_view complaint) {
    const std::size_t line_end = end_of_line();
    const std::string_view line = text_.substr(at_, line_end - at_);
    const std::size_t length = line.find(closing, 1);
    if (length != std::string_view::npos) {
      add(kind, at_ + length + 1);
      return;
    }
    findings_.error({line_, column_, 1},
                    {"BT1003", std::string(complaint), "opened here",
                     kind == FormKind::Interval ? "write an interval as `[2,5]`"
                                                : "close it on the same line"});
    advance(line_end);
  }

  void skip_latex() {
    const std::size_t line_end = end_of_line();
    const std::string_view line = text_.substr(at_, line_end - at_);
    const std::size_t length = line.find("@*)");
    const std::size_t end =
        length == std::string_view::npos ? line_end : at_ + length + 3;
    findings_.error(advance(end),
                    {"BT1003", "`(*@ ... @*)` is not part of the language",
                     "a line label of a LaTeX listing", "delete it"});
  }

  void add(FormKind kind, std::size_t end) {
    const std::string_view word = text_.substr(at_, end - at_);
    const SourceSpan span = advance(end);
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (continues_character(word[i]) || !is_harmful(decode(word, i).value)) {
        continue;
      }
      findings_.error(span, {"BT1003", "a control character in a word",
                             "shown as `?`", "delete it"});
      break;
    }
    tokens_.push_back({kind, word, span});
  }

  // Returns the span of what it passes, if that is in one line.
  SourceSpan advance(std::size_t end) {
    const int column = column_;
    for (; at_ < end; ++at_) {
      if (text_[at_] == '\n') {
        ++line_;
        column_ = 1;
      } else if (!continues_character(text_[at_])) {
        ++column_;
      }
    }
    return {line_, column, std::max(column_ - column, 1)};
  }

  std::size_t end_of_line() const {
    return std::min(text_.find('\n', at_), text_.size());
  }

  std::string_view text_;
  Findings& findings_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
  std::vector<Token> tokens_;
};

bool opens_the_top_level(std::string_view word) {
  constexpr std::array<std::string_view, 5> kHeads = {
      "BehaviorTree", "defsv", "defaction", "defcondition", "defun"};
  return std::ranges::any_of(kHeads, [&](std::string_view head) {
    return equal_ignoring_case(word, head);
  });
}

class Nesting {
 public:
  Nesting(std::vector<Token> tokens, Findings& findings) : findings_(findings) {
    forms_.tokens = std::move(tokens);
  }

  Forms run() {
    const std::vector<Token>& tokens = forms_.tokens;
    if (tokens.size() > kMostTokens) {
      stop(tokens[kMostTokens].span,
           fmt::format("the file has more than {} words", kMostTokens));
    }
    for (at_ = 0; at_ < tokens.size() && forms_.is_complete; ++at_) {
      next(tokens[at_]);
    }
    if (forms_.is_complete && !open_.empty()) close_from(0, "the end");
    open_the_enclosing_list();
    return std::move(forms_);
  }

 private:
  void next(const Token& token) {
    if (token.kind == FormKind::List) {
      open(token);
    } else if (token.kind == FormKind::Close) {
      close(token);
    } else {
      add(token);
    }
  }

  void open(const Token& token) {
    const std::size_t next = at_ + 1;
    if (next < forms_.tokens.size() &&
        opens_the_top_level(forms_.tokens[next].text) &&
        open_.size() > top_level_depth()) {
      close_from(top_level_depth(), fmt::format("line {}", token.span.line));
    }
    if (open_.size() == kDeepestForm) {
      stop(token.span,
           fmt::format("parentheses nest deeper than {} levels", kDeepestForm));
      return;
    }
    open_.push_back(add(token));
  }

  void close(const Token& token) {
    if (open_.empty()) {
      forms_.is_balanced = false;
      findings_.error(token.span, {"BT1001", "this `)` closes nothing",
                                   "every `(` before it is closed already",
                                   "delete it, or look for one too many "
                                   "before it"});
      return;
    }
    form(open_.back()).end_token = at_ + 1;
    open_.pop_back();
  }

  FormId add(const Token& token) {
    const FormId id{static_cast<std::uint32_t>(forms_.all.size())};
    std::vector<FormId>& siblings =
        open_.empty() ? forms_.top_level : form(open_.back()).items;
    siblings.push_back(id);
    const bool is_list = token.kind == FormKind::List;
    forms_.all.push_back({token.kind,
                          is_list ? std::string_view{} : token.text,
                          token.span,
                          {},
                          at_,
                          at_ + 1});
    return id;
  }

  // Closes every open list but the first `depth`, as an error.
  void close_from(std::size_t depth, std::string_view where) {
    forms_.is_balanced = false;
    const std::size_t missing = open_.size() - depth;
    const Form* head = forms_.head(open_[depth]);
    findings_.error(
        form(open_[depth]).span,
        {"BT1001",
         head ? fmt::format("`({}` is never closed", head->text)
              : std::string("`(` is never closed"),
         "opened here",
         missing == 1
             ? fmt::format("a `)` is missing before {}", where)
             : fmt::format("{} `)` are missing before {}", missing, where)});
    for (; open_.size() > depth; open_.pop_back()) {
      form(open_.back()).end_token = at_;
    }
  }

  // 1 inside a list that encloses the file, which begins with a list; else 0.
  std::size_t top_level_depth() const {
    if (open_.empty()) return 0;
    return forms_.head(open_.front()) ? 0 : 1;
  }

  void stop(SourceSpan span, std::string complaint) {
    forms_.is_complete = false;
    findings_.error(span, {"BT1002", std::move(complaint), "",
                           "split the tree into subtrees"});
  }

  void open_the_enclosing_list() {
    std::vector<FormId> opened;
    for (const FormId id : forms_.top_level) {
      const std::vector<FormId>& inside = form(id).items;
      if (form(id).is_list() && !forms_.head(id)) {
        opened.insert(opened.end(), inside.begin(), inside.end());
      } else {
        opened.push_back(id);
      }
    }
    forms_.top_level = std::move(opened);
  }

  Form& form(FormId id) { return forms_.all[static_cast<std::uint32_t>(id)]; }

  Findings& findings_;
  Forms forms_;
  std::vector<FormId> open_;
  std::uint32_t at_ = 0;
};

}  // namespace

const Form* Forms::head(FormId id) const {
  const Form& list = (*this)[id];
  if (!list.is_list() || list.items.empty()) return nullptr;
  const Form& first = (*this)[list.items.front()];
  return first.is_list() ? nullptr : &first;
}

std::string Forms::written(FormId id) const {
  const Form& form = (*this)[id];
  std::string text;
  for (std::uint32_t at = form.first_token; at < form.end_token; ++at) {
    const bool is_close = tokens[at].kind == FormKind::Close;
    if (!text.empty() && text.back() != '(' && !is_close) text += ' ';
    text += tokens[at].text;
  }
  return text;
}

ParsedForms::ParsedForms(const std::string& text)
    : source("", text),
      forms(Nesting(Lexer(source.text(), findings).run(), findings).run()) {}

}  // namespace btcheck::btf

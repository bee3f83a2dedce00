// SPDX-License-Identifier: MIT
//
// Words to lists, with an explicit stack of the lists that are open.
//
// The only thing that can go wrong here is a parenthesis, and one of them can
// ruin the sense of everything after it. Therefore `(BehaviorTree`, `(defsv`,
// `(defaction` and `(defcondition`, which never stand inside anything but the
// list that encloses the file, are taken as proof that what was open before
// them should have been closed: the error names that form, and reading starts
// afresh.
#include "model/btf/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace btcheck::btf {
namespace {

constexpr std::size_t kDeepest = 500;
constexpr std::size_t kMostWords = 1'000'000;

bool opens_the_top_level(std::string_view word) {
  constexpr std::array<std::string_view, 4> kHeads = {
      "BehaviorTree", "defsv", "defaction", "defcondition"};
  return std::any_of(kHeads.begin(), kHeads.end(), [&](std::string_view head) {
    return equal_ignoring_case(word, head);
  });
}

FormKind kind_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::Keyword:
      return FormKind::Keyword;
    case TokenKind::Interval:
      return FormKind::Interval;
    case TokenKind::Quoted:
      return FormKind::Quoted;
    default:
      return FormKind::Word;
  }
}

class Nesting {
 public:
  Nesting(std::vector<Token> tokens, Findings& findings) : findings_(findings) {
    forms_.tokens = std::move(tokens);
  }

  Forms run() {
    const std::vector<Token>& tokens = forms_.tokens;
    if (tokens.size() > kMostWords) {
      stop(tokens[kMostWords].span,
           fmt::format("the file has more than {} words", kMostWords));
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
    if (token.kind == TokenKind::Open) {
      open(token);
    } else if (token.kind == TokenKind::Close) {
      close(token);
    } else {
      add(kind_of(token.kind), token);
    }
  }

  void open(const Token& token) {
    const std::size_t next = at_ + 1;
    if (next < forms_.tokens.size() &&
        opens_the_top_level(forms_.tokens[next].text) &&
        open_.size() > top_level_depth()) {
      close_from(top_level_depth(), fmt::format("line {}", token.span.line));
    }
    if (open_.size() == kDeepest) {
      stop(token.span,
           fmt::format("parentheses nest deeper than {} levels", kDeepest));
      return;
    }
    open_.push_back(add(FormKind::List, token));
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

  FormId add(FormKind kind, const Token& token) {
    const FormId id{static_cast<std::uint32_t>(forms_.all.size())};
    std::vector<FormId>& siblings =
        open_.empty() ? forms_.top_level : form(open_.back()).items;
    siblings.push_back(id);
    Form added;
    added.kind = kind;
    added.text = kind == FormKind::List ? std::string_view{} : token.text;
    added.span = token.span;
    added.first_token = at_;
    added.end_token = at_ + 1;
    forms_.all.push_back(std::move(added));
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
      if (form(id).is_list() && !forms_.head(id)) {
        opened.insert(opened.end(), form(id).items.begin(),
                      form(id).items.end());
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
    const bool is_close = tokens[at].kind == TokenKind::Close;
    if (!text.empty() && text.back() != '(' && !is_close) text += ' ';
    text += tokens[at].text;
  }
  return text;
}

Forms read_forms(std::vector<Token> tokens, Findings& findings) {
  return Nesting(std::move(tokens), findings).run();
}

}  // namespace btcheck::btf

// SPDX-License-Identifier: MIT
//
// Line breaks are the author's, as far as a line has no more than kWidth
// columns, and more are made where that is not enough: before each child of a
// node, then before a keyword or a word. The children of a node stand in one
// line with it, or each in a line of its own. What goes on in another line is
// indented by two columns; operands stand below the first one, and what is a
// list of data below its first word.
#include "style/forms.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "model/btf/expression.hpp"
#include "model/btf/trees.hpp"
#include "text/utf8.hpp"

namespace btcheck::style {
namespace {

using btf::FormKind;

std::size_t form_comment(std::string_view text) {
  if (!text.starts_with(';')) return 0;
  return std::min(text.find('\n'), text.size());
}

// The words of a text, with what stands between them.
class Words {
 public:
  explicit Words(const btf::ParsedForms& parsed)
      : tokens(parsed.forms.tokens), text_(parsed.source.text()) {
    std::size_t at = 0;
    for (const btf::Token& token : tokens) {
      const auto begin =
          static_cast<std::size_t>(token.text.data() - text_.data());
      gaps.push_back(gap_in(text_, {at, begin}, form_comment));
      at = begin + token.text.size();
    }
    gaps.push_back(gap_in(text_, {at, text_.size()}, form_comment));
  }

  bool is(std::size_t at, FormKind kind) const {
    return at < tokens.size() && tokens[at].kind == kind;
  }
  int width(std::size_t at) const { return count_code_points(tokens[at].text); }

  const std::vector<btf::Token>& tokens;
  std::vector<Gap> gaps;  // gaps[i] stands before tokens[i]

 private:
  std::string_view text_;
};

class FormsWriter {
 public:
  explicit FormsWriter(const btf::ParsedForms& parsed)
      : words_(parsed), lines_(parsed.source.text()) {
    const std::size_t count = words_.tokens.size();
    closing_.assign(count, 0);
    std::vector<std::size_t> open;
    for (std::size_t at = 0; at < count; ++at) {
      ends_.push_back((at == 0 ? 0 : ends_.back()) + (has_blank(at) ? 1 : 0) +
                      words_.width(at));
      breaks_.push_back((at == 0 ? 0 : breaks_.back()) +
                        (is_broken(at) ? 1 : 0));
      if (words_.is(at, FormKind::List)) open.push_back(at);
      if (!words_.is(at, FormKind::Close)) continue;
      closing_[open.back()] = at;
      open.pop_back();
    }
  }

  std::string write() {
    for (std::size_t at = 0; at < words_.tokens.size(); ++at) {
      const bool is_close = words_.is(at, FormKind::Close);
      const bool begins_line = add_comments(at) || needs_break(at);
      if (begins_line) {
        lines_.begin(is_close ? open_.back().column : indent(),
                     words_.gaps[at].breaks);
      } else if (has_blank(at)) {
        lines_.add(" ");
      }
      place(at);
    }
    add_comments(words_.tokens.size());
    return lines_.take();
  }

 private:
  enum class Layout : unsigned char {
    Enclosing,  // the list around all that a file holds
    Node,       // a word, keywords, children
    Operator,
    Data,
    Pairs  // of :args
  };
  struct Open {
    Layout layout = Layout::Data;
    int column = 0;  // of the parenthesis
    int indent = 0;  // of what goes on in another line
    bool breaks_children = false;
    std::size_t items = 0;
  };

  bool has_blank(std::size_t at) const {
    return at > 0 && !words_.is(at - 1, FormKind::List) &&
           !words_.is(at, FormKind::Close);
  }
  // A new line begins before it as it is written.
  bool is_broken(std::size_t at) const {
    if (!words_.gaps[at].comments.empty()) return true;
    return has_blank(at) && words_.gaps[at].breaks > 0;
  }
  int breaks_in(std::size_t first, std::size_t last) const {
    return breaks_[last] - breaks_[first];
  }
  bool is_node(std::size_t at) const {
    return words_.is(at, FormKind::List) && words_.is(at + 1, FormKind::Word) &&
           btf::find_node_type(words_.tokens[at + 1].text).has_value();
  }
  bool is_operator(std::size_t at) const {
    return words_.is(at + 1, FormKind::Word) &&
           btf::find_operator(words_.tokens[at + 1].text) != nullptr;
  }
  // It belongs to the keyword before it.
  bool is_value(std::size_t at) const {
    return at > 0 && words_.is(at - 1, FormKind::Keyword) &&
           !words_.is(at, FormKind::Keyword) &&
           !words_.is(at, FormKind::Close) && !is_node(at);
  }
  bool is_top_level() const {
    return open_.empty() || open_.back().layout == Layout::Enclosing;
  }
  int indent() const { return open_.empty() ? 0 : open_.back().indent; }

  // The last word of what is not torn apart unless it has to be.
  std::size_t unit_end(std::size_t at) const {
    if (words_.is(at, FormKind::List)) return closing_[at];
    const bool is_pair =
        !open_.empty() && open_.back().layout == Layout::Pairs &&
        at + 1 < words_.tokens.size() && !words_.is(at + 1, FormKind::Close);
    const bool has_more =
        at + 1 < words_.tokens.size() && (is_value(at + 1) || is_pair);
    return has_more ? unit_end_of_item(at + 1) : at;
  }
  std::size_t unit_end_of_item(std::size_t at) const {
    return words_.is(at, FormKind::List) ? closing_[at] : at;
  }
  // How many columns it takes from its first word to the next line.
  int width_from(std::size_t at, std::size_t last) const {
    while (words_.is(last + 1, FormKind::Close) && !is_broken(last + 1)) {
      ++last;
    }
    // The first word behind which a line begins.
    const auto first = breaks_.begin() + static_cast<std::ptrdiff_t>(at);
    const auto broken = std::upper_bound(
        first, breaks_.begin() + static_cast<std::ptrdiff_t>(last) + 1, *first);
    last = static_cast<std::size_t>(broken - breaks_.begin()) - 1;
    return ends_[last] - ends_[at] + words_.width(at);
  }

  bool needs_break(std::size_t at) const {
    if (!has_blank(at)) return at == 0;
    if (words_.gaps[at].breaks > 0) return true;
    if (is_top_level()) return words_.is(at, FormKind::List);
    const Open& list = open_.back();
    if (is_node(at) && list.breaks_children) return true;
    if (is_value(at)) return false;
    if (list.layout == Layout::Pairs && list.items % 2 == 1) return false;
    const int column = lines_.column() + 1;
    return list.indent < column &&
           column + width_from(at, unit_end(at)) > kWidth;
  }

  // True where the next word has to begin a line.
  bool add_comments(std::size_t at) {
    const Gap& gap = words_.gaps[at];
    for (const Comment& comment : gap.comments) {
      if (comment.breaks > 0 || lines_.is_empty()) {
        lines_.begin(indent(), comment.breaks);
        lines_.add(comment.text);
      } else {
        add_behind(lines_, comment);
      }
    }
    return !gap.comments.empty();
  }

  void place(std::size_t at) {
    const int column = is_top_level() ? 0 : lines_.column();
    lines_.add(words_.tokens[at].text);
    if (words_.is(at, FormKind::Close)) {
      open_.pop_back();
      return;
    }
    const std::optional<Open> list = words_.is(at, FormKind::List)
                                         ? std::optional(opened(at, column))
                                         : std::nullopt;
    if (!open_.empty()) ++open_.back().items;
    if (list) open_.push_back(*list);
  }

  Open opened(std::size_t at, int column) const {
    Open list;
    list.column = column;
    list.indent = column + 1;
    if (open_.empty() && words_.is(at + 1, FormKind::List)) {
      list.layout = Layout::Enclosing;
      list.indent = 0;
    } else if (is_operator(at)) {
      list.layout = Layout::Operator;
      const bool has_operand = words_.is(at + 1, FormKind::Word) &&
                               !words_.is(at + 2, FormKind::Close) &&
                               !is_broken(at + 2);
      list.indent = column + (has_operand ? words_.width(at + 1) + 2 : kIndent);
    } else if (is_value(at)) {
      const bool has_pairs =
          equal_ignoring_case(words_.tokens[at - 1].text, ":args");
      list.layout = has_pairs ? Layout::Pairs : Layout::Data;
    } else if (words_.is(at + 1, FormKind::Word)) {
      list.layout = Layout::Node;
      list.indent = column + kIndent;
      const std::size_t last = closing_[at];
      list.breaks_children =
          breaks_in(at, last) > 0 || column + width_from(at, last) > kWidth;
    }
    return list;
  }

  const Words words_;
  Lines lines_;
  std::vector<std::size_t> closing_;  // of each list, its last word
  std::vector<int> ends_;             // of each word, if all were in one line
  std::vector<int> breaks_;           // the lines begun, up to each word
  std::vector<Open> open_;
};

}  // namespace

std::string styled_forms(const btf::ParsedForms& parsed) {
  return FormsWriter(parsed).write();
}

std::vector<std::string> words_and_comments(const btf::ParsedForms& parsed) {
  const Words words(parsed);
  std::vector<std::string> result;
  for (std::size_t at = 0; at < words.gaps.size(); ++at) {
    for (const Comment& comment : words.gaps[at].comments) {
      result.emplace_back(comment.text);
    }
    if (at < words.tokens.size()) result.emplace_back(words.tokens[at].text);
  }
  return result;
}

}  // namespace btcheck::style

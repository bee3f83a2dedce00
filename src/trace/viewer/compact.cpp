// SPDX-License-Identifier: MIT
//
// White space goes where one of its neighbours is punctuation. A line break in
// a script stays unless a bracket or an operator shows that the statement goes
// on, so nothing rests on semicolons that are not there.
#include "trace/viewer/compact.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace btcheck {
namespace {

bool is_one_of(char c, std::string_view set) {
  return set.find(c) != std::string_view::npos;
}

bool is_space(char c) { return c == ' ' || c == '\n'; }

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '$' || (c & 0x80) != 0;
}

class ScriptCompactor {
 public:
  explicit ScriptCompactor(std::string_view script) : rest_(script) {}

  std::string compacted() {
    while (!rest_.empty()) {
      const char c = rest_[0];
      if (is_space(c) || rest_.starts_with("//") || rest_.starts_with("/*")) {
        skip_space();
      } else if (c == '"' || c == '\'') {
        copy_until(c);
      } else if (c == '`') {
        copy(1);
        copy_template();
      } else if (c == '/' && (result_.empty() ||
                              is_one_of(result_.back(), "(,=:[!&|?{};\n"))) {
        copy_expression();
      } else {
        copy_code(c);
      }
    }
    return std::move(result_);
  }

 private:
  void copy(std::size_t many) {
    many = std::min(many, rest_.size());
    result_ += rest_.substr(0, many);
    rest_.remove_prefix(many);
  }

  // A bracket may end what stands in a template.
  void copy_code(char c) {
    if (c == '{') ++depth_;
    const bool ends = c == '}' && depth_ == 0 && !outer_.empty();
    if (c == '}' && depth_ > 0) --depth_;
    copy(1);
    if (!ends) return;
    depth_ = outer_.back();
    outer_.pop_back();
    copy_template();
  }

  // From inside a template to its end, or to where code stands in it.
  void copy_template() {
    while (!rest_.empty()) {
      const char c = rest_[0];
      if (rest_.starts_with("${")) {
        copy(2);
        outer_.push_back(depth_);
        depth_ = 0;
        return;
      }
      copy(c == '\\' ? 2 : 1);
      if (c == '`') return;
    }
  }

  void copy_until(char quote) {
    do {
      copy(rest_[0] == '\\' ? 2 : 1);
    } while (!rest_.empty() && rest_[0] != quote);
    copy(1);
  }

  void copy_expression() {
    bool in_set = false;
    do {
      in_set = rest_[0] == '[' || (in_set && rest_[0] != ']');
      copy(rest_[0] == '\\' ? 2 : 1);
    } while (!rest_.empty() && (in_set || rest_[0] != '/'));
    copy(1);
  }

  // Space and comments up to the next token; what must stay of them.
  void skip_space() {
    bool has_break = false;
    while (!rest_.empty()) {
      std::size_t length = 1;
      if (rest_.starts_with("//")) {
        length = std::min(rest_.find('\n'), rest_.size());
      } else if (rest_.starts_with("/*")) {
        length = rest_.find("*/") + 2;
      } else if (!is_space(rest_[0])) {
        break;
      }
      has_break |= rest_[0] == '\n';
      rest_.remove_prefix(length);
    }
    if (result_.empty() || rest_.empty()) return;
    const char before = result_.back();
    const char after = rest_[0];
    if (has_break) {
      const bool goes_on = is_one_of(before, "{([,;:?&|=<>!\n") ||
                           is_one_of(after, ")]},;.:?&|=<>");
      if (!goes_on) result_ += '\n';
    } else if (is_word(before) && is_word(after)) {
      result_ += ' ';
    } else if (before == after && is_one_of(after, "+-")) {
      result_ += ' ';
    }
  }

  std::string_view rest_;
  std::string result_;
  int depth_ = 0;           // of curly brackets
  std::vector<int> outer_;  // the same, of the code around each template
};

}  // namespace

std::string compact_script(std::string_view script) {
  return ScriptCompactor(script).compacted();
}

std::string compact_style(std::string_view style) {
  std::string result;
  bool has_space = false;
  bool in_text = false;
  for (std::size_t at = 0; at < style.size(); ++at) {
    const char c = style[at];
    if (c == '"') in_text = !in_text;
    if (!in_text && style.substr(at).starts_with("/*")) {
      at = style.find("*/", at) + 1;
      continue;
    }
    if (!in_text && is_space(c)) {
      has_space = true;
      continue;
    }
    const bool is_needed = has_space && !result.empty() &&
                           !is_one_of(result.back(), "{};,:") &&
                           !is_one_of(c, "{};,");
    if (is_needed) result += ' ';
    has_space = false;
    if (c == '}' && !result.empty() && result.back() == ';') result.pop_back();
    result += c;
  }
  return result;
}

std::string compact_page(std::string_view page) {
  std::string result;
  for (const char c : page) {
    const bool is_indent =
        is_space(c) && (result.empty() || result.back() == '\n');
    if (!is_indent) result += c;
  }
  return result;
}

}  // namespace btcheck

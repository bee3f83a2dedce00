// SPDX-License-Identifier: MIT
#include "model/edits/contract_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "model/btf/forms.hpp"
#include "model/tree/node_types.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

using namespace btf;

std::string_view head_of(NodeType leaf) {
  return leaf == NodeType::Condition ? "defcondition" : "defaction";
}

std::string said(const LeafClause& clause) {
  return clause.value.empty()
             ? fmt::format(":{}", clause.keyword)
             : fmt::format(":{} {}", clause.keyword, clause.value);
}

std::string_view unquoted(std::string_view name) {
  const bool is_quoted = name.size() > 1 && name.front() == '"';
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

class Edit {
 public:
  Edit(const std::string& text, const LeafClause& clause)
      : text_(text), clause_(clause), parsed_(text) {}

  std::string made() const {
    for (const FormId id : forms().top_level) {
      if (is_of_leaf(forms()[id])) return put_into(forms()[id]);
    }
    const bool ends_line = text_.empty() || text_.ends_with('\n');
    return fmt::format("{}{}{}\n", text_, ends_line ? "" : "\n",
                       contract_of(clause_));
  }

 private:
  const Forms& forms() const { return parsed_.forms; }

  bool is_of_leaf(const Form& form) const {
    if (!form.is_list() || form.items.size() < 2) return false;
    return equal_ignoring_case(forms()[form.items[0]].text,
                               head_of(clause_.leaf)) &&
           unquoted(forms()[form.items[1]].text) == unquoted(clause_.name);
  }

  std::size_t begin_of(const Token& token) const {
    return static_cast<std::size_t>(token.text.data() - text_.data());
  }
  std::size_t end_of(const Token& token) const {
    return begin_of(token) + token.text.size();
  }

  std::string put_into(const Form& form) const {
    for (std::size_t i = 2; i < form.items.size(); ++i) {
      const Form& keyword = forms()[form.items[i]];
      if (!is_keyword(keyword, clause_.keyword)) continue;
      const Form* value =
          i + 1 < form.items.size() ? &forms()[form.items[i + 1]] : nullptr;
      if (value != nullptr && value->kind == FormKind::Keyword) value = nullptr;
      const std::uint32_t last =
          value != nullptr ? value->end_token : keyword.end_token;
      return replaced(begin_of(forms().tokens[keyword.first_token]),
                      end_of(forms().tokens[last - 1]), added_to(value));
    }
    const std::size_t end = begin_of(forms().tokens[form.end_token - 1]);
    return replaced(end, end, " " + said(clause_));
  }

  // A list, with what it has already.
  std::string added_to(const Form* value) const {
    const bool is_list = clause_.value.starts_with('(');
    const bool adds = is_list && value != nullptr &&
                      (value->is_list() || value->is_word()) &&
                      clause_.keyword != "returns";
    if (!adds) return said(clause_);
    const ParsedForms more(clause_.value);
    std::vector<std::string> names;
    const auto add = [&](std::string_view name) {
      if (std::ranges::count(names, name) == 0) names.emplace_back(name);
    };
    if (value->is_word()) add(value->text);
    for (const FormId item : value->items) add(forms()[item].text);
    for (const Token& token : more.forms.tokens) {
      if (token.kind == FormKind::Word || token.kind == FormKind::Quoted) {
        add(token.text);
      }
    }
    return fmt::format(":{} ({})", clause_.keyword, fmt::join(names, " "));
  }

  std::string replaced(std::size_t begin, std::size_t end,
                       std::string_view by) const {
    return text_.substr(0, begin) + std::string(by) + text_.substr(end);
  }

  const std::string& text_;
  const LeafClause& clause_;
  ParsedForms parsed_;
};

}  // namespace

std::string contract_of(const LeafClause& clause) {
  return fmt::format("({} {} {})", head_of(clause.leaf), clause.name,
                     said(clause));
}

std::string with_clause(std::string_view text, const LeafClause& clause) {
  const std::string before(text);
  return Edit(before, clause).made();
}

}  // namespace btcheck

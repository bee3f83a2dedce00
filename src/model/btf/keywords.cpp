// SPDX-License-Identifier: MIT
//
// Keywords stand anywhere between the items of a form. A list after a keyword
// that wants a word is left to the items, where it is most likely a child: one
// forgotten value then costs one error, not the whole subtree.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/btf/forms.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck::btf {
namespace {

const KeywordRule* find_rule(std::span<const KeywordRule> rules,
                             const Form& keyword) {
  const auto found = std::ranges::find_if(rules, [&](const KeywordRule& rule) {
    return is_keyword(keyword, rule.name);
  });
  return found == rules.end() ? nullptr : &*found;
}

// `:transitions :all` is the one place where a keyword is a value.
bool can_be_value(const Form& keyword, Takes takes, const Form& next) {
  switch (next.kind) {
    case FormKind::Keyword:
      return is_keyword(next, "all") && is_keyword(keyword, "transitions");
    case FormKind::List:
      return takes == Takes::List;
    default:
      if (takes == Takes::Flag) return next.text == "0" || next.text == "1";
      return takes != Takes::YesNo || next.text == "yes" || next.text == "no";
  }
}

bool can_stand_alone(Takes takes) {
  return takes == Takes::Flag || takes == Takes::YesNo;
}

}  // namespace

Clauses::Clauses(const Reading& reading, FormId list,
                 std::span<const KeywordRule> rules)
    : reading_(reading), rules_(rules) {
  const std::vector<FormId>& inside = reading.form(list).items;
  for (std::size_t at = 1; at < inside.size(); ++at) {
    const Form& form = reading.form(inside[at]);
    if (form.kind != FormKind::Keyword) {
      items.push_back(inside[at]);
      continue;
    }
    const KeywordRule* rule = find_rule(rules, form);
    const Takes takes = rule ? rule->takes : Takes::Word;
    Clause& clause = all.emplace_back(Clause{inside[at], std::nullopt});
    if (at + 1 < inside.size() &&
        can_be_value(form, takes, reading.form(inside[at + 1]))) {
      clause.value = inside[++at];
    }
  }
}

const Clause* Clauses::find(std::string_view name) const {
  const Clause* found = nullptr;
  for (const Clause& clause : all) {
    const Form& keyword = reading_.form(clause.keyword);
    if (!is_keyword(keyword, name)) continue;
    const KeywordRule* rule = rule_of(clause);
    if (found) {
      reading_.error(keyword.span, "BT1006",
                     fmt::format("`{}` is given twice", keyword.text),
                     "the first one is used", "delete one of them");
    } else if (!clause.value && !(rule && can_stand_alone(rule->takes))) {
      reading_.error(keyword.span, "BT1006",
                     fmt::format("`{}` has no value", keyword.text),
                     is_before_list(keyword) ? "a word must follow, not a list"
                                             : "a value must follow");
    } else {
      found = &clause;
    }
  }
  return found;
}

bool Clauses::is_before_list(const Form& keyword) const {
  return std::ranges::any_of(items, [&](FormId id) {
    const Form& item = reading_.form(id);
    return item.is_list() && item.first_token == keyword.first_token + 1;
  });
}

bool Clauses::is_given(std::string_view name) const {
  return std::ranges::any_of(all, [&](const Clause& clause) {
    return is_keyword(reading_.form(clause.keyword), name);
  });
}

const KeywordRule* Clauses::rule_of(const Clause& clause) const {
  return find_rule(rules_, reading_.form(clause.keyword));
}

bool Clauses::report_unknown(std::span<const KeywordRule> rules,
                             std::string_view of) const {
  bool found = false;
  std::vector<std::string> known;
  for (const KeywordRule& rule : rules) {
    known.push_back(fmt::format(":{}", rule.name));
  }
  for (const Clause& clause : all) {
    const Form& keyword = reading_.form(clause.keyword);
    if (find_rule(rules, keyword)) continue;
    found = true;
    if (reading_.findings.is_full()) break;
    reading_.error(keyword.span, "BT1005",
                   fmt::format("unknown keyword `{}`", keyword.text),
                   fmt::format("not a keyword of {}", of),
                   nearest_or_all(keyword.text, known));
  }
  return found;
}

const Form* Clauses::first_item() const {
  return items.empty() ? nullptr : &reading_.form(items.front());
}

const Form& Clauses::value(const Clause& clause) const {
  return reading_.form(*clause.value);
}

void Clauses::report_value(const Clause& clause, std::string expected,
                           std::string help) const {
  const Form& form = value(clause);
  reading_.error(form.span, "BT1008",
                 fmt::format("{} is not a value of `{}`",
                             form.is_list() ? std::string("a list")
                                            : fmt::format("`{}`", form.text),
                             text(clause)),
                 std::move(expected), std::move(help));
}

std::optional<int> Clauses::integer_between(const Clause& clause, int min,
                                            int max) const {
  const Form& form = value(clause);
  const auto number = form.is_word() ? whole_number(form.text) : std::nullopt;
  if (!number || *number < min || *number > max) return std::nullopt;
  return static_cast<int>(*number);
}

std::optional<int> Clauses::integer(const Clause& clause, int min,
                                    int max) const {
  const auto number = integer_between(clause, min, max);
  if (!number) {
    report_value(clause, fmt::format("a whole number from {} to {} is needed",
                                     min, max));
  }
  return number;
}

bool Clauses::flag(std::string_view name) const {
  const Clause* clause = find(name);
  if (!clause || !clause->value) return clause != nullptr;
  const auto number = integer_between(*clause, 0, 1);
  if (!number) report_value(*clause, "0 or 1 is needed");
  return number == 1;
}

std::optional<bool> Clauses::yes_or_no(std::string_view name) const {
  const Clause* clause = find(name);
  if (!clause) return std::nullopt;
  return !clause->value || value(*clause).text == "yes";
}

std::optional<std::string> Clauses::name(const Clause& clause) const {
  const Form& form = value(clause);
  if (form.is_word() && is_name(form.text)) return std::string(form.text);
  report_value(
      clause, "a name is needed",
      form.kind == FormKind::Quoted ? "write the name without quotes" : "");
  return std::nullopt;
}

std::optional<Duration> Clauses::duration(const Clause& clause) const {
  return read_duration(reading_, *clause.value,
                       fmt::format("a value of `{}`", text(clause)));
}

std::vector<Argument> Clauses::arguments(const Clause& clause) const {
  const Form& list = value(clause);
  if (!list.is_list()) {
    report_value(clause, "a list is needed",
                 "write `:args (key value key value)`");
    return {};
  }
  std::vector<Argument> arguments;
  for (std::size_t at = 0; at < list.items.size(); at += 2) {
    const Form& key = reading_.form(list.items[at]);
    if (!key.is_word() || at + 1 == list.items.size()) {
      reading_.error(
          key.span, "BT1008",
          key.is_word()
              ? fmt::format("the argument `{}` has no value", key.text)
              : std::string("the key of an argument must be a word"),
          "", "write `:args (key value key value)`");
      break;
    }
    const auto is_same = [&](const Argument& each) {
      return equal_ignoring_case(each.key, key.text);
    };
    if (std::ranges::any_of(arguments, is_same)) {
      reading_.error(key.span, "BT1011",
                     fmt::format("the argument `{}` is given twice", key.text),
                     "", "delete one of them");
    }
    arguments.push_back({std::string(key.text),
                         reading_.forms.written(list.items[at + 1]),
                         {},
                         reading_.form(list.items[at + 1]).span});
  }
  return arguments;
}

std::string_view Clauses::text(const Clause& clause) const {
  return reading_.form(clause.keyword).text;
}

bool is_keyword(const Form& form, std::string_view name) {
  return form.kind == FormKind::Keyword &&
         equal_ignoring_case(form.text.substr(1), name);
}

std::optional<long long> whole_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with('+') || text.size() > 19) return std::nullopt;
  return as_number<long long>(text);
}

bool looks_numeric(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  return !text.empty() && is_digit(text.front());
}

std::string_view without_dollar(std::string_view word) {
  return word.starts_with('$') ? word.substr(1) : word;
}

bool is_name(std::string_view word) {
  constexpr std::array<std::string_view, 15> kOperators = {
      "=", "~=", "/=", "!=", "<", "<=", ">", ">=",
      "~", "+",  "-",  "*",  "/", ":=", ":"};
  const bool is_operator =
      std::ranges::find(kOperators, word) != kOperators.end();
  return !word.empty() && !is_operator && !looks_numeric(word) &&
         !word.starts_with('$');
}

std::string name_key(std::string_view word) { return lowered(word); }

std::string nearest_or_all(std::string_view word,
                           const std::vector<std::string>& candidates,
                           std::string_view introduction) {
  return did_you_mean(word, candidates,
                      fmt::format("{} {}", introduction, listed(candidates)));
}

}  // namespace btcheck::btf

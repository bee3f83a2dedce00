// SPDX-License-Identifier: MIT
//
// Taking a form apart into keywords, their values, and the rest.
//
// Keywords stand anywhere between the items of a form. A list after a keyword
// that wants a word is left to the items, where it is most likely a child: one
// forgotten value then costs one error, not the whole subtree.
#include "model/btf/keywords.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace btcheck::btf {
namespace {

constexpr int kLongestDuration = 1'000'000;
constexpr double kSlowestRate = 1e-5;
constexpr double kFastestRate = 1e6;

const KeywordRule* find_rule(std::span<const KeywordRule> rules,
                             const Form& keyword) {
  const auto found = std::find_if(
      rules.begin(), rules.end(),
      [&](const KeywordRule& rule) { return is_keyword(keyword, rule.name); });
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
      return takes != Takes::Flag || next.text == "0" || next.text == "1";
  }
}

bool is_flag(const Reading& reading, const Clause& clause) {
  return is_keyword(reading.form(clause.keyword), "SF");
}

void value_error(const Reading& reading, const Clause& clause, FormId value,
                 std::string expected, std::string help = {}) {
  reading.findings.error(
      reading.form(value).span,
      {"BT1008",
       fmt::format("{} is not a value of `{}`",
                   reading.form(value).is_list()
                       ? std::string("a list")
                       : fmt::format("`{}`", reading.form(value).text),
                   keyword_text(reading, clause)),
       std::move(expected), std::move(help)});
}

std::optional<int> integer_between(const Form& form, int min, int max) {
  if (!form.is_word()) return std::nullopt;
  const auto number = whole_number(form.text);
  if (!number || *number < min || *number > max) return std::nullopt;
  return static_cast<int>(*number);
}

// The one or two numbers of an interval as it is written.
std::vector<std::string_view> numbers_inside(std::string_view interval) {
  constexpr std::string_view kSeparators = "[], \t";
  std::vector<std::string_view> numbers;
  for (std::size_t at = 0; at < interval.size();) {
    const std::size_t begin = interval.find_first_not_of(kSeparators, at);
    if (begin == std::string_view::npos) break;
    at = std::min(interval.find_first_of(kSeparators, begin), interval.size());
    numbers.push_back(interval.substr(begin, at - begin));
  }
  return numbers;
}

std::vector<std::string_view> duration_words(const Reading& reading,
                                             const Form& value) {
  if (value.kind == FormKind::Interval) return numbers_inside(value.text);
  if (!value.is_list()) return {value.text};
  std::vector<std::string_view> words;
  for (const FormId item : value.items) {
    words.push_back(reading.form(item).text);
  }
  return words;
}

}  // namespace

Parts take_apart(const Reading& reading, FormId list,
                 std::span<const KeywordRule> rules) {
  Parts parts;
  const std::vector<FormId>& items = reading.form(list).items;
  for (std::size_t at = 1; at < items.size(); ++at) {
    const Form& form = reading.form(items[at]);
    if (form.kind != FormKind::Keyword) {
      parts.items.push_back(items[at]);
      continue;
    }
    const KeywordRule* rule = find_rule(rules, form);
    const Takes takes = rule ? rule->takes : Takes::Word;
    Clause clause{items[at], std::nullopt};
    if (at + 1 < items.size() &&
        can_be_value(form, takes, reading.form(items[at + 1]))) {
      clause.value = items[++at];
    }
    parts.clauses.push_back(clause);
  }
  return parts;
}

const Clause* find_clause(const Reading& reading, const Parts& parts,
                          std::string_view name) {
  const Clause* found = nullptr;
  for (const Clause& clause : parts.clauses) {
    const Form& keyword = reading.form(clause.keyword);
    if (!is_keyword(keyword, name)) continue;
    if (found) {
      reading.findings.error(
          keyword.span,
          {"BT1006", fmt::format("`{}` is given twice", keyword.text),
           "the first one is used", "delete one of them"});
    } else if (!clause.value && !is_flag(reading, clause)) {
      reading.findings.error(
          keyword.span,
          {"BT1006", fmt::format("`{}` has no value", keyword.text),
           "a value must follow", ""});
    } else {
      found = &clause;
    }
  }
  return found;
}

bool report_unknown_keywords(const Reading& reading, const Parts& parts,
                             std::span<const KeywordRule> rules,
                             std::string_view of) {
  bool found = false;
  std::vector<std::string> known;
  for (const KeywordRule& rule : rules) {
    known.push_back(fmt::format(":{}", rule.name));
  }
  for (const Clause& clause : parts.clauses) {
    const Form& keyword = reading.form(clause.keyword);
    if (find_rule(rules, keyword)) continue;
    found = true;
    if (reading.findings.is_full()) break;
    const std::string guess = did_you_mean(keyword.text, known);
    reading.findings.error(
        keyword.span,
        {"BT1005", fmt::format("unknown keyword `{}`", keyword.text),
         fmt::format("not a keyword of {}", of),
         guess.empty() ? fmt::format("there are {}", listed(known)) : guess});
  }
  return found;
}

std::string keyword_text(const Reading& reading, const Clause& clause) {
  return std::string(reading.form(clause.keyword).text);
}

bool is_keyword(const Form& form, std::string_view name) {
  return form.kind == FormKind::Keyword &&
         equal_ignoring_case(form.text.substr(1), name);
}

std::optional<long long> whole_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with('+') || text.size() > 19) return std::nullopt;
  long long number = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, problem] = std::from_chars(text.data(), end, number);
  if (problem != std::errc{} || stopped != end) return std::nullopt;
  return number;
}

bool looks_numeric(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

bool is_name(std::string_view word) {
  constexpr std::array<std::string_view, 15> kOperators = {
      "=", "~=", "/=", "!=", "<", "<=", ">", ">=",
      "~", "+",  "-",  "*",  "/", ":=", ":"};
  const bool is_operator =
      std::find(kOperators.begin(), kOperators.end(), word) != kOperators.end();
  return !word.empty() && !is_operator && !looks_numeric(word) &&
         !word.starts_with('$');
}

std::optional<int> read_integer(const Reading& reading, const Clause& clause,
                                int min, int max) {
  const auto number = integer_between(reading.form(*clause.value), min, max);
  if (!number) {
    value_error(
        reading, clause, *clause.value,
        fmt::format("a whole number from {} to {} is needed", min, max));
  }
  return number;
}

std::optional<bool> read_switch(const Reading& reading, const Clause& clause) {
  if (!clause.value) return true;
  const auto number = integer_between(reading.form(*clause.value), 0, 1);
  if (!number) value_error(reading, clause, *clause.value, "0 or 1 is needed");
  return number ? std::optional<bool>(*number == 1) : std::nullopt;
}

std::optional<std::string> read_name(const Reading& reading,
                                     const Clause& clause) {
  const Form& form = reading.form(*clause.value);
  if (form.is_word() && is_name(form.text)) return std::string(form.text);
  value_error(
      reading, clause, *clause.value, "a name is needed",
      form.kind == FormKind::Quoted ? "write the name without quotes" : "");
  return std::nullopt;
}

std::optional<double> read_rate(const Reading& reading, FormId value) {
  const Form& form = reading.form(value);
  const std::string_view text = form.is_word() ? form.text : "";
  double rate = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, problem] = std::from_chars(text.data(), end, rate);
  const bool is_number = problem == std::errc{} && stopped == end;
  if (is_number && rate >= kSlowestRate && rate <= kFastestRate) return rate;
  reading.findings.error(
      form.span, {"BT1008", "this is not a rate",
                  "ticks per second from 0.00001 to 1000000 are needed", ""});
  return std::nullopt;
}

std::optional<Duration> read_duration(const Reading& reading,
                                      const Clause& clause) {
  const auto words = duration_words(reading, reading.form(*clause.value));
  std::vector<int> ticks;
  for (const std::string_view word : words) {
    const auto number = whole_number(word);
    if (number && *number >= 0 && *number <= kLongestDuration) {
      ticks.push_back(static_cast<int>(*number));
    }
  }
  const bool are_numbers =
      ticks.size() == words.size() && !ticks.empty() && ticks.size() <= 2;
  if (are_numbers && ticks.front() <= ticks.back()) {
    return Duration{ticks.front(), ticks.back()};
  }
  value_error(reading, clause, *clause.value,
              are_numbers ? "the least number of ticks comes first"
                          : fmt::format("ticks from 0 to {} are needed",
                                        kLongestDuration),
              "write `5` or `[2,5]`");
  return std::nullopt;
}

std::vector<Argument> read_arguments(const Reading& reading,
                                     const Clause& clause) {
  const Form& list = reading.form(*clause.value);
  if (!list.is_list()) {
    value_error(reading, clause, *clause.value, "a list is needed",
                "write `:args (key value key value)`");
    return {};
  }
  std::vector<Argument> arguments;
  for (std::size_t at = 0; at < list.items.size(); at += 2) {
    const Form& key = reading.form(list.items[at]);
    if (!key.is_word() || at + 1 == list.items.size()) {
      reading.findings.error(
          key.span,
          {"BT1008",
           key.is_word()
               ? fmt::format("the argument `{}` has no value", key.text)
               : std::string("the key of an argument must be a word"),
           "", "write `:args (key value key value)`"});
      break;
    }
    arguments.push_back(
        {std::string(key.text), reading.forms.written(list.items[at + 1])});
  }
  return arguments;
}

}  // namespace btcheck::btf

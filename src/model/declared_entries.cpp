// SPDX-License-Identifier: MIT
//
// The forms are those of .btf, but for the states: the values of an entry are
// texts or numbers, and case matters.
#include "model/declared_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "model/btcpp/script/script.hpp"
#include "text/numbers.hpp"

namespace btcheck::btf {
namespace {

using btcpp::DeclaredEntry;
using btcpp::EntryDeclaration;
using btcpp::ScriptValue;

constexpr std::array<KeywordRule, 6> kEntryRules = {
    {{"min"},
     {"max"},
     {"init"},
     {"states", Takes::List},
     {"transitions", Takes::List},
     {"moves"}}};
constexpr std::array<KeywordRule, 4> kNumberEntryRules = {
    {{"min"}, {"max"}, {"init"}, {"moves"}}};
constexpr std::span<const KeywordRule> kStatesRules =
    std::span(kEntryRules).subspan(2);
constexpr std::array<KeywordRule, 1> kFirstValueRules = {{{"init"}}};

// As it is written; nothing when it is neither a number nor a text in quotes.
std::optional<ScriptValue> value_of(const Form& form) {
  if (form.kind == FormKind::Quoted) {
    return ScriptValue::of(
        std::string(form.text.substr(1, form.text.size() - 2)));
  }
  const auto number = as_number<double>(form.text);
  if (!number || !looks_numeric(form.text)) return std::nullopt;
  const bool is_integer = form.text.find_first_of(".eE") == form.text.npos;
  return is_integer ? ScriptValue::integer(*number)
                    : ScriptValue::real(*number);
}

class EntryReader {
 public:
  EntryReader(const Reading& reading, FormId form)
      : reading_(reading), form_(form), clauses_(reading, form, kEntryRules) {}

  std::optional<DeclaredEntry> read() {
    if (!read_name()) return std::nullopt;
    if (clauses_.is_given("states")) {
      if (clauses_.report_unknown(kStatesRules, "an entry with states")) {
        is_broken_ = true;
      }
      read_states();
    } else if (clauses_.is_given("min") || clauses_.is_given("max")) {
      if (clauses_.report_unknown(kNumberEntryRules, "a number"))
        is_broken_ = true;
      read_number();
    } else {
      read_first_value();
    }
    if (is_broken_) return std::nullopt;
    return std::move(entry_);
  }

 private:
  void error(SourceSpan span, std::string_view code, std::string message,
             std::string help = {}, std::string label = {}) {
    is_broken_ = true;
    reading_.error(span, code, std::move(message), std::move(label),
                   std::move(help));
  }

  bool read_name() {
    const Form* name = clauses_.first_item();
    if (!name || !name->is_word() || !is_entry_name(name->text)) {
      error(name ? name->span : reading_.forms.head(form_)->span, "BT1010",
            "an entry needs a name", "write `(defsv level :init 3)`");
      return false;
    }
    if (clauses_.items.size() > 1) {
      error(reading_.form(clauses_.items[1]).span, "BT1010",
            "this belongs to no keyword", "write `(defsv level :init 3)`");
    }
    entry_.entry = {std::string(name->text), name->span};
    return true;
  }

  const std::string& name() const { return entry_.entry.name; }

  // `(defsv level :init 3)`.
  void read_first_value() {
    if (clauses_.report_unknown(kFirstValueRules,
                                "an entry without `:max` or `:states`")) {
      is_broken_ = true;
      return;
    }
    const Clause* init = clauses_.find("init");
    if (!init) {
      is_broken_ = true;
      if (clauses_.is_given("init")) return;  // without a value
      return error(
          entry_.entry.span, "BT1006",
          fmt::format("`{}` needs `:init`, `:max` or `:states`", name()),
          "write `(defsv level :init 3)`, or `(defsv level :min 0 "
          ":max 100)`");
    }
    entry_.initial = value(clauses_.value(*init));
  }

  std::optional<ScriptValue> value(const Form& form) {
    auto value = value_of(form);
    if (!value) {
      error(form.span, "BT1008",
            fmt::format("`{}` is no number and no text in quotes", form.text),
            "write `(defsv level :init 3)`");
    }
    return value;
  }

  std::optional<int> integer(std::string_view keyword) {
    const Clause* clause = clauses_.find(keyword);
    if (!clause) return std::nullopt;
    const auto value = clauses_.integer(*clause, -kLargest, kLargest);
    is_broken_ |= !value;
    return value;
  }

  EntryDeclaration& declared() {
    if (!entry_.declaration) entry_.declaration.emplace();
    return *entry_.declaration;
  }

  void read_number() {
    const auto max = integer("max");
    const auto min = integer("min");
    if (!clauses_.find("max")) {
      return error(entry_.entry.span, "BT1006",
                   fmt::format("`{}` needs `:max`", name()),
                   "a number has `:min` and `:max`");
    }
    if (is_broken_) return;
    declared().domain.min = min.value_or(0);
    declared().domain.max = *max;
    if (declared().domain.min > *max) {
      return error(entry_.entry.span, "BT1010",
                   fmt::format("`{}` has no value between {} and {}", name(),
                               declared().domain.min, *max),
                   "`:min` must not be above `:max`");
    }
    if (const Clause* init = clauses_.find("init")) {
      const auto first = clauses_.integer(
          *init, static_cast<int>(declared().domain.min), *max);
      is_broken_ |= !first;
      if (first) entry_.initial = ScriptValue::integer(*first);
    }
    declared().is_free = false;
    read_moves();
  }

  // A word is a text.
  static ScriptValue state_value(const Form& form) {
    const auto value = value_of(form);
    return value ? *value : ScriptValue::of(std::string(form.text));
  }

  void read_states() {
    const Clause* clause = clauses_.find("states");
    if (!clause) {
      is_broken_ = true;
      return;
    }
    const Form& list = clauses_.value(*clause);
    if (!list.is_list() || list.items.empty()) {
      return error(list.span, "BT1010",
                   fmt::format("`{}` has no states", name()),
                   "write `:states (\"low\" \"high\")`");
    }
    if (list.items.size() > kMostDeclaredStates) {
      return error(
          list.span, "BT1010",
          fmt::format("`{}` has {} states", name(), list.items.size()),
          fmt::format("at most {} can be declared", kMostDeclaredStates));
    }
    for (const FormId item : list.items) add_state(reading_.form(item));
    if (is_broken_) return;
    if (const Clause* init = clauses_.find("init")) {
      const auto first = state(clauses_.value(*init));
      if (first) entry_.initial = states()[*first];
    }
    read_transitions();
    read_moves();
  }

  std::vector<ScriptValue>& states() { return declared().domain.states; }

  void add_state(const Form& form) {
    if (form.is_list() || form.text.starts_with(':')) {
      return error(form.span, "BT1010", "a state is a text or a number",
                   "write `:states (\"low\" \"high\")`");
    }
    const ScriptValue value = state_value(form);
    if (!states().empty() && value.is_number() != states()[0].is_number()) {
      return error(form.span, "BT1010",
                   fmt::format("`{}` has texts and numbers as states", name()),
                   "an entry keeps its type: write all of them as one");
    }
    if (std::ranges::find(states(), value) != states().end()) {
      return error(form.span, "BT1011",
                   fmt::format("`{}` has two states {}", name(), form.text));
    }
    states().push_back(value);
  }

  std::optional<std::size_t> state(const Form& form) {
    if (!form.is_list()) {
      const auto found = std::ranges::find(states(), state_value(form));
      if (found != states().end()) {
        return static_cast<std::size_t>(found - states().begin());
      }
    }
    std::vector<std::string> names;
    for (const ScriptValue& each : states()) {
      names.push_back(each.kind == btcpp::ScriptKind::Text
                          ? each.text
                          : fmt::format("{}", each.number));
    }
    error(form.span, "BT1013",
          form.is_list()
              ? fmt::format("a state of `{}` is needed", name())
              : fmt::format("{} is not a state of `{}`", form.text, name()),
          nearest_or_all(form.text, names, "its states are"));
    return std::nullopt;
  }

  void read_transitions() {
    const Clause* clause = clauses_.find("transitions");
    if (!clause) return;
    const Form& list = clauses_.value(*clause);
    if (is_keyword(list, "all") || equal_ignoring_case(list.text, "all")) {
      return;
    }
    if (!list.is_list()) {
      return error(list.span, "BT1010", "transitions are pairs of states",
                   "write `:transitions :all` or `:transitions ((A B) (B C))`");
    }
    auto& pairs = declared().transitions.emplace();
    for (const FormId item : list.items) {
      const Form& pair = reading_.form(item);
      if (!pair.is_list() || pair.items.size() != 2) {
        error(pair.span, "BT1010", "a transition is a pair of states",
              "write `(low high)`");
        continue;
      }
      const auto from = state(reading_.form(pair.items[0]));
      const auto to = state(reading_.form(pair.items[1]));
      if (!from || !to || *from == *to) continue;
      const std::pair one(*from, *to);
      if (std::ranges::find(pairs, one) == pairs.end()) pairs.push_back(one);
    }
  }

  void read_moves() {
    const Clause* clause = clauses_.find("moves");
    if (!clause) return;
    const Form& word = clauses_.value(*clause);
    if (equal_ignoring_case(word.text, "free")) {
      declared().is_free = true;
    } else if (equal_ignoring_case(word.text, "sampled")) {
      declared().is_free = false;
    } else {
      error(word.span, "BT1008",
            fmt::format("`{}` is not a value of `:moves`", word.text), "",
            "`free` or `sampled` is needed");
    }
  }

  const Reading& reading_;
  FormId form_;
  Clauses clauses_;
  DeclaredEntry entry_;
  bool is_broken_ = false;
};

}  // namespace

bool is_entry_name(std::string_view word) {
  const auto tokens = btcpp::tokens_of(word);
  return tokens.size() == 2 && tokens[0].kind == btcpp::ScriptTokenKind::Name &&
         tokens[0].text == word;
}

std::optional<DeclaredEntry> declared_entry(const Reading& reading,
                                            FormId form) {
  return EntryReader(reading, form).read();
}

}  // namespace btcheck::btf

// SPDX-License-Identifier: MIT
//
// State variables: a number with its range, or an enumeration with its moves.
//
// A declaration with a mistake in it still declares its name, with whatever
// could be understood, so that its uses are not reported as unknown. The
// bounds are those of an explicit state space: 2^20 values of a number, 256
// states of an enumeration, whose transitions are written out in pairs.
#include "model/btf/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace btcheck::btf {
namespace {

constexpr int kLargest = 1'000'000'000;
constexpr long long kMostValues = 1 << 20;
constexpr std::size_t kMostStates = 256;
constexpr std::size_t kMostTransitions = 1'000'000;

constexpr std::array<KeywordRule, 3> kNumberRules = {
    {{"init"}, {"min"}, {"max"}}};
constexpr std::array<KeywordRule, 4> kEnumerationRules = {
    {{"init"},
     {"states", Takes::List},
     {"transitions", Takes::List},
     {"moves"}}};
constexpr std::array<KeywordRule, 6> kRules = {{{"init"},
                                                {"min"},
                                                {"max"},
                                                {"states", Takes::List},
                                                {"transitions", Takes::List},
                                                {"moves"}}};

// The states of one enumeration by their keys.
using StateMap = std::map<std::string, int, std::less<>>;

class Declaration {
 public:
  Declaration(const Reading& reading, FormId form)
      : reading_(reading),
        form_(form),
        parts_(take_apart(reading, form, kRules)) {}

  // Nothing when it does not even have a name.
  std::optional<StateVariable> read() {
    if (!read_name_word()) return std::nullopt;
    const bool is_enumeration = given("states");
    const auto of = fmt::format(
        "{} `{}`", is_enumeration ? "the enumeration" : "the number",
        variable_.name);
    if (is_enumeration) {
      report_unknown_keywords(reading_, parts_, kEnumerationRules, of);
      read_enumeration();
    } else {
      report_unknown_keywords(reading_, parts_, kNumberRules, of);
      read_number();
    }
    return std::move(variable_);
  }

  bool is_broken() const { return is_broken_; }
  StateMap take_states() { return std::move(states_); }

 private:
  bool read_name_word() {
    const Form* name =
        parts_.items.empty() ? nullptr : &reading_.form(parts_.items.front());
    if (!name || !name->is_word() || !is_name(name->text)) {
      error(name ? name->span : reading_.forms.head(form_)->span, "BT1010",
            "a state variable needs a name", "",
            "write `(defsv name :init 0 :min 0 :max 3)`");
      return false;
    }
    if (parts_.items.size() > 1) {
      error(reading_.form(parts_.items[1]).span, "BT1010",
            fmt::format("`{}` is followed by something that is no keyword",
                        name->text));
    }
    variable_.name = name->text;
    variable_.span = name->span;
    return true;
  }

  void read_number() {
    const auto min = integer("min");
    const auto max = integer("max");
    variable_.min = min.value_or(0);
    variable_.max = max.value_or(variable_.min);
    is_broken_ = !max || (!min && given("min"));
    if (!max && !given("max")) {
      error(variable_.span, "BT1006",
            fmt::format("`{}` needs `:max` or `:states`", variable_.name), "",
            "a number has `:min` and `:max`, an enumeration `:states`");
    }
    if (!is_broken_) check_range();
    read_initial_number();
  }

  void check_range() {
    const long long values =
        static_cast<long long>(variable_.max) - variable_.min + 1;
    if (values < 1) {
      error(variable_.span, "BT1010",
            fmt::format("`{}` has no value between {} and {}", variable_.name,
                        variable_.min, variable_.max),
            "", "`:min` must not be above `:max`");
      is_broken_ = true;
    } else if (values > kMostValues) {
      error(variable_.span, "BT1010",
            fmt::format("`{}` has {} values", variable_.name, values), "",
            fmt::format("at most {} can be explored; choose a coarser unit",
                        kMostValues));
      is_broken_ = true;
    }
  }

  void read_initial_number() {
    variable_.initial = variable_.min;
    const Clause* clause = find_clause(reading_, parts_, "init");
    if (!clause) return;
    const int least = is_broken_ ? -kLargest : variable_.min;
    const int most = is_broken_ ? kLargest : variable_.max;
    variable_.initial =
        read_integer(reading_, *clause, least, most).value_or(variable_.min);
  }

  void read_enumeration() {
    read_states();
    is_broken_ = variable_.states.empty();
    if (is_broken_) variable_.states.emplace_back("?");
    variable_.max = std::max(static_cast<int>(variable_.states.size()) - 1, 0);
    if (const Clause* clause = find_clause(reading_, parts_, "init")) {
      variable_.initial = state(reading_.form(*clause->value)).value_or(0);
    }
    read_transitions();
    read_moves();
  }

  void read_states() {
    const Clause* clause = find_clause(reading_, parts_, "states");
    if (!clause) return;
    const Form& list = reading_.form(*clause->value);
    if (!list.is_list() || list.items.empty()) {
      error(list.span, "BT1010",
            fmt::format("`{}` has no states", variable_.name), "",
            "write `:states (Good Low Critical)`");
      return;
    }
    if (list.items.size() > kMostStates) {
      error(
          list.span, "BT1010",
          fmt::format("`{}` has {} states", variable_.name, list.items.size()),
          "", fmt::format("at most {} can be declared", kMostStates));
      return;
    }
    for (const FormId item : list.items) add_state(reading_.form(item));
  }

  void add_state(const Form& word) {
    if (!word.is_word() || !is_name(word.text)) {
      error(word.span, "BT1010", "the name of a state must be a word");
      return;
    }
    const int value = static_cast<int>(variable_.states.size());
    if (!states_.emplace(name_key(word.text), value).second) {
      error(word.span, "BT1011",
            fmt::format("`{}` has two states `{}`", variable_.name, word.text),
            "upper and lower case do not distinguish them");
      return;
    }
    variable_.states.emplace_back(word.text);
  }

  std::optional<int> state(const Form& word) {
    const auto found = states_.find(name_key(word.text));
    if (!word.is_list() && found != states_.end()) {
      reading_.findings.case_warning(
          word.span, word.text,
          variable_.states[static_cast<std::size_t>(found->second)]);
      return found->second;
    }
    if (!is_broken_) unknown_state(word);
    return std::nullopt;
  }

  void unknown_state(const Form& word) {
    const std::string guess = did_you_mean(word.text, variable_.states);
    error(word.span, "BT1013",
          word.is_list()
              ? fmt::format("a state of `{}` is needed", variable_.name)
              : fmt::format("`{}` is not a state of `{}`", word.text,
                            variable_.name),
          "",
          guess.empty()
              ? fmt::format("its states are {}", listed(variable_.states))
              : guess);
  }

  void read_transitions() {
    const Clause* clause = find_clause(reading_, parts_, "transitions");
    const Form* list = clause ? &reading_.form(*clause->value) : nullptr;
    if (!list || is_keyword(*list, "all") ||
        equal_ignoring_case(list->text, "all")) {
      allow_all();
    } else if (!list->is_list()) {
      error(list->span, "BT1010", "transitions are pairs of states", "",
            "write `:transitions :all` or `:transitions ((A B) (B C))`");
    } else {
      for (const FormId item : list->items) add_transition(item);
    }
  }

  void allow_all() {
    const int count = static_cast<int>(variable_.states.size());
    for (int from = 0; from < count; ++from) {
      for (int to = 0; to < count; ++to) {
        if (from != to) variable_.transitions.emplace_back(from, to);
      }
    }
  }

  void add_transition(FormId item) {
    const Form& pair = reading_.form(item);
    if (!pair.is_list() || pair.items.size() != 2) {
      error(pair.span, "BT1010", "a transition is a pair of states", "",
            "write `(Good Low)`");
      return;
    }
    const auto from = state(reading_.form(pair.items[0]));
    const auto to = state(reading_.form(pair.items[1]));
    if (!from || !to || *from == *to) return;
    const std::size_t count = variable_.states.size();
    if (is_listed_.empty()) is_listed_.resize(count * count);
    const std::size_t at =
        static_cast<std::size_t>(*from) * count + static_cast<std::size_t>(*to);
    if (!is_listed_[at]) variable_.transitions.emplace_back(*from, *to);
    is_listed_[at] = true;
  }

  void read_moves() {
    const Clause* clause = find_clause(reading_, parts_, "moves");
    if (!clause) return;
    const Form& word = reading_.form(*clause->value);
    if (equal_ignoring_case(word.text, "free")) {
      variable_.moves = Moves::Free;
    } else if (equal_ignoring_case(word.text, "sampled")) {
      variable_.moves = Moves::Sampled;
    } else {
      error(word.span, "BT1008",
            fmt::format("`{}` is not a value of `:moves`", word.text),
            "`free` or `sampled` is needed");
    }
  }

  bool given(std::string_view name) const {
    return std::any_of(parts_.clauses.begin(), parts_.clauses.end(),
                       [&](const Clause& clause) {
                         return is_keyword(reading_.form(clause.keyword), name);
                       });
  }

  std::optional<int> integer(std::string_view name) {
    const Clause* clause = find_clause(reading_, parts_, name);
    if (!clause) return std::nullopt;
    return read_integer(reading_, *clause, -kLargest, kLargest);
  }

  void error(SourceSpan span, std::string_view code, std::string message,
             std::string label = {}, std::string help = {}) {
    reading_.findings.error(
        span, {code, std::move(message), std::move(label), std::move(help)});
  }

  const Reading& reading_;
  FormId form_;
  Parts parts_;
  StateVariable variable_;
  StateMap states_;
  std::vector<bool> is_listed_;
  bool is_broken_ = false;
};

std::string_view without_dollar(std::string_view word) {
  return word.starts_with('$') ? word.substr(1) : word;
}

}  // namespace

std::string name_key(std::string_view word) {
  std::string key(word);
  for (char& c : key) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return key;
}

void Variables::declare(const Reading& reading, FormId form) {
  Declaration declaration(reading, form);
  auto variable = declaration.read();
  if (!variable) return;
  const StateVariableId id{static_cast<std::uint32_t>(declared_.size())};
  const auto [entry, is_new] = by_name_.emplace(name_key(variable->name), id);
  if (!is_new) {
    const StateVariable& first = (*this)[entry->second];
    reading.findings.error(
        variable->span,
        {"BT1011",
         fmt::format("the state variable `{}` is declared twice",
                     variable->name),
         "declared again here",
         fmt::format("the first declaration is on line {}", first.span.line)});
    return;
  }
  transitions_ += variable->transitions.size();
  if (transitions_ > kMostTransitions) {
    reading.findings.error(
        variable->span,
        {"BT1002",
         fmt::format("the state variables have more than {} transitions",
                     kMostTransitions),
         "", "declare fewer states"});
    variable->transitions.clear();
  }
  declared_.push_back(*std::move(variable));
  states_.push_back(declaration.take_states());
  is_broken_.push_back(declaration.is_broken());
}

std::optional<StateVariableId> Variables::declared(const Form& word) const {
  const auto found = by_name_.find(name_key(without_dollar(word.text)));
  if (!word.is_word() || found == by_name_.end()) return std::nullopt;
  return found->second;
}

bool Variables::has_state(StateVariableId variable, const Form& word) const {
  return word.is_word() &&
         states_[index(variable)].contains(name_key(word.text));
}

std::optional<StateVariableId> Variables::find(const Reading& reading,
                                               const Form& word) const {
  const auto found = declared(word);
  if (found) {
    reading.findings.case_warning(word.span, without_dollar(word.text),
                                  (*this)[*found].name);
  }
  return found;
}

std::optional<int> Variables::find_state(const Reading& reading,
                                         StateVariableId variable,
                                         const Form& word) const {
  if (!has_state(variable, word)) return std::nullopt;
  const int value = states_[index(variable)].find(name_key(word.text))->second;
  reading.findings.case_warning(word.span, word.text,
                                (*this)[variable].value_name(value));
  return value;
}

void Variables::report_unknown(const Reading& reading, const Form& word) const {
  std::vector<std::string> names;
  for (const StateVariable& variable : declared_) {
    names.push_back(variable.name);
  }
  const std::string_view name = without_dollar(word.text);
  const std::string guess = did_you_mean(name, names);
  reading.findings.error(
      word.span,
      {"BT1012", fmt::format("unknown state variable `{}`", name), "",
       !guess.empty()  ? guess
       : names.empty() ? fmt::format("declare it: `(defsv {} ...)`", name)
                       : fmt::format("there are {}", listed(names))});
}

}  // namespace btcheck::btf

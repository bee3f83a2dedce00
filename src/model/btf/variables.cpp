// SPDX-License-Identifier: MIT
//
// A declaration with a mistake in it still declares its name, with whatever
// could be understood, so that its uses are not reported as unknown. A number
// has at most 32 bits, counted in its steps, an enumeration 256 states, whose
// transitions are written out in pairs.
#include "model/btf/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace btcheck::btf {
namespace {

constexpr std::size_t kMostTransitions = 1'000'000;

constexpr std::array<KeywordRule, 5> kNumberRules = {
    {{"init"}, {"min"}, {"max"}, {"step"}, {"moves"}}};
constexpr std::array<KeywordRule, 7> kRules = {{{"min"},
                                                {"max"},
                                                {"step"},
                                                {"init"},
                                                {"states", Takes::List},
                                                {"transitions", Takes::List},
                                                {"moves"}}};
constexpr std::span<const KeywordRule> kEnumerationRules =
    std::span(kRules).subspan(3);

class Declaration {
 public:
  Declaration(const Reading& reading, FormId form)
      : reading_(reading), form_(form), clauses_(reading, form, kRules) {}

  // Nothing when it does not even have a name.
  std::optional<Declared> read() {
    if (!read_name_word()) return std::nullopt;
    if (clauses_.is_given("states")) {
      clauses_.report_unknown(
          kEnumerationRules,
          fmt::format("the enumeration `{}`", variable_.name));
      read_enumeration();
    } else {
      clauses_.report_unknown(kNumberRules,
                              fmt::format("the number `{}`", variable_.name));
      read_number();
    }
    return std::move(result_);
  }

 private:
  bool read_name_word() {
    const Form* name = clauses_.first_item();
    if (!name || !name->is_word() || !is_name(name->text)) {
      error(name ? name->span : reading_.forms.head(form_)->span,
            "a state variable needs a name",
            "write `(defsv name :init 0 :min 0 :max 3)`");
      return false;
    }
    if (clauses_.items.size() > 1) {
      error(reading_.form(clauses_.items[1]).span,
            fmt::format("`{}` is followed by something that is no keyword",
                        name->text));
    }
    variable_.name = name->text;
    variable_.span = name->span;
    return true;
  }

  // A contradiction in the declaration.
  void error(SourceSpan span, std::string message, std::string help = {}) {
    reading_.error(span, "BT1010", std::move(message), "", std::move(help));
  }

  void read_step() {
    const Clause* clause = clauses_.find("step");
    if (!clause) return;
    const auto step = decimal(*clause);
    if (step && step->digits > 0) {
      variable_.scale = {step->digits, step->decimals};
    } else {
      clauses_.report_value(*clause, "a number above 0 is needed",
                            "write `:step 0.1`");
      is_broken_ = true;
    }
  }

  std::optional<Decimal> decimal(const Clause& clause) const {
    const Form& word = clauses_.value(clause);
    return word.is_word() ? decimal_number(word.text) : std::nullopt;
  }

  // The most that a number of the variable's scale counts up to.
  int largest() const {
    const Scale& scale = variable_.scale;
    return (scale.decimals > 0 ? kLargestScaled : kLargest) / scale.step;
  }

  // The value of a clause, counted in steps.
  std::optional<int> counted(const Clause& clause, int least, int most) const {
    const Scale& scale = variable_.scale;
    const auto number = decimal(clause);
    if (scale.is_one() && number && number->decimals > 0) {
      clauses_.report_value(clause, "this number is whole",
                            "with decimals it has a step: `:step 0.1`");
      return std::nullopt;
    }
    if (scale.is_one()) return clauses_.integer(clause, least, most);
    const auto value =
        number ? bound_of(Operation::Equal, scale, *number) : std::nullopt;
    if (value && *value >= least && *value <= most) {
      return static_cast<int>(*value);
    }
    clauses_.report_value(
        clause,
        fmt::format("a multiple of {} from {} to {} is needed", scale.text(1),
                    scale.text(least), scale.text(most)));
    return std::nullopt;
  }

  std::optional<int> bound(std::string_view name) {
    const Clause* clause = clauses_.find(name);
    if (!clause) return std::nullopt;
    return counted(*clause, -largest(), largest());
  }

  void read_number() {
    read_step();
    if (is_broken_) return;
    const auto min = bound("min");
    const auto max = bound("max");
    variable_.min = min.value_or(0);
    variable_.max = max.value_or(variable_.min);
    is_broken_ = !max || (!min && clauses_.is_given("min"));
    if (!max && !clauses_.is_given("max")) {
      reading_.error(
          variable_.span, "BT1006",
          fmt::format("`{}` needs `:max` or `:states`", variable_.name), "",
          "a number has `:min` and `:max`, an enumeration `:states`");
    }
    if (!is_broken_) check_range();
    read_initial_number();
    read_moves();
  }

  void check_range() {
    if (variable_.min > variable_.max) {
      error(variable_.span,
            fmt::format("`{}` has no value between {} and {}", variable_.name,
                        variable_.value_name(variable_.min),
                        variable_.value_name(variable_.max)),
            "`:min` must not be above `:max`");
      is_broken_ = true;
    }
  }

  void read_initial_number() {
    variable_.initial = variable_.min;
    const Clause* clause = clauses_.find("init");
    if (!clause) return;
    const int least = is_broken_ ? -largest() : variable_.min;
    const int most = is_broken_ ? largest() : variable_.max;
    variable_.initial = counted(*clause, least, most).value_or(variable_.min);
  }

  void read_enumeration() {
    read_states();
    is_broken_ = variable_.states.empty();
    if (is_broken_) variable_.states.emplace_back("?");
    variable_.max = std::max(static_cast<int>(variable_.states.size()) - 1, 0);
    if (const Clause* clause = clauses_.find("init")) {
      variable_.initial = state(clauses_.value(*clause)).value_or(0);
    }
    read_moves();
    read_transitions();
  }

  void read_states() {
    const Clause* clause = clauses_.find("states");
    if (!clause) return;
    const Form& list = clauses_.value(*clause);
    if (!list.is_list() || list.items.empty()) {
      error(list.span, fmt::format("`{}` has no states", variable_.name),
            "write `:states (Good Low Critical)`");
      return;
    }
    if (list.items.size() > kMostDeclaredStates) {
      error(
          list.span,
          fmt::format("`{}` has {} states", variable_.name, list.items.size()),
          fmt::format("at most {} can be declared", kMostDeclaredStates));
      return;
    }
    for (const FormId item : list.items) add_state(reading_.form(item));
  }

  void add_state(const Form& word) {
    if (!word.is_word() || !is_name(word.text)) {
      error(word.span, "the name of a state must be a word");
      return;
    }
    const int value = static_cast<int>(variable_.states.size());
    if (!result_.states.emplace(name_key(word.text), value).second) {
      reading_.error(
          word.span, "BT1011",
          fmt::format("`{}` has two states `{}`", variable_.name, word.text),
          "upper and lower case do not distinguish them");
      return;
    }
    variable_.states.emplace_back(word.text);
  }

  std::optional<int> state(const Form& word) {
    const auto found = result_.states.find(name_key(word.text));
    if (!word.is_list() && found != result_.states.end()) {
      reading_.findings.case_warning(
          word.span, word.text,
          variable_.states[static_cast<std::size_t>(found->second)]);
      return found->second;
    }
    if (!is_broken_) report_unknown_state(reading_, word, variable_);
    return std::nullopt;
  }

  void read_transitions() {
    const Clause* clause = clauses_.find("transitions");
    const Form* list = clause ? &clauses_.value(*clause) : nullptr;
    if (!list || is_keyword(*list, "all") ||
        equal_ignoring_case(list->text, "all")) {
      allow_all();
    } else if (!list->is_list()) {
      error(list->span, "transitions are pairs of states",
            "write `:transitions :all` or `:transitions ((A B) (B C))`");
    } else {
      for (const FormId item : list->items) add_transition(item);
      check_times();
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
    const std::size_t count = pair.items.size();
    if (!pair.is_list() || count < 2 || count > 3) {
      error(pair.span, "a transition is a pair of states",
            "write `(Good Low)`, or with a time `(Good Low [3,5])`");
      return;
    }
    const auto from = state(reading_.form(pair.items[0]));
    const auto to = state(reading_.form(pair.items[1]));
    const auto time = count == 3 ? read_time(pair.items[2]) : kAnyDuration;
    if (!from || !to || !time) return;
    has_times_ |= count == 3;
    if (count == 3 && *from == *to) {
      return error(pair.span, "a state does not move to itself",
                   "what is never left has no transition");
    }
    if (*from == *to) return;
    const auto [known, is_new] =
        listed_.emplace(std::pair(*from, *to), variable_.transitions.size());
    if (is_new) {
      variable_.transitions.emplace_back(*from, *to);
      variable_.lasting.push_back(*time);
    } else if (*time != variable_.lasting[known->second]) {
      error(pair.span, "this transition is given twice, with another time",
            "delete one of them");
    }
  }

  std::optional<Duration> read_time(FormId form) {
    const auto time = read_duration(reading_, form, "the time of a transition");
    if (!time || time->max > 0) return time;
    error(reading_.form(form).span, "a state lasts for a tick at least",
          "with `[0,1]` it is left in the tick after the one in which it is "
          "entered, or before");
    return std::nullopt;
  }

  // A transition that comes after its state has been left for certain.
  void check_times() {
    if (!has_times_) return variable_.lasting.clear();
    if (variable_.moves == Moves::Sampled) {
      error(variable_.span, "only a free variable moves in its own time",
            "write `:moves free`, or leave the times out");
    }
    std::map<int, std::size_t> soonest;  // by state, the first to be forced
    for (std::size_t i = 0; i < variable_.transitions.size(); ++i) {
      const auto [known, is_new] =
          soonest.emplace(variable_.transitions[i].first, i);
      if (variable_.lasting[i].max < variable_.lasting[known->second].max) {
        known->second = i;
      }
    }
    for (std::size_t i = 0; i < variable_.transitions.size(); ++i) {
      const std::size_t forced = soonest.at(variable_.transitions[i].first);
      if (variable_.lasting[forced].max < variable_.lasting[i].min) {
        refuse_late(i, forced);
      }
    }
  }

  void refuse_late(std::size_t late, std::size_t forced) {
    const auto name_of = [&](int state) { return variable_.value_name(state); };
    const auto& [from, to] = variable_.transitions[late];
    error(variable_.span,
          fmt::format("`{}` never moves from `{}` to `{}`", variable_.name,
                      name_of(from), name_of(to)),
          fmt::format("after {} ticks it has moved to `{}`",
                      variable_.lasting[forced].max,
                      name_of(variable_.transitions[forced].second)));
  }

  void read_moves() {
    const Clause* clause = clauses_.find("moves");
    if (!clause) return;
    const Form& word = clauses_.value(*clause);
    if (equal_ignoring_case(word.text, "free")) {
      variable_.moves = Moves::Free;
    } else if (equal_ignoring_case(word.text, "sampled")) {
      variable_.moves = Moves::Sampled;
    } else {
      reading_.error(word.span, "BT1008",
                     fmt::format("`{}` is not a value of `:moves`", word.text),
                     "`free` or `sampled` is needed");
    }
  }

  const Reading& reading_;
  FormId form_;
  Clauses clauses_;
  Declared result_;
  StateVariable& variable_ = result_.variable;
  bool& is_broken_ = result_.is_broken;
  // Where each transition stands among all.
  std::map<std::pair<int, int>, std::size_t> listed_;
  bool has_times_ = false;  // some transition
};

}  // namespace

std::span<const KeywordRule> variable_keywords() { return kRules; }

void report_unknown_state(const Reading& reading, const Form& word,
                          const StateVariable& variable) {
  reading.error(
      word.span, "BT1013",
      word.is_list() ? fmt::format("a state of `{}` is needed", variable.name)
                     : fmt::format("`{}` is not a state of `{}`", word.text,
                                   variable.name),
      "", nearest_or_all(word.text, variable.states, "its states are"));
}

void Variables::declare(const Reading& reading, FormId form) {
  auto declared = Declaration(reading, form).read();
  if (!declared) return;
  StateVariable& variable = declared->variable;
  const StateVariableId id{static_cast<std::uint32_t>(all_.size())};
  const auto [entry, is_new] = by_name_.emplace(name_key(variable.name), id);
  if (!is_new) {
    reading.error(
        variable.span, "BT1011",
        fmt::format("the state variable `{}` is declared twice", variable.name),
        "declared again here",
        fmt::format("the first declaration is on line {}",
                    (*this)[entry->second].span.line));
    return;
  }
  transitions_ += variable.transitions.size();
  if (transitions_ > kMostTransitions) {
    reading.error(
        variable.span, "BT1002",
        fmt::format("the state variables have more than {} transitions",
                    kMostTransitions),
        "", "declare fewer states");
    variable.transitions.clear();
    variable.lasting.clear();
  }
  all_.push_back(*std::move(declared));
}

std::vector<StateVariable> Variables::take() {
  std::vector<StateVariable> variables;
  for (Declared& each : all_) variables.push_back(std::move(each.variable));
  return variables;
}

std::optional<StateVariableId> Variables::declared(const Form& word) const {
  return word.is_word() ? declared(without_dollar(word.text)) : std::nullopt;
}

std::optional<StateVariableId> Variables::declared(
    std::string_view name) const {
  const auto found = by_name_.find(name_key(name));
  if (found == by_name_.end()) return std::nullopt;
  return found->second;
}

bool Variables::has_state(StateVariableId variable, const Form& word) const {
  return word.is_word() &&
         all_[index(variable)].states.contains(name_key(word.text));
}

std::optional<StateVariableId> Variables::find(const Reading& reading,
                                               const Form& word) const {
  const std::string_view name = without_dollar(word.text);
  const auto found = declared(word);
  if (found) {
    reading.findings.case_warning(word.span, name, (*this)[*found].name);
    return found;
  }
  const std::vector<std::string> names = this->names();
  reading.error(
      word.span, "BT1012", fmt::format("unknown state variable `{}`", name), "",
      names.empty() ? fmt::format("declare it: `(defsv {} ...)`", name)
                    : nearest_or_all(name, names));
  return std::nullopt;
}

std::vector<std::string> Variables::names() const {
  std::vector<std::string> names;
  for (const Declared& each : all_) names.push_back(each.variable.name);
  return names;
}

std::optional<int> Variables::find_state(const Reading& reading,
                                         StateVariableId variable,
                                         const Form& word) const {
  if (!has_state(variable, word)) return std::nullopt;
  const int value =
      all_[index(variable)].states.find(name_key(word.text))->second;
  reading.findings.case_warning(word.span, word.text,
                                (*this)[variable].value_name(value));
  return value;
}

}  // namespace btcheck::btf

// SPDX-License-Identifier: MIT
//
// A program is executed term by term, with one value for each entry. Where only
// the program around the tree knows a value, all that depends on it is unknown
// too, and may throw.
#include "model/btcpp/tree/entry_programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/entries/run.hpp"
#include "model/tree/releases.hpp"
#include "text/numbers.hpp"

namespace btcheck::btcpp {
namespace {

using Values = std::vector<ScriptValue>;

// What a term has come to.
struct Result {
  ScriptValue value = ScriptValue::any();
  bool may_throw = false;
  bool may_yield = true;
};

Result result_of(const ScriptOutcome& outcome) {
  Result result;
  result.may_throw = outcome.may_throw;
  result.may_yield = !outcome.values.empty();
  if (outcome.values.size() == 1) {
    result.value = outcome.values[0];
  } else if (result.may_yield) {
    ScriptOptions options;
    for (const ScriptValue& each : outcome.values) {
      add_option(options, each, ScriptGuard::always());
    }
    result.value = merged(options);
  }
  return result;
}

// A value that an entry is declared not to hold ends the run.
Result within(const ProgramEntry& entry, Result result) {
  if (!entry.limits) return result;
  const auto held = entry.limits->held(result.value);
  if (!held) return {{}, true, false};
  result.value = *held;
  result.may_throw |= DeclaredDomain::may_leave(*held);
  return result;
}

class ScriptExecution {
 public:
  ScriptExecution(const EntryPrograms& programs, const EntryProgram& program,
                  Values& values)
      : programs_(programs), program_(program), values_(values) {}

  Result run() {
    Result last;
    for (const std::uint32_t statement : program_.tree.statements) {
      last = evaluate(statement);
      may_throw_ |= last.may_throw;
      if (!last.may_yield) break;
    }
    last.may_throw = may_throw_;
    return last;
  }

  // Something in it depends on an enumerator that is not declared.
  bool rests_on_enumerator() const { return rests_on_enumerator_; }

 private:
  const ScriptTerm& term(std::uint32_t number) const {
    return program_.tree.terms[number];
  }

  Result evaluate(std::uint32_t number) {
    const ScriptTerm& of = term(number);
    switch (of.operation) {
      case ScriptOperation::Number:
        return number_of(of);
      case ScriptOperation::Text:
        return {ScriptValue::of(of.text)};
      case ScriptOperation::Name:
        return read(program_.names[number]);
      case ScriptOperation::Negate:
      case ScriptOperation::Complement:
      case ScriptOperation::Not:
        return prefix(of);
      case ScriptOperation::Compare:
        return comparison(of);
      case ScriptOperation::Choose:
        return choice(of);
      default:
        return is_assignment(of.operation) ? assignment(number) : binary(of);
    }
  }

  Result number_of(const ScriptTerm& of) const {
    if (!of.number) return {};
    return {of.is_integer
                ? read_in(program_.tree, ScriptValue::integer(*of.number))
                : ScriptValue::real(*of.number)};
  }

  Result read(EntryNumber entry) {
    const ScriptValue& value = values_[entry];
    const bool is_enumerator =
        programs_.entries[entry].is_enumerator || value.is_enumerator();
    rests_on_enumerator_ |= is_enumerator;
    if (is_enumerator) return {ScriptValue::enumerator(), true};
    if (programs_.entries[entry].is_foreign) {
      return {ScriptValue::any(), true};
    }
    if (value.kind == ScriptKind::Unset) return {{}, true, false};
    if (value.kind == ScriptKind::Unknown) return {ScriptValue::any(), true};
    return {read_in(program_.tree, value.as(EntryType::Free))};
  }

  // What an operator makes of operands that may throw themselves.
  template <class Apply>
  Result applied(const Result& left, const Result& right, Apply apply) {
    if (!left.may_yield || !right.may_yield) return {{}, true, false};
    Result result = result_of(apply(left.value, right.value));
    const auto is_beside = [](const ScriptValue& text,
                              const ScriptValue& number) {
      return text.kind == ScriptKind::Text && number.is_number() &&
             may_be_enumerator(text.text);
    };
    rests_on_enumerator_ |=
        result.may_throw && (is_beside(left.value, right.value) ||
                             is_beside(right.value, left.value));
    result.may_throw |= left.may_throw || right.may_throw;
    return result;
  }

  Result prefix(const ScriptTerm& of) {
    return applied(evaluate(of.operands[0]), Result{},
                   [&](const ScriptValue& value, const ScriptValue&) {
                     return prefix_in(program_.tree, of.operation, value);
                   });
  }

  Result binary(const ScriptTerm& of) {
    const Result left = evaluate(of.operands[0]);
    if (!left.may_yield) return left;
    const Result right = evaluate(of.operands[1]);
    return applied(left, right,
                   [&](const ScriptValue& one, const ScriptValue& other) {
                     return apply_binary(of.operation, one, other);
                   });
  }

  // Ends at the first comparison that fails; where one is open, what stands
  // behind may be executed or not.
  Result comparison(const ScriptTerm& of) {
    Result left = evaluate(of.operands[0]);
    if (!left.may_yield) return left;
    bool may_throw = left.may_throw;
    bool may_fail = false;
    for (std::size_t i = 0; i < of.comparisons.size(); ++i) {
      const Values before = values_;
      Result right = evaluate(of.operands[i + 1]);
      if (may_fail) join(before);
      may_throw |= right.may_throw;
      if (!right.may_yield) return {ScriptValue::of(false), true, may_fail};
      const Result step = applied(
          left, right, [&](const ScriptValue& one, const ScriptValue& other) {
            return compare_in(program_.tree, of.comparisons[i], one, other);
          });
      may_throw |= step.may_throw;
      if (!step.may_yield) return {ScriptValue::of(false), true, may_fail};
      const ScriptTruth truth = truth_of(step.value);
      if (!truth.may_hold) return {ScriptValue::of(false), may_throw};
      may_fail |= truth.may_fail;
      left = std::move(right);
    }
    if (may_fail) return {ScriptValue::any(), may_throw};
    return {ScriptValue::of(true), may_throw};
  }

  Result choice(const ScriptTerm& of) {
    const Result condition = evaluate(of.operands[0]);
    if (!condition.may_yield) return condition;
    const ScriptTruth truth = choice_in(program_.tree, condition.value);
    const bool may_throw = condition.may_throw || truth.may_throw;
    if (!truth.may_hold && !truth.may_fail) return {{}, true, false};
    Result result;
    if (truth.may_hold && truth.may_fail) {
      const Values before = values_;
      evaluate(of.operands[1]);
      const Values after_one = std::exchange(values_, before);
      evaluate(of.operands[2]);
      join(after_one);
      result.may_throw = true;
    } else {
      result = evaluate(of.operands[truth.may_hold ? 1 : 2]);
    }
    result.may_throw |= may_throw;
    return result;
  }

  // What may be as it is now or as it was.
  void join(const Values& other) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (values_[i] == other[i]) continue;
      const bool is_alike = values_[i].noted == other[i].noted;
      const ScriptValue open = rests_on_enumerator_ ? ScriptValue::enumerator()
                                                    : ScriptValue::lost();
      values_[i] = open.as(is_alike ? other[i].noted : EntryType::Other);
    }
  }

  Result assignment(std::uint32_t number) {
    const ScriptTerm& of = term(number);
    const EntryNumber entry = program_.names[of.operands[0]];
    const bool creates = of.operation == ScriptOperation::Create;
    const bool is_free =
        programs_.entries[entry].is_foreign || program_.is_of_contract;
    const ScriptKind before = values_[entry].kind;
    if (!is_free && !creates && before == ScriptKind::Unset) {
      return {{}, true, false};
    }
    const Result by = evaluate(of.operands[1]);
    if (!by.may_yield) return by;
    if (program_.is_of_contract && of.operation <= ScriptOperation::Set) {
      Result written = result_of(written_by_leaf(of.operands[0], by.value));
      written.may_throw |= by.may_throw;
      return kept(entry, std::move(written));
    }
    if (is_free) return {ScriptValue::any(), true};
    // It has the type that its ports say before anything has written it.
    ScriptValue held = values_[entry];
    if (before == ScriptKind::Unknown) {
      held = held.as(programs_.entries[entry].declared);
    }
    Result result = of.operation <= ScriptOperation::Set
                        ? result_of(assign_in(program_.tree, held, by.value))
                        : result_of(apply_change(of.operation, held, by.value));
    const bool may_lack = before == ScriptKind::Unknown && !creates;
    result.may_throw |= by.may_throw || may_lack;
    return kept(entry, std::move(result));
  }

  // What the entry holds then.
  Result kept(EntryNumber entry, Result result) {
    if (!result.may_yield) return result;
    result = within(programs_.entries[entry], std::move(result));
    if (result.may_yield) values_[entry] = result.value;
    return result;
  }

  ScriptOutcome written_by_leaf(std::uint32_t name,
                                const ScriptValue& by) const {
    const EntryNumber entry = program_.names[name];
    const ProgramEntry& facts = programs_.entries[entry];
    ScriptValue now = values_[entry];
    const bool is_unknown = now.kind == ScriptKind::Unknown;
    if (is_unknown) now = now.as(facts.declared);
    if (!facts.is_typed_by_leaves && !has_type(now)) return {{by}, false};
    const bool exists =
        is_unknown ? facts.exists : now.kind != ScriptKind::Unset;
    return btcpp::written_by_leaf(
        now, {exists, static_cast<bool>(program_.is_own_name[name])}, by);
  }

  const EntryPrograms& programs_;
  const EntryProgram& program_;
  Values& values_;
  bool may_throw_ = false;
  bool rests_on_enumerator_ = false;
};

// Whether a script that comes out so may come out otherwise as well. One that
// ends is taken to find what it reads.
bool is_one_of_several(const Result& result, bool is_condition,
                       ScriptOutcomeKind outcome) {
  if (outcome == ScriptOutcomeKind::Throws) return result.may_yield;
  if (!is_condition) return false;
  const ScriptTruth truth = truth_of(result.value);
  return truth.may_hold && truth.may_fail;
}

bool comes_out(const Result& result, bool is_condition,
               ScriptOutcomeKind wanted) {
  if (wanted == ScriptOutcomeKind::Throws) {
    return result.may_throw ||
           (is_condition && truth_of(result.value).may_throw);
  }
  if (!result.may_yield) return false;
  if (wanted == ScriptOutcomeKind::Ends) return true;
  const ScriptTruth truth = truth_of(result.value);
  return wanted == ScriptOutcomeKind::Holds ? truth.may_hold : truth.may_fail;
}

ScriptValue value_in(const EntryPrograms& programs,
                     const ProgramOperand& operand, const Values& values) {
  if (!operand.entry) {
    return ScriptValue::of(operand.text).as(EntryType::Text);
  }
  const ProgramEntry& entry = programs.entries[*operand.entry];
  if (entry.is_foreign) return ScriptValue::any().as(EntryType::Other);
  const ScriptValue& value = values[*operand.entry];
  return value.kind == ScriptKind::Unknown ? value.as(entry.declared) : value;
}

// SetBlackboard; Ends where it succeeds, Fails where there is nothing to copy.
bool set(const EntryPrograms& programs, const EntryProgram& program,
         ScriptOutcomeKind wanted, Values& values) {
  const ScriptValue source = value_in(programs, program.right, values);
  const bool is_open = source.kind == ScriptKind::Unknown ||
                       (source.kind == ScriptKind::Any && program.right.entry);
  const bool copies =
      program.right.entry && releases::copies_anything(programs.release);
  const bool is_read =
      program.right.entry && releases::copies_text(programs.release);
  if (wanted == ScriptOutcomeKind::Fails) {
    return !copies && !is_read && (is_open || source.kind == ScriptKind::Empty);
  }
  const EntryNumber target = *program.left.entry;
  const ProgramEntry& entry = programs.entries[target];
  if (source.kind == ScriptKind::Unset || (is_read && source.is_nothing())) {
    return wanted == ScriptOutcomeKind::Throws;
  }
  if (wanted == ScriptOutcomeKind::Throws && is_read &&
      source.kind == ScriptKind::Unknown) {
    return true;
  }
  if (entry.is_foreign) return true;
  const ScriptValue held = value_in(programs, program.left, values);
  const bool exists = held.kind == ScriptKind::Unknown
                          ? entry.exists
                          : held.kind != ScriptKind::Unset;
  if (source.kind == ScriptKind::Empty && !copies) return false;
  const Result result =
      within(entry, result_of(apply_setting_in(
                        programs.release, program.right.entry.has_value(), held,
                        {exists, program.is_own}, source)));
  if (wanted == ScriptOutcomeKind::Throws) return result.may_throw;
  if (result.may_yield) values[target] = result.value;
  return result.may_yield;
}

// How values of ports are compared. After src/controls/switch_node.cpp of 4.10,
// and of 3.8.8 the header files controls/switch_node.h and
// decorators/blackboard_precondition.h, which read a port as convertFromString
// does (src/basic_types.cpp).

constexpr Equality kEqual{true, false};
constexpr Equality kDifferent{false, true};
constexpr Equality kPerhaps{true, true};

// The number of a declared enumerator.
std::optional<int> number_of(const std::string& text,
                             const ScriptEnums* enums) {
  if (enums == nullptr) return std::nullopt;
  const auto found = enums->find(text);
  return found == enums->end() ? std::nullopt : std::optional(found->second);
}

// Up to 4.9 the numbers that the texts begin with.
bool is_same_beginning(const std::string& one, const std::string& other,
                       const ScriptEnums* enums) {
  if (one == other) return true;
  const auto whole_in = [&](const std::string& text) {
    const auto number = number_of(text, enums);
    return number ? number : begun_number<int>(text);
  };
  const auto whole = whole_in(one);
  const auto whole_other = whole_in(other);
  if (whole && whole_other) return *whole == *whole_other;
  const auto left = begun_number<double>(one);
  const auto right = begun_number<double>(other);
  return left && right && is_same_number(*left, *right);
}

bool is_same_case(const std::string& one, const std::string& other,
                  const ScriptEnums* enums) {
  if (one == other) return true;
  const auto real_in = [&](const std::string& text) {
    const auto number = number_of(text, enums);
    return number ? std::optional<double>(*number) : as_number<double>(text);
  };
  const auto left = real_in(one);
  const auto right = real_in(other);
  return left && right && is_same_number(*left, *right);
}

// As std::stoi and std::stod do: blanks before it, anything behind it.
std::optional<int> begun_int(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const long number = std::strtol(text.c_str(), &end, 10);
  const bool fits = errno == 0 && number >= std::numeric_limits<int>::min() &&
                    number <= std::numeric_limits<int>::max();
  if (end == text.c_str() || !fits) return std::nullopt;
  return static_cast<int>(number);
}

std::optional<double> begun_double(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || errno == ERANGE) return std::nullopt;
  return number;
}

bool is_equal(PortComparison how, const std::string& one,
              const std::string& other, const ScriptEnums* enums) {
  const auto are = [](const auto& left, const auto& right) {
    return left && right && *left == *right;
  };
  switch (how) {
    case PortComparison::Switch:
      return is_same_case(one, other, enums);
    case PortComparison::OldSwitch:
      return is_same_beginning(one, other, enums);
    case PortComparison::Text:
      return one == other;
    case PortComparison::Int:
      return are(begun_int(one), begun_int(other));
    case PortComparison::Bool:
      return are(parse_bool(one), parse_bool(other));
    case PortComparison::ExactDouble:
      return are(begun_double(one), begun_double(other));
    case PortComparison::Double:
      break;
  }
  const auto left = begun_double(one);
  const auto right = begun_double(other);
  return left && right && is_same_number(*left, *right);
}

bool may_contain(const ScriptValue& range, const ScriptValue& value,
                 const ScriptEnums* enums) {
  const auto number_in = [&](const std::string& text) {
    const auto number = number_of(text, enums);
    return number ? std::optional<double>(*number) : btcpp::number_in(text);
  };
  const auto number = value.kind == ScriptKind::Text
                          ? number_in(value.text)
                          : std::optional<double>(value.number);
  if (!number || value.is_range()) return number.has_value();
  constexpr double kNear = 1e-6;
  return range.kind == ScriptKind::AtLeast ? *number >= range.number - kNear
                                           : *number <= range.number + kNear;
}

bool is_number_or_text(const ScriptValue& value) {
  return value.kind == ScriptKind::Text || value.kind == ScriptKind::Number;
}

// Not a number: texts are compared first, and two names are two enumerators.
bool is_open_name(const ScriptValue& value, const ScriptEnums* enums) {
  return value.kind == ScriptKind::Text && may_be_enumerator(value.text) &&
         !number_of(value.text, enums);
}

bool is_number(const ScriptValue& value) {
  return value.is_number() ||
         (value.kind == ScriptKind::Text && begun_number<double>(value.text));
}

}  // namespace

bool is_beside_enumerator(PortComparison how, const ScriptValue& one,
                          const ScriptValue& other, const ScriptEnums* enums) {
  const bool knows_names =
      how == PortComparison::Switch || how == PortComparison::OldSwitch;
  const auto is_open = [&](const ScriptValue& name, const ScriptValue& number) {
    return is_open_name(name, enums) && is_number(number);
  };
  return knows_names && (is_open(one, other) || is_open(other, one));
}

Equality compared(PortComparison how, const ScriptValue& one,
                  const ScriptValue& other, const ScriptEnums* enums) {
  if (one.is_nothing() || other.is_nothing()) return kDifferent;
  if (is_beside_enumerator(how, one, other, enums)) return kPerhaps;
  const auto is_unsure = [](const ScriptValue& value) {  // "-nan", too
    return value.kind == ScriptKind::NotANumber ||
           (!is_number_or_text(value) && !value.is_range());
  };
  if (is_unsure(one) || is_unsure(other)) return kPerhaps;
  if (is_number_or_text(one) && is_number_or_text(other)) {
    return is_equal(how, printed(one), printed(other), enums) ? kEqual
                                                              : kDifferent;
  }
  const bool may_be = is_number_or_text(one) ? may_contain(other, one, enums)
                                             : may_contain(one, other, enums);
  return may_be ? kPerhaps : kDifferent;
}

namespace {

// An integer or a whole double, and not too large for its 32 bits.
bool fits(PortType type, double number) {
  const bool is_unsigned = type == PortType::Unsigned;
  const double least = is_unsigned ? 0 : std::numeric_limits<int>::min();
  const double most = is_unsigned ? std::numeric_limits<std::uint32_t>::max()
                                  : std::numeric_limits<int>::max();
  return is_integer(number) && number >= least && number <= most;
}

// Whole numbers that a tree counts up or down to are not taken to leave 32
// bits.
PortReading read_range(PortType type, const ScriptValue& range) {
  const bool is_unsigned = type == PortType::Unsigned;
  const bool is_up = range.kind == ScriptKind::AtLeast;
  if (is_unsigned && !is_up && range.number < 0) return {false, true};
  const bool may_be_negative = !is_up || range.number < 0;
  const bool is_whole =
      range.type == NumberType::Integer || range.type == NumberType::Whole;
  return {true, !is_whole || (is_unsigned && may_be_negative)};
}

}  // namespace

PortReading read_by_port(PortType type, const ScriptValue& value) {
  constexpr PortReading kSuits{true, false};
  constexpr PortReading kThrows{false, true};
  switch (value.kind) {
    case ScriptKind::Unset:
    case ScriptKind::Empty:
    case ScriptKind::NotANumber:
      return kThrows;
    case ScriptKind::Unknown:
      return {true, true};
    case ScriptKind::Number:
      return fits(type, value.number) ? kSuits : kThrows;
    case ScriptKind::Text:
      return is_literal_of(type, value.text) ? kSuits : kThrows;
    case ScriptKind::AtMost:
    case ScriptKind::AtLeast:
      return read_range(type, value);
    case ScriptKind::AnyText:
      return {true, true};
    case ScriptKind::Any:
      break;
  }
  return {true, value.is_lost()};
}

std::vector<EntryNumber> EntryProgram::entries() const {
  std::vector<EntryNumber> all;
  for (std::size_t i = 0; i < tree.terms.size(); ++i) {
    if (tree.terms[i].operation == ScriptOperation::Name)
      all.push_back(names[i]);
  }
  for (const ProgramOperand* operand : {&left, &right}) {
    if (operand->entry) all.push_back(*operand->entry);
  }
  return all;
}

namespace {

void write_by_ports(const EntryProgram& program, Values& values) {
  for (const auto& [entry, value] : program.writes) {
    const bool is_sure = program.writes_surely || values[entry].is_something();
    values[entry] = is_sure ? value : ScriptValue{};
  }
}

}  // namespace

EntryExecution::EntryExecution(const EntryPrograms& programs)
    : programs_(programs) {
  for (const ProgramEntry& entry : programs.entries) {
    values_.push_back(entry.initial);
  }
}

bool EntryExecution::execute(const ScriptStep& step) {
  const EntryProgram& program =
      programs_.programs[static_cast<std::size_t>(step.program)];
  Values after = values_;
  bool is_possible = false;
  bool rests_on_enumerator = false;
  write_by_ports(program, after);
  switch (program.kind) {
    case EntryProgram::Kind::Script: {
      ScriptExecution script(programs_, program, after);
      const Result result = script.run();
      is_possible = comes_out(result, program.is_condition, step.outcome);
      rests_on_enumerator =
          script.rests_on_enumerator() &&
          is_one_of_several(result, program.is_condition, step.outcome);
      break;
    }
    case EntryProgram::Kind::Setting:
      is_possible = set(programs_, program, step.outcome, after);
      break;
    case EntryProgram::Kind::Unsetting:
      after[*program.left.entry] = ScriptValue::unset();
      is_possible = step.outcome != ScriptOutcomeKind::Throws;
      break;
    case EntryProgram::Kind::Equality: {
      const ScriptValue one = value_in(programs_, program.left, values_);
      const ScriptValue other = value_in(programs_, program.right, values_);
      const Equality whole =
          compared(program.how, one, other, programs_.enums.get());
      rests_on_enumerator = whole.may_hold && whole.may_fail &&
                            (one.is_enumerator() || other.is_enumerator() ||
                             is_beside_enumerator(program.how, one, other,
                                                  programs_.enums.get()));
      is_possible = step.outcome == ScriptOutcomeKind::Holds ? whole.may_hold
                                                             : whole.may_fail;
      break;
    }
    case EntryProgram::Kind::Reading: {
      const PortReading reading = read_by_port(
          program.port, value_in(programs_, program.left, values_));
      is_possible = step.outcome == ScriptOutcomeKind::Throws
                        ? reading.may_throw
                        : reading.may_suit;
      break;
    }
  }
  if (!is_possible) return false;
  values_ = std::move(after);
  rests_on_enumerator_ |= rests_on_enumerator;
  return true;
}

const ScriptStep* EntryExecution::refused(
    const std::vector<ScriptStep>& steps) {
  const auto found = std::ranges::find_if(
      steps, [&](const ScriptStep& step) { return !execute(step); });
  return found == steps.end() ? nullptr : &*found;
}

std::string shown(const ScriptValue& value) {
  switch (value.kind) {
    case ScriptKind::Number:
      return fmt::format("{}", value.number);
    case ScriptKind::NotANumber:
      return "nan";
    case ScriptKind::Text:
      return fmt::format("'{}'", value.text);
    case ScriptKind::Unset:
    case ScriptKind::Empty:
      return "nothing";
    default:
      return "unknown";
  }
}

}  // namespace btcheck::btcpp

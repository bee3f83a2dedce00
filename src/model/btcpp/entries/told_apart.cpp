// SPDX-License-Identifier: MIT
//
// All that is asked of a declared number, for the partition of its values
// (model/tree/partition.hpp): sums, differences and products of it and of whole
// numbers, compared with numbers or assigned to a declared number; whether it
// is true; the cases of a Switch and the ports of a BlackboardCheck; and what
// rules compare it with. What is done with it else, to copy or to divide it,
// tells all its values apart.
#include "model/btcpp/entries/told_apart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <utility>

#include "model/btcpp/entries/run.hpp"
#include "model/btcpp/entries/world.hpp"
#include "model/tree/partition.hpp"
#include "text/numbers.hpp"

namespace btcheck::btcpp {
namespace {

using Comparison = ScriptComparison;

// Beyond, doubles are not exact.
constexpr std::int64_t kMostExact = std::int64_t{1} << 53;
constexpr double kMostConstant = 0x7fffffff;

constexpr std::string_view kUsedOtherwise =
    "a script does more with it than to compare it with numbers";

std::optional<Operation> arithmetic(ScriptOperation operation) {
  switch (operation) {
    case ScriptOperation::Add:
    case ScriptOperation::SetSum:
      return Operation::Add;
    case ScriptOperation::Subtract:
    case ScriptOperation::SetDifference:
      return Operation::Subtract;
    case ScriptOperation::Multiply:
    case ScriptOperation::SetProduct:
      return Operation::Multiply;
    default:
      return std::nullopt;
  }
}

Comparison mirrored(Comparison comparison) {
  switch (comparison) {
    case Comparison::Less:
      return Comparison::Greater;
    case Comparison::LessEqual:
      return Comparison::GreaterEqual;
    case Comparison::Greater:
      return Comparison::Less;
    case Comparison::GreaterEqual:
      return Comparison::LessEqual;
    case Comparison::Equal:
    case Comparison::NotEqual:
      break;
  }
  return comparison;
}

// A calculation with at most one number, on which everything is exact.
struct Calculation {
  std::optional<std::size_t> number;
  std::vector<Term> terms;
  ValueRange range;
};

Calculation constant(std::int32_t value) {
  return {{}, {{Operation::Constant, value}}, {value, value}};
}

std::optional<Calculation> joined(Operation operation, Calculation left,
                                  const Calculation& right) {
  if (left.number && right.number && left.number != right.number) {
    return std::nullopt;
  }
  if (!left.number) left.number = right.number;
  left.terms.insert(left.terms.end(), right.terms.begin(), right.terms.end());
  left.terms.push_back({operation});
  left.range = range_of(operation, left.range, right.range);
  const bool is_exact =
      left.range.low >= -kMostExact && left.range.high <= kMostExact;
  return is_exact ? std::optional(std::move(left)) : std::nullopt;
}

// Whole numbers beside any: `x < 2.5` is `x < 3`.
struct WholeComparison {
  Operation operation{};
  std::int32_t number = 0;
};

std::optional<WholeComparison> whole(Comparison comparison, double number) {
  const auto with = [](Operation operation, double whole) {
    return WholeComparison{operation, static_cast<std::int32_t>(whole)};
  };
  switch (comparison) {
    case Comparison::Less:
      return with(Operation::Less, std::ceil(number));
    case Comparison::LessEqual:
      return with(Operation::LessEqual, std::floor(number));
    case Comparison::Greater:
      return with(Operation::Greater, std::floor(number));
    case Comparison::GreaterEqual:
      return with(Operation::GreaterEqual, std::ceil(number));
    case Comparison::Equal:
    case Comparison::NotEqual:
      break;
  }
  const double nearest = std::nearbyint(number);
  if (!is_same_number(nearest, number)) return std::nullopt;
  return with(Operation::Equal, nearest);
}

class Collection {
 public:
  Collection(const BtcppExpansion& expansion, const ScriptWriters& writers,
             const std::map<EntryName, EntryDeclaration>& declared)
      : expansion_(expansion) {
    for (const auto& [entry, declaration] : declared) {
      if (declaration.domain.is_range()) add(writers, entry, declaration);
    }
    for (const PlacedScript& script : writers.scripts) read(script);
    for (const PortPair& pair : writers.compared) read(pair);
    for (const Setting& setting : writers.settings) read(setting);
  }

  void ask(const ScriptDetail& detail) {
    const auto of_any = detail.asked.find("");
    for (const auto& [entry, at] : at_) {
      auto numbers = asked_of(detail, entry).value_or(std::set<double>());
      if (of_any != detail.asked.end()) numbers.merge(std::set(of_any->second));
      for (const double number : numbers) {
        compare(at, Comparison::Less, number);
        compare(at, Comparison::LessEqual, number);
      }
      const std::string other = compared_with(detail, entry);
      if (!other.empty()) {
        all_values(at, fmt::format("a rule compares it with `{}`", other));
      }
    }
  }

  std::map<EntryName, ToldApart> take(std::int64_t most_whole) {
    std::map<EntryName, ToldApart> found;
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const ValueRange& range = numbers_[i].values;
      const bool is_small = range.high - range.low < most_whole;
      if (is_small) numbers_[i].is_whole = true;
      wanted.push_back(i);
    }
    auto values = representatives(numbers_, wanted);
    for (const auto& [entry, at] : at_) {
      ToldApart& told = found[entry];
      told.samples = std::move(values[at]);
      if (told.samples) continue;
      told.why_all = why_[at].empty()
                         ? "its assignments tell too many of them apart"
                         : why_[at];
    }
    return found;
  }

 private:
  void add(const ScriptWriters& writers, const EntryName& entry,
           const EntryDeclaration& declaration) {
    const DeclaredDomain& domain = declaration.domain;
    const auto initial = writers.literals.find(entry);
    const bool begins = initial != writers.literals.end() &&
                        domain.held(initial->second).has_value();
    at_[entry] = numbers_.size();
    numbers_.push_back({{domain.min, domain.max},
                        begins
                            ? static_cast<std::int64_t>(initial->second.number)
                            : domain.min});
    why_.emplace_back();
  }

  std::optional<std::size_t> at(const EntryName& entry) const {
    const auto found = at_.find(entry);
    return found == at_.end() ? std::nullopt : std::optional(found->second);
  }

  void all_values(std::size_t number, std::string_view why) {
    numbers_[number].is_whole = true;
    if (why_[number].empty()) why_[number] = why;
  }

  void compare(std::size_t number, Comparison comparison, double with) {
    compare({number, {{Operation::Variable, 0}}, {}}, comparison, with);
  }

  void compare(Calculation of, Comparison comparison, double with) {
    if (std::isnan(with)) return;
    if (std::abs(with) > kMostConstant) {
      // Beyond every value of the entry itself.
      if (of.terms.size() > 1) all_values(*of.number, kUsedOtherwise);
      return;
    }
    const auto exact = whole(comparison, with);
    if (!exact) return;
    of.terms.push_back({Operation::Constant, exact->number});
    of.terms.push_back({exact->operation});
    numbers_[*of.number].add_atom(of.terms);
  }

  // Of doubles those below 0 are no truth values.
  void ask_truth(std::size_t number) {
    compare(number, Comparison::Less, 0);
    compare(number, Comparison::Equal, 0);
    compare(number, Comparison::Equal, 1);
  }

  // --- Scripts ------------------------------------------------------------

  void read(const PlacedScript& script) {
    // What is too deep is not run: it may come out in every way.
    if (is_too_deep(script.syntax.tree)) return;
    tree_ = &script.syntax.tree;
    subtree_ = script.subtree;
    for (const std::uint32_t statement : tree_->statements) judge(statement);
  }

  const ScriptTerm& term(std::uint32_t number) const {
    return tree_->terms[number];
  }

  std::optional<std::size_t> number_of(const ScriptTerm& name) const {
    return name.operation == ScriptOperation::Name
               ? at(entry_of(expansion_, subtree_, name.text))
               : std::nullopt;
  }

  // Only whether it is true matters.
  void judge(std::uint32_t number) {
    const ScriptTerm& of = term(number);
    if (of.operation != ScriptOperation::Name) return use(number);
    if (const auto entry = number_of(of)) ask_truth(*entry);
  }

  // Its value matters.
  void use(std::uint32_t number) {
    const ScriptTerm& of = term(number);
    switch (of.operation) {
      case ScriptOperation::Name:
        if (const auto entry = number_of(of)) {
          all_values(*entry, kUsedOtherwise);
        }
        return;
      case ScriptOperation::And:
      case ScriptOperation::Or:
      case ScriptOperation::Not:
        for (const std::uint32_t operand : of.operands) judge(operand);
        return;
      case ScriptOperation::Compare:
        return use_comparison(of);
      case ScriptOperation::Choose:
        judge(of.operands[0]);
        use(of.operands[1]);
        use(of.operands[2]);
        return;
      default:
        break;
    }
    if (is_assignment(of.operation)) return assign(of, of.operands[1]);
    for (const std::uint32_t operand : of.operands) use(operand);
  }

  // Nothing where it is more than whole numbers and one entry.
  std::optional<Calculation> calculation(std::uint32_t number) const {
    const ScriptTerm& of = term(number);
    if (of.operation == ScriptOperation::Number) {
      const bool is_exact = of.number && is_integer(*of.number) &&
                            std::abs(*of.number) <= kMostConstant;
      if (!is_exact) return std::nullopt;
      return constant(static_cast<std::int32_t>(*of.number));
    }
    if (const auto entry = number_of(of)) {
      return Calculation{
          entry, {{Operation::Variable, 0}}, numbers_[*entry].values};
    }
    if (of.operation == ScriptOperation::Negate) {
      const auto negated = calculation(of.operands[0]);
      return negated ? joined(Operation::Subtract, constant(0), *negated)
                     : std::nullopt;
    }
    const auto operation = arithmetic(of.operation);
    if (!operation || is_assignment(of.operation)) return std::nullopt;
    auto left = calculation(of.operands[0]);
    const auto right = left ? calculation(of.operands[1]) : std::nullopt;
    return right ? joined(*operation, std::move(*left), *right) : std::nullopt;
  }

  // A number that is written, or what is read as one.
  std::optional<double> literal(std::uint32_t number) const {
    const ScriptTerm& of = term(number);
    if (of.operation == ScriptOperation::Number) return of.number;
    if (of.operation == ScriptOperation::Text) {
      if (of.text == "true") return 1;
      if (of.text == "false") return 0;
      return begun_number<double>(of.text);
    }
    if (of.operation != ScriptOperation::Negate) return std::nullopt;
    const ScriptTerm& negated = term(of.operands[0]);
    const bool is_number = negated.operation == ScriptOperation::Number;
    return is_number && negated.number ? std::optional(-*negated.number)
                                       : std::nullopt;
  }

  void use_comparison(const ScriptTerm& of) {
    for (std::size_t i = 0; i < of.comparisons.size(); ++i) {
      const std::uint32_t left = of.operands[i];
      const std::uint32_t right = of.operands[i + 1];
      if (is_split(left, of.comparisons[i], right)) continue;
      use(left);
      use(right);
    }
  }

  // Whether the comparison is one of a number and constants.
  bool is_split(std::uint32_t left, Comparison comparison,
                std::uint32_t right) {
    auto one = calculation(left);
    auto other = calculation(right);
    if (one && other && one->number && other->number) {
      if (one->number != other->number) return false;
      // One that is the same on both sides: their difference beside 0.
      auto difference = joined(Operation::Subtract, std::move(*one), *other);
      if (difference) compare(std::move(*difference), comparison, 0);
      return difference.has_value();
    }
    if (other && other->number) {
      std::swap(one, other);
      std::swap(left, right);
      comparison = mirrored(comparison);
    }
    if (!one || !one->number) return false;
    if (term(right).operation == ScriptOperation::Text && !literal(right)) {
      return true;  // no number: it comes out alike for all
    }
    std::optional<double> with = literal(right);
    if (!with && other) with = static_cast<double>(other->range.low);
    if (with) compare(std::move(*one), comparison, *with);
    return with.has_value();
  }

  void assign(const ScriptTerm& assignment, std::uint32_t value) {
    const ScriptTerm& of = term(value);
    if (of.operation == ScriptOperation::Choose) {
      judge(of.operands[0]);
      assign(assignment, of.operands[1]);
      assign(assignment, of.operands[2]);
      return;
    }
    const auto target = number_of(term(assignment.operands[0]));
    auto moved = target ? calculation(value) : std::nullopt;
    if (moved && assignment.operation > ScriptOperation::Set) {
      const auto change = arithmetic(assignment.operation);
      const Calculation now{
          target, {{Operation::Variable, 0}}, numbers_[*target].values};
      moved = change ? joined(*change, now, *moved) : std::nullopt;
    }
    if (moved && moved->number) {
      numbers_[*moved->number].add_move(
          {target, numbers_[*target].values, std::move(moved->terms)});
      return;
    }
    if (moved) return numbers_[*target].constants.push_back(moved->range.low);
    if (target && assignment.operation > ScriptOperation::Set) {
      all_values(*target, kUsedOtherwise);
    }
    use(value);
  }

  // --- Ports ----------------------------------------------------------------

  void read(const PortPair& pair) {
    for (const EntryName& entry : pair.entries) {
      const auto number = at(entry);
      if (!number) continue;
      if (pair.entries.size() > 1) {
        all_values(*number, "a node compares it with another entry");
      }
      for (const std::string& text : pair.texts) ask_port(*number, text);
    }
  }

  // As a text, an int, a double or a truth: whatever the node reads there.
  void ask_port(std::size_t number, const std::string& text) {
    const auto enums = enumerators_of(*expansion_.document);
    if (enums && enums->contains(text)) {
      return compare(number, Comparison::Equal, enums->find(text)->second);
    }
    const char* const begin = text.c_str();
    char* end = nullptr;
    const double real = std::strtod(begin, &end);
    if (end == begin) return ask_truth(number);
    compare(number, Comparison::Equal, real);
    compare(number, Comparison::Equal,
            static_cast<double>(std::strtol(begin, &end, 10)));
  }

  void read(const Setting& setting) {
    const auto source = setting.source ? at(*setting.source) : std::nullopt;
    if (source) all_values(*source, "a SetBlackboard copies it");
    const auto target = at(setting.entry);
    const auto number = as_number<double>(setting.text);
    if (!target || !number || !is_integer(*number)) return;
    if (std::abs(*number) > kMostConstant) return;
    numbers_[*target].constants.push_back(static_cast<std::int64_t>(*number));
  }

  const BtcppExpansion& expansion_;
  std::map<EntryName, std::size_t> at_;
  std::vector<PartitionedNumber> numbers_;
  std::vector<std::string> why_;  // of each: why all values are told apart
  const ScriptTree* tree_ = nullptr;
  std::uint32_t subtree_ = 0;
};

}  // namespace

std::map<EntryName, ToldApart> told_apart(
    const BtcppExpansion& expansion, const ScriptWriters& writers,
    const std::map<EntryName, EntryDeclaration>& declared,
    const ScriptDetail& detail) {
  Collection collection(expansion, writers, declared);
  collection.ask(detail);
  return collection.take(detail.most_whole);
}

}  // namespace btcheck::btcpp

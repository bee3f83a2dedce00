// SPDX-License-Identifier: MIT
//
// Here everything is an integer, and so it is in Promela. In a typed language
// each part has a kind, and where another one is needed it is converted: a
// number to truth by `x != 0`, truth to a number by `t ? 1 : 0`. An enumeration
// stays one only where it is compared with its own values; elsewhere it becomes
// its number.
//
// The other tools compute in 32 bits, and some wrap; we saturate at 64. A model
// that differs from ours would be worse than none, so the range of each part is
// computed along with its text by interval arithmetic (Moore 1966). Where all
// ranges fit, every tool agrees with us; anything else is refused.
//
// A division by zero is 0 here and an error there. So where a divisor d can be
// zero, a / d becomes (d = 0 ? 0 : a / (d = 0 ? 1 : d)), and in Promela
// a / (d + (d == 0)) * (d != 0).
#include "model/export/language.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "model/tree/value_range.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kLongest = 4'000'000;  // characters
constexpr int kOr = 1;
constexpr int kAnd = 2;
constexpr int kComparison = 3;
constexpr int kSum = 4;
constexpr int kProduct = 5;
constexpr int kUnary = 6;
constexpr int kOperand = 7;

bool fits(ValueRange range) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  return range.low >= -kMost && range.high <= kMost;
}

enum class Kind : std::uint8_t { Truth, Number, Enumeration };

struct Part {
  std::string text;
  int tightness = kOperand;
  Kind kind = Kind::Number;
  ValueRange range = {};
  std::optional<VariableId> variable = {};    // it is this one
  std::optional<std::int64_t> constant = {};  // a Number
};

std::string enclosed(const Part& part, int tighter_than) {
  return part.tightness > tighter_than ? part.text : "(" + part.text + ")";
}

Part constant(std::int64_t value) {
  return {.text = std::to_string(value),
          .tightness = value < 0 ? kUnary : kOperand,
          .range = {value, value},
          .constant = value};
}

class Printer {
 public:
  explicit Printer(const ExportLanguage& language)
      : language_(language),
        network_(language.network()),
        signs_(language.signs()),
        is_typed_(language.is_typed()) {}

  enum class Outcome { Exact, TooLarge, TooLong };
  Outcome run(const Expression& expression) {
    ask_budget();
    if (expression.is_true()) stack_.push_back(constant(1));
    for (const Term& term : expression.terms()) {
      push(term);
      const Part& made = stack_.back();
      if (!fits(made.range)) return Outcome::TooLarge;
      if (made.text.size() > kLongest) return Outcome::TooLong;
    }
    assert(stack_.size() == 1);
    return Outcome::Exact;
  }

  std::string condition() { return truth(pop()).text; }
  std::string as_number() { return number(pop()).text; }

  std::string value(VariableId of) {
    const Part made = pop();
    if (made.constant && in_domain(of, *made.constant)) {
      return language_.names().value(of, *made.constant);
    }
    if (!language_.is_enumeration(of)) return number(made).text;
    if (made.kind == Kind::Enumeration && same_domain(*made.variable, of)) {
      return made.text;
    }
    return language_.value_of(of, number(made).text);
  }

 private:
  Part variable(VariableId id) const {
    const Variable& read = network_.variable(id);
    return {
        .text = language_.names().variable(id),
        .kind = language_.is_enumeration(id) ? Kind::Enumeration : Kind::Number,
        .range = {read.min, read.max},
        .variable = id};
  }

  bool in_domain(VariableId id, std::int64_t value) const {
    return value >= network_.variable(id).min &&
           value <= network_.variable(id).max;
  }

  // Two variables whose values are the same by name.
  bool same_domain(VariableId a, VariableId b) const {
    return a == b || (network_.variable(a).role == VariableRole::Status &&
                      network_.variable(b).role == VariableRole::Status);
  }

  Part truth_part(std::string text, int tightness) const {
    return {.text = std::move(text),
            .tightness = tightness,
            .kind = is_typed_ ? Kind::Truth : Kind::Number,
            .range = {0, 1}};
  }

  Part truth(Part part) const {
    if (!is_typed_ || part.kind == Kind::Truth) return part;
    if (!part.constant) {
      return compared(Operation::NotEqual, part, constant(0));
    }
    return truth_part(
        std::string(*part.constant != 0 ? signs_.truth : signs_.falsehood),
        kOperand);
  }

  Part number(const Part& part) const {
    if (part.kind == Kind::Number) return part;
    Part made{.text = part.text, .range = part.range};
    made.text = part.kind == Kind::Truth ? "(" + part.text + " ? 1 : 0)"
                                         : language_.number_of(*part.variable);
    return made;
  }

  Part negated(const Part& part) const {
    return truth_part(std::string(signs_.negation) + enclosed(part, kUnary),
                      kUnary);
  }

  Part joined(Operation operation, Part a, Part b) const {
    const bool is_and = operation == Operation::And;
    const int tightness = is_and ? kAnd : kOr;
    // A chain needs no parentheses. An And within an Or gets them all the same,
    // since gcc warns without, and in Promela so does a chain on the right.
    const auto side = [&](Part part, bool may_continue) {
      return part.tightness == tightness && may_continue ? std::move(part.text)
                                                         : enclosed(part, kAnd);
    };
    // Long chains grow on the left: appended to, not copied.
    std::string text = side(truth(std::move(a)), true);
    text += is_and ? signs_.conjunction : signs_.disjunction;
    text += side(truth(std::move(b)), is_typed_);
    return truth_part(std::move(text), tightness);
  }

  Part compared(Operation operation, Part a, Part b) const {
    const bool is_named =
        (is_equality(operation) || !is_typed_) && (named(a, b) || named(b, a));
    const bool are_alike = is_equality(operation) && a.kind == b.kind &&
                           a.kind != Kind::Enumeration;
    if (!is_named && !are_alike) {
      a = number(a);
      b = number(b);
    }
    const bool is_negated =
        operation == Operation::NotEqual && signs_.differs.empty();
    const Part made =
        truth_part(enclosed(a, kComparison) +
                       sign(is_negated ? Operation::Equal : operation) +
                       enclosed(b, kComparison),
                   kComparison);
    return is_negated ? negated(made) : made;
  }

  // A variable beside one of its values, which gets its name, or beside another
  // variable with the same values.
  bool named(const Part& one, Part& other) const {
    if (!one.variable || (is_typed_ && one.kind != Kind::Enumeration)) {
      return false;
    }
    if (other.kind == Kind::Enumeration) {
      return same_domain(*one.variable, *other.variable);
    }
    if (!other.constant || !in_domain(*one.variable, *other.constant)) {
      return false;
    }
    other.text = language_.names().value(*one.variable, *other.constant);
    other.tightness = kOperand;
    return true;
  }

  Part calculated(Operation operation, const Part& left,
                  const Part& right) const {
    const bool is_sum =
        operation == Operation::Add || operation == Operation::Subtract;
    const Part a = number(left);
    Part b = number(right);
    Part made{.text = {},
              .tightness = is_sum ? kSum : kProduct,
              .range = range_of(operation, a.range, b.range)};
    const std::string divisor = enclosed(b, kComparison);
    const bool may_fail = divides(operation) && b.range.has(0);
    if (may_fail) {
      b.text = is_typed_ ? fmt::format("({0} = 0 ? 1 : {0})", divisor)
                         : fmt::format("({0} + ({0} == 0))", divisor);
      b.tightness = kOperand;
    }
    made.text = enclosed(a, made.tightness - 1) + sign(operation) +
                enclosed(b, made.tightness);
    if (may_fail && is_typed_) {
      made.text = fmt::format("({} = 0 ? 0 : {})", divisor, made.text);
      made.tightness = kOperand;
    } else if (may_fail && operation == Operation::Divide) {
      // The remainder needs no factor: divided by 1 it is 0 already.
      made.text += fmt::format(" * ({} != 0)", divisor);
    }
    return made;
  }

  std::string sign(Operation operation) const {
    // In the order of Operation, from Add on.
    const std::array<std::string_view, 11> signs = {
        " + ",          " - ", " * ",  " / ", signs_.modulo, signs_.equals,
        signs_.differs, " < ", " <= ", " > ", " >= "};
    return std::string(signs[static_cast<std::size_t>(operation) -
                             static_cast<std::size_t>(Operation::Add)]);
  }

  void push(const Term& term) {
    if (term.operation == Operation::Constant) {
      stack_.push_back(constant(term.operand));
    } else if (term.operation == Operation::Variable) {
      stack_.push_back(
          variable(VariableId{static_cast<std::uint32_t>(term.operand)}));
    } else if (term.operation == Operation::Not) {
      stack_.push_back(negated(truth(pop())));
    } else if (term.operation == Operation::Negate) {
      const Part of = number(pop());
      stack_.push_back({.text = "-" + enclosed(of, kUnary),
                        .tightness = kUnary,
                        .range = range_of(Operation::Negate, {}, of.range)});
    } else {
      Part right = pop();
      Part left = pop();
      stack_.push_back(
          binary(term.operation, std::move(left), std::move(right)));
    }
  }

  Part binary(Operation operation, Part left, Part right) const {
    if (operation == Operation::And || operation == Operation::Or) {
      return joined(operation, std::move(left), std::move(right));
    }
    return is_comparison(operation)
               ? compared(operation, std::move(left), std::move(right))
               : calculated(operation, left, right);
  }

  Part pop() {
    Part top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  const ExportLanguage& language_;
  const Network& network_;
  const ExportLanguage::Signs& signs_;
  bool is_typed_;
  std::vector<Part> stack_;
};

std::string owner_text(const BehaviorTree& tree, const Automaton& automaton) {
  if (automaton.kind == AutomatonKind::StateVariable) {
    return fmt::format("`{}`", automaton.name);
  }
  return fmt::format("`{}` on line {}", automaton.name,
                     tree.node(automaton.node).span.line);
}

std::vector<Expression> expressions_of(const Automaton& automaton) {
  std::vector<Expression> expressions;
  for (const Edge& edge : automaton.edges) {
    expressions.push_back(edge.guard);
    for (const Assignment& update : edge.updates) {
      expressions.push_back(update.value);
    }
  }
  return expressions;
}

}  // namespace

std::string ExportLanguage::condition(const Expression& expression) const {
  Printer printer(*this);
  return printer.run(expression) == Printer::Outcome::Exact
             ? printer.condition()
             : "";
}

std::string ExportLanguage::as_number(const Expression& expression) const {
  Printer printer(*this);
  return printer.run(expression) == Printer::Outcome::Exact
             ? printer.as_number()
             : "";
}

std::string ExportLanguage::assigned(const Expression& expression,
                                     VariableId to) const {
  Printer printer(*this);
  return printer.run(expression) == Printer::Outcome::Exact ? printer.value(to)
                                                            : "";
}

std::vector<Diagnostic> ExportLanguage::refusals(
    const BehaviorTree& tree, const std::vector<ExportClaim>& claims) const {
  std::vector<Diagnostic> found;
  const auto ask = [&](const std::vector<Expression>& expressions,
                       const std::string& owner) {
    constexpr std::size_t kMostShown = 100;
    for (const Expression& each : expressions) {
      const auto outcome = Printer(*this).run(each);
      if (outcome == Printer::Outcome::Exact) continue;
      const bool is_long = outcome == Printer::Outcome::TooLong;
      std::string shown = expression_text(network_, each);
      if (shown.size() > kMostShown) shown = shown.substr(0, kMostShown) + "…";
      const std::string reason =
          is_long
              ? fmt::format("takes more than {} million characters",
                            kLongest / 1'000'000)
              : fmt::format("may leave the 32 bits of {}'s int", signs_.name);
      found.push_back(
          SourceText(tree.file, "")
              .diagnostic(Severity::Error, "BT0005", {},
                          fmt::format("`{}`, in {}, {}", shown, owner, reason),
                          "",
                          is_long ? "give the node fewer children"
                                  : "give its variables smaller ranges"));
      return;
    }
  };
  for (const Automaton& automaton : network_.automata) {
    ask(expressions_of(automaton), owner_text(tree, automaton));
  }
  for (const ExportClaim& claim : claims) {
    ask(claim.propositions, "`" + claim.name + "`");
  }
  return found;
}

}  // namespace btcheck

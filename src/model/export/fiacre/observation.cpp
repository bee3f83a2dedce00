// SPDX-License-Identifier: MIT
//
// Conditions on a network's states as Fiacre observes them.
//
// A property of Fiacre looks into one process at a time: at its state, or at an
// expression over the variables it sees. So a condition is taken apart down to
// its comparisons, each is asked of a process that sees what it reads, and
// and, or, not join them again, as in the paper's properties.
#include "model/export/fiacre/observation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace btcheck {
namespace {

constexpr std::size_t kLongest = 200'000;  // characters

// A part: told already, or still an expression.
struct Part {
  Expression expression;
  std::optional<std::string> told;
};

bool is_comparison(Operation operation) {
  return operation >= Operation::Equal && operation <= Operation::GreaterEqual;
}

Operation mirrored(Operation operation) {
  switch (operation) {
    case Operation::Less:
      return Operation::Greater;
    case Operation::LessEqual:
      return Operation::GreaterEqual;
    case Operation::Greater:
      return Operation::Less;
    case Operation::GreaterEqual:
      return Operation::LessEqual;
    default:
      return operation;
  }
}

// The only term, if there is only one and it is such a one.
std::optional<std::int32_t> single(const Expression& expression,
                                   Operation kind) {
  const auto terms = expression.terms();
  if (terms.size() != 1 || terms[0].operation != kind) return std::nullopt;
  return terms[0].operand;
}

class Observer {
 public:
  Observer(const FiacreLanguage& language, std::string_view component)
      : language_(language),
        network_(language.network()),
        component_(component) {}

  std::optional<std::string> run(const Expression& condition) {
    if (condition.is_true()) return constant(true);
    for (const Term& term : condition.terms()) {
      auto made = next(term);
      if (!made || (made->told && made->told->size() > kLongest)) return {};
      stack_.push_back(std::move(*made));
    }
    return told(stack_.back());
  }

 private:
  std::optional<Part> next(const Term& term) {
    switch (arity(term.operation)) {
      case 0:
        return Part{term.operation == Operation::Constant
                        ? Expression::constant(term.operand)
                        : Expression::variable(term.operand),
                    {}};
      case 1:
        return unary(term.operation, pop());
      default: {
        Part right = pop();
        Part left = pop();
        return binary(term.operation, std::move(left), std::move(right));
      }
    }
  }

  Part pop() {
    Part top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  std::optional<Part> unary(Operation operation, Part of) const {
    if (operation == Operation::Not) {
      const auto inner = told(of);
      if (!inner) return std::nullopt;
      return Part{{}, "not (" + *inner + ")"};
    }
    if (of.told) return std::nullopt;
    return Part{Expression::unary(operation, std::move(of.expression)), {}};
  }

  std::optional<Part> binary(Operation operation, Part left, Part right) const {
    if (operation == Operation::And || operation == Operation::Or) {
      return joined(operation == Operation::And ? "and" : "or", left, right);
    }
    const bool is_equality =
        operation == Operation::Equal || operation == Operation::NotEqual;
    if (is_equality && (left.told || right.told)) {
      return equivalent(operation, left, right);
    }
    if (left.told || right.told) return std::nullopt;
    if (!is_comparison(operation)) {
      return Part{Expression::binary(operation, std::move(left.expression),
                                     std::move(right.expression)),
                  {}};
    }
    auto observed = compared(operation, left.expression, right.expression);
    if (!observed) return std::nullopt;
    return Part{{}, std::move(observed)};
  }

  std::optional<Part> joined(std::string_view word, const Part& left,
                             const Part& right) const {
    const auto a = told(left);
    const auto b = told(right);
    if (!a || !b) return std::nullopt;
    return Part{{}, fmt::format("({}) {} ({})", *a, word, *b)};
  }

  // Among observations there are no constants: any process sees one.
  std::string constant(bool value) const {
    return fmt::format("{}/1/value ({})", component_, value);
  }

  // Truth beside truth, or beside a number that it may be equal to.
  std::optional<Part> equivalent(Operation operation, const Part& left,
                                 const Part& right) const {
    for (const Part* side : {&left, &right}) {
      if (side->told) continue;
      const auto number = single(side->expression, Operation::Constant);
      if (!number) return std::nullopt;
      if (*number == 0 || *number == 1) continue;
      return Part{{}, constant(operation != Operation::Equal)};
    }
    const auto a = told(left);
    const auto b = told(right);
    if (!a || !b) return std::nullopt;
    const std::string_view beside = operation == Operation::Equal ? "" : "not ";
    const std::string_view otherwise =
        operation == Operation::Equal ? "not " : "";
    return Part{{},
                fmt::format("(({0}) and {2}({1})) or (not ({0}) and {3}({1}))",
                            *a, *b, beside, otherwise)};
  }

  // A part as a truth value.
  std::optional<std::string> told(const Part& part) const {
    if (part.told) return part.told;
    if (const auto value = single(part.expression, Operation::Constant)) {
      return constant(*value != 0);
    }
    return compared(Operation::NotEqual, part.expression,
                    Expression::constant(0));
  }

  std::optional<std::string> compared(Operation operation,
                                      const Expression& left,
                                      const Expression& right) const {
    const auto constant_right = single(right, Operation::Constant);
    if (const auto owner = kept_location(left); owner && constant_right) {
      return in_states(*owner, operation, *constant_right);
    }
    const auto constant_left = single(left, Operation::Constant);
    if (const auto owner = kept_location(right); owner && constant_left) {
      return in_states(*owner, mirrored(operation), *constant_left);
    }
    return seen(Expression::binary(operation, left, right));
  }

  // The automaton whose location, kept in its states, is all of this.
  std::optional<AutomatonId> kept_location(const Expression& side) const {
    const auto variable = single(side, Operation::Variable);
    if (!variable) return std::nullopt;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      if (language_.place(AutomatonId{a}) == LocationPlace::State &&
          index(network_.automata[a].location) ==
              static_cast<std::uint32_t>(*variable)) {
        return AutomatonId{a};
      }
    }
    return std::nullopt;
  }

  std::string in_states(AutomatonId id, Operation operation,
                        std::int64_t value) const {
    const Automaton& automaton = network_.automaton(id);
    const int min = network_.variable(automaton.location).min;
    std::string text;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < automaton.locations.size(); ++i) {
      if (apply(operation, min + static_cast<int>(i), value) == 0) continue;
      text += fmt::format("{}{}/{}/state {}", text.empty() ? "" : " or ",
                          component_, index(id) + 1,
                          language_.state(id, LocationId{i}));
      ++count;
    }
    const bool is_constant = count == 0 || count == automaton.locations.size();
    return is_constant ? constant(count != 0) : text;
  }

  // The comparison, asked of the first process that sees all it reads.
  std::optional<std::string> seen(const Expression& comparison) const {
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const AutomatonId id{a};
      const auto sees = [&](const Term& term) {
        if (term.operation != Operation::Variable) return true;
        const VariableId read{static_cast<std::uint32_t>(term.operand)};
        const auto& own = language_.own(id);
        const auto& shared = language_.shared(id);
        return std::ranges::find(own, read) != own.end() ||
               std::ranges::find(shared, read) != shared.end();
      };
      if (!std::ranges::all_of(comparison.terms(), sees)) continue;
      return fmt::format("{}/{}/value ({})", component_, a + 1,
                         language_.condition(comparison));
    }
    return std::nullopt;
  }

  const FiacreLanguage& language_;
  const Network& network_;
  std::string_view component_;
  std::vector<Part> stack_;
};

}  // namespace

std::optional<std::string> fiacre_observation(const FiacreLanguage& language,
                                              std::string_view component,
                                              const Expression& condition) {
  return Observer(language, component).run(condition);
}

}  // namespace btcheck

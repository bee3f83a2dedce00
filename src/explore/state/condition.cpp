// SPDX-License-Identifier: MIT
//
// Guards are conjunctions of simple comparisons nearly always, so compiling
// them is splitting: each conjunct that compares one field with one constant,
// negated or not, is a masked comparison of a whole word, and two of them in
// one word are one. Arithmetic, and disjunctions, are left to a stack program
// over fields.
#include "explore/state/condition.hpp"

#include <boost/container/small_vector.hpp>
#include <cassert>

namespace btcheck {

ConditionPool::ConditionPool(const Network& network, const StateLayout& layout)
    : network_(network), layout_(layout) {}

Condition ConditionPool::compile(const Expression& condition) {
  Condition compiled;
  compiled.first_test = static_cast<std::uint32_t>(tests_.size());
  std::vector<Program> programs;
  for (const Expression& conjunct : condition.conjuncts()) {
    if (!compile_test(conjunct, compiled.first_test)) {
      programs.push_back(compile_value(conjunct));
    }
  }
  compiled.last_test = static_cast<std::uint32_t>(tests_.size());
  compiled.first_program = static_cast<std::uint32_t>(programs_.size());
  programs_.insert(programs_.end(), programs.begin(), programs.end());
  compiled.last_program = static_cast<std::uint32_t>(programs_.size());
  return compiled;
}

bool ConditionPool::compile_test(const Expression& conjunct,
                                 std::uint32_t first_test) {
  std::span<const Term> terms = conjunct.terms();
  bool is_negated = false;  // `not (status = running)`
  while (terms.size() > 3 && terms.back().operation == Operation::Not) {
    terms = terms.first(terms.size() - 1);
    is_negated = !is_negated;
  }
  if (terms.size() != 3 || terms[0].operation != Operation::Variable ||
      terms[1].operation != Operation::Constant) {
    return false;
  }
  bool is_equal = terms[2].operation == Operation::Equal;
  if (!is_equal && terms[2].operation != Operation::NotEqual) return false;
  is_equal ^= is_negated;
  const Variable& variable = network_.variables[terms[0].operand];
  std::int64_t value = terms[1].operand;
  const Field& field = layout_.fields[terms[0].operand];
  if (field.width == 0 || value < variable.min || value > variable.max) {
    return false;
  }
  if (!is_equal && variable.domain_size() == 2) {
    value = value == variable.min ? variable.max : variable.min;
    is_equal = true;
  }
  add_test({field.mask(), field.bits(value), field.word, is_equal}, first_test);
  return true;
}

// Fields that are compared one after the other mostly lie side by side, so the
// test to join is nearly always the last one.
void ConditionPool::add_test(Test test, std::uint32_t first_test) {
  for (std::size_t i = tests_.size(); test.is_equal && i-- > first_test;) {
    Test& known = tests_[i];
    const bool fits = known.is_equal && known.word == test.word &&
                      (known.mask & test.mask) == 0;
    if (!fits) continue;
    known.mask |= test.mask;
    known.value |= test.value;
    return;
  }
  tests_.push_back(test);
}

Program ConditionPool::compile_value(const Expression& value) {
  Program program;
  program.first = static_cast<std::uint32_t>(instructions_.size());
  for (const Term& term : value.terms()) {
    assert(term.operation != Operation::Status);
    Instruction instruction{term.operation, term.operand, {}};
    if (term.operation == Operation::Variable) {
      instruction.field = layout_.fields[term.operand];
    }
    instructions_.push_back(instruction);
  }
  if (value.is_true()) instructions_.push_back({Operation::Constant, 1, {}});
  program.last = static_cast<std::uint32_t>(instructions_.size());
  return program;
}

std::int64_t ConditionPool::value(const Program& program,
                                  const Word* state) const {
  boost::container::small_vector<std::int64_t, 32> stack;
  for (std::uint32_t i = program.first; i < program.last; ++i) {
    const Instruction& instruction = instructions_[i];
    switch (instruction.operation) {
      case Operation::Constant:
        stack.push_back(instruction.constant);
        break;
      case Operation::Variable:
        stack.push_back(instruction.field.get(state));
        break;
      case Operation::Negate:
      case Operation::Not:
        stack.back() = apply(instruction.operation, 0, stack.back());
        break;
      default: {
        const std::int64_t right = stack.back();
        stack.pop_back();
        stack.back() = apply(instruction.operation, stack.back(), right);
      }
    }
  }
  return stack.back();
}

}  // namespace btcheck

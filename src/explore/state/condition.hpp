// SPDX-License-Identifier: MIT
//
// Expressions compiled to tests on the packed words of a state.
#pragma once

#include <cstdint>
#include <vector>

#include "explore/state/state_layout.hpp"

namespace btcheck {

// A compiled truth value: a range of word tests and a range of programs, all
// of which must hold.
struct Condition {
  std::uint32_t first_test = 0;
  std::uint32_t last_test = 0;
  std::uint32_t first_program = 0;
  std::uint32_t last_program = 0;
};

// A compiled value: a range of instructions.
struct Program {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

// Where compiled conditions and programs live, side by side. Conjuncts of the
// form variable = constant become tests `(word & mask) == value`, several in
// one word a single test; what is left becomes a small postfix program.
class ConditionPool {
 public:
  ConditionPool(const Network& network, const StateLayout& layout);

  Condition compile(const Expression& condition);
  Program compile_value(const Expression& value);

  bool holds(const Condition& condition, const Word* state) const {
    for (std::uint32_t i = condition.first_test; i < condition.last_test; ++i) {
      const Test& test = tests_[i];
      if (((state[test.word] & test.mask) == test.value) != test.is_equal) {
        return false;
      }
    }
    for (std::uint32_t i = condition.first_program; i < condition.last_program;
         ++i) {
      if (value(programs_[i], state) == 0) return false;
    }
    return true;
  }

  std::int64_t value(const Program& program, const Word* state) const;

 private:
  struct Test {
    Word mask = 0;
    Word value = 0;
    std::uint32_t word = 0;
    bool is_equal = true;
  };
  struct Instruction {
    Operation operation = Operation::Constant;
    std::int64_t constant = 0;
    Field field;
  };

  bool compile_test(const Expression& conjunct, std::uint32_t first_test);
  void add_test(Test test, std::uint32_t first_test);

  const Network& network_;
  const StateLayout& layout_;
  std::vector<Test> tests_;
  std::vector<Instruction> instructions_;
  std::vector<Program> programs_;
};

}  // namespace btcheck

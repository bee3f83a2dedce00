// SPDX-License-Identifier: MIT
//
// Scripts as trees of operations.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck::btcpp {

enum class ScriptOperation : std::uint8_t {
  Number,
  Text,
  Name,
  Negate,      // -
  Complement,  // ~
  Not,         // !
  Add,         // also joins two texts
  Subtract,
  Multiply,
  Divide,
  Join,  // ..
  BitAnd,
  BitOr,
  BitXor,
  And,      // evaluates both sides
  Or,       // evaluates both sides
  Compare,  // a chain, a < b <= c
  Choose,   // ? :
  Create,   // :=
  Set,      // =
  SetSum,   // +=
  SetDifference,
  SetProduct,
  SetQuotient
};

enum class ScriptComparison : std::uint8_t {
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual
};

constexpr bool is_assignment(ScriptOperation operation) {
  return operation >= ScriptOperation::Create;
}

struct ScriptTerm {
  ScriptOperation operation = ScriptOperation::Number;
  std::string text;  // of a Text, without quotes, and of a Name
  // Of a Number; nothing when a double cannot hold it. true is 1, false 0.
  std::optional<double> number;
  bool is_integer = false;  // a Number that the engine keeps as an int64
  // Indices of terms, all smaller than this one's. The first of an assignment
  // is a Name.
  std::vector<std::uint32_t> operands;
  std::vector<ScriptComparison> comparisons;  // between operands of a Compare
  int depth = 0;                              // 0 without operands
};

struct ScriptTree {
  std::vector<ScriptTerm> terms;
  std::vector<std::uint32_t> statements;  // indices of terms, in order
};

// The operation between two operands, or that assigns, by its sign.
std::optional<ScriptOperation> binary_operation(std::string_view sign);
std::optional<ScriptComparison> comparison_named(std::string_view sign);

// The value of a number as BehaviorTree.CPP 4.10 reads it: integers have 64
// bits; nothing when a double holds it only roughly.
std::optional<double> script_number(std::string_view written);
bool is_integer_literal(std::string_view written);

}  // namespace btcheck::btcpp

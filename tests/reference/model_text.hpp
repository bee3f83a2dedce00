// SPDX-License-Identifier: MIT
//
// What the readers of exported models share: words, and expressions.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck::reference {

// The words, numbers and signs of a text, comments left out. Each of `signs`
// is one word, the longest first.
std::vector<std::string> words_of(std::string_view text,
                                  const std::vector<std::string>& signs,
                                  std::string_view line_comment);

// A place in a list of words. What does not fit is thrown as runtime_error.
class WordReader {
 public:
  explicit WordReader(std::vector<std::string> words)
      : words_(std::move(words)) {}

  bool at_end() const { return at_ == words_.size(); }
  const std::string& peek(std::size_t ahead = 0) const;
  std::string take();
  void expect(std::string_view word);
  bool accept(std::string_view word);
  int number();  // with its sign

 private:
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

// What a name in an expression stands for.
enum class NameKind : std::uint8_t { Constant, Variable, Definition };
struct NamedThing {
  NameKind kind = NameKind::Constant;
  int number = 0;  // the value, or its place
};
using NameTable = std::map<std::string, NamedThing>;

// An expression in postfix order. Truth is 1.
struct ReadExpression {
  enum class Code : std::uint8_t {
    Constant,
    Variable,
    Definition,
    Not,
    Negate,
    Keep,  // of one operand: its value
    And,
    Or,
    Implies,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
    Choose,  // c a b: a if c, else b
    Case,    // c1 v1 … cn vn, operand n
    Among    // x v1 … vn, operand n
  };
  struct Item {
    Code code = Code::Constant;
    int operand = 0;
  };
  std::vector<Item> items;

  std::int64_t value(const std::function<std::int64_t(int)>& variable,
                     const std::function<std::int64_t(int)>& definition) const;
};

// How a language writes the operators that others write otherwise.
struct OperatorWords {
  std::map<std::string, ReadExpression::Code> binary;
  std::map<std::string, ReadExpression::Code> unary;
};

// Reads an expression up to the first word that cannot belong to it.
ReadExpression read_expression(WordReader& words,
                               const OperatorWords& operators,
                               const NameTable& names);

}  // namespace btcheck::reference

// SPDX-License-Identifier: MIT
//
// Expressions of a network in languages that tell truth, numbers and
// enumerations apart: SMV and Fiacre.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/automata/network.hpp"

namespace btcheck {

// How such a language writes what others write otherwise. Both write = < <= >
// >= + - * / and (a ? b : c) alike.
class TypedLanguage {
 public:
  virtual ~TypedLanguage() = default;

  struct Signs {
    std::string_view conjunction;  // " & "
    std::string_view disjunction;
    std::string_view negation;  // stands before its operand
    std::string_view differs;   // "" where only a negation can say it
    std::string_view modulo;
    std::string_view truth;
    std::string_view falsehood;
  };
  virtual Signs signs() const = 0;
  virtual std::string variable(VariableId id) const = 0;
  // Whether the variable is an enumeration there, whose values have names.
  virtual bool is_enumeration(VariableId id) const = 0;
  // The name of such a value.
  virtual std::string value(VariableId id, int value) const = 0;
  // Which number the value of an enumeration has in the network, and back.
  virtual std::string number_of(VariableId id) const = 0;
  virtual std::string value_of(VariableId id,
                               const std::string& number) const = 0;
};

struct TypedExpression {
  std::string text;
  // The text has the value of the expression in every state. False when a part
  // may leave 32 bits, or the text becomes too long to be told.
  bool is_exact = true;
};

// The expression as a condition.
TypedExpression typed_condition(const Network& network,
                                const TypedLanguage& language,
                                const Expression& expression);
// The expression as a value of the variable.
TypedExpression typed_value(const Network& network,
                            const TypedLanguage& language,
                            const Expression& expression, VariableId of);

}  // namespace btcheck

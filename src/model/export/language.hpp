// SPDX-License-Identifier: MIT
//
// Expressions of a network in the languages of other tools. Promela has only
// integers, as we do; SMV and Fiacre have separate types for truth values,
// numbers and enumerations.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"
#include "model/export/names.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A property of an exported model. Letters, digits and `_` in the name, no
// digit first; the names of a model's claims differ. The formula is as the
// language writes it (LTL for SPIN, which has no X; `ltl [] (p0 => <> p1)` or
// `p0 leadsto p1 within [0,4]` for Fiacre), over p0, p1, …, which stand for
// propositions[0], propositions[1], …, each over the network's variables.
struct ExportClaim {
  std::string name;
  std::string formula;
  std::vector<Expression> propositions;
  std::vector<std::string> remarks = {};  // for its reader, a line each
};

// How a language writes operators, and the names of its values. All of them
// write < <= > >= + - * / alike.
class ExportLanguage {
 public:
  struct Signs {
    std::string_view name;         // of the language
    std::string_view conjunction;  // " & "
    std::string_view disjunction;
    std::string_view negation;  // stands before its operand
    std::string_view equals;
    std::string_view differs;  // "" where only a negation can say it
    std::string_view modulo;
    std::string_view truth = {};  // "": truth is the number 1
    std::string_view falsehood = {};
  };

  // Both must outlive it, and so must the texts of the signs.
  ExportLanguage(const Network& network, const ExportNames& names,
                 const Signs& signs)
      : network_(network), names_(names), signs_(signs) {}
  virtual ~ExportLanguage() = default;

  const Network& network() const { return network_; }
  const ExportNames& names() const { return names_; }
  const Signs& signs() const { return signs_; }
  // Whether truth values have a type of their own, and so have enumerations.
  bool is_typed() const { return !signs_.truth.empty(); }
  // Whether the variable is an enumeration there.
  bool is_enumeration(VariableId id) const {
    return is_typed() && names_.has_named_values(id);
  }
  // The number that the value of an enumeration has in the network, and back.
  virtual std::string number_of(VariableId id) const {
    return names_.variable(id);
  }
  virtual std::string value_of(VariableId, const std::string& number) const {
    return number;
  }

  // Empty where the language cannot say the expression: a part may leave 32
  // bits, or the text is too long to be written.
  std::string condition(const Expression& expression) const;
  std::string as_number(const Expression& expression) const;
  // As a value of the variable.
  std::string assigned(const Expression& expression, VariableId to) const;

  // An error for the first guard or assigned value of each automaton, and for
  // the first proposition of each claim, that the language cannot say.
  std::vector<Diagnostic> refusals(
      const BehaviorTree& tree, const std::vector<ExportClaim>& claims) const;

 private:
  const Network& network_;
  const ExportNames& names_;
  Signs signs_;
};

}  // namespace btcheck

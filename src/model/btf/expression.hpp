// SPDX-License-Identifier: MIT
//
// Expressions of .btf files: prefix notation, `(and (< x 3) (= mode Low))`, to
// typed terms.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "model/btf/forms.hpp"
#include "model/btf/trees.hpp"
#include "model/btf/variables.hpp"
#include "model/tree/expression.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

enum class Type : unsigned char {
  Broken,  // holds an error that is reported already
  Word,    // a state, a status or a variable, to be settled
  Number,
  Truth,
  Enumeration,
  Status
};

struct Operand {
  Type type = Type::Broken;
  FormId form{};
  Expression value;
  std::optional<StateVariableId> variable;  // when it is a variable
  std::optional<int> constant;              // when it is a number
  int decimals = 0;                         // a number is value / 10^decimals
};

class Functions;
struct Function;

// What a name stands for: an argument of a SubTree in its nodes, or of a
// function in what it returns.
struct Binding {
  Operand value;
  bool is_open = false;  // only the program around the tree knows it
};
struct Bindings {
  std::map<std::string, Binding, std::less<>> by_key;
  int line = 0;                        // of the SubTree, or of the call
  const Function* function = nullptr;  // that is being called
  const Bindings* outer = nullptr;     // what surrounds the call
};

// What the words of an expression may mean.
struct Scope {
  const Reading& reading;
  const Variables& variables;
  const NodeNames& nodes;
  NodeId from;  // the node that owns the expression
  Functions* functions = nullptr;
  const Bindings* bindings = nullptr;
  bool is_unused = false;  // of a tree that is not run: `$name` may be an
                           // argument of the SubTree that is missing
};

// True for a list that begins with `:=`.
bool is_assignment(const Reading& reading, FormId form);

// An expression of any type; Broken after an error, Word for a word alone.
Operand read_operand(const Scope& scope, FormId form);

// A truth-valued expression; nothing after an error.
std::optional<Expression> read_condition(const Scope& scope, FormId form);

// `(:= variable value)`; nothing after an error.
std::optional<StateAssignment> read_assignment(const Scope& scope, FormId form);

struct Operator {
  std::string_view sign;
  Operation operation;
  std::size_t least;
  std::size_t most;  // operands
};
// Null when there is none of that sign.
const Operator* find_operator(std::string_view sign);

// Reads operands within a scope; every error is reported and gives Broken.
class Operands {
 public:
  explicit Operands(const Scope& scope) : scope_(scope) {}

  // A form that is no list.
  Operand atom(FormId form);
  static Operand constant(FormId form, int value, int decimals = 0);

  // The operand as that type; a word becomes a variable.
  Operand wanted(Operand value, Type type);
  // A word beside an enumeration: one of its states, else a variable.
  Operand beside(Operand word, StateVariableId enumeration);
  // What bare words beside `=` mean.
  void settle_words(Operand& left, Operand& right);

  // True when `=` may stand between the two.
  bool are_comparable(const Operand& left, const Operand& right);
  // True when the value, a state or a variable, is one of the states of `of`.
  bool same_states(const Operand& value, StateVariableId of);

  Operand mismatch(const Operand& value, std::string needed,
                   std::string help = {});
  Operand error(SourceSpan span, std::string_view code, std::string message,
                std::string label = {}, std::string help = {});

 private:
  const Form& form(FormId id) const { return scope_.reading.form(id); }

  Operand number(FormId form);
  Operand bound(FormId form, const Binding& binding);
  Operand status(FormId form, std::string_view name);
  Operand variable(Operand word);
  Operand unknown(const Form& word);
  Operand beside_status(Operand word);
  bool is_state_of(const Operand& word, const Operand& variable) const;
  void settle(Operand& word, const Operand& neighbour);
  std::string quoted(const Operand& value) const;

  const Scope& scope_;
};

}  // namespace btcheck::btf

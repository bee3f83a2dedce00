// SPDX-License-Identifier: MIT
//
// Scripts of BehaviorTree.CPP 4: their words, their trees of operations, and
// the names in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/enumerators.hpp"

namespace btcheck::btcpp {

enum class ScriptTokenKind : unsigned char {
  Name,
  Number,  // decimal or hexadecimal
  Truth,   // true, false
  Text,    // in single quotes; before 4.9 in double quotes as well
  Operator,
  Bad,  // an unfinished string or number, a character of no operator
  End
};

struct ScriptToken {
  ScriptTokenKind kind = ScriptTokenKind::End;
  std::string_view text;  // as written, quotes included
  std::size_t at = 0;     // byte
};

// The last is the End; the text must outlive them.
std::vector<ScriptToken> tokens_of(std::string_view script,
                                   int release = kNewestRelease);

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
  bool compares_with_itself = false;  // as releases::kComparesWithItself says
  bool compares_no_mixture = false;   // likewise kComparesNoMixture
  bool numbers_refuse_texts = false;  // and kNumbersRefuseTexts
  bool texts_are_true = false;        // kTextsAreTrue
  bool converts_unchecked = false;    // kConvertsUnchecked
  // What a text beside a number may name; nullptr where nothing is declared.
  std::shared_ptr<const ScriptEnums> enums;
  std::vector<std::uint32_t> statements;  // indices of terms, in order
};

// What a script does with a name.
enum class ScriptUse : unsigned char {
  Read,
  Create,  // x := …
  Change   // x = …, x += …: the entry must be there already
};

struct ScriptName {
  std::string name;  // with the '@' of the root's blackboard
  ScriptUse use = ScriptUse::Read;
  std::size_t at = 0;  // byte
};

struct ScriptSyntax {
  // Why it is no script, "an operand is missing", or "".
  std::string flaw;
  std::size_t flaw_at = 0;        // byte
  std::vector<ScriptName> names;  // in the order of the text
  ScriptTree tree;                // of a script without a flaw
};

// As this release of BehaviorTree.CPP reads it, 4.8.3 is 40803. A declared
// enumerator that is read is a number (ExprName of operators.hpp).
ScriptSyntax parse_script(std::string_view script, int release = kNewestRelease,
                          std::shared_ptr<const ScriptEnums> enums = nullptr);
// One of the document's nodes.
ScriptSyntax parse_script(std::string_view script,
                          const BtcppDocument& document);
// What a contract says of entries: its enumerators are of type int.
ScriptSyntax parse_contract_script(std::string_view script,
                                   const BtcppDocument& document);

// The place of some bytes of a script; of the whole script when entities or
// line ends lie between them.
BtcppPlace place_in(const BtcppAttribute& script, std::size_t at,
                    std::size_t length);

}  // namespace btcheck::btcpp

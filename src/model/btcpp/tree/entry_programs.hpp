// SPDX-License-Identifier: MIT
//
// What the nodes of an XML tree do with blackboard entries, as programs over
// real values. A run over state variables, which may stand for many values
// each, is executed again with these: the second opinion on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/script/domain.hpp"
#include "model/btcpp/script/script.hpp"
#include "model/btcpp/script/value.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// Whether two values may be equal, and whether they may differ.
struct Equality {
  bool may_hold = false;
  bool may_fail = false;
};

// Compares the values of two entries; a literal is a text. A Switch since 4.5
// takes the names of enumerators for their numbers. One that is not declared
// may be any number, but not that of another name.
Equality compared(PortComparison how, const ScriptValue& one,
                  const ScriptValue& other, const ScriptEnums* enums = nullptr);

// Whether that depends on an enumerator that is not declared: a name beside a
// number.
bool is_beside_enumerator(PortComparison how, const ScriptValue& one,
                          const ScriptValue& other, const ScriptEnums* enums);

// Whether a port of a number, read from an entry of this value, may have one,
// and whether getInput may fail (TreeNode::getInputStamped,
// include/behaviortree_cpp/tree_node.h of 4.10; Any::cast, SafeAny's
// convertNumber). Of what a leaf has written it is taken to suit.
struct PortReading {
  bool may_suit = false;
  bool may_throw = false;
};
PortReading read_by_port(PortType type, const ScriptValue& value);

// Index into EntryPrograms::entries.
using EntryNumber = std::uint32_t;

// What a node reads or copies: an entry, or the text that is written.
struct ProgramOperand {
  std::optional<EntryNumber> entry;
  std::string text;
};

struct WrittenEntry {
  EntryNumber entry = 0;
  ScriptValue value;
};

struct EntryProgram {
  enum class Kind : std::uint8_t {
    Script,
    Setting,
    Unsetting,
    Equality,
    Reading
  };
  Kind kind = Kind::Script;
  std::string text;  // for people
  // Script: operands of Name terms are in `names`, by the number of the term.
  ScriptTree tree;
  std::vector<EntryNumber> names;
  std::vector<bool> is_own_name;  // likewise, as of SettingPlace
  bool is_condition = false;      // its last value has to be a truth value
  bool is_of_contract = false;
  // Setting: `left` is written, `right` copied. Unsetting: `left` is removed.
  // Equality: both are compared. Reading: `left`, by a port of `port`.
  ProgramOperand left;
  ProgramOperand right;
  PortComparison how = PortComparison::Switch;
  PortType port = PortType::Any;
  bool is_own = true;  // Setting: as of SettingPlace

  // Script: what a leaf writes by its ports before, for certain or perhaps.
  std::vector<WrittenEntry> writes;
  bool writes_surely = false;

  std::vector<EntryNumber> entries() const;  // that it mentions
};

struct ProgramEntry {
  std::string name;     // as the user knows it
  ScriptValue initial;  // Unknown where the program decides
  EntryType declared = EntryType::Free;
  bool exists = false;              // before anything has written it
  bool is_typed_by_leaves = false;  // as in ScriptWriters
  bool is_foreign = false;          // something else may write it at any time
  bool is_enumerator = false;       // perhaps; nothing writes it then
  // What it is declared to hold: all else ends the run.
  std::optional<DeclaredDomain> limits;
  // The state variable, where there is one: it may stand for many values.
  std::optional<StateVariableId> variable;
  std::size_t group = 0;      // the same for entries that scripts use together
  std::uint32_t subtree = 0;  // whose blackboard it is on
  std::string key;            // and its name there
};

struct EntryPrograms {
  int release = kNewestRelease;              // of the engine
  std::shared_ptr<const ScriptEnums> enums;  // nullptr: none is declared
  std::vector<ProgramEntry> entries;
  std::vector<EntryProgram> programs;
};

// The values that the entries have along one run.
class EntryExecution {
 public:
  explicit EntryExecution(const EntryPrograms& programs);

  // Executes a program. False when it cannot have this outcome; then nothing
  // has changed. Where a value is not known, every outcome is possible.
  bool execute(const ScriptStep& step);
  // Executes the steps of one edge, in order. Returns the first that cannot
  // have its outcome, or nullptr; those before it have been executed.
  const ScriptStep* refused(const std::vector<ScriptStep>& steps);

  const std::vector<ScriptValue>& values() const { return values_; }
  // Whether an outcome so far is one of several, and which depends on what the
  // program registers as an enumerator.
  bool rests_on_enumerator() const { return rests_on_enumerator_; }

 private:
  const EntryPrograms& programs_;
  bool rests_on_enumerator_ = false;
  std::vector<ScriptValue> values_;  // by EntryNumber
};

// "5", "0.5", "'idle'", "nothing", "unknown".
std::string shown(const ScriptValue& value);

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// Compiles the scripts of a tree: into guards and assignments over its state
// variables, and into programs that are executed on real values.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/entries/meaning.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

enum class ScriptRole : std::uint8_t {
  Condition,    // its value decides
  Action,       // its value does not matter
  Requirement,  // a condition that a leaf has by its contract
  Effect        // what the leaf writes, by its contract
};

class NodeScripts {
 public:
  // The expansion must outlive this.
  NodeScripts(const BtcppExpansion& expansion, const ContractScripts& contracts,
              const ScriptDetail& detail = {});

  // The entries that become state variables. They change only where a script
  // writes them.
  const std::vector<StateVariable>& variables() const {
    return world_.variables;
  }

  const std::map<EntryName, StateVariableId>& entries() const {
    return world_.of;
  }

  // The code of one script, inside a subtree.
  Script script(ScriptRole role, std::uint32_t subtree, std::string_view code);
  // Whether two ports are equal, each a literal or an entry `{name}`. A port
  // that cannot be read is equal to none.
  Script equality(std::uint32_t subtree, PortComparison how,
                  std::string_view one, std::string_view other);
  // What a node reads by a port of a number, `{name}`; nothing where it cannot
  // throw as far as the tree shows.
  std::optional<Script> reading(std::uint32_t subtree, PortType type,
                                std::string_view name, std::string_view value);
  Script set_blackboard(const BtcppInstance& node);
  Script unset_blackboard(const BtcppInstance& node);

  // Adds what a leaf's ports write to its contract.
  void add_port_writes(std::uint32_t instance, LeafContract& contract);

  // Why a declared entry has too many values, or "".
  std::string why_too_large(std::uint32_t subtree, std::string_view name) const;
  // The type that the ports of the tree give it, if they do.
  EntryType type_by_ports(std::uint32_t subtree, std::string_view name) const;
  // The declared entries that ports of a leaf may write, or only read: no model
  // says which way they go.
  std::vector<EntryName> written_by_open_ports(std::uint32_t instance) const;

  // Why the entry that a name means has no state variable; nothing when it has.
  std::optional<std::string> why_abstracted(std::uint32_t subtree,
                                            std::string_view name) const;

  // Once all scripts are compiled: the programs, and the entries that may have
  // values here that they cannot have in the engine.
  std::shared_ptr<const EntryPrograms> programs() const { return programs_; }
  std::vector<OpenEntry> open_entries() const;

 private:
  bool may_throw_as_said(const EntryProgram& program,
                         const ScriptMeaning& meaning) const;
  std::int32_t add(EntryProgram program);
  void add_measurements(const EntryName& entry, StateVariableId variable);
  EntryNumber number_of(const EntryName& entry);
  ProgramOperand operand_of(std::uint32_t subtree, std::string_view port);
  // Remembers entries that are told apart too roughly for this.
  void note_rough(const EntryProgram& program);
  // Remembers which of two values may be an enumerator.
  void note_open_case(const EntryProgram& program, const ScriptValue& one,
                      const ScriptValue& other);
  // Whether a name that is read may be an enumerator that is not declared.
  bool may_be_enumerator(const EntryName& entry) const;

  const BtcppExpansion& expansion_;
  ScriptWorld world_;
  std::shared_ptr<EntryPrograms> programs_;
  std::map<EntryName, EntryNumber> numbers_;
  std::set<EntryNumber> rough_;
  // By entry: what may be an enumerator, in a Switch, and meets a number there.
  std::map<EntryNumber, std::set<std::string>> open_cases_;
};

}  // namespace btcheck::btcpp

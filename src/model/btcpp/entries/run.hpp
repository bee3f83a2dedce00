// SPDX-License-Identifier: MIT
//
// Symbolic execution: a script run on all values of the entries at once.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "model/btcpp/entries/guard.hpp"
#include "model/btcpp/entries/world.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/script/script.hpp"

namespace btcheck::btcpp {

// Where a value counts as true.
struct ScriptTruthGuards {
  ScriptGuard hold;
  ScriptGuard fail;
  ScriptGuard yields;    // one of the two
  ScriptGuard no_truth;  // it may be no truth value
};

// Every guard is a condition on the values of the entries before the run.
class ScriptRun {
 public:
  using OnKeep = std::function<void(StateVariableId, const ScriptValue&)>;

  // What a leaf writes by its contract does not depend on what was there.
  ScriptRun(const BtcppExpansion& expansion, const ScriptWorld& world,
            std::uint32_t subtree, bool is_of_contract = false)
      : expansion_(expansion),
        world_(world),
        subtree_(subtree),
        is_of_contract_(is_of_contract) {}

  // Restricts the run to states in which the entry has this value of its domain
  // or a later one.
  void only_from(StateVariableId entry, std::size_t value) {
    restricted_ = entry;
    first_value_ = value;
  }

  // Values that entries are taken to hold where theirs is not known; they must
  // outlive the run.
  void take_for_open(const std::map<EntryName, ScriptValue>& values) {
    taken_ = &values;
  }

  // `call` gets every value that an entry is given, in its domain or not.
  // Without it, a value outside the domain becomes Any.
  void on_keep(OnKeep call) { on_keep_ = std::move(call); }

  // One statement; its last value is kept for `last`. Trees deeper than
  // kMostScriptDepth are refused by the callers.
  void execute(const ScriptTree& tree, std::uint32_t statement);

  // What SetBlackboard does; where it succeeds, and where it fails because
  // there is nothing to copy.
  struct SettingGuards {
    ScriptGuard succeeds;
    ScriptGuard fails;
  };
  // `entry` is empty where the entry is not modelled.
  SettingGuards set(std::optional<StateVariableId> entry,
                    const Setting& setting);

  // Of the last statement, where the run comes to its end.
  ScriptTruthGuards last_truth() const;
  // The entries that were assigned to, afterwards.
  const std::map<StateVariableId, ScriptOptions>& entries() const {
    return entries_;
  }
  const ScriptGuard& throws() const { return throws_; }
  // Where it reads an entry that the tree has not written: the engine throws
  // unless the program around the tree has written it.
  const ScriptGuard& lacks() const { return lacks_; }
  // Where an entry gets what it is declared not to hold, or a leaf writes what
  // it cannot.
  const ScriptGuard& leaves() const { return leaves_; }
  // Whether more is allowed than the engine can do, though all operands are
  // known.
  bool is_rough() const { return is_rough_; }
  const ScriptGuard& completes() const { return completes_; }

 private:
  using Entries = std::map<StateVariableId, ScriptOptions>;

  ScriptResult evaluate(const ScriptTree& tree, std::uint32_t term);
  ScriptResult prefix(const ScriptTree& tree, const ScriptTerm& term);
  ScriptResult binary(const ScriptTree& tree, const ScriptTerm& term);
  ScriptResult logic(const ScriptTree& tree, const ScriptTerm& term);
  ScriptResult comparison(const ScriptTree& tree, const ScriptTerm& term);
  ScriptResult choice(const ScriptTree& tree, const ScriptTerm& term);
  ScriptResult assignment(const ScriptTree& tree, const ScriptTerm& term);
  ScriptResult foreign_assignment(const ScriptTerm& term,
                                  const ScriptResult& value);
  ScriptResult compare(const ScriptTree& tree, ScriptComparison by,
                       const ScriptResult& left, const ScriptResult& right);
  ScriptResult reading(const ScriptTree& tree, const EntryName& entry);
  ScriptValue open_value(const EntryName& entry, ScriptValue value) const;

  ScriptGuard presence(StateVariableId entry, ScriptOperation operation);
  ScriptOptions held(StateVariableId entry) const;
  struct Source {
    ScriptOptions values;
    ScriptGuard fails;
  };
  Source source_of(const Setting& setting);
  ScriptResult stored(StateVariableId entry, const ScriptOptions& values,
                      const Setting& setting);
  // The outcomes for all pairs, told apart where they may.
  template <class Apply>
  ScriptResult paired(const ScriptOptions& left, const ScriptOptions& right,
                      Apply apply);
  ScriptOptions values_of(StateVariableId entry, const Entries& among) const;
  ScriptResult written(StateVariableId entry, bool is_own,
                       const ScriptResult& value);
  // Those that the entry is declared to hold; elsewhere the run ends.
  ScriptResult within(StateVariableId entry, ScriptResult values);
  void keep(StateVariableId entry, const ScriptResult& values);
  // The entries are as one branch or the other left them.
  void join(const ScriptGuard& where, const Entries& one,
            const ScriptGuard& elsewhere, const Entries& other);
  void may_throw(const ScriptGuard& where);
  void may_lack(const ScriptGuard& where);
  int engine() const { return expansion_.document->engine(); }

  const BtcppExpansion& expansion_;
  const ScriptWorld& world_;
  std::uint32_t subtree_;
  bool is_of_contract_;
  bool is_rough_ = false;
  std::optional<StateVariableId> restricted_;
  std::size_t first_value_ = 0;
  const std::map<EntryName, ScriptValue>* taken_ = nullptr;
  OnKeep on_keep_;
  Entries entries_;  // those assigned to
  int kept_ = 0;     // assignments so far
  ScriptGuard path_ = ScriptGuard::always();
  ScriptGuard throws_;
  ScriptGuard lacks_;
  ScriptGuard leaves_;
  ScriptGuard completes_ = ScriptGuard::always();
  ScriptResult last_;
};

// Scripts that are nested more deeply are not run: they may do anything.
inline constexpr int kMostScriptDepth = 500;
bool is_too_deep(const ScriptTree& tree);

}  // namespace btcheck::btcpp

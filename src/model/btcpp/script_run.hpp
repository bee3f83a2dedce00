// SPDX-License-Identifier: MIT
//
// A script executed on all values of the entries at once.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "model/btcpp/script_domain.hpp"
#include "model/btcpp/script_guard.hpp"
#include "model/btcpp/script_options.hpp"
#include "model/btcpp/script_tree.hpp"
#include "model/btcpp/script_writers.hpp"

namespace btcheck::btcpp {

// Where a value counts as true.
struct ScriptTruthGuards {
  ScriptGuard hold;
  ScriptGuard fail;
  ScriptGuard yields;    // one of the two
  ScriptGuard no_truth;  // it may be no truth value
};

// Symbolic execution: every guard speaks of the values that the entries have
// before the run.
class ScriptRun {
 public:
  using OnKeep = std::function<void(StateVariableId, const ScriptValue&)>;

  ScriptRun(const BtcppExpansion& expansion, const ScriptWorld& world,
            std::uint32_t subtree)
      : expansion_(expansion), world_(world), subtree_(subtree) {}

  // Called with what an entry comes to keep, in the domain or not, and with
  // texts that it does not keep.
  void on_keep(OnKeep call) { on_keep_ = std::move(call); }

  // One statement; its last value is kept for `last`. Trees deeper than
  // kMostScriptDepth are refused by the callers.
  void execute(const ScriptTree& tree, std::uint32_t statement);

  // What SetBlackboard does, where it succeeds.
  void set(StateVariableId entry, const Setting& setting);
  // What can be read: a read of an unset entry throws.
  ScriptOptions read(const EntryName& entry);

  // Of the last statement, where the run comes to its end.
  ScriptTruthGuards last_truth() const;
  // The entries that were assigned to, afterwards.
  const std::map<StateVariableId, ScriptOptions>& entries() const {
    return entries_;
  }
  const ScriptGuard& throws() const { return throws_; }
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
  ScriptResult compare(ScriptComparison by, const ScriptResult& left,
                       const ScriptResult& right);
  ScriptResult reading(const EntryName& entry);

  ScriptTruthGuards truth(const ScriptResult& of,
                          ScriptTruth (*judge)(const ScriptValue&)) const;
  ScriptResult from_truth(const ScriptGuard& hold, const ScriptGuard& fail,
                          const ScriptGuard& yields);

  ScriptGuard presence(StateVariableId entry);
  ScriptResult replaced(StateVariableId entry, const ScriptResult& value);
  ScriptResult changed(StateVariableId entry, ScriptOperation operation,
                       const ScriptResult& by);
  ScriptOptions values_of(StateVariableId entry) const;
  ScriptOptions at_first(StateVariableId entry) const;
  void keep(StateVariableId entry, const ScriptResult& values);
  // Sets the entries to what one branch left them with, or another.
  void join(const ScriptGuard& where, const Entries& one,
            const ScriptGuard& elsewhere, const Entries& other);
  void may_throw(const ScriptGuard& where);

  const BtcppExpansion& expansion_;
  const ScriptWorld& world_;
  std::uint32_t subtree_;
  OnKeep on_keep_;
  Entries entries_;  // those assigned to
  int kept_ = 0;     // assignments so far
  ScriptGuard path_ = ScriptGuard::always();
  ScriptGuard throws_;
  ScriptGuard completes_ = ScriptGuard::always();
  ScriptResult last_;
};

inline constexpr int kMostScriptDepth = 500;

}  // namespace btcheck::btcpp

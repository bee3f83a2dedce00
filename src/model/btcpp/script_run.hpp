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
#include "model/btcpp/script_tree.hpp"
#include "model/btcpp/script_writers.hpp"

namespace btcheck::btcpp {

// The values that something may come to, and where: several guards may be true
// at once. Where none is, it throws.
using ScriptOptions = std::map<ScriptValue, ScriptGuard>;

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

  // Called with what an entry comes to keep, in the domain or not.
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

 private:
  struct Result {
    ScriptOptions options;
    ScriptGuard yields;
  };
  struct Collected;
  using Entries = std::map<StateVariableId, ScriptOptions>;

  Result evaluate(const ScriptTree& tree, std::uint32_t term);
  Result prefix(const ScriptTree& tree, const ScriptTerm& term);
  Result binary(const ScriptTree& tree, const ScriptTerm& term);
  Result logic(const ScriptTree& tree, const ScriptTerm& term);
  Result comparison(const ScriptTree& tree, const ScriptTerm& term);
  Result choice(const ScriptTree& tree, const ScriptTerm& term);
  Result assignment(const ScriptTree& tree, const ScriptTerm& term);
  Result foreign_assignment(const ScriptTerm& term, const Result& value);
  Result compare(ScriptComparison by, const Result& left, const Result& right);
  Result reading(const EntryName& entry);

  ScriptTruthGuards truth(const Result& of,
                          ScriptTruth (*judge)(const ScriptValue&)) const;
  Result from_truth(const ScriptGuard& hold, const ScriptGuard& fail,
                    const ScriptGuard& yields);

  Result replaced(StateVariableId entry, ScriptOperation operation,
                  const Result& value);
  Result changed(StateVariableId entry, ScriptOperation operation,
                 const Result& by);
  ScriptOptions values_of(StateVariableId entry) const;
  ScriptOptions at_first(StateVariableId entry) const;
  void keep(StateVariableId entry, const Result& values);
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
  Result last_;
};

inline constexpr int kMostScriptDepth = 500;

}  // namespace btcheck::btcpp

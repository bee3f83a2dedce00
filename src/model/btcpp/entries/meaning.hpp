// SPDX-License-Identifier: MIT
//
// Scripts as assignments to state variables and conditions on them.
#pragma once

#include <cstdint>
#include <vector>

#include "model/btcpp/entries/world.hpp"
#include "model/tree/expression.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// What a script, or a leaf that writes entries, does. The conditions are about
// the state before it, are never the empty expression, and do not exclude each
// other: whatever the engine does without an exception, one of them allows.
// Where `may_end` is false the engine is certain to throw; for a condition, so
// it is where neither `may_hold` nor `may_fail` is true.
//
// It can throw elsewhere too, where the program around the tree has given
// entries types that scripts cannot give, such as unsigned integers.
struct ScriptMeaning {
  // In this order, each over the state that the earlier ones leave. An entry
  // that may get one of several values becomes unknown.
  std::vector<StateAssignment> assignments;
  Expression may_hold;   // the last value may be true
  Expression may_fail;   // and false
  Expression may_end;    // it may come to its end, whatever the last value
  Expression may_throw;  // it may not come to its end
  // As a condition, it may throw here too: the last value may be no truth.
  Expression may_be_no_truth;
  // It reads an entry that the tree has not written: the engine throws unless
  // the program around the tree has written it. Not always part of `may_throw`.
  Expression may_lack;
  // It gives an entry what that is declared not to hold.
  Expression may_leave;
  // More is allowed than the engine does, though no operand is unknown.
  bool is_rough = false;
  // The conditions had to be made simpler: where it throws for certain, they
  // may say that it can go on.
  bool is_simplified = false;
};

// Of a script without a flaw, inside a subtree.
ScriptMeaning compile_script(const BtcppExpansion& expansion,
                             const ScriptWorld& world, std::uint32_t subtree,
                             const ScriptSyntax& syntax,
                             bool is_of_contract = false);

// Of a SetBlackboard: `may_hold` where it may succeed, with the assignments,
// and `may_fail` where it may fail, without them.
ScriptMeaning compile_set_blackboard(const BtcppExpansion& expansion,
                                     const ScriptWorld& world,
                                     const BtcppInstance& node);

// What a leaf writes by its ports to entries that are not declared: for
// certain, or perhaps. An entry that has no value, and perhaps gets one, is
// unknown.
std::vector<StateAssignment> compile_port_writes(
    const ScriptWorld& world, const std::vector<PortWrite>& writes,
    bool is_sure);

// Of an UnsetBlackboard, which always succeeds.
ScriptMeaning compile_unset_blackboard(const BtcppExpansion& expansion,
                                       const ScriptWorld& world,
                                       const BtcppInstance& node);

}  // namespace btcheck::btcpp

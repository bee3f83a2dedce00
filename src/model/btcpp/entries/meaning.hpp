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

// What a script, or a leaf that writes entries, does. The conditions are over
// the state before it, are never the empty expression, and may be true
// together: every run of the engine that does not end in an exception is
// allowed by one of them. Where `may_end` is false the engine throws for
// certain, and as a condition where neither `may_hold` nor `may_fail` is true.
//
// Types that only the program around the tree gives to entries, like unsigned
// integers, can make the engine throw elsewhere, too.
struct ScriptMeaning {
  // In this order, each over the state that the earlier ones leave; with what
  // may be one value or another, the entry becomes unknown.
  std::vector<StateAssignment> assignments;
  Expression may_hold;   // the last value may be true
  Expression may_fail;   // and false
  Expression may_end;    // it may come to its end, whatever the last value
  Expression may_throw;  // it may not come to its end
  // As a condition, it may throw here too: the last value may be no truth.
  Expression may_be_no_truth;
  // It reads what the tree has not written: the engine throws unless the
  // program around the tree has written it. Part of `may_throw` or not.
  Expression may_lack;
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

// Of an UnsetBlackboard, which always succeeds.
ScriptMeaning compile_unset_blackboard(const BtcppExpansion& expansion,
                                       const ScriptWorld& world,
                                       const BtcppInstance& node);

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
#include "model/btcpp/leaf_types.hpp"

#include <algorithm>
#include <array>

namespace btcheck::btcpp {

LeafContract leaf_contract(Profile, const BtcppNode& leaf) {
  LeafContract contract;
  contract.may_run = leaf.kind == BtcppKind::Action;
  contract.memory = contract.may_run ? LeafMemory::Latched : LeafMemory::None;
  if (leaf.id == "AlwaysSuccess") contract = {true, false, false};
  if (leaf.id == "AlwaysFailure") contract = {false, true, false};
  if (leaf.id == "GoalUpdated" || leaf.id == "DistanceTraveled" ||
      leaf.id == "TimeExpired") {
    contract.memory = LeafMemory::FirstTickFails;
  }
  if (leaf.id == "GlobalUpdatedGoal") {
    contract.memory = LeafMemory::FirstTickSucceeds;
  }
  return contract;
}

}  // namespace btcheck::btcpp

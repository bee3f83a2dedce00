// SPDX-License-Identifier: MIT
#include "model/btcpp/tree/leaf_contract.hpp"

#include "model/btcpp/leaf_types.hpp"

namespace btcheck::btcpp {
namespace {

LeafMemory memory_of(LeafBehaviour behaviour) {
  switch (behaviour) {
    case LeafBehaviour::Latched:
      return LeafMemory::Latched;
    case LeafBehaviour::FirstTickFails:
      return LeafMemory::FirstTickFails;
    case LeafBehaviour::FirstTickOfLifeFails:
      return LeafMemory::FirstTickOfLifeFails;
    case LeafBehaviour::FirstTickOfLifeSucceeds:
      return LeafMemory::FirstTickOfLifeSucceeds;
    case LeafBehaviour::SuccessStays:
      return LeafMemory::SuccessStays;
    case LeafBehaviour::Restarting:
    case LeafBehaviour::Synchronous:
    case LeafBehaviour::Computed:
      return LeafMemory::None;
  }
  return LeafMemory::None;
}

// ControllerSelector and its like fail only where nothing has been selected and
// no default is written
// (nav2_behavior_tree/plugins/action/*_selector_node.cpp).
bool has_literal_default(const BtcppNode& leaf) {
  if (!leaf.id.ends_with("Selector")) return false;
  for (const BtcppAttribute& port : leaf.ports) {
    if (port.name.starts_with("default_")) {
      return !port.value.empty() && port.value[0] != '{';
    }
  }
  return false;
}

}  // namespace

LeafContract leaf_contract(BtcppRelease release, const BtcppNode& leaf) {
  LeafContract contract;
  const LeafTypeRow* row = builtin_leaf(release, leaf.id);
  if (row == nullptr) row = nav2_leaf(leaf.id);
  if (row == nullptr) {
    contract.may_run = leaf.kind == BtcppKind::Action;
    contract.memory = contract.may_run ? LeafMemory::Unknown : LeafMemory::None;
    return contract;
  }
  contract.may_succeed = row->may_succeed;
  contract.may_fail = row->may_fail;
  contract.may_run = may_run(*row);
  contract.memory = memory_of(row->behaviour);
  if (has_literal_default(leaf)) contract.may_fail = false;
  return contract;
}

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
//
// What a tick of BehaviorTree.CPP costs: `btcpp_tick TREE.xml`. Its leaves do
// as little as those of engine_tick: `Run` runs for three ticks and succeeds,
// `Ok` succeeds at once. A program of its own, for the library may bring
// another tinyxml2 along than ours.
#include <behaviortree_cpp/bt_factory.h>

#include "file_text.hpp"
#include "measured_ticks.hpp"

namespace {

class Run : public BT::StatefulActionNode {
 public:
  using StatefulActionNode::StatefulActionNode;
  static BT::PortsList providedPorts() { return {}; }

  BT::NodeStatus onStart() override {
    turns_ = 0;
    return BT::NodeStatus::RUNNING;
  }
  BT::NodeStatus onRunning() override {
    return ++turns_ < 3 ? BT::NodeStatus::RUNNING : BT::NodeStatus::SUCCESS;
  }
  void onHalted() override {}

 private:
  int turns_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  BT::BehaviorTreeFactory factory;
  factory.registerNodeType<Run>("Run");
  factory.registerSimpleCondition(
      "Ok", [](BT::TreeNode&) { return BT::NodeStatus::SUCCESS; });
  BT::Tree tree = factory.createTreeFromText(btcheck::file_text(argv[1]));
  const auto tick = [&] {
    return tree.tickExactlyOnce() == BT::NodeStatus::RUNNING;
  };
  measure_ticks("BehaviorTree.CPP", [&] {
    tree.haltTree();
    return tick;
  });
}

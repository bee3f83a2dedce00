// SPDX-License-Identifier: MIT
//
// A robot whose battery is soon empty. The rule `keeps_power` is violated then,
// the condition `power_lost` of the tree succeeds, and the mission ends where
// the tree says; with the word `halt`, the observer ends it in that very tick.
#include <btcheck/observer.hpp>

#include <chrono>
#include <iostream>
#include <string>

namespace {

int battery = 40;

class ReadBattery : public BT::SyncActionNode {
 public:
  using BT::SyncActionNode::SyncActionNode;
  static BT::PortsList providedPorts() {
    return {BT::OutputPort<int>("level")};
  }
  BT::NodeStatus tick() override {
    setOutput("level", battery -= 10);
    return BT::NodeStatus::SUCCESS;
  }
};

class FollowPath : public BT::StatefulActionNode {
 public:
  using BT::StatefulActionNode::StatefulActionNode;
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus onStart() override { return BT::NodeStatus::RUNNING; }
  BT::NodeStatus onRunning() override { return BT::NodeStatus::RUNNING; }
  void onHalted() override { std::cout << "the wheels stand still\n"; }
};

BT::NodeStatus succeed(BT::TreeNode&) { return BT::NodeStatus::SUCCESS; }

}  // namespace

int main(int argc, char** argv) {
  BT::BehaviorTreeFactory factory;
  btcheck::register_nodes(factory);
  factory.registerNodeType<ReadBattery>("ReadBattery");
  factory.registerNodeType<FollowPath>("FollowPath");
  for (const char* leaf : {"StopRobot", "ComputePath", "DropLoad"}) {
    factory.registerSimpleAction(leaf, succeed);
  }
  BT::Tree tree = factory.createTreeFromFile(MISSION);

  btcheck::ObserverOptions options;
  options.log = "robot.btlog";
  btcheck::Observer observer(tree, btcheck::read_table(TABLE), options);
  observer.log();
  if (argc > 1 && std::string(argv[1]) == "halt") observer.halt("keeps_power");

  BT::NodeStatus status = BT::NodeStatus::RUNNING;
  while (status == BT::NodeStatus::RUNNING) {
#if BTCHECK_ENGINE == 4
    status = observer.tickOnce();
#else
    status = observer.tickRoot();
#endif
    std::cout << "battery " << battery << "%, " << BT::toStr(status) << "\n";
    tree.sleep(std::chrono::milliseconds(10));
  }
  return observer.is_violated() ? 1 : 0;
}

// SPDX-License-Identifier: MIT
//
// A robot for `btcheck watch`: BehaviorTree.CPP 4 with a Groot2Publisher.
//
//     run_publisher PORT SECONDS LEGS TICK_MS [LOG.btlog]
//
// ticks a tree of 8 nodes for each leg, and some more, and writes the same with
// FileLogger2. The first tick is two seconds late, so that somebody may look
// on. Every four seconds another of twelve alarms fails for the first time; a
// line says which, and when: microseconds since 1970.
#include <behaviortree_cpp/bt_factory.h>
#include <behaviortree_cpp/loggers/bt_file_logger_v2.h>
#include <behaviortree_cpp/loggers/groot2_publisher.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kAlarms = 12;
constexpr int kAlarmSeconds = 4;

Clock::time_point beginning;
int ticks = 0;

std::int64_t now_in_microseconds() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

// Runs for two ticks, then succeeds.
class Go : public BT::StatefulActionNode {
 public:
  using StatefulActionNode::StatefulActionNode;
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus onStart() override {
    left_ = 2;
    return BT::NodeStatus::RUNNING;
  }
  BT::NodeStatus onRunning() override {
    return --left_ > 0 ? BT::NodeStatus::RUNNING : BT::NodeStatus::SUCCESS;
  }
  void onHalted() override {}

 private:
  int left_ = 0;
};

std::string tree_of(int legs) {
  std::string xml =
      "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"Rounds\">\n"
      "<ReactiveSequence name=\"rounds\">\n<Count name=\"count\" "
      "ticks=\"{ticks}\"/>\n<Sequence name=\"alarms\">\n";
  for (int i = 0; i < kAlarms; ++i) {
    const std::string name = "alarm_" + std::to_string(i);
    xml += "<ForceSuccess><Alarm name=\"" + name + "\" number=\"" +
           std::to_string(i) + "\"/></ForceSuccess>\n";
  }
  xml += "</Sequence>\n<Sequence name=\"legs\">\n";
  for (int i = 0; i < legs; ++i) {
    const std::string n = std::to_string(i);
    xml += "<Sequence name=\"leg_" + n + "\"><Go name=\"go_" + n +
           "\"/><Fallback name=\"look_" + n + "\"><AlwaysFailure name=\"near_" +
           n + "\"/><AlwaysSuccess name=\"far_" + n +
           "\"/></Fallback><Inverter><AlwaysFailure name=\"blocked_" + n +
           "\"/></Inverter><AlwaysSuccess name=\"note_" + n +
           "\"/></Sequence>\n";
  }
  return xml + "</Sequence>\n</ReactiveSequence>\n</BehaviorTree>\n</root>\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "run_publisher PORT SECONDS LEGS TICK_MS [LOG.btlog]\n";
    return 2;
  }
  const auto port = static_cast<unsigned>(std::atoi(argv[1]));
  const double seconds = std::atof(argv[2]);
  const std::chrono::milliseconds period(std::atoi(argv[4]));
  BT::BehaviorTreeFactory factory;
  factory.registerNodeType<Go>("Go");
  factory.registerSimpleAction("Count",
                               [](BT::TreeNode& node) {
                                 node.setOutput("ticks", ++ticks);
                                 return BT::NodeStatus::SUCCESS;
                               },
                               {BT::OutputPort<int>("ticks")});
  factory.registerSimpleCondition(
      "Alarm",
      [](BT::TreeNode& node) {
        const int number = node.getInput<int>("number").value();
        const auto due =
            beginning + std::chrono::seconds(kAlarmSeconds * (number + 1));
        static bool has_failed[kAlarms] = {};
        if (has_failed[number] || Clock::now() < due) {
          return BT::NodeStatus::SUCCESS;
        }
        has_failed[number] = true;
        std::cout << node.name() << " " << now_in_microseconds() << std::endl;
        return BT::NodeStatus::FAILURE;
      },
      {BT::InputPort<int>("number")});
  factory.registerBehaviorTreeFromText(tree_of(std::atoi(argv[3])));
  BT::Tree tree = factory.createTree("Rounds");
  std::optional<BT::FileLogger2> logger;
  if (argc > 5) logger.emplace(tree, argv[5]);
  std::size_t nodes = 0;
  for (const auto& subtree : tree.subtrees) nodes += subtree->nodes.size();
  BT::Groot2Publisher publisher(tree, port);
  std::cout << "nodes " << nodes << std::endl;
  std::this_thread::sleep_for(std::chrono::seconds(2));
  beginning = Clock::now();
  auto next = beginning;
  while (std::chrono::duration<double>(Clock::now() - beginning).count() <
         seconds) {
    tree.tickExactlyOnce();
    next += period;
    std::this_thread::sleep_until(next);
  }
  tree.haltTree();
  std::cout << "ticks " << ticks << std::endl;
}

// SPDX-License-Identifier: MIT
//
// What it costs to watch: ticks of a tree of BehaviorTree.CPP 4 with nobody,
// with its own FileLogger2, and with an observer, in one run and in turn.
//
//     observer_cost TREE TABLE [ROUNDS]
//
// Prints nanoseconds for each change of status that the tree makes.
#include <behaviortree_cpp/loggers/bt_file_logger_v2.h>
#include <btcheck/observer.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

// Counts what a logger would be told.
class Counter : public BT::StatusChangeLogger {
 public:
  explicit Counter(const BT::Tree& tree)
      : BT::StatusChangeLogger(tree.rootNode()) {}
  void callback(BT::Duration, const BT::TreeNode&, BT::NodeStatus,
                BT::NodeStatus) override {
    ++count;
  }
  void flush() override {}
  std::size_t count = 0;
};

BT::Tree tree_of(const std::string& file) {
  static BT::BehaviorTreeFactory factory;
  static bool is_made = false;
  if (!is_made) {
    is_made = true;
    const auto answer = [](BT::NodeStatus status) {
      return [status](BT::TreeNode&) { return status; };
    };
    factory.registerSimpleCondition("Condition0",
                                    answer(BT::NodeStatus::FAILURE));
    factory.registerSimpleCondition("Condition1",
                                    answer(BT::NodeStatus::SUCCESS));
    factory.registerSimpleAction("Action0", answer(BT::NodeStatus::FAILURE));
    factory.registerSimpleAction("Action1", answer(BT::NodeStatus::SUCCESS));
    class Runs : public BT::StatefulActionNode {
     public:
      using BT::StatefulActionNode::StatefulActionNode;
      static BT::PortsList providedPorts() { return {}; }
      BT::NodeStatus onStart() override { return BT::NodeStatus::RUNNING; }
      BT::NodeStatus onRunning() override { return BT::NodeStatus::RUNNING; }
      void onHalted() override {}
    };
    factory.registerNodeType<Runs>("ActionR");
  }
  return factory.createTreeFromFile(file);
}

constexpr int kTicks = 20'000;

double ns_per_tick(BT::Tree& tree) {
  const auto begin = Clock::now();
  for (int i = 0; i < kTicks; ++i) tree.tickExactlyOnce();
  return std::chrono::duration<double, std::nano>(Clock::now() - begin)
             .count() /
         kTicks;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: observer_cost TREE TABLE [ROUNDS]\n");
    return 2;
  }
  const std::string file = argv[1];
  const std::string table = btcheck::read_table(argv[2]);
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 7;
  double changes = 0;
  {
    BT::Tree tree = tree_of(file);
    Counter counter(tree);
    ns_per_tick(tree);
    changes = static_cast<double>(counter.count) / kTicks;
  }
  struct Way {
    const char* name;
    std::function<std::shared_ptr<void>(BT::Tree&)> watch;
    std::vector<double> times = {};
  };
  const auto observed = [&](const char* log) {
    return [&table, log](BT::Tree& tree) -> std::shared_ptr<void> {
      btcheck::ObserverOptions options;
      options.log = log;
      return std::make_shared<btcheck::Observer>(tree, table, options);
    };
  };
  std::vector<Way> ways;
  ways.push_back({"nobody", [](BT::Tree&) { return nullptr; }});
  ways.push_back({"FileLogger2", [](BT::Tree& tree) -> std::shared_ptr<void> {
                    return std::make_shared<BT::FileLogger2>(tree,
                                                             "cost_2.btlog");
                  }});
  ways.push_back({"observer", observed("")});
  ways.push_back({"observer, log", observed("cost.btlog")});
  for (int round = 0; round < rounds; ++round) {
    for (Way& way : ways) {
      BT::Tree tree = tree_of(file);
      const auto watching = way.watch(tree);
      way.times.push_back(ns_per_tick(tree));
    }
  }
  const auto median = [](std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  };
  const double alone = median(ways[0].times);
  std::printf("%.1f changes of status a tick, %d rounds of %d ticks, medians\n",
              changes, rounds, kTicks);
  std::printf("%-16s %10s %22s\n", "watched by", "ns a tick",
              "more, ns a change");
  for (const Way& way : ways) {
    const double time = median(way.times);
    std::printf("%-16s %10.0f %22.0f\n", way.name, time,
                (time - alone) / changes);
  }
  return 0;
}

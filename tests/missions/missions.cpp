// SPDX-License-Identifier: MIT
//
// Missions of the drone of examples/run with random faults, watched by monitors
// at each step: `missions EXAMPLES COUNT [SEED]`.
//
// In C++ and in Python, no mission of drone3-fixed.btf may break a rule of
// drone3-fixed.ltl. Some of drone3.btf, which does not measure the battery on
// the way to the charger, have to break `watched`. Exit code 1 where it is not
// so, or a contract is breached.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

// The leaves of the mission in C++; its `main` is not ours.
#define main fly_drone
#include "../../examples/run/drone.cpp"
#undef main

#include "check/check.hpp"
#include "file_text.hpp"
#include "model/sampling.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "run/engine/tree_engine.hpp"
#include "run/leaves/function_leaves.hpp"
#include "run/process/process_leaves.hpp"
#include "run/record/rule_watch.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kHole =
    "property watched: whenever goto_waypoint@27.running\n"
    "    then measure_battery.ticked within 1 tick\n";
constexpr int kMostTicks = 10'000;

[[noreturn]] void give_up(const std::string& why) {
  std::fputs(("missions: " + why + "\n").c_str(), stderr);
  std::exit(2);
}

// A tree with the rules that its missions are watched by.
class Watched {
 public:
  Watched(const std::string& file, std::string rules)
      : files_{{"rules", std::move(rules)}} {
    const std::string text = file_text(file);
    auto tree = read_btf(file, text);
    if (!tree.value) give_up("cannot read " + file);
    tree_ = std::move(*tree.value);
    auto network =
        lower_values(tree_, SourceText(file, text), TickSemantics::Root);
    if (!network.value) give_up("cannot lower " + file);
    network_ = std::move(*network.value);
    auto made = RunRules::make(tree_, network_, files_);
    if (!made.value) give_up(render(made.diagnostics.front()));
    rules_ = std::move(*made.value);
    system_ = std::make_unique<CompiledNetwork>(network_);
  }

  const BehaviorTree& tree() const { return tree_; }
  const CompiledNetwork& system() const { return *system_; }
  const RunRules& rules() const { return rules_; }

 private:
  std::vector<InputFile> files_;
  BehaviorTree tree_;
  Network network_;
  RunRules rules_;
  std::unique_ptr<CompiledNetwork> system_;
};

// Of one mission.
struct Flown {
  std::string broken;
  std::uint64_t breaches = 0;
  int ticks = 0;
};

Flown fly(const Watched& watched, Leaves& leaves) {
  TreeEngine engine(watched.tree(), watched.system(), leaves, OnBreach::Stop);
  std::string broken;  // the first
  RuleWatch watch(engine, watched.rules(), [&](std::size_t rule, int) {
    if (!broken.empty()) return;
    broken = watched.rules().monitors()[rule].rule->property->name;
  });
  engine.add(watch);
  engine.begin();
  while (engine.state() == EngineState::Ready && engine.ticks() < kMostTicks) {
    engine.tick();
  }
  engine.stop();
  return {broken, engine.breaches(), engine.ticks()};
}

Flown fly_cpp(const Watched& watched, unsigned seed) {
  Drone drone(seed);
  const auto actions = actions_of(drone);
  const BehaviorTree& tree = watched.tree();
  FunctionLeaves leaves(tree, std::chrono::seconds(1));
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const NodeType type = tree.nodes[n].type;
    LeafFunction function;
    function.where = run::Runs::InTick;
    if (type == NodeType::Action) {
      function.function = polled(actions.at(tree.nodes[n].id));
    } else if (type == NodeType::Condition) {
      function.function = run::ConditionFunction(
          [&](const run::Call&) { return !drone.fault(0.005); });
    } else if (type == NodeType::SetSV) {
      function.function = run::MeasureFunction(
          [&](const run::Call&) { return drone.battery(); });
    } else {
      continue;
    }
    leaves.give(NodeId{n}, function);
  }
  leaves.begin();
  Flown flown = fly(watched, leaves);
  leaves.end();
  return flown;
}

Flown fly_python(const Watched& watched, unsigned seed,
                 const std::string& examples) {
  ProcessLeaves leaves(watched.tree(), watched.system(),
                       ProcessPlan{"python3 -B '" + examples + "/run/drone.py'",
                                   std::chrono::seconds(30), 100, seed});
  if (const std::string why = leaves.begin(); !why.empty()) give_up(why);
  Flown flown = fly(watched, leaves);
  leaves.end("the mission is over");
  return flown;
}

bool fly_all(const std::string& examples, bool is_python, bool is_fixed,
             unsigned count, unsigned seed) {
  const std::string name = is_fixed ? "drone3-fixed" : "drone3";
  const Watched watched(examples + "/" + name + ".btf",
                        is_fixed ? file_text(examples + "/drone3-fixed.ltl")
                                 : std::string(kHole));
  const auto begin = std::chrono::steady_clock::now();
  std::atomic<unsigned> next{0};
  std::vector<Flown> flown(count);
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < std::thread::hardware_concurrency(); ++t) {
    threads.emplace_back([&] {
      for (unsigned m = next++; m < count; m = next++) {
        flown[m] = is_python ? fly_python(watched, seed + m, examples)
                             : fly_cpp(watched, seed + m);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::chrono::duration<double> took =
      std::chrono::steady_clock::now() - begin;
  std::uint64_t broken = 0;
  std::uint64_t breaches = 0;
  std::uint64_t ticks = 0;
  std::string first;
  for (unsigned m = 0; m < count; ++m) {
    const Flown& each = flown[m];
    broken += each.broken.empty() ? 0 : 1;
    if (!each.broken.empty() && first.empty()) {
      first = fmt::format("; {} first by seed {}", each.broken, seed + m);
    }
    breaches += each.breaches;
    ticks += static_cast<std::uint64_t>(each.ticks);
  }
  fmt::print(
      "{:6} {:12} {} missions, {} ticks: {} break a rule{}; {} breaches "
      "({:.1f} s)\n",
      is_python ? "Python" : "C++", name, count, ticks, broken, first, breaches,
      took.count());
  std::fflush(stdout);
  return breaches == 0 && (is_fixed ? broken == 0 : broken > 0);
}

}  // namespace
}  // namespace btcheck

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const auto count = static_cast<unsigned>(std::atoi(argv[2]));
  const auto seed = static_cast<unsigned>(argc > 3 ? std::atoi(argv[3]) : 1);
  bool is_well = true;
  for (const bool is_python : {false, true}) {
    for (const bool is_fixed : {true, false}) {
      is_well &= btcheck::fly_all(argv[1], is_python, is_fixed, count, seed);
    }
  }
  return is_well ? 0 : 1;
}

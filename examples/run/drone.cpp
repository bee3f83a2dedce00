// SPDX-License-Identifier: MIT
//
// The drone of the paper's survey mission, simulated, with random faults on the
// battery and the localisation; its tree is run by btcheck's engine.
//
//     drone TREE.btf                     one mission in real time, 10 Hz
//     drone TREE.btf MISSIONS [SEED]     so many, as fast as they go
//
// One mission: actions are functions on threads of their own. Many: they are
// polled within the tick, so that a seed gives the same missions every time.
#include <btcheck/run.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <thread>

namespace {

using namespace btcheck::run;
using Place = std::array<double, 3>;

constexpr Place kCharger{-1, -1, 0.5};
constexpr double kSpeed = 1.5;  // metres in a tick
constexpr auto kTick = std::chrono::milliseconds(100);

// What the robot is: a place, a charge, and bad luck.
class Drone {
 public:
  explicit Drone(unsigned seed) : random_(seed) {
    charge_ = 60 + 40 * chance();
  }

  // One tick of flight; true when it is there.
  bool step_towards(const Place& goal) {
    const std::lock_guard lock(mutex_);
    charge_ -= 0.4;
    double distance = 0;
    for (int i = 0; i < 3; ++i) {
      distance += (goal[i] - place_[i]) * (goal[i] - place_[i]);
    }
    distance = std::sqrt(distance);
    if (distance <= kSpeed) {
      place_ = goal;
      return true;
    }
    for (int i = 0; i < 3; ++i) {
      place_[i] += (goal[i] - place_[i]) * kSpeed / distance;
    }
    return false;
  }
  // One tick at the charger; true when that is enough.
  bool recharge() {
    const std::lock_guard lock(mutex_);
    charge_ += 10;
    return charge_ >= 95;
  }
  const char* battery() {
    const std::lock_guard lock(mutex_);
    if (chance() < 0.005)
      charge_ = std::min(charge_, 5.0);  // a cell has failed
    return charge_ < 15 ? "Critical" : charge_ < 40 ? "Low" : "Good";
  }
  bool fault(double probability) {
    const std::lock_guard lock(mutex_);
    return chance() < probability;
  }
  Place at_height(double height) {
    const std::lock_guard lock(mutex_);
    return {place_[0], place_[1], height};
  }

 private:
  double chance() { return std::uniform_real_distribution<>()(random_); }

  std::mutex mutex_;
  std::mt19937 random_;
  Place place_{0, 0, 0};
  double charge_ = 100;
};

// An action as what it does in each tick: nothing while it goes on.
using Step = std::function<std::optional<bool>()>;
using Begin = std::function<Step(const Call&)>;

Step after_ticks(int ticks, bool result) {
  return [=]() mutable -> std::optional<bool> {
    if (ticks-- > 0) return std::nullopt;
    return result;
  };
}
Step fly(Drone& drone, const Place& goal) {
  return [&drone, goal]() -> std::optional<bool> {
    if (drone.step_towards(goal)) return true;
    return std::nullopt;
  };
}
Step fly_to_waypoint(Drone& drone, const Place& goal) {
  return [&drone, goal, is_there = false]() mutable -> std::optional<bool> {
    is_there = is_there || drone.step_towards(goal);
    if (!is_there) return std::nullopt;
    if (goal == kCharger && !drone.recharge()) return std::nullopt;
    return true;
  };
}

std::map<std::string, Begin> actions_of(Drone& drone) {
  std::map<std::string, Begin> actions;
  actions["start_drone"] = [](const Call&) { return after_ticks(3, true); };
  actions["start_camera"] = [&](const Call&) {
    return after_ticks(2, !drone.fault(0.02));
  };
  actions["takeoff"] = [&](const Call& call) {
    return fly(drone, drone.at_height(call.number("height")));
  };
  actions["goto_waypoint"] = [&](const Call& call) {
    return fly_to_waypoint(
        drone, {call.number("x"), call.number("y"), call.number("z")});
  };
  actions["land"] = [&](const Call&) { return fly(drone, drone.at_height(0)); };
  actions["camera_tracking"] = [&](const Call&) -> Step {
    return [&drone]() -> std::optional<bool> {
      if (drone.fault(0.01)) return true;  // found it
      return std::nullopt;
    };
  };
  actions["shutdown_drone"] = [](const Call&) { return after_ticks(1, true); };
  return actions;
}

// Polled within the tick.
PolledFunction polled(const Begin& begin) {
  return [begin, steps = std::map<std::string, Step, std::less<>>()](
             const Call& call, Turn turn) mutable {
    if (turn == Turn::Halt) return Status::Failure;
    Step& step = steps[std::string(call.node())];
    if (turn == Turn::Start) step = begin(call);
    const std::optional<bool> result = step();
    return !result   ? Status::Running
           : *result ? Status::Success
                     : Status::Failure;
  };
}

// On a thread of its own, a step each tick.
ActionFunction in_task(const Begin& begin) {
  return [begin](const Call& call, std::stop_token stop) {
    const Step step = begin(call);
    while (!stop.stop_requested()) {
      if (const auto result = step()) {
        return *result ? Answer::Success : Answer::Failure;
      }
      std::this_thread::sleep_for(kTick);
    }
    return Answer::Failure;
  };
}

Engine* running = nullptr;
extern "C" void on_interrupt(int) {
  if (running != nullptr) running->stop();
}

Report fly_mission(const std::string& name, const std::string& text,
                   unsigned seed, bool is_real) {
  Drone drone(seed);
  Options options;
  options.period = kTick;
  options.pace = is_real ? Pace::RealTime : Pace::AtOnce;
  Engine engine(name, text, options);
  for (const auto& [leaf, begin] : actions_of(drone)) {
    if (is_real) {
      engine.action(leaf, in_task(begin));
    } else {
      engine.polled(leaf, polled(begin));
    }
  }
  const Runs where = is_real ? Runs::InTask : Runs::InTick;
  engine.condition(
      "localization_ok", [&](const Call&) { return !drone.fault(0.005); },
      where);
  engine.measure(
      "measure_battery", [&](const Call&) { return drone.battery(); }, where);
  engine.on_breach([](const Breach& breach) {
    std::cerr << "tick " << breach.tick << ": " << breach.text << '\n';
  });
  if (is_real) {
    engine.on_event([](const Event& event) {
      if (event.kind != Event::Kind::Answered) return;
      constexpr const char* kWords[] = {"success", "failure", "running",
                                        "halted"};
      std::cout << "tick " << event.tick << ": " << event.node << " -> "
                << kWords[static_cast<int>(event.status)] << '\n';
    });
    running = &engine;
    std::signal(SIGINT, on_interrupt);
  }
  const Report report = engine.run();
  running = nullptr;
  if (is_real) {
    std::ofstream("drone.itf.json") << engine.itf();
    std::cout << report.text << "; the run is in drone.itf.json\n";
  }
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "drone TREE.btf [MISSIONS [SEED]]\n";
    return 2;
  }
  std::ifstream file(argv[1]);
  std::stringstream text;
  text << file.rdbuf();
  const int missions = argc > 2 ? std::atoi(argv[2]) : 0;
  const auto seed = static_cast<unsigned>(argc > 3 ? std::atoi(argv[3]) : 1);
  try {
    if (missions == 0) {
      const Report report =
          fly_mission(argv[1], text.str(), std::random_device()(), true);
      return report.breaches == 0 ? 0 : 1;
    }
    std::map<End, int> ends;
    std::uint64_t breaches = 0;
    std::uint64_t ticks = 0;
    for (int m = 0; m < missions; ++m) {
      const Report report = fly_mission(argv[1], text.str(),
                                        seed + static_cast<unsigned>(m), false);
      ++ends[report.end];
      breaches += report.breaches;
      ticks += static_cast<std::uint64_t>(report.ticks);
    }
    std::cout << missions << " missions, " << ticks
              << " ticks: " << ends[End::Success]
              << " found what they looked for, " << ends[End::Failure]
              << " did not; " << breaches << " breaches\n";
    return breaches == 0 ? 0 : 1;
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}

// SPDX-License-Identifier: MIT
//
// Runs of the published drone mission, made by hand.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trace/hand_made_run.hpp"

namespace btcheck {

struct HandMadeNode {
  int parent;
  const char* type;
  const char* name;
  std::uint32_t line;
  std::uint32_t column;
};

// The tree of examples/drone3.btf.
inline constexpr HandMadeNode kDroneNodes[] = {
    {-1, "BehaviorTree", "drone", 11, 2},
    {0, "Sequence", "Sequence12", 12, 3},
    {1, "ParallelAll", "ParallelAll13", 13, 4},
    {2, "Action", "start_drone", 14, 5},
    {2, "Action", "start_camera", 15, 5},
    {1, "ReactiveSequence", "ReactiveSequence16", 16, 4},
    {5, "Sequence", "Sequence17", 17, 5},
    {6, "Fallback", "Fallback18", 18, 6},
    {7, "ForceFailure", "fail", 19, 7},
    {8, "SetSV", "measure_battery", 20, 8},
    {7, "Eval", "Eval21", 21, 7},
    {7, "ForceFailure", "fail_mission", 22, 7},
    {11, "Action", "land", 23, 8},
    {6, "Eval", "Eval24", 24, 6},
    {6, "Fallback", "Fallback25", 25, 6},
    {14, "Eval", "Eval26", 26, 7},
    {14, "Action", "goto_waypoint", 27, 7},
    {5, "Fallback", "Fallback28", 28, 5},
    {17, "Condition", "localization_ok", 29, 6},
    {17, "ForceFailure", "fail", 30, 6},
    {19, "Action", "land", 31, 7},
    {5, "Sequence", "Sequence32", 32, 5},
    {21, "Action", "takeoff", 33, 6},
    {21, "Parallel", "Parallel34", 34, 6},
    {23, "Action", "camera_track", 35, 7},
    {23, "Repeat", "Repeat36", 36, 7},
    {25, "Sequence", "Sequence37", 37, 8},
    {26, "Eval", "Eval38", 38, 9},
    {26, "Action", "goto_waypoint", 39, 9},
    {26, "Action", "goto_waypoint", 40, 9},
    {26, "Action", "goto_waypoint", 41, 9},
    {26, "Action", "goto_waypoint", 42, 9},
    {26, "Action", "goto_waypoint", 43, 9},
    {26, "Action", "goto_waypoint", 44, 9},
    {21, "Action", "goto_waypoint", 45, 6},
    {21, "Action", "land", 46, 6},
    {21, "Action", "shutdown_drone", 47, 6},
    {21, "Eval", "Eval48", 48, 6}};

inline constexpr std::size_t kLevel = 0;  // variables of the drone
inline constexpr std::size_t kBattery = 1;

inline RecordedRun drone_without_states(std::string source) {
  RecordedRun run;
  run.tree = "drone3.btf";
  run.source = std::move(source);
  run.ticks = "root";
  run.verdict = "VIOLATED";
  for (const HandMadeNode& node : kDroneNodes) {
    const std::string number = std::to_string(run.nodes.size());
    RecordedNode made{std::string(node.name) + "_btn" + number,
                      node.type,
                      node.name,
                      node.line,
                      node.column,
                      std::nullopt};
    if (node.parent >= 0) made.parent = static_cast<std::uint32_t>(node.parent);
    run.nodes.push_back(std::move(made));
  }
  run.variables = {"fls", "battery"};
  run.is_number = {true, false};
  return run;
}

// The drone flies to the charger; its battery is low, and measured only once.
inline LeafAnswer drone_on_the_way(std::uint32_t leaf, int) {
  switch (leaf) {
    case 9:
      return {Phase::Success, true, kBattery, "Low"};
    case 15:
      return {Phase::Failure};
    case 16:
      return {Phase::Running, true};
    case 10:
    case 13:
      return {Phase::Success};
    default:
      return {Phase::Success, true};
  }
}

// It does so for ever: the loop is the second tick.
inline RecordedRun drone_lasso(std::string source) {
  RecordedRun about = drone_without_states(std::move(source));
  about.property = "battery_stays_fresh";
  about.formula = "[] <> measure_battery.ticked";
  about.why =
      "Sequence17 goes on with goto_waypoint@27, which was running, and does "
      "not tick measure_battery again.";
  about.atoms = {"measure_battery.ticked"};
  about.back.step =
      "drone_btn0: start_ -> tick_node, drone_btn0.rstatus := "
      "no_ret_status";
  HandMadeRun made(std::move(about), {"0", "Good"}, drone_on_the_way);
  made.tick();
  made.tick();
  RecordedRun run = made.finished(kNoState, [](const RecordedState& state) {
    return std::vector<bool>{state.mover == 9u &&
                             state.locations[9] == "tick_node"};
  });
  run.loop = made.first_of_tick(2);
  return run;
}

// It should have been measured within a tick.
inline RecordedRun drone_watched(std::string source) {
  RecordedRun about = drone_without_states(std::move(source));
  about.property = "watched";
  about.formula =
      "whenever goto_waypoint@27.running then measure_battery.ticked or "
      "root.ended within 1 tick";
  about.why =
      "Sequence17 goes on with goto_waypoint@27, which was running, and does "
      "not tick measure_battery again.";
  about.atoms = {"goto_waypoint@27.running", "measure_battery.ticked",
                 "root.ended"};
  HandMadeRun made(std::move(about), {"0", "Good"}, drone_on_the_way);
  for (int i = 0; i < 3; ++i) made.tick();
  RecordedRun run =
      made.finished(made.first_of_tick(3) + 2, [](const RecordedState& state) {
        return std::vector<bool>{
            state.mover == 16u && state.locations[16] == "running",
            state.mover == 9u && state.locations[9] == "tick_node", false};
      });
  run.trigger = made.where("goto_waypoint@27 -> running");
  run.trigger_words = "asked here, not answered";
  run.lost = run.states.size() - 1;
  run.end_words = "the time for an answer is over";
  return run;
}

// The survey, with a flight to the charger in between: every colour occurs.
inline RecordedRun drone_survey(std::string source, std::size_t states) {
  RecordedRun about = drone_without_states(std::move(source));
  about.property = "camera_matters";
  about.formula = "[] (camera_track.failure => <> root.failure)";
  about.why = "camera_track fails, and the Parallel on line 34 goes on.";
  about.atoms = {"camera_track.failure", "root.failure"};
  int level = 0;
  const auto battery = [](int tick) {
    return tick % 11 == 6 || tick % 11 == 7 ? "Low" : "Good";
  };
  HandMadeRun made(
      std::move(about), {"0", "Good"},
      [&](std::uint32_t leaf, int tick) -> LeafAnswer {
        const bool is_low = std::string_view(battery(tick)) == "Low";
        switch (leaf) {
          case 9:
            return {Phase::Success, true, kBattery, battery(tick)};
          case 10:
          case 13:
            return {Phase::Success};
          case 15:
            return {is_low ? Phase::Failure : Phase::Success};
          case 16:
            return {tick % 11 == 6 ? Phase::Running : Phase::Success, true};
          case 22:
            return {tick % 11 == 1 ? Phase::Running : Phase::Success, true};
          case 24:
            return {tick % 7 == 3 ? Phase::Failure : Phase::Running, true};
          case 27:
            level = level % 3 + 1;
            return {Phase::Success, false, kLevel, std::to_string(level)};
          case 3:
          case 4:
          case 18:
            return {Phase::Success, true};
          default:
            return {(leaf + static_cast<std::uint32_t>(tick)) % 3 == 0
                        ? Phase::Running
                        : Phase::Success,
                    true};
        }
      });
  while (made.last() + 1 < states) made.tick();
  RecordedRun run = made.finished(states, [](const RecordedState& state) {
    return std::vector<bool>{
        state.mover == 24u && state.locations[24] == "failure", false};
  });
  run.trigger = made.where("camera_track -> failure");
  run.trigger_words = "asked here, not answered";
  return run;
}

}  // namespace btcheck

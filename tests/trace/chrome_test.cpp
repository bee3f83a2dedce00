// SPDX-License-Identifier: MIT
//
// What Perfetto would be given: slices that nest, and the run in them.
#include "trace/formats/recordings.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "trace/example_runs.hpp"
#include "trace/recorded_run_maker.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck::chrome_test {
namespace {

using nlohmann::json;

struct Slice {
  std::int64_t begin;
  std::int64_t end;
  std::string name;
};

// The slices of each track, in the order of the file.
std::map<int, std::vector<Slice>> slices_of(const json& document) {
  std::map<int, std::vector<Slice>> tracks;
  for (const json& event : document["traceEvents"]) {
    if (event["ph"] != "X") continue;
    CHECK(event["pid"] == 1);
    CHECK(event["dur"] > 0);
    const std::int64_t begin = event["ts"];
    tracks[event["tid"]].push_back(
        {begin, begin + event["dur"].get<std::int64_t>(), event["name"]});
  }
  return tracks;
}

std::map<std::string, int> track_names(const json& document) {
  std::map<std::string, int> names;
  for (const json& event : document["traceEvents"]) {
    if (event["name"] != "thread_name") continue;
    names[event["args"]["name"]] = event["tid"];
  }
  return names;
}

// Slices follow one another, or one is within the other and comes after it.
void check_nesting(const std::vector<Slice>& slices) {
  std::vector<Slice> open;
  std::int64_t last = 0;
  for (const Slice& slice : slices) {
    CHECK(slice.begin >= last);
    last = slice.begin;
    while (!open.empty() && open.back().end <= slice.begin) open.pop_back();
    if (!open.empty()) REQUIRE(slice.end <= open.back().end);
    open.push_back(slice);
  }
}

void check_apart(const std::vector<Slice>& slices) {
  for (std::size_t i = 1; i < slices.size(); ++i) {
    REQUIRE(slices[i - 1].end <= slices[i].begin);
  }
}

// Neither form has slices that overlap.
void check_slices(const RecordedRun& run) {
  for (const auto& [track, slices] :
       slices_of(json::parse(chrome_text(run, ChromeForm::Tracks)))) {
    check_apart(slices);
  }
  for (const auto& [track, slices] :
       slices_of(json::parse(chrome_text(run, ChromeForm::Stack)))) {
    check_nesting(slices);
  }
}

// The tracks hold the phase of each node in each state.
void check_phases(const RecordedRun& run) {
  const json document = json::parse(chrome_text(run, ChromeForm::Tracks));
  auto tracks = slices_of(document);
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    std::map<std::int64_t, std::string> told;
    for (const Slice& slice : tracks[static_cast<int>(n) + 3]) {
      for (auto at = slice.begin; at < slice.end; at += 1000) {
        told[at / 1000] = slice.name;
      }
    }
    for (std::size_t i = 0; i < run.states.size(); ++i) {
      const Phase phase = run.states[i].phases[n];
      std::string word(kPhaseNames[static_cast<std::size_t>(phase)]);
      if (run.states[i].is_stale[n]) word = "(" + word + ")";
      if (phase == Phase::Unvisited) word = "";
      REQUIRE(told[static_cast<std::int64_t>(i)] == word);
    }
  }
}

TEST_CASE("no slices of a track overlap, in either form") {
  std::mt19937 random(8);
  for (int round = 0; round < 150; ++round) {
    CAPTURE(round);
    check_slices(round % 2 == 0 ? random_phases(random)
                                : random_execution(random).run());
  }
}

TEST_CASE("the tracks hold every phase of every node") {
  std::mt19937 random(9);
  for (int round = 0; round < 50; ++round) check_phases(random_phases(random));
}

TEST_CASE("and so it is with every run of the examples") {
  for (const RecordedRun& run : example_runs()) {
    CAPTURE(run.tree);
    CAPTURE(run.property);
    check_slices(run);
    check_phases(run);
  }
}

TEST_CASE("a run is told on the tracks it needs") {
  const RecordedRun run = looping_run();
  const json document = json::parse(chrome_text(run, ChromeForm::Tracks));
  CHECK(document["displayTimeUnit"] == "ms");
  CHECK(document["otherData"]["verdict"] == "VIOLATED");
  const auto names = track_names(document);
  REQUIRE(names.contains("    go \"home\""));
  REQUIRE(names.contains("ticks"));
  auto tracks = slices_of(document);
  const auto& ticks = tracks[names.at("ticks")];
  REQUIRE(ticks.size() == 3);
  CHECK(ticks[2].name == "tick 3");
  const auto& loop = tracks[names.at("loop")];
  REQUIRE(loop.size() == 1);
  CHECK(loop[0].begin == static_cast<std::int64_t>(run.loop) * 1000);
  CHECK(loop[0].end == static_cast<std::int64_t>(run.states.size()) * 1000);
  const auto& battery = tracks[names.at("battery")];
  REQUIRE(battery.size() == 2);
  CHECK(battery[0].name == "Good");
  CHECK(battery[1].name == "Low");
  const auto& leaf = tracks[names.at("    go \"home\"")];
  REQUIRE(leaf.size() >= 4);
  CHECK(leaf[0].name == "here");
  CHECK(leaf[1].name == "running");
  CHECK(leaf[2].name == "(running)");
  CHECK(leaf[3].name == "here");
}

TEST_CASE("numbers are counters, choices are instants") {
  const RecordedRun run = looping_run();
  for (const auto form : {ChromeForm::Tracks, ChromeForm::Stack}) {
    const json document = json::parse(chrome_text(run, form));
    std::vector<int> values;
    std::vector<std::string> choices;
    for (const json& event : document["traceEvents"]) {
      if (event["ph"] == "C") {
        CHECK(event["name"] == "level");
        values.push_back(event["args"]["value"]);
      }
      if (event["ph"] == "i") choices.push_back(event["name"]);
    }
    CHECK(values == std::vector<int>{0, 10, 20, 30});
    REQUIRE(choices.size() == 6);
    CHECK(choices[0] == "good? -> failure");
    CHECK(choices[1] == "go \"home\" -> running");
  }
}

TEST_CASE("a stack says who ticked whom") {
  RecordedRun run = sample_execution().run();
  const json document = json::parse(chrome_text(run, ChromeForm::Stack));
  const auto names = track_names(document);
  REQUIRE(names.contains("main"));
  std::string told;
  for (const json& event : document["traceEvents"]) {
    if (event["ph"] != "X" || event["tid"] != names.at("main")) continue;
    told += event["name"].get<std::string>() + " " +
            event["args"].value("returns", "-") + "\n";
  }
  CHECK(told ==
        "main running\nSequence running\na running\n"
        "main success\nSequence success\na success\nSub success\n"
        "Fallback success\ns failure\nAlwaysSuccess success\n");
}

TEST_CASE("children of a Parallel have stacks of their own") {
  BtcppEngine engine;
  const auto parallel = engine.add("ParallelAll", "both", 0);
  engine.add("Action", "left", parallel);
  engine.add("Action", "right", parallel);
  engine.tick([](std::uint32_t) { return LogStatus::Success; });
  RecordedRun run = engine.run();
  for (RecordedState& state : run.states) {  // as the paper ticks them
    if (state.phases[2] == Phase::Here) state.phases[3] = Phase::Here;
  }
  const json document = json::parse(chrome_text(run, ChromeForm::Stack));
  const auto names = track_names(document);
  auto tracks = slices_of(document);
  CHECK(tracks[names.at("left")].size() == 1);
  CHECK(tracks[names.at("right")].size() == 2);
  CHECK(tracks[names.at("main")].size() == 2);
}

}  // namespace
}  // namespace btcheck::chrome_test

// SPDX-License-Identifier: MIT
//
// The missions of examples/run, in small numbers: with random faults no leaf
// leaves its contract, and each run that is kept can be read again.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::run_examples_test {

TEST_CASE("missions of the drone in Python keep to the model") {
  if (run("python3 -c 'import json' 2>/dev/null").code != 0) {
    MESSAGE("python3 is not installed: left out");
    return;
  }
  const TemporaryFolder folder;
  const std::string sources = BTCHECK_SOURCES;
  int successes = 0;
  int failures = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const std::string tree =
        sources +
        (seed % 2 == 0 ? "/examples/drone3-fixed.btf" : "/examples/drone3.btf");
    const Outcome mission = run_in(
        folder.path(),
        "'" BTCHECK_PROGRAM "' run '" + tree + "' --no-wait --seed " +
            std::to_string(seed) +
            " --answer-ms 10000 -o run.itf.json --leaves-exec \"python3 -B '" +
            sources + "/examples/run/drone.py'\" 2>stderr");
    CHECK(mission.code == 0);
    successes += mission.text.find("root=success") != std::string::npos;
    failures += mission.text.find("root=failure") != std::string::npos;
    const Outcome told =
        run_in(folder.path(),
               "'" BTCHECK_PROGRAM "' trace run.itf.json --to text 2>&1");
    CHECK(told.code == 0);
    CHECK(told.text.find("start_drone -> running") != std::string::npos);
  }
  CHECK(successes + failures == 12);
}

// The lines of verdicts.
std::string verdicts(const std::string& text) {
  std::string found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    for (const char* word : {"OPEN ", "SATISFIED ", "VIOLATED "}) {
      if (line.starts_with(word)) found += line + '\n';
    }
  }
  return found;
}

TEST_CASE("rules say of a run that goes on what they say of the kept one") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "rules.ltl")
      << "property watched: whenever goto_waypoint@27.running\n"
         "    then measure_battery.ticked within 1 tick\n"
         "property up: always (land@23.ticked => once takeoff.success)\n"
         "property flies: possible takeoff.success\n"
         "property good: always battery == Good\n"
         "property low: always (battery == Low =>\n"
         "    previously battery != Critical)\n";
  int broken = 0;
  for (int seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    const Outcome live = run_in(
        folder.path(), "'" BTCHECK_PROGRAM "' run '" BTCHECK_SOURCES
                       "/examples/drone3.btf' --prop rules.ltl "
                       "--no-wait --ticks 40 -q -o run.itf.json --seed " +
                           std::to_string(seed) + " 2>stderr");
    const Outcome kept = run_in(folder.path(), "'" BTCHECK_PROGRAM
                                               "' trace run.itf.json --prop "
                                               "rules.ltl 2>stderr");
    const std::string found = verdicts(live.text);
    CHECK(found == verdicts(kept.text));
    CHECK(std::ranges::count(found, '\n') == 5);
    CHECK(live.code == kept.code);
    broken += found.find("VIOLATED   watched") != std::string::npos;
  }
  CHECK(broken > 0);
  CHECK(broken < 30);
}

}  // namespace btcheck::run_examples_test

// SPDX-License-Identifier: MIT
//
// The missions of examples/run, in small numbers: with random faults no leaf
// leaves its contract, and each run that is kept can be read again.
#include <doctest/doctest.h>

#include <string>

#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck {

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

}  // namespace btcheck

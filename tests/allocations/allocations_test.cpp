// SPDX-License-Identifier: MIT
//
// A robot's tick allocates nothing. A program of its own, because it replaces
// operator new.
#include <doctest/doctest.h>

#include <string>

#include "btcheck/run.hpp"
#include "counted_allocations.hpp"
#include "file_text.hpp"

namespace btcheck::run {
namespace {

// The drone with leaves that allocate nothing themselves.
Engine engine_that_keeps(Options::Keep keep) {
  Options options;
  options.pace = Pace::AtOnce;
  options.keep = keep;
  Engine engine("drone3.btf", file_text(BTCHECK_EXAMPLES "/drone3.btf"),
                options);
  for (const char* leaf :
       {"start_drone", "start_camera", "land", "goto_waypoint", "takeoff",
        "camera_tracking", "shutdown_drone"}) {
    engine.polled(leaf, [turns = 0](const Call&, Turn turn) mutable {
      turns = turn == Turn::Start ? 0 : turns + 1;
      return turns < 40 ? Status::Running : Status::Success;
    });
  }
  engine.condition(
      "localization_ok", [](const Call&) { return true; }, Runs::InTick);
  engine.measure(
      "measure_battery", [](const Call&) { return "Good"; }, Runs::InTick);
  return engine;
}

struct Counted {
  std::size_t ticks = 0;
  std::size_t allocations = 0;
};

// From the second tick on.
Counted counted(Engine engine) {
  Counted counted;
  End end = engine.tick();
  while (end == End::None) {
    const std::size_t before = allocations;
    end = engine.tick();
    counted.allocations += allocations - before;
    ++counted.ticks;
  }
  return counted;
}

TEST_CASE("after the first tick of a mission no tick allocates") {
  const Counted found = counted(engine_that_keeps(Options::Keep::Nothing));
  CHECK(found.ticks > 100);
  CHECK(found.allocations == 0);
}

TEST_CASE("what is kept of a run grows by doubling and no more often") {
  const Counted found = counted(engine_that_keeps(Options::Keep::Run));
  CHECK(found.ticks > 100);
  CHECK(found.allocations < 20);
}

}  // namespace
}  // namespace btcheck::run

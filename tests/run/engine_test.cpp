// SPDX-License-Identifier: MIT
//
// btcheck/run.hpp as a program around a tree uses it, with real threads.
#include "btcheck/run.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <condition_variable>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "trace/logs/behavior_log.hpp"
#include "trace/run/itf.hpp"

namespace btcheck::engine_test {
namespace {

using namespace std::chrono_literals;
using run::Answer;
using run::Call;
using run::End;
using run::Engine;

constexpr const char* kTree = R"(
(defsv battery :states (Good Low) :init Good :transitions :all)
(defsv weather :states (Calm Storm) :init Calm :transitions ((Calm Storm)))
(defsv n :max 3)
(BehaviorTree :name t
  (ReactiveSequence :halt 1
    (SetSV :ID look :sv battery)
    (Eval (= battery Good))
    (Sequence
      (Eval (:= n 2))
      (Action :ID go :args (x (* 2 $n) mode Low place home half 0.5))
      (Condition :ID there)))))";

// Ticks as fast as a clock has them: with threads, one after the other would be
// thousands.
run::Options quick() {
  run::Options options;
  options.period = 1ms;
  options.answer_within = 5s;
  return options;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const run::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("leaves are functions, with their arguments evaluated") {
  Engine engine("t.btf", kTree, quick());
  std::atomic<bool> may_end = false;
  std::string seen;
  engine.action("go", [&](const Call& call, std::stop_token stop) {
    seen = std::string(call.node()) + " " + std::to_string(call.number("x")) +
           " " + std::to_string(call.number("half")) + " " +
           std::string(call.text("place"));
    while (!may_end && !stop.stop_requested()) std::this_thread::yield();
    return Answer::Success;
  });
  engine.condition("there", [](const Call&) { return true; });
  engine.measure("look", [](const Call&) { return "good"; });
  std::vector<std::string> events;
  engine.on_event([&](const run::Event& event) {
    if (event.kind == run::Event::Kind::Changed) {
      events.push_back(std::string(event.node) + "=" +
                       (event.value.empty() ? std::to_string(int(event.number))
                                            : std::string(event.value)));
    }
  });
  engine.set("weather", "Storm");
  CHECK(engine.tick() == End::None);
  CHECK(engine.value("weather").text() == "Storm");
  CHECK(engine.value("n").number() == 2);
  may_end = true;
  const run::Report report = engine.run(100000);
  CHECK(report.end == End::Success);
  CHECK(report.breaches == 0);
  CHECK(report.text.starts_with("t ended with success in tick "));
  CHECK(seen == "go 4.000000 0.500000 home");
  CHECK(events == std::vector<std::string>{"weather=Storm", "n=2"});
  const auto kept = read_itf("run", engine.itf());
  REQUIRE(kept.value.has_value());
  CHECK(kept.value->tree == "t.btf");
  const auto log = read_log("run.btlog", engine.btlog());
  CHECK(log.value.has_value());
}

TEST_CASE("an action that hangs when the run is over is told of") {
  std::atomic<bool> may_return = false;
  std::atomic<bool> has_begun = false;
  run::Options options = quick();
  options.answer_within = 50ms;
  for (const bool by_hand : {false, true}) {
    CAPTURE(by_hand);
    may_return = false;
    has_begun = false;
    Engine engine("t.btf",
                  by_hand ? R"((BehaviorTree :name t
      (ReactiveSequence :halt 1 (Condition :ID ok) (Action :ID go))))"
                          : "(BehaviorTree :name t (Action :ID go))",
                  options);
    engine.action("go", [&](const Call&, std::stop_token) {
      has_begun = true;
      while (!may_return) std::this_thread::sleep_for(1ms);
      return Answer::Success;
    });
    bool is_ok = true;
    if (by_hand) engine.condition("ok", [&](const Call&) { return is_ok; });
    std::vector<std::string> told;
    engine.on_breach(
        [&](const run::Breach& breach) { told.push_back(breach.text); });
    CHECK(engine.tick() == End::None);
    // One that has not begun when it is halted never does.
    while (!has_begun) std::this_thread::sleep_for(1ms);
    if (by_hand) {
      is_ok = false;
      engine.tick();
    } else {
      engine.run(2);
    }
    CHECK(engine.report().breaches == 1);
    CHECK(told == std::vector<std::string>{
                      "`go` was halted and has not returned within 50 ms"});
    may_return = true;
  }
}

TEST_CASE("an action that is halted is told to stop") {
  Engine engine("t.btf", kTree, quick());
  std::atomic<int> started = 0;
  std::atomic<int> stopped = 0;
  std::atomic<bool> is_low = false;
  engine.action("go", [&](const Call&, std::stop_token stop) {
    ++started;
    std::mutex mutex;
    std::condition_variable_any woken;
    std::unique_lock lock(mutex);
    woken.wait(lock, stop, [] { return false; });
    ++stopped;
    return Answer::Failure;
  });
  engine.condition("there", [](const Call&) { return true; });
  engine.measure("look", [&](const Call&) { return is_low ? "Low" : "Good"; });
  while (started == 0) {
    CHECK(engine.tick() == End::None);
    std::this_thread::sleep_for(1ms);
  }
  is_low = true;
  CHECK(engine.tick() == End::Failure);
  engine.run();
  for (int i = 0; i < 2000 && stopped < started; ++i) {
    std::this_thread::sleep_for(1ms);
  }
  CHECK(stopped == started);
}

TEST_CASE("mistakes in the set-up are thrown, and nothing else") {
  CHECK(message_of([] { Engine("t.btf", "(", {}); }).find("error[BT") !=
        std::string::npos);
  CHECK(message_of([] {
          Engine("t.xml",
                 "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">"
                 "<AlwaysSuccess/></BehaviorTree></root>");
        }).find("keeps its own executor") != std::string::npos);
  Engine engine("t.btf", kTree, quick());
  const auto go = [](const Call&, std::stop_token) { return Answer::Success; };
  CHECK(message_of([&] { engine.action("goo", go); }) ==
        "no leaf `goo` in t.btf; did you mean `go` (line 11)?");
  CHECK(message_of([&] { engine.action("there", go); }) ==
        "`there` is a Condition");
  CHECK(message_of([&] { engine.set("battery", "Low"); }) ==
        "`battery` does not move by itself");
  CHECK(message_of([&] { engine.set("weather", "Rain"); }) ==
        "`weather` has no value Rain");
  CHECK(message_of([&] { engine.set("wether", 1); }) ==
        "no variable `wether` in t.btf");
  engine.action("go", go);
  CHECK(message_of([&] { engine.tick(); }) ==
        "no function for look (line 7), there (line 12)");
}

TEST_CASE("ticks begin a period apart, and overruns are counted") {
  run::Options options;
  options.period = 20ms;
  options.answer_within = 1s;
  Engine engine("t.btf", "(BehaviorTree :name t (Condition :ID slow))",
                options);
  engine.condition("slow", [](const Call&) {
    std::this_thread::sleep_for(30ms);
    return true;
  });
  CHECK(engine.run().overruns == 1);

  Engine even("t.btf", "(BehaviorTree :name t (Action :ID a))", options);
  even.polled("a", [](const Call&, run::Turn) { return run::Status::Running; });
  const auto begin = std::chrono::steady_clock::now();
  CHECK(even.run(5).ticks == 5);
  CHECK(std::chrono::steady_clock::now() - begin >= 80ms);
}

TEST_CASE("a run is stopped from another thread") {
  run::Options options;
  options.period = 1ms;
  Engine engine("t.btf", "(BehaviorTree :name t (Action :ID a))", options);
  std::atomic<bool> was_halted = false;
  engine.polled("a", [&](const Call&, run::Turn turn) {
    if (turn == run::Turn::Halt) was_halted = true;
    return run::Status::Running;
  });
  std::thread other([&] {
    std::this_thread::sleep_for(20ms);
    engine.stop();
  });
  CHECK(engine.run().end == End::Stopped);
  other.join();
  CHECK(was_halted);
}

// Many actions on threads of their own, variables set from another one.
TEST_CASE("a hundred missions with real threads keep every contract") {
  const char* tree = R"((defsv w :states (A B) :init A :transitions :all)
    (BehaviorTree :name t (ReactiveSequence :halt 1 (Condition :ID c)
      (ParallelAll (Action :ID a) (Action :ID b) (Action :ID a)
        (Fallback (Action :ID b) (Action :ID a))))))";
  int successes = 0;
  for (int mission = 0; mission < 100; ++mission) {
    Engine engine("t.btf", tree, quick());
    std::atomic<int> count = 0;
    const auto act = [&](const Call& call, std::stop_token stop) {
      for (int i = 0; i < 50 && !stop.stop_requested(); ++i) {
        std::this_thread::yield();
      }
      count += call.tick() > 0 ? 1 : 0;
      return (mission + call.node().size()) % 7 == 0 ? Answer::Failure
                                                     : Answer::Success;
    };
    engine.action("a", act);
    engine.action("b", act);
    engine.condition("c", [&](const Call& call) {
      return mission % 3 != 0 || call.tick() < 5;
    });
    std::atomic<bool> is_over = false;
    std::thread weather([&] {
      for (int i = 0; !is_over; ++i) {
        engine.set("w", i % 2 == 0 ? "B" : "A");
        std::this_thread::sleep_for(200us);
      }
    });
    const run::Report report = engine.run(100000);
    is_over = true;
    weather.join();
    CHECK(report.breaches == 0);
    CHECK((report.end == End::Success || report.end == End::Failure));
    successes += report.end == End::Success;
    CHECK(read_itf("run", engine.itf()).value.has_value());
  }
  CHECK(successes > 0);
}

}  // namespace btcheck::engine_test

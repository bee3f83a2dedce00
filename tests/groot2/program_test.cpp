// SPDX-License-Identifier: MIT
//
// `btcheck watch`, the program, beside publishers that are none.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "groot2/fake_publisher.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::program_test {
namespace {

using namespace std::chrono_literals;
using enum LogStatus;

const std::string kProgram = "'" BTCHECK_PROGRAM "'";

// A command line that runs while something else happens.
class Beside {
 public:
  Beside(const std::filesystem::path& folder, const std::string& words)
      : thread_([this, folder, words] {
          outcome_ = run_in(folder, kProgram + " watch " + words + " 2>&1");
        }) {}
  ~Beside() {
    if (thread_.joinable()) thread_.join();
  }
  Outcome ended() {
    thread_.join();
    return outcome_;
  }

 private:
  Outcome outcome_;
  std::thread thread_;
};

std::string address_of(const FakePublisher& publisher) {
  return fmt::format("groot2://127.0.0.1:{}", publisher.port());
}

bool has(const Outcome& outcome, std::string_view text) {
  INFO(outcome.text);
  const bool is_there = outcome.text.find(text) != std::string::npos;
  CHECK(is_there);
  return is_there;
}

void wait_for_recording(const FakePublisher& publisher) {
  const auto until = std::chrono::steady_clock::now() + 20s;
  while (!publisher.is_recording() &&
         std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(5ms);
  }
  REQUIRE(publisher.is_recording());
  std::this_thread::sleep_for(200ms);
}

void tick(FakePublisher& publisher, LogStatus answer) {
  publisher.set(1, Running);
  publisher.set(2, Success);
  publisher.set(3, answer);
  publisher.set(2, Idle);
  publisher.set(3, Idle);
  publisher.set(1, answer);
  publisher.set(1, Idle);
  publisher.wait(20'000);
}

}  // namespace

TEST_CASE("a rule that is violated is told at its moment") {
  FakePublisher publisher;
  const TemporaryFolder folder;
  Beside program(folder.path(), address_of(publisher) +
                                    " -e 'never b.failure' -e 'a.success "
                                    "precedes b.success' --timeout 3 "
                                    "-o run.btlog");
  wait_for_recording(publisher);
  tick(publisher, Success);
  tick(publisher, Failure);
  const Outcome outcome = program.ended();
  CHECK(outcome.code == 1);
  has(outcome, fmt::format("{}: Fake, 3 nodes; recorded to run.btlog",
                           address_of(publisher)));
  has(outcome, "VIOLATED   prove1  (record 10, ");
  has(outcome, "SATISFIED  prove2  (record 2, ");
  has(outcome, "2 rules: 1 satisfied, 1 violated, 0 open\n");
  // The same of the log, and the tree can do all of it.
  const Outcome traced =
      run_in(folder.path(), kProgram + " trace run.btlog -e 'never b.failure'");
  CHECK(traced.code == 1);
  has(traced, "run.btlog: 3 nodes, 14 records");
  has(traced, "(record 10, ");
  CHECK(run_in(folder.path(), kProgram + " conform run.btlog 2>&1").code == 0);
}

TEST_CASE("without rules each change is a line") {
  FakePublisher publisher;
  const TemporaryFolder folder;
  Beside program(folder.path(), address_of(publisher) + " --timeout 2");
  wait_for_recording(publisher);
  tick(publisher, Success);
  const Outcome outcome = program.ended();
  CHECK(outcome.code == 0);
  has(outcome, "[0.000200]     2 a            IDLE -> SUCCESS\n");
}

TEST_CASE("ticks are known where somebody says how long a gap is") {
  for (const bool is_said : {false, true}) {
    FakePublisher publisher;
    const TemporaryFolder folder;
    Beside program(folder.path(),
                   address_of(publisher) +
                       " -e 'whenever a.success then b.failure within 1 ticks'"
                       " --timeout 3" +
                       (is_said ? " --tick-gap 5" : ""));
    wait_for_recording(publisher);
    // The tree never answers, so where a tick ends is not known by itself.
    publisher.set(1, Running);
    for (int i = 0; i < 5; ++i) {
      publisher.set(2, Success);
      publisher.set(2, Idle);
      publisher.wait(20'000);
    }
    const Outcome outcome = program.ended();
    CHECK(outcome.code == (is_said ? 1 : 0));
    has(outcome, is_said ? "VIOLATED   prove1" : "OPEN       prove1");
    if (!is_said) has(outcome, "--tick-gap");
  }
}

TEST_CASE("nobody there") {
  std::string address;
  { address = address_of(FakePublisher()); }
  const TemporaryFolder folder;
  const Outcome outcome =
      Beside(folder.path(), address + " --timeout 0.5 -o run.btlog").ended();
  CHECK(outcome.code == 2);
  has(outcome, address + ": nobody answers there yet; waiting for it\n");
  has(outcome, "error[BT1901]: nobody answered there\n  --> " + address);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("rules that no log can answer end it before it begins") {
  FakePublisher publisher;
  const TemporaryFolder folder;
  const Outcome outcome =
      Beside(folder.path(),
             address_of(publisher) + " -e 'never c.failure' --timeout 20")
          .ended();
  CHECK(outcome.code == 2);
  has(outcome, "error[BT1101]: unknown node `c`");
}

TEST_CASE("a program that starts anew gets a file of its own") {
  auto publisher = std::make_unique<FakePublisher>();
  const std::uint16_t port = publisher->port();
  const TemporaryFolder folder;
  Beside program(folder.path(), address_of(*publisher) +
                                    " -e 'never b.failure' --timeout 15 "
                                    "-o run.btlog");
  wait_for_recording(*publisher);
  tick(*publisher, Success);
  std::this_thread::sleep_for(200ms);
  publisher = nullptr;
  publisher = std::make_unique<FakePublisher>(port);
  wait_for_recording(*publisher);
  tick(*publisher, Failure);
  const Outcome outcome = program.ended();
  CHECK(outcome.code == 1);
  has(outcome, "warning[BT1904]: the recording of ");
  has(outcome, "recorded to run-2.btlog");
  for (const char* name : {"run.btlog", "run-2.btlog"}) {
    const Outcome traced =
        run_in(folder.path(), kProgram + " trace " + name + " --to text");
    CHECK(traced.code == 0);
    has(traced, "3 nodes, 7 changes");
  }
}

TEST_CASE("several robots, each with its name") {
  FakePublisher one;
  FakePublisher other;
  const TemporaryFolder folder;
  Beside program(folder.path(), address_of(one) + " " + address_of(other) +
                                    " -e 'never b.failure' --timeout 3 "
                                    "-o run.btlog");
  wait_for_recording(one);
  wait_for_recording(other);
  tick(other, Failure);
  tick(one, Success);
  const Outcome outcome = program.ended();
  CHECK(outcome.code == 1);
  has(outcome, fmt::format("127.0.0.1:{}: VIOLATED   prove1", other.port()));
  CHECK(outcome.text.find(fmt::format("127.0.0.1:{}: VIOLATED", one.port())) ==
        std::string::npos);
  for (const auto* each : {&one, &other}) {
    CHECK(std::filesystem::exists(
        folder.path() / fmt::format("run-127.0.0.1_{}.btlog", each->port())));
  }
}

TEST_CASE("faults are told, and said in the log") {
  FakePublisher publisher;
  const TemporaryFolder folder;
  Beside program(folder.path(),
                 address_of(publisher) +
                     " --inject 'b fails' --break a --break-for 100 "
                     "--allow-inject --timeout 3 -o run.btlog");
  wait_for_recording(publisher);
  std::this_thread::sleep_for(300ms);
  publisher.reach(3);
  publisher.reach(2);
  const Outcome outcome = program.ended();
  CHECK(outcome.code == 0);
  has(outcome, "injected `b fails` after ");
  has(outcome, "stands at `a` after 0.000000 s, for 100 ms\n");
  CHECK(publisher.told('U').size() == 1);
  CHECK(publisher.told('R').size() == 2);
  std::ifstream file(folder.path() / "run.btlog", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  CHECK(bytes.find("on purpose: b fails; break a -->") != std::string::npos);
  CHECK(run_in(folder.path(), kProgram + " trace run.btlog --to text").code ==
        0);
}

TEST_CASE("an address or a fault that is none") {
  const TemporaryFolder folder;
  for (const auto& [words, error] :
       {std::pair("robot.xml", "an address of a robot begins with"),
        std::pair("groot2://a groot2://a:1667", "is given twice"),
        std::pair("groot2://a --inject 'b burns' --allow-inject",
                  "--inject 'b burns' is not understood")}) {
    const Outcome outcome = Beside(folder.path(), words).ended();
    CHECK(outcome.code == 2);
    has(outcome, error);
  }
}

TEST_CASE("a folder that cannot be written to") {
  FakePublisher publisher;
  const TemporaryFolder folder;
  const Outcome outcome =
      Beside(folder.path(),
             address_of(publisher) + " -o none/run.btlog --timeout 20")
          .ended();
  CHECK(outcome.code == 2);
  has(outcome, "error[BT0004]: cannot write `none/run.btlog`: ");
}

TEST_CASE("a server of nonsense ends in a message") {
  FakePublisher publisher;
  publisher.set_tree("<root><BehaviorTree ID=\"\x1B[2J\"><a/></BehaviorTree>");
  const TemporaryFolder folder;
  const Outcome outcome =
      Beside(folder.path(), address_of(publisher) + " --timeout 20").ended();
  CHECK(outcome.code == 2);
  has(outcome, "error[BT1903]: the tree that it sends cannot be read: ");
  CHECK(outcome.text.find('\x1B') == std::string::npos);
}

TEST_CASE("Ctrl-C tells what is open, and leaves nothing behind") {
  FakePublisher publisher;
  const TemporaryFolder folder;
  std::thread program([&] {
    const Outcome outcome =
        run_in(folder.path(), "timeout --foreground -s INT 2 " + kProgram +
                                  " watch " + address_of(publisher) +
                                  " -e 'never b.failure' --inject 'b fails' "
                                  "--allow-inject 2>&1; echo ended $?");
    has(outcome, "1 rule: 0 satisfied, 0 violated, 1 open\n");
  });
  wait_for_recording(publisher);
  program.join();
  CHECK(!publisher.is_recording());
  CHECK(publisher.told('R').size() == 1);
}

}  // namespace btcheck::program_test

// SPDX-License-Identifier: MIT
//
// Who checks what: one at a time, as long as it lives.
#include "batch/results/leases.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "file_text.hpp"
#include "temporary_folder.hpp"

namespace btcheck::leases_test {
namespace {

namespace fs = std::filesystem;

constexpr double kLong = 3600;
const std::string kKey = "0123456789abcdef0123456789abcdef";

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

// Runs that in a process that is then gone without a farewell, as if killed.
// What it has returned.
template <class Work>
bool in_lost_process(const Work& work) {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(work() ? 1 : 0);
  int status = 0;
  REQUIRE(::waitpid(process, &status, 0) == process);
  REQUIRE(WIFEXITED(status));
  return WEXITSTATUS(status) == 1;
}

// Leaves the lease of a process that is gone.
void leave_lost_lease(const fs::path& folder) {
  CHECK(in_lost_process([&] {
    auto* lost = new Leases(folder, kLong);
    return lost->begin().empty() && lost->claim(kKey);
  }));
}

bool is_held(Leases& leases, const std::string& key) {
  return leases.holder_of(key) != KeptResults::Holder::Nobody;
}

// A machine that is not this one has counted so far.
void put_foreign(const fs::path& folder, int number, int count) {
  put(folder / (kKey + "." + std::to_string(number) + ".lease"), "other-7-ab");
  put(folder / "other-7-ab.alive",
      "other 7 1234 0f0f/pid:[1] " + std::to_string(count) + "\n");
}

TEST_CASE("one of two has an entry, the other when the first is done") {
  const TemporaryFolder folder;
  Leases one(folder.path(), kLong);
  Leases two(folder.path(), kLong);
  CHECK(one.begin().empty());
  CHECK(two.begin().empty());
  CHECK(one.holder_name(kKey).empty());
  CHECK(one.claim(kKey));
  CHECK(!two.claim(kKey));
  CHECK(is_held(two, kKey));
  CHECK(two.holder_name(kKey).ends_with(", process " +
                                        std::to_string(::getpid())));
  two.release(kKey);  // not its own
  CHECK(is_held(two, kKey));
  one.release(kKey);
  CHECK(!is_held(two, kKey));
  CHECK(two.claim(kKey));
}

TEST_CASE("nothing is left of who has said farewell") {
  const TemporaryFolder folder;
  {
    Leases leases(folder.path(), kLong);
    CHECK(leases.begin().empty());
    CHECK(leases.claim(kKey));
    leases.clear(kKey);
  }
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("the entry of a process that is gone is free at once") {
  const TemporaryFolder folder;
  leave_lost_lease(folder.path());
  leave_lost_lease(folder.path());  // whoever has taken over, too
  Leases leases(folder.path(), kLong);
  CHECK(leases.begin().empty());
  CHECK(!is_held(leases, kKey));
  CHECK(leases.claim(kKey));
  CHECK(is_held(leases, kKey));
  CHECK(fs::exists(folder.path() / (kKey + ".3.lease")));
}

TEST_CASE("of many who take over at once, one has it") {
  for (int round = 0; round < 50; ++round) {
    const TemporaryFolder folder;
    leave_lost_lease(folder.path());
    constexpr int kMany = 8;
    std::array<int, 2> start{};
    REQUIRE(::pipe(start.data()) == 0);
    std::vector<pid_t> processes;
    std::vector<std::unique_ptr<Leases>> all;
    for (int i = 0; i < kMany; ++i) {
      all.push_back(std::make_unique<Leases>(folder.path(), kLong));
      CHECK(all.back()->begin().empty());
      const pid_t process = ::fork();
      if (process == 0) {
        ::close(start[1]);
        char byte = 0;  // until all are there
        if (::read(start[0], &byte, 1) != 0) ::_exit(2);
        ::_exit(all.back()->claim(kKey) ? 1 : 0);
      }
      processes.push_back(process);
    }
    ::close(start[1]);
    ::close(start[0]);
    int winners = 0;
    for (const pid_t process : processes) {
      int status = 0;
      ::waitpid(process, &status, 0);
      winners += WEXITSTATUS(status);
    }
    CHECK(winners == 1);
  }
}

TEST_CASE("a foreign machine has an entry as long as it counts") {
  const TemporaryFolder folder;
  put_foreign(folder.path(), 1, 1);
  constexpr double kPatience = 0.2;
  Leases leases(folder.path(), kPatience);
  CHECK(leases.begin().empty());
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  CHECK(!leases.claim(kKey));
  CHECK(leases.holder_of(kKey) != KeptResults::Holder::Alive);
  // Each time it has counted, the patience begins anew.
  for (int count = 2; count < 5; ++count) {
    put_foreign(folder.path(), 1, count);
    CHECK(leases.holder_of(kKey) == KeptResults::Holder::Alive);
  }
  while (is_held(leases, kKey)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::chrono::duration<double> waited = Clock::now() - begun;
  CHECK(waited.count() >= kPatience);
  CHECK(leases.claim(kKey));
  CHECK(fs::exists(folder.path() / (kKey + ".2.lease")));
}

TEST_CASE("a clock that is wrong by an hour changes nothing") {
  for (const int hours : {-1, 1}) {
    const TemporaryFolder folder;
    put_foreign(folder.path(), 1, 1);
    for (const auto& file : fs::directory_iterator(folder.path())) {
      fs::last_write_time(
          file, fs::file_time_type::clock::now() + std::chrono::hours(hours));
    }
    Leases patient(folder.path(), kLong);
    CHECK(patient.begin().empty());
    CHECK(!patient.claim(kKey));
    CHECK(is_held(patient, kKey));
    Leases impatient(folder.path(), 0.01);
    CHECK(impatient.begin().empty());
    while (is_held(impatient, kKey)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(impatient.claim(kKey));
  }
}

TEST_CASE("who has taken its sign away is gone") {
  const TemporaryFolder folder;
  put_foreign(folder.path(), 1, 1);
  Leases leases(folder.path(), kLong);
  CHECK(leases.begin().empty());
  CHECK(is_held(leases, kKey));
  fs::remove(folder.path() / "other-7-ab.alive");
  CHECK(!is_held(leases, kKey));
  CHECK(leases.claim(kKey));
}

TEST_CASE("a process number that another process has by now is nobody") {
  const TemporaryFolder folder;
  Leases leases(folder.path(), kLong);
  CHECK(leases.begin().empty());
  CHECK(leases.claim(kKey));
  Leases other(folder.path(), kLong);
  CHECK(other.begin().empty());
  CHECK(is_held(other, kKey));
  // The same sign, but for the start of the process.
  for (const auto& file : fs::directory_iterator(folder.path())) {
    if (file.path().extension() != ".alive") continue;
    std::string text = file_text(file);
    text.insert(text.find(' ', text.find(' ') + 1) + 1, "9");
    put(file, text);
  }
  CHECK(!is_held(other, kKey));
}

TEST_CASE("a lease that names nobody is waited for, and then taken over") {
  for (const char* text :
       {"", "../../etc/passwd", "a b", "\n", "\xff\x1b[2J"}) {
    const TemporaryFolder folder;
    put(folder.path() / (kKey + ".1.lease"), text);
    Leases patient(folder.path(), kLong);
    CHECK(patient.begin().empty());
    const bool names_somebody = std::string(text) == "a b";  // who is not there
    CHECK(is_held(patient, kKey) == !names_somebody);
    CHECK(patient.holder_name(kKey) == "a process that is gone");
    Leases impatient(folder.path(), 0);
    CHECK(impatient.begin().empty());
    CHECK(impatient.claim(kKey));
  }
}

TEST_CASE("who wakes up after others have taken over harms nobody") {
  const TemporaryFolder folder;
  Leases slept(folder.path(), 0);
  CHECK(slept.begin().empty());
  CHECK(slept.claim(kKey));
  Leases other(folder.path(), 0);  // has no patience at all
  CHECK(other.begin().empty());
  CHECK(other.claim(kKey));
  slept.keep_alive();
  slept.release(kKey);
  Leases third(folder.path(), kLong);
  CHECK(third.begin().empty());
  CHECK(is_held(third, kKey));
  CHECK(!third.claim(kKey));
}

TEST_CASE("where no lease can be made, everybody works for himself") {
  Leases leases("/nowhere/at/all", kLong);
  CHECK(leases.begin().starts_with("cannot write into `/nowhere/at/all`: "));
  CHECK(leases.claim(kKey));
  CHECK(!is_held(leases, kKey));
  leases.keep_alive();
  leases.release(kKey);
}

}  // namespace
}  // namespace btcheck::leases_test

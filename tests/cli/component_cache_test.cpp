// SPDX-License-Identifier: MIT
//
// What is kept in the folder of --cache is found again as it was, or not at
// all: whatever somebody has done to the file, and whoever else is at it.
#include "cli/inputs/component_cache.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::component_cache_test {
namespace {

namespace fs = std::filesystem;

const std::string kBuild = "0123456789abcdef0123456789abcdef";

ContentHash content(std::uint64_t number) { return {number * 77, ~number}; }

std::string bytes_of(std::uint64_t number, std::size_t size = 40) {
  std::string bytes = fmt::format("{} ", number);
  bytes.resize(size, static_cast<char>(number));
  return bytes;
}

fs::path file_in(const fs::path& folder) {
  return folder / "btcheck-components.sqlite";
}

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

// Keeps so many contents.
void fill(const fs::path& folder, std::uint64_t count,
          const std::string& build = kBuild) {
  ComponentCache cache(folder.string(), build);
  for (std::uint64_t i = 0; i < count; ++i) cache.keep(content(i), bytes_of(i));
}

struct Seen {
  std::size_t known = 0;
  std::size_t wrong = 0;  // found, and not as it was kept
  std::string complaint;
};

Seen seen_in(const fs::path& folder, std::uint64_t count,
             const std::string& build = kBuild) {
  Seen seen;
  ComponentCache cache(folder.string(), build);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto found = cache.find(content(i));
    if (!found) continue;
    ++seen.known;
    seen.wrong += *found != bytes_of(i);
  }
  seen.complaint = cache.complaint();
  return seen;
}

TEST_CASE("what one has kept another finds, and no other build") {
  const TemporaryFolder folder;
  fill(folder.path(), 100);
  const Seen same = seen_in(folder.path(), 120);
  CHECK(same.known == 100);
  CHECK(same.wrong == 0);
  CHECK(same.complaint == "");
  CHECK(seen_in(folder.path(), 120, "f" + kBuild.substr(1)).known == 0);
  // What is written beside it leaves it there.
  fill(folder.path(), 50, "f" + kBuild.substr(1));
  CHECK(seen_in(folder.path(), 120).known == 100);
  CHECK(seen_in(folder.path(), 120, "f" + kBuild.substr(1)).known == 50);
}

TEST_CASE("nothing is left beside the database") {
  const TemporaryFolder folder;
  fill(folder.path(), 10);
  std::set<std::string> names;
  for (const auto& each : fs::directory_iterator(folder.path())) {
    names.insert(each.path().filename().string());
  }
  CHECK(names == std::set<std::string>{"btcheck-components.sqlite"});
}

TEST_CASE("what is gathered is written when it is asked to be") {
  const TemporaryFolder folder;
  ComponentCache cache(folder.path().string(), kBuild);
  cache.keep(content(1), bytes_of(1));
  CHECK(seen_in(folder.path(), 2).known == 0);
  cache.write();
  CHECK(seen_in(folder.path(), 2).known == 1);
  CHECK(cache.counts().added == 1);
}

TEST_CASE("half a file, no database, or somebody else's: it is made anew") {
  const TemporaryFolder whole;
  fill(whole.path(), 400);
  const std::string text = file_text(file_in(whole.path()));
  REQUIRE(text.size() > 20'000);
  std::vector<std::string> texts = {std::string(1000, '\0'),
                                    std::string(10'000, 'x')};
  for (const std::size_t part : {2, 3, 10, 100}) {
    texts.push_back(text.substr(0, text.size() / part));
  }
  texts.push_back(std::string(4096, '\0') + text.substr(4096));
  texts.push_back(text.substr(0, 4096) +
                  std::string(text.size() - 4096, '\xff'));
  for (const std::string& damaged : texts) {
    const TemporaryFolder folder;
    put(file_in(folder.path()), damaged);
    CAPTURE(damaged.size());
    const Seen seen = seen_in(folder.path(), 400);
    CHECK(seen.wrong == 0);
    CHECK(seen.known < 400);
    CHECK(seen.complaint == "it was damaged, and is made anew");
    fill(folder.path(), 400);
    const Seen again = seen_in(folder.path(), 400);
    CHECK(again.known == 400);
    CHECK(again.complaint == "");
  }
}

TEST_CASE("an empty file is a new one") {
  const TemporaryFolder folder;
  put(file_in(folder.path()), "");
  CHECK(seen_in(folder.path(), 10).complaint == "");
  fill(folder.path(), 10);
  CHECK(seen_in(folder.path(), 10).known == 10);
}

// Of what SQLite does not notice the seal of the bytes does.
TEST_CASE("whatever byte is changed, nothing ends and all goes on") {
  const TemporaryFolder whole;
  fill(whole.path(), 100);
  const std::string text = file_text(file_in(whole.path()));
  std::size_t anew = 0;
  for (std::size_t at = 0; at < text.size(); at += at < 200 ? 1 : 97) {
    const TemporaryFolder folder;
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    put(file_in(folder.path()), damaged);
    CAPTURE(at);
    const Seen seen = seen_in(folder.path(), 100);
    CHECK(seen.known <= 100);
    anew += !seen.complaint.empty();
    fill(folder.path(), 100);
    CHECK(seen_in(folder.path(), 100).known > 0);
  }
  CHECK(anew > 10);
}

TEST_CASE("a database that is a program is not run") {
  const TemporaryFolder folder;
  const std::string file = file_in(folder.path()).string();
  const std::string make =
      std::string(
          "python3 -c \"import sqlite3, sys\n"
          "base = sqlite3.connect(sys.argv[1])\n"
          "base.executescript('''CREATE TABLE kept(id INTEGER PRIMARY KEY, "
          "rest, "
          "used, bytes);\n"
          "CREATE VIEW parts AS WITH RECURSIVE n(i) AS (VALUES(1) UNION ALL "
          "SELECT i + 1 FROM n) SELECT i AS id, 1 AS rest, 1 AS used, 'x' AS "
          "bytes "
          "FROM n;''')\" '") +
      file + "'";
  REQUIRE(run(make).code == 0);
  const Seen seen = seen_in(folder.path(), 10);
  CHECK(seen.known == 0);
  CHECK(seen.complaint == "it was damaged, and is made anew");
  fill(folder.path(), 10);
  CHECK(seen_in(folder.path(), 10).known == 10);
}

TEST_CASE("where there can be no file, nothing is kept and nothing fails") {
  const TemporaryFolder folder;
  fs::create_directory(file_in(folder.path()));
  CHECK(seen_in(folder.path(), 3).complaint == "it is no file");
  const TemporaryFolder with_pipe;
  REQUIRE(::mkfifo(file_in(with_pipe.path()).c_str(), 0600) == 0);
  CHECK(seen_in(with_pipe.path(), 3).complaint == "it is no file");
  const TemporaryFolder with_link;
  fs::create_symlink("/etc/passwd", file_in(with_link.path()));
  CHECK(seen_in(with_link.path(), 3).complaint == "it is no file");
  ComponentCache nowhere("/proc", kBuild);
  nowhere.try_out();
  CHECK(nowhere.complaint() == "unable to open database file");
  nowhere.keep(content(1), bytes_of(1));
  nowhere.write();
  CHECK_FALSE(nowhere.find(content(1)));
}

TEST_CASE("it does not grow beyond its bound, and what was used last stays") {
  constexpr std::uint64_t kMost = 512 << 10;
  const TemporaryFolder folder;
  for (std::uint64_t i = 0; i <= 600; ++i) {
    ComponentCache cache(folder.path().string(), kBuild, kMost);
    for (std::uint64_t j = 0; j < 10; ++j) {
      cache.keep(content(10 * i + j), bytes_of(10 * i + j, 300));
    }
    cache.write();
    CHECK(cache.complaint() == "");
    CHECK(fs::file_size(file_in(folder.path())) <= kMost);
  }
  ComponentCache cache(folder.path().string(), kBuild, kMost);
  CHECK(cache.find(content(6005)));
  std::size_t known = 0;
  for (std::uint64_t i = 0; i < 6010; ++i) {
    known += cache.find(content(i)).has_value();
  }
  CHECK(known > 300);
  CHECK(known < 2000);
  // What has no room at all is not kept.
  cache.keep(content(9999), bytes_of(9999, kMost));
  cache.write();
  CHECK(cache.complaint() == "");
  CHECK_FALSE(cache.find(content(9999)));
}

TEST_CASE("ten processes at once find what is right, and keep what is new") {
  const TemporaryFolder folder;
  constexpr std::uint64_t kEach = 200;
  std::vector<pid_t> processes;
  for (std::uint64_t p = 0; p < 10; ++p) {
    const pid_t process = ::fork();
    if (process == 0) {
      int wrong = 0;
      ComponentCache cache(folder.path().string(), kBuild);
      for (std::uint64_t round = 0; round < 5; ++round) {
        for (std::uint64_t i = 0; i < kEach; ++i) {
          const std::uint64_t number = 100 * p + i;
          const auto found = cache.find(content(number));
          if (found) {
            wrong += *found != bytes_of(number);
          } else {
            cache.keep(content(number), bytes_of(number));
          }
        }
        cache.write();
      }
      ::_exit(wrong > 0 ? 1 : cache.complaint().empty() ? 0 : 2);
    }
    processes.push_back(process);
  }
  for (const pid_t process : processes) {
    int status = 0;
    REQUIRE(::waitpid(process, &status, 0) == process);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
  }
  const Seen seen = seen_in(folder.path(), 1100);
  CHECK(seen.wrong == 0);
  CHECK(seen.known == 1100);
}

TEST_CASE("a process that is killed while it writes leaves a whole file") {
  for (int after = 1; after < 40; after += 3) {
    const TemporaryFolder folder;
    fill(folder.path(), 50);
    const pid_t process = ::fork();
    if (process == 0) {
      ComponentCache cache(folder.path().string(), kBuild);
      for (std::uint64_t i = 50;; ++i) {
        cache.keep(content(i), bytes_of(i, 2000));
        if (i % 20 == 0) cache.write();
      }
    }
    ::usleep(static_cast<useconds_t>(after) * 1000);
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    const Seen seen = seen_in(folder.path(), 50);
    CHECK(seen.known == 50);
    CHECK(seen.wrong == 0);
    CHECK(seen.complaint == "");
  }
}

TEST_CASE("a database that was open before a fork is left alone behind it") {
  const TemporaryFolder folder;
  ComponentCache cache(folder.path().string(), kBuild);
  cache.keep(content(1), bytes_of(1));
  cache.write();
  REQUIRE(cache.find(content(1)));
  const pid_t process = ::fork();
  if (process == 0) ::_exit(cache.find(content(1)) ? 1 : 0);
  int status = 0;
  REQUIRE(::waitpid(process, &status, 0) == process);
  CHECK(status == 0);
  CHECK(cache.find(content(1)));
}

}  // namespace
}  // namespace btcheck::component_cache_test

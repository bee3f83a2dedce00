// SPDX-License-Identifier: MIT
//
// --cache: what is told is the same without it, with an empty folder, with what
// was found out the last time, and with what somebody has made of that.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::cache_test {
namespace {

namespace fs = std::filesystem;

const std::string kProgram = "'" BTCHECK_PROGRAM "'";
const std::string kName = "btcheck-components.sqlite";

// Two drones on one battery, a tree that is asked part by part.
fs::path large_tree(const fs::path& folder) {
  const fs::path file = folder / "drones.btf";
  const auto made = run(
      fmt::format("python3 '{}/../bench/families' drones 2", BTCHECK_EXAMPLES));
  REQUIRE(made.code == 0);
  std::ofstream(file) << made.text;
  return file;
}

// JSON but for what is measured: how long it took, how much memory, and when.
std::string without_measures(const std::string& text) {
  static const std::regex kMeasured(
      "\"(seconds|bytes|peak_bytes|started)\": (\"[^\"]*\"|[0-9.e+-]+)");
  return std::regex_replace(text, kMeasured, "#");
}

std::string told(const std::string& line) {
  const Outcome outcome = run(kProgram + " " + line);
  return fmt::format("exit {}\n{}", outcome.code,
                     without_measures(outcome.text));
}

// What -v says of the folder.
std::string counted(const std::string& line) {
  const Outcome outcome = run(kProgram + " " + line + " -v 2>&1 >/dev/null");
  const std::size_t at = outcome.text.find("--cache: ");
  if (at == outcome.text.npos) return {};
  return outcome.text.substr(at, outcome.text.find('\n', at) - at);
}

}  // namespace

TEST_CASE("a report is the same whatever is known before") {
  const TemporaryFolder folder;
  const fs::path tree = large_tree(folder.path());
  const std::string line = fmt::format("'{}' --format json", tree.string());
  const std::string without = told(line);
  CHECK(without.find("\"nodes\"") != std::string::npos);
  const std::string cache = " --cache '" + (folder.path() / "c").string() + "'";
  CHECK(told(line + cache) == without);
  CHECK(told(line + cache) == without);
  const std::string warm = counted(line + cache);
  CHECK(std::regex_match(warm, std::regex("--cache: [0-9]{2,} known, 0 new, "
                                          "0 damaged")));
  const fs::path file = folder.path() / "c" / kName;
  const std::string whole = file_text(file);
  // Half of it, and garbage.
  for (const std::string& text :
       {whole.substr(0, whole.size() / 2), std::string(5000, 'x')}) {
    std::ofstream(file, std::ios::binary) << text;
    CHECK(told(line + cache + " 2>/dev/null") == without);
    CHECK(told(line + cache) == without);
  }
  // Bytes of the contents that are others now.
  std::string changed = whole;
  for (std::size_t at = 4096 + 777; at < changed.size(); at += 1500) {
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
  }
  std::ofstream(file, std::ios::binary) << changed;
  CHECK(told(line + cache + " 2>/dev/null") == without);
}

TEST_CASE("another build finds nothing of it") {
  const TemporaryFolder folder;
  const fs::path tree = large_tree(folder.path());
  const fs::path other = folder.path() / "other-btcheck";
  fs::copy_file(BTCHECK_PROGRAM, other);
  std::ofstream(other, std::ios::app) << "another build";
  const std::string words =
      fmt::format(" '{}' --no-repairs --cache '{}'", tree.string(),
                  (folder.path() / "c").string());
  const std::string first = counted(words);
  CHECK(first.starts_with("--cache: 0 known, "));
  CHECK(counted(words).find(", 0 new") != std::string::npos);
  const Outcome outcome =
      run("'" + other.string() + "'" + words + " -v 2>&1 >/dev/null");
  CHECK(outcome.text.find(first) != std::string::npos);
}

TEST_CASE("ten processes at once tell the same") {
  const TemporaryFolder folder;
  const fs::path tree = large_tree(folder.path());
  const std::string words =
      fmt::format("{} '{}' --no-repairs --format json --threads 1 --cache '{}'",
                  kProgram, tree.string(), (folder.path() / "c").string());
  const Outcome all =
      run(fmt::format("for i in 0 1 2 3 4 5 6 7 8 9; do {} >'{}/'$i.json "
                      "2>/dev/null & done; wait",
                      words, folder.path().string()));
  REQUIRE(all.code == 0);
  const Outcome without = run(fmt::format("{} '{}' --no-repairs --format json",
                                          kProgram, tree.string()));
  for (int i = 0; i < 10; ++i) {
    CHECK(without_measures(
              file_text(folder.path() / fmt::format("{}.json", i))) ==
          without_measures(without.text));
  }
}

TEST_CASE("a folder that cannot be made is an error, one without room is not") {
  const std::string tree = BTCHECK_EXAMPLES "/train.btf";
  const Outcome no_folder =
      run(kProgram + " " + tree + " --cache /dev/null/folder 2>&1");
  CHECK(no_folder.code == 2);
  CHECK(no_folder.text.find("error[BT0004]: --cache: cannot make the directory "
                            "`/dev/null/folder`") != std::string::npos);
  const std::string plain = told(tree + " --format json");
  CHECK(told(tree + " --format json --cache /proc 2>/dev/null") == plain);
  const Outcome no_room =
      run(kProgram + " " + tree + " --cache /proc 2>&1 >/dev/null");
  CHECK(no_room.text.find("warning[BT0004]: --cache /proc: unable to open "
                          "database file") != std::string::npos);
}

TEST_CASE("trees of the examples are told the same with one cache for all") {
  const TemporaryFolder folder;
  const std::string cache = " --cache '" + folder.path().string() + "'";
  for (const char* words :
       {"drone1.btf", "drone3.btf", "drone3-fixed.btf", "nav2.btf",
        "recovery.btf", "train.btf",
        "drone3.btf --prop " BTCHECK_EXAMPLES "/drone3.ltl"}) {
    const std::string line = std::string(BTCHECK_EXAMPLES "/") + words +
                             " --format json 2>/dev/null";
    const std::string without = told(line);
    CHECK(told(line + cache) == without);
    CHECK(told(line + cache) == without);
  }
}

TEST_CASE("a batch, a comparison and a server use it as well") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "trees");
  const fs::path tree = large_tree(folder.path() / "trees");
  const std::string cache = " --cache '" + (folder.path() / "c").string() + "'";
  const std::string batch = "batch '" + (folder.path() / "trees").string() +
                            "' --no-repairs --format json";
  const std::string without = told(batch);
  CHECK(told(batch + cache) == without);
  // What its workers have kept is there.
  const std::string check = "'" + tree.string() + "' --no-repairs";
  CHECK(counted(check + cache).find(", 0 new, 0 damaged") != std::string::npos);
  const std::string diff =
      "diff " BTCHECK_EXAMPLES "/drone1.btf " BTCHECK_EXAMPLES
      "/drone3.btf --format json";
  CHECK(told(diff + cache) == told(diff));
}

}  // namespace btcheck::cache_test

// SPDX-License-Identifier: MIT
//
// `btcheck tests` as a user types it: its files, what it refuses, and suites
// that BehaviorTree.CPP has passed. Those are in recorded/, with what
// run_suites has said of each in recorded/engine.txt; a suite that changes has
// to be run again.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace program_test {

namespace fs = std::filesystem;
using namespace btcheck;

const std::string kProgram = quoted(fs::path(BTCHECK_PROGRAM));
const fs::path kExamples = BTCHECK_EXAMPLES;
const fs::path kRecorded = fs::path(BTCHECK_SUITES) / "recorded";

Outcome tests_of(const fs::path& folder, const std::string& words) {
  return run_in(folder, kProgram + " tests " + words + " 2>&1");
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

TEST_CASE("suites are those that the engine has passed") {
  const std::string passed = file_text(kRecorded / "engine.txt");
  for (const std::string name :
       {"observer/mission", "world/patrol", "cookbook/one_motion",
        "cookbook/two_checks_broken", "nav2/own/last_recovery",
        "nav2/own/patrol"}) {
    CAPTURE(name);
    const TemporaryFolder folder;
    const Outcome made = tests_of(
        kExamples, name + ".xml -q --to jsonl -o " + quoted(folder.path()));
    CHECK(made.code == 0);
    const std::string file =
        fs::path(name).filename().string() + ".tests.jsonl";
    const std::string text = file_text(folder.path() / file);
    std::string kept = name + ".tests.jsonl";
    std::ranges::replace(kept, '/', '-');
    if (std::getenv("BTCHECK_UPDATE") != nullptr) {
      write(kRecorded / kept, text);
      continue;
    }
    CHECK(text == file_text(kRecorded / kept));
    const std::string line =
        kept + " (" + std::to_string(text.size()) + " bytes): ";
    const std::size_t begin = passed.find(line);
    REQUIRE_MESSAGE(begin != std::string::npos,
                    "run_suites has not been asked of " << kept);
    const std::string said = passed.substr(
        begin + line.size(), passed.find('\n', begin) - begin - line.size());
    const auto tests = std::ranges::count(text, '\n') - 1;
    const std::string all = std::to_string(tests);
    CHECK(said.starts_with(all + " of " + all + " tests pass, "));
  }
}

TEST_CASE("all is written, or nothing") {
  const TemporaryFolder folder;
  const fs::path tree = kExamples / "cookbook/one_motion.xml";
  const std::string words = quoted(tree) + " -o suites";
  const Outcome first = tests_of(folder.path(), words);
  CHECK(first.code == 0);
  CHECK(first.text.find("9 tests reach 12 of 12 answers and halts that are "
                        "proven possible (100 %)\n") != std::string::npos);
  const fs::path suites = folder.path() / "suites";
  const std::vector<std::string> files = {
      "one_motion_test.cpp", "CMakeLists.txt", "test_one_motion.py",
      "one_motion.tests.jsonl"};
  for (const std::string& file : files) CHECK(fs::exists(suites / file));
  // Its own files are replaced, those of others are not.
  CHECK(tests_of(folder.path(), words).code == 0);
  write(suites / "CMakeLists.txt", "project(robot)\n");
  fs::remove(suites / "one_motion_test.cpp");
  const Outcome refused = tests_of(folder.path(), words);
  CHECK(refused.code == 2);
  CHECK(refused.text.find(
            "`suites/CMakeLists.txt` is there, and not written by "
            "`btcheck tests`; --force replaces it") != std::string::npos);
  CHECK_FALSE(fs::exists(suites / "one_motion_test.cpp"));
  CHECK(file_text(suites / "CMakeLists.txt") == "project(robot)\n");
  CHECK(tests_of(folder.path(), words + " --force").code == 0);
  CHECK(fs::exists(suites / "one_motion_test.cpp"));
  CHECK(file_text(suites / "CMakeLists.txt").find("btcheck_tests") !=
        std::string::npos);
}

TEST_CASE("what cannot be written is refused") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& words) {
    const Outcome outcome = tests_of(folder.path(), words);
    CHECK(outcome.code == 2);
    return outcome.text;
  };
  const std::string motion = quoted(kExamples / "cookbook/one_motion.xml");
  const std::string drone = quoted(kExamples / "drone3.btf");
  CHECK(refused(motion).find("tests: no folder to write into") !=
        std::string::npos);
  CHECK(refused(motion + " -o x --to junit").find("--to junit") !=
        std::string::npos);
  CHECK(refused("none.xml -o x").find("none.xml") != std::string::npos);
  CHECK(refused(drone + " -q -o x --to googletest")
            .find("googletest is for trees of BehaviorTree.CPP") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "x"));
  write(folder.path() / "file", "");
  CHECK(refused(motion + " -o file/x").find("error[BT0004]") !=
        std::string::npos);
}

TEST_CASE("a search that is stopped says so") {
  const TemporaryFolder folder;
  const Outcome stopped =
      tests_of(folder.path(),
               quoted(kExamples / "drone3.btf") + " -q -o x --max-states 3");
  CHECK(stopped.code == 3);
  CHECK(stopped.text.find("the search was stopped") != std::string::npos);
}

}  // namespace program_test

// SPDX-License-Identifier: MIT
//
// A btcheck.toml beside a tree means to the door what it means to the program.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "api/comparable.hpp"
#include "btcheck/check.hpp"
#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::api_settings_test {
namespace {

namespace fs = std::filesystem;
namespace v1 = btcheck::v1;

using Texts = std::map<std::string, std::string>;

v1::Files files_of(const Texts& texts) {
  v1::Files files;
  for (const auto& [name, text] : texts) files.add(name, text);
  return files;
}

v1::Request request_for(const std::string& tree) {
  v1::Request request;
  request.tree = tree;
  return request;
}

// The program in a folder that holds these texts.
Outcome program(const Texts& texts, const std::string& words) {
  const TemporaryFolder folder;
  for (const auto& [name, text] : texts) {
    fs::create_directories((folder.path() / name).parent_path());
    std::ofstream(folder.path() / name) << text;
  }
  fs::create_directory(folder.path() / ".git");
  return run_in(folder.path(), "'" BTCHECK_PROGRAM "' " + words +
                                   " --format json 2>/dev/null");
}

constexpr const char* kTree =
    "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n"
    "<BehaviorTree ID=\"M\"><ReactiveSequence>\n"
    "  <IsOpen/><OpenDoor/>\n"
    "  <RetryUntilSuccessful num_attempts=\"2\"><Go/></RetryUntilSuccessful>\n"
    "  <Script code=\"lamp := RED\"/>\n"
    "</ReactiveSequence></BehaviorTree>\n"
    "<TreeNodesModel><Condition ID=\"IsOpen\"/></TreeNodesModel></root>\n";

void same_as_program(const Texts& texts, const std::string& tree) {
  CAPTURE(tree);
  v1::Files files = files_of(texts);
  const v1::Report checked = v1::check(request_for(tree), files);
  const Outcome told = program(texts, tree);
  CHECK(comparable(checked.json()) == comparable(told.text));
  CHECK(static_cast<int>(checked.outcome) == told.code);
  const v1::Report linted = v1::lint(request_for(tree), files);
  const Outcome read = program(texts, "lint " + tree);
  CHECK(comparable(linted.json()) == comparable(read.text));
  CHECK(static_cast<int>(linted.outcome) == read.code);
}

TEST_CASE("levels, denials, contracts, enumerators and profile of settings") {
  const std::string leaves =
      "leaves = \"../robot.leaves\"\nenums = { RED = 1 }\n";
  for (const std::string& settings :
       {std::string(), std::string("profile = \"btcpp-4.8\"\n"),
        std::string("deny = [\"warnings\"]\n"),
        leaves + "tick-ms = 10\nloop = true\nwake-ups = true\n",
        leaves + "[levels]\nBT2211 = \"allow\"\nwarnings = \"note\"\n",
        std::string("[[paths]]\nmatch = \"deep/*\"\n"
                    "levels = { BT2211 = \"error\" }\n")}) {
    CAPTURE(settings);
    same_as_program({{"trees/deep/a.xml", kTree},
                     {"trees/btcheck.toml", settings},
                     {"robot.leaves", "(defaction Go :returns (success))\n"}},
                    "trees/deep/a.xml");
  }
}

TEST_CASE("what settings allow is not told, and counted") {
  v1::Files files = files_of(
      {{"a.xml", kTree}, {"btcheck.toml", "[levels]\nBT2211 = \"allow\"\n"}});
  const v1::Report report = v1::check(request_for("a.xml"), files);
  CHECK(report.allowed > 0);
  CHECK(std::ranges::count(report.findings, "BT2211", &v1::Finding::code) == 0);
  files.add("btcheck.toml", "");
  const v1::Report all = v1::check(request_for("a.xml"), files);
  CHECK(all.allowed == 0);
  CHECK(all.findings.size() > report.findings.size());
}

TEST_CASE("without settings, and with wrong ones") {
  same_as_program({{"a.xml", kTree}}, "a.xml");
  for (const char* wrong :
       {"profil = 1\n", "[levels", "[levels]\nBT0002 = \"allow\"\n"}) {
    CAPTURE(wrong);
    same_as_program({{"a.xml", kTree}, {"btcheck.toml", wrong}}, "a.xml");
  }
  v1::Files files = files_of(
      {{"x/a.xml", kTree}, {"btcheck.toml", "leaves = \"gone.leaves\"\n"}});
  const v1::Report report = v1::check(request_for("x/a.xml"), files);
  CHECK(report.outcome == v1::Outcome::BadInput);
  REQUIRE(report.findings.size() == 1);
  CHECK(report.findings[0].code == "BT0002");
  CHECK(report.findings[0].where.file == "gone.leaves");
}

TEST_CASE("settings of XML trees mean nothing beside a .btf tree") {
  same_as_program(
      {{"drone1.btf", file_text(fs::path(BTCHECK_EXAMPLES) / "drone1.btf")},
       {"btcheck.toml",
        "profile = \"nav2-jazzy\"\nleaves = \"gone.leaves\"\nloop = true\n"}},
      "drone1.btf");
}

TEST_CASE("what the request says wins, and a source may have none") {
  v1::Files files = files_of(
      {{"a.xml", kTree}, {"btcheck.toml", "profile = \"btcpp-4.8\"\n"}});
  v1::Request request = request_for("a.xml");
  CHECK(v1::check(request, files).profile == "btcpp-4.8");
  request.profile = "btcpp-4.7";
  CHECK(v1::check(request, files).profile == "btcpp-4.7");
  class Plain final : public v1::Sources {
   public:
    explicit Plain(v1::Files& files) : files_(files) {}
    std::optional<std::string> text(const std::string& name) override {
      return files_.text(name);
    }

   private:
    v1::Files& files_;
  } plain(files);
  CHECK(v1::check(request_for("a.xml"), plain).profile == "btcpp-4");
}

TEST_CASE("the nearest settings above the tree count") {
  v1::Files files = files_of({{"x/y/a.xml", kTree},
                              {"x/btcheck.toml", "profile = \"btcpp-4.7\"\n"},
                              {"btcheck.toml", "profile = \"btcpp-4.8\"\n"}});
  CHECK(files.settings("x/y/a.xml")->name == "x/btcheck.toml");
  CHECK(files.settings("./x/a.xml")->name == "x/btcheck.toml");
  CHECK(files.settings("z/a.xml")->name == "btcheck.toml");
  CHECK_FALSE(files.settings("/z/a.xml"));
  CHECK(v1::describe(request_for("x/y/a.xml"), files).profile == "btcpp-4.7");
}

TEST_CASE("a request that cannot be meant") {
  v1::Files files = files_of({{"a.xml", kTree}});
  v1::Request request = request_for("a.xml");
  request.ticks = "now";
  CHECK_THROWS_AS(v1::lint(request, files), std::invalid_argument);
  request.ticks = "leaves";
  CHECK(v1::check(request, files).findings[0].code == "BT1636");
  request.ticks.clear();
  request.tick_milliseconds = -1;
  CHECK_THROWS_AS(v1::check(request, files), std::invalid_argument);
}

}  // namespace
}  // namespace btcheck::api_settings_test

// SPDX-License-Identifier: MIT
//
// What is kept of a batch: all of it comes back, and what is damaged does not.
#include "batch/results/results_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "batch/results/kept_text.hpp"
#include "checked_report.hpp"
#include "file_text.hpp"
#include "report/formats/formats.hpp"
#include "temporary_folder.hpp"

namespace btcheck::results_file_test {
namespace {

constexpr auto kOver = ResultsFile::Start::Over;
constexpr auto kTakeUp = ResultsFile::Start::TakeUp;

void put(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string told(const Report& report) {
  return json_text(report) + junit_text(report) + sarif_text(report);
}

// A tree with findings, runs, a loop, tags, a warning, and a repair.
Report eventful() {
  Report report =
      report_of(kSmallTree,
                "## Title\nproperty p [safety, req=1]: never a.failure\n"
                "property q expect violated: eventually a.success\n"
                "property r: always X a.failure\n"
                "property s: whenever c.success then a.ticked within 1 tick\n"
                "property t: [] c.failure => <> a.failure\n");
  report.trees[0].findings.at(0).repair = a_repair();
  return report;
}

// A result that may be kept.
ReportedTree tree_named(const std::string& entry) {
  ReportedTree tree;
  tree.entry = entry;
  tree.files.emplace_back();
  return tree;
}

// So many trees under the keys of their numbers.
void keep(const std::string& file, std::size_t count) {
  ResultsFile kept(file, kOver);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    kept.add(content_hash(number), tree_named("entry " + number));
  }
  CHECK(kept.complaint().empty());
}

// How many of so many trees are found again.
std::size_t found(ResultsFile& kept, std::size_t count) {
  std::size_t trees = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto tree = kept.find(content_hash(std::to_string(i))).tree;
    if (!tree) continue;
    CHECK(tree->entry == "entry " + std::to_string(i));
    ++trees;
  }
  return trees;
}

TEST_CASE("reports of what was kept are those of what was found") {
  for (Report report :
       {eventful(), report_of(kSmallTree, ""), report_of("(nothing", "")}) {
    const std::string before = told(report);
    const auto back = tree_from(kept_text(report.trees[0]));
    REQUIRE(back.has_value());
    // Nothing of the tree is lost, even what no format tells.
    CHECK(kept_text(*back) == kept_text(report.trees[0]));
    report.trees[0] = *back;
    CHECK(told(report) == before);
  }
}

TEST_CASE("a kept text is one line, and another version's is not read") {
  CHECK(kept_text(eventful().trees[0]).find('\n') == std::string::npos);
  for (const char* text : {"", "{}", "[]", "7", "{\"entry\": 3}", "{"}) {
    CHECK(!tree_from(text).has_value());
  }
}

TEST_CASE("a file is taken up, or started over") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  keep(file, 5);
  const std::string text = file_text(file);
  ResultsFile taken(file, kTakeUp);
  CHECK(found(taken, 5) == 5);
  CHECK(file_text(file) == text);
  ResultsFile over(file, kOver);
  CHECK(found(over, 5) == 0);
  CHECK(file_text(file).empty());
}

TEST_CASE("what was not used is dropped when it is said to be") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  keep(file, 5);
  {
    ResultsFile kept(file, kTakeUp);
    CHECK(found(kept, 2) == 2);
    for (const char* one : {"0", "1"}) kept.use(content_hash(one));
    kept.add(content_hash("new"), tree_named("new"));
    kept.drop_unused();
  }
  ResultsFile kept(file, kTakeUp);
  CHECK(kept.damaged() == 0);
  CHECK(found(kept, 5) == 2);
  CHECK(kept.find(content_hash("new")).tree.has_value());
}

TEST_CASE("what may be another time is not kept") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  ResultsFile kept(file, kOver);
  for (const ExitCode code : {ExitCode::BadInput, ExitCode::Internal}) {
    ReportedTree tree = tree_named("broken");
    tree.code = code;
    kept.add(content_hash("k"), tree);
  }
  CHECK(!kept.find(content_hash("k")).tree.has_value());
  CHECK(!std::filesystem::exists(file));
}

TEST_CASE("no file is made before there is something to keep") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  ResultsFile kept(file, kOver);
  kept.drop_unused();
  CHECK(!std::filesystem::exists(file));
}

TEST_CASE("what is added last under a key is what is found") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  const std::string key = content_hash("k");
  {
    ResultsFile kept(file, kOver);
    kept.add(key, tree_named("old"));
    kept.add(key, tree_named("new"));
  }
  CHECK(ResultsFile(file, kTakeUp).find(key).tree->entry == "new");
}

TEST_CASE("wherever the file ends, the whole lines before are found") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  keep(file, 3);
  const std::string text = file_text(file);
  for (std::size_t end = 0; end <= text.size(); ++end) {
    put(file, text.substr(0, end));
    ResultsFile kept(file, kTakeUp);
    const auto whole = static_cast<std::size_t>(
        std::count(text.begin(), text.begin() + static_cast<long>(end), '\n'));
    REQUIRE(found(kept, 3) == (whole == 0 ? 0 : whole - 1));  // the heading
    REQUIRE(kept.damaged() == (end == 0 || text[end - 1] == '\n' ? 0 : 1));
  }
}

TEST_CASE(
    "whatever byte is another one, its line is not found, and is mended") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  keep(file, 3);
  const std::string text = file_text(file);
  for (std::size_t at = text.find('\n') + 1; at < text.size(); ++at) {
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    put(file, damaged);
    ResultsFile kept(file, kTakeUp);
    REQUIRE(kept.damaged() >= 1);
    REQUIRE(found(kept, 3) <= 2);
    REQUIRE(found(kept, 3) >= 1);
    ResultsFile again(file, kTakeUp);
    REQUIRE(again.damaged() == 0);
    REQUIRE(found(again, 3) == found(kept, 3));
  }
}

TEST_CASE("what is no such file is started over") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "kept";
  put(file, std::string("\0\n\xff\n\n", 5));
  CHECK(ResultsFile(file, kTakeUp).damaged() == 3);
  CHECK(file_text(file).empty());
}

TEST_CASE("where nothing can be kept, everything else goes on") {
  ResultsFile kept("/nowhere/at/all", kTakeUp);
  kept.add(content_hash("k"), tree_named("k"));
  CHECK(!kept.complaint().empty());
}

TEST_CASE("content hashes are those of XXH3") {
  CHECK(content_hash("") == "99aa06d3014798d86001c324468d497f");
  CHECK(content_hash("a") != content_hash("b"));
}

}  // namespace
}  // namespace btcheck::results_file_test

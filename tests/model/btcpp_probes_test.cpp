// SPDX-License-Identifier: MIT
//
// The recorded runs of tests/btcpp_probes: each tree is readable, each record
// well formed, and every leaf of a record is a leaf of its tree that can
// answer so.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "btcpp_text.hpp"
#include "file_text.hpp"

namespace fs = std::filesystem;

namespace btcheck::btcpp_probes_test {
namespace {

std::vector<fs::path> files_ending(std::string_view extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(BTCHECK_BTCPP_PROBES)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  return files;
}

// The words of each line that is no comment.
std::vector<std::vector<std::string>> lines_of(const fs::path& file) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream text(file_text(file.string()));
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    lines.emplace_back();
    for (std::string word; words >> word;) lines.back().push_back(word);
  }
  return lines;
}

// The leaves of a tree that may stand in a record, by ID.
std::map<std::string, BtcppKind> leaves_of(const ReadTree& tree) {
  std::map<std::string, BtcppKind> leaves;
  for (const BtcppNode& node : tree.document->trees[0].nodes) {
    if (node.kind == BtcppKind::Action || node.kind == BtcppKind::Condition) {
      leaves[node.id] = node.kind;
    }
  }
  return leaves;
}

void check_event(const std::string& word,
                 const std::map<std::string, BtcppKind>& leaves) {
  CAPTURE(word);
  const auto colon = word.find(':');
  REQUIRE(colon != std::string::npos);
  const auto leaf = leaves.find(word.substr(0, colon));
  REQUIRE(leaf != leaves.end());
  const std::string what = word.substr(colon + 1);
  const bool is_of_all = what == "S" || what == "F" || what == "K";
  const bool is_of_actions = what == "R" || what == "halt";
  CHECK((is_of_all || (is_of_actions && leaf->second == BtcppKind::Action)));
}

TEST_CASE("every probe has its tree and its record") {
  std::set<fs::path> trees;
  for (fs::path file : files_ending(".xml")) {
    trees.insert(file.replace_extension());
  }
  std::set<fs::path> records;
  for (fs::path file : files_ending(".expected")) {
    records.insert(file.replace_extension());
  }
  CHECK(trees == records);
  CHECK(trees.size() == 63);
}

TEST_CASE("the trees of the probes are read without an error") {
  // The reader says itself what the engine says at the first tick.
  const std::map<std::string, std::string> found_by_reading = {
      {"P21", "BT1627"}};
  for (const fs::path& file : files_ending(".xml")) {
    CAPTURE(file);
    const ReadTree tree = good_tree(file_text(file.string()));
    CHECK(tree.document->main_tree == file.stem().string());
    std::string warned;
    for (const Diagnostic& found : tree.diagnostics) {
      if (found.code == "BT1627") warned = found.code;
    }
    const auto expected = found_by_reading.find(file.stem().string());
    CHECK(warned ==
          (expected == found_by_reading.end() ? "" : expected->second));
  }
}

TEST_CASE("the records are well formed and fit their trees") {
  const std::set<std::string> statuses = {"RUNNING", "SUCCESS", "FAILURE",
                                          "SKIPPED", "EXCEPTION"};
  for (fs::path file : files_ending(".expected")) {
    CAPTURE(file);
    const auto lines = lines_of(file);
    REQUIRE(!lines.empty());
    const ReadTree tree =
        good_tree(file_text(file.replace_extension(".xml").string()));
    const auto leaves = leaves_of(tree);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& words = lines[i];
      const bool is_tick = words[0] == "tick";
      CHECK((is_tick || (words[0] == "haltTree" && i + 1 == lines.size())));
      if (is_tick) {
        REQUIRE(words.size() >= 3);
        CHECK(words[1] == std::to_string(i));
        CHECK(statuses.contains(words[2]));
      }
      for (std::size_t j = is_tick ? 3 : 1; j < words.size(); ++j) {
        check_event(words[j], leaves);
      }
    }
  }
}

}  // namespace
}  // namespace btcheck::btcpp_probes_test

// SPDX-License-Identifier: MIT
//
// Planted bugs: a finding of the right code names each, and is gone in the
// repaired twin. `tests/findings/expected` has all that is said of them; with
// BTCHECK_UPDATE set it is written instead.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"

namespace fs = std::filesystem;

namespace btcheck::findings_test {
namespace {

const fs::path kFolder = BTCHECK_FINDINGS;

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, '\t');) {
    found.push_back(field);
  }
  return found;
}

std::string said_of(const std::string& tree) {
  const std::string program = "'" BTCHECK_PROGRAM "' ";
  return run_in(kFolder, program + tree + " -q 2>&1").text;
}

// The codes in square brackets of the headings that begin with one of these.
std::set<std::string> codes_in(const std::string& text,
                               const std::vector<std::string>& levels = {
                                   "warning[", "error["}) {
  std::set<std::string> codes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find('[');
    const bool is_heading = std::ranges::any_of(
        levels,
        [&](const std::string& level) { return line.starts_with(level); });
    if (is_heading) codes.insert(line.substr(begin + 1, 6));
    // A fault is told with the mission as a whole.
    if (line.starts_with("Not so: no script")) codes.insert("BT2101");
  }
  return codes;
}

// The codes of questions that speak of the node, or of its line.
std::set<std::string> asked_of(const std::string& node, const std::string& at,
                               const std::string& text) {
  const std::string name = "`" + node.substr(node.find_last_of(' ') + 1) + "`";
  std::set<std::string> codes;
  std::istringstream lines(text);
  std::string code;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) code.clear();
    if (line.starts_with("  BT25")) code = line.substr(2, 6);
    const bool is_there = line.find(name) != std::string::npos ||
                          line.find("  line " + at + "  ") != std::string::npos;
    if (!code.empty() && is_there) {
      codes.insert(code);
    }
  }
  return codes;
}

const std::map<std::string, std::set<std::string>> kCodes = {
    {"stale-guard", {"BT2205", "BT2501"}},
    {"guard-without-effect", {"BT2209"}},
    {"dead-node", {"BT2201", "BT2204"}},
    {"never-succeeds-or-fails", {"BT2202", "BT2204", "BT2213"}},
    {"always-skipped", {"BT2212"}},
    {"swallowed-failure", {"BT2207", "BT2503"}},
    {"failure-despite-success", {"BT2208"}},
    {"self-interruption", {"BT2210", "BT2504"}},
    {"restart-every-tick", {"BT2211"}},
    {"parallel-cutoff", {"BT2202", "BT2214", "BT2502"}},
    {"unbounded-retry", {"BT2215", "BT2505"}},
    {"forgotten-reset", {"BT2216"}},
    {"left-running", {"BT2206"}},
    {"read-before-write", {"BT1628", "BT1644", "BT2101", "BT2217"}}};

TEST_CASE("planted bugs are named, and not in their repaired twins") {
  std::istringstream rows(file_text(kFolder / "bugs.tsv"));
  std::string row;
  std::getline(rows, row);
  std::size_t count = 0;
  while (std::getline(rows, row)) {
    const std::vector<std::string> columns = fields(row);
    INFO(columns[0]);
    const std::set<std::string>& wanted = kCodes.at(columns[2]);
    const auto named = [&](const std::string& tree) {
      const std::string text = said_of(tree);
      std::set<std::string> codes =
          codes_in(text, {"note[", "warning[", "error["});
      codes.merge(asked_of(columns[3], columns[4], text));
      std::erase_if(codes, [&](const std::string& code) {
        return !wanted.contains(code);
      });
      return codes;
    };
    const std::set<std::string> codes = named(columns[0]);
    CHECK(!codes.empty());
    const std::set<std::string> left = named(columns[1]);
    CHECK(std::ranges::none_of(
        codes, [&](const std::string& code) { return left.contains(code); }));
    ++count;
  }
  CHECK(count == 79);
}

TEST_CASE("what is said of planted bugs and clean trees") {
  std::vector<std::string> trees;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".xml")) trees.push_back(name);
  }
  std::ranges::sort(trees);
  std::string text;
  for (const std::string& tree : trees) {
    text += "=== " + tree + "\n" + said_of(tree);
    if (!tree.ends_with("-bug.xml")) {
      INFO(tree);
      CHECK(codes_in(said_of(tree)).empty());
    }
  }
  if (std::getenv("BTCHECK_UPDATE") != nullptr) {
    std::ofstream(kFolder / "expected") << text;
    return;
  }
  CHECK(text == file_text(kFolder / "expected"));
}

// "`X` succeeded" in the heading of a finding, and "X -> success" in its run,
// where that shows what X answers.
TEST_CASE("words and runs of findings agree") {
  static const std::regex kSaid("`([^`]+)` (?:has )?(succeed|fail)(?:s|ed)\\b");
  std::istringstream lines(file_text(kFolder / "expected"));
  std::vector<std::pair<std::string, std::string>> wanted;
  std::size_t agreed = 0;
  std::string run;
  const auto compare = [&] {
    for (const auto& each : wanted) {
      const std::string of_it = " " + each.first + " -> ";
      if (run.find(of_it) == std::string::npos) continue;
      INFO(of_it, each.second, " in\n", run);
      CHECK(run.find(of_it + each.second) != std::string::npos);
      ++agreed;
    }
    wanted.clear();
    run.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    const bool is_heading =
        line.starts_with("warning[") || line.starts_with("note[");
    if (is_heading) compare();
    if (line.starts_with("    tick ")) run += line + "\n";
    if (!is_heading) continue;
    for (std::sregex_iterator said(line.begin(), line.end(), kSaid), end;
         said != end; ++said) {
      wanted.emplace_back((*said)[1].str(),
                          (*said)[2] == "fail" ? "failure" : "success");
    }
  }
  compare();
  CHECK(agreed > 8);
}

}  // namespace

}  // namespace btcheck::findings_test

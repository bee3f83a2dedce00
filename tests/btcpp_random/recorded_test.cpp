// SPDX-License-Identifier: MIT
//
// Random trees as BehaviorTree.CPP and py_trees themselves have run them:
// btcheck has the same lines. script/compare-engine writes the records, and
// tests/py_trees/random_trees.py.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "btcpp_random/scripted_run.hpp"
#include "file_text.hpp"
#include "model/tree/answers.hpp"
#include "model/tree_file.hpp"

namespace btcheck::reference::recorded_test {
namespace {

struct RecordedRun {
  std::string name;
  Profile profile{};
  // What stands below `--- xml`, `--- leaves`, `--- script`, `--- engine` and,
  // of py_trees, `--- status`.
  std::string xml;
  std::string leaves;
  std::string script;
  std::string engine;
  std::string status = {};
};

std::vector<RecordedRun> runs_in(const std::string& text) {
  std::vector<RecordedRun> runs;
  std::istringstream lines(text);
  std::string* part = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("=== ")) {
      const std::size_t blank = line.rfind(' ');
      const auto profile = profile_named(line.substr(blank + 1));
      REQUIRE(profile.has_value());
      runs.push_back({line.substr(4, blank - 4), *profile, "", "", "", ""});
    } else if (line == "--- xml") {
      part = &runs.back().xml;
    } else if (line == "--- leaves") {
      part = &runs.back().leaves;
    } else if (line == "--- script") {
      part = &runs.back().script;
    } else if (line == "--- engine") {
      part = &runs.back().engine;
    } else if (line == "--- status") {
      part = &runs.back().status;
    } else if (part != nullptr) {
      *part += line + '\n';
    }
  }
  return runs;
}

// As script/compare-engine has it: an entry that is not there is `unset`, the
// text `text_2` is `2`, and what an exception leaves behind is left out.
std::string common(const std::string& lines) {
  std::string known = std::regex_replace(
      lines, std::regex("=(unknown|any|no_value)\\b"), "=unset");
  known = std::regex_replace(known, std::regex("=text_"), "=");
  return std::regex_replace(known, std::regex("(root=none)[^\n]*"), "$1");
}

// Before 4.5 the engine tells of success and failure only: `n1=success,halted`
// is `n1=success`, and what has neither is left out.
std::string told_by_older(const std::string& lines) {
  const std::string kOther = "(running|skipped|halted)";
  std::string told = std::regex_replace(
      lines, std::regex(" [^ =\n]+=" + kOther + "(," + kOther + ")*(?=[ \n])"),
      "");
  told = std::regex_replace(told, std::regex("=(" + kOther + ",)+"), "=");
  return std::regex_replace(told, std::regex("," + kOther + "(?=[, \n])"), "");
}

// A status that the node is said never to have, in a line of statuses.
bool has_impossible(const std::vector<Answers>& answers,
                    const std::string& statuses) {
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    const Answers& possible = answers[i + 1];
    const char status = statuses[i];
    if ((status == 'S' && !possible.success) ||
        (status == 'F' && !possible.failure) ||
        (status == 'R' && !possible.runs)) {
      return true;
    }
  }
  return false;
}

void check_records(const std::string& file) {
  const std::vector<RecordedRun> runs = runs_in(file_text(file));
  REQUIRE(runs.size() >= 10);
  std::size_t ticks = 0;
  for (const RecordedRun& run : runs) {
    CAPTURE(run.name);
    const auto tree =
        read_tree("t.xml", run.xml, scripted_reading(run.profile, run.leaves));
    REQUIRE(tree.value.has_value());
    const auto recorded = static_cast<int>(
        std::count(run.engine.begin(), run.engine.end(), '\n'));
    const ScriptedRun played = scripted_run(*tree.value, run.script, recorded);
    CHECK(played.is_determined);
    const bool is_older = !is_release_3(run.profile) &&
                          run.profile != Profile::PyTrees &&
                          engine_release(run.profile) < 40500;
    if (is_older) {
      CHECK(told_by_older(common(played.lines)) == told_by_older(run.engine));
    } else {
      CHECK(common(played.lines) == run.engine);
    }
    if (!run.status.empty()) CHECK(played.statuses == run.status);
    const auto answers = possible_answers(*tree.value);
    std::istringstream statuses(run.status);
    for (std::string line; std::getline(statuses, line);) {
      CHECK(!has_impossible(answers, line));
    }
    ticks += static_cast<std::size_t>(recorded);
  }
  MESSAGE(runs.size() << " recorded trees, " << ticks << " ticks");
}

std::string record(const std::string& name) {
  return std::string(BTCHECK_BTCPP_RECORDS) + "/" + name;
}

}  // namespace

TEST_CASE("random trees run as BehaviorTree.CPP 4.10 has run them") {
  check_records(record("btcpp-4.10.0.txt"));
}

TEST_CASE("random trees run as BehaviorTree.CPP 4.8 has run them") {
  check_records(record("btcpp-4.8.4.txt"));
}

TEST_CASE("random trees run as BehaviorTree.CPP 4.6 has run them") {
  check_records(record("btcpp-4.6.2.txt"));
}

TEST_CASE("random trees run as BehaviorTree.CPP 4.1 to 4.3 have run them") {
  for (const std::string release : {"4.1.1", "4.2.1", "4.3.8"}) {
    CAPTURE(release);
    check_records(record("btcpp-" + release + ".txt"));
  }
}

TEST_CASE("random trees run as BehaviorTree.CPP 3.5.1 has run them") {
  check_records(record("btcpp-3.5.1.txt"));
}

TEST_CASE("random trees run as BehaviorTree.CPP 3.7 has run them") {
  check_records(record("btcpp-3.7.0.txt"));
}

TEST_CASE("random trees run as BehaviorTree.CPP 3.8 has run them") {
  check_records(record("btcpp-3.8.8.txt"));
}

// BTCHECK_RECORDS names a file with others: script/compare-py_trees.
TEST_CASE("random trees run as py_trees 2.2.3 has run them") {
  const char* others = std::getenv("BTCHECK_RECORDS");
  check_records(others != nullptr ? others : record("py_trees-2.2.3.txt"));
}

}  // namespace btcheck::reference::recorded_test

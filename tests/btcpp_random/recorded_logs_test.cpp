// SPDX-License-Identifier: MIT
//
// What FileLogger2 of BehaviorTree.CPP has written of random trees: the trees
// conform to it, and not to what is left when a record is taken out.
// script/compare-engine writes the records.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "btcpp_random/scripted_run.hpp"
#include "check/check.hpp"
#include "explore/state/step.hpp"
#include "file_text.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "trace/conform/conform.hpp"
#include "trace/run/record.hpp"

namespace btcheck::reference::recorded_logs_test {
namespace {

// The bytes of a record: six of time, two of the node, one of the status.
using Bytes = std::array<std::uint64_t, 9>;

struct RecordedLog {
  std::string name;
  Profile profile{};
  std::string xml;
  std::string leaves;
  std::vector<Bytes> records;
};

std::vector<RecordedLog> logs_in(const std::string& text) {
  std::vector<RecordedLog> logs;
  std::istringstream lines(text);
  std::string part;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("=== ")) {
      const std::size_t blank = line.rfind(' ');
      const auto profile = profile_named(line.substr(blank + 1));
      REQUIRE(profile.has_value());
      logs.push_back({line.substr(4, blank - 4), *profile, "", "", {}});
    } else if (line.starts_with("--- ")) {
      part = line;
    } else if (part == "--- xml") {
      logs.back().xml += line + '\n';
    } else if (part == "--- leaves") {
      logs.back().leaves += line + '\n';
    } else if (part == "--- log") {
      std::istringstream numbers(line);
      Bytes bytes{};
      for (std::uint64_t& byte : bytes) numbers >> byte;
      logs.back().records.push_back(bytes);
    }
  }
  return logs;
}

LogTransition transition(const Bytes& bytes) {
  LogTransition made;
  for (std::size_t i = 6; i-- > 0;) {
    made.time = made.time * 256 + static_cast<std::int64_t>(bytes[i]);
  }
  made.uid = static_cast<std::uint16_t>(bytes[6] + 256 * bytes[7]);
  made.after = static_cast<LogStatus>(bytes[8]);
  return made;
}

// The tree that has been logged, ready to be asked.
class Logged {
 public:
  explicit Logged(const RecordedLog& log)
      : tree_(read_tree("t.xml", log.xml, reading_of(log)).value.value()),
        network_(lower(tree_, TickSemantics::Root)),
        system_(network_),
        run_(recorded_tree(tree_, TreeInput("t.xml", log.xml))) {}

  Conformance follow(const std::vector<LogTransition>& records) const {
    BehaviorLog log = log_of_tree(run_);
    std::map<std::uint16_t, LogStatus> last;
    for (LogTransition record : records) {
      record.before = last[record.uid];
      last[record.uid] = record.after;
      log.transitions.push_back(record);
    }
    log.begin = 1;
    const auto nodes = LoggedNodes::match(log, tree_, run_);
    Limits limits;
    limits.max_states = 200'000;
    return conform(tree_, system_, log, nodes.value.value(), limits);
  }

 private:
  static TreeReading reading_of(const RecordedLog& log) {
    TreeReading reading = scripted_reading(log.profile, log.leaves);
    reading.loops = true;
    return reading;
  }

  BehaviorTree tree_;
  Network network_;
  CompiledNetwork system_;
  RecordedRun run_;
};

std::vector<RecordedLog> recorded_logs() {
  return logs_in(
      file_text(std::string(BTCHECK_BTCPP_RECORDS) + "/logs-btcpp-4.10.0.txt"));
}

std::vector<LogTransition> transitions_of(const RecordedLog& log) {
  std::vector<LogTransition> all;
  for (const Bytes& bytes : log.records) all.push_back(transition(bytes));
  return all;
}

}  // namespace

TEST_CASE("trees conform to the logs that BehaviorTree.CPP 4.10 has written") {
  const auto logs = recorded_logs();
  REQUIRE(logs.size() >= 40);
  std::size_t records = 0;
  for (const RecordedLog& log : logs) {
    CAPTURE(log.name);
    const Conformance found = Logged(log).follow(transitions_of(log));
    CHECK(found.conforms());
    records += log.records.size();
  }
  MESSAGE(logs.size() << " logs, " << records << " records");
}

TEST_CASE("a log of BehaviorTree.CPP without one of its records is refused") {
  int refused = 0;
  int tried = 0;
  for (const RecordedLog& log : recorded_logs()) {
    const Logged tree(log);
    const auto whole = transitions_of(log);
    // The last ones may not have come about yet.
    for (std::size_t at = 0; at + 12 < whole.size(); at += 5) {
      if (!is_completed(whole[at].after)) continue;
      auto rest = whole;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
      ++tried;
      refused += tree.follow(rest).refused.has_value();
    }
  }
  MESSAGE(refused << " of " << tried << " are refused");
  CHECK(tried > 100);
  CHECK(refused > tried * 9 / 10);
}

}  // namespace btcheck::reference::recorded_logs_test

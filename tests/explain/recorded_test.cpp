// SPDX-License-Identifier: MIT
//
// Logs of BehaviorTree.CPP with a fault that is known: it is named first.
// script/compare-explain writes the records.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "file_text.hpp"
#include "model/sampling.hpp"
#include "model/tree_file.hpp"
#include "trace/explain/explain.hpp"
#include "trace/run/record.hpp"

namespace btcheck::recorded_faults_test {
namespace {

struct Record {
  std::string name;
  Profile profile{};
  std::string leaf;
  std::string fault;
  std::map<std::string, std::string> parts;  // xml, leaves, log, marks
};

std::vector<Record> records_in(const std::string& text) {
  std::vector<Record> records;
  std::istringstream lines(text);
  std::string* part = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("=== ")) {
      std::istringstream words(line.substr(4));
      Record& made = records.emplace_back();
      std::string profile;
      words >> made.name >> profile >> made.leaf >> made.fault;
      made.profile = profile_named(profile).value();
    } else if (line.starts_with("--- ")) {
      part = &records.back().parts[line.substr(4)];
    } else {
      *part += line + '\n';
    }
  }
  return records;
}

// Numbers of bytes.
std::string bytes_in(const std::string& text) {
  std::string bytes;
  std::istringstream numbers(text);
  for (int number = 0; numbers >> number;) {
    bytes += static_cast<char>(number);
  }
  return bytes;
}

void look_at(const Record& record) {
  CAPTURE(record.name);
  TreeReading reading;
  reading.profile = record.profile;
  reading.loops = true;
  reading.leaves = {{"t.leaves", record.parts.at("leaves")}};
  const std::string& xml = record.parts.at("xml");
  const auto tree = read_tree("t.xml", xml, reading);
  REQUIRE(tree.value.has_value());
  const auto network =
      lower_values(*tree.value, SourceText("t.xml", xml), TickSemantics::Root);
  REQUIRE(network.value.has_value());
  auto log = read_log("t.btlog", bytes_in(record.parts.at("log")));
  REQUIRE(log.value.has_value());
  if (record.parts.contains("marks")) {
    const auto found = read_marks(
        "t.btlog.marks", bytes_in(record.parts.at("marks")), *log.value);
    REQUIRE(!has_error(found));
  }
  const auto nodes =
      LoggedNodes::match(*log.value, *tree.value,
                         recorded_tree(*tree.value, TreeInput("t.xml", xml)));
  REQUIRE(nodes.value.has_value());
  const LogReading how;
  const LogMoments moments(*log.value, *nodes.value, how);
  const ExplainedLog asked{*log.value, *nodes.value, how, moments};
  Limits limits;
  limits.max_states = 200'000;
  const Suspects found =
      suspects_of({*tree.value, SourceText("t.xml", xml), TickSemantics::Root},
                  asked, causes_of(moments), limits);
  REQUIRE(!found.single.empty());
  const Suspect& first = found.single.front();
  CHECK(short_name(*tree.value, first.leaf) == record.leaf);
  CHECK(std::ranges::any_of(first.faults, [&](const InjectedFault& each) {
    return facts_of(each.fault.kind).word == record.fault;
  }));
}

}  // namespace

TEST_CASE("the fault of a log of BehaviorTree.CPP is named first") {
  for (const char* file : {"faults-4.10.0.txt", "faults-3.8.8.txt"}) {
    const auto records = records_in(
        file_text(std::string(BTCHECK_EXPLAIN_RECORDS) + "/" + file));
    CHECK(records.size() >= 10);
    for (const Record& record : records) look_at(record);
  }
}

}  // namespace btcheck::recorded_faults_test

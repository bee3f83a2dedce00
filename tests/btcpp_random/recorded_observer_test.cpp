// SPDX-License-Identifier: MIT
//
// Runs of BehaviorTree.CPP itself as a recorder has told them, and random rules
// about them: a monitor with the table of the rules, `btcheck trace` of a
// marked log with these events, and the definitions of the rules say the same,
// at the same events. script/compare-observer writes the records.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "btcpp_random/monitored.hpp"
#include "btcpp_random/naive_rules.hpp"
#include "btcpp_random/scripted_run.hpp"
#include "check/check.hpp"
#include "file_text.hpp"
#include "model/tree/answers.hpp"
#include "model/tree_file.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/monitor_table.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck::reference::recorded_observer_test {
namespace {

struct Record {
  std::string name;
  Profile profile{};
  std::map<std::string, std::string> parts;  // xml, leaves, ltl, events, naive
};

std::vector<Record> records_in(const std::string& text) {
  std::vector<Record> records;
  std::istringstream lines(text);
  std::string* part = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("=== ")) {
      const std::size_t blank = line.rfind(' ');
      const auto profile = profile_named(line.substr(blank + 1));
      REQUIRE(profile.has_value());
      records.push_back({line.substr(4, blank - 4), *profile, {}});
      part = nullptr;
    } else if (line.starts_with("--- ")) {
      part = &records.back().parts[line.substr(4)];
    } else if (part != nullptr) {
      *part += line + '\n';
    }
  }
  return records;
}

std::string lines_of(const std::vector<NaiveVerdict>& verdicts) {
  std::string lines;
  for (const NaiveVerdict& verdict : verdicts) lines += shown(verdict) + '\n';
  return lines;
}

LogStatus log_status(const std::string& word) {
  for (std::size_t s = 0; s < kLogStatusNames.size(); ++s) {
    std::string name(kLogStatusNames[s]);
    std::ranges::transform(name, name.begin(), [](unsigned char c) {
      return static_cast<char>(std::tolower(c));
    });
    if (name == word) return static_cast<LogStatus>(s);
  }
  FAIL("no status: " << word);
  return {};
}

std::string log_value(const KeptValue& value) {
  switch (value.kind) {
    case KeptValue::Kind::Unset:
      return "unset";
    case KeptValue::Kind::NoValue:
      return "no_value";
    case KeptValue::Kind::Text:
      return "'" + value.text + "'";
    case KeptValue::Kind::Other:
      return "of_another_type";
    default:
      return fmt::format("{}", value.number);
  }
}

LogMark mark_of(const EngineEvent& event, LogMarks& marks) {
  LogMark mark;
  if (event.what == "tick") mark.kind = MarkKind::TickBegins;
  if (event.what == "wake") mark.kind = MarkKind::TickIsWoken;
  if (event.what == "begin") mark.kind = MarkKind::NodeBegins;
  if (event.what == "change") mark.kind = MarkKind::Record;
  if (event.what == "answer") mark.kind = MarkKind::NodeAnswers;
  if (event.what == "end") mark.kind = MarkKind::TickEnds;
  const bool has_status = event.what == "answer" || event.what == "end";
  if (has_status) mark.status = log_status(event.after);
  mark.uid = static_cast<std::uint16_t>(event.number);
  if (event.what == "throw" || event.what == "entry") {
    const bool is_entry = event.what == "entry";
    mark.kind = is_entry ? MarkKind::Entry : MarkKind::TickIsLeft;
    mark.number = static_cast<std::uint32_t>(is_entry ? event.number
                                                      : marks.texts.size());
    mark.time = static_cast<std::int64_t>(is_entry ? marks.texts.size() : 0);
    marks.texts.push_back(is_entry ? log_value(event.value) : "");
  }
  return mark;
}

// As the observer would have written it. Uids are the numbers of nodes.
BehaviorLog log_of(const EngineRun& run) {
  BehaviorLog log;
  log.tree = run.nodes[0].name;
  for (std::size_t n = 1; n < run.nodes.size(); ++n) {
    const EngineNode& node = run.nodes[n];
    LogNode made;
    made.uid = static_cast<std::uint16_t>(n);
    made.name = node.name;
    made.type = node.type;
    if (node.parent != 0) {
      made.parent = static_cast<std::uint16_t>(node.parent);
      made.depth = log.nodes[node.parent - 1].depth + 1;
    }
    log.nodes.push_back(std::move(made));
  }
  LogMarks& marks = log.marks.emplace();
  marks.entries = run.entries;
  for (const EngineEvent& event : run.events) {
    marks.events.push_back(mark_of(event, marks));
    if (event.what != "change") continue;
    log.transitions.push_back({0, static_cast<std::uint16_t>(event.number),
                               log_status(event.before),
                               log_status(event.after)});
  }
  return log;
}

// Without the number of the event, which a log does not tell.
std::string without_events(const std::string& lines) {
  std::string kept;
  std::istringstream all(lines);
  for (std::string line; std::getline(all, line);) {
    kept += line.substr(0, line.find(" event ")) + '\n';
  }
  return kept;
}

std::string lines_of(const WatchReport& report) {
  std::string lines;
  for (const WatchedRule& rule : report.rules) {
    lines += rule.name + ' ' +
             std::string(kOutlookNames[static_cast<std::size_t>(rule.outlook)]);
    if (rule.outlook != Outlook::Open) {
      lines += fmt::format(" tick {} record {}", rule.tick.value_or(0),
                           rule.record.value_or(0));
    }
    lines += '\n';
  }
  return lines;
}

void compare(const Record& record) {
  CAPTURE(record.name);
  const EngineRun run = engine_run(record.parts.at("events"));
  const std::string& text = record.parts.at("ltl");
  const SourceText source("rules.ltl", text);
  const auto rules = read_properties("rules.ltl", text);
  REQUIRE(rules.value.has_value());
  const std::string& expected = record.parts.at("naive");
  CHECK(lines_of(naive_verdicts(run, *rules.value)) == expected);

  const std::string& xml = record.parts.at("xml");
  const auto tree =
      read_tree("t.xml", xml,
                scripted_reading(record.profile, record.parts.at("leaves")));
  REQUIRE(tree.value.has_value());
  const auto table = monitor_table(
      *tree.value, recorded_tree(*tree.value, TreeInput("t.xml", xml)),
      *rules.value, source);
  REQUIRE(table.value.has_value());
  CHECK(lines_of(monitored_verdicts(run, *table.value)) == expected);

  const auto watched =
      watch_log("t.btlog", log_of(run), {}, *rules.value, source);
  for (const Diagnostic& found : watched.diagnostics) {
    CAPTURE(found.message);
    CHECK(found.severity != Severity::Error);
  }
  REQUIRE(watched.value.has_value());
  CHECK(lines_of(*watched.value) == without_events(expected));
}

}  // namespace

TEST_CASE("a monitor and a marked log say of runs what definitions say") {
  for (const char* file : {"observer-4.10.0.txt", "observer-3.8.8.txt"}) {
    CAPTURE(file);
    const auto records =
        records_in(file_text(std::string(BTCHECK_BTCPP_RECORDS) + "/" + file));
    CHECK(records.size() >= 20);
    int decided = 0;
    for (const Record& record : records) {
      compare(record);
      const std::string& lines = record.parts.at("naive");
      for (std::size_t at = lines.find(" tick "); at != lines.npos;
           at = lines.find(" tick ", at + 1)) {
        decided += lines.compare(at, 8, " tick 0 ") != 0;
      }
    }
    CHECK(decided > 50);
  }
}

}  // namespace btcheck::reference::recorded_observer_test

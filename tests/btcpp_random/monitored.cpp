// SPDX-License-Identifier: MIT
#include "btcpp_random/monitored.hpp"

#include <stdexcept>

#include "btcheck/monitor.hpp"

namespace btcheck::reference {
namespace {

monitor::Status status_called(const std::string& word) {
  using monitor::Status;
  if (word == "idle") return Status::Idle;
  if (word == "running") return Status::Running;
  if (word == "success") return Status::Success;
  if (word == "failure") return Status::Failure;
  if (word == "skipped") return Status::Skipped;
  throw std::runtime_error("no status: " + word);
}

monitor::EntryValue as_told(const KeptValue& value) {
  using monitor::EntryValue;
  EntryValue told;
  told.kind = static_cast<EntryValue::Kind>(value.kind);
  told.integer = static_cast<std::int64_t>(value.number);
  told.real = value.number;
  told.text = value.text;
  return told;
}

void tell(monitor::Monitor& monitor, const EngineEvent& event) {
  if (event.what == "tick" || event.what == "wake") {
    monitor.begin_tick();
  } else if (event.what == "end") {
    monitor.end_tick();
  } else if (event.what == "throw") {
    monitor.leave_tick();
  } else if (event.what == "begin") {
    monitor.begin_node(event.number);
  } else if (event.what == "answer") {
    monitor.answer(event.number, status_called(event.after));
  } else if (event.what == "change") {
    monitor.change(event.number, status_called(event.before),
                   status_called(event.after));
  }
}

}  // namespace

std::vector<NaiveVerdict> monitored_verdicts(const EngineRun& run,
                                             std::string_view text) {
  const monitor::Table table = monitor::Table::read(text);
  std::vector<monitor::RunningNode> nodes;
  for (std::size_t n = 1; n < run.nodes.size(); ++n) {
    const EngineNode& node = run.nodes[n];
    nodes.push_back({node.parent, node.name, node.type});
  }
  table.require(nodes);
  monitor::Monitor watched(table, monitor::Knowledge::Exact);
  std::vector<NaiveVerdict> verdicts;
  for (std::size_t r = 0; r < watched.rule_count(); ++r) {
    verdicts.push_back({table.automata[r].name, {}, 0, 0, 0});
    verdicts[r].verdict = monitor::verdict_name(watched.verdict(r));
  }
  std::size_t events = 0;
  std::size_t records = 0;
  watched.on_verdict = [&](std::size_t rule, monitor::Verdict verdict) {
    verdicts[rule].verdict = monitor::verdict_name(verdict);
    verdicts[rule].tick = static_cast<int>(watched.ticks());
    if (watched.ticks() == 0) return;  // told once more in the first
    verdicts[rule].events = events;
    verdicts[rule].records = records;
  };
  for (const EngineEvent& event : run.events) {
    ++events;
    if (event.what == "change") ++records;
    if (event.what != "entry") {
      tell(watched, event);
      continue;
    }
    for (std::size_t e = 0; e < table.entries.size(); ++e) {
      if (table.entries[e].name != run.entries[event.number]) continue;
      watched.set_entry(e, as_told(event.value));
    }
  }
  return verdicts;
}

}  // namespace btcheck::reference

// SPDX-License-Identifier: MIT
#include "check/whatif/cut_sets.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {
namespace {

// Where the mission can fail anyhow, that it cannot succeed is told instead.
std::vector<TopEvent> events_of(const WhatIf& result) {
  using Kind = TopEvent::Kind;
  const Effect& healthy = result.healthy;
  std::vector<TopEvent> events;
  if (!healthy.fails) {
    events.push_back({Kind::Fails});
  } else if (healthy.succeeds) {
    events.push_back({Kind::CannotSucceed});
  }
  if (!healthy.hangs) events.push_back({Kind::NeverEnds});
  if (!healthy.throws) events.push_back({Kind::Throws});
  for (std::size_t file = 0; file < result.rules.size(); ++file) {
    for (std::size_t i = 0; i < result.rules[file].properties.size(); ++i) {
      events.push_back({Kind::Rule, {file, i}});
    }
  }
  return events;
}

bool is_whole(const FaultRow& row) {
  return row.effect.stopped == StopReason::None;
}

}  // namespace

bool happens(const TopEvent& event, const Effect& effect) {
  if (!effect.strikes) return false;
  switch (event.kind) {
    case TopEvent::Kind::Fails:
      return effect.fails;
    case TopEvent::Kind::CannotSucceed:
      return !effect.succeeds && effect.stopped == StopReason::None;
    case TopEvent::Kind::NeverEnds:
      return effect.hangs;
    case TopEvent::Kind::Throws:
      return effect.throws;
    case TopEvent::Kind::Rule:
      return std::ranges::find(effect.broken, event.rule) !=
             effect.broken.end();
  }
  return false;
}

void add_pairs(WhatIf& result, const RowsOf& rows_of) {
  const std::vector<TopEvent> events = events_of(result);
  const std::vector<FaultRow>& rows = result.rows;
  std::vector<std::vector<InjectedFault>> pairs;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      const InjectedFault& one = rows[i].faults[0];
      const InjectedFault& other = rows[j].faults[0];
      if (one.leaf == other.leaf) continue;
      ++result.pairs_in_all;
      const auto asks = [](const FaultRow& row, NodeId leaf) {
        return !is_whole(row) || (!row.asked.empty() && row.asked[index(leaf)]);
      };
      if (!asks(rows[i], other.leaf) && !asks(rows[j], one.leaf)) continue;
      const bool is_open = std::ranges::any_of(events, [&](const auto& event) {
        return !happens(event, rows[i].effect) &&
               !happens(event, rows[j].effect);
      });
      if (is_open) pairs.push_back({one, other});
    }
  }
  result.pairs_searched = pairs.size();
  std::vector<FaultRow> found = rows_of(pairs);
  const auto row_of = [&](const InjectedFault& fault) -> const FaultRow& {
    return *std::ranges::find_if(
        rows, [&](const FaultRow& row) { return row.faults[0] == fault; });
  };
  for (FaultRow& pair : found) {
    const Effect& one = row_of(pair.faults[0]).effect;
    const Effect& other = row_of(pair.faults[1]).effect;
    const bool is_new = std::ranges::any_of(events, [&](const auto& event) {
      return happens(event, pair.effect) && !happens(event, one) &&
             !happens(event, other);
    });
    if (is_new || !is_whole(pair)) result.pairs.push_back(std::move(pair));
  }
}

void add_cut_sets(WhatIf& result) {
  for (const TopEvent& event : events_of(result)) {
    CutSets cut{event, {}};
    for (const FaultRow& row : result.rows) {
      if (happens(event, row.effect)) cut.sets.push_back(row.faults);
    }
    const auto is_there = [&](const InjectedFault& fault) {
      return std::ranges::find(cut.sets, std::vector{fault}) != cut.sets.end();
    };
    for (const FaultRow& pair : result.pairs) {
      if (happens(event, pair.effect) &&
          std::ranges::none_of(pair.faults, is_there)) {
        cut.sets.push_back(pair.faults);
      }
    }
    result.cut_sets.push_back(std::move(cut));
  }
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "groot2/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "check/bind/node_names.hpp"
#include "ltl/rules/property.hpp"
#include "text/numbers.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/watch/recorded_network.hpp"

namespace btcheck::groot2 {
namespace {

constexpr std::string_view kForm =
    "write `NODE fails`, `NODE succeeds always` or `NODE fails from tick 3`";

ReadFault refused(std::string why) { return {std::nullopt, std::move(why)}; }

// Words between blanks; a name in double quotes is one of them.
std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  bool is_open = false;
  bool is_quoted = false;
  for (const char c : text) {
    if (c == '"') {
      is_quoted = !is_quoted;
      if (is_quoted && !std::exchange(is_open, true)) words.emplace_back();
    } else if ((c == ' ' || c == '\t') && !is_quoted) {
      is_open = false;
    } else {
      if (!std::exchange(is_open, true)) words.emplace_back();
      words.back() += c;
    }
  }
  return words;
}

// Takes "from tick N" off the end; nothing where N is none.
std::optional<std::int64_t> from_tick(std::vector<std::string>& words) {
  const std::size_t count = words.size();
  if (count < 3 || words[count - 3] != "from" || words[count - 2] != "tick") {
    return 1;
  }
  const auto tick = as_number<std::int32_t>(words.back());
  if (!tick || *tick < 1) return std::nullopt;
  words.resize(count - 3);
  return *tick;
}

}  // namespace

ReadFault fault_in(std::string_view text) {
  Fault fault;
  fault.text = text;
  std::vector<std::string> words = words_in(text);
  const auto tick = from_tick(words);
  if (!tick) return refused("ticks are counted from 1");
  fault.from_tick = *tick;
  if (words.size() == 3 && (words[2] == "once" || words[2] == "always")) {
    fault.is_once = words[2] == "once";
    words.pop_back();
  }
  if (words.size() != 2 || words[0].empty() ||
      (words[1] != "succeeds" && words[1] != "fails")) {
    return refused(std::string(kForm));
  }
  fault.node = words[0];
  fault.answer =
      words[1] == "succeeds" ? LogStatus::Success : LogStatus::Failure;
  return {fault, ""};
}

ReadFault break_in(std::string_view text) {
  Fault fault;
  fault.text = text;
  fault.is_break = true;
  fault.is_once = false;
  std::vector<std::string> words = words_in(text);
  const auto tick = from_tick(words);
  if (!tick) return refused("ticks are counted from 1");
  fault.from_tick = *tick;
  if (words.size() != 1 || words[0].empty()) {
    return refused("write `NODE` or `NODE from tick 3`");
  }
  fault.node = words[0];
  return {fault, ""};
}

Result<std::vector<Hook>> hooks_of(const std::vector<Fault>& faults,
                                   const BehaviorLog& log,
                                   const std::string& robot) {
  Result<std::vector<Hook>> result{std::vector<Hook>(), {}};
  const PropertyFile no_rules;
  const RecordedRun heading = LogPlayer(log, LogReading{}).heading();
  const RecordedNetwork network(heading, no_rules);
  const NodeNames names(network.tree());
  const auto refuse = [&](std::string_view code, std::string message,
                          std::string help) {
    result.diagnostics.push_back(
        file_error(code, robot, std::move(message), std::move(help)));
    result.value.reset();
  };
  std::vector<Hook> hooks;
  for (const Fault& fault : faults) {
    const std::vector<NodeId> found = names.called(fault.node);
    const auto place = found.empty() ? 0 : index(found.front());
    if (found.empty() || place == 0) {
      refuse("BT1906", fmt::format("unknown node `{}`", fault.node),
             names.nearest_help(fault.node));
    } else if (found.size() > 1) {
      refuse("BT1906",
             fmt::format("`{}` names {} nodes", fault.node, found.size()),
             "write one of " + names.references_to(found));
    } else {
      const std::uint16_t uid = log.nodes[place - 1].uid;
      if (std::ranges::find(hooks, uid, &Hook::uid) != hooks.end()) {
        refuse("BT1907", fmt::format("`{}` is named twice", fault.node),
               "a publisher keeps one hook for each node");
        continue;
      }
      hooks.push_back({uid, fault.is_break, fault.is_once, fault.answer});
    }
  }
  if (result.value) result.value = std::move(hooks);
  return result;
}

}  // namespace btcheck::groot2

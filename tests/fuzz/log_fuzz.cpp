// SPDX-License-Identifier: MIT
//
// Any bytes as a log of BehaviorTree.CPP or a recording of ROS 2: a log that
// hangs together or an error, and text that no terminal obeys.
#include <cstddef>
#include <string>
#include <string_view>

#include "fuzzed.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/log_run.hpp"

namespace btcheck {
namespace {

void check_log(const BehaviorLog& log) {
  require(!log.nodes.empty());
  for (std::size_t i = 0; i < log.nodes.size(); ++i) {
    const LogNode& node = log.nodes[i];
    require(i == 0 || log.nodes[i - 1].uid < node.uid);
    require(node.parent.has_value() == (node.depth > 0));
    if (!node.parent) continue;
    const LogNode* parent = log.find(*node.parent);
    require(parent != nullptr && parent->depth + 1 == node.depth);
  }
  for (const LogTransition& transition : log.transitions) {
    require(log.find(transition.uid) != nullptr);
    require(transition.after <= LogStatus::Skipped);
  }
  // As a run: every record is told, and time never goes back.
  LogPlayer player(log, {.tick_time = 1'000'000'000});
  int time = 0;
  std::size_t states = 0;
  player.play([&] {
    require(player.state().time >= time);
    require(player.state().phases.size() == log.nodes.size() + 1);
    time = player.state().time;
    return ++states < 10'000;
  });
  const std::string text = log_text(log);
  require(text.ends_with('\n'));
  for (const char c : text) {
    require(static_cast<unsigned char>(c) >= 0x20 || c == '\n');
  }
}

}  // namespace

void check_bytes(std::string_view bytes) {
  for (const char* name : {"fuzz.btlog", "fuzz.fbl", "fuzz.mcap", "fuzz.db3"}) {
    const auto result = read_log(name, bytes);
    require_sound(result);
    require(result.diagnostics.size() <= 1);
    if (result.value) check_log(*result.value);
  }
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Any bytes as a log of BehaviorTree.CPP: a log that hangs together or an
// error, and text that no terminal obeys.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "trace/logs/behavior_log.hpp"

namespace {

using btcheck::BehaviorLog;
using btcheck::LogNode;
using btcheck::LogTransition;

void require(bool condition) {
  if (!condition) std::abort();
}

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
    require(transition.after <= btcheck::LogStatus::Skipped);
  }
  const std::string text = btcheck::log_text(log);
  require(text.ends_with('\n'));
  for (const char c : text) {
    require(static_cast<unsigned char>(c) >= 0x20 || c == '\n');
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"fuzz.btlog", "fuzz.fbl"}) {
    const auto result = btcheck::read_log(name, bytes);
    require(btcheck::has_error(result.diagnostics) != result.value.has_value());
    require(result.diagnostics.size() <= 1);
    for (const auto& diagnostic : result.diagnostics) {
      require(!btcheck::render(diagnostic).empty());
    }
    if (result.value) check_log(*result.value);
  }
  return 0;
}

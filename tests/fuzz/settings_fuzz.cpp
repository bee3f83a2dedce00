// SPDX-License-Identifier: MIT
//
// Any bytes as a btcheck.toml and as a baseline: settings or errors, never
// both, never a crash; what is wrong has a place and can be shown.
#include <string_view>

#include "cli/settings/baseline.hpp"
#include "cli/settings/choices.hpp"
#include "fuzzed.hpp"

namespace btcheck {
namespace {

template <class Value>
void check_result(const Result<Value>& read) {
  require_sound(read);
  for (const Diagnostic& found : read.diagnostics) {
    require(found.code.starts_with("BT"));
    require(found.span.line >= 0 && found.span.length >= 1);
  }
}

}  // namespace

void check_bytes(std::string_view text) {
  const auto settings = read_settings("/w", "a/btcheck.toml", text);
  check_result(settings);
  if (settings.value) {
    const Options options = settled({}, *settings.value, "t.xml");
    require(options.tick_ms >= 1);
    require(!options.profile || is_engine(*options.profile));
  }
  const auto known = read_baseline("/w", "b.json", text);
  check_result(known);
  if (!known.value) return;
  const auto again = read_baseline("/w", "b.json",
                                   baseline_text("/w", "b.json", *known.value));
  require(again.value && again.value->size() == known.value->size());
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Any bytes as a btcheck.toml and as a baseline: settings or errors, never
// both, never a crash; what is wrong has a place and can be shown.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "cli/settings/baseline.hpp"
#include "cli/settings/settings.hpp"

namespace btcheck {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

template <class Value>
void check_result(const Result<Value>& read) {
  require(read.value.has_value() != has_error(read.diagnostics));
  for (const Diagnostic& found : read.diagnostics) {
    require(found.code.starts_with("BT"));
    require(found.span.line >= 0 && found.span.length >= 1);
    require(!render(found).empty());
  }
}

void check_text(std::string_view text) {
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

}  // namespace
}  // namespace btcheck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  btcheck::check_text(text);
  return 0;
}

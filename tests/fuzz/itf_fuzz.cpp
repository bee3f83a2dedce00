// SPDX-License-Identifier: MIT
//
// Any bytes as a run in ITF: a run that every format can be made from and that
// is read back as it is, or an error.
#include <cstddef>
#include <string_view>

#include "fuzzed.hpp"
#include "trace/formats/recordings.hpp"
#include "trace/formats/text.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/itf.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck {
namespace {

void check_formats(const RecordedRun& run) {
  const auto again = read_itf("again", itf_text(run));
  require(again.value && *again.value == run);
  require(!html_text(run).empty());
  require(!svg_strip(run).empty());
  require(!chrome_text(run, ChromeForm::Tracks).empty());
  require(!chrome_text(run, ChromeForm::Stack).empty());
  require(!mcap_bytes(run).empty());
  require(!substitution_text(run).empty());
  const std::size_t last = run.states.size() - 1;
  require(!svg_text(run, last).empty());
  require(!dot_text(run, last).empty());
  require(!mermaid_text(run, last).empty());
  run_text(run, {});
  const auto log = read_log("x.btlog", btlog_bytes(run));
  require(log.value.has_value());
}

}  // namespace

void check_bytes(std::string_view bytes) {
  const auto result = read_itf("fuzz.itf.json", bytes);
  require_sound(result);
  if (result.value) check_formats(*result.value);
}

}  // namespace btcheck

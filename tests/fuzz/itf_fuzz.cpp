// SPDX-License-Identifier: MIT
//
// Any bytes as a run in ITF: a run that every format can be made from and that
// is read back as it is, or an error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "trace/formats/recordings.hpp"
#include "trace/formats/text.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/itf.hpp"
#include "trace/viewer/html.hpp"

namespace {

using btcheck::RecordedRun;

void require(bool condition) {
  if (!condition) std::abort();
}

void check_formats(const RecordedRun& run) {
  const auto again = btcheck::read_itf("again", btcheck::itf_text(run));
  require(again.value && *again.value == run);
  require(!btcheck::html_text(run).empty());
  require(!btcheck::svg_strip(run).empty());
  require(!btcheck::chrome_text(run, btcheck::ChromeForm::Tracks).empty());
  require(!btcheck::chrome_text(run, btcheck::ChromeForm::Stack).empty());
  require(!btcheck::mcap_bytes(run).empty());
  require(!btcheck::substitution_text(run).empty());
  const std::size_t last = run.states.size() - 1;
  require(!btcheck::svg_text(run, last).empty());
  require(!btcheck::dot_text(run, last).empty());
  require(!btcheck::mermaid_text(run, last).empty());
  btcheck::run_text(run, {});
  const auto log = btcheck::read_log("x.btlog", btcheck::btlog_bytes(run));
  require(log.value.has_value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto result = btcheck::read_itf("fuzz.itf.json", bytes);
  require(btcheck::has_error(result.diagnostics) != result.value.has_value());
  for (const auto& diagnostic : result.diagnostics) {
    require(!btcheck::render(diagnostic).empty());
  }
  if (result.value) check_formats(*result.value);
  return 0;
}

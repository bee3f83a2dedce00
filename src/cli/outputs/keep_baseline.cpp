// SPDX-License-Identifier: MIT
#include "cli/outputs/keep_baseline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/settings/baseline.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

void tell_gone(const Options& options, std::size_t gone) {
  if (gone == 0) return;
  Diagnostic note = file_error(
      "BT1512", options.baseline,
      fmt::format("{} of the baseline {} no more",
                  counted(gone, "entry", "entries"),
                  gone == 1 ? "occurs" : "occur"),
      fmt::format("--baseline {0} --write-baseline {0} writes it anew",
                  options.baseline));
  note.severity = Severity::Note;
  show(options, {note});
}

}  // namespace

ExitCode keep_baseline(const Options& options,
                       const std::vector<const Judged*>& trees) {
  const bool is_checked = std::ranges::any_of(
      trees, [](const Judged* tree) { return !tree->files.empty(); });
  if (!is_checked) return ExitCode::Met;
  const BaselineChange change = change_of(options.judgement, trees);
  if (options.new_baseline.empty()) {
    tell_gone(options, change.gone);
    return ExitCode::Met;
  }
  return write_output(options.new_baseline,
                      baseline_text(options.judgement.directory,
                                    options.new_baseline, change.now));
}

}  // namespace btcheck

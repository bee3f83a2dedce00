// SPDX-License-Identifier: MIT
//
// `btcheck trace LOG --view`: a log shown while it is written.
#include "cli/view.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <thread>
#include <tuple>

#include "cli/console/console.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/open_view.hpp"
#include "cli/recordings.hpp"
#include "trace/live/live_log.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {
namespace {

using Clock = std::chrono::steady_clock;

// Between two looks at the log, where reading it does not take longer.
constexpr std::chrono::milliseconds kLook{100};
// A log that cannot be read may be one that is just begun anew.
constexpr std::chrono::milliseconds kPatience{2000};

// What changes when a file is written to.
auto stamp_of(const std::string& name) {
  struct stat found {};
  ::stat(name.c_str(), &found);
  struct stat marks {};
  ::stat((name + std::string(kMarksEnding)).c_str(), &marks);
  return std::tuple(found.st_ino, found.st_size, found.st_mtim.tv_sec,
                    found.st_mtim.tv_nsec, marks.st_ino, marks.st_size,
                    marks.st_mtim.tv_sec, marks.st_mtim.tv_nsec);
}

std::vector<Diagnostic> reread(const InputFile& file, LiveLog& log) {
  const auto marks = marks_beside(file.name, file.text);
  if (marks && !marks->value) return marks->diagnostics;
  return log.take(file.text, marks ? &marks->value->text.text() : nullptr);
}

std::vector<Diagnostic> reread(const std::string& name, LiveLog& log) {
  const auto file = read_file(name);
  return file.value ? reread(*file.value, log) : file.diagnostics;
}

// Until it is interrupted; or until the log is beyond reading, which is
// returned.
std::vector<Diagnostic> follow(const std::string& name, LiveLog& log) {
  auto stamp = stamp_of(name);
  std::vector<Diagnostic> flaws;
  Clock::time_point good = Clock::now();
  Clock::duration rest = kLook;
  while (!InterruptWatch::is_interrupted()) {
    std::this_thread::sleep_for(std::min<Clock::duration>(rest, kPatience));
    const auto now = stamp_of(name);
    if (now != stamp || !flaws.empty()) {
      const Clock::time_point begin = Clock::now();
      stamp = now;
      flaws = reread(name, log);
      rest = std::max<Clock::duration>(kLook, 4 * (Clock::now() - begin));
    }
    if (flaws.empty()) good = Clock::now();
    if (Clock::now() - good >= kPatience) return flaws;
  }
  return {};
}

}  // namespace

ExitCode view_log(const Options& options, const InputFile& file) {
  if (!is_log(file.name, file.text)) {
    show(options, {file_error("BT1307", file.name,
                              "a run that was kept does not grow any more",
                              "write --to html, and open that page")});
    return ExitCode::BadInput;
  }
  auto rules = live_rules(options, file.name);
  if (!rules) return ExitCode::BadInput;
  LiveLog log(file.name, reading_of(options), options.topic, std::move(*rules));
  std::vector<Diagnostic> flaws = reread(file, log);
  if (!flaws.empty()) {
    show(options, flaws);
    return ExitCode::BadInput;
  }
  Guard::dismiss();
  const BudgetScope own_way(nullptr);
  LiveServer server(log.run());
  if (!open_view(options, server)) return ExitCode::BadInput;
  flaws = follow(file.name, log);
  log.end(flaws.empty() ? "btcheck follows the log no longer"
                        : "the log cannot be read any further");
  server.finish(kViewPatience);
  show(options, flaws);
  if (!flaws.empty()) return ExitCode::BadInput;
  print(log.verdicts_text());
  return log.is_broken() ? ExitCode::Missed : ExitCode::Met;
}

}  // namespace btcheck

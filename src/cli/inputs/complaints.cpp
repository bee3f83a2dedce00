// SPDX-License-Identifier: MIT
#include "cli/inputs/complaints.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "cli/inputs/files.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostDiagnostics = 20;

bool wants_color(const Options& options, int descriptor) {
  if (options.color != When::Auto) return options.color == When::Always;
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') &&
         ::isatty(descriptor) != 0;
}

// Warnings and notes that say the same become one, which names the other lines.
std::vector<Diagnostic> without_repetitions(
    const std::vector<Diagnostic>& diagnostics) {
  std::vector<Diagnostic> distinct;
  for (const Diagnostic& diagnostic : diagnostics) {
    auto same = std::find_if(distinct.begin(), distinct.end(),
                             [&](const Diagnostic& known) {
                               return known.severity != Severity::Error &&
                                      known.code == diagnostic.code &&
                                      known.file == diagnostic.file &&
                                      known.message == diagnostic.message;
                             });
    if (same == distinct.end()) {
      distinct.push_back(diagnostic);
    } else {
      same->label += fmt::format(
          "{}line {}",
          same->label.find("line ") == std::string::npos ? "; also on " : ", ",
          diagnostic.span.line);
    }
  }
  return distinct;
}

}  // namespace

std::string shown(const Options& options,
                  const std::vector<Diagnostic>& diagnostics, int descriptor) {
  const Color color =
      wants_color(options, descriptor) ? Color::Always : Color::Never;
  std::string text;
  for (const Severity severity :
       {Severity::Error, Severity::Warning, Severity::Note}) {
    std::size_t count = 0;
    for (const Diagnostic& diagnostic : without_repetitions(diagnostics)) {
      if (diagnostic.severity != severity) continue;
      if (count++ < kMostDiagnostics) text += render(diagnostic, color) + '\n';
    }
    if (count > kMostDiagnostics) {
      text += fmt::format("and {} more\n\n", count - kMostDiagnostics);
    }
  }
  return text;
}

void show(const Options& options, const std::vector<Diagnostic>& diagnostics) {
  fmt::print(stderr, "{}", shown(options, diagnostics, STDERR_FILENO));
}

void complain(std::string_view code, std::string_view message) {
  fmt::print(stderr, "error[{}]: {}\n", code, message);
}

ExitCode write_output(const std::string& file, const std::string& text) {
  if (file.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return ExitCode::Met;
  }
  const std::string complaint = write_file(file, text);
  if (!complaint.empty()) complain("BT0004", complaint);
  return complaint.empty() ? ExitCode::Met : ExitCode::BadInput;
}

}  // namespace btcheck

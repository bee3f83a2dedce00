// SPDX-License-Identifier: MIT
//
// Any bytes as a manifest: entries or errors, never both for the file as a
// whole, never a crash; what is wrong has a place and can be shown.
#include <cmath>
#include <string_view>

#include "batch/entries/manifest.hpp"
#include "fuzzed.hpp"

namespace btcheck {
namespace {

void check_diagnostic(const Diagnostic& found) {
  require(found.code.starts_with("BT"));
  require(!found.message.empty());
  require(found.span.line >= 0 && found.span.length >= 1);
  require(!render(found).empty());
}

void check_choices(const OptionChoices& choices) {
  Options before;
  before.max_bytes = 1;
  const Options options = applied(before, choices);
  require(options.threads >= 1 && options.threads <= kMostThreads);
  require(options.max_states >= 1 && options.max_bytes >= 1);
  require(std::isfinite(options.timeout) && options.timeout >= 0);
}

void check_entry(const ManifestEntry& entry) {
  check_choices(entry.choices);
  for (const Diagnostic& found : entry.diagnostics) check_diagnostic(found);
  if (has_error(entry.diagnostics)) return;
  const bool has_folder = !entry.folder.empty();
  require(has_folder != (!entry.tree.empty() || !entry.properties.empty()));
  require(!has_folder || entry.name.empty());
  require(has_folder || entry.exclude.empty());
  require(entry.expected.empty() || !entry.properties.empty());
  for (const ExpectedVerdict& expected : entry.expected) {
    require(expected.expectation != Expectation::None);
    require(expected.place.span.line >= 1);
  }
}

}  // namespace

void check_bytes(std::string_view text) {
  const Manifest manifest = read_manifest("fuzz.toml", text);
  require(has_error(manifest.diagnostics) == manifest.entries.empty());
  for (const Diagnostic& found : manifest.diagnostics) check_diagnostic(found);
  for (const ManifestEntry& entry : manifest.entries) check_entry(entry);
}

}  // namespace btcheck

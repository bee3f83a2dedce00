// SPDX-License-Identifier: MIT
//
// What the rooms above share of the command line, without all its options:
// formats of reports, and values that are more than a word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/exit_code.hpp"
#include "text/version.hpp"

namespace btcheck {

// In the order of --format in tables.cpp.
enum class ReportFormat : std::uint8_t {
  Text,
  Json,
  JsonLines,
  Sarif,
  JUnit,
  GitHub,
  GitLab
};

struct ReportTarget {
  ReportFormat format = ReportFormat::Text;
  std::string file;  // "" for standard output
};

// The whole text as a decimal number; nothing where it is no such number, or
// does not fit.
std::optional<std::uint64_t> whole_number(std::string_view text);

// The part of a batch that one machine does: every `count`th entry, beginning
// with number `index`, counted from 1.
struct Shard {
  unsigned index = 1;
  unsigned count = 1;

  bool has(std::size_t entry) const { return entry % count + 1 == index; }
};

// "2/3"; nothing for any other text.
std::optional<Shard> shard_of(std::string_view text);

struct BatchOptions {
  std::vector<std::string> sources;  // folders and manifests
  unsigned jobs = 1;                 // entries checked at a time
  Shard shard;
  bool stops_early = false;  // --fail-fast
  bool resumes = false;      // --resume
  std::string shared;        // the folder of --results or --join; "" for none
  bool joins = false;        // --join: nothing is checked
  bool waits = true;         // no --no-wait
  double patience = 60;      // --lease, in seconds
  std::string page;          // --report; "" for none
};

}  // namespace btcheck

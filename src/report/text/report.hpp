// SPDX-License-Identifier: MIT
//
// Results as the text a person reads.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "check/check.hpp"
#include "cli/options/interface.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

// What was checked, and how: one line.
std::string heading_text(const CheckResult& result, const CheckedFile& file);

// A verdict for each property, with the runs that have to be seen: those of
// verdicts that nobody expected, and all of them where every step is told. A
// line of sums at the end.
std::string verdicts_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail);

// The default report: the mission as a whole, the table of its nodes, and what
// is worth a look.
std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail);

// HOLDS, VIOLATED, UNDECIDED.
std::string_view verdict_word(Verdict verdict);

// How a verdict came about: what stands behind the property's name.
std::string note_of(const CheckedFile& file, const PropertyVerdict& verdict);

// What is said of a verdict's run besides its steps.
struct RunRemarks {
  std::string reason;                // why it goes as it does; "" where unknown
  std::optional<std::size_t> state;  // the one that `words` are said of
  std::string words;
  std::string end;  // what the last state shows; "" for nothing
};
RunRemarks remarks_on(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict);

// The rule, why it is broken, and the run. The verdict must have a run.
std::string told_text(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict, Detail detail);

// What ended a search early, and what may help.
std::string stop_text(StopReason reason, const SearchProgress& progress);

// The same, with what is not known of entries, if anything.
std::string with_open(std::string text, const std::string& open);

// The same in a word for programs: "max-states"; "" for none.
std::string_view stop_word(StopReason reason);

// The exit code that one file's results ask for.
ExitCode exit_code_of(const CheckedFile& file);
// The one that counts: 4 before 2, 1, 3, 0.
ExitCode worst_of(ExitCode one, ExitCode other);

// "328,443".
std::string grouped(std::uint64_t number);

}  // namespace btcheck

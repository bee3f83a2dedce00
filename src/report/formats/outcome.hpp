// SPDX-License-Identifier: MIT
//
// What came of each tree of a report, in a word and in numbers: what the table
// of a batch, its page and the summary of a job have in common.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/formats/reported.hpp"

namespace btcheck {

enum class TreeOutcome : std::uint8_t {
  Met,        // every property is as expected
  Missed,     // some is not, or the default report found a fault
  Broken,     // an input is wrong: nothing was checked
  Undecided,  // a limit was reached
  Failed,     // our mistake
  NotRun      // a batch that ended before it was its turn
};
inline constexpr std::size_t kOutcomeCount = 6;

// MET, MISSED, BROKEN, UNDECIDED, FAILED, NOT RUN.
std::string_view word_of(TreeOutcome outcome);

TreeOutcome outcome_of(const ReportedTree& tree);

// The properties of a tree, or the questions of its default report; of those
// one is violated if its answer is a fault, and else it holds.
struct PropertyCounts {
  std::size_t all = 0;
  std::size_t holds = 0;
  std::size_t violated = 0;
  std::size_t undecided = 0;
  std::size_t missed = 0;  // not as expected
};
PropertyCounts properties_of(const ReportedTree& tree);

// How many trees came to what.
using OutcomeCounts = std::array<std::size_t, kOutcomeCount>;
OutcomeCounts outcomes_of(const Report& report);

// The word for an answer of the default report: FINE, FAULT, UNDECIDED.
std::string_view word_of(const ReportedAnswer& answer);

// "200 entries: 190 met, 10 broken".
std::string sum_of(const Report& report);

// Something about a tree that keeps it from being met.
struct Shortfall {
  std::string word;  // "VIOLATED", "FAULT", "UNDECIDED", "error[BT1003]"
  std::string name;  // of the property; "" for what is wrong with an input
  std::string text;  // how it came about, or what is wrong
  std::string title;
  std::string told;  // the run as text; "" for none
  std::string page;  // the file in which a browser shows it; "" for none
};
std::vector<Shortfall> shortfalls_of(const ReportedTree& tree);

}  // namespace btcheck

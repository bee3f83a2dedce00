// SPDX-License-Identifier: MIT
//
// The result of each tree of a report, in a word and in numbers: for the table
// of a batch, its page and the summary of a job.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/formats/reported.hpp"

namespace btcheck {

// The first five are those of ExitCode, in its order.
enum class TreeOutcome : std::uint8_t {
  Met,        // every property is as expected
  Missed,     // some is not, or the default report found a fault
  Broken,     // an input is wrong: nothing was checked
  Undecided,  // a limit was reached
  Failed,     // an internal error of btcheck
  NotRun      // the batch ended before its turn
};
inline constexpr std::size_t kOutcomeCount = 6;

// MET, MISSED, BROKEN, UNDECIDED, FAILED, NOT RUN.
std::string_view word_of(TreeOutcome outcome);

TreeOutcome outcome_of(const ReportedTree& tree);

// The properties of a tree, or the questions of its default report: a question
// counts as violated if its answer is a fault, else as one that holds.
struct PropertyCounts {
  std::size_t all = 0;
  std::size_t holds = 0;
  std::size_t violated = 0;
  std::size_t undecided = 0;
  std::size_t missed = 0;  // not as expected
};
PropertyCounts properties_of(const ReportedTree& tree);

// How many trees have each outcome.
using OutcomeCounts = std::array<std::size_t, kOutcomeCount>;
OutcomeCounts outcomes_of(const Report& report);

// The word for an answer of the default report: FINE, FAULT, UNDECIDED.
std::string_view word_of(const ReportedAnswer& answer);

// "200 entries: 190 met, 10 broken".
std::string sum_of(const Report& report);

// Why a tree is not met: one reason.
struct Shortfall {
  std::string word = {};  // "VIOLATED", "FAULT", "UNDECIDED", "error[BT1003]"
  std::string name = {};  // of the property; "" for a mistake in an input
  std::string text = {};  // how it came about, or what is wrong
  std::string title = {};
  std::string told = {};  // the run as text; "" for none
  std::string page = {};  // the file in which a browser shows it; "" for none
};
std::vector<Shortfall> shortfalls_of(const ReportedTree& tree);

}  // namespace btcheck

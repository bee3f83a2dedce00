// SPDX-License-Identifier: MIT
//
// The results of a check as the text a person reads, and its exit code.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "report/exit_code.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/record.hpp"

namespace btcheck {

// What was checked, and how: one line.
std::string heading_text(const CheckResult& result, const CheckedFile& file);

// A verdict for each property and, at the end, a line of totals. A run is shown
// where the verdict was not expected; with Detail::EveryStep, every run.
std::string verdicts_text(const CheckResult& result, const CheckedFile& file,
                          Layout layout);

// HOLDS, VIOLATED, UNDECIDED.
std::string_view verdict_word(Verdict verdict);

// How a verdict came about, shown behind the property's name: "after 2 ticks".
std::string note_of(const CheckedFile& file, const PropertyVerdict& verdict);
// The rule that may have been meant: "did you mean: in no tick: …", or "".
std::string advice_text(const CheckedFile& file,
                        const PropertyVerdict& verdict);

// What is known of the verdict for other numbers of rounds, by node; empty
// where that was not asked.
CountClaims claims_of(const CheckedFile& file, const PropertyVerdict& verdict);

// What is said of a verdict's run besides its steps, the texts of its tree left
// out. The verdict must have a run.
RunHeading heading_of(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict);

// The rule, why it is broken, and the run. The verdict must have a run.
std::string told_text(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict, Layout layout);

// Why a search ended early, and what may help. `open` is what is not known of
// blackboard entries, "" for nothing.
std::string stop_text(StopReason reason, const SearchProgress& progress,
                      const std::string& open = {});

// The reason as one word for programs: "max-states"; "" for none.
std::string_view stop_word(StopReason reason);

// The limit that was reached, if there was one.
StopReason stopped_by(const CheckedFile& file);

// The exit code for the results of one file, and of all: BadInput for none.
ExitCode exit_code_of(const CheckedFile& file);
ExitCode exit_code_of(const CheckResult& result);
// That of `lint`: Missed where there is more than notes.
ExitCode lint_code_of(const CheckResult& result);
// The more serious of two: 4 before 2, 1, 3, 0.
ExitCode worst_of(ExitCode one, ExitCode other);

// "Sequence land"; the name alone where it begins with the type: "Sequence17".
std::string typed_name(const Node& node);

// "328,443".
std::string grouped(std::uint64_t number);
// "1 entry", "2000 entries".
std::string counted(std::uint64_t count, std::string_view one,
                    std::string_view many);

// --- Without a property file -------------------------------------------------

// The report on a tree without a property file: what is wrong, and a line that
// sums up; with Detail::EveryStep also the mission as a whole and a table of
// the nodes.
std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Layout layout);

// A question about the tree as a whole, in words.
struct QuestionWords {
  std::string_view key;    // "can_succeed"
  std::string_view words;  // "the mission can succeed"
};
const QuestionWords& words_of(TreeQuestion question);
// Its answer: "yes", "NO, see below".
std::string answer_text(const CheckResult& result, const CheckedFile& file,
                        const TreeReport& answer);
// False where a node of this type can never do what the question asks.
bool can_be_asked(const Network& network, NodeId node, std::size_t question);

// How many findings are not told, and why; ", 2 allowed, 1 in the baseline"
// behind the number of the others, "" for none.
struct JudgedCount {
  std::size_t allowed = 0;
  std::size_t known = 0;
};
JudgedCount count_of(const Judged& judged);
std::string judged_text(const JudgedCount& count);

// A finding in the form of the diagnostics, at its node.
Diagnostic diagnostic_of(const CheckResult& result, const TreeFinding& finding);

// The same as text, with its run in a few lines.
std::string finding_text(const CheckResult& result, const CheckedFile& file,
                         const TreeFinding& finding, Layout layout);

// The findings as text, each with its run in a few lines; with
// Detail::EveryStep, with the whole run. "" where there are none.
std::string findings_text(const CheckResult& result, const CheckedFile& file,
                          Layout layout);

// The same beside the verdicts of rules: warnings, a line for each.
std::string beside_rules_text(const CheckResult& result,
                              const CheckedFile& file, Layout layout);

// "in tick 3" or "at time 3", after `before`; "" where no time passes.
std::string when_text(std::string_view before, TickSemantics ticks, int time);

}  // namespace btcheck

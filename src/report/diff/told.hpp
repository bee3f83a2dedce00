// SPDX-License-Identifier: MIT
//
// Two trees that were compared, and what is said of them: what every format is
// made from.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "check/diff/diff.hpp"
#include "report/exit_code.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// A verdict or a finding that is otherwise in the other tree.
struct DiffChange {
  enum class Kind : std::uint8_t { Verdict, New, Gone };
  Kind kind = Kind::Verdict;
  std::string code = {};  // of a finding: "BT2001"
  std::string text;       // the finding's first line, or the rule's name
  std::string was = {};   // Verdict: "HOLDS"
  std::string is = {};
  std::string file = {};  // where it is found
  std::uint32_t line = 0;
};
// By what checks of both have found; in the order of the reports, new ones
// first.
std::vector<DiffChange> changes_between(const CheckResult& one,
                                        const CheckResult& other);

// All must outlive it.
struct DiffReport {
  const Diff& diff;
  std::array<std::string, 2> names;  // of the trees, as the user has them
  Caller caller = Caller::Any;
  std::vector<std::string> observe = {};
  std::array<const TreeInput*, 2> inputs = {};  // for pages: may be null
  std::optional<std::vector<DiffChange>> changes = {};  // where it was checked
  // Of one tree twice: "nav2-jazzy", the profile under which each is read.
  std::array<std::string, 2> profiles = {};

  // Such a profile, or a name without what both have in common: "nav2-jazzy" of
  // two trees that differ in a folder.
  std::string label(std::size_t side) const;
  std::string_view verdict() const;  // "equivalent", "different", "undecided"
  ExitCode code() const;
};

// "equivalent for every caller and every world", with what is not so, in a
// sentence or two.
std::string verdict_text(const DiffReport& report);

// What is seen in the end, beside each other: an entry for each thing that
// happens, in its tick.
struct DiffRow {
  int tick = 0;                      // from 1
  std::array<std::string, 2> cells;  // with names in backquotes
  bool differs = false;
};
std::vector<DiffRow> rows_of(const DiffReport& report);

// The run of a tree as far as it has it; nothing where the difference is none
// of runs.
std::optional<RecordedRun> run_of(const DiffReport& report, std::size_t side);

// "`land` of a.xml stands in no place of b.xml": leaves without a partner, and
// those that are told something else, in lines; "" for none.
std::string partners_text(const DiffReport& report);
// "rule `r`: HOLDS before, VIOLATED now", with backquotes around names.
std::string change_text(const DiffChange& change);

// --- The formats -------------------------------------------------------------

// For a terminal: side by side in `width` columns.
std::string diff_text(const DiffReport& report, std::size_t width);
// For the comment of a pull request.
std::string diff_markdown(const DiffReport& report);
// What a name means never changes; new names may come. docs/diff.md
inline constexpr std::string_view kDiffSchema = "btcheck-diff/1";
std::string diff_json(const DiffReport& report);
// One file for the browser. It asks nothing from anywhere.
std::string diff_page(const DiffReport& report);

// The page's form, style sheet and script, compiled in from page/.
extern const std::string_view kDiffPage;
extern const std::string_view kDiffStyle;
extern const std::string_view kDiffScript;

}  // namespace btcheck

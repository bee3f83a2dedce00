// SPDX-License-Identifier: MIT
//
// What there is to report of a check, without tree and network: every format
// that programs read is made from it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "check/check.hpp"
#include "report/exit_code.hpp"
#include "trace/run/record.hpp"

namespace btcheck {

// A place in an input; line 0 is the file as a whole.
struct Place {
  std::string file;
  SourceSpan span;
};

struct ToldStep {
  enum class Kind : std::uint8_t {
    Time,   // "tick 2 begins", "time 2"
    Event,  // "start_drone -> success"
    Remark  // "the loop begins"
  };
  Kind kind = Kind::Event;
  std::string text;
  int time = 0;            // units of time since the beginning
  bool is_chosen = false;  // by the world outside, not by the tree
  Place place;
};

// A run as a list of places to step through.
struct ToldRun {
  std::vector<ToldStep> steps;
  std::string unit;  // "tick", "time"
  int time = 0;      // units of time until the end, or until the loop closes
  // Of an infinite run: the number of the step with which the loop begins.
  std::optional<std::size_t> loop;
};

struct RelatedPlace {
  Place place;
  std::string text;  // what is there
};

// What a question can be answered with: contracts of leaves to write down, or,
// where there are none, a comment before the node.
struct ReportedReply {
  std::string words;  // "that may be cut off"
  std::vector<std::string> contracts;
  std::string comment;
};

// Something to look at: a property that is not as expected, a fault of the
// tree, a remark on it, or a mistake in an input.
struct Finding {
  enum class About : std::uint8_t {
    Rule,     // what came of a property
    Mission,  // an answer of the default report
    Tree,     // what the tree says (docs/findings.md)
    Input     // a diagnostic
  };
  About about = About::Tree;
  std::string code;  // "BT2001"
  Severity severity = Severity::Error;
  std::string title;    // the property's name, else what kind of thing it is
  std::string message;  // its first line is a sentence that stands alone
  Place place;
  std::string node;  // the names from the root down to the node; "" for none
  std::vector<RelatedPlace> related;
  std::optional<ToldRun> run;
  std::optional<CheckedRepair> repair;
  std::vector<ReportedReply> answers;  // of a question
  // Different for each finding of a file, and the same when lines have moved.
  std::string identity;
  std::string told;   // as the text of a check tells it; "" of diagnostics
  std::string trace;  // the name that its run is kept by; "" for no run
  std::string page;   // the file in which a browser shows the run
};

// The verdict is the same for every number from this one on.
struct ReportedCount {
  std::string node;  // the names from the root down to it
  Place place;
  std::string attribute;  // "num_attempts"
  int from = 0;
};

struct ReportedProperty {
  std::string name;
  std::string title;
  std::string text;
  std::vector<std::string> tags;
  Place place;
  Verdict verdict = Verdict::Undecided;
  Expectation expectation = Expectation::None;
  bool is_met = true;
  bool is_vacuous = false;
  std::string note;    // how the verdict came about: "after 2 ticks"
  std::string reason;  // why it is violated
  std::string error;   // set: our mistake, and no verdict
  StopReason stopped = StopReason::None;
  SearchProgress progress;
  std::optional<std::uint64_t> triggers;  // states in which it was asked
  int longest_answer = -1;                // -1: none
  std::vector<ReportedCount> for_every;   // where it was asked for
  std::optional<ToldRun> run;
  std::string told;  // the rule, the reason and the run as the text tells them
  std::string page;  // the file in which a browser shows the run; "" for none
};

// The answer to a question about the tree as a whole.
struct ReportedAnswer {
  std::string key;       // "can_succeed"
  std::string code;      // "BT2105": of the finding that it is not so, or ""
  std::string question;  // "the mission can succeed"
  std::string answer;    // "yes, e.g. in tick 1"
  Verdict verdict = Verdict::Undecided;
  bool is_fault = false;
  std::optional<ToldRun> run;
  std::string trace;  // the name that its run is kept by; "" for no run
  std::string page;
};

// What a node can do; no answer where nodes of its type can never do it.
struct ReportedNode {
  std::string key;  // unique in the tree
  std::string name;
  std::string type;
  Place place;
  struct Possible {
    Verdict verdict = Verdict::Undecided;
    int time = 0;
  };
  std::array<std::optional<Possible>, kNodeQuestionCount> answers;
};

// One property file, or the default report.
struct ReportedFile {
  std::string properties;  // "" for the default report
  std::string profile = "paper";
  std::string ticks;  // root, leaves, nodes, none
  std::vector<std::string> assumptions;
  bool has_faults = false;
  std::vector<ReportedProperty> verdicts;
  // Of the default report:
  std::vector<ReportedAnswer> answers;
  std::vector<ReportedNode> nodes;
  StopReason stopped = StopReason::None;
  SearchProgress progress;
  std::string error;
};

// A tree that was checked, or should have been.
struct ReportedTree {
  std::string entry;          // of a batch, its name there; "" for one check
  std::string main_tree;      // that was asked for; "" where none was
  std::string not_run;        // of a batch: why it was not begun, or not ended
  std::string file;           // as the user names it
  std::size_t nodes = 0;      // 0 when it could not be read
  std::size_t variables = 0;  // of the tree
  Place root;
  std::vector<Diagnostic> diagnostics;
  std::vector<ReportedFile> files;
  std::vector<Finding> findings;  // without those of the diagnostics
  Judged judged;                  // what the user has said of either
  std::string left_out;           // runs that are not kept, in lines
  ExitCode code = ExitCode::Met;
  // What differs from run to run:
  double seconds = 0;
  std::uint64_t peak_bytes = 0;
};

struct Report {
  std::vector<ReportedTree> trees;
  std::string directory;  // absolute; the files' names are relative to it
  std::string root;       // where reports name files from
  std::string started;    // "2026-11-22T09:30:00Z"; differs from run to run

  ExitCode code() const;
  double seconds() const;
};

// The name of a tree in a report: that of its entry, else its file.
const std::string& title_of(const ReportedTree& tree);

// The most states that a search for the tree has stored.
std::uint64_t states_of(const ReportedTree& tree);

// `file` is the tree as the user names it, `code` the exit code of the check.
ReportedTree reported(const CheckResult& result, const std::string& file,
                      ExitCode code);

// What took a step that is not one of time: a node, or a variable that moves by
// itself.
using Mover = std::variant<NodeId, StateVariableId>;
Mover mover_of(const Network& network, const RunStep& step);
Place place_of(const BehaviorTree& tree, const Mover& mover);

// Left out are times without an event, and steps that only hand control on.
ToldRun told_run(const BehaviorTree& tree, const Network& network,
                 const Run& run, const RunHeading& heading);
ToldRun told_run(const BehaviorTree& tree, const Network& network,
                 const KeptRun& run);

// The names that runs are kept by: "BT2104" for an answer of the default report
// that nobody wants, "BT2208-RecoveryActions" for a finding at that node, and
// "BT2208-RecoveryActions-2" for the second; "" where there is no run, and of a
// question: -v shows that.
std::string trace_name(const TreeReport& answer);
std::vector<std::string> trace_names(const BehaviorTree& tree,
                                     const std::vector<TreeFinding>& findings);

// The same for the same finding wherever in a repository the program is run.
std::string fingerprint_of(const Report& report, const Finding& finding);

// The same for each finding of a report, once: equal ones are told apart by a
// number, "0a1b2c3d4e5f6789:2".
class Fingerprints {
 public:
  explicit Fingerprints(const Report& report) : report_(report) {}
  std::string next(const Finding& finding);

 private:
  const Report& report_;
  std::map<std::string, int> seen_;
};

// The findings of a tree, those of its diagnostics first; and that it was not
// checked, where others were.
std::vector<Finding> all_findings(const ReportedTree& tree);
// About what the tree says (docs/findings.md): not a rule that is not met, nor
// an answer about the mission as a whole.
bool is_of_tree(const Finding& finding);
// "trees/a.xml:12:3", "trees/a.xml" for the file as a whole.
std::string place_text(const Place& place);

// --- Findings ------------------------------------------------------------

// Codes of findings that no single question of the default report asks for.
namespace rule {
inline constexpr std::string_view kViolated = "BT2001";
inline constexpr std::string_view kHolds = "BT2002";
inline constexpr std::string_view kUndecided = "BT2003";
inline constexpr std::string_view kVacuous = "BT2004";
inline constexpr std::string_view kFault = "BT2101";
inline constexpr std::string_view kInternal = "BT9002";
}  // namespace rule

// Of one property file, or of the default report. `reported` says the same as
// `file`; the runs are taken from there.
std::vector<Finding> findings_of(const CheckResult& result,
                                 const CheckedFile& file,
                                 const ReportedFile& reported);

Finding finding_of(const Diagnostic& diagnostic);

// What a diagnostic of that code is about, in a few words without a full stop;
// for an unknown code, words that fit every one.
std::string_view diagnostic_summary(std::string_view code);

// Names from the root down to the node, the same when lines have moved:
// "t/Sequence/land#2", a Sequence without a name, and the second of two `land`.
std::string stable_path(const BehaviorTree& tree, NodeId node);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What a command line asks for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "check/check.hpp"
#include "check/diff/diff.hpp"
#include "check/export/export_model.hpp"
#include "check/findings/judgement.hpp"
#include "check/space/graph.hpp"
#include "check/space/space.hpp"
#include "check/whatif/faults.hpp"
#include "cli/options/interface.hpp"
#include "model/automata/network.hpp"
#include "run/engine/leaves.hpp"

namespace btcheck {

class XmlProject;

enum class Command : std::uint8_t {
  Check,
  Space,
  Export,
  Trace,
  Simulate,
  Demo,
  Batch,
  Lint,
  Explain,
  Init,
  Conform,
  Completions,
  Man,
  Run,
  Monitor,
  Leaves,
  Answer,
  Serve,
  Mcp,
  Lsp,
  Fmt,
  Watch,
  WhatIf,
  Tests,
  Diff
};

// The tree that `btcheck -` reads.
inline constexpr std::string_view kStandardInput = "<stdin>";

inline constexpr unsigned kMostThreads = 256;
unsigned core_count();

enum class When : std::uint8_t { Auto, Always, Never };

// What `trace` makes of a run; in the order of --to in tables.cpp.
enum class TraceFormat : std::uint8_t {
  Text,
  Html,
  Itf,
  Svg,
  Strip,
  Dot,
  Mermaid,
  Btlog,
  Chrome,
  ChromeStack,
  Mcap,
  Substitution
};

struct TraceOptions {
  TraceFormat format = TraceFormat::Text;
  std::optional<int> tick;  // --at, the tick to draw
  std::string tree;         // --tree, of a trace of LTSmin, or explain's
};

// What `simulate` runs without questions. Without a seed and a script, the
// person at the terminal steps by hand.
struct SimulationPlan {
  std::optional<std::uint64_t> seed;
  std::string script;  // a file's name; "" for none
  int ticks = 100;     // where the run stops
};

// How `run` runs a tree. Its script, seed and ticks are those of the
// simulation.
struct ExecutionPlan {
  std::string leaves;    // --leaves-exec; "" for none
  int answer_ms = 1000;  // --answer-ms
  OnBreach on_breach = OnBreach::Stop;
  bool is_at_once = false;  // --no-wait
  std::string btlog;        // --btlog; "" for none
};

// What `leaves` writes; in the order of --to in tables.cpp.
enum class LeafForm : std::uint8_t { Models, Contracts };

// How `tests` writes them; in the order of --to in tables.cpp.
enum class TestForm : std::uint8_t { GoogleTest, Pytest, JsonLines };
struct TestPlan {
  std::set<TestForm> forms;  // --to; empty: all
  bool forces = false;       // --force
};

// What `fmt` does with files that are in another style.
struct FormattingPlan {
  bool checks = false;     // --check: lists them
  bool shows = false;      // --diff: shows what would change
  bool verifies = false;   // --verify
  std::string stdin_name;  // --stdin-name; "" for none

  bool writes() const { return !checks && !shows; }
};

// How `watch` follows robots.
struct RobotPlan {
  std::vector<std::string> faults;  // --inject
  std::vector<std::string> breaks;  // --break
  std::optional<int> break_ms;      // --break-for
};

// What `whatif` tells of faults; in the order of its --format in tables.cpp.
enum class FaultFormat : std::uint8_t { Text, Json, Csv, Html, Dot, Svg, Opsa };
struct FaultTarget {
  FaultFormat format = FaultFormat::Text;
  std::string file = {};  // "" for standard output
};

// What `whatif` puts into a tree, and what it tells of it.
struct FaultPlan {
  FaultChoices choices;  // --faults, --late, --others
  int order = 1;         // --order
  std::string only;      // --only: a leaf, or a node above some; "" for all
  std::string against;   // --against: an earlier result; "" for none
  std::vector<FaultTarget> outputs = {FaultTarget{}};  // --format
};

// What `diff` tells; in the order of its --format in tables.cpp.
enum class DiffFormat : std::uint8_t { Text, Json, Markdown, Html };
struct DiffTarget {
  DiffFormat format = DiffFormat::Text;
  std::string file = {};  // "" for standard output
};
struct DiffPlan {
  std::vector<std::string> observe;                  // --observe
  Caller caller = Caller::Any;                       // --caller
  std::string revision;                              // --git; "" for none
  std::vector<DiffTarget> outputs = {DiffTarget{}};  // --format
};

// How `space` tells its figures.
enum class StatisticsFormat : std::uint8_t { Table, Json };

struct Options {
  std::vector<std::string> words;  // the command line, as it was typed
  Command command = Command::Check;
  std::string input;  // a tree, or a file of properties;
                      // explain: a code or log; completions: a shell
  std::vector<std::string> inputs;      // lint: every tree, `input` the first
  std::vector<std::string> properties;  // --prop
  std::vector<std::string> rules;       // -e
  std::optional<TickSemantics> ticks;
  std::optional<Profile> profile;
  std::optional<Profile> against;   // --against: to compare with
  int tick_ms = 100;                // XML trees: what a tick of the root takes
  std::vector<std::string> models;  // --models
  std::vector<std::string> leaves;  // --leaves
  bool loops = false;               // --loop
  bool wakes = false;               // --wake-ups
  std::string main_tree;            // --main-tree
  std::string settings;             // --config: a btcheck.toml; "": found
  bool ignores_settings = false;    // --no-config
  // The options that the command line names, "--profile": what a btcheck.toml
  // says of these does not count.
  std::set<std::string> given;
  // Where inputs may lie: folders of --root, else those of a batch, and files
  // that the command line names. Anywhere where it is empty.
  std::vector<std::string> roots;
  // The XML files that a tree lies among; nullptr: those beside it.
  std::shared_ptr<const XmlProject> project;
  SearchOrder search = SearchOrder::BreadthFirst;
  Reduction reduce = Reduction::Full;  // `space`: None, unless it is said
  StateSetKind store = StateSetKind::Compressed;
  // Default: one for each core; in a batch the cores shared out.
  unsigned threads = 1;
  ExtraAssumption assume = ExtraAssumption::None;  // --assume
  std::uint64_t max_states = UINT64_MAX;
  std::uint64_t max_bytes = 0;  // 0: three quarters of what there is
  double timeout = 0;           // seconds; 0: none
  std::vector<ReportTarget> reports = {ReportTarget{}};  // --format
  // --deny, the levels of btcheck.toml, and the baseline.
  Judgement judgement;
  std::string baseline;       // --baseline; "" for none
  std::string new_baseline;   // --write-baseline; "" for none
  bool tries_repairs = true;  // no --no-repairs
  bool any_count = false;     // --any-count
  std::string trace_dir;
  std::string scratch_dir;  // --on-disk; "": nothing goes to disk
  std::string cache_dir;    // --cache; "": what is known is forgotten
  ExportFormat format = ExportFormat::Dot;
  std::string space;                  // export: --namespace; "": one of its own
  std::optional<std::uint16_t> view;  // --view: the port; 0: any
  TraceOptions trace;
  SimulationPlan simulation;
  ExecutionPlan run;
  // --from: a log or an ITF file, "" for none, and the tick at whose end runs
  // begin; without one at its last state.
  std::string from;
  std::optional<int> from_tick;
  std::optional<int> tick_gap;  // --tick-gap, in milliseconds
  std::string topic;    // --topic, of a recording of ROS 2; "": the only one
  std::string learned;  // conform: --learn-leaves; "" for none
  bool tells_coverage = false;  // conform: --coverage
  bool explains_log = false;    // explain: `input` is a log and no code
  std::string output;           // -o; "" for standard output
  FormattingPlan formatting;
  RobotPlan robots;
  FaultPlan faults;
  TestPlan tests;
  DiffPlan diff;
  std::optional<LeafForm> leaf_form;  // leaves: --to; else by the name of -o
  std::optional<GraphFormat> graph;   // space: --export
  std::string graph_file;             // "" for standard output
  // space: --reduce bisimulation and strong, and --observe.
  std::optional<Equivalence> modulo;
  std::optional<SeenAnswers> seen;
  StatisticsFormat statistics = StatisticsFormat::Table;
  When color = When::Auto;
  BatchOptions batch;
  bool watches = false;     // --watch: check again whenever a file changes
  bool is_quiet = false;    // no progress, no statistics
  bool is_verbose = false;  // every run, every step
};

// A text to print and the code to exit with: the answer to --help, to --version
// and to a command line that cannot be understood.
struct Answer {
  std::string text;
  ExitCode code = ExitCode::Met;
};
bool is_folder(const std::string& input);
// A tree's file, by its name; a folder is none, whatever it is called.
bool names_tree(const std::string& input);

// What `check` was asked, for several entries.
Options as_batch(Options options);

std::variant<Options, Answer> parse_options(int argc, const char* const* argv);

}  // namespace btcheck

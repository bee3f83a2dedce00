// SPDX-License-Identifier: MIT
//
// The command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "check/check.hpp"
#include "check/export/export_model.hpp"
#include "check/space/space.hpp"
#include "cli/options/batch_options.hpp"
#include "cli/options/report_target.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Part of the interface: docs and `--help` list them.
enum class ExitCode : std::uint8_t {
  Met = 0,        // every property met its expectation
  Missed = 1,     // some property missed its expectation
  BadInput = 2,   // usage, input or model error: nothing was checked
  Undecided = 3,  // a limit, timeout or interrupt, and nothing violated
  Internal = 4    // our mistake
};

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
  Completions,
  Man
};

inline constexpr unsigned kMostThreads = 256;

enum class When : std::uint8_t { Auto, Always, Never };

// What `trace` makes of a run; in the order of --to in option_table.cpp.
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

// How `space` tells its figures.
enum class StatisticsFormat : std::uint8_t { Table, Json };

struct Options {
  Command command = Command::Check;
  std::string input;                    // a tree, or a file of properties;
                                        // explain: a code; completions: a shell
  std::vector<std::string> inputs;      // lint: every tree, `input` the first
  std::vector<std::string> properties;  // --prop
  std::optional<TickSemantics> ticks;
  std::optional<Profile> profile;
  int tick_ms = 100;                // XML trees: what a tick of the root takes
  std::vector<std::string> models;  // --models
  std::vector<std::string> leaves;  // --leaves
  bool loops = false;               // --loop
  bool wakes = false;               // --wake-ups
  std::string main_tree;            // --main-tree
  SearchOrder search = SearchOrder::BreadthFirst;
  Reduction reduce = Reduction::Full;  // `space`: None, unless it is said
  StateSetKind store = StateSetKind::Compressed;
  // Default: one for each core; in a batch the cores shared out.
  unsigned threads = 1;
  ExtraAssumption assume = ExtraAssumption::None;  // --assume
  std::uint64_t max_states = UINT64_MAX;
  std::uint64_t max_bytes = 0;  // 0: three quarters of the machine's memory
  double timeout = 0;           // seconds; 0: none
  std::vector<ReportTarget> reports = {ReportTarget{}};  // --format
  std::string trace_dir;
  std::string scratch_dir;  // --on-disk; "": nothing goes to disk
  ExportFormat format = ExportFormat::Dot;
  TraceFormat trace_format = TraceFormat::Text;
  std::optional<int> trace_tick;       // trace: --at, the tick to draw
  std::string output;                  // -o; trace: "" for standard output
  std::optional<std::uint64_t> seed;   // simulate: a random run
  std::string script;                  // simulate: --script, "" for none
  std::optional<int> simulated_ticks;  // simulate: --ticks
  std::optional<GraphFormat> graph;    // space: --export
  std::string graph_file;              // "" for standard output
  StatisticsFormat statistics = StatisticsFormat::Table;
  When color = When::Auto;
  BatchOptions batch;       // batch
  bool is_quiet = false;    // no progress, no statistics
  bool is_verbose = false;  // every run, every step
};

// What a command line asks for: options to work with, or a text to print and
// the code to exit with.
struct Answer {
  std::string text;
  ExitCode code = ExitCode::Met;
};
std::variant<Options, Answer> parse_options(int argc, const char* const* argv);

}  // namespace btcheck

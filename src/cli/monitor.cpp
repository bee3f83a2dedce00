// SPDX-License-Identifier: MIT
//
// `btcheck monitor TREE --prop RULES`: rules asked while the robot runs. A line
// of standard input is an event, a line of standard output its verdict.
#include <fmt/format.h>

#include <iostream>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/process_limits.hpp"
#include "cli/recordings.hpp"
#include "model/tree_file.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/oracle/oracle.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

// Of one line; what follows is passed over.
constexpr std::size_t kMostLetters = std::size_t{1} << 20;

// The next line without its end, cut where it is longer; false at the end.
bool next_line(std::istream& in, std::string& line) {
  line.clear();
  std::streambuf& bytes = *in.rdbuf();
  constexpr int kEnd = std::char_traits<char>::eof();
  int next = bytes.sbumpc();
  if (next == kEnd) return false;
  for (; next != kEnd && next != '\n'; next = bytes.sbumpc()) {
    if (line.size() <= kMostLetters) line += static_cast<char>(next);
  }
  return true;
}

// Answers every line. Bad input where one was not understood.
ExitCode serve(const Options& options, Oracle& oracle) {
  ExitCode code = ExitCode::Met;
  std::string line;
  while (next_line(std::cin, line)) {
    if (line.find_first_not_of(" \t\r") == line.npos) continue;
    auto answer = oracle.answer(line);
    for (const Diagnostic& found : answer.told) {
      if (found.code == "BT1813") code = ExitCode::BadInput;
    }
    show(options, answer.told);
    print(answer.line + "\n");
    flush_output();
  }
  const auto broken = oracle.violated();
  if (!options.is_quiet) {
    tell(fmt::format("{} lines, {} changes of status: {}\n", oracle.lines(),
                     oracle.changes(), oracle.verdict()));
  }
  return broken.empty() ? code : worst_of(code, ExitCode::Missed);
}

}  // namespace

ExitCode run_monitor(const Options& options) {
  std::vector<Diagnostic> found;
  const auto inputs = read_inputs(options, found);
  if (!inputs) return ExitCode::BadInput;
  if (inputs->properties.empty()) {
    complain("BT0001", "monitor: there are no rules; write --prop RULES.ltl");
    return ExitCode::BadInput;
  }
  std::vector<OracleRules> rules;
  for (const InputFile& file : inputs->properties) {
    auto read = read_properties(file.name, file.text);
    found.insert(found.end(), read.diagnostics.begin(), read.diagnostics.end());
    if (!read.value) continue;
    rules.push_back({std::move(*read.value), SourceText(file.name, file.text)});
  }
  auto tree =
      read_tree(inputs->tree.name, inputs->tree.text, inputs->tree.reading);
  found.insert(found.end(), tree.diagnostics.begin(), tree.diagnostics.end());
  if (!tree.value || has_error(found)) {
    show(options, found);
    return ExitCode::BadInput;
  }
  if (tree.value->roots.size() != 1) {
    found.push_back(file_error("BT1806", inputs->tree.name,
                               "several trees at once are not followed in a "
                               "log",
                               "a robot logs one tree"));
  }
  const RecordedRun run = recorded_tree(*tree.value, inputs->tree);
  auto oracle = Oracle::make(*tree.value, run, rules, reading_of(options));
  found.insert(found.end(), oracle.diagnostics.begin(),
               oracle.diagnostics.end());
  show(options, found);
  if (!oracle.value || has_error(found)) return ExitCode::BadInput;
  Guard::dismiss();
  InterruptWatch::stand_down();
  return serve(options, **oracle.value);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A page for each run, and a file for programs: of a property its
// counterexample or witness, of a finding the run that shows it.
#include "cli/outputs/write_reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "cli/inputs/files.hpp"
#include "report/text/report.hpp"
#include "trace/run/itf.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck {
namespace {

// A name that can be part of a file's.
std::string file_part(std::string_view name) {
  std::string part;
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '_' || c == '-';
    part += is_plain ? c : '_';
  }
  return part;
}

std::string stem_of(const std::string& file) {
  std::string stem = file.substr(file.find_last_of('/') + 1);
  return file_part(stem.substr(0, stem.rfind('.')));
}

// Directory, tree and name, without an ending.
std::string trace_stem(const std::string& directory,
                       const std::string& tree_file, std::string_view name) {
  return fmt::format("{}/{}.{}", directory, stem_of(tree_file),
                     name.find('/') == std::string_view::npos
                         ? std::string(name)
                         : file_part(name));
}

// For the browser.
std::string write_page(const std::string& directory,
                       const std::string& tree_file, std::string_view name,
                       const RecordedRun& run) {
  std::string complaint = make_directory(directory);
  if (!complaint.empty()) return complaint;
  return write_file(trace_stem(directory, tree_file, name) + ".html",
                    html_text(run));
}

// About what ITF needs for one state: of each node its key, three times, with
// a status, a location and a phase.
std::size_t state_bytes(const RecordedRun& run) {
  constexpr std::size_t kOfState = 200;
  constexpr std::size_t kOfNode = 50;
  std::size_t bytes = kOfState;
  for (const RecordedNode& node : run.nodes) {
    bytes += kOfNode + 3 * node.key.size();
  }
  return bytes;
}

// Runs of the results, as files.
class TraceWriter {
 public:
  TraceWriter(const std::string& directory, const CheckResult& result,
              const TreeInput& input, const Limits& limits)
      : directory_(directory),
        result_(result),
        tree_(*result.tree),
        input_(input),
        limits_(limits) {}

  WrittenTraces write(const CheckedFile& file) {
    for (const PropertyVerdict& verdict : file.verdicts) {
      if (!verdict.run) continue;
      add(file, *verdict.run, verdict.property->name,
          heading_of(result_, file, verdict), kMostAskedBytes);
    }
    if (file.defaults) {
      for (const TreeReport& answer : file.defaults->tree) {
        add(file, answer.run, trace_name(answer));
      }
    }
    const auto names = trace_names(tree_, file.findings);
    std::size_t count = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto& run = file.findings[i].run;
      if (run && !names[i].empty() && ++count > kMostFindings) {
        ++written_.too_many;
      } else {
        add(file, run, names[i]);
      }
    }
    return std::move(written_);
  }

 private:
  // Of a finding.
  void add(const CheckedFile& file, const std::optional<KeptRun>& run,
           const std::string& name) {
    if (!run || name.empty()) return;
    if (is_too_long(*run) || !limits_.may_tell()) {
      ++written_.left_out;
      return;
    }
    RunHeading heading;
    heading.property = heading.formula = name;
    heading.verdict = "VIOLATED";
    add(file, run->told(), name, std::move(heading), kMostStateBytes);
  }

  // A page for people, and where it is not too long a file for programs.
  void add(const CheckedFile& file, const Run& run, const std::string& name,
           RunHeading heading, std::size_t most_bytes) {
    std::string& complaint = written_.complaint;
    if (!complaint.empty()) return;
    add_sources(heading, tree_, input_);
    const RecordedRun kept = recorded(tree_, *file.network, run, heading);
    if (kept.states.size() > most_bytes / state_bytes(kept)) {
      ++written_.pages_alone;
      complaint = write_page(directory_, tree_.file, name, kept);
    } else {
      complaint = write_trace(directory_, tree_.file, name, kept);
    }
    if (complaint.empty()) written_.names.push_back(name);
  }

  // A run as a file holds each node in each state, in words.
  bool is_too_long(const KeptRun& run) const {
    constexpr std::size_t kNodeBytes = 512;
    return run.step_count() * tree_.nodes.size() >
           limits_.max_bytes / 2 / kNodeBytes;
  }

  std::string directory_;
  const CheckResult& result_;
  const BehaviorTree& tree_;
  const TreeInput& input_;
  const Limits& limits_;
  WrittenTraces written_;
};

}  // namespace

void WrittenTraces::add(WrittenTraces more) {
  complaint = std::move(more.complaint);
  std::ranges::move(more.names, std::back_inserter(names));
  left_out += more.left_out;
  too_many += more.too_many;
  pages_alone += more.pages_alone;
}

std::string WrittenTraces::omissions(const std::string& directory) const {
  std::string text;
  const auto add = [&](std::size_t count, std::string_view what) {
    if (count == 0) return;
    text += fmt::format("{} {}\n", counted(count, "run is", "runs are"), what);
  };
  add(left_out, fmt::format("not written to {}: the limit of --timeout or "
                            "--memory",
                            directory));
  add(too_many, fmt::format("not written to {}: it has those of {} findings",
                            directory, kMostFindings));
  add(pages_alone, fmt::format("written to {} as a page alone: with each node "
                               "in each state, for programs, it is too long",
                               directory));
  return text;
}

std::string trace_page(const std::string& directory,
                       const std::string& tree_file, std::string_view name) {
  return trace_stem(directory, tree_file, name) + ".html";
}

std::string write_trace(const std::string& directory,
                        const std::string& tree_file, std::string_view name,
                        const RecordedRun& run) {
  std::string complaint = write_page(directory, tree_file, name, run);
  if (!complaint.empty()) return complaint;
  return write_file(trace_stem(directory, tree_file, name) + ".itf.json",
                    itf_text(run));
}

WrittenTraces write_traces(const std::string& directory,
                           const CheckResult& result, const CheckedFile& file,
                           const TreeInput& input, const Limits& limits) {
  return TraceWriter(directory, result, input, limits).write(file);
}

}  // namespace btcheck

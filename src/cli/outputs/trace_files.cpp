// SPDX-License-Identifier: MIT
//
// One file for each run: of a property its counterexample or witness, of the
// default report a witness for each thing that a node can do.
#include "cli/outputs/write_reports.hpp"

#include <fmt/format.h>

#include <array>

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

// Every run of the results, as files.
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
          heading_of(result_, file, verdict));
    }
    if (file.defaults) write_defaults(file);
    return std::move(written_);
  }

 private:
  void write_defaults(const CheckedFile& file) {
    for (const TreeReport& report : file.defaults->tree) {
      const std::string name(trace_name(report.question));
      add(file, report.run, name,
          shown(name, name, is_fault(report) ? "VIOLATED" : "HOLDS"));
    }
    write_findings(file);
    const std::size_t most_bytes = bytes_ + kMostNodeBytes;
    for (const NodeReport& report : file.defaults->nodes) {
      for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
        const std::string name = fmt::format(
            "{}.{}", unique_name(tree_, report.node), kNodeQuestionNames[q]);
        if (report.answers[q].run && bytes_ > most_bytes) {
          ++written_.too_many;
          continue;
        }
        add(file, report.answers[q].run,
            fmt::format("{}.{}", file_part(unique_name(tree_, report.node)),
                        kNodeQuestionNames[q]),
            shown(name, "possible " + name));
      }
    }
  }

  void write_findings(const CheckedFile& file) {
    for (const StaleGuardReport& stale : file.defaults->stale_guards) {
      const std::string name =
          file_part(unique_name(tree_, stale.action)) + ".stale_guards";
      add(file, stale.run, name, shown(name, name));
    }
    for (const LeftRunningReport& left : file.defaults->left_running) {
      const std::string name = fmt::format(
          "{}.left_running_by.{}", file_part(unique_name(tree_, left.leaf)),
          file_part(unique_name(tree_, left.above)));
      add(file, left.run, name, shown(name, name));
    }
  }

  RunHeading shown(const std::string& property, const std::string& formula,
                   const std::string& verdict = "HOLDS") const {
    RunHeading heading;
    heading.property = property;
    heading.formula = formula;
    heading.verdict = verdict;
    return heading;
  }

  // A file for programs, and one for people.
  void add(const CheckedFile& file, const std::optional<KeptRun>& run,
           std::string_view name, RunHeading heading) {
    if (!run) return;
    if (is_too_long(*run) || !limits_.may_tell()) {
      ++written_.left_out;
    } else {
      add(file, run->told(), name, std::move(heading));
    }
  }
  void add(const CheckedFile& file, const Run& run, std::string_view name,
           RunHeading heading) {
    std::string& complaint = written_.complaint;
    if (!complaint.empty()) return;
    add_sources(heading, tree_, input_);
    complaint =
        write_trace(directory_, tree_.file, name,
                    recorded(tree_, *file.network, run, heading), bytes_);
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
  std::size_t bytes_ = 0;  // of what is written
};

}  // namespace

std::string_view trace_name(TreeQuestion question) {
  constexpr std::array<std::string_view, kTreeQuestionCount> kNames = {
      "root.success", "root.failure", "cannot_end",    "cannot_succeed",
      "stuck",        "range",        "zero_time_loop"};
  return kNames[static_cast<std::size_t>(question)];
}

std::string trace_page(const std::string& directory,
                       const std::string& tree_file, std::string_view name) {
  return trace_stem(directory, tree_file, name) + ".html";
}

std::string write_trace(const std::string& directory,
                        const std::string& tree_file, std::string_view name,
                        const RecordedRun& run, std::size_t& bytes) {
  std::string complaint = make_directory(directory);
  const std::string stem = trace_stem(directory, tree_file, name);
  const auto write = [&](std::string_view ending, const std::string& text) {
    if (!complaint.empty()) return;
    complaint = write_file(stem + std::string(ending), text);
    bytes += text.size();
  };
  write(".itf.json", itf_text(run));
  write(".html", html_text(run));
  return complaint;
}

WrittenTraces write_traces(const std::string& directory,
                           const CheckResult& result, const CheckedFile& file,
                           const TreeInput& input, const Limits& limits) {
  return TraceWriter(directory, result, input, limits).write(file);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// One file for each run: of a property its counterexample or witness, of the
// default report a witness for each thing that a node can do.
#include "cli/trace_files.hpp"

#include <fmt/format.h>

#include <array>

#include "cli/files.hpp"
#include "trace/itf.hpp"

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

// Every run of the results, as files.
class TraceWriter {
 public:
  TraceWriter(const std::string& directory, const BehaviorTree& tree)
      : directory_(directory), tree_(tree) {}

  std::string write(const CheckedFile& file) {
    for (const PropertyVerdict& verdict : file.verdicts) {
      const bool holds = verdict.verdict == Verdict::Holds;
      add(file, verdict.run, verdict.property->name,
          {verdict.property->name, verdict.property->text,
           holds ? "HOLDS" : "VIOLATED"});
    }
    if (file.defaults) write_defaults(file);
    return complaint_;
  }

 private:
  void write_defaults(const CheckedFile& file) {
    for (const NodeReport& report : file.defaults->nodes) {
      for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
        const std::string name = fmt::format(
            "{}.{}", unique_name(tree_, report.node), kNodeQuestionNames[q]);
        add(file, report.answers[q].run,
            fmt::format("{}.{}", file_part(unique_name(tree_, report.node)),
                        kNodeQuestionNames[q]),
            {name, "possible " + name, "HOLDS"});
      }
    }
    constexpr std::array<std::string_view, kTreeQuestionCount> kNames = {
        "root.success", "root.failure", "cannot_end",    "cannot_succeed",
        "stuck",        "range",        "zero_time_loop"};
    for (const TreeReport& report : file.defaults->tree) {
      const std::string name(kNames[static_cast<std::size_t>(report.question)]);
      add(file, report.run, name,
          {name, name, is_fault(report) ? "VIOLATED" : "HOLDS"});
    }
    write_findings(file);
  }

  void write_findings(const CheckedFile& file) {
    for (const StaleGuardReport& stale : file.defaults->stale_guards) {
      const std::string name =
          file_part(unique_name(tree_, stale.action)) + ".stale_guards";
      add(file, stale.run, name, {name, name, "HOLDS"});
    }
    for (const LeftRunningReport& left : file.defaults->left_running) {
      const std::string name = fmt::format(
          "{}.left_running_by.{}", file_part(unique_name(tree_, left.leaf)),
          file_part(unique_name(tree_, left.above)));
      add(file, left.run, name, {name, name, "HOLDS"});
    }
  }

  void add(const CheckedFile& file, const std::optional<Run>& run,
           std::string_view name, const RunHeading& heading) {
    if (!run || !complaint_.empty()) return;
    complaint_ = make_directory(directory_);
    if (!complaint_.empty()) return;
    complaint_ = write_file(
        fmt::format("{}/{}.{}.itf.json", directory_, stem_of(tree_.file),
                    name.find('/') == std::string_view::npos ? std::string(name)
                                                             : file_part(name)),
        itf_text(tree_, *file.network, *run, heading));
  }

  std::string directory_;
  const BehaviorTree& tree_;
  std::string complaint_;
};

}  // namespace

std::string write_traces(const std::string& directory, const BehaviorTree& tree,
                         const CheckedFile& file) {
  return TraceWriter(directory, tree).write(file);
}

}  // namespace btcheck

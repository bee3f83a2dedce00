// SPDX-License-Identifier: MIT
#include "batch/leaves.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "batch/entries/entries.hpp"
#include "check/init/leaf_uses.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "model/btcpp/unknown_leaves.hpp"
#include "model/tree_file.hpp"
#include "report/text/report.hpp"
#include "text/budget.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// What is wrong with one entry, each thing once for all of them.
class Complaints {
 public:
  explicit Complaints(const Options& options) : options_(options) {}

  void take(std::vector<Diagnostic> found) {
    std::erase_if(found, [&](const Diagnostic& one) {
      return one.severity != Severity::Error ||
             !told_.insert(render(one)).second;
    });
    is_empty_ = is_empty_ && found.empty();
    show(options_, found);
  }
  bool is_empty() const { return is_empty_; }

 private:
  const Options& options_;
  std::set<std::string> told_;
  bool is_empty_ = true;
};

// Nothing where the entry is read; only XML trees have leaves to describe. What
// their uses show is added to `uses` where that is asked for.
std::vector<Diagnostic> add_leaves_of(const BatchEntry& entry,
                                      const Options& all, UnknownLeaves& to,
                                      LeafUses* uses) {
  if (has_error(entry.diagnostics)) return entry.diagnostics;
  if (!is_xml_name(entry.input)) return {};
  const Stage stage("leaves were looked for");
  Options own = applied(all, entry.choices);
  own.project = entry.project;
  std::vector<Diagnostic> found;
  const auto inputs = gather_inputs(entry.input, {}, own, found);
  if (!inputs) return found;
  if (uses != nullptr) {
    const auto read =
        read_tree(inputs->tree.name, inputs->tree.text, inputs->tree.reading);
    if (read.value) uses->add(*read.value);
  }
  return add_unknown_leaves(inputs->tree.name, inputs->tree.text,
                            inputs->tree.reading, to);
}

// Somebody may have filled it in.
std::string obstacle_to_begin(const std::string& file) {
  std::error_code fault;
  const bool is_there = std::filesystem::is_regular_file(file, fault) &&
                        std::filesystem::file_size(file, fault) > 0;
  if (!is_there) return {};
  return fmt::format(
      "cannot write `{}`: it is there already; name another file, or delete it",
      file);
}

bool asks_for_contracts(const Options& options) {
  return options.leaf_form ? *options.leaf_form == LeafForm::Contracts
                           : options.output.ends_with(".leaves");
}

}  // namespace

ExitCode run_leaves(const Options& options) {
  const std::string obstacle = obstacle_to_begin(options.output);
  if (!obstacle.empty()) {
    complain("BT0004", obstacle);
    return ExitCode::BadInput;
  }
  UnknownLeaves leaves;
  LeafUses uses;
  const bool as_contracts = asks_for_contracts(options);
  Complaints complaints(options);
  for (const std::string& source : options.inputs) {
    if (!source.ends_with(".btf") || !names_tree(source)) continue;
    complaints.take({file_error(
        "BT1636", source, "only leaves of XML trees are described elsewhere",
        "a .btf tree has its contracts in its own file")});
  }
  for (const BatchEntry& entry : gather_batch(options)) {
    complaints.take(
        add_leaves_of(entry, options, leaves, as_contracts ? &uses : nullptr));
  }
  ExitCode code = complaints.is_empty() ? ExitCode::Met : ExitCode::BadInput;
  const std::size_t count = leaves.types().size();
  const std::string proposals = uses.proposals();
  if (count > 0 || !proposals.empty()) {
    const std::string text =
        !as_contracts ? leaves.xml()
        : count == 0
            ? proposals
            : leaves.contracts() + (proposals.empty() ? "" : "\n" + proposals);
    code = worst_of(code, write_output(options.output, harmless(text)));
  }
  if (!options.is_quiet && (count > 0 || complaints.is_empty())) {
    tell(count == 0 ? "there is no leaf of which nothing is known\n"
                    : fmt::format("{} of which nothing is known\n",
                                  counted(count, "leaf", "leaves")));
  }
  return code;
}

}  // namespace btcheck

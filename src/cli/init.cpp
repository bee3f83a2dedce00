// SPDX-License-Identifier: MIT
//
// `btcheck init TREE`: a file of rules to begin with.
#include <filesystem>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "report/text/proposed_rules.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// Where rules that are kept in `output` find the tree.
std::string tree_seen_from(const std::string& output, const std::string& tree) {
  if (output.empty()) return tree;
  std::error_code fault;
  const fs::path folder = fs::absolute(output, fault).parent_path();
  const fs::path path = fs::absolute(tree, fault).lexically_relative(folder);
  return path.empty() ? tree : path.generic_string();
}

}  // namespace

ExitCode run_init(const Options& asked) {
  std::vector<Diagnostic> found;
  const auto inputs = read_inputs(asked, found);
  if (!inputs) return ExitCode::BadInput;
  const Options& options = inputs->options;
  const std::string& tree = inputs->tree.name;
  Watch watch(options);
  const ProposedRules proposed = proposed_rules(
      inputs->tree, is_given(tree) ? "" : tree_seen_from(options.output, tree),
      check_options(options, watch.limits));
  watch.monitor.clear();
  show(options, proposed.diagnostics);
  if (proposed.text.empty()) return proposed.code;
  return worst_of(proposed.code, write_output(options.output, proposed.text));
}

}  // namespace btcheck

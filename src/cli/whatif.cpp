// SPDX-License-Identifier: MIT
//
// `btcheck whatif TREE`: what the mission does when something breaks.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "check/bind/node_names.hpp"
#include "check/whatif/whatif.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "report/whatif/table.hpp"

namespace btcheck {

ExitCode run_whatif(const Options& asked) {
  Options options = asked;
  std::vector<Diagnostic> found;
  const auto inputs = read_inputs(options, found);
  if (!inputs) return ExitCode::BadInput;
  options = inputs->options;
  auto input = what_if_input(inputs->tree, inputs->properties);
  show(options, input.diagnostics);
  if (!input.value) return ExitCode::BadInput;
  Watch watch(options);
  const WhatIfOptions how{options.faults.choices, options.faults.order,
                          options.ticks.value_or(TickSemantics::Root),
                          watch.limits, threads_to_use(options)};
  auto result = what_if(*input.value, how);
  watch.monitor.clear();
  show(options, result.diagnostics);
  if (!result.value) return ExitCode::BadInput;
  print_exactly(painted(
      options,
      what_if_text(input.value->tree, *result.value, {options.is_verbose}),
      STDOUT_FILENO));
  if (!options.is_quiet) {
    tell(fmt::format("{:.2f} s\n", watch.monitor.seconds()));
  }
  return ExitCode::Met;
}

}  // namespace btcheck

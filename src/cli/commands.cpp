// SPDX-License-Identifier: MIT
//
// Verdicts go to stdout; diagnostics, progress and statistics to stderr. An
// error in any input ends a command before anything is searched.
#include "cli/commands.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <variant>
#include <vector>

#include "batch/command.hpp"
#include "check/export/export_model.hpp"
#include "cli/check_command.hpp"
#include "cli/explain_command.hpp"
#include "cli/inputs/complaints.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/lint_command.hpp"
#include "cli/options/completions.hpp"
#include "cli/simulate.hpp"
#include "cli/space_command.hpp"
#include "cli/trace_command.hpp"

namespace btcheck {
namespace {

ExitCode run_export(const Options& options) {
  std::vector<Diagnostic> found;
  const auto inputs = read_inputs(options, found);
  if (!inputs) return ExitCode::BadInput;
  const auto model =
      export_model(inputs->tree, inputs->properties,
                   {options.format, options.ticks, options.assume});
  show(options, model.diagnostics);
  if (!model.value) return ExitCode::BadInput;
  fmt::print("{}", *model.value);
  return ExitCode::Met;
}

ExitCode run_trace(const Options& options) {
  const auto file = read_file(options.input);
  show(options, file.diagnostics);
  if (!file.value) return ExitCode::BadInput;
  const Result<std::string> result = converted(*file.value, options);
  show(options, result.diagnostics);
  if (!result.value) return ExitCode::BadInput;
  return write_output(options.output, *result.value);
}

ExitCode run_simulate(const Options& options) {
  const auto lowered = read_and_lower(options);
  if (!lowered) return ExitCode::BadInput;
  const auto [findings, is_interrupted] = simulate_as_told(
      {lowered->tree, lowered->network, lowered->source}, options);
  show(options, findings);
  if (has_error(findings)) return ExitCode::BadInput;
  return is_interrupted ? ExitCode::Undecided : ExitCode::Met;
}

ExitCode run_completions(const Options& options) {
  const std::string script = completions_for(options.input);
  if (script.empty()) {
    complain("BT0001", fmt::format("completions for `{}`: no such shell; write "
                                   "bash, zsh or fish",
                                   options.input));
    return ExitCode::BadInput;
  }
  fmt::print("{}", script);
  return ExitCode::Met;
}

ExitCode run_command(const Options& options) {
  switch (options.command) {
    case Command::Check:
      return run_check(options);
    case Command::Space:
      return run_space(options);
    case Command::Export:
      return run_export(options);
    case Command::Trace:
      return run_trace(options);
    case Command::Simulate:
      return run_simulate(options);
    case Command::Demo:
      return run_demo(options);
    case Command::Batch:
      return run_batch(options);
    case Command::Lint:
      return run_lint(options);
    case Command::Explain:
      return run_explain(options);
    case Command::Completions:
      return run_completions(options);
    case Command::Man:
      fmt::print("{}", man_page());
      return ExitCode::Met;
  }
  return ExitCode::Internal;
}

// What was printed is not yet written. Throws std::system_error.
void finish_output() {
  if (std::fflush(stdout) != 0) {
    throw std::system_error(errno, std::generic_category());
  }
  if (std::ferror(stdout) != 0) {  // some time ago
    throw std::system_error(EIO, std::generic_category());
  }
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // writing fails instead
  try {
    const auto parsed = parse_options(argc, argv);
    if (const auto* answer = std::get_if<Answer>(&parsed)) {
      fmt::print(answer->code == ExitCode::Met ? stdout : stderr, "{}",
                 answer->text);
      finish_output();
      return static_cast<int>(answer->code);
    }
    const ExitCode code = run_command(std::get<Options>(parsed));
    finish_output();
    return static_cast<int>(code);
  } catch (const std::system_error& fault) {
    complain("BT0004", fmt::format("cannot write the output: {}",
                                   fault.code().message()));
    return static_cast<int>(ExitCode::BadInput);
  } catch (const std::bad_alloc&) {
    complain("BT9001", "out of memory; --memory sets a limit that is kept");
    return static_cast<int>(ExitCode::Undecided);
  } catch (const std::exception& fault) {
    complain("BT9002", fmt::format("internal error: {}", fault.what()));
    return static_cast<int>(ExitCode::Internal);
  }
}

}  // namespace btcheck

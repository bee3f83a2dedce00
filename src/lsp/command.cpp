// SPDX-License-Identifier: MIT
#include "lsp/command.hpp"

#include <memory>

#include "lsp/methods.hpp"
#include "lsp/workbench.hpp"
#include "serve/command.hpp"

namespace btcheck {
namespace lsp {
namespace {

std::unique_ptr<Workbench>& the_workbench() {
  static std::unique_ptr<Workbench> one;
  return one;
}

}  // namespace

Workbench& workbench() { return *the_workbench(); }

}  // namespace lsp

ExitCode run_lsp(const Options& options) {
  Options all = options;
  all.command = Command::Check;
  // One thread for what comes in order, one for what waits for a check.
  constexpr unsigned kThreads = 2;
  const ExitCode code = serve_messages(
      all, lsp::lsp_protocol(), Framing::Headers, kThreads,
      [](Wire& wire, const Service& service) {
        lsp::the_workbench() = std::make_unique<lsp::Workbench>(
            wire, service.options, service.bytes);
      },
      [] { lsp::the_workbench().reset(); });
  if (code != ExitCode::Met) return code;
  return lsp::is_shut_down() ? ExitCode::Met : ExitCode::Missed;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "serve/command.hpp"

#include <unistd.h>

#include <csignal>
#include <string>
#include <utility>

#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/process_limits.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/options/roots.hpp"
#include "serve/asked.hpp"
#include "serve/mcp.hpp"
#include "serve/methods.hpp"
#include "serve/server.hpp"
#include "serve/wire.hpp"

namespace btcheck {
namespace {

// Files are read in the repository of the current folder, or in that folder.
Options confined(const Options& options, bool is_strict) {
  Options all = options;
  all.command = Command::Check;
  if (all.roots.empty()) {
    const std::string repository = repository_of(".");
    all.roots = {repository.empty() ? "." : repository};
  }
  if (is_strict) all.given.insert("--root");
  return all;
}

ExitCode serve(const Options& options, const Protocol& protocol,
               Framing framing, bool is_strict) {
  return serve_messages(confined(options, is_strict), protocol, framing,
                        std::max(1U, options.batch.jobs),
                        [](Wire&, const Service& all) { begin_service(all); });
}

}  // namespace

ExitCode serve_messages(const Options& options, const Protocol& protocol,
                        Framing framing, unsigned threads,
                        const std::function<void(Wire&, const Service&)>& begin,
                        const std::function<void()>& end) {
  if (::isatty(STDIN_FILENO) != 0 && !options.is_quiet) {
    tell("waiting for messages of a program; Ctrl-D ends it\n");
  }
  // Signals end the process: it has nothing to tell that nobody asks for.
  InterruptWatch::stand_down();
  Guard::dismiss();
  std::signal(SIGPIPE, SIG_IGN);
  // The limit of time is that of each request; that of memory is shared.
  limits_of_command().allow(0, memory_limit(options));
  const OpenFile in(::dup(STDIN_FILENO));
  const OpenFile out(::dup(STDOUT_FILENO));
  Wire wire(in, out, framing);
  begin(wire, {options, options.timeout, memory_limit(options) / threads});
  const bool is_understood = Server(wire, protocol, threads).run();
  if (end) end();
  return is_understood ? ExitCode::Met : ExitCode::BadInput;
}

ExitCode run_serve(const Options& options) {
  return serve(options, serve_protocol(), Framing::Headers, false);
}

ExitCode run_mcp(const Options& options) {
  return serve(options, mcp_protocol(), Framing::Lines, true);
}

}  // namespace btcheck

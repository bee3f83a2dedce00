// SPDX-License-Identifier: MIT
//
// `btcheck serve --stdio` and `btcheck mcp`: a process that stays.
#pragma once

#include <functional>

#include "cli/options/options.hpp"
#include "serve/asked.hpp"
#include "serve/server.hpp"

namespace btcheck {

// Met where the other side has ended it; BadInput where what it sent could not
// be understood.
ExitCode run_serve(const Options& options);
ExitCode run_mcp(const Options& options);

// Answers messages on standard input and output until they end; `begin` is
// called before the first, `end` behind the last.
ExitCode serve_messages(const Options& options, const Protocol& protocol,
                        Framing framing, unsigned threads,
                        const std::function<void(Wire&, const Service&)>& begin,
                        const std::function<void()>& end = {});

}  // namespace btcheck

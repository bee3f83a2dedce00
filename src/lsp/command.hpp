// SPDX-License-Identifier: MIT
//
// `btcheck lsp`: what editors ask while somebody types, by the Language Server
// Protocol 3.17.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Met where the editor has ended it as the protocol has it; Missed where it
// did not say so before; BadInput where what it sent could not be understood.
ExitCode run_lsp(const Options& options);

}  // namespace btcheck

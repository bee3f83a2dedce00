// SPDX-License-Identifier: MIT
//
// `btcheck explain`: what stands behind a code.
#pragma once

#include <string>

#include "cli/codes/codes.hpp"
#include "cli/options/options.hpp"

namespace btcheck {

// What it means, what to do, and the smallest example.
std::string explanation(const CodeRow& row);

// Every code with its summary, a line for each.
std::string code_list();

ExitCode run_explain(const Options& options);

}  // namespace btcheck

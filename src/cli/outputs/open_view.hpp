// SPDX-License-Identifier: MIT
//
// What the commands with --view share.
#pragma once

#include <chrono>

#include "cli/options/options.hpp"
#include "run/view/server.hpp"

namespace btcheck {

// How long the end of a run waits for those who look on.
inline constexpr std::chrono::milliseconds kViewPatience{2000};

// Opens the server on the port of --view and tells its address. False, once it
// is said why, where it cannot.
bool open_view(const Options& options, LiveServer& server);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// While something is written.
#pragma once

#include <mutex>

namespace btcheck {

// Held while something is printed to standard output or a file is written:
// whoever ends the process from another thread takes it first.
std::timed_mutex& output_mutex();

}  // namespace btcheck

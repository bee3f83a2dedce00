// SPDX-License-Identifier: MIT
//
// Messages about inputs, on stderr, and a result that goes to a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// The errors, then the warnings, then the notes: the first twenty of each.
// Those that differ by their line only are shown as one.
void show(const Options& options, const std::vector<Diagnostic>& diagnostics);

// The same as a text, in colours if they are wanted on that descriptor.
std::string shown(const Options& options,
                  const std::vector<Diagnostic>& diagnostics, int descriptor);

// An error that is in no file: `error[BT0004]: …`.
void complain(std::string_view code, std::string_view message);

// The text to the file, or to standard output when its name is "".
ExitCode write_output(const std::string& file, const std::string& text);

}  // namespace btcheck

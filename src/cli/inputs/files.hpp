// SPDX-License-Identifier: MIT
//
// Files in and out, and what can go wrong with them.
#pragma once

#include <string>
#include <string_view>

#include "check/check.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// The text of a file. A directory, a missing or unreadable file, or one of
// more than 64 MiB is a diagnostic.
Result<InputFile> read_file(const std::string& name);

// An error in a file as a whole, or about it.
Diagnostic file_error(std::string_view code, const std::string& name,
                      std::string message, std::string help = {});

// Writes a file as a whole: into a temporary one beside it, then renamed. A
// device or a pipe, /dev/stderr for instance, is written to directly. Returns
// what went wrong, or "".
std::string write_file(const std::string& name, const std::string& text);

// Adds the text to the end of a file, which is made if need be. Returns what
// went wrong, or "".
std::string append_file(const std::string& name, const std::string& text);

// Makes the directory if it is not there. Returns what went wrong, or "".
std::string make_directory(const std::string& name);

// `file`, as seen from the directory that `beside` is in.
std::string path_beside(const std::string& beside, const std::string& file);

}  // namespace btcheck

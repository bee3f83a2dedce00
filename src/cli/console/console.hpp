// SPDX-License-Identifier: MIT
//
// The one way out: everything that is printed goes through here. What people
// read is escaped first, so that a name in a tree can neither clear the screen
// nor recolour a verdict, nor give orders to a service that reads the log;
// formats that programs read keep every byte.
//
// Printing to standard output throws std::system_error when it cannot be
// written. Standard error is not worth a failure: what cannot be told is left
// out.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

namespace btcheck {

// Opens what the caller has closed of standard input, output and error, so that
// no file of ours gets their numbers: `2>&-` must not print messages into a
// report. Writing to what was closed fails as before.
void open_standard_files();

// The text escaped: `harmless`, and without a command of a continuous
// integration. GitHub obeys lines that begin with `::`, after blanks, and
// `##[` anywhere (actions/runner, ActionCommand.cs), Azure `##vso[`, TeamCity
// `##teamcity[`: the first sign is written out.
std::string readable(std::string_view text);

// To standard output, escaped.
void print(std::string_view text);
// As it is: for formats that programs read, and for text escaped before.
void print_exactly(std::string_view text);

// To standard error, escaped.
void tell(std::string_view text);
void tell_exactly(std::string_view text);

// The columns of the terminal that standard output is, kLineWidth at least;
// kLineWidth where it is none.
std::size_t terminal_width();

// Writes out what was printed so far.
void flush_output();

// A stream that prints when it is flushed, and at its end.
std::unique_ptr<std::ostream> printing_stream();

// Whether the terminal knows no escape sequences: without a TERM, or `dumb`.
bool is_dumb_terminal();

}  // namespace btcheck

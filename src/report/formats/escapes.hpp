// SPDX-License-Identifier: MIT
//
// Texts as the formats of reports can carry them. What an input or the name of
// a file may hold, a report may have to quote: control characters, broken
// UTF-8, and the marks of the format itself.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace btcheck {

// Valid UTF-8 without control characters but tab and line feed: each that is
// none becomes a `?`. A carriage return before a line feed is left out.
std::string plain_text(std::string_view text);

// Character data, and the value of an attribute, of XML 1.0.
std::string xml_text(std::string_view text);
std::string xml_attribute(std::string_view text);

// The message, and a property, of a workflow command of GitHub Actions.
std::string github_message(std::string_view text);
std::string github_property(std::string_view text);

// The plain text of a message in SARIF, where braces hold places for
// arguments and `[text](target)` is a link: there are neither in what we say.
std::string sarif_message(std::string_view text);

// One line of Markdown, in a cell of a table too: no character of it has a
// meaning there.
std::string markdown_text(std::string_view text);

// A file seen from `root`, where it lies below it; both may be relative to
// `directory`, which is absolute. What lies elsewhere stays absolute, or as it
// was written when it was relative.
std::string path_from(std::string_view root, std::string_view directory,
                      std::string_view file);

// A path as a URI reference: relative, or with the scheme `file`.
std::string uri_of(std::string_view path);

// 16 hexadecimal digits that are the same on every machine (FNV-1a).
std::string fingerprint(std::string_view text);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Texts from inputs, written so that the format of a report can carry them:
// control characters, broken UTF-8, and the marks of the format itself.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace btcheck {

// Valid UTF-8 without control characters other than tab and line feed: each of
// the others, and each broken byte, becomes a `?`. CR LF becomes a line feed.
std::string plain_text(std::string_view text);

// Character data, and the value of an attribute, of XML 1.0.
std::string xml_text(std::string_view text);
std::string xml_attribute(std::string_view text);

// The message, and a property, of a workflow command of GitHub Actions.
std::string github_message(std::string_view text);
std::string github_property(std::string_view text);

// The text of a message in SARIF. Braces and `](` are written so that nothing
// is taken for the place of an argument or for a link.
std::string sarif_message(std::string_view text);

// One line of Markdown, also fit for a cell of a table: no character of it has
// a meaning there.
std::string markdown_text(std::string_view text);

// The path of a file relative to `root`, where it lies below it; both may be
// relative to `directory`, which is absolute. What lies elsewhere stays
// absolute or, when it was relative, as it was written.
std::string path_from(std::string_view root, std::string_view directory,
                      std::string_view file);

// "a/t" for "a/t.btf"; the path itself where it has no ending.
std::string without_ending(std::string_view path);

// A path as a URI reference: relative, or with the scheme `file`.
std::string uri_of(std::string_view path);

// 16 hexadecimal digits that are the same on every machine (FNV-1a).
std::string fingerprint(std::string_view text);

}  // namespace btcheck

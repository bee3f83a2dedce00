// SPDX-License-Identifier: MIT
//
// Names and sentences out of somebody's file, made fit to be shown.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace btcheck {

// The first line of a text as valid UTF-8; what a terminal would obey, and
// bytes that are no UTF-8, are '?'.
std::string one_line(std::string_view text);

// Code points of a text that one_line has cleaned.
std::size_t letter_count(std::string_view text);

// The text, or its beginning and an ellipsis: at most `most` code points, which
// must be 1 or more. Takes what one_line gives.
std::string shortened(std::string_view text, std::size_t most);

// In double quotes, with a backslash before each of these and each backslash.
std::string quoted(std::string_view text);

// The name as a word: letters and digits of ASCII, `_`, the characters of
// `also`, and `_` for any other code point.
std::string plain_word(std::string_view name, std::string_view also = {});

// One line, as it stands in XML (text/utf8.hpp).
std::string xml_escaped(std::string_view text);

}  // namespace btcheck

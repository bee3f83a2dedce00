// SPDX-License-Identifier: MIT
//
// Sentences broken into lines.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace btcheck {

inline constexpr std::size_t kLineWidth = 80;

// The words of a text, as many as fit side by side into the width (a longer
// word has a line of its own). Each line but the first begins with `indent`
// blanks; the first is taken to begin there as well. Ends without a newline.
std::string wrapped(std::string_view text, std::size_t indent,
                    std::size_t width = kLineWidth);

}  // namespace btcheck

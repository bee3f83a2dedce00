// SPDX-License-Identifier: MIT
#include "text/wrapped_text.hpp"

#include <algorithm>

#include "text/utf8.hpp"

namespace btcheck {

std::string wrapped(std::string_view text, std::size_t indent,
                    std::size_t width) {
  std::string result;
  std::size_t column = indent;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end =
        std::min(text.find_first_of(" \n", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    const auto letters = static_cast<std::size_t>(count_code_points(word));
    if (!result.empty()) {
      const bool fits = column + 1 + letters <= width;
      result += fits ? " " : '\n' + std::string(indent, ' ');
      column = fits ? column + 1 : indent;
    }
    result += word;
    column += letters;
  }
  return result;
}

}  // namespace btcheck

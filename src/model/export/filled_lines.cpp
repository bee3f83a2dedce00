// SPDX-License-Identifier: MIT
//
// Greedy filling: a piece ends with its joint, and goes on the line as long as
// it fits.
#include "model/export/filled_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace btcheck {
namespace {

// The length of what goes on one line in one piece, up to the next joint.
std::size_t piece_length(std::string_view text,
                         std::initializer_list<std::string_view> joints) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const std::string_view joint : joints) {
      if (text.substr(at).starts_with(joint)) return at + joint.size() - 1;
    }
  }
  return text.size();
}

}  // namespace

std::string filled(std::string_view text, std::size_t indent,
                   std::string_view line_end,
                   std::initializer_list<std::string_view> joints) {
  constexpr std::size_t kWidth = 78;
  std::string result;
  std::size_t column = indent;
  while (!text.empty()) {
    const std::size_t length = piece_length(text, joints);
    if (!result.empty() && column + 1 + length > kWidth) {
      result += fmt::format("{}\n{:{}}", line_end, "", indent);
      column = indent;
    } else if (!result.empty()) {
      result += ' ';
      ++column;
    }
    result += text.substr(0, length);
    column += length;
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return result;
}

void append(std::string& text, std::string_view joint, std::string_view more) {
  if (!text.empty() && !more.empty()) text += joint;
  text += more;
}

}  // namespace btcheck

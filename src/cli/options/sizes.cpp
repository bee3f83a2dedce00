// SPDX-License-Identifier: MIT
#include "cli/options/sizes.hpp"

#include <exception>

namespace btcheck {

std::optional<std::uint64_t> bytes_in(const std::string& text) {
  std::size_t digits = 0;
  double number = 0;
  try {
    number = std::stod(text, &digits);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  const std::string unit = text.substr(digits);
  double factor = 1;
  if (unit == "k" || unit == "K")
    factor = 1024;
  else if (unit == "M")
    factor = 1024.0 * 1024;
  else if (unit == "G")
    factor = 1024.0 * 1024 * 1024;
  else if (!unit.empty())
    return std::nullopt;
  if (!(number * factor >= 1) || number * factor > 1e18) return std::nullopt;
  return static_cast<std::uint64_t>(number * factor);
}

}  // namespace btcheck

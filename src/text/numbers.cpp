// SPDX-License-Identifier: MIT
//
// Decimals stay whole numbers beside a count of decimals: nothing is rounded.
#include "text/numbers.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "text/utf8.hpp"

namespace btcheck {

// Both are exact, so that only the quotient is rounded.
double Decimal::nearest() const {
  double power = 1;
  for (int i = 0; i < decimals; ++i) power *= 10;
  return digits / power;
}

std::optional<Decimal> decimal_number(std::string_view text) {
  constexpr std::size_t kMostDecimals = 9;
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view before = text.substr(0, point);
  std::string_view behind = text.substr(std::min(point + 1, text.size()));
  if (before.empty() && behind.empty()) return std::nullopt;
  while (behind.ends_with('0')) behind.remove_suffix(1);
  if (behind.size() > kMostDecimals) return std::nullopt;
  std::int64_t digits = 0;
  for (const std::string_view part : {before, behind}) {
    for (const char digit : part) {
      if (!is_digit(digit)) return std::nullopt;
      digits = digits * 10 + (digit - '0');
      if (digits > std::int64_t{1} << 31) return std::nullopt;
    }
  }
  if (is_negative) digits = -digits;
  if (digits > std::numeric_limits<int>::max()) return std::nullopt;
  return Decimal{static_cast<int>(digits), static_cast<int>(behind.size())};
}

std::optional<std::uint64_t> bytes_in(const std::string& text) {
  std::size_t digits = 0;
  double number = 0;
  try {
    number = std::stod(text, &digits);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  const std::string unit = text.substr(digits);
  if (unit == "k" || unit == "K") {
    number *= 1 << 10;
  } else if (unit == "M") {
    number *= 1 << 20;
  } else if (unit == "G") {
    number *= 1 << 30;
  } else if (!unit.empty()) {
    return std::nullopt;
  }
  if (!(number >= 1) || number > 1e18) return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

}  // namespace btcheck

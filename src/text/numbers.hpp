// SPDX-License-Identifier: MIT
//
// Numbers in texts, and names that numbers tell apart.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

namespace btcheck {

// The number that a text begins with, and the number that all of it is: as
// std::from_chars reads them, so without blanks and `+` before them.
template <class Number>
std::optional<Number> begun_number(std::string_view text, bool to_end = false) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stopped, fault] = std::from_chars(text.data(), end, number);
  if (fault != std::errc{} || (to_end && stopped != end)) return std::nullopt;
  return number;
}
template <class Number>
std::optional<Number> as_number(std::string_view text) {
  return begun_number<Number>(text, true);
}

// digits / 10^decimals; 2.50 is 25 with one decimal.
struct Decimal {
  int digits = 0;
  int decimals = 0;

  double nearest() const;  // what the same text is read as
  friend bool operator==(const Decimal&, const Decimal&) = default;
};

// "5", "-0.25", "+.5"; nothing for what is no such number, has more than nine
// digits behind its point, or needs more than 32 bits without the point.
std::optional<Decimal> decimal_number(std::string_view text);

// "500M", "4G", "4096": bytes, at least one. Nothing for any other text.
std::optional<std::uint64_t> bytes_in(const std::string& text);

// The name, or where it is used already `name_2`, `name_3`, …
inline std::string unused_name(std::set<std::string>& used,
                               const std::string& name,
                               std::string_view mark = "_") {
  std::string candidate = name;
  for (int i = 2; !used.insert(candidate).second; ++i) {
    candidate = name + std::string(mark) + std::to_string(i);
  }
  return candidate;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Whole numbers as bytes, the least significant first.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace btcheck {

// The lowest `count` bytes of a number. A negative one comes as its complement.
inline void append_number(std::string& to, std::uint64_t value,
                          std::size_t count) {
  for (; count > 0; --count, value >>= 8) {
    to += static_cast<char>(value & 0xFFu);
  }
}

// The number in bytes at … at + count - 1, which must be there.
inline std::uint64_t number_at(std::string_view bytes, std::size_t at,
                               std::size_t count) {
  assert(count <= 8 && at <= bytes.size() && count <= bytes.size() - at);
  std::uint64_t value = 0;
  for (std::size_t i = count; i > 0; --i) {
    value = (value << 8) | static_cast<unsigned char>(bytes[at + i - 1]);
  }
  return value;
}

}  // namespace btcheck

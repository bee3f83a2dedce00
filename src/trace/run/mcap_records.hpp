// SPDX-License-Identifier: MIT
//
// MCAP (mcap.dev/spec): what a file begins and ends with, and the kinds of its
// records. A record is its kind, the length of its body in eight bytes, and its
// body.
#pragma once

#include <string_view>

namespace btcheck {

inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";

enum class McapRecord : unsigned char {
  Header = 0x01,
  Footer = 0x02,
  Schema = 0x03,
  Channel = 0x04,
  Message = 0x05,
  Chunk = 0x06,
  Metadata = 0x0C,
  DataEnd = 0x0F
};

}  // namespace btcheck

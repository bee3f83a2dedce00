// SPDX-License-Identifier: MIT
//
// Whether two inputs are the same, from 16 bytes of each (XXH3, 128 bits).
#pragma once

#include <string>
#include <string_view>

namespace btcheck {

// 32 hexadecimal digits, the same on every machine.
std::string content_hash(std::string_view text);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Amounts of memory as people write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace btcheck {

// "500M", "4G", "4096": bytes, at least one. Nothing for any other text.
std::optional<std::uint64_t> bytes_in(const std::string& text);

}  // namespace btcheck

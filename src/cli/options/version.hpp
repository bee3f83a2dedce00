// SPDX-License-Identifier: MIT
//
// The version that `--version` and every report name.
#pragma once

#include <string_view>

namespace btcheck {

inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace btcheck

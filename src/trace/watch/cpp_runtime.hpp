// SPDX-License-Identifier: MIT
//
// The part of a generated monitor that is the same for all rules.
#pragma once

#include <string_view>

namespace btcheck {

// What the tables are made of, and what reads them; C++17.
std::string_view cpp_runtime_head();
std::string_view cpp_runtime_body();

}  // namespace btcheck

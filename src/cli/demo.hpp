// SPDX-License-Identifier: MIT
//
// The texts of `btcheck demo`, compiled in from examples/ at build time.
#pragma once

#include <string_view>

namespace btcheck {

extern const std::string_view kDemoTree;
extern const std::string_view kDemoFixedTree;
extern const std::string_view kDemoProperties;

}  // namespace btcheck

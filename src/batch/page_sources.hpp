// SPDX-License-Identifier: MIT
//
// The page's form, style sheet and script, compiled in.
#pragma once

#include <string_view>

namespace btcheck {

extern const std::string_view kBatchPage;
extern const std::string_view kBatchStyle;
extern const std::string_view kBatchScript;

}  // namespace btcheck

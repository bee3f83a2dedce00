// SPDX-License-Identifier: MIT
//
// The text of btcheck/scripted_suite.hpp, for files that stand by themselves.
#pragma once

#include <string_view>

namespace btcheck {

extern const std::string_view kSuiteRunner;

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Findings as workflow commands of GitHub Actions, which annotate a change.
#pragma once

#include <cstddef>
#include <string>

#include "report/formats/reported.hpp"

namespace btcheck {

// GitHub shows so many errors, warnings and notices of a step; the others are
// counted.
inline constexpr std::size_t kMostAnnotations = 10;

std::string github_text(const Report& report);

}  // namespace btcheck

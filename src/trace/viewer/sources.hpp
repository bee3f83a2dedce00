// SPDX-License-Identifier: MIT
//
// The files of this folder, compiled in without what only their readers need.
#pragma once

#include <array>
#include <string_view>

namespace btcheck {

extern const std::string_view kViewerPage;
// In this order, a single style sheet and a single script.
extern const std::array<std::string_view, 2> kViewerStyles;
extern const std::array<std::string_view, 6> kViewerScripts;

}  // namespace btcheck

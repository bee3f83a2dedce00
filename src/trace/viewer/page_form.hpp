// SPDX-License-Identifier: MIT
//
// Pages are forms with gaps, `{{title}}` for instance.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace btcheck {

using Gaps = std::vector<std::pair<std::string_view, std::string>>;

// The form with its gaps filled, each of which it has, in this order. What goes
// into a gap is not looked at again.
std::string filled(std::string_view form, const Gaps& gaps);

}  // namespace btcheck

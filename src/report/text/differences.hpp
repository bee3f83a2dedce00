// SPDX-License-Identifier: MIT
//
// One tree, checked under two profiles: what the change from one release to the
// other changes.
#pragma once

#include <string>

#include "check/check.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

// Rules with another verdict, findings that come or go, and nodes that can do
// otherwise, each with a run; "" where nothing differs. Both results are of the
// same inputs, and have a tree.
std::string differences_text(const CheckResult& before,
                             const CheckResult& after, Layout layout);

}  // namespace btcheck

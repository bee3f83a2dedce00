// SPDX-License-Identifier: MIT
//
// What is told of a property's run beside its states.
#pragma once

#include <string>

#include "check/check.hpp"
#include "trace/run/record.hpp"

namespace btcheck {

// Of a verdict that has a run. `source` is the text of the tree's file.
RunHeading heading_of(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict,
                      const std::string& source);

}  // namespace btcheck

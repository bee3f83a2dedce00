// SPDX-License-Identifier: MIT
//
// `btcheck trace FILE --to FORMAT`: a run that was written before, converted.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "cli/options/options.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// The file's run in the format asked for: an ITF file of btcheck in any, a
// .btlog or .fbl log of BehaviorTree.CPP as text.
Result<std::string> converted(const InputFile& file, const Options& options);

}  // namespace btcheck

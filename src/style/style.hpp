// SPDX-License-Identifier: MIT
//
// The one way in which `btcheck fmt` writes a file: XML of BehaviorTree.CPP,
// .btf, leaf contracts and rules. Blanks, line breaks and the order of
// attributes are chosen, all else is kept.
#pragma once

#include <string>

#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

// The text as `btcheck fmt` writes it. Without a value the file cannot be read,
// or would say something else then, and the diagnostics tell why.
Result<std::string> styled(const InputFile& file);

}  // namespace btcheck

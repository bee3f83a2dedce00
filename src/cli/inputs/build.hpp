// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace btcheck {

// Which btcheck this is: a content hash of the running program, 32 hexadecimal
// digits. "" where the system does not say where the program lies.
const std::string& build_identity();

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The part of a generated monitor that is the same for all rules.
#pragma once

#include <string_view>

namespace btcheck {

// C++17, in the order in which it stands in a header.
struct CppRuntime {
  std::string_view about;     // how it is used, as a comment
  std::string_view includes;  // opens the namespace that all headers share
  std::string_view types;     // what the tables are made of; leaves theirs open
  std::string_view body;      // what reads them, and a logger
};
CppRuntime cpp_runtime();

}  // namespace btcheck

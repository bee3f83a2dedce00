// SPDX-License-Identifier: MIT
//
// The logs in tests/trace/data.
#pragma once

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace btcheck {

inline std::string data_file(const std::string& name) {
  std::ifstream stream(std::string(BTCHECK_TRACE_DATA) + "/" + name,
                       std::ios::binary);
  REQUIRE(stream.good());
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace btcheck

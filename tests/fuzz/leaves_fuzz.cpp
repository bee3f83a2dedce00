// SPDX-License-Identifier: MIT
//
// Fuzzes read_leaf_files and what is made of its rules: any bytes beside an XML
// tree give a tree whose parts fit together, or an error.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "../model/leaf_files_consistency.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string flaw = btcheck::flaw_of_leaves(text);
  if (!flaw.empty()) {
    std::fprintf(stderr, "%s\n", flaw.c_str());
    std::abort();
  }
  return 0;
}

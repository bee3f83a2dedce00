// SPDX-License-Identifier: MIT
//
// Fuzzes read_btcpp and expand_btcpp: any bytes give either a tree whose parts
// fit together, or an error.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "../model/btcpp_consistency.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  int expanded = 0;
  const std::string flaw = btcheck::flaw_of_reading(text, expanded);
  if (!flaw.empty()) {
    std::fprintf(stderr, "%s\n", flaw.c_str());
    std::abort();
  }
  return 0;
}

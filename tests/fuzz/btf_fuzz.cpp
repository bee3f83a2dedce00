// SPDX-License-Identifier: MIT
//
// Fuzzes read_btf: any bytes give either a consistent tree or an error.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "../model/btf_consistency.hpp"
#include "model/tree/tree.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto result = btcheck::read_btf("fuzz.btf", text);
  const std::string flaw = btcheck::flaw_of(result);
  if (!flaw.empty()) {
    std::fprintf(stderr, "%s\n", flaw.c_str());
    std::abort();
  }
  return 0;
}

// SPDX-License-Identifier: MIT
#include "fuzzed.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace btcheck {

void require(bool condition) {
  if (!condition) std::abort();
}

void require_none(std::string_view flaw) {
  if (flaw.empty()) return;
  std::fprintf(stderr, "%.*s\n", static_cast<int>(flaw.size()), flaw.data());
  std::abort();
}

}  // namespace btcheck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  btcheck::check_bytes({reinterpret_cast<const char*>(data), size});
  return 0;
}

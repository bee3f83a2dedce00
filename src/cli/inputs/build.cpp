// SPDX-License-Identifier: MIT
#include "cli/inputs/build.hpp"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace btcheck {
namespace {

std::string hash_of_program() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  std::vector<char> block(1 << 16);
  bool is_there = false;
  while (program.read(block.data(), static_cast<std::streamsize>(block.size())),
         program.gcount() > 0) {
    is_there = true;
    XXH3_128bits_update(&state, block.data(),
                        static_cast<std::size_t>(program.gcount()));
  }
  if (!is_there) return {};
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

const std::string& build_identity() {
  static const std::string identity = hash_of_program();
  return identity;
}

}  // namespace btcheck

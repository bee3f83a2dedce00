// SPDX-License-Identifier: MIT
//
// What only `btcheck batch` is told.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace btcheck {

// The part of a batch that one machine does: every `count`th entry, beginning
// with the one of number `index`, which counts from 1.
struct Shard {
  unsigned index = 1;
  unsigned count = 1;

  bool has(std::size_t entry) const { return entry % count + 1 == index; }
};

// "2/3"; nothing for any other text.
std::optional<Shard> shard_of(const std::string& text);

struct BatchOptions {
  std::vector<std::string> sources;  // folders and manifests
  unsigned jobs = 1;                 // entries checked at a time
  Shard shard;
  bool stops_early = false;  // --fail-fast
  bool resumes = false;      // --resume
  std::string page;          // --report; "" for none
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// So little room that everything goes to disk, in many small pieces.
#pragma once

#include <filesystem>

#include "explore/large/scratch.hpp"

namespace btcheck {

inline Scratch tiny_scratch() {
  Scratch scratch;
  scratch.folder = std::filesystem::temp_directory_path().string();
  scratch.words_in_memory = 0;
  scratch.words_in_block = 16;
  scratch.fewest_gathered = 64;
  scratch.most_gathered = 64;
  return scratch;
}

}  // namespace btcheck

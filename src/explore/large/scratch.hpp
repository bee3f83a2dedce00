// SPDX-License-Identifier: MIT
//
// Where a search puts what has no room in memory: files without a name, which
// nobody else sees and which are gone with the process, however it ends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "explore/state/transition_system.hpp"

namespace btcheck {

struct Scratch {
  std::string folder;  // none: nothing goes to disk
  // Runs of words (sorted_run.hpp) up to this long stay in memory.
  std::size_t words_in_memory = std::size_t{1} << 20;
  std::size_t words_in_block = std::size_t{1} << 14;  // of those on disk
  // So many words are gathered before they are sorted, at most and at least;
  // between the two, as many as the memory limit allows.
  std::size_t most_gathered = std::size_t{1} << 26;
  std::size_t fewest_gathered = std::size_t{1} << 16;

  // The same for a search that may hold so much: a run in memory is a small
  // part of that, and so is what is gathered.
  Scratch within(std::uint64_t bytes) const {
    Scratch fitting = *this;
    const auto words = static_cast<std::size_t>(
        std::max<std::uint64_t>(bytes / 64 / sizeof(Word), words_in_block));
    fitting.words_in_memory = std::min(words_in_memory, words);
    fitting.fewest_gathered = std::min(fewest_gathered, words);
    return fitting;
  }

  // How many words to gather in about so much memory.
  std::size_t words_within(std::uint64_t bytes) const {
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(
        bytes / sizeof(Word), fewest_gathered, most_gathered));
  }
};

// The disk is full, or fails. what() names the folder and the reason.
class ScratchFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A file in the folder, already without a name. Every member throws
// ScratchFault.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& folder);
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile();

  void append(std::span<const std::byte> bytes);
  void read(std::uint64_t offset, std::span<std::byte> into) const;
  std::uint64_t size() const { return size_; }

 private:
  [[noreturn]] void fail(int error) const;

  std::string folder_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace btcheck

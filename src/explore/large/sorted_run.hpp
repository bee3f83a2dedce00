// SPDX-License-Identifier: MIT
//
// Words in ascending order, each once: in memory where they are few, else on
// disk, in blocks of differences, which zstd makes smaller still. A block that
// is not read as it was written is a fault, never other words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "explore/large/scratch.hpp"
#include "explore/state/transition_system.hpp"

namespace btcheck {

class SortedRun {
 public:
  SortedRun() = default;
  // In memory, whatever its length.
  explicit SortedRun(std::vector<Word> words)
      : size_(words.size()), words_(std::move(words)) {}

  std::uint64_t size() const { return size_; }
  // Held in memory, and on disk.
  std::size_t bytes() const {
    return words_.capacity() * sizeof(Word) +
           blocks_.capacity() * sizeof(Block);
  }
  std::uint64_t bytes_on_disk() const { return bytes_on_disk_; }

 private:
  friend class RunWriter;
  friend class RunCursor;
  // Where the words from `first` on lie in the file.
  struct Block {
    Word first = 0;
    std::uint64_t offset = 0;
    std::uint64_t hash = 0;  // of its bytes in the file
    std::uint32_t bytes = 0;
    std::uint32_t words = 0;
  };

  std::uint64_t size_ = 0;
  std::vector<Word> words_;  // of a run in memory
  std::vector<Block> blocks_;
  std::uint64_t bytes_on_disk_ = 0;
  std::shared_ptr<ScratchFile> file_;
};

// Throws ScratchFault.
class RunWriter {
 public:
  // `scratch` must outlive the writer. With a file, which many runs may share,
  // all goes there.
  explicit RunWriter(const Scratch& scratch,
                     std::shared_ptr<ScratchFile> file = nullptr)
      : scratch_(scratch) {
    if (file) most_waiting_ = scratch.words_in_block;
    run_.file_ = std::move(file);
  }

  // In ascending order, each word once.
  void add(Word word) {
    waiting_.push_back(word);
    if (waiting_.size() > most_waiting_) spill();
  }
  SortedRun finish();

 private:
  void spill();
  void write(std::span<const Word> words);

  const Scratch& scratch_;
  std::size_t most_waiting_ =
      std::max(scratch_.words_in_memory, scratch_.words_in_block);
  SortedRun run_;
  std::vector<Word> waiting_;
  std::vector<std::byte> plain_;
  std::vector<std::byte> packed_;
};

// Reads a run from its first word to its last. Throws ScratchFault.
class RunCursor {
 public:
  // The run must outlive it.
  explicit RunCursor(const SortedRun& run) : run_(&run) { to_next_block(); }
  RunCursor(RunCursor&&) = default;  // a copy would read the other's words
  RunCursor& operator=(RunCursor&&) = default;

  bool is_at_end() const { return at_ == words_.size(); }
  Word word() const { return words_[at_]; }
  void advance() {
    if (++at_ == words_.size()) to_next_block();
  }

  // Whether the run has this word; to be asked in ascending order. What lies
  // between two questions is passed over, whole blocks unread.
  bool contains(Word word) {
    if (is_at_end()) return false;
    if (words_.back() < word && !skip_to(word)) return false;
    advance_to(word);
    return words_[at_] == word;
  }

 private:
  void to_next_block();
  void read(std::size_t block);
  bool skip_to(Word word);
  // To the first word not below this one, which there is in the block.
  void advance_to(Word word) {
    std::size_t step = 1;
    std::size_t end = at_;
    while (end < words_.size() && words_[end] < word) {
      at_ = end;
      end += step;
      step *= 2;
    }
    const auto begin = words_.begin();
    at_ = static_cast<std::size_t>(
        std::lower_bound(
            begin + static_cast<std::ptrdiff_t>(at_),
            begin + static_cast<std::ptrdiff_t>(std::min(end, words_.size())),
            word) -
        begin);
  }

  const SortedRun* run_;
  std::size_t next_block_ = 0;
  std::span<const Word> words_;  // of the present block
  std::size_t at_ = 0;
  std::vector<Word> unpacked_;
  std::vector<std::byte> packed_;
  std::vector<std::byte> plain_;
};

}  // namespace btcheck

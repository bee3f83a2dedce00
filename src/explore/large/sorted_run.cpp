// SPDX-License-Identifier: MIT
//
// A block begins anew: its first word stands in the index, the others as the
// difference to the one before, seven bits to a byte, the lowest first.
#include "explore/large/sorted_run.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>
#include <zstd.h>

#include <string>
#include <utility>

namespace btcheck {
namespace {

constexpr int kLevel = 1;  // higher ones cost more time than they save
constexpr std::size_t kMostBytesPerWord = 10;

void add_difference(std::vector<std::byte>& bytes, Word difference) {
  while (difference >= 0x80) {
    bytes.push_back(static_cast<std::byte>(difference | 0x80));
    difference >>= 7;
  }
  bytes.push_back(static_cast<std::byte>(difference));
}

Word next_difference(const std::byte*& at) {
  Word difference = 0;
  for (int shift = 0;; shift += 7) {
    const auto byte = static_cast<Word>(*at++);
    difference |= (byte & 0x7f) << shift;
    if (byte < 0x80) return difference;
  }
}

std::size_t checked(std::size_t result) {
  if (ZSTD_isError(result) == 0) return result;
  throw ScratchFault(std::string("zstd: ") + ZSTD_getErrorName(result));
}

}  // namespace

// The first words that are too many for memory make the file; from then on it
// takes block after block.
void RunWriter::spill() {
  if (!run_.file_) {
    run_.file_ = std::make_shared<ScratchFile>(scratch_.folder);
    most_waiting_ = scratch_.words_in_block;
  }
  std::span<const Word> words = waiting_;
  while (!words.empty()) {
    const std::size_t count = std::min(words.size(), scratch_.words_in_block);
    write(words.first(count));
    words = words.subspan(count);
  }
  run_.size_ += waiting_.size();
  waiting_.clear();
}

void RunWriter::write(std::span<const Word> words) {
  plain_.clear();
  for (std::size_t i = 1; i < words.size(); ++i) {
    add_difference(plain_, words[i] - words[i - 1]);
  }
  packed_.resize(ZSTD_compressBound(plain_.size()));
  const std::size_t size = checked(ZSTD_compress(
      packed_.data(), packed_.size(), plain_.data(), plain_.size(), kLevel));
  run_.blocks_.push_back({words.front(), run_.file_->size(),
                          XXH3_64bits(packed_.data(), size),
                          static_cast<std::uint32_t>(size),
                          static_cast<std::uint32_t>(words.size())});
  run_.file_->append({packed_.data(), size});
  run_.bytes_on_disk_ += size;
}

SortedRun RunWriter::finish() {
  if (run_.file_) {
    spill();
  } else {
    waiting_.shrink_to_fit();
    run_ = SortedRun(std::move(waiting_));
  }
  return std::move(run_);
}

void RunCursor::to_next_block() {
  at_ = 0;
  if (run_->file_ == nullptr) {
    words_ = next_block_ == 0 ? std::span<const Word>(run_->words_)
                              : std::span<const Word>();
    ++next_block_;
  } else if (next_block_ < run_->blocks_.size()) {
    read(next_block_);
  } else {
    words_ = {};
  }
}

void RunCursor::read(std::size_t number) {
  const SortedRun::Block& block = run_->blocks_[number];
  next_block_ = number + 1;
  packed_.resize(block.bytes);
  run_->file_->read(block.offset, packed_);
  if (XXH3_64bits(packed_.data(), packed_.size()) != block.hash) {
    throw ScratchFault("a scratch file is not read as it was written");
  }
  plain_.resize(block.words * kMostBytesPerWord);
  checked(ZSTD_decompress(plain_.data(), plain_.size(), packed_.data(),
                          packed_.size()));
  unpacked_.resize(block.words);
  const std::byte* at = plain_.data();
  Word word = block.first;
  for (std::size_t i = 0; i < unpacked_.size(); ++i) {
    if (i > 0) word += next_difference(at);
    unpacked_[i] = word;
  }
  words_ = unpacked_;
  at_ = 0;
}

// To the last block that begins at or below the word; whether it has words not
// below it. Else the cursor is at the first word above.
bool RunCursor::skip_to(Word word) {
  const std::vector<SortedRun::Block>& blocks = run_->blocks_;
  const auto above = std::upper_bound(
      blocks.begin() +
          static_cast<std::ptrdiff_t>(std::min(next_block_, blocks.size())),
      blocks.end(), word, [](Word wanted, const SortedRun::Block& block) {
        return wanted < block.first;
      });
  const auto number = static_cast<std::size_t>(above - blocks.begin());
  if (number > next_block_) {
    read(number - 1);
    if (words_.back() >= word) return true;
  }
  to_next_block();
  return false;
}

}  // namespace btcheck

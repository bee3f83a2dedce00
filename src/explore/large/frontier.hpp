// SPDX-License-Identifier: MIT
//
// The states of one depth, in blocks that threads take and fill on their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "explore/state/transition_system.hpp"

namespace btcheck {

// Up to 512 states, as pairs (pair_coding.hpp).
class FrontierBlock {
 public:
  static constexpr std::size_t kMost = 512;

  FrontierBlock() : pairs_(new Word[kMost]) {}

  bool is_full() const { return count_ == kMost; }
  void add(Word pair) { pairs_[count_++] = pair; }
  std::span<const Word> pairs() const { return {pairs_.get(), count_}; }

 private:
  std::unique_ptr<Word[]> pairs_;
  std::size_t count_ = 0;
};

class Frontier {
 public:
  void add(Word pair) {
    if (blocks_.empty() || blocks_.back().is_full()) blocks_.emplace_back();
    blocks_.back().add(pair);
  }
  // Moves all of another's blocks behind one's own.
  void take(Frontier& other) {
    for (FrontierBlock& block : other.blocks_) {
      blocks_.push_back(std::move(block));
    }
    other.blocks_.clear();
  }
  const std::vector<FrontierBlock>& blocks() const { return blocks_; }
  std::uint64_t size() const {
    std::uint64_t size = 0;
    for (const FrontierBlock& block : blocks_) size += block.pairs().size();
    return size;
  }
  std::size_t bytes() const {
    return blocks_.size() *
           (FrontierBlock::kMost * sizeof(Word) + sizeof(FrontierBlock));
  }

 private:
  std::vector<FrontierBlock> blocks_;
};

}  // namespace btcheck

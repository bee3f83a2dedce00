// SPDX-License-Identifier: MIT
//
// An array that grows while others read it: elements never move. Chunks of
// 65536 elements come one after another, straight from the kernel and all
// zero; memory that nobody has written yet costs nothing. What a search keeps
// for each half of a state vector lies in these.
#pragma once

#include <sys/mman.h>

#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#include "explore/store/huge_pages.hpp"

namespace btcheck {

// `T` must be meaningful when all its bytes are zero, and need no destructor.
// Each index stands for a row of `width` elements.
template <class T>
class ChunkedArray {
 public:
  explicit ChunkedArray(std::size_t width = 1)
      : width_(width), chunks_(new std::atomic<T*>[kMostChunks]()) {}
  ChunkedArray(const ChunkedArray&) = delete;
  ChunkedArray& operator=(const ChunkedArray&) = delete;
  ~ChunkedArray() {
    for (std::size_t i = 0; i < kMostChunks && chunks_[i] != nullptr; ++i) {
      ::munmap(chunks_[i], chunk_bytes());
    }
  }

  // The row of an index that `reach` has been called with.
  T* operator[](std::uint32_t index) const {
    T* chunk = chunks_[index >> kChunkBits].load(std::memory_order_acquire);
    assert(chunk != nullptr || width_ == 0);
    return chunk + (index & kChunkMask) * width_;
  }

  // Makes room for an index. May be called by several threads at once.
  // Throws std::bad_alloc.
  void reach(std::uint32_t index) {
    const std::size_t number = index >> kChunkBits;
    if (width_ == 0) return;
    if (number >= kMostChunks) throw std::bad_alloc();
    for (std::size_t i = number + 1; i > 0; --i) {
      if (chunks_[i - 1].load(std::memory_order_acquire) != nullptr) break;
      add(i - 1);
    }
  }

  // Of memory in use, when `count` rows are.
  std::size_t bytes(std::size_t count) const {
    return count * width_ * sizeof(T);
  }

 private:
  static constexpr int kChunkBits = 16;
  static constexpr std::uint32_t kChunkMask = (1u << kChunkBits) - 1;
  static constexpr std::size_t kMostChunks = 1u << 12;

  std::size_t chunk_bytes() const {
    return (std::size_t{1} << kChunkBits) * width_ * sizeof(T);
  }

  void add(std::size_t number) {
    void* memory = mapped(chunk_bytes());
    T* none = nullptr;
    if (!chunks_[number].compare_exchange_strong(none,
                                                 static_cast<T*>(memory))) {
      ::munmap(memory, chunk_bytes());
    }
  }

  std::size_t width_;
  std::unique_ptr<std::atomic<T*>[]> chunks_;
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The array of what a search keeps for each state: it grows without a copy of
// it ever being held, so that a limit of memory can be kept.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "explore/store/huge_pages.hpp"

namespace btcheck {

// Small ones lie in the heap. From 4 MiB on the array is a mapping of its own,
// on pages of 2 MiB where the kernel has them, whose pages move to a larger
// range of addresses when it is full. Memory that no element has reached costs
// nothing. Growing throws std::bad_alloc; elements move, as in a vector.
template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  GrowingArray() = default;
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    swap(other);
    return *this;
  }
  ~GrowingArray() {
    if (is_mapped()) {
      ::munmap(data_, capacity_);
    } else {
      std::free(data_);
    }
  }

  void push_back(const T& value) {
    const T kept = value;  // it may be an element
    make_room(size_ + 1);
    data_[size_++] = kept;
  }
  // The elements must not be the array's own.
  void append(std::span<const T> values) {
    make_room(size_ + values.size());
    std::copy(values.begin(), values.end(), data_ + size_);
    size_ += values.size();
  }
  void resize(std::size_t size, const T& value = {}) {
    if (size > size_) {
      make_room(size);
      std::fill(data_ + size_, data_ + size, value);
    }
    size_ = size;
  }
  void pop_back() {
    assert(size_ > 0);
    --size_;
  }
  void clear() { size_ = 0; }

  T* data() { return data_; }
  const T* data() const { return data_; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  T& operator[](std::size_t i) {
    assert(i < size_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return data_[i];
  }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // Of memory in use.
  std::size_t bytes() const { return size_ * sizeof(T); }

 private:
  bool is_mapped() const { return capacity_ >= kLargeTable; }

  void make_room(std::size_t size) {
    if (size * sizeof(T) > capacity_) grow(size * sizeof(T));
  }

  void grow(std::size_t needed) {
    const std::size_t more = is_mapped() ? capacity_ / 4 : capacity_;
    std::size_t bytes = std::max({needed, capacity_ + more, std::size_t{64}});
    void* larger = nullptr;
    if (bytes < kLargeTable) {
      larger = std::realloc(data_, bytes);
      if (larger == nullptr) throw std::bad_alloc();
    } else {
      bytes = (bytes + kHugePage - 1) / kHugePage * kHugePage;
      larger = moved_to(aligned_range(bytes), bytes);
    }
    data_ = static_cast<T*>(larger);
    capacity_ = bytes;
  }

  void* moved_to(void* range, std::size_t bytes) {
    if (is_mapped()) {
      void* moved = ::mremap(data_, capacity_, bytes,
                             MREMAP_MAYMOVE | MREMAP_FIXED, range);
      if (moved == MAP_FAILED) throw std::bad_alloc();
      return moved;
    }
    ::madvise(range, bytes, MADV_HUGEPAGE);  // a hint: may be refused
    if (size_ > 0) std::memcpy(range, data_, size_ * sizeof(T));
    std::free(data_);
    return range;
  }

  // Fresh memory that begins at a multiple of the large page.
  static void* aligned_range(std::size_t bytes) {
    auto* const first = static_cast<std::byte*>(mapped(bytes + kHugePage));
    const std::size_t before =
        -reinterpret_cast<std::uintptr_t>(first) % kHugePage;
    if (before > 0) ::munmap(first, before);
    ::munmap(first + before + bytes, kHugePage - before);
    return first + before;
  }

  void swap(GrowingArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;      // elements
  std::size_t capacity_ = 0;  // bytes
};

}  // namespace btcheck

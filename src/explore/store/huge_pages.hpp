// SPDX-License-Identifier: MIT
//
// Memory for tables that are read at random, on large pages where it pays.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>

namespace btcheck {

// An allocator for std::vector. A table of some million slots is read all over
// the place, and on pages of 4 KiB nearly every read also misses the address
// translation; the kernel is asked for pages of 2 MiB from 4 MiB on.
template <class T>
struct HugePages {
  using value_type = T;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kLarge) return static_cast<T*>(::operator new(bytes));
    const std::size_t rounded = (bytes + kPage - 1) / kPage * kPage;
    void* memory = std::aligned_alloc(kPage, rounded);
    if (memory == nullptr) throw std::bad_alloc();
    ::madvise(memory, rounded, MADV_HUGEPAGE);  // a hint: may be refused
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < kLarge) {
      ::operator delete(memory);
    } else {
      std::free(memory);
    }
  }

  friend bool operator==(const HugePages&, const HugePages&) { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t{2} << 20;
  static constexpr std::size_t kLarge = 2 * kPage;
};

// Memory that begins as zeros. What fills whole pages of 2 MiB lies on such,
// the rest on small ones, so that nothing is held beyond what was asked for.
// All of it is fetched from the kernel at once: a page that is read before it
// is written would otherwise be mapped twice, and the second time stops every
// other thread.
class ZeroedPages {
 public:
  ZeroedPages() = default;
  // Throws std::bad_alloc.
  explicit ZeroedPages(std::size_t bytes) : bytes_(bytes) {
    void* memory = ::mmap(nullptr, bytes + slack(), PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    mapped_ = static_cast<std::byte*>(memory);
    const auto address = reinterpret_cast<std::uintptr_t>(mapped_);
    data_ = mapped_ + (slack() == 0 ? 0 : kHuge - address % kHuge);
    if (slack() != 0) ::madvise(data_, bytes / kHuge * kHuge, MADV_HUGEPAGE);
    fetch();
  }
  ZeroedPages(ZeroedPages&& other) noexcept { swap(other); }
  ZeroedPages& operator=(ZeroedPages&& other) noexcept {
    swap(other);
    return *this;
  }
  ~ZeroedPages() {
    if (mapped_ != nullptr) ::munmap(mapped_, bytes_ + slack());
  }

  void* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHuge = std::size_t{2} << 20;

  // To begin at a multiple of the large page.
  std::size_t slack() const { return bytes_ < kHuge ? 0 : kHuge; }

  void fetch() {
#ifdef MADV_POPULATE_WRITE
    ::madvise(data_, bytes_, MADV_POPULATE_WRITE);  // as above: a hint
#endif
  }
  void swap(ZeroedPages& other) {
    std::swap(mapped_, other.mapped_);
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
  }

  std::byte* mapped_ = nullptr;
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace btcheck

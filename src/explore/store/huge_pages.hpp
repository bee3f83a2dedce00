// SPDX-License-Identifier: MIT
//
// Memory for tables that are read at random, on large pages where it pays.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace btcheck {

inline constexpr std::size_t kHugePage = std::size_t{2} << 20;
// Tables lie on such pages from here on.
inline constexpr std::size_t kLargeTable = 2 * kHugePage;

// Fresh memory, all zero; pages that nobody has written cost nothing. Throws
// std::bad_alloc.
inline void* mapped(std::size_t bytes) {
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return memory;
}

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
    if (bytes < kLargeTable) return static_cast<T*>(::operator new(bytes));
    const std::size_t rounded = (bytes + kHugePage - 1) / kHugePage * kHugePage;
    void* memory = std::aligned_alloc(kHugePage, rounded);
    if (memory == nullptr) throw std::bad_alloc();
    ::madvise(memory, rounded, MADV_HUGEPAGE);  // a hint: may be refused
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < kLargeTable) {
      ::operator delete(memory);
    } else {
      std::free(memory);
    }
  }

  friend bool operator==(const HugePages&, const HugePages&) = default;
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
  explicit ZeroedPages(std::size_t bytes) {
    // To begin at a multiple of the large page.
    const std::size_t slack = bytes < kHugePage ? 0 : kHugePage;
    mapped_ = {static_cast<std::byte*>(mapped(bytes + slack)),
               Unmap{bytes, bytes + slack}};
    if (slack != 0) {
      ::madvise(data(), bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
    }
#ifdef MADV_POPULATE_WRITE
    ::madvise(data(), bytes, MADV_POPULATE_WRITE);  // as above: a hint
#endif
  }

  void* data() const {
    const auto address = reinterpret_cast<std::uintptr_t>(mapped_.get());
    return mapped_.get() +
           (bytes() < kHugePage ? 0 : kHugePage - address % kHugePage);
  }
  std::size_t bytes() const { return mapped_.get_deleter().bytes; }

 private:
  struct Unmap {
    std::size_t bytes;
    std::size_t mapped_bytes;
    void operator()(std::byte* memory) const { ::munmap(memory, mapped_bytes); }
  };

  std::unique_ptr<std::byte, Unmap> mapped_;
};

}  // namespace btcheck

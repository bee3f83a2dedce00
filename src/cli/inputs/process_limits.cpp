// SPDX-License-Identifier: MIT
#include "cli/inputs/process_limits.hpp"

#include <malloc.h>
#include <unistd.h>

#include <cstdio>

// AddressSanitizer keeps several times the program's own memory beside it.
#if defined(__SANITIZE_ADDRESS__)
#define BTCHECK_HAS_ASAN
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define BTCHECK_HAS_ASAN
#endif
#endif
#ifdef BTCHECK_HAS_ASAN
#include <sanitizer/allocator_interface.h>
#endif

namespace btcheck {
namespace {

// Half of the second in which a command ends after its limit.
constexpr double kTelling = 0.5;

}  // namespace

#ifdef BTCHECK_HAS_ASAN

std::uint64_t held_bytes() { return __sanitizer_get_current_allocated_bytes(); }

#else

// The second number of /proc/self/statm: resident pages.
std::uint64_t held_bytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  unsigned long long size = 0;
  unsigned long long resident = 0;
  const int found = std::fscanf(file, "%llu %llu", &size, &resident);
  std::fclose(file);
  if (found != 2) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

#endif

double ProcessLimits::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                       start_)
      .count();
}

// What an earlier search has given back may still be with the allocator: it is
// asked to return that before anybody is stopped for it.
StopReason ProcessLimits::reached(bool is_interrupted) {
  StopReason reason = StopReason::None;
  if (is_interrupted) {
    reason = StopReason::Interrupted;
  } else if (timeout_ > 0 && seconds() >= timeout_) {
    reason = StopReason::Timeout;
  } else if (held_bytes() > max_bytes_) {
    ::malloc_trim(0);
    if (held_bytes() > max_bytes_) reason = StopReason::Memory;
  }
  if (reason != StopReason::None && !stopped_at_) stopped_at_ = seconds();
  return reason;
}

bool ProcessLimits::may_tell(bool is_interrupted) {
  if (!stopped_at_) reached(is_interrupted);
  return !stopped_at_ || seconds() - *stopped_at_ < kTelling;
}

}  // namespace btcheck

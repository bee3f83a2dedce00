// SPDX-License-Identifier: MIT
//
// When a search must stop before it is done, and how it tells where it stands.
#pragma once

#include <cstdint>
#include <string>

namespace btcheck {

enum class StopReason : std::uint8_t {
  None,
  MaxStates,
  Memory,
  Timeout,
  Interrupted,
  Disk,             // full, or it fails
  FormulaTooLarge,  // its automaton exceeded a bound; nothing was searched
  OpenEntries       // what was found rests on values that are not known
};

struct SearchProgress {
  std::uint64_t states = 0;       // stored
  std::uint64_t expanded = 0;     // of these, with all successors computed
  std::uint64_t transitions = 0;  // steps that change the state
  std::uint64_t depth = 0;        // steps (breadth-first) or stack height
  std::uint64_t bytes = 0;        // held by the search
};

// Asked every few thousand states whether to go on. Clocks and signals live
// behind this interface, at the rim.
class SearchMonitor {
 public:
  virtual ~SearchMonitor() = default;
  virtual StopReason observe(const SearchProgress& progress) = 0;
  // Whether there is time and memory left to tell what has been found, for a
  // moment also after a search has been stopped.
  virtual bool may_tell() { return true; }
  // Whether half of the time and memory is left, for what is not needed.
  virtual bool has_spare() { return true; }
  // Told while the search goes on: what has been found so far, in lines.
  virtual void found(const std::string& /*lines*/) {}
};

struct Limits {
  std::uint64_t max_states = UINT64_MAX;
  std::uint64_t max_bytes = UINT64_MAX;
  SearchMonitor* monitor = nullptr;  // may be null

  // The limit that `progress` has reached, after asking the monitor.
  StopReason reached(const SearchProgress& progress) const {
    if (progress.states >= max_states) return StopReason::MaxStates;
    if (progress.bytes >= max_bytes) return StopReason::Memory;
    return monitor != nullptr ? monitor->observe(progress) : StopReason::None;
  }
  bool may_tell() const { return monitor == nullptr || monitor->may_tell(); }
  bool has_spare() const { return monitor == nullptr || monitor->has_spare(); }
};

// Searches ask their limits each time this many states were expanded.
inline constexpr std::uint64_t kPollInterval = 1024;

}  // namespace btcheck

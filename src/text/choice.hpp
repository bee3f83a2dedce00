// SPDX-License-Identifier: MIT
//
// What its user can choose, in the words of whoever talks to that user.
//
// A help such as "describe them by --leaves" is made far below the command
// line. It names a Choice: the program says `--leaves`, and a caller of
// btcheck/check.hpp, who has no command line, is told of the field `leaves`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace btcheck {

enum class Choice : std::uint8_t {
  Assume,
  Disk,
  Export,
  Format,
  Leaves,
  Loop,
  MainTree,
  MaxStates,
  Memory,
  Models,
  Profile,
  Reduce,
  Rules,
  Tick,
  TickGap,
  TickMs,
  Ticks,
  Timeout,
  Topic,
  TraceDir,
  WakeUps
};

// "--leaves", or "`leaves`" where the user fills in a request.
std::string_view word(Choice choice);
// "--tick root", or "`ticks = root`".
std::string word(Choice choice, std::string_view value);

// What this thread says while the scope lives is read by who made a request.
class SpeaksOfRequests {
 public:
  SpeaksOfRequests();
  ~SpeaksOfRequests();
  SpeaksOfRequests(const SpeaksOfRequests&) = delete;
  SpeaksOfRequests& operator=(const SpeaksOfRequests&) = delete;

 private:
  bool before_;
};

}  // namespace btcheck

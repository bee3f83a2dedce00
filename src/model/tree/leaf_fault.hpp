// SPDX-License-Identifier: MIT
//
// What may be wrong with a leaf: faults that are put into a tree to see what
// the mission does then (`btcheck whatif`).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace btcheck {

enum class FaultKind : std::uint8_t {
  Fails,          // whenever it is asked; of a condition: it says no
  FailsOnce,      // one of its answers, whichever
  FailsOn,        // from one of its answers on
  Succeeds,       // a condition that says yes whenever it is asked
  NeverEnds,      // from one of its answers on it runs
  EndsLate,       // whenever it runs, by so many ticks
  Inverted,       // a condition: the wrong way round, whenever it is asked
  FlipsOnce,      // the same for one answer
  Halted,         // once while it runs, behind the back of its parent
  WritesNothing,  // it succeeds, and what it should write stays as it is
  WritesOther,    // it succeeds, and writes another value
  Throws          // instead of one of its answers
};
inline constexpr std::size_t kFaultKinds = 12;

// When a fault strikes. Those of the first sort are there from the first time
// on that the leaf is asked; the others are there when it pleases them.
enum class Strikes : std::uint8_t { Always, Once, FromThenOn };

struct FaultFacts {
  FaultKind kind{};
  std::string_view word;  // in tables and files: "fails-once"
  std::string_view told;  // of a leaf: "fails once"
  Strikes strikes{};
};
inline constexpr std::array<FaultFacts, kFaultKinds> kFaults = {{
    {FaultKind::Fails, "fails", "fails whenever it is asked", Strikes::Always},
    {FaultKind::FailsOnce, "fails-once", "fails once", Strikes::Once},
    {FaultKind::FailsOn, "fails-for-ever", "fails from some tick on",
     Strikes::FromThenOn},
    {FaultKind::Succeeds, "says-yes", "says yes whenever it is asked",
     Strikes::Always},
    {FaultKind::NeverEnds, "never-ends", "never ends", Strikes::FromThenOn},
    {FaultKind::EndsLate, "late", "ends late", Strikes::Always},
    {FaultKind::Inverted, "inverted", "answers the wrong way round",
     Strikes::Always},
    {FaultKind::FlipsOnce, "flips-once", "answers the wrong way round once",
     Strikes::Once},
    {FaultKind::Halted, "halted", "is halted while it runs", Strikes::Once},
    {FaultKind::WritesNothing, "writes-nothing", "succeeds and writes nothing",
     Strikes::Always},
    {FaultKind::WritesOther, "writes-other", "writes another value",
     Strikes::Always},
    {FaultKind::Throws, "throws", "throws an exception", Strikes::Once},
}};
constexpr const FaultFacts& facts_of(FaultKind kind) {
  return kFaults[static_cast<std::size_t>(kind)];
}
constexpr std::optional<FaultKind> fault_kind(std::string_view word) {
  const auto* found = std::ranges::find(kFaults, word, &FaultFacts::word);
  if (found == kFaults.end()) return std::nullopt;
  return found->kind;
}

// A fault of a leaf. In its automaton it has a local of LocalRole::Fault.
struct LeafFault {
  FaultKind kind{};
  int late = 0;  // EndsLate: ticks for which it runs before it may end

  friend bool operator==(const LeafFault&, const LeafFault&) = default;
};

// Of that local: whether the fault has struck yet, and whether it is over.
enum class FaultPhase : std::uint8_t { NotYet, There, Over };

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Monitors: what a beginning of a run says about a rule.
//
// A rule about runs is watched with three verdicts (Bauer, Leucker and
// Schallhart, "Runtime verification for LTL and TLTL", TOSEM 2011): satisfied
// by every continuation, violated by every one, or open. A monitor is the
// smallest deterministic automaton that says so at the earliest moment at which
// it can be said, where any labels may follow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "ltl/formula/formula.hpp"
#include "ltl/timed/timed_pattern.hpp"

namespace btcheck {

enum class Outlook : std::uint8_t {
  Open,
  Satisfied,  // by every continuation, of those that are assumed
  Violated,   // by every one of these
  Excluded    // there is none: what is assumed is not so
};
inline constexpr std::array<std::string_view, 4> kOutlookNames = {
    "OPEN", "SATISFIED", "VIOLATED", "EXCLUDED"};

// Reads the label of each state of a run in turn, the first one included. Only
// the propositions of `reads` matter: bit i of a letter is the i-th of them.
struct Monitor {
  std::vector<PropositionSet> reads;             // single bits, ascending
  std::vector<std::vector<std::uint32_t>> next;  // by state, letter
  std::vector<Outlook> outlook;                  // by state; 0 is the first

  std::uint32_t letter(PropositionSet label) const {
    std::uint32_t letter = 0;
    for (std::size_t i = 0; i < reads.size(); ++i) {
      if ((label & reads[i]) != 0) letter |= std::uint32_t{1} << i;
    }
    return letter;
  }
  // Some beginning of a run leads to this outlook.
  bool can_be(Outlook wanted) const;
};

// Bounds on a monitor while it is made.
inline constexpr std::size_t kMostMonitorLetters = 1024;
inline constexpr std::size_t kMostMonitorEntries = 1'000'000;

// Of a formula of LTL where a formula is assumed; atom i is bit i. Nothing when
// it would be larger than the bounds.
std::optional<Monitor> monitor_of(FormulaPool& pool, FormulaId claim,
                                  FormulaId assumed);

// Of a real-time pattern. Bit `elapsed` of a label says that a unit of time has
// passed since the label before; of several units, each has a label.
std::optional<Monitor> monitor_of(const TimedPattern& pattern,
                                  PropositionSet elapsed);

// A monitor on its way along one run. Where a proposition is not known, each
// way it could be is followed, and only what all of them say is said.
class MonitorRun {
 public:
  // The monitor must outlive it.
  explicit MonitorRun(const Monitor& monitor);

  // `unknown` counts for nothing in the label.
  Outlook read(PropositionSet label, PropositionSet unknown = 0);
  // Or any number of such labels more, none included.
  Outlook read_more(PropositionSet label, PropositionSet unknown);
  Outlook outlook() const { return outlook_; }
  // How many ways are followed, and whether they say different things.
  std::size_t ways() const { return states_.size(); }
  bool is_torn() const { return is_torn_; }

 private:
  void settle();
  // Adds to `next_` where the states lead.
  void follow(PropositionSet label, PropositionSet unknown);

  const Monitor* monitor_;
  std::vector<std::uint32_t> states_{0};  // ascending, each once
  std::vector<std::uint32_t> next_;
  Outlook outlook_ = Outlook::Open;
  bool is_torn_ = false;
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Rules asked of a run of the engine, by their definitions: a second opinion
// for monitors. Of src only the reader of rules is used.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "btcpp_random/engine_events.hpp"
#include "ltl/rules/property.hpp"

namespace btcheck::reference {

struct NaiveVerdict {
  std::string rule;
  std::string verdict = "OPEN";  // SATISFIED, VIOLATED, or TOO LARGE
  // The state in which it was decided.
  std::size_t events = 0;
  std::size_t records = 0;
  int tick = 0;
};

// In the order of the file. Throws where a rule asks for what is not known
// here.
std::vector<NaiveVerdict> naive_verdicts(const EngineRun& run,
                                         const PropertyFile& rules);

// "r1 VIOLATED tick 3 record 17 event 42"
std::string shown(const NaiveVerdict& verdict);

}  // namespace btcheck::reference

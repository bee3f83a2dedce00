// SPDX-License-Identifier: MIT
//
// Rules about single states that speak of the answers of several nodes, read as
// they are mostly meant: of whole ticks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/search/engine.hpp"
#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// A rule said of whole ticks.
struct TickReading {
  std::string rule;  // `in no tick: a.answer == failure and …`
  // Answers of several nodes that the rule, as it is written, forbids together:
  // all of them events, which hold for an instant, or all of them levels.
  std::vector<std::string> together;
  bool are_events = false;
  // Where these are events of running alone: the rule of the statuses that last
  // between them, `never (a.status == running and …)`; else "".
  std::string of_levels = {};
};

// What is told beside the verdict of a rule.
struct TickAdvice {
  std::string rule;
  Verdict verdict = Verdict::Undecided;  // of the reading
};

// The reading of a rule that says that some condition never or always holds,
// if that names answers of two nodes at least: events, or the status that is
// kept of them. Everything else in it must mean the same at the end of a tick.
std::optional<TickReading> tick_reading(const BehaviorTree& tree,
                                        const PropertyFile& file,
                                        const Property& property);

// For each verdict of the file the reading that may have been meant instead.
// One that holds because the events it forbids never stand in the same instant,
// though each happens, becomes vacuous; so does one over levels where the
// reading is violated. Where the reading holds, too, and the statuses that last
// do stand together, it is these that are named. One that is violated gets a
// reading that holds.
std::vector<std::optional<TickAdvice>> tick_advice(
    const BehaviorTree& tree, const PropertyFile& file, const Network& network,
    const SearchChoices& choices, const Limits& limits,
    std::vector<PropertyVerdict>& verdicts);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The rules that explain a run, each a sentence or "".
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "check/bind/verdict.hpp"
#include "trace/why/story.hpp"

namespace btcheck::reasons {

// What an explanation may look at.
struct Case {
  const Story& story;
  const Subjects& subjects;
  // The part of the run in which something is missing: its loop, else what
  // follows the trigger, else the last unit of time.
  StepRange part;
};

// What the control nodes do (why_control.cpp).
std::string runs_for_ever(const Case& about);
std::string passes_over(const Case& about);
std::string halts_sibling(const Case& about);
std::string has_ended(const Case& about);
std::string nobody_moves(const Case& about);

// What becomes of values, and what the world chooses (why_values.cpp).
std::string ends_in_fault(const Case& about);
std::string changes_meanwhile(const Case& about);
std::string last_choice(const Case& about);

}  // namespace btcheck::reasons

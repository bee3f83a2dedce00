// SPDX-License-Identifier: MIT
//
// One check of a batch: a tree, its property files, and how.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "cli/options/options.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// How an entry is checked, where it says so; the rest is said by the command
// line, for all entries.
struct EntryChoices {
  std::optional<Profile> profile;
  std::optional<int> tick_ms;
  std::optional<bool> loops;
  std::optional<bool> wakes;
  std::optional<std::string> main_tree;
  std::optional<std::vector<std::string>> leaves;
  std::optional<TickSemantics> ticks;
  std::optional<SearchOrder> search;
  std::optional<Reduction> reduce;
  std::optional<ExtraAssumption> assume;
  std::optional<unsigned> threads;
  std::optional<std::uint64_t> max_states;
  std::optional<std::uint64_t> max_bytes;
  std::optional<double> timeout;  // seconds; 0: none
};

// The first, and what it leaves open as the second says.
EntryChoices completed(EntryChoices choices, const EntryChoices& by);

// The command line with what an entry says of itself.
Options applied(Options options, const EntryChoices& choices);

// A verdict that the manifest expects, whatever the property file says.
struct ExpectedVerdict {
  std::string property;
  Expectation expectation = Expectation::None;
  Diagnostic place;  // where it is written: what to say if there is no such one
};

struct BatchEntry {
  std::string name;    // what reports call it; no other entry has it
  std::string folder;  // of its runs, below --trace-dir; nor has any this
  std::string input;   // a tree, or a property file that names its tree
  std::vector<std::string> properties;
  EntryChoices choices;
  std::vector<ExpectedVerdict> expected;
  std::vector<Diagnostic> diagnostics;  // with an error: it is not checked
};

}  // namespace btcheck

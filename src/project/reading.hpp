// SPDX-License-Identifier: MIT
//
// How a tree is read, as far as somebody says it: a command line, an entry of a
// manifest, a btcheck.toml, a program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "model/tree_file.hpp"
#include "project/sources.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Nothing where nothing is said.
struct ReadingChoices {
  std::optional<Profile> profile;
  std::optional<TickSemantics> ticks;
  std::optional<int> tick_ms;
  std::optional<bool> loops;
  std::optional<bool> wakes;
  std::optional<std::string> main_tree;
  // Names of files.
  std::optional<std::vector<std::string>> models;
  std::optional<std::vector<std::string>> leaves;
  std::string enums;  // as a file of contracts, "(defenum RED 1)"; or ""
};

// What is said for all trees of a project, as far as it has a meaning for this
// one: no profile of the other kind, and no models, contracts and wake-ups
// beside a .btf tree.
ReadingChoices fitting(ReadingChoices choices, bool is_xml);

// What is said, and where nothing is, what is said below it.
ReadingChoices over(ReadingChoices said, const ReadingChoices& below);

// Reads the models and contracts that are named, and what an XML tree asks for.
// Nothing, and why in `found`, where a file that is named cannot be read, or
// what is asked for has no meaning for the tree.
std::optional<TreeReading> reading_of(const InputFile& tree,
                                      const ReadingChoices& how,
                                      Sources& sources,
                                      std::vector<Diagnostic>& found);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What a check has against a tree, so that two checks can be compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/edits/edited_files.hpp"
#include "text/repair.hpp"

namespace btcheck {

struct Problem {
  std::string code;
  SourcePlace place;  // line 0: the file as a whole
  bool is_note = false;

  bool is_at(const Problem& other) const {
    return code == other.code && place == other.place;
  }
};

Problem problem_of(const Diagnostic& diagnostic);
Problem problem_of(const TreeFinding& finding, const BehaviorTree& tree);

// Those of the readers, all findings, and those that others speak for.
std::vector<Problem> problems_of(const CheckResult& result);

// As it stands in files that were edited meanwhile; nothing where it is not to
// be found there.
std::optional<Problem> moved(const Problem& problem, const EditedFiles& files);

// Everything was searched and could be told.
bool is_complete(const CheckResult& result);

// A fault of the tree or a mission that cannot succeed, that was not there; a
// rule that held, and does not.
bool breaks_something(const CheckResult& before, const CheckResult& after);

// The most states that one search has stored.
std::uint64_t most_states(const CheckResult& result);

}  // namespace btcheck

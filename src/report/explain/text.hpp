// SPDX-License-Identifier: MIT
//
// Why a run ended so, told to people and to programs.
#pragma once

#include <string>

#include "model/tree/tree.hpp"
#include "trace/explain/explain.hpp"

namespace btcheck {

struct ExplainedRun {
  const std::string& name;  // of the log
  const BehaviorTree& tree;
  const ExplainedLog& log;
  const Explanation& found;
};

std::string explain_text(const ExplainedRun& run);

// An object of schemas/run-explanation.schema.json.
std::string explain_json(const ExplainedRun& run);

// "fails whenever it is asked (3 times)": the faults of a suspect in words, as
// far as the log tells them apart.
std::string suspect_text(const LogMoments& moments, const Suspect& suspect);

}  // namespace btcheck

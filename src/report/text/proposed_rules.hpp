// SPDX-License-Identifier: MIT
//
// `btcheck init`: a file of rules to begin with.
#pragma once

#include <string>
#include <vector>

#include "check/check.hpp"
#include "report/exit_code.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct ProposedRules {
  ExitCode code = ExitCode::BadInput;
  std::string text;  // of a file of rules; "" where the tree cannot be read
  std::vector<Diagnostic> diagnostics;
};

// `named` is how the rules name their tree, "" where they do not.
ProposedRules proposed_rules(const TreeInput& tree, const std::string& named,
                             const CheckOptions& options);

}  // namespace btcheck

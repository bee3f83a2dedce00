// SPDX-License-Identifier: MIT
//
// What the user has said of findings: which are meant, and which are not to be.
#pragma once

#include <string>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Takes out what a comment at the node allows, in its line or in those right
// above it: `<!-- btcheck: allow BT2208: the last recovery ends it -->`, in
// .btf files `; btcheck: allow BT2205`. Returns how many.
std::size_t take_allowed(std::vector<TreeFinding>& findings,
                         const BehaviorTree& tree,
                         const std::vector<SourceText>& files);

// `denied` holds codes, and "warnings" for all of them: those are errors.
bool is_denied(const std::vector<std::string>& denied, std::string_view code,
               Severity severity);

}  // namespace btcheck

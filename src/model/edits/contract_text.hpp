// SPDX-License-Identifier: MIT
//
// A file of leaf contracts, with something more said of its leaves: as a person
// would write it, and all else left as it stands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck {

// One thing that a contract says: `:may-be-cut-off no` of `Clean`.
struct LeafClause {
  NodeType leaf{};      // Action or Condition
  std::string name;     // as contracts have it, in quotes where it needs them
  std::string keyword;  // "may-be-cut-off"
  std::string value;    // "no"; "" for none; "(Drive)": a list
};

// "(defaction Clean :may-be-cut-off no)".
std::string contract_of(const LeafClause& clause);

// The text of a file with the clause: in the contract that the leaf has there,
// or in a new one at the end. What was said otherwise before is not said any
// more; to a list, what is not in it is added.
std::string with_clause(std::string_view text, const LeafClause& clause);

}  // namespace btcheck

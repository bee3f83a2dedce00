// SPDX-License-Identifier: MIT
//
// What may be wrong with a tree, and what would show that it is.
//
// Each kind of fault is looked for in the tree as it is written. What is found
// there is a suspicion. It becomes a finding when the search has seen what it
// names, and nothing that would clear it; one that names nothing is true of
// every run as the tree stands.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/replay/run_tree.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "text/repair.hpp"

namespace btcheck {

// One finding for one cause.
struct TreeFinding {
  std::string_view code;  // "BT2207"
  Severity severity = Severity::Warning;
  NodeId node{};                    // to blame
  std::vector<NodeId> others = {};  // what is affected, in pre-order
  std::string message = {};         // what happens
  std::string why = {};             // the mechanism; stands under the carets
  std::string help = {};            // the repair
  std::optional<KeptRun> run = {};  // that shows it
  // The repair as edits of the file, the best first; and one that was checked.
  std::vector<Repair> repairs = {};
  std::optional<CheckedRepair> repair = {};
  std::vector<NodeId> folded = {};  // others of this kind that it speaks for
  int rank = 0;                     // of a question: the smaller, the earlier
};

// What the file does not say and its owner knows. Its code is of a family of
// its own, and it is told in a line, after the findings; unless it has been
// answered, and the tree does what the answer says that it may not.
inline bool is_question(const TreeFinding& finding) {
  return finding.severity == Severity::Note && finding.code.starts_with("BT25");
}
// How many of a tree are shown before the rest is counted.
inline constexpr std::size_t kShownQuestions = 5;
// Of what a finding says that the tree does: whether it may. `said` is what the
// owner of its leaves has answered; where that is no, `against` says what the
// answer was, as in "`clean` may not be cut off".
TreeFinding asked(TreeFinding finding, std::string_view question,
                  std::optional<bool> said, std::string_view against);

// A step with which a node gets to a place, while others have these statuses.
struct Sighting {
  NodeId node{};
  LocationRole role{};
  std::vector<std::pair<NodeId, NodeStatus>> with = {};  // NoRetStatus: not yet
  // A node that has begun its work again after a failure.
  std::optional<NodeId> retried = {};

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

// What a node answers next, with nothing of the world outside in between.
struct Consequence {
  NodeId node{};
  LocationRole answer{};

  friend bool operator==(const Consequence&, const Consequence&) = default;
};

struct Suspicion {
  TreeFinding finding;
  std::vector<Sighting> shown_by = {};  // any of them, and then this:
  std::optional<Consequence> then = {};
  std::optional<Consequence> after = {};  // an answer earlier on the run
  std::vector<Sighting> cleared_by = {};  // any of them
};

}  // namespace btcheck

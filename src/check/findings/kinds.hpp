// SPDX-License-Identifier: MIT
//
// The kinds of findings, each with the file that looks for it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "check/findings/facts.hpp"
#include "check/findings/suspicion.hpp"
#include "text/budget.hpp"

namespace btcheck {

using Suspicions = std::vector<Suspicion>;

// What every family of kinds looks at, and where it puts what it finds.
class Look {
 public:
  Look(const TreeFacts& facts, Suspicions& found)
      : facts_(facts), found_(found) {}

 protected:
  std::string told(NodeId node) const { return facts_.told(node); }
  Suspicion& add(TreeFinding finding);
  // An Inverter that turns round what is done below it, and not just a
  // question.
  Suspicion& add_inverted(NodeId inverter, NodeId deed);
  // What one of its scripts reads, by BehaviorTree::entries: its own one where
  // `when` is nothing.
  std::vector<std::uint32_t> entries_of(NodeId node,
                                        std::optional<ScriptTime> when) const;
  // The nodes that write any of them, by a port or a script.
  std::vector<NodeId> writers_of(
      const std::vector<std::uint32_t>& entries) const;
  SourcePlace place(NodeId node) const { return facts_.place(node); }
  SourcePlace whole(NodeId node) const { return facts_.whole(node); }

  const TreeFacts& facts_;
  Suspicions& found_;
};

template <typename Family>
void look_at_nodes(const TreeFacts& facts, Family& family) {
  for (std::uint32_t n = 0; n < facts.tree().nodes.size(); ++n) {
    ask_budget();
    family.look_at(NodeId{n}, facts.node(NodeId{n}));
  }
}

// A failure, or a warning, after which the mission goes on as if nothing had
// happened; a success that counts as failure.
void suspect_failure_flow(const TreeFacts& facts, Suspicions& found);
// A failure, or an answer, that a decorator or a last child throws away.
void suspect_swallowed(const TreeFacts& facts, Suspicions& found);
// An attempt that succeeds because the event it answers to is used up.
void suspect_lost_events(const TreeFacts& facts, Suspicions& found);
// Guards that cannot interrupt what they guard.
void suspect_guards(const TreeFacts& facts, Suspicions& found);
// Branches that interrupt themselves, or begin anew in each tick.
void suspect_restarts(const TreeFacts& facts, Suspicions& found);
// Branches that end as soon as they have had an effect, or on a moment's
// notice.
void suspect_chases(const TreeFacts& facts, Suspicions& found);
// Loops without a way out, and Parallels that cut off or never decide.
void suspect_endings(const TreeFacts& facts, Suspicions& found);
// Ports that are read on a run that has not come to what writes them.
void suspect_unwritten(const TreeFacts& facts, Suspicions& found);
// Entries that are set and not reset; what is begun and not ended.
void suspect_lasting(const TreeFacts& facts, Suspicions& found);
// What is possible as the tree stands, and perhaps meant.
void suspect_open_questions(const TreeFacts& facts, Suspicions& found);

}  // namespace btcheck

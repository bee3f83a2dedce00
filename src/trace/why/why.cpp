// SPDX-License-Identifier: MIT
//
// A counterexample is a list of facts; its reader asks which of them matters.
// No theory of causes is at work here (Beer et al., "Explaining
// counterexamples using causality", 2009, has one): a few patterns in which
// the semantics of behavior trees surprises people are looked for, the most
// specific first, and the first one that is really there is told. A fault goes
// before all others, because it is what ends the run.
#include "trace/why/why.hpp"

#include "model/tree/node_types.hpp"
#include "trace/why/rules.hpp"
#include "trace/why/story.hpp"

namespace btcheck {
namespace {

StepRange part_to_explain(const Story& story,
                          std::optional<std::size_t> trigger_state) {
  if (story.loop()) return *story.loop();
  StepRange part = story.all();
  if (trigger_state) {
    part.begin = *trigger_state;
    return part;
  }
  for (std::size_t i = 0; i < part.end; ++i) {
    if (story.run().steps[i].step.elapsed > 0) part.begin = i + 1;
  }
  return part;
}

}  // namespace

std::string why(const BehaviorTree& tree, const Network& network,
                const Run& run, const Subjects& subjects,
                std::optional<std::size_t> trigger_state) {
  const Story story(tree, network, run);
  const reasons::Case about{story, subjects,
                            part_to_explain(story, trigger_state)};
  for (const auto rule :
       {reasons::ends_in_fault, reasons::runs_for_ever, reasons::passes_over,
        reasons::halts_sibling, reasons::has_ended, reasons::changes_meanwhile,
        reasons::nobody_moves, reasons::last_choice}) {
    std::string sentence = rule(about);
    if (!sentence.empty()) return sentence;
  }
  return "";
}

std::vector<NodeId> running_for_ever(const BehaviorTree& tree,
                                     const Network& network, const Run& run) {
  const Story story(tree, network, run);
  std::vector<NodeId> found;
  if (!story.loop()) return found;
  const StepRange loop = *story.loop();
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const NodeId node{n};
    if (tree.nodes[n].type != NodeType::Action || tree.nodes[n].duration) {
      continue;
    }
    const bool ends = story.enters(loop, node, LocationRole::Success) ||
                      story.enters(loop, node, LocationRole::Failure) ||
                      story.enters(loop, node, LocationRole::Halted);
    if (!ends && story.enters(loop, node, LocationRole::Tick) &&
        story.enters(loop, node, LocationRole::Running)) {
      found.push_back(node);
    }
  }
  return found;
}

}  // namespace btcheck

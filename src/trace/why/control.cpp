// SPDX-License-Identifier: MIT
//
// Explanations from what the control nodes do: they wait for an action that
// never ends, they resume one child and pass others over, they halt.
#include <fmt/format.h>

#include <algorithm>

#include "model/tree/node_types.hpp"
#include "model/tree/reads.hpp"
#include "text/choice.hpp"
#include "trace/run/skipping.hpp"
#include "trace/why/story.hpp"
#include "trace/why/why.hpp"

namespace btcheck::reasons {
namespace {

bool is_guard(const Node& node) {
  return node.type == NodeType::Condition || node.type == NodeType::SetSV ||
         (node.type == NodeType::Eval && !node.assignment);
}

bool concerns(const Case& about, const Node& guard) {
  const auto& variables = about.subjects.variables;
  return std::ranges::any_of(variables, [&](StateVariableId variable) {
    return guard.type == NodeType::SetSV ? guard.variable == variable
                                         : reads(guard.expression, variable);
  });
}

// Nodes that a reader of the property expects to be ticked, and that have been
// before: those that are awaited, else guards that it is about.
std::vector<NodeId> expected_to_be_ticked(const Case& about) {
  const BehaviorTree& tree = about.tree;
  std::vector<NodeId> nodes = about.subjects.awaited;
  if (!nodes.empty()) return nodes;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const bool is_named = contains(about.subjects.nodes, NodeId{n});
    if (is_guard(tree.nodes[n]) &&
        (is_named || concerns(about, tree.nodes[n]))) {
      nodes.push_back(NodeId{n});
    }
  }
  return nodes;
}

// The leaf that a step ticks although it has been running before.
std::optional<NodeId> ticked_again(const Story& story, std::size_t step) {
  const auto node = story.entering(step, LocationRole::Tick);
  if (!node || !is_leaf(story.tree.node(*node).type) ||
      story.status(step, *node) != NodeStatus::Running) {
    return std::nullopt;
  }
  return node;
}

// True if the node's last call before the step was of this child, and no other
// was called first in the same tick.
bool went_straight_to(const Story& story, NodeId node, NodeId child,
                      std::size_t before) {
  std::optional<NodeId> called;
  for (auto i = story.last_move(node, before); i;
       i = story.last_move(node, *i)) {
    const Location& reached = story.target(*i);
    if (reached.role == LocationRole::Tick) return called == child;
    if (reached.role != LocationRole::Call) continue;
    if (called) return false;
    called = reached.child;
  }
  return false;
}

// The node that goes on with `running`, ticked by the step, and thereby does
// not come past `missing`, which stands to the left.
std::optional<NodeId> who_passes(const Story& story, NodeId missing,
                                 NodeId running, std::size_t step) {
  const auto fork = fork_of(story.tree, missing, running);
  if (!fork || fork->one >= fork->other) return std::nullopt;
  const Node& node = story.tree.node(fork->node);
  if (info_of(node.type).beside != Beside::None ||
      !went_straight_to(story, fork->node, node.children[fork->other], step)) {
    return std::nullopt;
  }
  return fork->node;
}

// Who halts a node, and with which step.
struct Halt {
  NodeId by{};
  std::size_t step = 0;
};

// The last step before `before` with which a node halts this child.
std::optional<std::size_t> last_halting(const Story& story, NodeId child,
                                        std::size_t before) {
  const NodeId parent = story.tree.node(child).parent;
  auto i = story.last_move(parent, before);
  while (i && (story.status(*i, child) == NodeStatus::HaltMe ||
               story.status(*i + 1, child) != NodeStatus::HaltMe)) {
    i = story.last_move(parent, *i);
  }
  return i;
}

// True if the node takes the step because it was asked to halt.
bool is_asked_to_halt(const Story& story, NodeId node, std::size_t step) {
  auto i = story.last_move(node, step);
  while (i && story.source(*i).role != LocationRole::Start) {
    i = story.last_move(node, *i);
  }
  return i && story.target(*i).role == LocationRole::Halt;
}

// Up from a node that is halted by step `before`: to the one that halts
// without having been asked to halt itself.
std::optional<Halt> origin_of_halt(const Story& story, NodeId node,
                                   std::size_t before) {
  const BehaviorTree& tree = story.tree;
  for (; !tree.node(node).is_root(); node = tree.node(node).parent) {
    const auto step = last_halting(story, node, before);
    if (!step) return std::nullopt;
    const NodeId by = tree.node(node).parent;
    if (!is_asked_to_halt(story, by, *step)) return Halt{by, *step};
    before = *step;
  }
  return std::nullopt;
}

// What the node goes on to answer when all are halted.
std::optional<LocationRole> next_answer(const Story& story, const Halt& halt) {
  const Automaton& automaton = *story.mover(halt.step);
  for (const Edge& edge : automaton.edges) {
    const LocationRole role = automaton.target(edge).role;
    if (edge.source == story.edge(halt.step).source && is_end(role)) {
      return role;
    }
  }
  return std::nullopt;
}

// Why a node began to halt its children: the answer of a child or what it found
// itself, whichever came last; "" when it is not to be seen.
std::string reason_to_halt(const Story& story, const Halt& halt) {
  const BehaviorTree& tree = story.tree;
  if (info_of(tree.node(halt.by).type).beside == Beside::Counted) {
    const auto answer = next_answer(story, halt);
    if (answer == LocationRole::Success) {
      return "enough of its children have succeeded";
    }
    if (answer == LocationRole::Failure) {
      return "too many of its children have failed";
    }
    return "";
  }
  for (auto i = story.last_move(halt.by, halt.step); i;
       i = story.last_move(halt.by, *i)) {
    // What the world has chosen, or a timer brought about.
    const Edge& edge = story.edge(*i);
    if ((edge.asks_world || edge.tells_why) && !edge.label.empty()) {
      return edge.label;
    }
    const Location& left = story.source(*i);
    if (left.role == LocationRole::Tick) return "";
    if (left.role != LocationRole::Called) continue;
    const auto status = static_cast<std::size_t>(story.status(*i, left.child));
    return fmt::format("{} returned {}", story.name(left.child),
                       status_names(tree.profile)[status]);
  }
  return "";
}

// That the node, or the one above the awaited one, is skipped for the last time
// in the part to explain; "" where it is not, or nothing says why.
std::string skipped_in(const Case& about, NodeId node, NodeId awaited) {
  for (std::size_t i = about.part.end; i-- > about.part.begin;) {
    if (!about.moves(i, node)) continue;
    const RunStep& step = about.run.steps[i];
    if (!begins_to_skip(about.network, step)) continue;
    const std::string reason =
        reason_to_skip(about.tree, about.network, about.run.state(i), step);
    if (reason.empty()) return "";
    const std::string when = about.when(i);
    return fmt::format(
        "{}{} is skipped{}{} because {}.", about.name(node),
        node == awaited ? "" : ", above " + about.name(awaited) + ",",
        when.empty() ? "" : " ", when, reason);
  }
  return "";
}

}  // namespace

std::string runs_for_ever(const Case& about) {
  const std::vector<NodeId> nodes =
      running_for_ever(about.tree, about.network, about.run);
  if (nodes.empty()) return "";
  return fmt::format(
      "{} {} running for ever, and nothing says that an action must end. "
      "`{}` leaves such runs out.",
      about.names(nodes), nodes.size() == 1 ? "returns" : "return",
      word(Choice::Assume, "actions-end"));
}

std::string passes_over(const Case& about) {
  for (const NodeId missing : expected_to_be_ticked(about)) {
    if (about.enters(about.part, missing, LocationRole::Tick)) continue;
    if (!about.enters({0, about.part.begin}, missing, LocationRole::Tick))
      continue;
    for (std::size_t i = about.part.begin; i < about.part.end; ++i) {
      const auto running = ticked_again(about, i);
      if (!running) continue;
      const auto passes = who_passes(about, missing, *running, i);
      if (!passes) continue;
      return fmt::format(
          "{} goes on with {}, which was running, and does not tick {} again.",
          about.name(*passes), about.name(*running), about.name(missing));
    }
  }
  return "";
}

std::string halts_sibling(const Case& about) {
  std::vector<NodeId> nodes = about.subjects.awaited;
  nodes.insert(nodes.end(), about.subjects.nodes.begin(),
               about.subjects.nodes.end());
  for (const NodeId node : nodes) {
    const auto halted =
        about.last_entering(about.part, node, LocationRole::Halted);
    if (!halted ||
        about.enters({*halted, about.part.end}, node, LocationRole::Tick)) {
      continue;
    }
    const auto halt = origin_of_halt(about, node, *halted);
    if (!halt) continue;
    const std::string reason = reason_to_halt(about, *halt);
    if (reason.empty()) continue;
    return fmt::format("{} halts {} because {}.", about.name(halt->by),
                       about.name(node), reason);
  }
  return "";
}

// An answer is waited for of a node that is skipped, or is not ticked because
// one above it is.
std::string is_skipped(const Case& about) {
  for (const NodeId awaited : about.subjects.awaited) {
    const bool is_ticked =
        about.enters(about.part, awaited, LocationRole::Tick);
    for (NodeId node = awaited;; node = about.tree.node(node).parent) {
      const std::string sentence = skipped_in(about, node, awaited);
      if (!sentence.empty()) return sentence;
      if (is_ticked || about.tree.node(node).is_root()) break;
    }
  }
  return "";
}

// An answer is waited for, and the one tree there is has ended.
std::string has_ended(const Case& about) {
  const BehaviorTree& tree = about.tree;
  const NodeId root = tree.roots[0];
  if (about.subjects.awaited.empty() || tree.roots.size() > 1 ||
      tree.node(root).loop) {
    return "";
  }
  for (std::size_t i = 0; i < about.all().end; ++i) {
    const bool succeeds = about.enters(i, root, LocationRole::Success);
    if (!succeeds && !about.enters(i, root, LocationRole::Failure)) continue;
    // What is missing must be missing still, a unit of time or a loop later.
    const StepRange rest{std::max(i + 1, about.part.begin), about.all().end};
    bool goes_on = about.loop().has_value();
    for (std::size_t k = i + 1; k < about.all().end; ++k) {
      goes_on |= about.run.steps[k].step.elapsed > 0;
    }
    if (!goes_on || rest.begin >= rest.end) return "";
    const bool waits_for_root = contains(about.subjects.awaited, root);
    const std::string when = about.when(i);
    return fmt::format(
        "{} has {}{}{}, and a tree that has ended {}.", tree.node(root).name,
        succeeds ? "succeeded" : "failed", when.empty() ? "" : " ", when,
        waits_for_root ? "stays as it is" : "ticks no node any more");
  }
  return "";
}

std::string nobody_moves(const Case& about) {
  if (!about.loop()) return "";
  for (std::size_t i = about.part.begin; i < about.part.end; ++i) {
    if (about.is_edge(i) || about.run.state(i) != about.run.state(i + 1)) {
      return "";
    }
  }
  // The node that has been called last and has not given control back.
  for (std::size_t i = about.part.begin; i > 0; --i) {
    const auto node = about.entering(i - 1, LocationRole::Tick);
    if (!node || about.tree.node(*node).is_root()) continue;
    const VariableId caller = *about.network.node_caller[index(*node)];
    if (about.run.state(about.part.begin).variables[index(caller)] == 0) {
      continue;
    }
    return about.name(*node) +
           " has been ticked and gives no answer; nothing can happen any more.";
  }
  return "";
}

}  // namespace btcheck::reasons

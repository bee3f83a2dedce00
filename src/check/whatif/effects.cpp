// SPDX-License-Identifier: MIT
#include "check/whatif/effects.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// A loop that is told is no longer than so many arcs.
constexpr std::size_t kMostShownArcs = 200;

// On from a state that has no way out, until it is where it has been before.
void add_round(const AnswerGraph& graph, std::uint32_t state,
               Shown::Path& path) {
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < kMostShownArcs && seen.insert(state).second;
       ++i) {
    const auto arcs = graph.arcs(state);
    if (arcs.empty()) return;
    // Something happens there rather than nothing.
    const auto busy = std::ranges::max_element(arcs, {}, [&](const auto& arc) {
      return graph.events(arc).empty() ? 0 : 1;
    });
    path.push_back(graph.first_arc(state) +
                   static_cast<std::uint32_t>(busy - arcs.begin()));
    state = busy->target;
  }
}

// A run of faults that all have struck to an end with this still on.
std::optional<Shown::Path> left_on(const AnswerGraph& graph,
                                   const OnOff& pair) {
  struct Reached {
    std::uint32_t from = 0;  // twice the state, and whether it is on
    std::uint32_t arc = 0;
    bool is_there = false;
  };
  std::vector<Reached> reached(std::size_t{graph.size()} * 2);
  std::vector<std::uint32_t> open = {0};
  reached[0].is_there = true;
  for (std::size_t next = 0; next < open.size(); ++next) {
    ask_budget();
    const std::uint32_t here = open[next];
    const std::uint32_t state = here / 2;
    if (here % 2 == 1 && has_ended(graph.ending(state)) &&
        graph.has_struck(state)) {
      Shown::Path path;
      for (std::uint32_t at = here; at != 0; at = reached[at].from) {
        path.push_back(reached[at].arc);
      }
      std::ranges::reverse(path);
      return path;
    }
    const auto arcs = graph.arcs(state);
    for (std::uint32_t i = 0; i < arcs.size(); ++i) {
      bool is_on = here % 2 == 1;
      for (const NodeEvent event : graph.events(arcs[i])) {
        if (event.what() != Happening::Success) continue;
        if (event.node() == pair.on) is_on = true;
        if (std::ranges::find(pair.off, event.node()) != pair.off.end()) {
          is_on = false;
        }
      }
      const std::uint32_t to = arcs[i].target * 2 + (is_on ? 1 : 0);
      if (std::exchange(reached[to].is_there, true)) continue;
      reached[to].from = here;
      reached[to].arc = graph.first_arc(state) + i;
      open.push_back(to);
    }
  }
  return std::nullopt;
}

bool is_named(const Node& node, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& name) {
    return name == node.id || name == node.name;
  });
}

}  // namespace

std::vector<OnOff> on_and_off(const BehaviorTree& tree) {
  std::map<std::vector<std::string>, std::vector<NodeId>> of_words;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!is_leaf(tree.nodes[n].type)) continue;
    of_words[words_in(tree.nodes[n].id)].push_back(NodeId{n});
  }
  std::vector<OnOff> pairs;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    const LeafMeaning& meaning = node.contract.meaning;
    if (!is_deed(node) || meaning.may_stay == true) continue;
    OnOff pair{NodeId{n}, {}};
    if (!meaning.undone_by.empty()) {
      for (std::uint32_t o = 0; o < tree.nodes.size(); ++o) {
        const bool is_meant = is_leaf(tree.nodes[o].type) && o != n &&
                              is_named(tree.nodes[o], meaning.undone_by);
        if (is_meant) pair.off.push_back(NodeId{o});
      }
    } else if (const auto undoing = words_of_undoing(node.id);
               !undoing.empty()) {
      const auto found = of_words.find(undoing);
      if (found != of_words.end()) pair.off = found->second;
    }
    if (!pair.off.empty()) pairs.push_back(std::move(pair));
  }
  return pairs;
}

Effect effect_of(const AnswerGraph& graph, const std::vector<OnOff>& pairs,
                 const Effect* known, Shown& shown) {
  Effect effect;
  effect.stopped = graph.stopped();
  effect.states = graph.progress().states;
  const auto show = [&](bool& is_so, std::optional<Shown::Path>& path,
                        std::uint32_t state) {
    if (is_so) return;
    is_so = true;
    path = graph.path_to(state);
  };
  std::set<NodeId> running;
  const auto is_known = [](const std::vector<NodeId>& those, NodeId leaf) {
    return std::ranges::find(those, leaf) != those.end();
  };
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    ask_budget();
    if (!graph.has_struck(s)) continue;
    effect.strikes = true;
    switch (graph.ending(s)) {
      case Ending::Success:
        show(effect.succeeds, shown.succeeds, s);
        break;
      case Ending::Failure:
        show(effect.fails, shown.fails, s);
        break;
      case Ending::Exception:
        show(effect.throws, shown.throws, s);
        break;
      case Ending::None:
        break;
    }
    const bool is_whole = effect.stopped == StopReason::None;
    if (is_whole && !graph.can_end()[s] && !effect.hangs) {
      show(effect.hangs, shown.hangs, s);
      add_round(graph, s, *shown.hangs);
    }
    if (!has_ended(graph.ending(s))) continue;
    for (const NodeId leaf : graph.running(s)) {
      if (known != nullptr && is_known(known->left_running, leaf)) continue;
      if (running.insert(leaf).second && !shown.left) {
        shown.left = graph.path_to(s);
      }
    }
  }
  effect.left_running.assign(running.begin(), running.end());
  for (const OnOff& pair : pairs) {
    if (known != nullptr && is_known(known->left_on, pair.on)) continue;
    auto path = left_on(graph, pair);
    if (!path) continue;
    effect.left_on.push_back(pair.on);
    if (!shown.left) shown.left = std::move(path);
  }
  return effect;
}

Effect ends_behind(const AnswerGraph& graph, NodeId leaf) {
  Effect effect;
  effect.stopped = graph.stopped();
  std::vector<bool> reached(graph.size(), false);
  std::vector<std::uint32_t> open;
  const auto reach = [&](std::uint32_t state) {
    if (reached[state]) return;
    reached[state] = true;
    open.push_back(state);
  };
  const NodeEvent asked(leaf, Happening::Asked);
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    ask_budget();
    for (const AnswerGraph::Arc& arc : graph.arcs(s)) {
      const auto events = graph.events(arc);
      if (std::ranges::find(events, asked) != events.end()) reach(arc.target);
    }
  }
  while (!open.empty()) {
    const std::uint32_t here = open.back();
    open.pop_back();
    effect.strikes = true;
    const Ending ending = graph.ending(here);
    effect.succeeds = effect.succeeds || ending == Ending::Success;
    effect.fails = effect.fails || ending == Ending::Failure;
    effect.throws = effect.throws || ending == Ending::Exception;
    effect.hangs = effect.hangs || !graph.can_end()[here];
    for (const AnswerGraph::Arc& arc : graph.arcs(here)) reach(arc.target);
  }
  return effect;
}

std::vector<NodeEvent> events_along(const AnswerGraph& graph,
                                    const Shown::Path& path) {
  std::vector<NodeEvent> all;
  for (const std::uint32_t arc : path) {
    const auto events = graph.events(graph.arc(arc));
    all.insert(all.end(), events.begin(), events.end());
  }
  return all;
}

// Up from a failure of the leaf as long as each node passes it on; the first
// that does something else has caught it. One that runs on is caught where a
// node above it has decided.
std::optional<Recovery> recovery_on(const BehaviorTree& tree, NodeId leaf,
                                    const std::vector<NodeEvent>& run,
                                    const std::vector<bool>& asked) {
  auto at = std::ranges::find(run, NodeEvent(leaf, Happening::Struck));
  if (at == run.end()) return std::nullopt;
  Recovery recovery;
  std::optional<NodeId> caught;
  std::optional<Happening> answer;  // of the leaf, that is on its way up
  NodeId below = leaf;
  std::set<NodeId> through;
  for (++at; at != run.end(); ++at) {
    const NodeId node = at->node();
    if (at->what() == Happening::Asked) {
      if (!asked[index(node)]) through.insert(node);
      if (node == leaf && caught) recovery.is_asked_again = true;
      // In each tick its running is passed on anew.
      if (tree.node(node).is_root() && answer == Happening::Running) {
        below = leaf;
      }
    }
    if (node == leaf) {
      if (!is_answer(at->what()) || caught) continue;
      if (at->what() == Happening::Success) break;
      answer = at->what();
      below = leaf;
      continue;
    }
    if (caught || !answer || tree.node(below).is_root()) continue;
    const NodeId above = tree.node(below).parent;
    const bool is_above = node == above && is_answer(at->what());
    if (is_above && at->what() == *answer) {
      below = above;
    } else if (is_above || answer == Happening::Failure) {
      caught = above;
    }
  }
  if (!caught || tree.node(*caught).is_root()) return std::nullopt;
  recovery.caught_by = *caught;
  recovery.through.assign(through.begin(), through.end());
  return recovery;
}

std::vector<bool> asked_behind(const BehaviorTree& tree,
                               const AnswerGraph& graph) {
  std::vector<bool> asked(tree.nodes.size(), false);
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    for (const AnswerGraph::Arc& arc : graph.arcs(s)) {
      if (!graph.has_struck(arc.target)) continue;
      bool is_behind = graph.has_struck(s);
      for (const NodeEvent event : graph.events(arc)) {
        if (event.what() == Happening::Struck) is_behind = true;
        if (is_behind && event.what() == Happening::Asked) {
          asked[index(event.node())] = true;
        }
      }
    }
  }
  return asked;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What the search behind the default report notes on its way.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "check/questions/defaults.hpp"
#include "check/questions/watches.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/search/reachability.hpp"
#include "explore/search/stored_graph.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// A question of the search that is answered by the first state found.
using FirstState = std::optional<StateId>;
// Or by the first edge taken.
using FirstStep = std::optional<FoundStep>;

// Some of the questions of one node, by NodeQuestion.
using NodeQuestions = std::bitset<kNodeQuestionCount>;

// Which of the questions a search is for.
struct QuestionsAsked {
  bool of_tree = true;
  bool left_running = true;
  std::vector<NodeQuestions> nodes = {};  // by NodeId; empty: all
  std::vector<bool> sightings = {};       // by number; empty: all

  bool has(NodeId node, std::size_t question) const {
    return nodes.empty() || nodes[index(node)][question];
  }
  bool has_any_node() const {
    return nodes.empty() || std::ranges::any_of(nodes, &NodeQuestions::any);
  }
  bool has_sighting(std::size_t number) const {
    return sightings.empty() || sightings[number];
  }
};

// Whether the roots have ended, and how. (A fault is never missed: it is dead.)
// And where rounds of an unknown number begin, so that such a step is told by
// itself.
Observed seen_by_default(const BehaviorTree& tree, const Network& network,
                         const QuestionsAsked& asked = {});

// Beyond that, which nodes run when some other gives control back or is ticked,
// and what sightings ask. All of them stand below or beside that node, and what
// they do is done by then in whatever order the rest of the tree moves; so it
// need not be seen at once.
Observed kept_for_default(const BehaviorTree& tree, const Network& network,
                          const std::vector<Sighting>& sightings,
                          const QuestionsAsked& asked = {});

// Watches the edges that fire for the questions of single nodes, the states for
// those of the tree, and keeps every step for those that need steps twice.
struct DefaultQuestions : public ReachabilityVisitor {
  DefaultQuestions(const BehaviorTree& tree, const CompiledNetwork& system,
                   const std::vector<Sighting>& watched,
                   QuestionsAsked what = {});

  void passed(StateId from, StateView before, Step step) {
    left_running.passed(from, before, step);
    sightings.passed(from, before, step);
    if (step.edge == kTimeStep) return;
    FirstStep* first = question_of_edge_[step.edge];
    if (first == nullptr || *first) return;
    *first = FoundStep{from, step.edge};
    --open_;
  }

  bool is_heard(Step step) const {
    if (step.edge == kTimeStep) return false;
    const FirstStep* first = question_of_edge_[step.edge];
    return (first != nullptr && !*first) || left_running.is_heard(step) ||
           sightings.is_heard(step);
  }

  // What comes to an end as time does is no part of a loop that takes none.
  void stepped(StateId from, Step step, StateId to) {
    if (!asked.of_tree) return;
    if (step.edge != kTimeStep && is_like_time_[step.edge]) step.elapsed = 1;
    graph.add(from, step, to);
  }

  GoOn expanded(StateId id, StateView state, bool is_dead) {
    if (!asked.of_tree) return has_all() ? GoOn::No : GoOn::Yes;
    const auto role = [&](const Automaton* root) {
      return root->locations[system_.value(state, root->location)].role;
    };
    const bool has_ended = std::ranges::all_of(roots_, is_end, role);
    const bool has_succeeded =
        has_ended && std::ranges::count(roots_, LocationRole::Success, role) ==
                         std::ssize(roots_);
    if (!success && has_succeeded) success = id;
    if (!failure &&
        std::ranges::count(roots_, LocationRole::Failure, role) > 0) {
      failure = id;
    }
    const std::optional<VariableId> fault_bit = system_.network().fault;
    const bool is_faulty = fault_bit && system_.value(state, *fault_bit) != 0;
    if (is_faulty && !fault) fault = id;
    // A fault ends the run as well; it is reported as such.
    ended.push_back(has_ended || is_faulty);
    succeeded.push_back(has_succeeded);
    if (is_dead && !has_ended && !is_faulty && !stuck) stuck = id;
    if (pause && ended.size() % kPollInterval == 0) pause(ended.size());
    return GoOn::Yes;
  }

  // Nothing is asked but for sightings.
  bool is_of_sightings() const {
    return !asked.of_tree && !asked.left_running && !asked.has_any_node();
  }
  // Nothing is asked but what can be found, and all of that has been.
  bool has_all() const {
    return !asked.of_tree && !asked.left_running && open_ == 0 &&
           sightings.has_all();
  }

  // From where each answer was found; some of these states more than once.
  std::vector<StateId> found_from() const;

  std::size_t bytes() const {
    return graph.bytes() + (ended.size() + succeeded.size()) / 8 + beside;
  }

  QuestionsAsked asked;
  std::vector<std::array<FirstStep, kNodeQuestionCount>> nodes;
  LeftRunningWatch left_running;
  SightingWatch sightings;
  std::vector<bool> ended;      // by state
  std::vector<bool> succeeded;  // by state: all roots have
  FirstState success;
  FirstState failure;
  FirstState fault;
  FirstState stuck;
  StoredGraph graph;
  // Called now and then with the number of states that were expanded.
  std::function<void(std::size_t)> pause;
  std::size_t beside = 0;  // bytes held by what is done then

 private:
  void watch_node(NodeId node);

  const CompiledNetwork& system_;
  std::vector<FirstStep*> question_of_edge_;  // null: none
  std::size_t open_ = 0;                      // of nodes, not yet found
  std::vector<bool> is_like_time_;            // by edge
  std::vector<const Automaton*> roots_;
};

}  // namespace btcheck

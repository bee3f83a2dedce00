// SPDX-License-Identifier: MIT
//
// Questions about nodes that stand together are asked together: a few nodes
// more that stand as they are cost little, and one search, one outside and one
// walk to the runs do for all. Where such a search grows too large its
// questions are asked one by one.
#include "check/questions/in_parts.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "check/questions/default_questions.hpp"
#include "check/questions/inquiry.hpp"
#include "check/questions/reporter.hpp"
#include "check/questions/watches.hpp"
#include "check/search/searched_network.hpp"
#include "explore/components/composition.hpp"
#include "explore/search/reachability.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// Nodes of one group.
constexpr std::size_t kTogether = 8;
// States of one search.
constexpr std::uint64_t kMostStates = 65'536;

// What is asked in one search, and which nodes have to stand for it.
struct Group {
  std::vector<NodeId> nodes;
  Asked asked;
};

// Nodes that stand together: each a part of the tree without gaps.
class Neighbourhoods {
 public:
  explicit Neighbourhoods(const BehaviorTree& tree) : top_(tree.nodes.size()) {
    std::vector<std::size_t> size(tree.nodes.size(), 1);
    std::vector<bool> is_top(tree.nodes.size(), false);
    // In pre-order children follow their parents.
    for (std::size_t n = tree.nodes.size(); n-- > 0;) {
      std::vector<NodeId> open = tree.nodes[n].children;
      std::ranges::sort(open, {}, [&](NodeId id) { return size[index(id)]; });
      for (const NodeId child : open) size[n] += size[index(child)];
      for (; size[n] > kTogether && !open.empty(); open.pop_back()) {
        is_top[index(open.back())] = true;
        size[n] -= size[index(open.back())];
      }
      is_top[n] = is_top[n] || tree.nodes[n].is_root();
    }
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      top_[n] = is_top[n] ? NodeId{n} : top_[index(tree.nodes[n].parent)];
    }
  }

  NodeId top(NodeId node) const { return top_[index(node)]; }

 private:
  std::vector<NodeId> top_;
};

class Groups {
 public:
  Groups(const BehaviorTree& tree, const Network& network,
         const std::vector<Sighting>& sightings)
      : tree_(tree), sightings_(sightings) {
    const Neighbourhoods around(tree);
    std::map<NodeId, std::size_t> of_top;
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      const NodeId top = around.top(NodeId{n});
      const auto [known, is_new] = of_top.try_emplace(top, all_.size());
      if (is_new) all_.push_back(empty());
      ask(NodeId{n}, all_[known->second]);
    }
    std::map<std::vector<NodeId>, std::size_t> apart;
    const auto group_of = [&](const std::vector<NodeId>& nodes) -> Group& {
      const NodeId top = around.top(nodes.front());
      const bool is_near = std::ranges::all_of(
          nodes, [&](NodeId node) { return around.top(node) == top; });
      if (is_near) return all_[of_top.at(top)];
      const auto [known, is_new] = apart.try_emplace(nodes, all_.size());
      if (is_new) {
        all_.push_back(empty());
        all_.back().nodes = nodes;
      }
      return all_[known->second];
    };
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      group_of(nodes_of(sightings[i])).asked.sightings[i] = true;
    }
    // A watch of its own looks for these wherever their nodes stand.
    for (const auto& way : ways_left_running(tree, network)) group_of(way);
  }

  const std::vector<Group>& all() const { return all_; }

  // The questions of a group, each by itself.
  std::vector<Group> single(const Group& group) const {
    std::vector<Group> singles;
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (!group.asked.has_node(NodeId{n})) continue;
      singles.push_back(empty());
      ask(NodeId{n}, singles.back());
    }
    for (std::size_t i = 0; i < sightings_.size(); ++i) {
      if (!group.asked.has_sighting(i)) continue;
      singles.push_back(empty());
      singles.back().nodes = nodes_of(sightings_[i]);
      singles.back().asked.sightings[i] = true;
    }
    return singles;
  }

  // Of the tree as a whole.
  Group of_roots() const {
    Group group = empty();
    group.asked.of_tree = true;
    group.nodes = tree_.roots;
    return group;
  }

 private:
  Group empty() const {
    return {{},
            {false, std::vector<bool>(tree_.nodes.size(), false),
             std::vector<bool>(sightings_.size(), false)}};
  }
  void ask(NodeId node, Group& group) const {
    group.nodes.push_back(node);
    group.asked.nodes[index(node)] = true;
  }
  static std::vector<NodeId> nodes_of(const Sighting& sighting) {
    std::vector<NodeId> nodes = {sighting.node};
    for (const auto& [node, status] : sighting.with) nodes.push_back(node);
    if (sighting.retried) nodes.push_back(*sighting.retried);
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  const BehaviorTree& tree_;
  const std::vector<Sighting>& sightings_;
  std::vector<Group> all_;
};

// One search, with the nodes of a group as they are.
class PartSearch {
 public:
  PartSearch(const BehaviorTree& tree, const CompiledNetwork& whole,
             ComponentTable& components, const Group& group,
             const std::vector<Sighting>& sightings, const Limits& limits,
             DefaultReport& report)
      : parts_(components, standing(whole.network(), group),
               group.asked.of_tree),
        searched_(
            whole, parts_, seen_by_default(tree, parts_.network(), group.asked),
            kept_for_default(tree, parts_.network(), sightings, group.asked)),
        questions_(tree, searched_.system().network(), sightings, group.asked),
        search_(searched_.system(), limits) {
    result_ = search_.run(questions_);
    if (result_.is_complete) questions_.graph.close(search_.store().size());
    reporter_.emplace(searched_, search_, result_.is_complete, whole.network(),
                      limits, report);
  }
  PartSearch(const PartSearch&) = delete;
  PartSearch& operator=(const PartSearch&) = delete;

  const ReachabilityResult& result() const { return result_; }
  bool is_complete() const {
    return result_.is_complete || questions_.has_all();
  }
  Seen seen() { return {questions_, *reporter_}; }
  void look_up() { reporter_->look_up(questions_.found_from()); }

 private:
  static std::vector<bool> standing(const Network& network,
                                    const Group& group) {
    std::vector<bool> stands(network.automata.size(), false);
    for (const NodeId node : group.nodes) {
      stands[index(network.node_automaton[index(node)])] = true;
    }
    return stands;
  }

  Composition parts_;
  SearchedNetwork searched_;
  DefaultQuestions questions_;
  BreadthFirst<ReducedNetwork> search_;
  ReachabilityResult result_;
  std::optional<Reporter> reporter_;
};

}  // namespace

DefaultReport check_defaults_in_parts(const BehaviorTree& tree,
                                      const CompiledNetwork& system,
                                      const Limits& limits) {
  DefaultReport report;
  report.reduction = Reduction::Full;
  const Network& network = system.network();
  Inquiry inquiry(tree, network);
  ComponentTable components(
      network, std::vector<bool>(network.variables.size(), false), {});
  std::vector<std::unique_ptr<PartSearch>> searches;
  Evidence evidence;
  const auto search = [&](const Group& group) -> PartSearch& {
    Limits few = limits;
    few.max_states = std::min(
        kMostStates, limits.max_states -
                         std::min(limits.max_states, report.progress.states));
    searches.push_back(std::make_unique<PartSearch>(
        tree, system, components, group, inquiry.sightings(), few, report));
    PartSearch& made = *searches.back();
    const SearchProgress& progress = made.result().progress;
    report.progress.states += progress.states;
    report.progress.expanded += progress.expanded;
    report.progress.transitions += progress.transitions;
    report.progress.depth = std::max(report.progress.depth, progress.depth);
    report.progress.bytes += progress.bytes;
    if (!made.is_complete()) report.stopped = made.result().stopped;
    evidence.add(made.seen());
    return made;
  };
  const Groups groups(tree, network, inquiry.sightings());
  PartSearch& of_tree = search(groups.of_roots());
  const auto goes_on = [&] {
    return report.stopped == StopReason::None ||
           report.stopped == StopReason::MaxStates;
  };
  for (const Group& group : groups.all()) {
    if (!goes_on()) break;
    const StopReason before = report.stopped;
    if (search(group).is_complete()) continue;
    const std::vector<Group> singles = groups.single(group);
    if (singles.size() < 2 || !goes_on()) continue;
    report.stopped = before;
    for (const Group& single : singles) {
      if (goes_on()) search(single);
    }
  }
  const bool is_complete = report.stopped == StopReason::None;
  // What has been found is told.
  const BudgetScope telling(nullptr);
  for (const auto& each : searches) each->look_up();
  std::move(inquiry).answer(of_tree.seen(), of_tree.is_complete(), evidence,
                            is_complete, report);
  return report;
}

}  // namespace btcheck

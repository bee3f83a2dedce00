// SPDX-License-Identifier: MIT
//
// Questions about nodes that stand together are asked together: a few nodes
// more that stand as they are cost little, and one search, one outside and one
// walk to the runs do for all. Where such a search grows too large its
// questions are asked one by one.
#include "check/parts/in_parts.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "check/parts/open_questions.hpp"
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

// States of one search, and of one that is worth its while as most of the
// network is left out of it; and of all: beyond that the whole is the better
// bet.
constexpr std::uint64_t kMostStates = 65'536;
constexpr std::uint64_t kMostStatesOfFew = 4'000'000;
constexpr std::uint64_t kMostStatesInAll = 20'000'000;

// What is asked in one search, and which nodes have to stand for it.
struct Group {
  std::vector<NodeId> nodes;
  QuestionsAsked asked;

  bool asks_anything() const {
    return asked.of_tree || asked.left_running || asked.has_any_node() ||
           std::ranges::find(asked.sightings, true) != asked.sightings.end();
  }
};

// Nodes that stand together: each a part of the tree without gaps.
class Neighbourhoods {
 public:
  Neighbourhoods(const BehaviorTree& tree, std::size_t together)
      : top_(tree.nodes.size()) {
    std::vector<std::size_t> size(tree.nodes.size(), 1);
    std::vector<bool> is_top(tree.nodes.size(), false);
    // In pre-order children follow their parents.
    for (std::size_t n = tree.nodes.size(); n-- > 0;) {
      std::vector<NodeId> open = tree.nodes[n].children;
      std::ranges::sort(open, {}, [&](NodeId id) { return size[index(id)]; });
      for (const NodeId child : open) size[n] += size[index(child)];
      for (; size[n] > together && !open.empty(); open.pop_back()) {
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
         const std::vector<Sighting>& sightings, std::size_t together)
      : tree_(tree), sightings_(sightings) {
    const Neighbourhoods around(tree, together);
    std::map<NodeId, std::size_t> of_top;
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      const NodeId top = around.top(NodeId{n});
      const auto [known, is_new] = of_top.try_emplace(top, all_.size());
      if (is_new) all_.push_back(empty());
      ask(NodeId{n}, all_[known->second]);
    }
    // Those of nodes that stand apart; what stands for one may do for others.
    std::map<std::vector<NodeId>, Group> apart;
    const auto group_of = [&](const std::vector<NodeId>& nodes) -> Group& {
      const NodeId top = around.top(nodes.front());
      const bool is_near = std::ranges::all_of(
          nodes, [&](NodeId node) { return around.top(node) == top; });
      if (is_near) return all_[of_top.at(top)];
      Group& group = apart.try_emplace(nodes, empty()).first->second;
      group.nodes = nodes;
      return group;
    };
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      group_of(nodes_of(sightings[i])).asked.sightings[i] = true;
    }
    // A watch of its own looks for these wherever their nodes stand. The nodes
    // of the engine halt all children when they decide.
    if (!is_engine(tree.profile)) {
      for (std::vector<NodeId>& way : ways_left_running(tree, network)) {
        std::ranges::sort(way);
        group_of(way).asked.left_running = true;
      }
    }
    add_largest(apart);
  }

  const std::vector<Group>& all() const { return all_; }

  // The questions of a group, each by itself.
  std::vector<Group> single(const Group& group) const {
    std::vector<Group> singles;
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (group.asked.nodes[n].none()) continue;
      singles.push_back(empty());
      singles.back().nodes = {NodeId{n}};
      singles.back().asked.nodes[n] = group.asked.nodes[n];
    }
    for (std::size_t i = 0; i < sightings_.size(); ++i) {
      if (!group.asked.has_sighting(i)) continue;
      singles.push_back(empty());
      singles.back().nodes = nodes_of(sightings_[i]);
      singles.back().asked.sightings[i] = true;
    }
    if (group.asked.left_running) {
      singles.push_back(empty());
      singles.back().nodes = group.nodes;
      singles.back().asked.left_running = true;
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
  // Each with those whose nodes are among its own.
  void add_largest(const std::map<std::vector<NodeId>, Group>& apart) {
    std::vector<const Group*> by_size;
    for (const auto& [nodes, group] : apart) by_size.push_back(&group);
    std::ranges::stable_sort(
        by_size, std::ranges::greater(),
        [](const Group* each) { return each->nodes.size(); });
    const std::size_t first = all_.size();
    for (const Group* group : by_size) {
      ask_budget();
      const auto larger =
          std::find_if(all_.begin() + static_cast<std::ptrdiff_t>(first),
                       all_.end(), [&](const Group& each) {
                         return std::ranges::includes(each.nodes, group->nodes);
                       });
      if (larger == all_.end()) {
        all_.push_back(*group);
        continue;
      }
      larger->asked.left_running |= group->asked.left_running;
      for (std::size_t i = 0; i < sightings_.size(); ++i) {
        if (group->asked.has_sighting(i)) larger->asked.sightings[i] = true;
      }
    }
  }

  Group empty() const {
    return {{},
            {false, false, std::vector<NodeQuestions>(tree_.nodes.size()),
             std::vector<bool>(sightings_.size(), false)}};
  }
  void ask(NodeId node, Group& group) const {
    group.nodes.push_back(node);
    group.asked.nodes[index(node)].set();
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
             std::unique_ptr<const Composition> parts, const Group& group,
             const std::vector<Sighting>& sightings, const Limits& limits,
             std::uint64_t most_states, DefaultReport& report)
      : parts_(std::move(parts)),
        searched_(
            whole, *parts_,
            seen_by_default(tree, parts_->network(), group.asked),
            kept_for_default(tree, parts_->network(), sightings, group.asked)),
        questions_(tree, searched_.system().network(), sightings, group.asked),
        limits_(limits),
        search_(searched_.system(), limits_) {
    limits_.max_states =
        std::min(limits.max_states, most_of(*parts_, most_states));
    result_ = search_.run(questions_);
    if (result_.is_complete) questions_.graph.close(search_.store().size());
    reporter_.emplace(searched_, search_, result_.is_complete, whole.network(),
                      limits_, report);
  }
  PartSearch(const PartSearch&) = delete;
  PartSearch& operator=(const PartSearch&) = delete;

  // How many states one may have that is to have no more than so many, where
  // it is much smaller than the whole.
  static std::uint64_t most_of(const Composition& parts,
                               std::uint64_t most_states) {
    const std::size_t automata = parts.components().network().automata.size();
    return 2 * parts.left_out() >= automata ? most_states : kMostStates;
  }

  const ReachabilityResult& result() const { return result_; }
  bool is_complete() const {
    return result_.is_complete || questions_.has_all();
  }
  Seen seen() { return {questions_, *reporter_}; }
  // Somebody will ask what was found.
  bool is_told() const {
    return questions_.asked.of_tree || !questions_.found_from().empty();
  }
  // Of sightings few runs are asked for.
  void look_up() {
    if (questions_.is_of_sightings()) return;
    reporter_->look_up(questions_.found_from());
  }

 private:
  std::unique_ptr<const Composition> parts_;
  SearchedNetwork searched_;
  DefaultQuestions questions_;
  Limits limits_;
  BreadthFirst<ReducedNetwork> search_;
  ReachabilityResult result_;
  std::optional<Reporter> reporter_;
};

// Tells how far all searches have come.
class MonitorOfAll : public SearchMonitor {
 public:
  MonitorOfAll(SearchMonitor* monitor, const SearchProgress& done)
      : monitor_(monitor), done_(done) {}

  StopReason observe(const SearchProgress& progress) override {
    if (monitor_ == nullptr) return StopReason::None;
    SearchProgress all = progress;
    all.states += done_.states;
    all.expanded += done_.expanded;
    all.transitions += done_.transitions;
    return monitor_->observe(all);
  }
  bool may_tell() override {
    return monitor_ == nullptr || monitor_->may_tell();
  }
  bool has_spare() override {
    return monitor_ == nullptr || monitor_->has_spare();
  }

 private:
  SearchMonitor* monitor_;
  const SearchProgress& done_;
};

// All searches of a report.
class SearchInParts {
 public:
  SearchInParts(const BehaviorTree& tree, const CompiledNetwork& system,
                const Limits& limits, ComponentStore* known,
                const EarlierReport* earlier)
      : tree_(tree),
        system_(system),
        limits_(limits),
        inquiry_(tree, system.network()),
        components_(system.network(),
                    std::vector<bool>(system.network().variables.size(), false),
                    {}, known),
        whole_(system),
        earlier_(earlier == nullptr
                     ? nullptr
                     : std::make_unique<EarlierRuns>(tree, whole_, inquiry_,
                                                     system.network(), limits,
                                                     report_, *earlier)),
        open_(system.network(), inquiry_.sightings(), earlier_.get(), known) {}

  DefaultReport report(std::size_t together) && {
    report_.reduction = Reduction::Full;
    const Groups groups(tree_, system_.network(), inquiry_.sightings(),
                        together);
    const bool pays = answer(groups.of_roots(), groups);
    for (const Group& group : groups.all()) {
      if (pays) answer(group, groups);
    }
    // What has been found is told.
    const BudgetScope telling(nullptr);
    KnownAnswers answers;
    if (earlier_) answers = earlier_->taken_over();
    answers.never = open_.never();
    Evidence evidence(std::move(answers));
    if (earlier_) evidence.add(earlier_->seen());
    for (const auto& each : searches_) {
      each->look_up();
      evidence.add(each->seen());
    }
    keep_sighted(evidence);
    PartSearch& of_tree = *searches_.front();
    std::move(inquiry_).answer(of_tree.seen(), of_tree.is_complete(), evidence,
                               report_.stopped == StopReason::None, report_);
    return std::move(report_);
  }

 private:
  bool goes_on() const {
    return (report_.stopped == StopReason::None ||
            report_.stopped == StopReason::MaxStates) &&
           report_.progress.states < most_states();
  }
  std::uint64_t most_states() const {
    return std::min(limits_.max_states, kMostStatesInAll);
  }

  // For a tree much like this one.
  void keep_sighted(const Evidence& evidence) {
    const auto consequences = inquiry_.consequences();
    for (std::size_t i = 0; i < consequences.size(); ++i) {
      auto run = evidence.run_to(i);
      if (!run) continue;
      report_.sighted.push_back(
          {inquiry_.sightings()[i], consequences[i], std::move(*run), {}});
      if (!consequences[i]) continue;
      report_.sighted.back().followed = evidence.run_to(i, consequences[i]);
    }
  }

  // Of few states if it can be, else by itself. Whether all is known then.
  bool answer(const Group& group, const Groups& groups) {
    const StopReason before = report_.stopped;
    const std::size_t known = searches_.size();
    if (search(group, kMostStates)) return true;
    if (!goes_on()) return false;
    report_.stopped = before;
    if (searches_.size() > known) {
      held_ -= searches_.back()->result().progress.bytes;
      searches_.pop_back();
    }
    const std::vector<Group> singles = groups.single(group);
    if (singles.size() < 2) return search(group, kMostStatesOfFew);
    for (const Group& single : singles) answer(single, groups);
    return report_.stopped == before;
  }

  // Whether all that the group asks is known then.
  bool search(Group group, std::uint64_t most_states) {
    open_.leave_out_shown(group.asked);
    if (!group.asks_anything()) return true;
    if (!goes_on()) {
      if (report_.stopped == StopReason::None) {
        report_.stopped = StopReason::MaxStates;
      }
      return false;
    }
    auto parts = std::make_unique<const Composition>(
        components_, standing(group), group.asked.of_tree);
    const AskedContent content(parts->network());
    open_.leave_out_known(content, group.asked);
    if (!group.asks_anything()) return true;
    Limits few = limits_;
    few.max_states -= std::min(few.max_states, report_.progress.states);
    few.max_bytes -= std::min(few.max_bytes, held_);
    few.monitor = &monitor_;
    const auto before = open_.in_vain(content, group.asked);
    if (before && before->bytes < few.max_bytes &&
        before->states < std::min(few.max_states,
                                  PartSearch::most_of(*parts, most_states))) {
      count(*before);
      open_.take_over(content, group.asked);
      return true;
    }
    auto made = std::make_unique<PartSearch>(tree_, system_, std::move(parts),
                                             group, inquiry_.sightings(), few,
                                             most_states, report_);
    const auto& [stopped, is_complete, progress] = made->result();
    count(progress);
    const bool knows_all = made->is_complete();
    if (!knows_all) report_.stopped = stopped;
    if (is_complete) open_.keep(content, made->seen().questions);
    if (is_complete && !made->is_told()) {
      open_.share_in_vain(content, group.asked, progress);
    }
    if (made->is_told()) {
      held_ += progress.bytes;
      searches_.push_back(std::move(made));
    }
    return knows_all;
  }

  void count(const SearchProgress& progress) {
    SearchProgress& all = report_.progress;
    all.states += progress.states;
    all.expanded += progress.expanded;
    all.transitions += progress.transitions;
    all.depth = std::max(all.depth, progress.depth);
    all.bytes = std::max(all.bytes, held_ + progress.bytes);
    ++report_.searches;
  }

  std::vector<bool> standing(const Group& group) const {
    const Network& network = system_.network();
    std::vector<bool> stands(network.automata.size(), false);
    for (const NodeId node : group.nodes) {
      stands[index(network.node_automaton[index(node)])] = true;
    }
    return stands;
  }

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  const Limits& limits_;
  Inquiry inquiry_;
  ComponentTable components_;
  DefaultReport report_;
  const SearchedNetwork whole_;
  const std::unique_ptr<EarlierRuns> earlier_;
  OpenQuestions open_;
  std::vector<std::unique_ptr<PartSearch>> searches_;
  std::uint64_t held_ = 0;  // bytes
  MonitorOfAll monitor_{limits_.monitor, report_.progress};
};

}  // namespace

DefaultReport check_defaults_in_parts(const BehaviorTree& tree,
                                      const CompiledNetwork& system,
                                      const Limits& limits,
                                      ComponentStore* known,
                                      std::size_t together,
                                      const EarlierReport* earlier) {
  return SearchInParts(tree, system, limits, known, earlier).report(together);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A state of the search is one of the network and, for each node, the status
// that the log has of it: what does not change it is not logged. States are put
// on the record that comes next for them; a step that makes several changes
// takes as many records at once. That a node is reset from an answer to IDLE is
// housekeeping, which releases of the engine do at different moments: such
// records are held against the log alone.
#include "trace/conform/conform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "explore/store/state_store.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/tree/node_types.hpp"
#include "trace/logs/btcpp_tree.hpp"
#include "trace/logs/engine_records.hpp"

namespace btcheck {

// --- The trees ---------------------------------------------------------------

namespace {

Diagnostic other_tree(std::string message, std::string help) {
  Diagnostic found;
  found.code = "BT1806";
  found.message = std::move(message);
  found.help = std::move(help);
  return found;
}

std::string name_of(const LogNode& node) {
  return node.name.empty() ? node.type : node.name;
}

// A name as a log and a tree may spell it; btcheck's own logs have plain words
// for types.
bool is_same(const LogNode& logged, const LoggedNode& known) {
  return logged.name == known.name || logged.name == known.id ||
         (logged.name.empty() && logged.type == known.id);
}

}  // namespace

Result<LoggedNodes> LoggedNodes::match(const BehaviorLog& log,
                                       const BehaviorTree& tree,
                                       const RecordedRun& run) {
  const std::string help = "name the tree that the robot ran";
  if (tree.roots.size() != 1) {
    return {std::nullopt,
            {other_tree("several trees at once are not followed in a log",
                        "a log has one tree")}};
  }
  const LoggedTree known = btcpp_tree(run);
  LoggedNodes nodes;
  nodes.by_uid_.resize(65536);
  nodes.is_logged_.resize(tree.nodes.size(), false);
  std::map<std::uint16_t, std::size_t> place_of;
  const std::size_t count = std::min(log.nodes.size(), known.nodes.size());
  for (std::size_t place = 0; place < count; ++place) {
    const LogNode& logged = log.nodes[place];
    const LoggedNode& wanted = known.nodes[place];
    place_of[logged.uid] = place;
    std::optional<std::size_t> parent;
    if (logged.parent) {
      const auto above = place_of.find(*logged.parent);
      parent = above == place_of.end() ? place : above->second;
    }
    if (!is_same(logged, wanted) || parent != wanted.parent) {
      return {
          std::nullopt,
          {other_tree(
              fmt::format("the log is of another tree: its node {} is "
                          "`{}`, where {} has `{}`",
                          logged.uid, name_of(logged), tree.file, wanted.name),
              help)}};
    }
    const NodeId node{*wanted.recorded};
    nodes.by_uid_[logged.uid] = node;
    nodes.is_logged_[index(node)] = !logged.is_silent;
  }
  if (log.nodes.size() != known.nodes.size()) {
    return {std::nullopt,
            {other_tree(
                fmt::format("the log is of another tree: it has {} "
                            "nodes, {} has {}",
                            log.nodes.size(), tree.file, known.nodes.size()),
                help)}};
  }
  return {std::move(nodes), {}};
}

// --- Places ------------------------------------------------------------------

namespace {

// The places in the tree that a node of the log may have.
using Places = std::vector<std::size_t>;

// By uid, or nothing where a name is another: uids are given in pre-order.
std::optional<std::vector<Places>> places_by_uid(const BehaviorLog& log,
                                                 const LoggedTree& known) {
  std::vector<Places> places;
  for (const LogNode& node : log.nodes) {
    const std::size_t place = std::size_t{node.uid} - 1;
    const bool fits = log.has_uids && place < known.nodes.size() &&
                      is_same(node, known.nodes[place]);
    if (!fits) return std::nullopt;
    places.push_back({place});
  }
  return places;
}

std::vector<Places> places_by_name(const BehaviorLog& log,
                                   const LoggedTree& known) {
  std::multimap<std::string_view, std::size_t> named;
  for (std::size_t place = 0; place < known.nodes.size(); ++place) {
    const LoggedNode& node = known.nodes[place];
    named.emplace(node.name, place);
    if (node.id != node.name) named.emplace(node.id, place);
  }
  std::vector<Places> places;
  for (const LogNode& node : log.nodes) {
    const auto [begin, end] = named.equal_range(node.name);
    Places& those = places.emplace_back();
    for (auto each = begin; each != end; ++each) those.push_back(each->second);
    // The name of an instance counts for more than that of its type.
    const auto is_instance = [&](std::size_t place) {
      return known.nodes[place].name == node.name;
    };
    if (std::ranges::any_of(those, is_instance)) {
      std::erase_if(those, [&](std::size_t at) { return !is_instance(at); });
    }
  }
  return places;
}

// The nodes of the tree, in their places.
std::vector<LogNode> nodes_of(const LoggedTree& known) {
  std::vector<LogNode> nodes;
  for (std::size_t place = 0; place < known.nodes.size(); ++place) {
    const LoggedNode& node = known.nodes[place];
    LogNode& made = nodes.emplace_back();
    made.uid = static_cast<std::uint16_t>(place + 1);
    made.name = node.name;
    made.type = node.id;
    if (!node.parent) continue;
    made.parent = static_cast<std::uint16_t>(*node.parent + 1);
    made.depth = nodes[*node.parent].depth + 1;
  }
  return nodes;
}

Diagnostic not_told_apart(const std::set<std::string>& names) {
  constexpr std::size_t kMostNamed = 5;
  std::string list;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (count++ == kMostNamed) break;
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", name);
  }
  if (names.size() > kMostNamed) list += ", ...";
  Diagnostic found;
  found.severity = Severity::Warning;
  found.code = "BT1812";
  found.message = fmt::format(
      "several nodes of the tree have the same name: records of {} are left "
      "out",
      list);
  found.help = "give each node a name of its own";
  return found;
}

}  // namespace

BehaviorLog log_of_tree(const RecordedRun& run) {
  BehaviorLog log;
  log.nodes = nodes_of(btcpp_tree(run));
  return log;
}

Result<BehaviorLog> placed(BehaviorLog log, const BehaviorTree& tree,
                           const RecordedRun& run) {
  if (log.has_places() || tree.roots.size() != 1) return {std::move(log), {}};
  const LoggedTree known = btcpp_tree(run);
  if (known.nodes.size() > UINT16_MAX) {
    return {std::nullopt,
            {other_tree("a recording has 65,535 nodes at most", "")}};
  }
  auto places = places_by_uid(log, known);
  if (!places) places = places_by_name(log, known);
  Result<BehaviorLog> result;
  std::vector<LogNode> nodes = nodes_of(known);
  std::map<std::uint16_t, std::size_t> place_of;
  std::set<std::string> mixed;
  for (std::size_t i = 0; i < log.nodes.size(); ++i) {
    const LogNode& node = log.nodes[i];
    const Places& those = (*places)[i];
    if (those.empty()) {
      return {std::nullopt,
              {other_tree(fmt::format("the log is of another tree: {} has no "
                                      "node `{}`",
                                      tree.file, name_of(node)),
                          "name the tree that the robot ran")}};
    }
    if (those.size() == 1) {
      place_of[node.uid] = those.front();
      continue;
    }
    mixed.insert(name_of(node));
    for (const std::size_t place : those) nodes[place].is_silent = true;
  }
  std::vector<LogTransition> kept;
  for (LogTransition record : log.transitions) {
    const auto place = place_of.find(record.uid);
    if (place == place_of.end() || nodes[place->second].is_silent) continue;
    record.uid = nodes[place->second].uid;
    kept.push_back(record);
  }
  if (!mixed.empty()) result.diagnostics.push_back(not_told_apart(mixed));
  log.nodes = std::move(nodes);
  log.transitions = std::move(kept);
  log.topic.clear();
  log.tree = known.id;
  result.value = std::move(log);
  return result;
}

// --- The search --------------------------------------------------------------

namespace {

// A record that a model has to take.
struct Wanted {
  LogEvent event;
  std::size_t record = 0;
  std::int64_t tick = 0;
  bool is_answer = false;  // whether or not it changes the status
};

// A change that a step makes.
struct Change {
  LogEvent event;
  bool is_optional = false;  // up to the user's program
  bool is_answer = false;
};

// What one step of the network writes into a log.
//
// In logs of BehaviorTree.CPP that is what TreeNode::setStatus and resetStatus
// tell (src/tree_node.cpp): an answer is a change of the status that the
// network keeps, and SetsRunning says where a tick sets RUNNING before
// it answers. In logs that btcheck has written, and in those of other trees,
// which have no such status, a node with children is RUNNING once it is ticked.
class Observer {
 public:
  // `answers`: of which nodes the log has each answer.
  Observer(const BehaviorTree& tree, const CompiledNetwork& system,
           const LoggedNodes& nodes, bool is_own, std::vector<bool> answers)
      : tree_(tree),
        system_(system),
        nodes_(nodes),
        answers_(std::move(answers)),
        keeps_status_(is_engine(tree.profile) && !is_own) {
    const Network& network = system.network();
    by_status_.resize(network.variables.size());
    place_.resize(tree.nodes.size());
    std::size_t place = 0;
    for (const NodeId node : post_order(tree)) place_[index(node)] = place++;
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      if (keeps_status_) {
        by_status_[index(network.node_status[n])] = NodeId{n};
      }
    }
    for (const Automaton& automaton : network.automata) {
      for (const Edge& edge : automaton.edges) {
        by_edge_.push_back(told_of(automaton, edge));
      }
    }
    words_ = (tree.nodes.size() + kInWord - 1) / kInWord;
  }

  std::size_t words() const { return words_; }

  bool begins_tick(const Step& step) const {
    if (step.edge == kTimeStep) return false;
    const Told& told = by_edge_[step.edge];
    return told.role == LocationRole::Tick && tree_.node(told.node).is_root();
  }

  // The log has this, which may have been up to the program.
  void note(const LogEvent& event, std::span<Word> statuses) const {
    if (keeps_status_) put(statuses, event.node, event.status);
  }

  // Adds the changes of status that the step to `state` makes to `changes`, and
  // brings up to date which status the log has of each node.
  void see(const Step& step, StateView state, std::span<Word> statuses,
           std::vector<Change>& changes) const {
    if (step.edge == kTimeStep) return;
    const Told& told = by_edge_[step.edge];
    const bool runs_first = told.begins && begins(told.node, statuses) &&
                            !may_skip_beginning(told.node);
    see_changes(told, state, statuses, changes);
    if (answers_.empty() || !answers_[index(told.node)]) return;
    const auto answer = answer_of(told.role);
    if (!answer) return;
    // The engine sets the status of a node that has answered; unless it runs
    // already, as it does first of all.
    const Change own{{told.node, *answer}, false, true};
    const auto place = std::ranges::find(changes, own.event, &Change::event);
    const bool is_set = runs_first && *answer == LogStatus::Running;
    changes.insert(is_set ? changes.end() : place, own);
  }

 private:
  static std::optional<LogStatus> answer_of(LocationRole role) {
    switch (role) {
      case LocationRole::Success:
        return LogStatus::Success;
      case LocationRole::Failure:
        return LogStatus::Failure;
      case LocationRole::Running:
        return LogStatus::Running;
      case LocationRole::Skipped:
        return LogStatus::Skipped;
      case LocationRole::Inner:
      case LocationRole::Start:
      case LocationRole::Tick:
      case LocationRole::Evaluate:
      case LocationRole::Call:
      case LocationRole::Called:
      case LocationRole::Error:
      case LocationRole::Halt:
      case LocationRole::Halted:
      case LocationRole::Done:
        break;
    }
    return std::nullopt;
  }

  struct Told;
  void see_changes(const Told& told, StateView state, std::span<Word> statuses,
                   std::vector<Change>& changes) const {
    if (!keeps_status_) return see_entered(told, statuses, changes);
    for (const VariableId variable : told.statuses) {
      const NodeId node = *by_status_[index(variable)];
      const auto value =
          static_cast<NodeStatus>(system_.value(state, variable));
      if (const auto status = status_of(value)) {
        set(node, *status, statuses, changes);
      }
    }
    if (told.begins) begin(told.node, statuses, changes);
  }

  static constexpr std::size_t kBits = 2;
  static constexpr std::size_t kInWord = sizeof(Word) * 8 / kBits;

  struct Told {
    NodeId node{};
    LocationRole role = LocationRole::Inner;  // that it enters
    bool begins = false;                      // it may set RUNNING here
    std::vector<VariableId> statuses;         // that it assigns, in order
  };

  Told told_of(const Automaton& automaton, const Edge& edge) const {
    Told told;
    if (automaton.kind != AutomatonKind::Node || edge.source == edge.target) {
      return told;
    }
    told.node = automaton.node;
    told.role = automaton.target(edge).role;
    if (!keeps_status_) return told;
    const Node& node = tree_.node(told.node);
    const SetsRunning when = sets_running_of(node);
    if (node.children.empty()) {
      // Where its tick() begins, and may answer anything.
      const auto body = automaton.find_location("tick");
      told.begins = may_begin(node) && (body ? edge.target == *body
                                             : told.role == LocationRole::Tick);
    } else if (!node.is_root()) {
      told.begins = sets_running(when, automaton.source(edge).name,
                                 automaton.target(edge).name,
                                 told.role == LocationRole::Call);
    }
    for (const Assignment& update : edge.updates) {
      if (by_status_[index(update.variable)]) {
        told.statuses.push_back(update.variable);
      }
    }
    // As a log is written of a run: children first, from left to right.
    std::ranges::sort(told.statuses, {}, [&](VariableId variable) {
      return place_[index(*by_status_[index(variable)])];
    });
    return told;
  }

  SetsRunning sets_running_of(const Node& node) const {
    return sets_running_in(node.type, tree_.profile);
  }

  // Nothing where the node keeps the status it has.
  static std::optional<LogStatus> status_of(NodeStatus value) {
    switch (value) {
      case NodeStatus::NoRetStatus:
      case NodeStatus::Skipped:
        return LogStatus::Idle;
      case NodeStatus::Success:
        return LogStatus::Success;
      case NodeStatus::Failure:
        return LogStatus::Failure;
      case NodeStatus::Running:
      case NodeStatus::SkippedRunning:
        return LogStatus::Running;
      case NodeStatus::HaltMe:
      case NodeStatus::SkippedEnded:
        break;
    }
    return std::nullopt;
  }

  static LogStatus status(std::span<const Word> statuses, NodeId node) {
    const std::size_t shift = index(node) % kInWord * kBits;
    return static_cast<LogStatus>(statuses[index(node) / kInWord] >> shift & 3);
  }
  static bool runs(std::span<const Word> statuses, NodeId node) {
    return status(statuses, node) == LogStatus::Running;
  }
  static void put(std::span<Word> statuses, NodeId node, LogStatus now) {
    const std::size_t shift = index(node) % kInWord * kBits;
    Word& word = statuses[index(node) / kInWord];
    word = (word & ~(Word{3} << shift)) | static_cast<Word>(now) << shift;
  }

  void tell(NodeId node, LogStatus now, std::vector<Change>& changes,
            bool is_optional = false) const {
    if (nodes_.is_logged(node)) changes.push_back({{node, now}, is_optional});
  }

  void set(NodeId node, LogStatus now, std::span<Word> statuses,
           std::vector<Change>& changes) const {
    const LogStatus before = status(statuses, node);
    if (before == now || tree_.node(node).is_root()) return;
    put(statuses, node, now);
    // That an answer is reset is not looked at.
    if (now == LogStatus::Idle && before != LogStatus::Running) return;
    if (is_completed(now) && before == LogStatus::Running &&
        sets_running_of(tree_.node(node)) == SetsRunning::FirstMayHalt) {
      tell(node, LogStatus::Idle, changes, true);
    }
    tell(node, now, changes);
  }

  // A leaf of the program's own, not one that the engine brings along.
  bool may_begin(const Node& leaf) const {
    return sets_running_of(leaf) == SetsRunning::AsProgrammed &&
           btcpp::builtin_type(btcpp::dialect_of(tree_.profile), leaf.id) ==
               nullptr;
  }

  // Where it sets RUNNING, if it does: whether that changes the status.
  bool begins(NodeId node, std::span<const Word> statuses) const {
    const LogStatus before = status(statuses, node);
    if (before == LogStatus::Running) return false;
    return !is_from_idle(sets_running_of(tree_.node(node))) ||
           before == LogStatus::Idle;
  }
  bool may_skip_beginning(NodeId node) const {
    return sets_running_of(tree_.node(node)) == SetsRunning::AsProgrammed;
  }

  void begin(NodeId node, std::span<Word> statuses,
             std::vector<Change>& changes) const {
    if (!begins(node, statuses)) return;
    const bool is_optional = may_skip_beginning(node);
    if (!is_optional) put(statuses, node, LogStatus::Running);
    tell(node, LogStatus::Running, changes, is_optional);
  }

  // --- Logs of btcheck, and trees of others

  void see_entered(const Told& told, std::span<Word> statuses,
                   std::vector<Change>& changes) const {
    switch (told.role) {
      case LocationRole::Tick:
        if (!tree_.node(told.node).children.empty()) {
          run(told.node, statuses, changes);
        }
        break;
      case LocationRole::Running:
        run(told.node, statuses, changes);
        break;
      case LocationRole::Success:
        complete(told.node, LogStatus::Success, statuses, changes);
        break;
      case LocationRole::Failure:
        complete(told.node, LogStatus::Failure, statuses, changes);
        break;
      case LocationRole::Skipped:
      case LocationRole::Halted:
        reset(told.node, statuses, changes);
        break;
      case LocationRole::Inner:
      case LocationRole::Start:
      case LocationRole::Evaluate:
      case LocationRole::Call:
      case LocationRole::Called:
      case LocationRole::Error:
      case LocationRole::Halt:
      case LocationRole::Done:
        break;
    }
  }

  void run(NodeId node, std::span<Word> statuses,
           std::vector<Change>& changes) const {
    if (runs(statuses, node)) return;
    put(statuses, node, LogStatus::Running);
    tell(node, LogStatus::Running, changes);
  }

  // Those below it that are left running go first.
  void complete(NodeId node, LogStatus answer, std::span<Word> statuses,
                std::vector<Change>& changes) const {
    for (const NodeId child : tree_.node(node).children) {
      reset(child, statuses, changes);
    }
    put(statuses, node, LogStatus::Idle);
    tell(node, answer, changes);
  }

  // A node that runs, and what runs below it, children first.
  void reset(NodeId top, std::span<Word> statuses,
             std::vector<Change>& changes) const {
    if (!runs(statuses, top)) return;
    std::vector<NodeId> running{top};
    for (std::size_t i = 0; i < running.size(); ++i) {
      const auto& children = tree_.node(running[i]).children;
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        if (runs(statuses, *child)) running.push_back(*child);
      }
    }
    // Pre-order numbers: with the right-most last, from behind is post-order.
    std::ranges::sort(running);
    for (const NodeId node : post_order_of(running)) {
      put(statuses, node, LogStatus::Idle);
      tell(node, LogStatus::Idle, changes);
    }
  }

  // Of nodes in pre-order, each below the first.
  std::vector<NodeId> post_order_of(const std::vector<NodeId>& nodes) const {
    std::vector<NodeId> order;
    std::vector<NodeId> open;
    for (const NodeId node : nodes) {
      while (!open.empty() && tree_.node(node).parent != open.back()) {
        order.push_back(open.back());
        open.pop_back();
      }
      open.push_back(node);
    }
    order.insert(order.end(), open.rbegin(), open.rend());
    return order;
  }

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  const LoggedNodes& nodes_;
  std::vector<bool> answers_;  // by node; empty: the log has none
  bool keeps_status_;
  std::vector<std::size_t> place_;                // by node, in post-order
  std::vector<std::optional<NodeId>> by_status_;  // by variable
  std::vector<Told> by_edge_;                     // by number of the edge
  std::size_t words_ = 0;
};

class Follower {
 public:
  Follower(const BehaviorTree& tree, const CompiledNetwork& system,
           const LoggedNodes& nodes, const BehaviorLog& log,
           std::vector<bool> answers, const Limits& limits)
      : system_(system),
        observer_(tree, system, nodes, is_own(log), std::move(answers)),
        counts_ticks_(is_own(log) || log.marks),
        limits_(limits),
        system_words_(system.word_count()),
        words_(system_words_ + observer_.words() + 1) {}

  void run(const std::vector<Wanted>& wanted, Conformance& found) {
    wanted_ = &wanted;
    StateVector first(words_, 0);
    system_.initial_states([&](StateView state) {
      std::ranges::copy(state, first.begin());
      put(0, first);
    });
    std::size_t at = 0;
    for (; at < wanted.size(); ++at) {
      if (!layers_.contains(at)) continue;
      if (!expand(at, found)) return;
      layers_.erase(at);
      if (layers_.empty()) break;
    }
    found.records = furthest_;
    if (at < wanted.size()) {
      found.refused = wanted[refused_].record;
      if (wanted[refused_].is_answer) {
        found.refused_answer = wanted[refused_].event;
      }
      found.tick = wanted[refused_].tick;
      found.allowed = std::move(allowed_);
      found.is_in_wrong_tick = is_in_wrong_tick_;
      return;
    }
    collect(found);
  }

 private:
  void put(std::size_t at, StateView state) {
    furthest_ = std::max(furthest_, at);
    layers_.try_emplace(at, words_).first->second.insert(state);
  }

  std::size_t bytes() const {
    std::size_t all = 0;
    for (const auto& [at, layer] : layers_) all += layer.bytes();
    return all;
  }

  // All that can be reached before the record is taken, and from there on.
  bool expand(std::size_t at, Conformance& found) {
    VectorSet& layer = layers_.at(at);
    if (at > refused_) begin_refusals(at);
    for (std::uint32_t next = 0; next < layer.size(); ++next) {
      if (found.progress.expanded % kPollInterval == 0 || next == 0) {
        if (!may_go_on(at, found)) return false;
      }
      const StateView view = layer[next];
      present_.assign(view.begin(), view.end());
      ++found.progress.expanded;
      step_from(at, layer);
    }
    found.progress.states = found.progress.expanded;
    return true;
  }

  bool may_go_on(std::size_t at, Conformance& found) const {
    found.progress.states = found.progress.expanded;
    found.progress.bytes = bytes();
    found.progress.depth = at;
    found.stopped = limits_.reached(found.progress);
    return found.stopped == StopReason::None;
  }

  void step_from(std::size_t at, VectorSet& layer) {
    const StateView state(present_.data(), system_words_);
    system_.successors(state, [&](StateView target, Step step) {
      if (target.size() == state.size() && step.edge == kTimeStep &&
          std::ranges::equal(target, state)) {
        return;
      }
      reached_ = present_;
      std::ranges::copy(target, reached_.begin());
      if (observer_.begins_tick(step) && counts_ticks_) {
        if (reached_.back() >= static_cast<Word>((*wanted_)[at].tick)) return;
        ++reached_.back();
      }
      changes_.clear();
      observer_.see(step, target, statuses_of(reached_), changes_);
      if (changes_.empty()) {
        layer.insert(reached_);
      } else {
        take(at);
      }
    });
  }

  std::span<Word> statuses_of(StateVector& state) const {
    return std::span(state).subspan(system_words_, observer_.words());
  }

  // The changes of a step against the records that come next. Where the log
  // ends among them, it ends in the middle of the step.
  void take(std::size_t at) {
    for (const Change& change : changes_) {
      if (at == wanted_->size()) return put(at, reached_);
      const Wanted& next = (*wanted_)[at];
      const bool is_in_time =
          !counts_ticks_ || reached_.back() == static_cast<Word>(next.tick);
      const bool is_that =
          next.event == change.event && next.is_answer == change.is_answer;
      if (is_that && is_in_time) {
        ++at;
        if (!change.is_answer) {
          observer_.note(change.event, statuses_of(reached_));
        }
      } else if (!change.is_optional) {
        return note_refused(at, change.event, is_that);
      }
    }
    put(at, reached_);
  }

  void note_refused(std::size_t at, const LogEvent& instead,
                    bool is_wrong_tick) {
    if (at < refused_) return;
    if (at > refused_) begin_refusals(at);
    is_in_wrong_tick_ |= is_wrong_tick;
    const bool is_new = std::ranges::find(allowed_, instead) == allowed_.end();
    if (is_new && !is_wrong_tick) allowed_.push_back(instead);
  }

  void begin_refusals(std::size_t at) {
    refused_ = at;
    allowed_.clear();
    is_in_wrong_tick_ = false;
  }

  void collect(Conformance& found) {
    const auto last = layers_.find(wanted_->size());
    if (last == layers_.end()) {
      // An empty log: nothing has happened yet.
      return;
    }
    VectorSet alone(system_words_);
    for (std::uint32_t i = 0; i < last->second.size(); ++i) {
      const StateView state = last->second[i].first(system_words_);
      if (alone.insert(state).is_new) {
        found.states.emplace_back(state.begin(), state.end());
      }
    }
  }

  const CompiledNetwork& system_;
  Observer observer_;
  bool counts_ticks_;
  const Limits& limits_;
  std::size_t system_words_;
  std::size_t words_;  // those of the network, the statuses, the tick
  const std::vector<Wanted>* wanted_ = nullptr;
  std::map<std::size_t, VectorSet> layers_;  // by the record that comes next
  std::size_t furthest_ = 0;
  std::size_t refused_ = 0;
  std::vector<LogEvent> allowed_;
  bool is_in_wrong_tick_ = false;
  StateVector present_;
  StateVector reached_;
  std::vector<Change> changes_;
};

// The records that a model has to take, and the answers where the log has them;
// a record that contradicts an earlier one ends them.
class WantedEvents {
 public:
  WantedEvents(const BehaviorTree& tree, const BehaviorLog& log,
               const LoggedNodes& nodes, std::optional<int> until,
               Conformance& found)
      : tree_(tree), log_(log), nodes_(nodes), until_(until), found_(found) {}

  std::vector<Wanted> all(const LogReading& reading) {
    if (log_.marks) {
      each_mark(*log_.marks, [&](const LogMark& mark) { take(mark); });
      return std::move(wanted_);
    }
    const std::vector<std::int64_t> ticks = ticks_of(log_, reading);
    for (; record_ < ticks.size() && !is_over(ticks[record_]); ++record_) {
      take_record(ticks[record_]);
    }
    return std::move(wanted_);
  }

  // Of which nodes there are answers.
  std::vector<bool> answers(std::size_t count) const {
    std::vector<bool> answers;
    if (!log_.marks) return answers;
    answers.resize(count, false);
    for (const LogMark& mark : log_.marks->events) {
      if (mark.kind == MarkKind::NodeAnswers) {
        answers[index(nodes_.node(mark.uid))] = true;
      }
    }
    return answers;
  }

 private:
  bool is_over(std::int64_t tick) const {
    return !found_.contradiction.empty() || (until_ && tick > *until_);
  }

  void take(const LogMark& mark) {
    if (begins_tick(mark)) ++tick_;
    if (begins_tick(mark)) is_in_tick_ = true;
    if (mark.kind == MarkKind::TickEnds || mark.kind == MarkKind::TickIsLeft) {
      is_in_tick_ = false;
    }
    if (is_over(tick_)) return;
    if (mark.kind == MarkKind::NodeAnswers) take_answer(mark);
    if (mark.kind == MarkKind::WasBefore) ++record_;
    if (mark.kind != MarkKind::Record) return;
    // A thread sets what its node answers in the next tick.
    const bool is_ahead =
        !is_in_tick_ && log_.transitions[record_].after != LogStatus::Idle;
    take_record(is_ahead ? tick_ + 1 : tick_);
    ++record_;
  }

  // A node that has set its status by itself, such as SimpleActionNode, answers
  // behind that record, where others answer before it.
  void take_answer(const LogMark& mark) {
    const LogEvent event{nodes_.node(mark.uid), mark.status};
    const auto is_one = [&](std::size_t behind, bool is_answer) {
      if (wanted_.size() < behind) return false;
      const Wanted& wanted = wanted_[wanted_.size() - behind];
      return wanted.event == event && wanted.tick == tick_ &&
             wanted.is_answer == is_answer;
    };
    // That it began to run stands in front of its answer for another reason.
    const bool has_begun = event.status == LogStatus::Running &&
                           may_begin_before_its_answer(event.node);
    const bool has_set = !has_begun && is_one(1, false) && !is_one(2, true);
    wanted_.insert(
        wanted_.end() - (has_set ? 1 : 0),
        {event, std::min(record_, log_.transitions.size() - 1), tick_, true});
  }

  bool may_begin_before_its_answer(NodeId node) const {
    const SetsRunning when =
        sets_running_in(tree_.node(node).type, tree_.profile);
    return when != SetsRunning::Never && when != SetsRunning::AsProgrammed;
  }

  void take_record(std::int64_t tick) {
    const LogTransition& record = log_.transitions[record_];
    if (record.before == record.after) {
      found_.contradiction =
          fmt::format("it is {} already",
                      kLogStatusNames[static_cast<std::size_t>(record.after)]);
    } else if (record.time < time_ && is_own(log_)) {
      found_.contradiction = "it is earlier than the record before";
    }
    time_ = record.time;
    if (!found_.contradiction.empty()) {
      found_.refused = record_;
      return;
    }
    const bool is_reset =
        record.before != LogStatus::Running &&
        (record.after == LogStatus::Idle || record.after == LogStatus::Skipped);
    if (is_reset) return;
    const LogStatus status =
        record.after == LogStatus::Skipped ? LogStatus::Idle : record.after;
    wanted_.push_back({{nodes_.node(record.uid), status}, record_, tick});
  }

  const BehaviorTree& tree_;
  const BehaviorLog& log_;
  const LoggedNodes& nodes_;
  const std::optional<int> until_;
  Conformance& found_;
  std::vector<Wanted> wanted_;
  std::size_t record_ = 0;
  std::int64_t tick_ = 0;
  std::int64_t time_ = 0;
  bool is_in_tick_ = false;
};

}  // namespace

Conformance conform(const BehaviorTree& tree, const CompiledNetwork& system,
                    const BehaviorLog& log, const LoggedNodes& nodes,
                    const Limits& limits, std::optional<int> until,
                    const LogReading& reading) {
  Conformance found;
  WantedEvents events(tree, log, nodes, until, found);
  const std::vector<Wanted> wanted = events.all(reading);
  const auto contradicted = found.refused;
  found.refused.reset();
  Follower(tree, system, nodes, log, events.answers(tree.nodes.size()), limits)
      .run(wanted, found);
  if (!found.refused && contradicted && found.stopped == StopReason::None) {
    found.refused = contradicted;
    found.states.clear();
  } else {
    found.contradiction.clear();
  }
  return found;
}

}  // namespace btcheck

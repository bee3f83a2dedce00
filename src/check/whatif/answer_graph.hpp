// SPDX-License-Identifier: MIT
//
// All runs of a network as a graph whose steps tell what nodes answer: what
// somebody sees who watches the tree, and nothing of what leaves mean by it.
#pragma once

#include <boost/container_hash/hash.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/search/searched_network.hpp"
#include "explore/components/component_store.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/step.hpp"
#include "explore/store/state_store.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

enum class Happening : std::uint8_t {
  Asked,  // a leaf or a root is ticked
  Success,
  Failure,
  Running,
  Skipped,
  Halted,
  Struck  // a fault of the leaf strikes
};
inline bool is_answer(Happening happening) {
  return happening >= Happening::Success && happening <= Happening::Skipped;
}

// What happens to one node, in four bytes.
class NodeEvent {
 public:
  NodeEvent(NodeId node, Happening what)
      : bits_(index(node) << 3 | static_cast<std::uint32_t>(what)) {}
  NodeId node() const { return NodeId{bits_ >> 3}; }
  Happening what() const { return static_cast<Happening>(bits_ & 7); }
  std::uint32_t bits() const { return bits_; }
  friend bool operator==(const NodeEvent&, const NodeEvent&) = default;
  friend std::size_t hash_value(NodeEvent event) { return event.bits(); }

 private:
  std::uint32_t bits_;
};

// What somebody sees of a node that gets to a place of this role.
std::optional<Happening> shown_as(LocationRole role);
// Of the node that an edge moves; nothing of an edge that shows nothing.
std::optional<NodeEvent> event_of(const Network& network, std::uint32_t edge);

// How a state stands to the mission.
enum class Ending : std::uint8_t {
  None,       // it goes on
  Success,    // all roots have succeeded
  Failure,    // some root has not, and all have ended
  Exception,  // nothing moves any more
};
// In order: no exception has left everything as it is.
inline bool has_ended(Ending ending) {
  return ending == Ending::Success || ending == Ending::Failure;
}

// Nodes that are listened to while all others stand as components: runs of all
// of the network that differ in what is heard are all there.
struct Heard {
  // By NodeId; all above one are as well. Empty: all nodes.
  std::vector<bool> nodes = {};
  ComponentStore* known = nullptr;  // of components

  bool is_all() const { return nodes.empty(); }
  bool hears(NodeId node) const { return is_all() || nodes[index(node)]; }
};

class AnswerGraph {
 public:
  struct Arc {
    std::uint32_t target = 0;
    std::uint32_t events : 29 = 0;  // for `events`
    // Something else than a free variable moves.
    std::uint32_t is_progress : 1 = 1;
    // It stands for one step of the network; or its first event, if any, is
    // that of the first of its steps.
    std::uint32_t is_single : 1 = 1;
    std::uint32_t begins_with_event : 1 = 1;
  };

  // Searches at once. Tree and network must outlive it, and what is heard.
  AnswerGraph(const BehaviorTree& tree, const Network& network,
              const Limits& limits, Reduction reduction = Reduction::Full,
              const Heard& heard = kAllHeard);
  ~AnswerGraph();
  AnswerGraph(const AnswerGraph&) = delete;
  AnswerGraph& operator=(const AnswerGraph&) = delete;

  StopReason stopped() const { return stopped_; }
  const SearchProgress& progress() const { return progress_; }
  std::uint32_t size() const {
    return static_cast<std::uint32_t>(endings_.size());
  }
  std::span<const Arc> arcs(std::uint32_t state) const {
    return {arcs_.data() + first_[state], arcs_.data() + first_[state + 1]};
  }
  std::uint32_t first_arc(std::uint32_t state) const { return first_[state]; }
  const Arc& arc(std::uint32_t number) const { return arcs_[number]; }
  std::span<const NodeEvent> events(const Arc& arc) const {
    return *sequences_[arc.events];
  }
  Ending ending(std::uint32_t state) const { return endings_[state]; }
  // Every fault of the tree has struck.
  bool has_struck(std::uint32_t state) const { return struck_[state]; }
  // From there some run leads to an end of the mission, or to an exception.
  const std::vector<bool>& can_end() const { return can_end_; }
  // Leaves that run in a state that ends the mission, of those that are heard.
  std::vector<NodeId> running(std::uint32_t state) const;

  // The numbers of the arcs on a shortest way to a state.
  std::vector<std::uint32_t> path_to(std::uint32_t state) const;
  // The single steps along arcs that follow each other from the beginning on,
  // executed again; sets `error` where they cannot be.
  std::vector<Step> steps_along(std::span<const std::uint32_t> path,
                                std::string& error) const;

 private:
  void search(const Limits& limits);
  void expand(std::uint32_t state);
  std::uint32_t source_of(std::uint32_t arc) const;
  void note(StateView state);
  // Calls found(target, step, single steps, whether the first of them has an
  // event) for each step, with what happens in it.
  template <class Visit>
  void visit(StateView state, std::vector<NodeEvent>& happened,
             Visit found) const;
  std::uint32_t sequence_of(const std::vector<NodeEvent>& events);
  void measure(std::uint32_t expanded);
  void close();

  struct Parts;
  static const Heard kAllHeard;

  const BehaviorTree& tree_;
  const Heard& heard_;
  CompiledNetwork system_;
  const std::unique_ptr<Parts> parts_;  // null: all stand as they are
  SearchedNetwork searched_;
  StateStore store_;
  std::vector<std::uint32_t> reached_by_;  // by state: an arc
  std::vector<std::optional<NodeEvent>> event_of_edge_;
  struct Fault {
    NodeId leaf{};
    VariableId phase{};
  };
  std::vector<Fault> faults_;

  std::vector<std::uint32_t> first_;  // by state
  std::vector<Arc> arcs_;
  std::unordered_map<std::vector<NodeEvent>, std::uint32_t,
                     boost::hash<std::vector<NodeEvent>>>
      known_sequences_;
  std::vector<const std::vector<NodeEvent>*> sequences_;  // by number
  std::size_t event_count_ = 0;                           // in all of them
  std::vector<Ending> endings_;
  std::vector<bool> struck_;
  std::vector<bool> can_end_;
  StopReason stopped_ = StopReason::None;
  SearchProgress progress_;
};

// The network of a tree to be searched so: of larger numbers with a value of
// each region that the tree tells apart. An error at each SetSV with too many.
Result<Network> lower_regions(const BehaviorTree& tree,
                              const SourceText& source, TickSemantics ticks);

// Where a fault of the leaf stands; nothing where it has none.
std::optional<VariableId> fault_phase(const Network& network, NodeId leaf);

}  // namespace btcheck

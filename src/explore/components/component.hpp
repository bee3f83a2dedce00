// SPDX-License-Identifier: MIT
//
// A subtree as one small automaton.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "explore/minimise/partition.hpp"
#include "explore/reduce/call_protocol.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The values of a network's variables, by VariableId.
using Values = std::vector<int>;

// The subtree below an automaton, looked at from outside: what it does to the
// variables that others use as well, when and under which conditions; all else
// that it does is silent. Its states are those of its own variables that any
// caller can bring about that keeps to the protocol, and of them only one is
// left of each block of the coarsest divergence-preserving branching
// bisimulation. Put in the place of the subtree, its automaton makes the
// network branching bisimilar to what it was (docs/reductions.md).
class Component {
 public:
  // What takes the place of the automaton of the subtree's root.
  Automaton automaton;
  Variable location;
  // In which of the states between two calls it is.
  Variable memory;
  VariableId memory_id{};

  // The single edges of the subtree, as places in the automata that they belong
  // to, that stand for an edge of `automaton`.
  struct Member {
    std::uint32_t child = 0;  // 0: the root of the subtree, else child - 1
    std::uint32_t edge = 0;   // of its automaton, or of its component's
  };

  // States of the subtree, and blocks of them.
  std::size_t size() const { return graph_.size(); }
  std::size_t blocks() const { return partition_.blocks; }

 private:
  friend class Components;
  friend class OpenSubtree;

  struct Arc {
    std::uint32_t label = 0;
    std::uint32_t target = 0;
    Member member;
  };
  // Where the automaton stands in a block.
  struct Place {
    int location = 0;
    int memory = 0;
  };
  struct Drawn {
    std::uint32_t label = 0;
    std::uint32_t from = 0;  // block
    std::uint32_t to = 0;
  };
  struct HashOfValues {
    std::size_t operator()(const Values& values) const;
  };

  std::span<const Arc> arcs(std::uint32_t state) const {
    return {arcs_.data() + first_[state], arcs_.data() + first_[state + 1]};
  }

  std::vector<VariableId> own_;  // the variables of its states
  std::unordered_map<Values, std::uint32_t, HashOfValues> states_;
  std::vector<std::uint32_t> first_;
  std::vector<Arc> arcs_;
  LabelledGraph graph_;
  Partition partition_;
  std::vector<Place> places_;  // by block
  std::vector<Drawn> drawn_;   // by edge of the automaton
};

// The components of a network, each made when it is asked for first.
class Components {
 public:
  struct Limits {
    std::size_t states = 50'000;
    std::size_t edges = 5'000;  // of one automaton
  };

  // `shared`: by variable, whether somebody else looks at it. Edges of which
  // one with `marks` is another step than one without are by their number. The
  // network must outlive this.
  Components(const Network& network, std::vector<bool> shared,
             std::vector<std::uint8_t> marks, Limits limits);
  Components(const Components&) = delete;
  Components& operator=(const Components&) = delete;

  const Network& network() const { return network_; }
  const CallProtocol& protocol() const { return protocol_; }
  const std::vector<AutomatonId>& children(AutomatonId id) const {
    return children_[index(id)];
  }
  // Null where the subtree cannot be one, or is too large to be.
  const Component* of(AutomatonId root);
  // The variables that nobody else touches, but for those of the subtree's own
  // call and answer.
  bool is_inside(AutomatonId root, VariableId variable) const;
  // Behind those of the network: the memories of the components.
  std::size_t variable_count() const {
    return network_.variables.size() + network_.automata.size();
  }
  VariableId memory_of(AutomatonId root) const {
    return VariableId{static_cast<std::uint32_t>(network_.variables.size()) +
                      index(root)};
  }

  // Takes an edge of a component, in values of the network's variables: fires
  // the single edges that it stands for and appends their numbers. False, and
  // nothing of use in either, where it cannot be taken.
  bool take(Values& values, AutomatonId root, std::uint32_t edge,
            std::vector<std::uint32_t>& taken) const;
  // An edge of the network itself.
  void fire(Values& values, std::uint32_t edge) const;
  std::optional<Component::Place> place(const Values& values,
                                        AutomatonId root) const;

 private:
  friend class OpenSubtree;

  std::optional<std::uint32_t> state_of(const Values& values,
                                        AutomatonId root) const;
  bool may_be_component(AutomatonId root) const;

  const Network& network_;
  const std::vector<std::uint8_t> marks_;
  const Limits limits_;
  const CallProtocol protocol_;
  std::vector<std::vector<AutomatonId>> children_;  // by AutomatonId
  std::vector<std::uint32_t> first_inside_;  // by AutomatonId: of its subtree
  std::vector<bool> has_timer_;              // by AutomatonId
  // By VariableId: who touches it, the first and the last.
  std::vector<std::uint32_t> first_user_, last_user_;
  std::vector<std::optional<std::optional<Component>>> known_;
};

}  // namespace btcheck

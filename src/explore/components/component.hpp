// SPDX-License-Identifier: MIT
//
// A subtree as one small automaton.
#pragma once

#include <boost/container_hash/hash.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "explore/components/component_store.hpp"
#include "explore/minimise/partition.hpp"
#include "explore/reduce/call_protocol.hpp"
#include "explore/reduce/called_with.hpp"
#include "explore/state/accesses.hpp"
#include "explore/state/valuation.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

class CutPart;
struct PlacedComponent;

// Which part of a network: the subtree of an automaton, or what is outside of
// it in its tree. The subtree of a root is the whole tree.
enum class PartSide : std::uint8_t { Inside, Outside };

// What a part is made of: automata of the network, and components.
struct PartMember {
  AutomatonId automaton{};
  const PlacedComponent* component = nullptr;  // that of this side of it
  PartSide side = PartSide::Inside;
};

// A part of a network, looked at from the rest of it: what it does to the
// variables that both use, when and under which conditions; all else that it
// does is silent. The part is a subtree, or all that is outside of one.
//
// Its states are those of its own variables that any other part can bring about
// that keeps to the protocol of calls. Of them one is left of each block of the
// coarsest divergence-preserving branching bisimulation, and of those in which
// it goes on silently and in no other way none: what it decides by itself it
// decides with the step before. In the place of the part, its automaton leaves
// a network the runs that it had, but for silent steps (docs/reductions.md).
//
// Variables have numbers of the part's own here, so that one component stands
// for all parts that are made alike, in any network.
class Component {
 public:
  Automaton automaton;
  Variable location;
  VariableId location_id{};
  // Of a subtree that is called: in which of its states between two calls it
  // is.
  Variable memory;
  VariableId memory_id{};
  // By the value of its memory, of what nobody calls by that of its location:
  // the one after a unit of time in which it does nothing.
  std::vector<int> later;
  // No time passes while it is called.
  bool is_instant = true;
  // The variables that the automaton speaks of, its location and memory first;
  // and all of the above in terms of these. Where both are equal, so is what
  // the parts do.
  std::vector<VariableId> spoken_of;
  ContentHash content;

  // A single edge of the part: of one of its members, by its place in that.
  struct Member {
    std::uint32_t number = 0;
    std::uint32_t edge = 0;
  };
  // Where the automaton stands.
  struct Place {
    int location = 0;
    int memory = 0;
  };

  // Instead of a place: it goes on silently from there, and is never seen.
  static constexpr std::uint32_t kPassing = 0xffffffff;

  // States of the part, and what is left of them.
  std::size_t size() const { return place_of_.size(); }
  std::size_t place_count() const { return places_.size(); }
  std::size_t bytes() const;

 private:
  friend class ComponentBytes;
  friend class ComponentTable;
  friend class OpenPart;

  struct Arc {
    std::uint32_t label = 0;
    std::uint32_t target = 0;
    Member member;
  };
  struct Drawn {
    std::uint32_t label = 0;
    std::uint32_t from = 0;  // of places_
    std::uint32_t to = 0;
    bool is_loop = false;  // silent, and leads back
  };
  // Of one state: the values of own_.
  using Values = std::vector<int>;
  using Numbers =
      std::unordered_map<Values, std::uint32_t, boost::hash<Values>>;

  std::vector<const Arc*> way(
      std::uint32_t from, std::uint32_t label,
      const std::function<bool(std::uint32_t)>& ends) const;
  bool is_silent(std::uint32_t state) const;
  // What a part that contains it can know of it: `spoken_of` and `content`.
  void tell_content();
  std::span<const Arc> arcs(std::uint32_t state) const {
    return {arcs_.data() + first_[state], arcs_.data() + first_[state + 1]};
  }

  std::vector<VariableId> own_;  // the variables of its states
  Numbers states_;
  std::vector<std::uint32_t> first_;
  std::vector<Arc> arcs_;
  // By state: where the automaton stands then, as a number of places_, or
  // kPassing.
  std::vector<std::uint32_t> place_of_;
  std::vector<Place> places_;
  std::vector<Drawn> drawn_;  // by edge of the automaton
};

// A component in its network.
struct PlacedComponent {
  std::shared_ptr<const Component> shape;
  std::vector<VariableId> names;  // of the shape's variables, by number
  std::vector<PartMember> members;
  // The shape's, with these names, once it has been asked for.
  Automaton automaton;

  VariableId name(VariableId own) const { return names[index(own)]; }
};

// Where components stand while a run of the network is followed, as far as it
// is known: a step changes that of few.
class Standing {
 public:
  // Time has passed, or it is another state altogether.
  void forget();

 private:
  friend class ComponentTable;

  struct Part {
    AutomatonId root{};
    PartSide side = PartSide::Inside;
  };
  // By side and AutomatonId: the number of a component's state, if it has one.
  std::vector<std::optional<std::optional<std::uint32_t>>> states_[2];
  std::vector<Part> known_;
};

// The components of a network, each made when it is asked for first, or taken
// from those that are known.
class ComponentTable {
 public:
  using Place = Component::Place;
  struct Limits {
    std::size_t states = 200'000;
    std::size_t edges = 5'000;         // of one that stands in a network
    std::size_t inner_edges = 50'000;  // of one that other parts are made of
    std::size_t all_states = 1'000'000;
    std::size_t automata = 2'000;  // of the network: in a larger one are none
  };

  // `shared`: by variable, whether somebody else looks at it. `store`: what is
  // asked for components, and told of new ones; null: nobody. Both must outlive
  // this.
  ComponentTable(const Network& network, const std::vector<bool>& shared,
                 Limits limits, ComponentStore* store = nullptr);
  ComponentTable(const ComponentTable&) = delete;
  ComponentTable& operator=(const ComponentTable&) = delete;

  const Network& network() const { return network_; }
  const CallProtocol& protocol() const { return protocol_; }
  const std::vector<AutomatonId>& roots() const { return roots_; }
  const std::vector<AutomatonId>& children(AutomatonId id) const {
    return protocol_.children(id);
  }
  // Null where the part cannot be one, or is too large to be. Outside of a root
  // is nothing.
  const PlacedComponent* of(AutomatonId root, PartSide side = PartSide::Inside);
  // The same, where it is small enough to stand in a network.
  const PlacedComponent* placeable(AutomatonId root, PartSide side);
  // Of a component that can be one: as it stands in the network.
  const Automaton& automaton_of(AutomatonId root, PartSide side);
  // The nodes that touch a variable, in order; none where somebody else does.
  const std::vector<std::uint32_t>& users_of(VariableId variable) const {
    return users_[index(variable)];
  }
  // Whether only this part touches the variable; the calls and answers of the
  // subtree's root are not asked for.
  bool is_only_in(AutomatonId root, PartSide side, VariableId variable) const;
  AutomatonId root_of(AutomatonId node) const;
  bool is_below(AutomatonId node, AutomatonId root) const {
    return index(node) >= first_inside_[index(root)] &&
           index(node) <= index(root);
  }
  // With those of the components, behind those of the network.
  std::size_t variable_count() const {
    return network_.variables.size() + 2 * network_.automata.size();
  }
  VariableId memory_of(AutomatonId root) const { return behind(0, root); }
  VariableId outside_of(AutomatonId root) const { return behind(1, root); }

  // Where the component that stands for a part stands when the network is in a
  // state; nothing where it passes.
  std::optional<Place> place(const Valuation& state, AutomatonId root,
                             PartSide side, Standing& standing) const;
  // Takes an edge of a component in a state of the network: calls fire(edge)
  // for the single ones that it stands for, one after the other, and each of
  // them has to change the state. False where it cannot be taken.
  using Fire = std::function<bool(std::uint32_t)>;
  bool take(const Valuation& state, AutomatonId root, PartSide side,
            std::uint32_t edge, const Fire& fire, Standing& standing) const;
  // Likewise all that the part does by itself where its component stands: no
  // time passes before.
  bool settle(const Valuation& state, AutomatonId root, PartSide side,
              const Fire& fire, Standing& standing) const;

 private:
  friend class CutPart;

  // Takes steps of a component's states.
  bool follow(const Valuation& state, const PlacedComponent& component,
              const std::vector<const Component::Arc*>& steps, const Fire& fire,
              Standing& standing) const;

  VariableId behind(std::size_t group, AutomatonId automaton) const {
    return VariableId{static_cast<std::uint32_t>(
        network_.variables.size() + group * network_.automata.size() +
        index(automaton))};
  }
  // The clock of an automaton as if it were a variable.
  VariableId clock_of(AutomatonId automaton) const {
    return behind(2, automaton);
  }
  const PlacedComponent& known(AutomatonId root, PartSide side) const {
    return known_[static_cast<std::size_t>(side)][index(root)]->value();
  }
  // Nothing where one of them cannot be had.
  std::optional<std::vector<PartMember>> members(AutomatonId root,
                                                 PartSide side);
  bool may_be_component(AutomatonId root) const;
  // A component that somebody else has made of a part like this one does not
  // speak of anything that the part does not have.
  bool fits(const Component& shape, const CutPart& part,
            const std::vector<PartMember>& members) const;
  std::optional<PlacedComponent> made(AutomatonId root, PartSide side,
                                      std::vector<PartMember> members);
  std::optional<std::uint32_t> state_of(const Valuation& state,
                                        AutomatonId root, PartSide side,
                                        Standing& standing) const;
  std::optional<std::uint32_t> found_state(const Valuation& state,
                                           const PlacedComponent& component,
                                           Standing& standing) const;
  // Behind a step of an automaton that stands in components.
  void forget_around(AutomatonId moved, Standing& standing) const;

  const Network& network_;
  const Limits limits_;
  const CallProtocol protocol_;
  const Accesses accesses_;
  const std::vector<std::optional<CalledWith>> entries_;  // by AutomatonId
  ComponentStore own_store_;
  ComponentStore& store_;
  std::vector<AutomatonId> roots_;
  std::vector<std::uint32_t> first_inside_;  // by AutomatonId: of its subtree
  std::vector<std::vector<AutomatonId>> timers_;  // by AutomatonId: its own
  // By VariableId: the nodes that touch it, in order; none of a variable that
  // somebody else touches as well.
  std::vector<std::vector<std::uint32_t>> users_;
  std::vector<std::optional<std::optional<PlacedComponent>>> known_[2];
  std::size_t states_ = 0;  // of all that are known
};

}  // namespace btcheck

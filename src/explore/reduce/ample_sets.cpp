// SPDX-License-Identifier: MIT
//
// Why the enabled edges of A in an ample location suffice. Take any run from
// the present state.
//
// 1. Nobody interferes. Who else touches a variable that these edges touch is
//    above A, below A, its own timer, or a rival. Those above are blocked while
//    A is called, those below are not called while A can move
//    (call_protocol.hpp), a timer of a fixed period fires only when it is due.
//    A rival would have to be called and then come, without time passing, to an
//    edge that touches such a variable; so would those above it, up to one that
//    is called already, to an edge that calls the next. None of them stands
//    where it could. So until A moves, no step of the run enables, disables or
//    changes an edge of A, and each is independent of what others do meanwhile.
// 2. A moves, or might as well. The edges are due, so no time passes before
//    A moves; without time passing, only free variables could keep moving,
//    which is no run, or other trees (untimed), beside which A's step may be
//    put in front without anyone noticing (3). A variable that is forced to
//    move keeps time from passing, but for one move only: its states last for
//    a unit of time at least.
//    A fault that another automaton runs into ends the run for all; with A's
//    step in front it is reached just the same.
// 3. Nobody notices. No enabled edge of A changes what a question tells apart,
//    so the run with A's step moved to its front passes the same observations
//    in the same order, and between the same steps of time.
// 4. Nothing is put off for ever. On a cycle of the reduced graph take the
//    uppermost automaton that moves. It is not called anew, for then its parent
//    would move; so it goes round in its own locations, or it is a root. On
//    each such round some location is excluded (own_cycles.hpp), so the step
//    from it was taken where everything was explored.
//
// State variables and timers never form an ample set. Dead states are reached
// just the same, since no step leads from them; only, after a fault, with or
// without a step that was put before it. But which step is the last one may
// change: a question that tells a state from a dead one with the same values
// gets no ample sets at all.
#include "explore/reduce/ample_sets.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "explore/reduce/call_protocol.hpp"
#include "explore/state/accesses.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// Fires exactly when it has counted so far, and so before everything else.
bool is_punctual(const Network& network, const Automaton& timer) {
  return network.ticks != TickSemantics::None &&
         std::ranges::all_of(timer.edges, [](const Edge& edge) {
           return edge.when.lower == edge.when.upper && edge.when.upper > 0;
         });
}

// What each edge reads and writes, each variable once: expressions may be long.
class Touched {
 public:
  explicit Touched(const Network& network) {
    for (const Automaton& automaton : network.automata) {
      for (const Edge& edge : automaton.edges) {
        Variables& of = by_edge_.emplace_back();
        for_each_access(
            automaton, edge, [&](VariableId read) { add(of.read, read); },
            [&](VariableId written) { add(of.written, written); });
      }
    }
  }

  struct Variables {
    std::vector<VariableId> read;
    std::vector<VariableId> written;
  };
  const Variables& by(std::uint32_t edge) const { return by_edge_[edge]; }
  bool touches(std::uint32_t edge, VariableId variable) const {
    return has(by_edge_[edge].read, variable) ||
           has(by_edge_[edge].written, variable);
  }

 private:
  static bool has(const std::vector<VariableId>& all, VariableId variable) {
    return std::ranges::find(all, variable) != all.end();
  }
  static void add(std::vector<VariableId>& all, VariableId variable) {
    if (!has(all, variable)) all.push_back(variable);
  }

  std::vector<Variables> by_edge_;
};

// What is read off a network once.
struct Tables {
  const Network& network;
  const CallProtocol protocol{network};
  const Accesses accesses{network};
  const Touched touched{network};
};

// Where a rival stands that may soon touch a variable.
class Dangers {
 public:
  explicit Dangers(const Tables& tables) : tables_(tables) {}

  // From which an edge that touches the variable may be taken before the
  // automaton's turn ends or time passes.
  const std::vector<bool>& locations(AutomatonId of, VariableId variable) {
    const auto [known, is_new] = known_.try_emplace({of, variable});
    if (is_new) known->second = found(tables_.network.automaton(of), variable);
    return known->second;
  }

 private:
  std::vector<bool> found(const Automaton& automaton,
                          VariableId variable) const {
    std::vector<bool> dangerous(automaton.locations.size(), false);
    std::vector<bool> soon(automaton.locations.size(), false);
    for (bool grows = true; grows;) {
      grows = false;
      for (std::uint32_t i = 0; i < automaton.edges.size(); ++i) {
        const Edge& edge = automaton.edges[i];
        const bool leads_on =
            !ends_turn(automaton, edge) && soon[index(edge.target)];
        if (!leads_on &&
            !tables_.touched.touches(automaton.first_edge + i, variable)) {
          continue;
        }
        const std::uint32_t from = index(edge.source);
        const bool waits = takes_time(tables_.network, edge);
        grows |= !dangerous[from] || (!waits && !soon[from]);
        dangerous[from] = true;
        if (!waits) soon[from] = true;
      }
    }
    return dangerous;
  }

  const Tables& tables_;
  std::map<std::pair<AutomatonId, VariableId>, std::vector<bool>> known_;
};

// The rules of all locations of one automaton.
class RuleMaker {
 public:
  RuleMaker(const Tables& tables, Dangers& dangers, AutomatonId id)
      : tables_(tables),
        dangers_(dangers),
        id_(id),
        rules_(tables.network.automaton(id).locations.size(),
               {true,
                tables.network.ticks == TickSemantics::None ? 0 : kNoEdge,
                {}}) {}

  std::vector<AmpleSets::Rule> make() && {
    const Automaton& automaton = tables_.network.automaton(id_);
    for (std::uint32_t i = 0; i < automaton.edges.size(); ++i) {
      look_at(automaton.edges[i], tables_.touched.by(automaton.first_edge + i));
    }
    return std::move(rules_);
  }

 private:
  static constexpr int kNoEdge = -1;  // looked at yet, from a location

  void look_at(const Edge& edge, const Touched::Variables& touched) {
    AmpleSets::Rule& rule = rules_[index(edge.source)];
    rule.may_be_ample = rule.may_be_ample && is_as_due_as(rule, edge);
    for (const VariableId variable : touched.read) {
      if (!read_.emplace(edge.source, variable).second) continue;
      share(rule, tables_.accesses.writers[index(variable)], variable);
    }
    for (const VariableId variable : touched.written) {
      if (!written_.emplace(edge.source, variable).second) continue;
      share(rule, tables_.accesses.readers[index(variable)], variable);
      share(rule, tables_.accesses.writers[index(variable)], variable);
      // A fault ends everything, so it commutes with nothing.
      if (tables_.network.fault == variable) rule.may_be_ample = false;
    }
  }

  // When one edge of the location is due all are; before that, none is enabled.
  bool is_as_due_as(AmpleSets::Rule& rule, const Edge& edge) {
    if (tables_.network.ticks == TickSemantics::None) return true;
    if (rule.due == kNoEdge) rule.due = edge.when.upper;
    return edge.when == Interval{rule.due, rule.due};
  }

  // Others touch a variable that the edges of the rule's location touch.
  void share(AmpleSets::Rule& rule, const std::vector<AutomatonId>& others,
             VariableId variable) {
    for (const AutomatonId other : others) {
      const Automaton& who = tables_.network.automaton(other);
      if (who.kind == AutomatonKind::Node) {
        if (!tables_.protocol.is_line(id_, other))
          add_rivals(rule, other, variable);
      } else if (who.kind == AutomatonKind::StateVariable ||
                 !is_punctual(tables_.network, who) ||
                 tables_.network.node_automaton[index(who.node)] != id_) {
        rule.may_be_ample = false;
      }
    }
  }

  // The other one, and those above it that are not above this one.
  void add_rivals(AmpleSets::Rule& rule, AutomatonId other,
                  VariableId variable) {
    VariableId touched = variable;
    for (std::optional<AutomatonId> at = other;
         at && !tables_.protocol.is_line(id_, *at);
         at = tables_.protocol.parent(*at)) {
      add_rival(rule, *at, dangers_.locations(*at, touched));
      const auto& gate = tables_.network.automaton(*at).gate;
      if (!gate) break;
      touched = *gate;
    }
  }

  static void add_rival(AmpleSets::Rule& rule, AutomatonId automaton,
                        const std::vector<bool>& dangerous) {
    const auto known =
        std::ranges::find(rule.rivals, automaton, &AmpleSets::Rival::automaton);
    if (known == rule.rivals.end()) {
      return rule.rivals.push_back({automaton, dangerous});
    }
    for (std::size_t l = 0; l < dangerous.size(); ++l) {
      if (dangerous[l]) known->dangerous[l] = true;
    }
  }

  const Tables& tables_;
  Dangers& dangers_;
  AutomatonId id_;
  std::vector<AmpleSets::Rule> rules_;
  // By what edges of a location: each is asked for once.
  std::set<std::pair<LocationId, VariableId>> read_;
  std::set<std::pair<LocationId, VariableId>> written_;
};

// Whether firing the edge may change what a question sees.
bool may_be_noticed(const Network& network, const Observed& observed,
                    const Automaton& automaton, const Edge& edge) {
  const int first = network.variable(automaton.location).min;
  if (observed.tells_apart(automaton.location,
                           first + static_cast<int>(index(edge.source)),
                           first + static_cast<int>(index(edge.target)))) {
    return true;
  }
  for (const Assignment& update : edge.updates) {
    if (!observed.sees(update.variable)) continue;
    const auto value = constant_value(update);
    if (!value) return true;
    const auto before = demanded_value(edge.guard, update.variable);
    const Variable& variable = network.variable(update.variable);
    const int lowest = before.value_or(variable.min);
    const int highest = before.value_or(variable.max);
    for (int old = lowest; old <= highest; ++old) {
      if (observed.tells_apart(update.variable, old, *value)) return true;
    }
  }
  return false;
}

AutomatonId mover_after(const Network& network, const CallProtocol& protocol,
                        AutomatonId id, const Edge& edge) {
  AutomatonId mover = id;
  for (const Assignment& update : edge.updates) {
    if (network.variable(update.variable).role != VariableRole::Caller) {
      continue;
    }
    const auto called = protocol.gated(update.variable);
    if (!called) continue;
    mover = *called == id ? protocol.parent(id).value_or(id) : *called;
  }
  return mover;
}

// With the protocol, an automaton that has called one other is blocked until
// that gives control back; so where a single one needs no call, and none calls
// two at once, the called ones are a chain of which only the last can move.
bool calls_one_at_a_time(const Network& network, const CallProtocol& protocol) {
  std::size_t uncalled = 0;
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    ask_budget();
    const Automaton& automaton = network.automata[a];
    if (automaton.kind != AutomatonKind::Node) continue;
    uncalled += !automaton.gate;
    const auto calls = [&](const Assignment& update) {
      const auto gated = protocol.gated(update.variable);
      return gated && *gated != AutomatonId{a};
    };
    for (const Edge& edge : automaton.edges) {
      if (std::ranges::count_if(edge.updates, calls) > 1) return false;
    }
  }
  return protocol.holds() && uncalled == 1;
}

}  // namespace

AmpleSets::AmpleSets(const Network& network, const Observed& observed) {
  const Tables tables{network};
  const CallProtocol& protocol = tables.protocol;
  Dangers dangers(tables);
  const bool may_reduce =
      protocol.holds() && !observed.sees_steps() && !observed.sees_death();
  is_sequential_ = calls_one_at_a_time(network, protocol);
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    ask_budget();
    const Automaton& automaton = network.automata[a];
    first_location_.push_back(static_cast<std::uint32_t>(rules_.size()));
    std::vector<Rule> rules(automaton.locations.size());
    if (automaton.kind == AutomatonKind::Node && may_reduce) {
      rules = RuleMaker(tables, dangers, AutomatonId{a}).make();
      for (const LocationId head :
           cycle_heads(network, protocol, AutomatonId{a})) {
        rules[index(head)].may_be_ample = false;
      }
    }
    rules_.insert(rules_.end(), rules.begin(), rules.end());
    for (const Edge& edge : automaton.edges) {
      visible_.push_back(may_be_noticed(network, observed, automaton, edge));
      next_.push_back(mover_after(network, protocol, AutomatonId{a}, edge));
    }
  }
}

}  // namespace btcheck

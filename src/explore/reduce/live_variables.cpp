// SPDX-License-Identifier: MIT
//
// Live-variable analysis (Aho, Lam, Sethi, Ullman, section 9.2.5; for state
// spaces Bozga, Fernandez and Ghirvu, SAS 1999), finer in one point: what is
// asked backwards is not whether a variable will be read but which of its
// values will be compared with. A parent that halts its children asks of an old
// status only whether it is `running`, so success and failure are the same.
//
// It is done for the locals of a node, which nobody else touches, and for the
// rstatus of each child, which parent and child pass to and fro: while the
// child has not been called only the parent can read it, and calling it leads
// to the child's first location and back to where the parent waits. Locations
// are told apart further by locals of the node: a Parallel that has decided
// (active = 0) is not taken for one that still counts, and a Sequence that is
// at its third child (next = 3) not for one that may yet call the first.
#include "explore/reduce/live_variables.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "explore/reduce/call_protocol.hpp"
#include "explore/reduce/contexts.hpp"
#include "explore/state/accesses.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// As bits from a variable's lowest on. Of a domain that has more values than
// bits only two are told apart, the first value and any other, and whoever
// compares it compares it with all: what is left is plain liveness.
using Values = std::uint64_t;
constexpr int kBits = 64;
constexpr Values kFirst = 1, kOther = 2;

// A variable of one automaton, the owner; with `child`, that child's rstatus.
// Its values are the bits of `own`: several variables share a word.
class Tracked {
 public:
  enum class Calls : std::uint8_t { Never, Perhaps, Surely };

  // What an edge does with the variable.
  struct Use {
    Values tests = 0;     // compared with, before it is written
    Values excluded = 0;  // not before it
    bool is_written = false;
    Values written = 0;          // what may be written
    Calls calls = Calls::Never;  // the child
  };

  Tracked(const Network& network, VariableId variable,
          std::optional<AutomatonId> child, const Observed& observed)
      : network_(network),
        variable_(variable),
        of_(network.variable(variable)),
        child_(child ? &network.automaton(*child) : nullptr),
        child_id_(child) {
    observed_ = values_told_by(observed);
    if (child_ == nullptr) return;
    child_needs_.assign(child_->locations.size(), observed_);
    for (const Edge& edge : child_->edges) {
      child_uses_.push_back(use_in(edge, edge.guard));
      written_by_child_ |= child_uses_.back().written;
    }
  }

  VariableId variable() const { return variable_; }
  std::optional<AutomatonId> child() const { return child_id_; }
  std::optional<VariableId> child_gate() const {
    return child_ == nullptr ? std::nullopt : child_->gate;
  }
  // Its bits are the lowest of a word until they are moved.
  int width() const {
    return is_large() ? 2 : static_cast<int>(of_.domain_size());
  }
  void move_to(int first) {
    first_ = first;
    observed_ <<= first;
    written_by_child_ <<= first;
    for (Values& needs : child_needs_) needs <<= first;
    for (Use& use : child_uses_) use = moved(use);
  }

  Values own() const { return every_value(); }
  Values first_value() const { return bit(of_.initial); }
  // What a question tells apart is compared with everywhere.
  Values observed() const { return observed_; }
  Values written_by_child() const { return written_by_child_; }
  // What is compared with when the child is called.
  Values needed_by_child() const {
    return child_needs_.empty() ? 0 : child_needs_[0];
  }

  // `guard` is that of the edge, as far as it reads the variable.
  Use use_in(const Edge& edge, const Expression& guard) const {
    Use use;
    use.calls = calls_child(edge);
    use.tests = tests_in(guard);
    if (use.tests != 0 && !is_large()) {
      use.excluded = excluded_values(network_, guard, variable_) << first_;
    }
    for (const Assignment& update : edge.updates) {
      if (!use.is_written) use.tests |= tests_in(update.value);
      if (update.variable != variable_) continue;
      use.is_written = true;
      const auto value = constant_value(update);
      use.written = value ? bit(*value) : every_value();
    }
    return use;
  }

  // One round over the child's edges, whose turn ends where the owner waits;
  // false when nothing is new.
  bool find_child_needs(Values on_return) {
    bool grows = false;
    for (std::size_t e = 0; e < child_uses_.size(); ++e) {
      const Edge& edge = child_->edges[e];
      const Use& use = child_uses_[e];
      Values tests = use.tests;
      if (!use.is_written) {
        tests |= ends_turn(*child_, edge) ? on_return & own()
                                          : child_needs_[index(edge.target)];
      }
      Values& needs = child_needs_[index(edge.source)];
      grows |= (tests & ~needs) != 0;
      needs |= tests;
    }
    return grows;
  }

  // The value that stands for all that are not compared with; the first value
  // of the variable if it is one of them. With all compared with: any.
  int representative(Values tests) const {
    if ((tests & first_value()) == 0) return of_.initial;
    const Values free = every_value() & ~tests;
    return free == 0 ? of_.initial : value_of(free);
  }
  Values represented(Values tests) const { return bit(representative(tests)); }

  // The assignment that leaves, of `values`, those that are needed.
  Assignment forgetting(Values values, Values needed) const {
    const int rest = representative(needed);
    // rest + Σ (v = t) (t - rest): the rest, or the value compared with.
    Expression value = Expression::constant(rest);
    for (Values kept = values & needed; kept != 0; kept &= kept - 1) {
      const int tested = value_of(kept);
      value = Expression::binary(
          Operation::Add, std::move(value),
          Expression::binary(Operation::Multiply, equals(variable_, tested),
                             Expression::constant(tested - rest)));
    }
    return Assignment{variable_, std::move(value)};
  }

 private:
  bool is_large() const { return of_.domain_size() > kBits; }
  Values bit(int value) const {
    if (is_large()) return (value == of_.initial ? kFirst : kOther) << first_;
    return Values{1} << (value - of_.min + first_);
  }
  Values every_value() const {
    return ~Values{0} >> (kBits - width()) << first_;
  }
  // The value of the lowest bit; of one that is not large.
  int value_of(Values values) const {
    return of_.min + std::countr_zero(values) - first_;
  }
  // What is needed so that a comparison with the value comes out as it was.
  Values tested(int value) const {
    return is_large() ? every_value() : bit(value);
  }
  Use moved(Use use) const {
    use.tests <<= first_;
    use.excluded <<= first_;
    use.written <<= first_;
    return use;
  }

  Values values_told_by(const Observed& observed) const {
    if (is_large()) return observed.sees(variable_) ? every_value() : 0;
    Values told = 0;
    for (int value = of_.min; value <= of_.max; ++value) {
      if (observed.tells(variable_, value)) told |= bit(value);
    }
    return told;
  }

  Values tests_in(const Expression& expression) const {
    Values tests = 0;
    for_each_read(expression, [&](VariableId read, std::optional<int> value) {
      if (read != variable_) return;
      if (!value) {
        tests = every_value();
      } else if (*value >= of_.min && *value <= of_.max) {
        tests |= tested(*value);
      }
    });
    return tests;
  }

  Calls calls_child(const Edge& edge) const {
    if (child_ == nullptr) return Calls::Never;
    for (const Assignment& update : edge.updates) {
      if (update.variable != child_->gate) continue;
      return constant_value(update) == 1 ? Calls::Surely : Calls::Perhaps;
    }
    return Calls::Never;
  }

  const Network& network_;
  VariableId variable_;
  const Variable& of_;
  const Automaton* child_;
  std::optional<AutomatonId> child_id_;
  int first_ = 0;
  Values observed_ = 0;
  Values written_by_child_ = 0;
  std::vector<Use> child_uses_;      // by edge of the child
  std::vector<Values> child_needs_;  // by location of the child
};

// As many variables of one automaton as fit into a word, whose edges are gone
// along for all of them at once: what an edge does not mention passes it as it
// is.
class Liveness {
 public:
  Liveness(const CallProtocol& protocol, const Contexts& contexts,
           const Mentions& mentions, const Automaton& owner,
           std::vector<Tracked> all)
      : protocol_(protocol),
        contexts_(contexts),
        owner_(owner),
        all_(std::move(all)),
        first_use_(owner.edges.size(), kNone),
        overwritten_(owner.locations.size(), 0),
        values_(contexts.size(), 0),
        needed_after_(owner.edges.size(), 0) {
    Values observed = 0;
    int width = 0;
    for (Tracked& each : all_) {
      each.move_to(width);
      width += each.width();
      observed |= each.observed();
      first_values_ |= each.first_value();
    }
    needs_.assign(contexts_.size(), observed);
    for (std::uint32_t i = 0; i < all_.size(); ++i) add_uses(mentions, i);
    for (const Tracked& each : all_) {
      if (contexts_.tell_apart(each.variable())) add_tests_elsewhere(each);
    }
    do {
      find_needs();
    } while (find_child_needs());
    for (const Contexts::Arc& arc : contexts_.arcs()) {
      needed_after_[arc.edge] |= needs_[arc.to];
    }
    find_overwritten();
    find_values();
  }

  // Adds to the owner's edges what they should write besides.
  void rewrite(std::vector<Edge>& edges, std::vector<bool>& forgotten) const {
    std::vector<Values> left(owner_.edges.size(), 0);
    for (const Contexts::Arc& arc : contexts_.arcs()) {
      left[arc.edge] |= left_by(arc);
    }
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      const Values gone = left[e] & ~kept_behind(e, left[e]);
      if (gone == 0) continue;
      for (const Tracked& each : all_) {
        if ((gone & each.own()) == 0) continue;
        edges[e].updates.push_back(
            each.forgetting(left[e] & each.own(), needed_after_[e]));
        forgotten[index(each.variable())] = true;
      }
    }
  }

 private:
  using Calls = Tracked::Calls;
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::size_t kManyUpdates = 64;

  // What an edge does with one of the variables, and the next use of the edge.
  struct Use : Tracked::Use {
    std::uint32_t of = 0;
    std::uint32_t next = kNone;
  };

  void add_uses(const Mentions& mentions, std::uint32_t number) {
    const Tracked& tracked = all_[number];
    const auto add = [&](std::uint32_t edge, const Expression& guard) {
      const std::uint32_t first = first_use_[edge];
      if (first != kNone && uses_[first].of == number) return;
      const Tracked::Use use = tracked.use_in(owner_.edges[edge], guard);
      first_use_[edge] = static_cast<std::uint32_t>(uses_.size());
      uses_.push_back({use, number, first});
    };
    for (const auto& mention : mentions.of(tracked.variable())) {
      add(mention.edge, mention.guard);
    }
    const auto& gate = tracked.child_gate();
    if (!gate) return;
    for (const auto& mention : mentions.of(*gate)) add(mention.edge, {});
  }

  // Calls visit(use, bits of its variable) for the variables that an edge has
  // to do with.
  template <class Visit>
  void for_each_use(std::uint32_t edge, Visit visit) const {
    for (std::uint32_t i = first_use_[edge]; i != kNone; i = uses_[i].next) {
      visit(uses_[i], all_[uses_[i].of]);
    }
  }

  // An edge that the variable's own value forbids in a context has no arc from
  // there; but it must not become possible when the value is forgotten.
  void add_tests_elsewhere(const Tracked& tracked) {
    std::vector<Values> tests(owner_.locations.size(), 0);
    for (std::uint32_t e = 0; e < owner_.edges.size(); ++e) {
      for_each_use(e, [&](const Use& use, const Tracked& of) {
        if (&of != &tracked) return;
        tests[index(owner_.edges[e].source)] |= use.tests;
      });
    }
    for (std::uint32_t context = 0; context < needs_.size(); ++context) {
      needs_[context] |= tests[index(contexts_.location(context))];
    }
  }

  // What is compared with from before an edge on.
  Values needed_before(std::uint32_t edge, Values after) const {
    for_each_use(edge, [&](const Use& use, const Tracked& of) {
      Values tests = use.tests;
      if (!use.is_written && use.calls != Calls::Never) {
        tests |= of.needed_by_child();
      }
      if (!use.is_written && use.calls != Calls::Surely) {
        tests |= after & of.own();
      }
      after = (after & ~of.own()) | tests;
    });
    return after;
  }

  // Of the hundreds of children of a Sequence the failure of each one would
  // forget all others, just before one edge resets them. Around that edge they
  // are kept.
  void find_overwritten() {
    for (std::uint32_t e = 0; e < owner_.edges.size(); ++e) {
      const Edge& edge = owner_.edges[e];
      if (edge.updates.size() < kManyUpdates) continue;
      for_each_use(e, [&](const Use& use, const Tracked& of) {
        if (use.is_written) overwritten_[index(edge.source)] |= of.own();
      });
    }
  }

  // Backwards over the owner's edges, until nothing is new.
  void find_needs() {
    std::vector<std::uint32_t> changed(contexts_.size());
    std::iota(changed.begin(), changed.end(), 0u);
    while (!changed.empty()) {
      ask_budget();
      const std::uint32_t context = changed.back();
      changed.pop_back();
      contexts_.for_each_arc_into(context, [&](const Contexts::Arc& arc) {
        const Values needed = needed_before(arc.edge, needs_[context]);
        if ((needed & ~needs_[arc.from]) == 0) return;
        needs_[arc.from] |= needed;
        changed.push_back(arc.from);
      });
    }
  }

  bool find_child_needs() {
    std::vector<Values> needs(owner_.locations.size(), 0);
    for (std::uint32_t context = 0; context < needs_.size(); ++context) {
      needs[index(contexts_.location(context))] |= needs_[context];
    }
    bool grows = false;
    for (Tracked& each : all_) {
      if (!each.child()) continue;
      Values on_return = 0;
      for (const LocationId waits : protocol_.waits_for(*each.child())) {
        on_return |= needs[index(waits)];
      }
      grows |= each.find_child_needs(on_return);
    }
    return grows;
  }

  // Forwards, until nothing is new.
  void find_values() {
    std::vector<std::uint32_t> changed{Contexts::kInitial};
    values_[changed.front()] = first_values_;
    while (!changed.empty()) {
      ask_budget();
      const std::uint32_t context = changed.back();
      changed.pop_back();
      contexts_.for_each_arc_from(context, [&](const Contexts::Arc& arc) {
        const Values left = kept_behind(arc.edge, left_by(arc));
        if ((left & ~values_[arc.to]) == 0) return;
        values_[arc.to] |= left;
        changed.push_back(arc.to);
      });
    }
  }

  // The values after an edge that forgets nothing; none of a variable for which
  // it is not taken.
  Values left_by(const Contexts::Arc& arc) const {
    Values left = values_[arc.from];
    for_each_use(arc.edge, [&](const Use& use, const Tracked& of) {
      Values before = left & of.own() & ~use.excluded;
      if (before != 0 && use.is_written) before = use.written;
      left = (left & ~of.own()) | before;
    });
    return left;
  }

  // Of the values that an edge may leave if it forgets nothing, those that it
  // should forget: not compared with later, and not the first of their
  // variable, which then stands for them. An edge that calls forgets nothing of
  // the child.
  Values dead_behind(std::uint32_t edge, Values left) const {
    const Edge& taken = owner_.edges[edge];
    Values dead = left & ~needed_after_[edge] & ~first_values_ &
                  ~overwritten_[index(taken.source)] &
                  ~overwritten_[index(taken.target)];
    if (dead == 0) return 0;
    for_each_use(edge, [&](const Use& use, const Tracked& of) {
      if (use.calls != Calls::Never) dead &= ~of.own();
    });
    return dead;
  }

  // What becomes of them when it has forgotten what it may.
  Values kept_behind(std::uint32_t edge, Values left) const {
    const Values dead = dead_behind(edge, left);
    for_each_use(edge, [&](const Use& use, const Tracked& of) {
      if (use.calls == Calls::Never || (left & of.own()) == 0) return;
      left |= of.written_by_child();
    });
    if (dead == 0) return left;
    for (const Tracked& each : all_) {
      if ((dead & each.own()) == 0) continue;
      left = (left & ~(each.own() & ~needed_after_[edge])) |
             each.represented(needed_after_[edge]);
    }
    return left;
  }

  const CallProtocol& protocol_;
  const Contexts& contexts_;
  const Automaton& owner_;
  std::vector<Tracked> all_;
  std::vector<Use> uses_;
  std::vector<std::uint32_t> first_use_;  // by edge
  Values first_values_ = 0;
  // By location: those of variables that an edge resets with many others.
  std::vector<Values> overwritten_;
  // By context of the owner: the values that the variables may have there, none
  // where it cannot be reached; and those that will be compared with.
  std::vector<Values> values_;
  std::vector<Values> needs_;
  std::vector<Values> needed_after_;  // by edge: compared with behind it
};

}  // namespace

LiveNetwork forget_dead_values(const Network& network,
                               const Observed& observed) {
  LiveNetwork live{network, std::vector<bool>(network.variables.size(), false)};
  const CallProtocol protocol(network);
  if (!protocol.holds()) return live;
  const Accesses accesses(network);
  const auto entries = called_with(network, protocol, accesses);
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    ask_budget();
    const Automaton& automaton = network.automata[a];
    if (automaton.kind != AutomatonKind::Node || automaton.edges.empty() ||
        !accesses.moves_alone(network, AutomatonId{a})) {
      continue;
    }
    std::vector<std::vector<Tracked>> words(1);
    int width = 0;
    const auto track = [&](VariableId variable,
                           std::optional<AutomatonId> child) {
      const AutomatonId users[] = {AutomatonId{a},
                                   child.value_or(AutomatonId{a})};
      if (!accesses.are_only_by(users, variable)) return;
      Tracked tracked(network, variable, child, observed);
      width += tracked.width();
      if (width > kBits) {
        words.emplace_back();
        width = tracked.width();
      }
      words.back().push_back(std::move(tracked));
    };
    for (const VariableId local : automaton.locals) {
      track(local, std::nullopt);
    }
    if (!automaton.gate) {
      track(network.node_status[index(automaton.node)], std::nullopt);
    }
    for (const AutomatonId child : protocol.children(AutomatonId{a})) {
      track(network.node_status[index(network.automaton(child).node)], child);
    }
    if (words.front().empty()) continue;
    // Each word goes round all arcs: with thousands of children values are
    // better kept than looked at for minutes.
    constexpr std::size_t kMostVisits = 20'000'000;
    const Contexts contexts(network, automaton, kMostVisits / words.size(),
                            entries[a]);
    if (contexts.arcs().size() * words.size() > kMostVisits) continue;
    look_at_budget();
    const Mentions mentions(automaton);
    for (std::vector<Tracked>& word : words) {
      Liveness(protocol, contexts, mentions, automaton, std::move(word))
          .rewrite(live.network.automata[a].edges, live.forgotten);
    }
  }
  return live;
}

}  // namespace btcheck

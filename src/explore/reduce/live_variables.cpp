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
// are told apart further by the node's two-valued locals, so that a Parallel
// that has decided (active = 0) is not taken for one that still counts.
#include "explore/reduce/live_variables.hpp"

#include <algorithm>
#include <bit>
#include <set>
#include <unordered_map>

#include "explore/reduce/call_protocol.hpp"
#include "explore/state/accesses.hpp"

namespace btcheck {
namespace {

// As bits from a variable's lowest on.
using Values = std::uint64_t;
constexpr std::int64_t kLargestDomain = 64;

// The contexts of an automaton, its locations together with the values of the
// two-valued locals, and where each edge leads from each.
class Contexts {
 public:
  struct Arc {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t edge = 0;  // by its place in the automaton
  };

  Contexts(const Network& network, const Automaton& automaton)
      : network_(network), automaton_(automaton) {
    for (const VariableId local : automaton.locals) {
      const bool is_flag = network.variable(local).domain_size() == 2;
      if (is_flag && flags_.size() < kMostFlags) flags_.push_back(local);
    }
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) add_arcs(e);
  }

  std::size_t size() const {
    return automaton_.locations.size() << flags_.size();
  }

  std::uint32_t initial() const {
    const auto first = [&](VariableId variable) {
      const Variable& of = network_.variable(variable);
      return static_cast<std::uint32_t>(of.initial - of.min);
    };
    std::uint32_t context = first(automaton_.location) << flags_.size();
    for (std::uint32_t i = 0; i < flags_.size(); ++i) {
      context |= first(flags_[i]) << i;
    }
    return context;
  }

  LocationId location(std::uint32_t context) const {
    return LocationId{context >> flags_.size()};
  }
  const std::vector<Arc>& arcs() const { return arcs_; }
  // Whether contexts differ in the variable's value.
  bool tell_apart(VariableId variable) const {
    return std::ranges::find(flags_, variable) != flags_.end();
  }

 private:
  static constexpr std::size_t kMostFlags = 4;

  // From every setting of the flags that the guard allows; a flag that is given
  // a computed value may be either afterwards.
  void add_arcs(std::uint32_t number) {
    const Edge& edge = automaton_.edges[number];
    std::uint32_t demanded_mask = 0, demanded = 0;
    std::uint32_t fixed_mask = 0, fixed = 0, open = 0;
    for (std::uint32_t i = 0; i < flags_.size(); ++i) {
      const int lowest = network_.variable(flags_[i]).min;
      const std::uint32_t bit = 1u << i;
      if (const auto value = demanded_value(edge.guard, flags_[i])) {
        demanded_mask |= bit;
        if (*value != lowest) demanded |= bit;
      }
      for (const Assignment& update : edge.updates) {
        if (update.variable != flags_[i]) continue;
        const auto value = constant_value(update);
        fixed_mask |= bit;
        fixed &= ~bit;
        open = value ? open & ~bit : open | bit;
        if (value && *value != lowest) fixed |= bit;
      }
    }
    for (std::uint32_t flags = 0; flags < 1u << flags_.size(); ++flags) {
      if ((flags & demanded_mask) != demanded) continue;
      const std::uint32_t after = (flags & ~fixed_mask) | fixed;
      for (std::uint32_t some = open;; some = (some - 1) & open) {
        arcs_.push_back({index(edge.source) << flags_.size() | flags,
                         index(edge.target) << flags_.size() | after | some,
                         number});
        if (some == 0) break;
      }
    }
  }

  const Network& network_;
  const Automaton& automaton_;
  std::vector<VariableId> flags_;
  std::vector<Arc> arcs_;
};

// Which edges of an automaton have to do with a variable, and what their guards
// say of it. Guards grow with the number of children, and so do edges: each
// guard is taken apart once, and not for each variable.
class Mentions {
 public:
  struct Mention {
    std::uint32_t edge = 0;  // by its place in the automaton
    Expression guard;        // its conjuncts that read the variable
  };

  explicit Mentions(const Automaton& automaton) {
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      const Edge& edge = automaton.edges[e];
      for (const Expression& conjunct : edge.guard.conjuncts()) {
        std::set<VariableId> reads;
        for_each_read(conjunct, [&](VariableId read, std::optional<int>) {
          reads.insert(read);
        });
        for (const VariableId read : reads) {
          Expression& guard = add(e, read).guard;
          guard = both(std::move(guard), conjunct);
        }
      }
      for (const Assignment& update : edge.updates) {
        add(e, update.variable);
        for_each_read(update.value, [&](VariableId read, std::optional<int>) {
          add(e, read);
        });
      }
    }
  }

  // In the order of the edges.
  const std::vector<Mention>& of(VariableId variable) const {
    static const std::vector<Mention> kNone;
    const auto found = mentions_.find(index(variable));
    return found == mentions_.end() ? kNone : found->second;
  }

 private:
  Mention& add(std::uint32_t edge, VariableId variable) {
    std::vector<Mention>& all = mentions_[index(variable)];
    if (all.empty() || all.back().edge != edge) all.push_back({edge, {}});
    return all.back();
  }

  std::unordered_map<std::uint32_t, std::vector<Mention>> mentions_;
};

// One variable of one automaton; with `child`, that child's rstatus.
class Liveness {
 public:
  Liveness(const Network& network, const CallProtocol& protocol,
           const Contexts& contexts, const Mentions& mentions,
           const Observed& observed, AutomatonId owner, VariableId variable,
           std::optional<AutomatonId> child)
      : network_(network),
        protocol_(protocol),
        contexts_(contexts),
        owner_(network.automaton(owner)),
        variable_(variable),
        of_(network.variable(variable)),
        child_(child),
        values_(contexts_.size(), 0) {
    // What a question tells apart is compared with everywhere.
    Values observed_values = 0;
    for (int value = of_.min; value <= of_.max; ++value) {
      if (observed.tells(variable, value)) observed_values |= bit(value);
    }
    needs_.assign(contexts_.size(), observed_values);
    uses_.resize(owner_.edges.size());
    for (const Mentions::Mention& mention : mentions.of(variable)) {
      uses_[mention.edge] = use_in(owner_.edges[mention.edge], mention.guard);
    }
    if (child) {
      const Automaton& called = network.automaton(*child);
      for (const Mentions::Mention& mention : mentions.of(*called.gate)) {
        uses_[mention.edge].calls = calls_child(owner_.edges[mention.edge]);
      }
      child_needs_.assign(called.locations.size(), observed_values);
      for (const Edge& edge : called.edges) {
        child_uses_.push_back(use_in(edge, edge.guard));
        written_by_child_ |= child_uses_.back().written;
      }
    }
    if (contexts_.tell_apart(variable)) add_tests_of_other_contexts();
    for (bool grows = true; grows;) {
      grows = find_needs();
      grows |= find_child_needs();
    }
    for (const Contexts::Arc& arc : contexts_.arcs()) {
      uses_[arc.edge].needed_after |= needs_[arc.to];
    }
    values_[contexts_.initial()] = bit(of_.initial);
    while (find_values()) {
    }
  }

  // Adds to the owner's edges what they should write besides.
  void rewrite(std::vector<Edge>& edges, std::vector<bool>& forgotten) const {
    std::vector<Values> left(owner_.edges.size(), 0);
    for (const Contexts::Arc& arc : contexts_.arcs()) {
      left[arc.edge] |= left_by(arc);
    }
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      auto added = forgetting(e, left[e]);
      if (!added) continue;
      edges[e].updates.push_back(std::move(*added));
      forgotten[index(variable_)] = true;
    }
  }

 private:
  enum class Calls : std::uint8_t { Never, Perhaps, Surely };

  // What an edge does with the variable.
  struct Use {
    Values tests = 0;     // compared with, before it is written
    Values excluded = 0;  // not before it
    bool is_written = false;
    Values written = 0;          // what may be written
    Calls calls = Calls::Never;  // the child
    Values needed_after = 0;     // owner: compared with later
  };

  Values bit(int value) const { return Values{1} << (value - of_.min); }
  Values every_value() const { return ~Values{0} >> (64 - of_.domain_size()); }

  Values tests_in(const Expression& expression) const {
    Values tests = 0;
    for_each_read(expression, [&](VariableId read, std::optional<int> value) {
      if (read != variable_) return;
      if (!value) {
        tests = every_value();
      } else if (*value >= of_.min && *value <= of_.max) {
        tests |= bit(*value);
      }
    });
    return tests;
  }

  // `guard` is that of the edge, as far as it reads the variable.
  Use use_in(const Edge& edge, const Expression& guard) const {
    Use use;
    use.calls = calls_child(edge);
    use.tests = tests_in(guard);
    for (int value = of_.min; use.tests != 0 && value <= of_.max; ++value) {
      if (excludes(guard, variable_, value)) use.excluded |= bit(value);
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

  Calls calls_child(const Edge& edge) const {
    if (!child_) return Calls::Never;
    for (const Assignment& update : edge.updates) {
      if (update.variable != network_.automaton(*child_).gate) continue;
      return constant_value(update) == 1 ? Calls::Surely : Calls::Perhaps;
    }
    return Calls::Never;
  }

  // An edge that the variable's own value forbids in a context has no arc from
  // there; but it must not become possible when the value is forgotten.
  void add_tests_of_other_contexts() {
    std::vector<Values> tests(owner_.locations.size(), 0);
    for (std::size_t e = 0; e < uses_.size(); ++e) {
      tests[index(owner_.edges[e].source)] |= uses_[e].tests;
    }
    for (std::uint32_t context = 0; context < needs_.size(); ++context) {
      needs_[context] |= tests[index(contexts_.location(context))];
    }
  }

  // One round backwards over the owner's edges; false when nothing is new.
  bool find_needs() {
    bool grows = false;
    const auto& arcs = contexts_.arcs();
    for (auto arc = arcs.rbegin(); arc != arcs.rend(); ++arc) {
      const Use& use = uses_[arc->edge];
      const bool is_kept = !use.is_written;
      Values tests = use.tests;
      if (is_kept && use.calls != Calls::Never) tests |= child_needs_[0];
      if (is_kept && use.calls != Calls::Surely) tests |= needs_[arc->to];
      grows |= (tests & ~needs_[arc->from]) != 0;
      needs_[arc->from] |= tests;
    }
    return grows;
  }

  // The same over the child's: its turn ends where the owner waits.
  bool find_child_needs() {
    if (!child_) return false;
    Values on_return = 0;
    const auto& waits = protocol_.waits_for(*child_);
    for (std::uint32_t context = 0; context < needs_.size(); ++context) {
      const LocationId here = contexts_.location(context);
      if (std::ranges::find(waits, here) != waits.end()) {
        on_return |= needs_[context];
      }
    }
    bool grows = false;
    const Automaton& child = network_.automaton(*child_);
    for (std::size_t e = 0; e < child.edges.size(); ++e) {
      const Edge& edge = child.edges[e];
      const Use& use = child_uses_[e];
      Values tests = use.tests;
      if (!use.is_written) {
        tests |= ends_turn(child, edge) ? on_return
                                        : child_needs_[index(edge.target)];
      }
      Values& needs = child_needs_[index(edge.source)];
      grows |= (tests & ~needs) != 0;
      needs |= tests;
    }
    return grows;
  }

  // One round forwards; false when nothing is new.
  bool find_values() {
    bool grows = false;
    for (const Contexts::Arc& arc : contexts_.arcs()) {
      Values left = left_by(arc);
      if (left == 0) continue;
      left = forgotten_by(uses_[arc.edge], left);
      grows |= (left & ~values_[arc.to]) != 0;
      values_[arc.to] |= left;
    }
    return grows;
  }

  // The values after an edge that forgets nothing; none where it is not taken.
  Values left_by(const Contexts::Arc& arc) const {
    const Use& use = uses_[arc.edge];
    const Values before = values_[arc.from] & ~use.excluded;
    return before != 0 && use.is_written ? use.written : before;
  }

  // The value that stands for all that are not compared with; the first value
  // of the variable if it is one of them. With all compared with: any.
  int representative(Values tests) const {
    if ((tests & bit(of_.initial)) == 0) return of_.initial;
    const Values free = every_value() & ~tests;
    return free == 0 ? of_.initial : of_.min + std::countr_zero(free);
  }

  // What becomes of the values after an edge when it has forgotten what it may.
  Values forgotten_by(const Use& use, Values values) const {
    if (use.calls != Calls::Never) return values | written_by_child_;
    if ((values & ~use.needed_after) == 0) return values;
    return (values & use.needed_after) | bit(representative(use.needed_after));
  }

  // `values`: those that the edge may leave behind if it forgets nothing.
  std::optional<Assignment> forgetting(std::uint32_t edge,
                                       Values values) const {
    const Use& use = uses_[edge];
    const bool is_called = use.calls != Calls::Never;
    if (is_called || forgotten_by(use, values) == values) return std::nullopt;
    const int rest = representative(use.needed_after);
    // rest + Σ (v = t) (t - rest): the rest, or the value compared with.
    Expression value = Expression::constant(rest);
    for (Values kept = values & use.needed_after; kept != 0; kept &= kept - 1) {
      const int tested = of_.min + std::countr_zero(kept);
      value = Expression::binary(
          Operation::Add, std::move(value),
          Expression::binary(Operation::Multiply, equals(variable_, tested),
                             Expression::constant(tested - rest)));
    }
    return Assignment{variable_, std::move(value)};
  }

  const Network& network_;
  const CallProtocol& protocol_;
  const Contexts& contexts_;
  const Automaton& owner_;
  VariableId variable_;
  const Variable& of_;
  std::optional<AutomatonId> child_;
  std::vector<Use> uses_;        // by edge of the owner
  std::vector<Use> child_uses_;  // by edge of the child
  Values written_by_child_ = 0;
  // By context of the owner: the values it may have there, none where the
  // context cannot be reached; and those that will be compared with.
  std::vector<Values> values_;
  std::vector<Values> needs_;
  std::vector<Values> child_needs_;  // by location of the child
};

}  // namespace

LiveNetwork forget_dead_values(const Network& network,
                               const Observed& observed) {
  LiveNetwork live{network, std::vector<bool>(network.variables.size(), false)};
  const CallProtocol protocol(network);
  if (!protocol.holds()) return live;
  const Accesses accesses(network);
  std::vector<std::vector<AutomatonId>> children(network.automata.size());
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const auto parent = protocol.parent(AutomatonId{a});
    if (parent) children[index(*parent)].push_back(AutomatonId{a});
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    if (automaton.kind != AutomatonKind::Node) continue;
    const Contexts contexts(network, automaton);
    // Each variable goes round all arcs: with thousands of children values are
    // better kept than looked at for minutes.
    constexpr std::size_t kMostVisits = 20'000'000;
    const std::size_t variables =
        automaton.locals.size() + children[a].size() + 1;
    if (contexts.arcs().size() * variables > kMostVisits) continue;
    const Mentions mentions(automaton);
    const auto rewrite = [&](VariableId variable,
                             std::optional<AutomatonId> child) {
      const AutomatonId users[] = {AutomatonId{a},
                                   child.value_or(AutomatonId{a})};
      if (network.variable(variable).domain_size() > kLargestDomain ||
          !accesses.are_only_by(users, variable)) {
        return;
      }
      Liveness(network, protocol, contexts, mentions, observed, AutomatonId{a},
               variable, child)
          .rewrite(live.network.automata[a].edges, live.forgotten);
    };
    for (const VariableId local : automaton.locals) {
      rewrite(local, std::nullopt);
    }
    if (!automaton.gate) {
      rewrite(network.node_status[index(automaton.node)], std::nullopt);
    }
    for (const AutomatonId child : children[a]) {
      rewrite(network.node_status[index(network.automaton(child).node)], child);
    }
  }
  return live;
}

}  // namespace btcheck

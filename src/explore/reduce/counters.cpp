// SPDX-License-Identifier: MIT
//
// A counter is known by what edges do with it, not by the type of its node. The
// pen says which locals are meant to count (LocalRole::Rounds); that they do is
// read off the table. Families draw differently: one edge that adds 1, or one
// for each value.
#include "explore/reduce/counters.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "explore/reduce/contexts.hpp"
#include "explore/state/accesses.hpp"
#include "model/tree/reads.hpp"

namespace btcheck {
namespace {

bool reads_only(const Expression& expression, VariableId variable) {
  bool does = true;
  for_each_read(expression, [&](VariableId read, std::optional<int>) {
    does &= read == variable;
  });
  return does;
}

// What the guard of an edge asks of the counter.
enum class Asks : std::uint8_t { Nothing, IsLast, IsNotLast, OneValue, Other };
// What it makes of it.
enum class Makes : std::uint8_t { Nothing, Zero, OneMore, Constant, Other };

// One edge, as far as it has to do with the counter.
struct CounterUse {
  Asks asks = Asks::Nothing;
  int asked = 0;  // OneValue
  Makes makes = Makes::Nothing;
  int made = 0;     // Constant
  Expression rest;  // of the guard
  std::vector<Assignment> others;

  // Whether the edge counts a round.
  bool counts() const {
    return makes == Makes::OneMore || makes == Makes::Constant;
  }
};

class CounterUses {
 public:
  CounterUses(const Network& network, VariableId counter)
      : counter_(counter), last_(network.variable(counter).max) {}

  CounterUse of(const Edge& edge) const {
    CounterUse use;
    Expression asked;
    for (const Expression& conjunct : edge.guard.conjuncts()) {
      Expression& part = reads(conjunct, counter_) ? asked : use.rest;
      part = both(std::move(part), conjunct);
    }
    if (!asked.is_true()) ask(asked, use);
    for (const Assignment& update : edge.updates) {
      if (update.variable == counter_) {
        use.makes =
            use.makes == Makes::Nothing ? made_by(update, use) : Makes::Other;
      } else if (reads(update.value, counter_)) {
        use.makes = Makes::Other;
      } else {
        use.others.push_back(update);
      }
    }
    return use;
  }

  // Whether a counter may be used so; of one for each value together with the
  // others.
  bool is_allowed(const Edge& edge, const CounterUse& use) const {
    const bool is_touched =
        use.asks != Asks::Nothing || use.makes != Makes::Nothing;
    if (is_touched && edge.when.needs_clock()) return false;
    if (use.asks == Asks::Other || use.makes == Makes::Other) return false;
    if (use.counts() && edge.is_like_time) return false;
    if (use.makes == Makes::Constant) {
      return (use.asks == Asks::OneValue && use.made == use.asked + 1) ||
             (use.asks == Asks::IsNotLast && last_ == 1 && use.made == 1);
    }
    if (use.makes == Makes::OneMore) return use.asks != Asks::IsLast;
    return use.asks != Asks::OneValue;
  }

 private:
  // By its truth for each value.
  void ask(const Expression& asked, CounterUse& use) const {
    use.asks = Asks::Other;
    if (!reads_only(asked, counter_)) return;
    std::vector<int> values;
    for (int value = 0; value <= last_; ++value) {
      if (asked.evaluate([&](const Term&) { return std::int64_t{value}; })) {
        values.push_back(value);
      }
    }
    if (values == std::vector<int>{last_}) {
      use.asks = Asks::IsLast;
    } else if (static_cast<int>(values.size()) == last_ &&
               values.back() == last_ - 1) {
      use.asks = Asks::IsNotLast;
    } else if (values.size() == 1) {
      use.asks = Asks::OneValue;
      use.asked = values.front();
    }
  }

  Makes made_by(const Assignment& update, CounterUse& use) const {
    if (const auto value = constant_value(update)) {
      use.made = *value;
      return *value == 0 ? Makes::Zero : Makes::Constant;
    }
    const Expression one_more = Expression::binary(
        Operation::Add, read(counter_), Expression::constant(1));
    return update.value == one_more ? Makes::OneMore : Makes::Other;
  }

  VariableId counter_;
  int last_;
};

bool is_same(const Assignment& one, const Assignment& other) {
  return one.variable == other.variable && one.value == other.value;
}

// Two edges of one step, each for its own value of the counter.
bool are_one_step(const Edge& one, const CounterUse& used, const Edge& other,
                  const CounterUse& as) {
  return one.source == other.source && one.target == other.target &&
         one.when == other.when && used.rest == as.rest &&
         one.asks_world == other.asks_world && one.scripts.empty() &&
         other.scripts.empty() &&
         std::ranges::equal(used.others, as.others, is_same);
}

// Where there is one for a value, there is one for each but the last.
bool are_complete(const Automaton& automaton,
                  const std::vector<CounterUse>& uses, int last) {
  for (std::size_t e = 0; e < uses.size(); ++e) {
    if (uses[e].asks != Asks::OneValue) continue;
    std::vector<int> values;
    for (std::size_t f = 0; f < uses.size(); ++f) {
      if (uses[f].asks == Asks::OneValue &&
          are_one_step(automaton.edges[e], uses[e], automaton.edges[f],
                       uses[f])) {
        values.push_back(uses[f].asked);
      }
    }
    std::ranges::sort(values);
    if (static_cast<int>(values.size()) != last) return false;
    for (int value = 0; value < last; ++value) {
      if (values[static_cast<std::size_t>(value)] != value) return false;
    }
  }
  return true;
}

// Whether an edge that counts without asking may find the counter at its last
// value. That is looked for with a counter that knows only whether it is: 1 for
// the last value, else 0, so that the answer is that for every last value.
class CountsBeyond {
 public:
  CountsBeyond(const Network& network, const RoundCounter& counter,
               const std::vector<CounterUse>& uses)
      : abstract_(network) {
    Variable& flag = abstract_.variables[index(counter.variable)];
    flag.max = 1;
    Automaton& automaton = abstract_.automata[index(counter.automaton)];
    const std::size_t count = automaton.edges.size();
    for (std::size_t e = 0; e < count; ++e) {
      Edge& edge = automaton.edges[e];
      const CounterUse& use = uses[e];
      edge.guard = use.rest;
      edge.updates = use.others;
      if (use.asks != Asks::Nothing) {
        const int asked = use.asks == Asks::IsLast ? 1 : 0;
        edge.guard =
            both(std::move(edge.guard), equals(counter.variable, asked));
      }
      if (use.makes == Makes::Zero) {
        edge.updates.push_back({counter.variable, Expression::constant(0)});
      }
      if (!use.counts()) continue;
      // It may be either afterwards.
      edge.updates.push_back({counter.variable, read(counter.variable)});
      if (use.asks != Asks::Nothing) continue;
      Edge beyond = edge;
      beyond.guard = both(use.rest, equals(counter.variable, 1));
      first_beyond_ = first_beyond_.value_or(count);
      automaton.edges.push_back(std::move(beyond));
    }
    automaton_ = &automaton;
  }

  bool may_happen() const {
    if (!first_beyond_) return false;
    const Contexts contexts(abstract_, *automaton_, 1'000'000, {});
    return std::ranges::any_of(contexts.arcs(), [&](const auto& arc) {
      return arc.edge >= *first_beyond_;
    });
  }

 private:
  Network abstract_;
  const Automaton* automaton_ = nullptr;
  // Behind the automaton's own: edges that must not be taken.
  std::optional<std::size_t> first_beyond_;
};

}  // namespace

std::optional<RoundCounter> round_counter(const Network& network, NodeId node) {
  const auto variable = local_of(network, node, LocalRole::Rounds);
  if (!variable) return std::nullopt;
  const RoundCounter counter{network.node_automaton[index(node)], *variable};
  const Variable& of = network.variable(*variable);
  const AutomatonId users[] = {counter.automaton};
  if (of.min != 0 || of.initial != 0 || of.max < 1 ||
      !Accesses(network).are_only_by(users, *variable)) {
    return std::nullopt;
  }
  const Automaton& automaton = network.automaton(counter.automaton);
  const CounterUses all(network, *variable);
  std::vector<CounterUse> uses;
  for (const Edge& edge : automaton.edges) {
    uses.push_back(all.of(edge));
    if (!all.is_allowed(edge, uses.back())) return std::nullopt;
  }
  if (!are_complete(automaton, uses, of.max) ||
      CountsBeyond(network, counter, uses).may_happen()) {
    return std::nullopt;
  }
  return counter;
}

void leave_rounds_open(const RoundCounter& counter, Network& network) {
  const VariableId uncounted{
      static_cast<std::uint32_t>(network.variables.size())};
  network.variables.push_back({VariableRole::Local,
                               std::string(kUncounted),
                               0,
                               2,
                               0,
                               {},
                               counter.automaton});
  const CounterUses all(network, counter.variable);
  Automaton& automaton = network.automata[index(counter.automaton)];
  automaton.locals.push_back(uncounted);
  std::vector<Edge> uncounting;
  for (Edge& edge : automaton.edges) {
    const CounterUse use = all.of(edge);
    if (use.makes == Makes::Zero) {
      edge.updates.push_back({uncounted, Expression::constant(0)});
    }
    const bool is_for_zero = use.asks != Asks::OneValue || use.asked == 0;
    if (!use.counts() || !is_for_zero) continue;
    Edge& other = uncounting.emplace_back(edge);
    other.guard = both(use.rest, equals(counter.variable, 0));
    other.updates = use.others;
    // 0 → 1 → 2 → 1
    other.updates.push_back(
        {uncounted, Expression::binary(Operation::Add, equals(uncounted, 1),
                                       Expression::constant(1))});
  }
  std::ranges::move(uncounting, std::back_inserter(automaton.edges));
  network.number_edges();
}

}  // namespace btcheck

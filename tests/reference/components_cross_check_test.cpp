// SPDX-License-Identifier: MIT
//
// Networks of components against all states of the whole written out, on random
// trees under every tick semantics.
//
// Every edge of a node that stands as it is must be taken in both or in none,
// whether what is above it is a component or not; the roots must be able to end
// from every state in both or in none; and whatever a network of components
// does the whole must do as well, single step by single step. Without its dead
// values a network of components does the same. Components that are wrong on
// purpose must not pass.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "explore/components/composition.hpp"
#include "explore/reduce/live_variables.hpp"
#include "reference/effort.hpp"
#include "reference/kept_bytes.hpp"
#include "reference/random_tree.hpp"
#include "reference/reduction_cases.hpp"

namespace btcheck::reference::components_cross_check_test {
namespace {

constexpr int kStepsOfWalk = 60;

struct Census : ReductionCensus {
  int compositions = 0;
  int outsides = 0;             // with all above a node as one
  int clocks = 0;               // components that change with time
  std::uint64_t left_out = 0;   // automata
  std::uint64_t smaller = 0;    // states fewer than in the whole
  std::uint64_t steps = 0;      // walked in both
  std::uint64_t forgotten = 0;  // variables whose dead values are
};

std::vector<bool> taken_edges(const Network& network, const NaiveSpace& space) {
  std::vector<bool> taken(network.edge_count(), false);
  for (const auto& steps : space.steps) {
    for (const NaiveSpace::Step& step : steps) {
      if (step.edge) taken[*step.edge] = true;
    }
  }
  return taken;
}

// By state: all roots have ended, or a fault has ended the run.
std::vector<bool> ended(const Network& network, const NaiveSpace& space,
                        const CallProtocol& protocol) {
  std::vector<const Automaton*> roots;
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    const bool is_root = automaton.kind == AutomatonKind::Node &&
                         !protocol.parent(AutomatonId{a}) &&
                         !automaton.edges.empty();
    if (is_root) roots.push_back(&automaton);
  }
  std::vector<bool> all;
  for (const NaiveState& state : space.states) {
    const bool is_over = std::ranges::all_of(roots, [&](const Automaton* root) {
      const int location =
          state.value(root->location) - network.variable(root->location).min;
      return is_end(root->locations[static_cast<std::size_t>(location)].role);
    });
    all.push_back(is_over || NaiveNetwork(network).is_faulty(state));
  }
  return all;
}

bool can_always(const NaiveSpace& space, std::vector<bool> goal) {
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t s = 0; s < space.steps.size(); ++s) {
      if (goal[s]) continue;
      for (const NaiveSpace::Step& step : space.steps[s]) {
        if (!goal[step.target]) continue;
        grows = goal[s] = true;
        break;
      }
    }
  }
  return std::ranges::all_of(goal, [](bool each) { return each; });
}

// A run of the composition, and of the whole beside it.
class Walk {
 public:
  Walk(const Composition& composition, const NaiveSpace& space)
      : composition_(composition),
        space_(space),
        whole_(composition.components().network()) {
    take_over(whole_.initial());
  }

  // What goes wrong, "" for nothing.
  std::string flaw(SplitMix64& random, Census& census) {
    std::size_t here = 0;
    for (int i = 0; i < kStepsOfWalk; ++i) {
      const auto& steps = space_.steps[here];
      if (steps.empty()) break;
      const NaiveSpace::Step& step = steps[static_cast<std::size_t>(
          random.below(static_cast<int>(steps.size())))];
      const std::string wrong = step.edge ? taken(*step.edge) : waited();
      if (!wrong.empty()) return wrong;
      here = step.target;
      ++census.steps;
      const auto& seen = space_.states[here].values;
      for (std::size_t v = 0; v < state_.values.size(); ++v) {
        if (composition_.hidden()[v] || seen[v] == state_.values[v]) continue;
        return fmt::format(
            "step {}: {} is {}, not {}", i,
            qualified_name(whole_.network(),
                           VariableId{static_cast<std::uint32_t>(v)}),
            state_.values[v], seen[v]);
      }
    }
    return {};
  }

 private:
  void take_over(NaiveState state) {
    state_ = std::move(state);
    valuation_.variables = state_.values;
    valuation_.clocks = state_.clocks;
  }

  bool fire(std::uint32_t edge) {
    if (std::ranges::count(whole_.enabled(state_), edge) == 0) return false;
    take_over(whole_.after(state_, whole_.network().owner_of_edge(edge),
                           whole_.network().edge(edge)));
    return true;
  }

  std::string taken(std::uint32_t edge) {
    const bool is_done = composition_.take(
        valuation_, edge, [&](std::uint32_t single) { return fire(single); },
        standing_);
    return is_done ? ""
                   : "the whole cannot take an edge of " +
                         composition_.network().owner_of_edge(edge).name;
  }

  std::string waited() {
    const bool is_settled = composition_.settle(
        valuation_, [&](std::uint32_t single) { return fire(single); },
        standing_);
    if (!is_settled) return "the whole does not come to rest";
    if (!whole_.may_wait(state_)) return "the whole cannot wait";
    take_over(whole_.waited(state_));
    for (bool fired = true; fired;) {
      fired = false;
      for (const std::uint32_t edge : composition_.hidden_timers()) {
        fired = fired || fire(edge);
      }
    }
    standing_.forget();
    return {};
  }

  const Composition& composition_;
  const NaiveSpace& space_;
  NaiveNetwork whole_;
  NaiveState state_;
  Valuation valuation_;
  Standing standing_;
};

std::shared_ptr<KeptBytes> kept_bytes() {
  static const auto kept = std::make_shared<KeptBytes>();
  return kept;
}

// Of the network with one node as it is, or with all roots.
std::string flaw_of(const ReductionCase& each, ComponentTable& components,
                    std::optional<AutomatonId> kept, Census& census) {
  const Network& whole = each.network;
  std::vector<bool> keeps(whole.automata.size(), false);
  for (std::uint32_t a = 0; a < keeps.size(); ++a) {
    const bool is_root = whole.automata[a].kind == AutomatonKind::Node &&
                         !components.protocol().parent(AutomatonId{a});
    keeps[a] = kept ? AutomatonId{a} == *kept : is_root;
  }
  const Composition composition(components, keeps, !kept);
  const Network& network = composition.network();
  const auto space = naive_space(network, 4 * kMostStatesOfCase);
  if (!space) return "more than four times as many states";
  ++census.compositions;
  census.left_out += composition.left_out();
  census.smaller += each.space.states.size() > space->states.size()
                        ? each.space.states.size() - space->states.size()
                        : 0;
  SplitMix64 random(each.seed);
  for (int run = 0; run < 4; ++run) {
    const std::string wrong = Walk(composition, *space).flaw(random, census);
    if (!wrong.empty()) return wrong;
  }
  for (std::size_t a = whole.automata.size(); a < network.automata.size();
       ++a) {
    const bool is_clock = network.automata[a].kind == AutomatonKind::Timer;
    ++(is_clock ? census.clocks : census.outsides);
  }
  const auto in_whole = taken_edges(whole, each.space);
  const auto here = taken_edges(network, *space);
  for (std::uint32_t a = 0; a < keeps.size(); ++a) {
    if (!keeps[a]) continue;
    const Automaton& automaton = whole.automata[a];
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      const std::uint32_t number = automaton.first_edge + e;
      const auto place = composition.edge_here(number);
      if (!place) return "an edge of what is kept is gone";
      if (in_whole[number] == here[*place]) continue;
      return fmt::format("{}.{} -> {} is{} taken in the whole", automaton.name,
                         automaton.source(automaton.edges[e]).name,
                         automaton.target(automaton.edges[e]).name,
                         in_whole[number] ? "" : " not");
    }
  }
  // As it is searched: what nobody asks for is forgotten.
  const LiveNetwork live = forget_dead_values(network, Observed(network));
  const auto forgetful = naive_space(live.network, 4 * kMostStatesOfCase);
  if (!forgetful) return "more states without dead values";
  if (taken_edges(live.network, *forgetful) != here) {
    return "other edges are taken without dead values";
  }
  census.forgotten +=
      static_cast<std::uint64_t>(std::ranges::count(live.forgotten, true));
  if (!kept) {
    const CallProtocol& protocol = components.protocol();
    if (can_always(each.space, ended(whole, each.space, protocol)) !=
        can_always(*space, ended(network, *space, CallProtocol(network)))) {
      return fmt::format(
          "can always end: {} {}",
          can_always(each.space, ended(whole, each.space, protocol)),
          can_always(*space, ended(network, *space, CallProtocol(network))));
    }
  }
  return {};
}

// Of all networks that were looked at before, as far as there is room; of every
// other one as it comes back from where it was kept as bytes.
ComponentStore& known_parts(std::uint64_t seed) {
  static ComponentStore store(std::size_t{4} << 20);
  static ComponentStore forgetful(0);
  forgetful.keep_in(kept_bytes());
  return seed % 2 == 0 ? store : forgetful;
}

std::string flaw_of(const ReductionCase& each, Census& census) {
  const Network& network = each.network;
  // In some networks large ones stand in others only.
  ComponentTable::Limits limits;
  if (each.seed % 3 == 0) limits.edges = 12;
  ComponentTable components(network,
                            std::vector<bool>(network.variables.size()), limits,
                            &known_parts(each.seed));
  std::string wrong = flaw_of(each, components, std::nullopt, census);
  for (std::uint32_t a = 0; a < network.automata.size() && wrong.empty(); ++a) {
    if (network.automata[a].kind != AutomatonKind::Node) continue;
    wrong = flaw_of(each, components, AutomatonId{a}, census);
    if (!wrong.empty()) wrong += ", with " + network.automata[a].name;
  }
  return wrong;
}

}  // namespace

TEST_CASE("networks of components do what the whole does") {
  Census census;
  for_reduction_cases(211, by_effort(150, 2000), [&](const auto& each) {
    census.count(each);
    const std::string wrong = flaw_of(each, census);
    if (wrong.empty()) return GoOn::Yes;
    FAIL(fmt::format("seed {}, tick {}\n{}\n{}", each.seed,
                     tick_name(each.ticks), each.text, wrong));
    return GoOn::No;
  });
  MESSAGE(census.networks << " networks, " << census.xml_trees << " of XML; "
                          << census.compositions << " compositions, "
                          << census.outsides << " of them with what is above "
                          << "as one; " << census.left_out
                          << " automata left out, " << census.smaller
                          << " states; " << census.clocks
                          << " components change with time; " << census.steps
                          << " steps walked in both; " << kept_bytes()->found
                          << " components from bytes");
  CHECK_COVERED(census.outsides > 100);
  CHECK_COVERED(census.clocks > 10);
  CHECK_COVERED(census.left_out > 1000);
  CHECK_COVERED(census.smaller > 1000);
  CHECK_COVERED(census.forgotten > 1000);
  CHECK_COVERED(kept_bytes()->found > 300);
  CHECK(kept_bytes()->refused == 0);
}

}  // namespace btcheck::reference::components_cross_check_test

// SPDX-License-Identifier: MIT
//
// Simulated runs beside the engines that know nothing of simulations: random
// ones are runs of the tick interpreter, its runs written down as scripts come
// out the same, and whatever the naive network can reach the choices reach.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/simulate/script.hpp"
#include "check/simulate/simulation.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"
#include "reference/tick_interpreter.hpp"
#include "trace/formats/text.hpp"

namespace btcheck::reference::simulation_cross_check_test {
namespace {

constexpr int kTicks = 15;

// The line of a tick, from what the interpreter tells of it.
std::string expected_line(const BehaviorTree& tree, int number,
                          const TickResult& told) {
  const std::vector<std::string> keys = tick_line_keys(tree);
  std::map<NodeId, std::string> answers;
  for (const TickEvent& event : told.events) {
    if (tree.node(event.node).is_root()) continue;
    std::string& answer = answers[event.node];
    if (event.kind == EventKind::Ticked) continue;
    answer += answer.empty() ? "" : ",";
    answer += event_name(event.kind);
  }
  // The leaf that was ticked last is where the fault happened.
  if (told.fault) {
    std::string& last = answers[told.events.back().node];
    last += last.empty() ? "error" : ",error";
  }
  std::string line = fmt::format(
      "tick {}: root={}", number,
      told.fault ? "none" : kStatusNames[static_cast<std::size_t>(told.root)]);
  for (std::size_t v = 0; v < tree.variables.size(); ++v) {
    line += fmt::format(" {}={}", tree.variables[v].name,
                        tree.variables[v].value_name(told.variables[v]));
  }
  for (const auto& [node, answer] : answers) {
    line += fmt::format(" {}={}", keys[index(node)],
                        answer.empty() ? "none" : answer);
  }
  return line + "\n";
}

std::string difference(const std::string& expected, const std::string& found) {
  if (expected == found) return {};
  return fmt::format("expected:\n{}found:\n{}", expected, found);
}

// --- The interpreter goes first, and a script follows --------------------

// What was decided in a run of the interpreter, as a script.
struct Recorded {
  std::map<NodeId, std::string> results;          // of leaves
  std::map<StateVariableId, std::string> values;  // of free variables
  std::string lines;

  std::string script(const BehaviorTree& tree) const {
    std::string text;
    for (const auto& [node, words] : results) {
      text += fmt::format("{}:{}\n", unique_name(tree, node), words);
    }
    for (const auto& [variable, words] : values) {
      text += fmt::format("${}:{}\n", tree.variable(variable).name, words);
    }
    return text;
  }
};

Script recording_script(const BehaviorTree& tree, SplitMix64& random,
                        Recorded& recorded) {
  const auto one_of = [&random](const auto& allowed) {
    return allowed[static_cast<std::size_t>(
        random.below(static_cast<int>(allowed.size())))];
  };
  Script script;
  script.action = [&recorded, one_of](NodeId leaf, auto allowed) {
    const NodeStatus chosen = one_of(allowed);
    recorded.results[leaf] +=
        fmt::format(" {}", kStatusNames[static_cast<std::size_t>(chosen)]);
    return chosen;
  };
  script.set_sv = [&tree, &recorded, one_of](NodeId node, auto allowed) {
    const int chosen = one_of(allowed);
    const StateVariable& variable = tree.variable(tree.node(node).variable);
    recorded.results[node] += " " + variable.value_name(chosen);
    return chosen;
  };
  script.due = [&random](NodeId, int) { return random.percent(40); };
  script.free_moves = [&tree, &recorded, one_of](std::span<int> values) {
    for (std::uint32_t v = 0; v < values.size(); ++v) {
      const StateVariableId id{v};
      if (!moves_freely(tree, id)) continue;
      if (!tree.variables[v].lasting.empty()) continue;
      std::vector<int> allowed = {values[v], values[v]};
      for (const auto& [from, to] : tree.variables[v].transitions) {
        if (from == values[v]) allowed.push_back(to);
      }
      values[v] = one_of(allowed);
      recorded.values[id] += " " + tree.variables[v].value_name(values[v]);
    }
  };
  script.timely_move = [&tree, &recorded, one_of](StateVariableId id,
                                                  auto allowed) {
    const int chosen = one_of(allowed);
    recorded.values[id] += " " + tree.variable(id).value_name(chosen);
    return chosen;
  };
  return script;
}

Recorded interpreted_run(const BehaviorTree& tree, std::uint64_t seed) {
  SplitMix64 random(seed);
  Recorded recorded;
  TickInterpreter interpreter(tree, recording_script(tree, random, recorded));
  for (int tick = 1;
       tick <= kTicks && !interpreter.fault() && !interpreter.ended(); ++tick) {
    const TickResult told = interpreter.tick();
    recorded.lines += expected_line(tree, tick, told);
  }
  return recorded;
}

// The lines of the simulation that a script asks for, or why there are none.
std::string scripted_lines(const BehaviorTree& tree, const Network& network,
                           const std::string& text) {
  const auto script = read_simulation_script(tree, network, "s.txt", text);
  std::string complaints;
  for (const Diagnostic& found : script.diagnostics) {
    complaints += render(found);
  }
  if (!script.value) return complaints;
  const SourceText source("s.txt", text);
  ScriptPlayer player(*script.value, source);
  Simulation simulation(tree, network, Interleaving::InOrder);
  while (simulation.end() == RunEnd::None &&
         (simulation.choices()[0].kind != ChoiceKind::Tick ||
          simulation.ticks(tree.roots[0]) < kTicks)) {
    const ScriptedChoice choice = player.choose(simulation);
    if (const auto* refusal = std::get_if<Diagnostic>(&choice)) {
      return render(*refusal);
    }
    simulation.take(std::get<std::size_t>(choice));
  }
  return tick_lines(tree, network, simulation.run());
}

// --- A random simulation goes first, and the interpreter follows ---------

// What was chosen in one tick of a simulation.
struct Chosen {
  std::map<NodeId, std::deque<NodeStatus>> answers;
  std::map<NodeId, std::deque<int>> values;
  // Of timers, by the time they have counted: whether that was enough.
  std::map<std::pair<NodeId, int>, std::deque<bool>> due;
  std::vector<int> variables;  // when the tick begins
  // Where an answer was a fault: the answers that would not have been.
  std::set<NodeStatus> harmless;
};

std::vector<int> variables_of(const Simulation& simulation) {
  std::vector<int> values;
  for (const VariableId read : simulation.network().state_variable) {
    values.push_back(simulation.state().variables[index(read)]);
  }
  return values;
}

// NoRetStatus for what is no status.
NodeStatus status_called(std::string_view word) {
  const auto found = std::ranges::find(kStatusNames, word);
  return found == kStatusNames.end()
             ? NodeStatus::NoRetStatus
             : static_cast<NodeStatus>(found - kStatusNames.begin());
}

// A random run in order, told tick by tick.
class RandomRun {
 public:
  RandomRun(const BehaviorTree& tree, const Network& network,
            std::uint64_t seed)
      : tree_(tree),
        network_(network),
        simulation_(tree, network, Interleaving::InOrder),
        lines_(tree, network),
        random_(seed) {}

  bool goes_on() const { return simulation_.end() == RunEnd::None; }

  // The next tick, and its line.
  Chosen tick(std::string& line) {
    Chosen chosen;
    line.clear();
    bool has_begun = false;
    while (goes_on()) {
      const auto choices = simulation_.choices();
      const bool begins = choices[0].kind == ChoiceKind::Tick;
      if (begins && has_begun) break;
      const std::size_t number = random_choice(choices, random_);
      if (choices[number].kind == ChoiceKind::Tick) {
        chosen.variables = variables_of(simulation_);
        has_begun = true;
      }
      note(choices[number], chosen);
      simulation_.take(number);
      simulation_.for_each_latest([&](const Valuation&, const RunStep& step) {
        const std::string told = lines_.take(step);
        if (!told.empty()) line = told + "\n";
      });
    }
    if (line.empty()) line = lines_.rest(simulation_.state());
    return chosen;
  }

 private:
  void note(const SimulationChoice& choice, Chosen& chosen) {
    const Automaton& mover = network_.owner_of_edge(choice.step.edge);
    const Valuation after = simulation_.after(choice);
    if (choice.kind == ChoiceKind::Answer) {
      const Node& leaf = tree_.node(mover.node);
      const Edge& edge = network_.edge(choice.step.edge);
      const std::string& target = mover.target(edge).name;
      if (leaf.type == NodeType::SetSV) {
        chosen.values[mover.node].push_back(after.variables[index(
            network_.state_variable[index(leaf.variable)])]);
      } else if (target != "error") {
        chosen.answers[mover.node].push_back(status_called(target));
      }
      for (const SimulationChoice& other : simulation_.choices()) {
        if (target != "error" || other.kind != ChoiceKind::Answer) continue;
        const Edge& beside = network_.edge(other.step.edge);
        chosen.harmless.insert(status_called(mover.target(beside).name));
      }
    }
    for (const SimulationChoice& offered : simulation_.choices()) {
      if (offered.kind != ChoiceKind::Due) continue;
      const Automaton& timer = network_.owner_of_edge(offered.step.edge);
      const auto number =
          static_cast<std::size_t>(&timer - network_.automata.data());
      const int elapsed = simulation_.state().clocks[number];
      chosen.due[{timer.node, elapsed}].push_back(offered.step.edge ==
                                                  choice.step.edge);
    }
  }

  const BehaviorTree& tree_;
  const Network& network_;
  Simulation simulation_;
  TickLines lines_;
  btcheck::SplitMix64 random_;
};

template <class Value>
Value taken(std::deque<Value>& values, Value otherwise) {
  if (values.empty()) return otherwise;
  const Value first = values.front();
  values.pop_front();
  return first;
}

// Answers as it was chosen. Where the effects of an answer were a fault it was
// not noted which one that was; it is one that is not harmless.
Script following_script(Chosen& chosen) {
  Script script;
  script.action = [&chosen](NodeId leaf, auto allowed) {
    const auto fault = std::ranges::find_if(allowed, [&](NodeStatus answer) {
      return !chosen.harmless.contains(answer);
    });
    return taken(chosen.answers[leaf],
                 fault == allowed.end() ? allowed.front() : *fault);
  };
  script.set_sv = [&chosen](NodeId node, auto allowed) {
    return taken(chosen.values[node], allowed.front());
  };
  script.due = [&chosen](NodeId node, int elapsed) {
    return taken(chosen.due[{node, elapsed}], false);
  };
  script.free_moves = [&chosen](std::span<int> values) {
    std::ranges::copy(chosen.variables, values.begin());
  };
  return script;
}

struct Census {
  int ticks = 0;
  int faults = 0;
};

std::string difference_of_random_run(const BehaviorTree& tree,
                                     const Network& network, std::uint64_t seed,
                                     Census& census) {
  RandomRun run(tree, network, seed);
  Chosen chosen;
  TickInterpreter interpreter(tree, following_script(chosen));
  for (int tick = 1; tick <= kTicks && run.goes_on(); ++tick) {
    std::string line;
    chosen = run.tick(line);
    std::string expected;
    try {
      const TickResult told = interpreter.tick();
      expected = expected_line(tree, tick, told);
      census.faults += told.fault ? 1 : 0;
    } catch (const std::logic_error& refusal) {
      expected = refusal.what() + std::string("\n");
    }
    ++census.ticks;
    if (expected != line) return difference(expected, line);
    for (const auto& [node, left] : chosen.answers) {
      if (!left.empty()) return "an answer was not asked for\n";
    }
    for (const auto& [node, left] : chosen.values) {
      if (!left.empty()) return "a value was not asked for\n";
    }
  }
  return {};
}

std::string difference_of_script(const BehaviorTree& tree,
                                 const Network& network, std::uint64_t seed) {
  const Recorded recorded = interpreted_run(tree, seed);
  const std::string text = recorded.script(tree);
  const std::string found = scripted_lines(tree, network, text);
  const std::string differs = difference(recorded.lines, found);
  return differs.empty() ? "" : differs + "script:\n" + text;
}

// --- Nothing is left out -------------------------------------------------

// A state without what a simulation may decide later than the network: timers
// that may be due, and every clock.
std::vector<int> observed(const Network& network,
                          const std::vector<int>& values) {
  std::vector<int> kept = values;
  for (const Automaton& automaton : network.automata) {
    if (automaton.kind == AutomatonKind::Timer) {
      kept[index(automaton.location)] = 0;
    }
  }
  return kept;
}

using Observations = std::set<std::vector<int>>;

// At the beginning of a tick: the root is about to call its child.
Observations naive_beginnings(const BehaviorTree& tree, const Network& network,
                              const NaiveSpace& space) {
  const NaiveNetwork naive(network);
  const Automaton& root =
      network.automaton(network.node_automaton[index(tree.roots[0])]);
  Observations seen;
  for (const NaiveState& state : space.states) {
    for (const std::uint32_t edge : naive.enabled(state)) {
      if (&network.owner_of_edge(edge) != &root) continue;
      if (root.source(network.edge(edge)).role != LocationRole::Tick) {
        continue;
      }
      seen.insert(observed(network, state.values));
    }
  }
  return seen;
}

Observations simulated_beginnings(const BehaviorTree& tree,
                                  const Network& network) {
  Observations seen;
  std::set<std::pair<std::vector<int>, std::vector<int>>> visited;
  std::vector<Simulation> open;
  open.emplace_back(tree, network, Interleaving::Open);
  while (!open.empty()) {
    const Simulation here = std::move(open.back());
    open.pop_back();
    if (!visited.emplace(here.state().variables, here.state().clocks).second) {
      continue;
    }
    if (!here.choices().empty() && here.choices()[0].kind == ChoiceKind::Tick) {
      seen.insert(observed(network, here.state().variables));
    }
    for (std::size_t i = 0; i < here.choices().size(); ++i) {
      Simulation next = here;
      next.take(i);
      open.push_back(std::move(next));
    }
  }
  return seen;
}

// --- The cases -----------------------------------------------------------

// Runs `differs(tree, network, seed)` on random trees; the least tree on which
// it finds something fails the test.
template <class Differs>
void check_trees(std::uint64_t trees, const RandomTreeWeights& weights,
                 Differs differs) {
  const std::uint64_t seed = seed_or(1);
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const auto found_in = [&](const std::string& text,
                              std::uint64_t runs) -> std::string {
      const Result<BehaviorTree> tree = read_btf("random.btf", text);
      if (!tree.value) return {};
      const Network network = lower(*tree.value, TickSemantics::Root);
      for (std::uint64_t run = 0; run < runs; ++run) {
        const std::string found = differs(*tree.value, network, here + run);
        if (!found.empty()) return found;
      }
      return {};
    };
    const std::string text =
        i % 2 == 0 ? random_tree(here) : random_tree(here, weights);
    REQUIRE(read_btf("random.btf", text).value.has_value());
    if (found_in(text, 2).empty()) continue;
    const std::string small = shrink(text, [&](const std::string& candidate) {
      return !found_in(candidate, 20).empty();
    });
    FAIL("seed ", here, "\n", small, "\n", found_in(small, 20));
  }
}

}  // namespace

TEST_CASE("a random simulated run is a run of the tick interpreter") {
  const auto trees = by_effort<std::uint64_t>(300, 3000);
  Census census;
  check_trees(trees, large_trees(),
              [&](const BehaviorTree& tree, const Network& network,
                  std::uint64_t seed) {
                return difference_of_random_run(tree, network, seed, census);
              });
  MESSAGE(trees << " trees, " << census.ticks << " ticks, " << census.faults
                << " faults");
  CHECK_COVERED(census.ticks > static_cast<int>(trees));
  CHECK_COVERED(census.faults > 0);
}

TEST_CASE("a run of the tick interpreter, written as a script, comes again") {
  const auto trees = by_effort<std::uint64_t>(300, 3000);
  check_trees(trees, large_trees(), difference_of_script);
  check_trees(trees, timed_weather(), difference_of_script);
  MESSAGE(trees << " trees");
}

namespace {

struct SpaceCensus {
  std::size_t compared = 0;
  std::size_t beginnings = 0;
};

std::string difference_of_space(const BehaviorTree& tree,
                                const Network& network, std::size_t most,
                                SpaceCensus& census) {
  const auto space = naive_space(network, most);
  if (!space) return {};
  const Observations expected = naive_beginnings(tree, network, *space);
  const Observations found = simulated_beginnings(tree, network);
  ++census.compared;
  census.beginnings += expected.size();
  if (expected == found) return {};
  return fmt::format("{} states, of which the choices reach {}\n",
                     expected.size(), found.size());
}

}  // namespace

TEST_CASE("choices reach whatever can be reached when a tick begins") {
  const auto trees = by_effort<std::uint64_t>(300, 3000);
  RandomTreeWeights side_by_side;
  side_by_side.min_nodes = 6;
  side_by_side.max_nodes = 10;
  side_by_side.max_variables = 1;
  side_by_side.max_parallels = 2;
  side_by_side.halting_top = 0;
  side_by_side.contract = 80;
  SpaceCensus census;
  check_trees(
      trees, side_by_side,
      [&](const BehaviorTree& tree, const Network& network, std::uint64_t) {
        // Where a clock decides, a tree may have ended before it is time.
        const bool has_clock = std::ranges::any_of(
            tree.variables,
            [](const StateVariable& each) { return !each.lasting.empty(); });
        return has_clock ? std::string()
                         : difference_of_space(tree, network, 6000, census);
      });
  MESSAGE(trees << " trees, " << census.compared << " spaces, "
                << census.beginnings << " beginnings of ticks");
  CHECK_COVERED(census.compared > trees);
  check_trees(
      trees, timed_weather(),
      [&](const BehaviorTree& tree, const Network& network, std::uint64_t) {
        // Where a clock decides, a tree may have ended before it is time.
        const bool has_clock = std::ranges::any_of(
            tree.variables,
            [](const StateVariable& each) { return !each.lasting.empty(); });
        return has_clock ? std::string()
                         : difference_of_space(tree, network, 6000, census);
      });
}

// What one part of a tree does makes a difference to another.
const char* const kContests[] = {
    "((defsv x :max 1) (defaction a :on-success ((:= x (- 1 x))))"
    " (BehaviorTree :loop 1 (ParallelAll (Sequence (Action :ID b)"
    " (Eval (= x 0))) (Action :ID a))))",
    "((defsv x :max 1) (BehaviorTree :loop 1 (ParallelAll"
    " (Sequence (Eval (= x 0)) (Action :ID b)) (Sequence (Action :ID a)"
    " (Eval (:= x (- 1 x)))))))",
    "((defsv x :max 2) (BehaviorTree :loop 1 (ParallelAll"
    " (Sequence (Action :ID b) (Eval (:= x 1)))"
    " (Sequence (Action :ID a) (Eval (:= x 2))))))",
    "((defsv b :states (Good Low)) (BehaviorTree :loop 1 (Parallel :success 1"
    " (SetSV :ID m :sv b) (Sequence (Eval (= b Good)) (Eval (= b Low))))))",
    "((defsv w :states (Calm Storm)) (BehaviorTree :loop 1 (Sequence"
    " (Eval (= w Calm)) (Eval (= w Storm)) (Action :ID a))))",
    "((defsv w :states (A B C) :transitions ((A B) (B C) (C A)))"
    " (BehaviorTree :loop 1 (Sequence (Eval (= w A)) (Eval (= w C))"
    " (Action :ID a))))",
    "((defsv w :states (A B) :moves free) (BehaviorTree :loop 1 (Sequence"
    " (Eval (:= w A)) (Fallback (Eval (= w A)) (Action :ID a)))))",
    "((defsv w :states (A B C) :transitions ((A B [2,3]) (B C [0,1])"
    " (C A [1,inf]))) (BehaviorTree :loop 1 (Sequence (Eval (= w A))"
    " (Eval (= w C)) (Action :ID a))))",
    "(BehaviorTree :loop 1 (ParallelAll (Action :ID a) (Sequence"
    " (Eval (= a.rstatus running)) (Action :ID b))))",
    "((defsv x :max 1) (BehaviorTree :loop 1 (ParallelAll"
    " (Sequence (Action :ID a :duration [1,3]) (Eval (:= x 1)))"
    " (Sequence (Wait :duration 2) (Eval (= x 0)) (Action :ID b)))))",
    "((defsv x :max 1) (defaction a :requires (= x 0) :duration [0,2])"
    " (BehaviorTree :loop 1 (ParallelAll (Action :ID a) (Sequence"
    " (Action :ID c) (Eval (:= x (- 1 x)))))))"};

TEST_CASE("choices reach what depends on who comes first") {
  SpaceCensus census;
  for (const char* const text : kContests) {
    CAPTURE(text);
    const Result<BehaviorTree> tree = read_btf("tree.btf", text);
    REQUIRE(tree.value.has_value());
    const Network network = lower(*tree.value, TickSemantics::Root);
    const std::string differs =
        difference_of_space(*tree.value, network, 100'000, census);
    CHECK(differs == "");
  }
  CHECK(census.compared == std::size(kContests));
}

}  // namespace btcheck::reference::simulation_cross_check_test

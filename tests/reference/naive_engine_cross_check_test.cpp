// SPDX-License-Identifier: MIT
//
// Random XML trees, ticked by the automata with a random world, and by plain
// functions with the same one: every node answers and is halted in the same
// order, and is left with the same status after every tick.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "check/simulate/simulation.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/naive_engine.hpp"
#include "reference/random_xml_tree.hpp"

namespace btcheck::reference::naive_engine_cross_check_test {
namespace {

// What the world has said, in the words of the functions.
std::string said_by(const Edge& edge) {
  if (edge.label.ends_with("` is true")) return "true";
  if (edge.label.ends_with("` is false")) return "false";
  return edge.label;
}

// One tick of the automata.
struct Tick {
  std::vector<std::string> told;               // "3 success", "4 halted"
  std::vector<std::deque<std::string>> world;  // by node, what it was told
  std::vector<std::string> statuses;           // by node, afterwards
  bool throws = false;
  bool is_whole = false;
};

class AutomataRun {
 public:
  AutomataRun(const BehaviorTree& tree, std::uint64_t seed)
      : tree_(tree),
        network_(lower(tree, TickSemantics::Root)),
        simulation_(tree_, network_, Interleaving::InOrder),
        random_(seed) {
    note();
  }

  Tick next() {
    for (int step = 0; step < 2000 && !simulation_.choices().empty(); ++step) {
      simulation_.take(random_choice(simulation_.choices(), random_));
      note();
      if (!ready_.empty()) break;
    }
    if (ready_.empty()) return std::move(now_);
    Tick tick = std::move(ready_.front());
    ready_.pop_front();
    return tick;
  }

 private:
  void note() {
    simulation_.for_each_latest(
        [&](const Valuation&, const RunStep& step) { note(step); });
  }

  void note(const RunStep& step) {
    if (step.step.edge == kTimeStep) return;
    const Automaton& automaton = network_.owner_of_edge(step.step.edge);
    if (automaton.kind != AutomatonKind::Node) return;
    const Edge& edge = network_.edge(step.step.edge);
    const std::string& target = automaton.target(edge).name;
    const LocationRole role = automaton.target(edge).role;
    const std::uint32_t node = index(automaton.node);
    const Node& mover = tree_.node(automaton.node);
    now_.world.resize(tree_.nodes.size());
    if (target == "error") end(step, true);
    if (mover.is_root()) {
      if (is_answer(role)) end(step, false);
      return;
    }
    const bool is_leaf =
        mover.type == NodeType::Action || mover.type == NodeType::Condition;
    const bool stands = edge.label == "has ended already" &&
                        mover.contract.memory == LeafMemory::Unknown && is_leaf;
    if (edge.asks_world || stands) {
      now_.world[node].push_back(said_by(edge));
    } else if (is_leaf && edge.label.empty() && is_answer(role) &&
               target != "skipped") {
      now_.world[node].push_back(target);
    }
    if (is_answer(role) || target == "halted") {
      now_.told.push_back(fmt::format("{} {}", node, target));
    }
  }

  void end(const RunStep& step, bool throws) {
    now_.throws = throws;
    now_.is_whole = true;
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      now_.statuses.push_back(
          std::string(kEngineStatusNames[static_cast<std::size_t>(
              step.after.variables[index(network_.node_status[n])])]));
    }
    ready_.push_back(std::move(now_));
    now_ = {};
    now_.world.resize(tree_.nodes.size());
  }

  const BehaviorTree& tree_;
  Network network_;
  Simulation simulation_;
  btcheck::SplitMix64 random_;
  Tick now_;
  std::deque<Tick> ready_;
};

std::string status_of(const std::string& automaton) {
  if (automaton == "skipped") return "idle";
  return automaton == "skipped_running" ? "running" : automaton;
}

// What has ended and is skipped keeps its status, whichever of the two it is.
bool is_same(const std::string& automaton, const std::string& status) {
  if (automaton == "skipped_ended") {
    return status == "success" || status == "failure";
  }
  return status_of(automaton) == status;
}

// What goes wrong first, or "".
std::string difference(const BehaviorTree& tree, std::uint64_t seed, int ticks,
                       std::size_t& compared) {
  AutomataRun run(tree, seed);
  Tick tick;
  std::vector<std::string> told;
  std::string missing;
  NaiveEngine engine(
      tree,
      [&](NodeId node) -> std::string {
        auto& said = tick.world[index(node)];
        if (said.empty()) {
          missing = fmt::format("node {} asks the world", index(node));
          throw EngineThrows(missing);
        }
        std::string word = said.front();
        said.pop_front();
        return word;
      },
      [&](NodeId node, const std::string& what) {
        told.push_back(fmt::format("{} {}", index(node), what));
      });
  for (int t = 1; t <= ticks; ++t) {
    tick = run.next();
    if (!tick.is_whole) return "";  // goes round within one tick
    told.clear();
    bool throws = false;
    try {
      engine.tick_root(t);
    } catch (const EngineThrows&) {
      throws = true;
    }
    if (!missing.empty()) return fmt::format("tick {}: {}", t, missing);
    if (throws != tick.throws) return fmt::format("tick {}: one throws", t);
    if (throws) return "";
    const std::string automata = fmt::format("{}", fmt::join(tick.told, ", "));
    const std::string functions = fmt::format("{}", fmt::join(told, ", "));
    if (automata != functions) {
      return fmt::format("tick {}:\n  automata  {}\n  functions {}", t,
                         automata, functions);
    }
    for (std::uint32_t n = 1; n < tree.nodes.size(); ++n) {
      const std::string& is = tick.statuses[n];
      const std::string should = status_word(engine.status(NodeId{n}));
      if (!is_same(is, should)) {
        return fmt::format("tick {}: node {} is {}, should be {}", t, n, is,
                           should);
      }
    }
    ++compared;
  }
  return "";
}

}  // namespace

TEST_CASE("automata of XML trees do what the engines' functions do") {
  const std::uint64_t first = seed_or(1);
  const std::uint64_t trees = by_effort<std::uint64_t>(1500, 20'000);
  constexpr std::array<Profile, 5> kProfiles = {
      Profile::Btcpp38, Profile::Btcpp4, Profile::Nav2Humble,
      Profile::Nav2Jazzy, Profile::Nav2Main};
  std::size_t ticks = 0;
  int differences = 0;
  for (std::uint64_t i = 0; i < trees && differences < 5; ++i) {
    TreeReading reading;
    reading.profile = kProfiles[i % kProfiles.size()];
    reading.loops = true;
    const std::string text =
        random_xml_tree(first * 1'000'003 + i, *reading.profile);
    const auto tree = read_tree("t.xml", text, reading);
    if (!tree.value) {
      std::string told;
      for (const Diagnostic& found : tree.diagnostics) {
        if (found.severity == Severity::Error) told += render(found);
      }
      FAIL(text << told);
    }
    for (std::uint64_t world = 0; world < 3; ++world) {
      const std::string found = difference(*tree.value, world, 12, ticks);
      if (found.empty()) continue;
      ++differences;
      FAIL_CHECK(profile_name(*reading.profile)
                 << "\n"
                 << text << found << " (seed " << i << ")");
      break;
    }
  }
  MESSAGE(trees << " trees, " << ticks << " ticks compared");
}

}  // namespace btcheck::reference::naive_engine_cross_check_test

// SPDX-License-Identifier: MIT
//
// An engine beside `simulate --script`, which steps the network's tables, line
// for line, with leaves that answer at once and with leaves on threads of their
// own; and every run of an engine executed again.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "check/simulate/script.hpp"
#include "check/simulate/simulation.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"
#include "run/engine/tree_engine.hpp"
#include "run/leaves/function_leaves.hpp"
#include "run/leaves/scripted_leaves.hpp"
#include "run/record/recorder.hpp"
#include "trace/formats/text.hpp"

namespace btcheck::agreement_test {
namespace {

constexpr int kTicks = 15;

// Leaves that answer by chance, each on a thread of its own that takes its
// time. An answer that comes before the model allows it is kept until then.
class Threaded : public Leaves {
 public:
  Threaded(const BehaviorTree& tree, const CompiledNetwork& system,
           std::uint64_t seed)
      : tree_(tree),
        leaves_(tree, std::chrono::seconds(20)),
        moves_(tree, system, seed),
        minds_(tree.nodes.size(), Mind(seed)) {
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) give(NodeId{n});
    leaves_.begin();
  }
  ~Threaded() override { CHECK(leaves_.end()); }

  Reply ask(const LeafQuestion& question) override {
    Mind& mind = minds_[index(question.node)];
    LeafQuestion again = question;
    if (again.asked == Asked::Anew) {
      mind.early.reset();
      mind.allowed.clear();
      for (const PossibleAnswer& each : question.possible) {
        if (each.result != kFaultResult) mind.allowed.push_back(each.result);
      }
    }
    Reply reply = mind.early ? *mind.early : leaves_.ask(again);
    again.asked = Asked::Again;
    while (is_running(reply) && !is_possible(question, reply)) {
      reply = leaves_.ask(again);
    }
    if (is_running(reply)) return reply;
    mind.early.reset();
    if (is_possible(question, reply) || question.may_be_due) return reply;
    const Reply runs = Reply::answer(NodeStatus::Running);
    if (!is_possible(question, runs)) return reply;
    mind.early = reply;
    return runs;
  }
  void halt(NodeId node) override {
    minds_[index(node)].early.reset();
    leaves_.halt(node);
  }
  std::optional<VariableMove> next_move(int tick, StateView now) override {
    return moves_.next_move(tick, now);
  }
  bool lets_variables_move() const override { return true; }

 private:
  // Written by the engine's thread before a call, read by the leaf's.
  struct Mind {
    explicit Mind(std::uint64_t seed) : chance(seed) {}
    SplitMix64 chance;
    std::vector<int> allowed = {};  // when it was asked anew
    std::optional<Reply> early = {};
  };

  static bool is_running(const Reply& reply) {
    return reply.kind == Reply::Kind::Answer &&
           reply.value == static_cast<int>(NodeStatus::Running);
  }
  static bool is_possible(const LeafQuestion& question, const Reply& reply) {
    return std::ranges::find(question.possible, reply.value,
                             &PossibleAnswer::result) !=
           question.possible.end();
  }

  bool succeeds(NodeId node) {
    const LeafContract& contract = tree_.node(node).contract;
    const bool wants_to = minds_[index(node)].chance.below(2) == 0;
    return contract.may_succeed && (wants_to || !contract.may_fail);
  }

  void give(NodeId id) {
    const Node& node = tree_.node(id);
    if (node.type == NodeType::Action) {
      leaves_.give(id, {run::ActionFunction(
                           [this, id](const run::Call&, std::stop_token stop) {
                             return act(id, stop);
                           })});
    } else if (node.type == NodeType::Condition) {
      leaves_.give(id, {run::ConditionFunction([this, id](const run::Call&) {
                     return succeeds(id);
                   })});
    } else if (node.type == NodeType::SetSV) {
      leaves_.give(id, {run::MeasureFunction([this, id](const run::Call&) {
                     return measured(id);
                   })});
    }
  }

  run::Answer act(NodeId id, const std::stop_token& stop) {
    const auto turns = minds_[index(id)].chance.below(40);
    for (std::uint64_t i = 0; i < turns && !stop.stop_requested(); ++i) {
      std::this_thread::yield();
    }
    return succeeds(id) ? run::Answer::Success : run::Answer::Failure;
  }

  run::Value measured(NodeId id) {
    const StateVariable& variable = tree_.variable(tree_.node(id).variable);
    Mind& mind = minds_[index(id)];
    const int found = mind.allowed.at(mind.chance.below(mind.allowed.size()));
    if (variable.is_enumeration()) return variable.value_name(found);
    return number_of(variable, found);
  }

  const BehaviorTree& tree_;
  FunctionLeaves leaves_;
  RandomLeaves moves_;
  std::vector<Mind> minds_;  // by NodeId
};

// What leaves have answered, as a script.
class Noted : public Leaves {
 public:
  Noted(const BehaviorTree& tree, const CompiledNetwork& system, Leaves& leaves)
      : tree_(tree), system_(system), leaves_(leaves) {}

  Reply ask(const LeafQuestion& question) override {
    return note(question, leaves_.ask(question));
  }
  Reply refused(const LeafQuestion& question) override {
    return note(question, leaves_.refused(question));
  }
  void halt(NodeId node) override { leaves_.halt(node); }
  bool lets_variables_move() const override { return true; }
  std::optional<VariableMove> next_move(int tick, StateView now) override {
    const auto move = leaves_.next_move(tick, now);
    if (noted_tick_ != tick) {
      noted_tick_ = tick;
      for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
        const StateVariableId id{v};
        if (!moves_freely(tree_, id)) continue;
        const bool has_moved = move && move->variable == id;
        const int value = has_moved
                              ? move->value
                              : static_cast<int>(system_.value(
                                    now, system_.network().state_variable[v]));
        lines_["$" + tree_.variables[v].name] +=
            " " + tree_.variables[v].value_name(value);
      }
    }
    return move;
  }

  std::string script() const {
    std::string text;
    for (const auto& [name, words] : lines_) text += name + ":" + words + "\n";
    return text;
  }

 private:
  Reply note(const LeafQuestion& question, Reply reply) {
    const int value = reply.kind == Reply::Kind::Answer
                          ? reply.value
                          : question.possible[0].result;
    const Node& leaf = tree_.node(question.node);
    const std::string word =
        is_measured(leaf)
            ? tree_.variable(leaf.variable).value_name(value)
            : std::string(kStatusNames[static_cast<std::size_t>(value)]);
    lines_[unique_name(tree_, question.node)] += " " + word;
    return reply;
  }
  static bool is_measured(const Node& leaf) {
    return leaf.type == NodeType::SetSV;
  }

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  Leaves& leaves_;
  std::map<std::string, std::string> lines_;
  int noted_tick_ = 0;
};

struct Told {
  std::string lines;
  std::size_t steps = 0;
  EngineState end = EngineState::Ready;
  bool is_run_of_the_model = false;
  std::uint64_t breaches = 0;
};

Told engine_lines(const BehaviorTree& tree, const CompiledNetwork& system,
                  Leaves& leaves) {
  Told told;
  RunRecorder recorder;
  TickTeller teller(tree, system, [&](const std::string& line) {
    told.lines += line + "\n";
  });
  TreeEngine engine(tree, system, leaves, OnBreach::Stop);
  engine.add(recorder);
  engine.add(teller);
  engine.begin();
  for (int tick = 0; tick < kTicks && engine.state() == EngineState::Ready;
       ++tick) {
    engine.tick();
  }
  told.lines += teller.rest();
  told.steps = recorder.steps().size();
  told.end = engine.state();
  told.breaches = engine.breaches();
  const auto run = recorder.replayed(system.network());
  told.is_run_of_the_model =
      run && run->state(run->steps.size()) == unpacked(system, engine.now());
  return told;
}

std::string simulated_lines(const BehaviorTree& tree, const Network& network,
                            const SimulationScript& script,
                            const SourceText& source) {
  ScriptPlayer player(script, source);
  Simulation simulation(tree, network, Interleaving::InOrder);
  while (simulation.end() == RunEnd::None &&
         (simulation.choices()[0].kind != ChoiceKind::Tick ||
          simulation.ticks(
              network.owner_of_edge(simulation.choices()[0].step.edge).node) <
              kTicks)) {
    const ScriptedChoice choice = player.choose(simulation);
    if (const auto* refusal = std::get_if<Diagnostic>(&choice)) {
      return render(*refusal);
    }
    simulation.take(std::get<std::size_t>(choice));
  }
  return tick_lines(tree, network, simulation.run());
}

struct Census {
  std::uint64_t steps = 0;
  int ends = 0;
  int faults = 0;
};

// "" where all agree. Chance: RandomLeaves or Threaded.
template <class Chance>
std::string difference(const std::string& text, std::uint64_t seed,
                       Census& census) {
  const auto tree = read_btf("tree.btf", text);
  if (!tree.value) return {};
  const Network network = lower(*tree.value, TickSemantics::Root);
  const CompiledNetwork system(network);
  Chance chance(*tree.value, system, seed);
  Noted noted(*tree.value, system, chance);
  const Told first = engine_lines(*tree.value, system, noted);
  census.steps += first.steps;
  census.ends += first.end == EngineState::Ended;
  census.faults += first.end == EngineState::Fault;
  if (!first.is_run_of_the_model) return "no run of the model\n";
  if (first.breaches != 0) return "a breach\n";

  const std::string written = noted.script();
  const SourceText source("s.txt", written);
  const auto script =
      read_simulation_script(*tree.value, network, "s.txt", written);
  if (!script.value) return render(script.diagnostics.at(0));
  ScriptedLeaves scripted(*tree.value, *script.value);
  const Told second = engine_lines(*tree.value, system, scripted);
  const std::string simulated =
      simulated_lines(*tree.value, network, *script.value, source);
  if (first.lines == second.lines && second.lines == simulated &&
      second.is_run_of_the_model) {
    return {};
  }
  return fmt::format("by chance:\n{}scripted:\n{}simulated:\n{}script:\n{}",
                     first.lines, second.lines, simulated, written);
}

template <class Chance>
void compare(std::uint64_t trees, const reference::RandomTreeWeights& weights,
             Census& census) {
  const std::uint64_t seed = reference::seed_or(1);
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::string text = reference::random_tree(seed + i, weights);
    const std::string differs = difference<Chance>(text, i, census);
    if (differs.empty()) continue;
    Census other;
    const std::string least =
        reference::shrink(text, [&](const std::string& smaller) {
          return read_btf("tree.btf", smaller).value.has_value() &&
                 !difference<Chance>(smaller, i, other).empty();
        });
    FAIL_CHECK("seed " << i << ":\n" << least << differs);
    return;
  }
}

}  // namespace

TEST_CASE("an engine and a simulation go the same way, line for line") {
  Census census;
  compare<RandomLeaves>(reference::by_effort<std::uint64_t>(600, 6000), {},
                        census);
  compare<RandomLeaves>(reference::by_effort<std::uint64_t>(400, 4000),
                        reference::large_trees(), census);
  MESSAGE(census.steps << " steps, " << census.ends << " ends, "
                       << census.faults << " faults");
  CHECK_COVERED(census.steps > 100'000);
  CHECK_COVERED(census.ends > 100);
  CHECK_COVERED(census.faults > 10);
}

TEST_CASE("leaves on threads of their own go the same way, line for line") {
  Census census;
  compare<Threaded>(reference::by_effort<std::uint64_t>(200, 1000), {}, census);
  MESSAGE(census.steps << " steps, " << census.ends << " ends, "
                       << census.faults << " faults");
  CHECK_COVERED(census.steps > 10'000);
  CHECK_COVERED(census.ends > 20);
}

}  // namespace btcheck::agreement_test

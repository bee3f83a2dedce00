// SPDX-License-Identifier: MIT
//
// Steps that leave nothing open are taken at once: the caller is asked only for
// what the world decides. In which order two children of a Parallel, or two
// trees, take their steps is asked only where one writes what the other reads
// or writes; such places are found beforehand, on the tables. All else
// commutes, and goes by process number. A free variable may move when a tick
// begins and before each step that reads or writes it, a timer may be due
// before each step that reads it: at other instants only the order of the
// telling would change. A fault ends the run; what else could have happened in
// its instant is not asked.
//
// Only steps are kept; states are executed again when they are asked for.
#include "check/simulate/simulation.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "explore/state/accesses.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

bool is_parallel(NodeType type) {
  return type == NodeType::Parallel || type == NodeType::ParallelAll;
}

// Finds the locations of automata whose steps others can interfere with.
class Contests {
 public:
  Contests(const BehaviorTree& tree, const Network& network)
      : tree_(tree),
        network_(network),
        accesses_(network),
        is_sequential_(tree.roots.size() == 1 &&
                       std::ranges::none_of(tree.nodes, [](const Node& node) {
                         return is_parallel(node.type);
                       })) {}

  std::vector<std::vector<bool>> find() const {
    std::vector<std::vector<bool>> contested;
    for (const Automaton& automaton : network_.automata) {
      contested.emplace_back(automaton.locations.size(), false);
      if (automaton.kind != AutomatonKind::Node) continue;
      for (const Edge& edge : automaton.edges) {
        if (is_contested(automaton, edge)) {
          contested.back()[index(edge.source)] = true;
        }
      }
    }
    return contested;
  }

 private:
  bool is_contested(const Automaton& automaton, const Edge& edge) const {
    bool is_so = false;
    const auto look = [&](VariableId variable,
                          const std::vector<std::vector<AutomatonId>>& users) {
      if (is_so || variable == network_.fault) return;
      is_so =
          std::ranges::any_of(users[index(variable)], [&](AutomatonId user) {
            return meets(automaton, network_.automaton(user));
          });
    };
    for_each_access(
        automaton, edge,
        [&](VariableId read) { look(read, accesses_.writers); },
        [&](VariableId written) {
          look(written, accesses_.writers);
          look(written, accesses_.readers);
        });
    return is_so;
  }

  // Both may have a step to take in the same state. Timers are looked at where
  // they are read.
  bool meets(const Automaton& node, const Automaton& other) const {
    if (&node == &other) return false;
    if (other.kind == AutomatonKind::StateVariable) return true;
    return other.kind == AutomatonKind::Node &&
           run_side_by_side(node.node, other.node);
  }

  bool run_side_by_side(NodeId one, NodeId other) const {
    if (is_sequential_) return false;
    if (const auto fork = fork_of(tree_, one, other)) {
      return is_parallel(tree_.node(fork->node).type);
    }
    return root_of(tree_, one) != root_of(tree_, other);
  }

  const BehaviorTree& tree_;
  const Network& network_;
  Accesses accesses_;
  bool is_sequential_;  // no two nodes ever run side by side
};

bool answers(const BehaviorTree& tree, const Automaton& automaton,
             const Edge& edge) {
  // In XML trees: its _while has become false, or its answer is known to stand
  // until it is reset.
  if (edge.label == "halts itself") return false;
  const Node& node = tree.node(automaton.node);
  if (keeps_answer(edge) && node.contract.memory == LeafMemory::Latched) {
    return false;
  }
  const LocationRole target = automaton.target(edge).role;
  return is_scripted(node.type) &&
         (is_answer(target) || target == LocationRole::Error);
}

std::size_t number_of_owner(const Network& network, std::uint32_t edge) {
  return static_cast<std::size_t>(&network.owner_of_edge(edge) -
                                  network.automata.data());
}

bool leave_nothing_open(std::span<const SimulationChoice> choices) {
  if (choices.size() != 1) return false;
  const ChoiceKind kind = choices[0].kind;
  return kind != ChoiceKind::Answer && kind != ChoiceKind::Tick &&
         kind != ChoiceKind::Move;
}

}  // namespace

bool is_scripted(NodeType type) {
  return type == NodeType::Action || type == NodeType::Condition ||
         type == NodeType::SetSV;
}

bool keeps_answer(const Edge& edge) {
  return edge.label == "has ended already";
}

Simulation::Simulation(const BehaviorTree& tree, const Network& network,
                       Interleaving interleaving)
    : tree_(tree),
      network_(network),
      interpreter_(network),
      interleaving_(interleaving),
      contested_(Contests(tree, network).find()),
      ticks_(tree.nodes.size(), 0) {
  restart({});
  settle();
}

// --- What may happen -----------------------------------------------------

void Simulation::add_enabled(const Automaton& automaton,
                             std::vector<std::uint32_t>& edges) const {
  if (automaton.gate && state_.variables[index(*automaton.gate)] == 0) return;
  const VariableId location = automaton.location;
  const LocationId here{static_cast<std::uint32_t>(
      state_.variables[index(location)] - network_.variable(location).min)};
  for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
    const std::uint32_t edge = automaton.first_edge + e;
    if (automaton.edges[e].source == here &&
        interpreter_.may_fire(state_, edge)) {
      edges.push_back(edge);
    }
  }
}

std::vector<std::uint32_t> Simulation::enabled(AutomatonKind kind) const {
  std::vector<std::uint32_t> edges;
  for (const Automaton& automaton : network_.automata) {
    if (automaton.kind == kind) add_enabled(automaton, edges);
  }
  return edges;
}

// A timer that has reached its deadline goes before everything else; which of
// several is the first makes no difference.
std::optional<std::uint32_t> Simulation::forced_timer() const {
  for (const std::uint32_t edge : enabled(AutomatonKind::Timer)) {
    const int clock = state_.clocks[number_of_owner(network_, edge)];
    if (clock == network_.edge(edge).when.upper) return edge;
  }
  return std::nullopt;
}

bool Simulation::is_contested(std::uint32_t edge) const {
  return contested_[number_of_owner(network_, edge)]
                   [index(network_.edge(edge).source)];
}

ChoiceKind Simulation::kind_of(std::uint32_t number) const {
  const Automaton& automaton = network_.owner_of_edge(number);
  const Edge& edge = network_.edge(number);
  if (tree_.node(automaton.node).is_root()) {
    return automaton.source(edge).role == LocationRole::Tick ? ChoiceKind::Tick
                                                             : ChoiceKind::Tree;
  }
  if (edge.asks_world) return ChoiceKind::World;
  return answers(tree_, automaton, edge) ? ChoiceKind::Answer
                                         : ChoiceKind::Tree;
}

// A SetSV that finds nothing new is what goes without saying.
void Simulation::put_unchanged_first(Choices& own) const {
  const auto same =
      std::ranges::find_if(own, [&](const SimulationChoice& choice) {
        const NodeId node = network_.owner_of_edge(choice.step.edge).node;
        if (tree_.node(node).type != NodeType::SetSV) return false;
        const VariableId found =
            network_.state_variable[index(tree_.node(node).variable)];
        return after(choice).variables[index(found)] ==
               state_.variables[index(found)];
      });
  if (same != own.end()) std::rotate(own.begin(), same, same + 1);
}

// A state variable that stands for many values lets a script come out in ways
// that the real ones do not.
void Simulation::leave_out_refused(std::vector<std::uint32_t>& edges) const {
  if (!values_ || edges.size() == 1) return;
  const auto is_taken = [&](std::uint32_t edge) {
    btcpp::EntryExecution values = *values_;
    return values.refused(network_.edge(edge).scripts) == nullptr;
  };
  const auto taken =
      std::stable_partition(edges.begin(), edges.end(), is_taken);
  if (taken != edges.begin()) edges.erase(taken, edges.end());
}

// The steps of the first node that nobody can interfere with; where there is
// none, of all.
Simulation::Choices Simulation::choices_of_tree() const {
  Choices all;
  std::vector<std::uint32_t> edges;
  for (const Automaton& automaton : network_.automata) {
    if (automaton.kind != AutomatonKind::Node) continue;
    edges.clear();
    add_enabled(automaton, edges);
    if (edges.empty()) continue;
    leave_out_refused(edges);
    Choices own;
    for (const std::uint32_t edge : edges) {
      own.push_back({{edge, 0, true}, kind_of(edge)});
    }
    put_unchanged_first(own);
    if (interleaving_ == Interleaving::InOrder || !is_contested(edges[0])) {
      return own;
    }
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

// The timers that may be due now, where one of the choices depends on it.
void Simulation::add_due(Choices& choices) const {
  const std::size_t count = choices.size();
  for (const std::uint32_t edge : enabled(AutomatonKind::Timer)) {
    const Valuation due = interpreter_.after(state_, {edge, 0, true});
    const bool makes_a_difference = std::any_of(
        choices.begin(), choices.begin() + static_cast<std::ptrdiff_t>(count),
        [&](const SimulationChoice& choice) {
          return !interpreter_.may_fire(due, choice.step.edge);
        });
    if (makes_a_difference) {
      choices.push_back({{edge, 0, true}, ChoiceKind::Due});
    }
  }
}

bool Simulation::may_move(const Automaton& variable,
                          const Choices& choices) const {
  const NodeId first = tree_.roots.front();
  for (const SimulationChoice& choice : choices) {
    if (choice.kind == ChoiceKind::Move) continue;
    const Automaton& automaton = network_.owner_of_edge(choice.step.edge);
    if (choice.kind == ChoiceKind::Tick &&
        (interleaving_ == Interleaving::Open || automaton.node == first)) {
      return true;
    }
    if (interleaving_ == Interleaving::InOrder) continue;
    bool is_used = false;
    const auto look = [&](VariableId used) {
      is_used |=
          used == network_.state_variable[index(variable.state_variable)];
    };
    // Not the edge alone: its siblings are what could be enabled instead.
    for (const Edge& edge : automaton.edges) {
      if (edge.source == network_.edge(choice.step.edge).source) {
        for_each_access(automaton, edge, look, look);
      }
    }
    if (is_used) return true;
  }
  return false;
}

// No node can take a step: time passes, and after the end of all trees free
// variables still move.
Simulation::Choices Simulation::choices_without_tree() const {
  const bool may_wait = interpreter_.may_wait(state_) &&
                        interpreter_.after(state_, kIdleStep) != state_;
  Choices choices;
  if (may_wait) choices.push_back({kIdleStep, ChoiceKind::Time});
  if (may_wait && has_root_alive()) return choices;
  for (const std::uint32_t edge : enabled(AutomatonKind::Timer)) {
    choices.push_back({{edge, 0, true}, ChoiceKind::Due});
  }
  for (const std::uint32_t edge : enabled(AutomatonKind::StateVariable)) {
    choices.push_back({{edge, 0, false}, ChoiceKind::Move});
  }
  return choices;
}

Simulation::Choices Simulation::possible() const {
  if (const auto timer = forced_timer()) {
    return {{{*timer, 0, true}, ChoiceKind::Tree}};
  }
  Choices choices = choices_of_tree();
  if (choices.empty()) return choices_without_tree();
  add_due(choices);
  for (const std::uint32_t edge : enabled(AutomatonKind::StateVariable)) {
    if (may_move(network_.owner_of_edge(edge), choices)) {
      choices.push_back({{edge, 0, false}, ChoiceKind::Move});
    }
  }
  return choices;
}

// --- What happens --------------------------------------------------------

// Executes the steps from the initial state on.
void Simulation::restart(std::span<const Step> steps) {
  steps_.clear();
  std::ranges::fill(ticks_, 0);
  state_ = interpreter_.initial();
  if (tree_.programs) values_.emplace(*tree_.programs);
  for (const Step& step : steps) execute(step);
  before_latest_ = state_;
  first_latest_ = steps_.size();
}

void Simulation::execute(const Step& step) {
  assert(interpreter_.taken(state_, step).has_value());
  interpreter_.take(state_, step);
  steps_.push_back(step);
  if (step.edge == kTimeStep) return;
  if (values_) values_->refused(network_.edge(step.edge).scripts);
  const Automaton& mover = network_.owner_of_edge(step.edge);
  if (mover.kind == AutomatonKind::Node &&
      kind_of(step.edge) == ChoiceKind::Tick) {
    ++ticks_[index(mover.node)];
  }
}

// Ends: every cycle of the tree passes through the beginning of a tick, which
// is offered, and time that changes nothing does not pass.
void Simulation::settle() {
  choices_ = possible();
  while (leave_nothing_open(choices_)) {
    execute(choices_[0].step);
    choices_ = possible();
  }
}

void Simulation::take(std::size_t choice) {
  assert(choice < choices_.size());
  const Step step = choices_[choice].step;
  marks_.push_back({steps_.size(), choices_.size() > 1});
  before_latest_ = state_;
  first_latest_ = steps_.size();
  execute(step);
  settle();
}

bool Simulation::back() {
  const auto last =
      std::find_if(marks_.rbegin(), marks_.rend(),
                   [](const Mark& mark) { return mark.is_among_several; });
  if (last == marks_.rend()) return false;
  const std::vector<Step> kept(steps_.begin(), steps_.begin() + last->steps);
  marks_.erase(last.base() - 1, marks_.end());
  restart(kept);
  choices_ = possible();
  return true;
}

Run Simulation::run() const {
  Run run{interpreter_.initial(), {}, kNoLoop};
  for (const Step& step : steps_) {
    run.steps.push_back(
        {step, interpreter_.after(run.state(run.steps.size()), step)});
  }
  return run;
}

bool Simulation::has_root_alive() const {
  return std::ranges::any_of(tree_.roots, [&](NodeId root) {
    const Automaton& automaton = network_.automaton(root);
    const LocationId here{static_cast<std::uint32_t>(
        state_.variables[index(automaton.location)])};
    return std::ranges::any_of(
        automaton.edges, [&](const Edge& edge) { return edge.source == here; });
  });
}

RunEnd Simulation::end() const {
  if (network_.fault && state_.variables[index(*network_.fault)] != 0) {
    return RunEnd::Fault;
  }
  if (!has_root_alive()) return RunEnd::Ended;
  return choices_.empty() ? RunEnd::Stuck : RunEnd::None;
}

int Simulation::ticks(NodeId node) const {
  return ticks_[index(root_of(tree_, node))];
}

// --- Chance --------------------------------------------------------------

std::size_t random_choice(std::span<const SimulationChoice> choices,
                          SplitMix64& random) {
  const auto settled = static_cast<std::size_t>(
      std::ranges::find(choices, ChoiceKind::Move, &SimulationChoice::kind) -
      choices.begin());
  const std::size_t moves = choices.size() - settled;
  if (settled == 0 || moves == 0) return random.below(choices.size());
  if (random.below(4) != 0) return random.below(settled);
  return settled + random.below(moves);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// The search is reduced: what happens between two choices of the world is one
// step with all its events. Those of one tree come in one order, whatever the
// others do, so the reduction leaves no sequence of them out.
#include "check/whatif/answer_graph.hpp"

#include <algorithm>
#include <utility>

#include "explore/components/composition.hpp"
#include "explore/state/spent.hpp"
#include "model/sampling.hpp"
#include "model/tree/leaf_fault.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// They are numbered in so many bits.
constexpr std::uint32_t kMostSequences = 0x1fffffff;

// What is told of a state: the ends of roots, faults, and who of these runs
// there.
Observed told_of(const BehaviorTree& tree, const Network& network,
                 const Heard& heard, bool with_running) {
  Observed told(network);
  for (const NodeId root : tree.roots) {
    const Automaton& automaton = network.automaton(root);
    for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
      if (!is_end(automaton.locations[i].role)) continue;
      told.add(equals(automaton.location, static_cast<int>(i)));
    }
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!heard.hears(NodeId{n})) continue;
    if (const auto phase = fault_phase(network, NodeId{n})) told.add(*phase);
    if (!with_running || !is_leaf(tree.nodes[n].type)) continue;
    told.add(equals(network.node_status[n], NodeStatus::Running));
  }
  return told;
}

}  // namespace

std::optional<Happening> shown_as(LocationRole role) {
  switch (role) {
    case LocationRole::Tick:
      return Happening::Asked;
    case LocationRole::Success:
      return Happening::Success;
    case LocationRole::Failure:
      return Happening::Failure;
    case LocationRole::Running:
      return Happening::Running;
    case LocationRole::Skipped:
      return Happening::Skipped;
    case LocationRole::Halted:
      return Happening::Halted;
    default:
      return std::nullopt;
  }
}

std::optional<NodeEvent> event_of(const Network& network, std::uint32_t edge) {
  if (edge == kTimeStep) return std::nullopt;
  const Automaton& owner = network.owner_of_edge(edge);
  if (owner.kind != AutomatonKind::Node) return std::nullopt;
  const auto what = shown_as(owner.target(network.edge(edge)).role);
  return what ? std::optional(NodeEvent(owner.node, *what)) : std::nullopt;
}

Result<Network> lower_regions(const BehaviorTree& tree,
                              const SourceText& source, TickSemantics ticks) {
  const Lowering how = lowering(tree, ticks);
  Network network = lower_to_bind(tree, how);
  auto found = sample_regions(tree, source, {}, how, network);
  if (has_error(found)) return {std::nullopt, std::move(found)};
  return {std::move(network), {}};
}

std::optional<VariableId> fault_phase(const Network& network, NodeId leaf) {
  return local_of(network, leaf, LocalRole::Fault);
}

struct AnswerGraph::Parts {
  Parts(const Network& network, const Heard& heard)
      : components(network, std::vector<bool>(network.variables.size(), false),
                   {}, heard.known),
        composition(components, standing(network, heard), true) {}

  static std::vector<bool> standing(const Network& network,
                                    const Heard& heard) {
    std::vector<bool> stands(network.automata.size(), false);
    for (std::uint32_t n = 0; n < heard.nodes.size(); ++n) {
      if (heard.nodes[n]) stands[index(network.node_automaton[n])] = true;
    }
    return stands;
  }

  ComponentTable components;
  Composition composition;
};

const Heard AnswerGraph::kAllHeard;

AnswerGraph::AnswerGraph(const BehaviorTree& tree, const Network& network,
                         const Limits& limits, Reduction reduction,
                         const Heard& heard)
    : tree_(tree),
      heard_(heard),
      system_(network),
      parts_(heard.is_all() ? nullptr
                            : std::make_unique<Parts>(network, heard)),
      searched_(
          parts_ == nullptr
              ? SearchedNetwork(system_, told_of(tree, network, heard, false),
                                told_of(tree, network, heard, true), reduction)
              : SearchedNetwork(
                    system_, parts_->composition,
                    told_of(tree, parts_->composition.network(), heard, false),
                    told_of(tree, parts_->composition.network(), heard, true))),
      store_(searched_.system().word_count()) {
  const Network& stands = searched_.system().network().network();
  event_of_edge_.resize(stands.edge_count());
  for (const Automaton& automaton : stands.automata) {
    if (automaton.kind != AutomatonKind::Node || !heard.hears(automaton.node)) {
      continue;
    }
    // Of inner nodes that they are asked says nothing.
    const Node& node = tree.node(automaton.node);
    const bool is_inner = !node.is_root() && !is_leaf(node.type);
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      const std::uint32_t edge = automaton.first_edge + e;
      const auto event = event_of(stands, edge);
      if (!event) continue;
      if (event->what() == Happening::Asked && is_inner) continue;
      event_of_edge_[edge] = event;
    }
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const auto phase =
        heard.hears(NodeId{n}) ? fault_phase(network, NodeId{n}) : std::nullopt;
    if (phase) faults_.push_back({NodeId{n}, *phase});
  }
  search(limits);
}

AnswerGraph::~AnswerGraph() = default;

void AnswerGraph::search(const Limits& limits) {
  const ReducedNetwork& system = searched_.system();
  system.initial_states([&](StateView state) {
    store_.insert(state);
    note(state);
    reached_by_.push_back(0);
  });
  std::uint32_t next = 0;
  try {
    for (; next < store_.size() && stopped_ == StopReason::None; ++next) {
      ask_budget();
      expand(next);
      if ((next + 1) % kPollInterval != 0) continue;
      measure(next + 1);
      stopped_ = limits.reached(progress_);
    }
  } catch (const BudgetSpent& spent) {
    stopped_ = stop_reason(spent.spent());
  }
  first_.resize(store_.size() + 1, static_cast<std::uint32_t>(arcs_.size()));
  measure(next);
  close();
}

void AnswerGraph::measure(std::uint32_t expanded) {
  progress_.states = store_.size();
  progress_.expanded = expanded;
  progress_.transitions = arcs_.size();
  progress_.bytes = store_.bytes() + arcs_.size() * sizeof(Arc) +
                    event_count_ * sizeof(NodeEvent);
}

void AnswerGraph::expand(std::uint32_t state) {
  const ReducedNetwork& system = searched_.system();
  StateVector words(system.word_count());
  store_.load(StateId{state}, words);
  first_.push_back(static_cast<std::uint32_t>(arcs_.size()));
  std::vector<NodeEvent> happened;
  visit(words, happened,
        [&](StateView target, Step step, std::size_t steps, bool begins) {
          const auto [id, is_new] = store_.insert(target);
          if (is_new) {
            note(target);
            reached_by_.push_back(static_cast<std::uint32_t>(arcs_.size()));
          }
          // An idle step is none.
          if (index(id) == state && happened.empty()) return;
          Arc arc;
          arc.target = index(id);
          arc.events = sequence_of(happened) & kMostSequences;
          arc.is_progress = step.progress ? 1 : 0;
          arc.is_single = steps == 1 ? 1 : 0;
          arc.begins_with_event = begins ? 1 : 0;
          arcs_.push_back(arc);
        });
}

template <class Visit>
void AnswerGraph::visit(StateView state, std::vector<NodeEvent>& happened,
                        Visit found) const {
  const CompiledNetwork& network = searched_.system().network();
  std::size_t steps = 0;
  bool begins = false;
  searched_.system().successors(
      state,
      [&](StateView target, Step step) {
        found(target, step, steps, begins);
        happened.clear();
        steps = 0;
        begins = false;
      },
      [&](StateView before, Step step, StateView after) {
        ++steps;
        if (step.edge == kTimeStep) return;
        for (const auto& [leaf, phase] : faults_) {
          constexpr auto kNotYet = static_cast<int>(FaultPhase::NotYet);
          if (network.value(before, phase) == kNotYet &&
              network.value(after, phase) != kNotYet) {
            happened.emplace_back(leaf, Happening::Struck);
          }
        }
        if (const auto& event = event_of_edge_[step.edge]) {
          happened.push_back(*event);
        }
        if (steps == 1) begins = !happened.empty();
      });
}

void AnswerGraph::note(StateView state) {
  const CompiledNetwork& system = searched_.system().network();
  const Network& network = system.network();
  std::size_t ended = 0;
  std::size_t succeeded = 0;
  for (const NodeId root : tree_.roots) {
    const Automaton& automaton = network.automaton(root);
    const LocationRole role = automaton
                                  .locations[static_cast<std::size_t>(
                                      system.value(state, automaton.location))]
                                  .role;
    ended += is_end(role) ? 1 : 0;
    succeeded += role == LocationRole::Success ? 1 : 0;
  }
  Ending ending = Ending::None;
  if (network.fault && system.value(state, *network.fault) != 0) {
    ending = Ending::Exception;
  } else if (ended == tree_.roots.size()) {
    ending = succeeded == ended ? Ending::Success : Ending::Failure;
  }
  endings_.push_back(ending);
  struck_.push_back(std::ranges::all_of(faults_, [&](const Fault& fault) {
    return system.value(state, fault.phase) !=
           static_cast<int>(FaultPhase::NotYet);
  }));
}

std::uint32_t AnswerGraph::sequence_of(const std::vector<NodeEvent>& events) {
  const auto next = static_cast<std::uint32_t>(sequences_.size());
  const auto [known, is_new] = known_sequences_.emplace(events, next);
  if (is_new) {
    sequences_.push_back(&known->first);
    event_count_ += events.size();
  }
  return known->second;
}

// Which states can end: backwards from those that do.
void AnswerGraph::close() {
  std::vector<std::uint32_t> count(size() + 1, 0);
  for (const Arc& arc : arcs_) ++count[arc.target + 1];
  for (std::uint32_t s = 0; s < size(); ++s) count[s + 1] += count[s];
  std::vector<std::uint32_t> sources(arcs_.size());
  std::vector<std::uint32_t> next(count.begin(), count.end() - 1);
  for (std::uint32_t s = 0; s < size(); ++s) {
    for (const Arc& arc : arcs(s)) sources[next[arc.target]++] = s;
  }
  can_end_.resize(size());
  std::vector<std::uint32_t> open;
  for (std::uint32_t s = 0; s < size(); ++s) {
    if (endings_[s] == Ending::None) continue;
    can_end_[s] = true;
    open.push_back(s);
  }
  while (!open.empty()) {
    const std::uint32_t state = open.back();
    open.pop_back();
    for (std::uint32_t i = count[state]; i < count[state + 1]; ++i) {
      if (can_end_[sources[i]]) continue;
      can_end_[sources[i]] = true;
      open.push_back(sources[i]);
    }
  }
}

std::vector<NodeId> AnswerGraph::running(std::uint32_t state) const {
  const CompiledNetwork& system = searched_.system().network();
  StateVector words(system.word_count());
  store_.load(StateId{state}, words);
  std::vector<NodeId> found;
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    if (!is_leaf(tree_.nodes[n].type) || !heard_.hears(NodeId{n})) continue;
    const auto status = static_cast<NodeStatus>(
        system.value(words, system.network().node_status[n]));
    if (status == NodeStatus::Running) found.push_back(NodeId{n});
  }
  return found;
}

std::uint32_t AnswerGraph::source_of(std::uint32_t arc) const {
  const auto behind = std::ranges::upper_bound(first_, arc);
  return static_cast<std::uint32_t>(behind - first_.begin()) - 1;
}

std::vector<std::uint32_t> AnswerGraph::path_to(std::uint32_t state) const {
  std::vector<std::uint32_t> path;
  while (state != 0) {
    path.push_back(reached_by_[state]);
    state = source_of(path.back());
  }
  std::ranges::reverse(path);
  return path;
}

std::vector<Step> AnswerGraph::steps_along(std::span<const std::uint32_t> path,
                                           std::string& error) const {
  const ReducedNetwork& system = searched_.system();
  StateVector from(system.word_count());
  StateVector to(system.word_count());
  store_.load(StateId{0}, from);
  Lasso found{{{from, {}}}, {}, {}};
  for (const std::uint32_t number : path) {
    const Arc& taken = arcs_[number];
    store_.load(StateId{taken.target}, to);
    // Several may lead there that differ in what happens.
    std::optional<Step> step;
    std::vector<NodeEvent> happened;
    visit(from, happened, [&](StateView target, Step each, auto...) {
      if (step || !std::ranges::equal(target, to)) return;
      if (std::ranges::equal(happened, events(taken))) step = each;
    });
    found.prefix.push_back({to, step.value_or(Step{})});
    from.swap(to);
  }
  std::vector<Step> steps;
  const auto run = searched_.replayed(found, error);
  if (!run) return steps;
  for (const RunStep& each : run->steps) steps.push_back(each.step);
  return steps;
}

}  // namespace btcheck

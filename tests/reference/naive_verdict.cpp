// SPDX-License-Identifier: MIT
//
// What the written-out space of a network says of a property.
//
// Without an assumption, state properties by looking at every state and plain
// responses by late_response.hpp; all else as toy systems are checked, by
// tableau.hpp. The toy system has the states in reverse order, so that most
// steps lead to a smaller number: the fixpoints of fair_graph.hpp then need few
// rounds. Events of steps become labels of states by splitting each state into
// its steps. CTL is answered from the innermost quantifier outwards, each by a
// tableau over what is known by then. Fairness, the actions' too, is left to
// the tableau, all other assumptions are put in front of the formula.
#include "reference/naive_verdict.hpp"

#include <algorithm>
#include <map>

#include "model/tree/node_types.hpp"
#include "reference/late_response.hpp"
#include "reference/naive_timed.hpp"
#include "reference/tableau.hpp"
#include "reference/timed_definition.hpp"

namespace btcheck::reference {
namespace {

// Numbers of propositions besides a property's atoms.
constexpr std::uint32_t kFirstCondition = 32;  // requested, granted, …
constexpr std::uint32_t kDead = 60;

bool is_true(const FormulaPool& pool, FormulaId id, PropositionSet atoms) {
  const FormulaNode& node = pool[id];
  switch (node.kind) {
    case FormulaKind::True:
      return true;
    case FormulaKind::Atom:
      return (atoms >> node.atom & 1) != 0;
    case FormulaKind::Not:
      return !is_true(pool, node.left, atoms);
    case FormulaKind::And:
      return is_true(pool, node.left, atoms) &&
             is_true(pool, node.right, atoms);
    case FormulaKind::Or:
      return is_true(pool, node.left, atoms) ||
             is_true(pool, node.right, atoms);
    case FormulaKind::Implies:
      return !is_true(pool, node.left, atoms) ||
             is_true(pool, node.right, atoms);
    case FormulaKind::Equivalent:
      return is_true(pool, node.left, atoms) ==
             is_true(pool, node.right, atoms);
    default:
      return false;
  }
}

ToySystem toy_system(const Network& network, const NaiveSpace& space,
                     const std::vector<PropositionSet>& labels) {
  ToySystem toy;
  const std::size_t count = space.states.size();
  const bool has_time = network.ticks != TickSemantics::None;
  for (std::size_t i = count; i-- > 0;) {
    std::vector<ToySystem::ToyStep> steps;
    for (const NaiveSpace::Step& step : space.steps[i]) {
      const bool elapses = !step.edge && has_time;
      steps.push_back({static_cast<std::uint32_t>(count - 1 - step.target),
                       {step.edge.value_or(kTimeStep),
                        static_cast<std::uint8_t>(elapses), step.progress}});
    }
    toy.add(labels[i], std::move(steps));
  }
  toy.add_initial(static_cast<std::uint32_t>(count - 1));
  return toy;
}

// One state for each state and step from it, with the step's label as well.
// Time plays no part.
ToySystem split_system(const NaiveSpace& space,
                       const std::vector<std::vector<PropositionSet>>& labels) {
  std::vector<std::uint32_t> first(space.states.size() + 1, 0);
  for (std::size_t s = space.states.size(); s-- > 0;) {
    first[s] = first[s + 1] + static_cast<std::uint32_t>(space.steps[s].size());
  }
  ToySystem toy;
  for (std::size_t s = space.states.size(); s-- > 0;) {
    for (std::size_t k = 0; k < space.steps[s].size(); ++k) {
      const NaiveSpace::Step& taken = space.steps[s][k];
      std::vector<ToySystem::ToyStep> steps;
      for (std::uint32_t next = first[taken.target + 1];
           next < first[taken.target]; ++next) {
        steps.push_back(
            {next, {taken.edge.value_or(kTimeStep), 0, taken.progress}});
      }
      toy.add(labels[s][k], std::move(steps));
    }
  }
  for (std::uint32_t k = first[1]; k < first[0]; ++k) toy.add_initial(k);
  return toy;
}

// One property on one space.
class NaiveQuestion {
 public:
  NaiveQuestion(const BehaviorTree& tree, const Network& network,
                const NaiveSpace& space, const RandomProperty& property)
      : network_(network),
        space_(space),
        property_(property),
        pool_(property.pool) {
    is_sound_ = label_states(tree) && label_steps(tree);
    if (is_sound_) add_conditions(tree);
  }

  bool is_sound() const { return is_sound_; }

  bool holds() {
    if (property_.assumption.is_empty()) {
      if (const auto answer = plain_answer()) return *answer;
    }
    switch (property_.form) {
      case PropertyForm::Never:
        return !some_run(eventually(property_.formula));
      case PropertyForm::Invariant:
        return !some_run(eventually(negation(property_.formula)));
      case PropertyForm::Possible:
        return some_run(eventually(property_.formula));
      case PropertyForm::DeadlockFree:
        return !some_run(eventually(pool_.atom(kDead)));
      case PropertyForm::Timed:
        return !some_run_misses();
      case PropertyForm::Branching:
        return starts_satisfy_branching();
      default:
        return !some_run(negation(property_.formula));
    }
  }

  bool has_assumed_run() { return some_run(pool_.constant(true)); }

  TimedPattern pattern() const {
    TimedPattern pattern;
    const TimedClaim& claim = property_.timed;
    pattern.trigger = claim.trigger ? kTrigger : 0;
    pattern.answer = kAnswer;
    pattern.opening = claim.opening ? kOpening : 0;
    pattern.closing = claim.closing ? kClosing : 0;
    pattern.demand = claim.demand;
    pattern.from = claim.from;
    pattern.to = claim.to;
    pattern.must_open = claim.must_open;
    return pattern;
  }
  // The label of a state with the roles of a timed pattern.
  PropositionSet with_roles(std::size_t state) const {
    const TimedClaim& claim = property_.timed;
    PropositionSet label = labels_[state];
    const auto add = [&](std::optional<FormulaId> of, PropositionSet role) {
      if (of && is_true(property_.pool, *of, labels_[state])) label |= role;
    };
    add(claim.trigger, kTrigger);
    add(claim.answer, kAnswer);
    add(claim.opening, kOpening);
    add(claim.closing, kClosing);
    return label;
  }

 private:
  static constexpr PropositionSet kTrigger = PropositionSet{1} << 56;
  static constexpr PropositionSet kAnswer = PropositionSet{1} << 57;
  static constexpr PropositionSet kOpening = PropositionSet{1} << 58;
  static constexpr PropositionSet kClosing = PropositionSet{1} << 59;

  bool label_states(const BehaviorTree& tree) {
    labels_.assign(space_.states.size(), 0);
    for (std::size_t a = 0; a < property_.atoms.size(); ++a) {
      if (!property_.atoms[a].test) continue;
      const auto test = property_.atoms[a].test(tree, network_);
      if (!test) return false;
      for (std::size_t s = 0; s < labels_.size(); ++s) {
        labels_[s] |= PropositionSet{(*test)(space_, s)} << a;
      }
    }
    for (std::size_t s = 0; s < labels_.size(); ++s) {
      labels_[s] |= PropositionSet{space_.dead[s]} << kDead;
    }
    return true;
  }

  bool label_steps(const BehaviorTree& tree) {
    for (std::size_t a = 0; a < property_.atoms.size(); ++a) {
      if (!property_.atoms[a].step_test) continue;
      const auto test = property_.atoms[a].step_test(tree, network_);
      if (!test) return false;
      step_tests_.push_back({a, *test});
    }
    return true;
  }

  void add_conditions(const BehaviorTree& tree) {
    const RandomAssumption& assumption = property_.assumption;
    for (const auto& pair : assumption.fairness) {
      const auto is_so = [this](FormulaId of) {
        return [this, of](std::size_t s) {
          return is_true(property_.pool, of, labels_[s]);
        };
      };
      add_condition(is_so(pair.first), is_so(pair.second));
    }
    if (!assumption.actions_end) return;
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      if (tree.nodes[n].type != NodeType::Action) continue;
      const auto at = [&](std::string_view word) {
        return [this, test = node_event(network_, NodeId{n}, word)](
                   std::size_t s) { return test(space_, s); };
      };
      const auto succeeds = at("success");
      const auto fails = at("failure");
      const auto is_halted = at("halted");
      add_condition(at("tick_node"), [&](std::size_t s) {
        return succeeds(s) || fails(s) || is_halted(s);
      });
    }
  }

  template <class Requested, class Granted>
  void add_condition(Requested&& requested, Granted&& granted) {
    const auto first =
        static_cast<std::uint32_t>(kFirstCondition + 2 * conditions_.size());
    conditions_.push_back({first, first + 1});
    for (std::size_t s = 0; s < labels_.size(); ++s) {
      labels_[s] |= PropositionSet{requested(s)} << first;
      labels_[s] |= PropositionSet{granted(s)} << (first + 1);
    }
  }

  // By looking at states, where that is enough.
  std::optional<bool> plain_answer() const {
    const auto some_state_is = [&](bool value) {
      return std::ranges::any_of(labels_, [&](PropositionSet label) {
        return is_true(property_.pool, property_.formula, label) == value;
      });
    };
    switch (property_.form) {
      case PropertyForm::Never:
        return !some_state_is(true);
      case PropertyForm::Invariant:
        return !some_state_is(false);
      case PropertyForm::Possible:
        return some_state_is(true);
      case PropertyForm::DeadlockFree:
        return std::ranges::count(space_.dead, true) == 0;
      default:
        break;
    }
    if (property_.kind != PropertyKind::Response) return std::nullopt;
    return !late_response(timed_system(), pattern()).exists;
  }

  ToySystem timed_system() const {
    std::vector<PropositionSet> labels;
    for (std::size_t s = 0; s < labels_.size(); ++s) {
      labels.push_back(with_roles(s));
    }
    return toy_system(network_, space_, labels);
  }

  ToySystem system() const {
    if (step_tests_.empty()) return toy_system(network_, space_, labels_);
    std::vector<std::vector<PropositionSet>> labels;
    for (std::size_t s = 0; s < labels_.size(); ++s) {
      labels.emplace_back();
      for (const NaiveSpace::Step& step : space_.steps[s]) {
        labels.back().push_back(labels_[s]);
        for (const auto& [atom, test] : step_tests_) {
          labels.back().back() |= PropositionSet{test(space_, s, step)} << atom;
        }
      }
    }
    return split_system(space_, labels);
  }

  // Whether an assumed run satisfies the formula.
  bool some_run(FormulaId formula) { return some_run_of(system(), formula); }
  bool some_run_of(const ToySystem& system, FormulaId formula) {
    if (property_.assumption.formula) {
      formula = pool_.binary(FormulaKind::And, *property_.assumption.formula,
                             formula);
    }
    const std::vector<bool> found =
        states_satisfying(system, pool_, formula, conditions_);
    return std::ranges::any_of(
        system.initial(), [&](std::uint32_t state) { return found[state]; });
  }

  bool some_run_misses() {
    const FormulaId for_ever =
        pool_.unary(FormulaKind::Always, pool_.atom(kDue));
    return some_run_of(with_occurrence(timed_system(), pattern()),
                       eventually(for_ever));
  }

  // CTL over the runs that satisfy the conditions.
  bool starts_satisfy_branching() const {
    const FormulaPool& pool = property_.pool;
    const ToySystem toy = system();
    std::map<FormulaId, std::vector<bool>> known;
    for (const FormulaId id : pool.nodes(property_.formula)) {
      const FormulaNode& node = pool[id];
      if (is_path_operator(node.kind)) continue;
      std::vector<bool>& here = known[id];
      if (is_path_quantifier(node.kind)) {
        here = quantified(toy, node, known);
        continue;
      }
      for (std::size_t s = 0; s < toy.size(); ++s) {
        here.push_back(connected(node, toy.label_of(s), s, known));
      }
    }
    return known[property_.formula][toy.initial()[0]];
  }

  using Known = std::map<FormulaId, std::vector<bool>>;

  static bool connected(const FormulaNode& node, PropositionSet label,
                        std::size_t state, Known& known) {
    if (is_leaf(node.kind)) {
      return node.kind == FormulaKind::Atom ? (label >> node.atom & 1) != 0
                                            : node.kind == FormulaKind::True;
    }
    const bool left = known.at(node.left)[state];
    if (node.kind == FormulaKind::Not) return !left;
    const bool right = known.at(node.right)[state];
    if (node.kind == FormulaKind::And) return left && right;
    if (node.kind == FormulaKind::Or) return left || right;
    if (node.kind == FormulaKind::Implies) return !left || right;
    return left == right;
  }

  // E or A over one operator, whose operands are known.
  std::vector<bool> quantified(const ToySystem& toy, const FormulaNode& node,
                               const Known& known) const {
    const FormulaNode& path = property_.pool[node.left];
    const FormulaId right = is_unary(path.kind) ? path.left : path.right;
    constexpr PropositionSet kBoth = 3;
    ToySystem relabelled;
    for (std::size_t s = 0; s < toy.size(); ++s) {
      const PropositionSet operands = PropositionSet{known.at(path.left)[s]} |
                                      PropositionSet{known.at(right)[s]} << 1;
      relabelled.add((toy.label_of(s) & ~kBoth) | operands, toy.steps(s));
    }
    FormulaPool pool;
    FormulaId formula =
        is_unary(path.kind)
            ? pool.unary(path.kind, pool.atom(0))
            : pool.binary(path.kind, pool.atom(0), pool.atom(1));
    const bool exists = node.kind == FormulaKind::ExistsPath;
    if (!exists) formula = pool.unary(FormulaKind::Not, formula);
    std::vector<bool> found =
        states_satisfying(relabelled, pool, formula, conditions_);
    if (!exists) found.flip();
    return found;
  }

  FormulaId eventually(FormulaId of) {
    return pool_.unary(FormulaKind::Eventually, of);
  }
  FormulaId negation(FormulaId of) { return pool_.unary(FormulaKind::Not, of); }

  const Network& network_;
  const NaiveSpace& space_;
  const RandomProperty& property_;
  FormulaPool pool_;  // the property's, and what is asked of it
  std::vector<PropositionSet> labels_;                        // by state
  std::vector<std::pair<std::size_t, StepTest>> step_tests_;  // by atom
  std::vector<Condition> conditions_;
  bool is_sound_ = false;
};

}  // namespace

std::optional<NaiveAnswer> naive_verdict(const BehaviorTree& tree,
                                         const Network& network,
                                         const NaiveSpace& space,
                                         const RandomProperty& property) {
  NaiveQuestion question(tree, network, space, property);
  if (!question.is_sound()) return std::nullopt;
  NaiveAnswer answer;
  answer.holds = question.holds();
  if (!property.assumption.is_empty()) {
    answer.has_run = question.has_assumed_run();
  }
  return answer;
}

std::string timed_evidence_flaw(const BehaviorTree& tree,
                                const Network& network, const NaiveSpace& space,
                                const RandomProperty& property, const Run& run,
                                std::size_t occurrence) {
  const NaiveQuestion question(tree, network, space, property);
  const TimedPattern pattern = question.pattern();
  std::map<NaiveState, std::size_t> numbers;
  for (std::size_t s = 0; s < space.states.size(); ++s) {
    numbers.emplace(space.states[s], s);
  }
  TimedRun timed;
  for (std::size_t i = 0; i < run.state_count(); ++i) {
    const auto found =
        numbers.find({run.state(i).variables, run.state(i).clocks});
    if (found == numbers.end()) return "a state of the run is not reachable";
    timed.labels.push_back(question.with_roles(found->second));
    if (i < run.steps.size()) {
      timed.elapsed.push_back(run.steps[i].step.elapsed);
    }
  }
  if (run.loop == kNoLoop) {
    return is_lost_at(pattern, timed, occurrence) ? ""
                                                  : "the run is no violation";
  }
  timed.loop = run.loop;
  timed.labels.pop_back();
  if (satisfies(pattern, timed)) return "the run satisfies the pattern";
  const bool is_last = occurrence + 1 == run.state_count();
  if (pattern.must_open && is_last) return {};  // it never opens
  return is_violated_at(pattern, timed, occurrence) ? "" : "another occurrence";
}

}  // namespace btcheck::reference

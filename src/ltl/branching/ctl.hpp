// SPDX-License-Identifier: MIT
//
// Branching time: where fair runs come to rest in a stored graph, under
// built-in justice and strong fairness (fair_components.cpp); which of its
// states satisfy a formula of CTL; and a path that shows why one does, or does
// not (ctl_path.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "explore/search/stored_graph.hpp"
#include "ltl/formula/formula.hpp"

namespace btcheck {

// The steps of a stored graph, backwards: by state, where its steps come from.
class Predecessors {
 public:
  explicit Predecessors(const StoredGraph& graph);

  std::span<const std::uint32_t> of(std::size_t state) const {
    return {sources_.data() + first_[state],
            sources_.data() + first_[state + 1]};
  }

  // The states with a step into `target`.
  StateSet before(const StateSet& target) const;

  // The states from which a path leads into `target` all of whose states but
  // the last are in `hold`; those of `target` among them.
  StateSet leading_to(const StateSet& hold, const StateSet& target) const;

 private:
  std::vector<std::uint64_t> first_;  // by state: its first source
  std::vector<std::uint32_t> sources_;
};

// A strong fairness condition on one graph, as sets of its states: requested
// infinitely often, therefore granted infinitely often.
struct FairnessSets {
  StateSet requested;
  StateSet granted;
};

// A run is fair when it makes progress infinitely often (built-in justice: no
// condition where every step is progress) and keeps every strong condition.
//
// The states of `within` that lie in a strongly connected part of it which a
// fair run can go round in for ever, seeing every state of it. Different parts
// are different components of the states returned. After Lichtenstein and
// Pnueli (POPL 1985): each round takes time linear in the graph, and there are
// at most `conditions.size() + 1` rounds.
StateSet fair_components(const StoredGraph& graph, const StateSet& within,
                         std::span<const FairnessSets> conditions);

// A cycle through `state`, one of a set that fair_components has returned, by
// whose repetition a run is fair: `state` first, the last one leads back to
// it. Not the shortest, but each leg of it is.
std::vector<StateId> fair_cycle(const StoredGraph& graph,
                                const StateSet& fair_components, StateId state,
                                std::span<const FairnessSets> conditions);

// The fair runs of one graph, which must be closed and outlive it. To make it
// takes as long as an operator AF does, so properties of one graph share it.
class FairRuns {
 public:
  explicit FairRuns(const StoredGraph& graph,
                    std::vector<FairnessSets> conditions = {})
      : graph_(graph),
        conditions_(std::move(conditions)),
        predecessors_(graph),
        fair_(starts_within(~StateSet(graph.size()))) {}

  const StoredGraph& graph() const { return graph_; }
  std::span<const FairnessSets> conditions() const { return conditions_; }
  const Predecessors& predecessors() const { return predecessors_; }

  // The states where a fair run begins.
  const StateSet& starts() const { return fair_; }
  // The states where a run begins that is fair and never leaves `hold`.
  StateSet starts_within(const StateSet& hold) const {
    return predecessors_.leading_to(hold,
                                    fair_components(graph_, hold, conditions_));
  }

 private:
  const StoredGraph& graph_;
  std::vector<FairnessSets> conditions_;
  Predecessors predecessors_;
  StateSet fair_;
};

// That a formula holds in some state, or that it does not.
struct Claim {
  FormulaId formula{};
  bool holds = true;

  friend bool operator==(const Claim&, const Claim&) = default;
};

// What a run has to be like so that it shows E… holding or A… failing. Each
// list of claims is a conjunction; an empty one is true.
struct RunPlan {
  enum class Shape : unsigned char {
    Next,          // `target` in the second state
    Until,         // `hold` up to a state with `target`
    Always,        // `hold` for ever
    UntilOrAlways  // one of the two
  };

  Shape shape = Shape::Next;
  std::vector<Claim> hold;
  std::vector<Claim> target;
};

// The plan of a quantified formula of CTL: for E ψ a run with ψ, for A ψ one
// without.
RunPlan plan_of(const FormulaPool& formulas, FormulaId quantified);

// Decides CTL over fair runs on one graph. Quantifiers range over fair runs
// only: a state where none begins satisfies every A… and no E….
class CtlChecker {
 public:
  // `propositions` has a set of states for each atom number that occurs. The
  // pool, which may grow meanwhile, and the graph must outlive the checker.
  CtlChecker(std::shared_ptr<const FairRuns> runs, const FormulaPool& formulas,
             std::vector<StateSet> propositions)
      : runs_(std::move(runs)),
        formulas_(formulas),
        propositions_(std::move(propositions)) {}

  // The states where a formula of CTL holds: linear time for each operator.
  // The set is kept, and stays where it is as long as the checker.
  const StateSet& satisfying(FormulaId formula);
  bool is_true(Claim claim, StateId state) {
    return satisfying(claim.formula)[index(state)] == claim.holds;
  }

  // The states where all claims are true, each about a part of a formula that
  // `satisfying` was asked for.
  StateSet where(std::span<const Claim> claims) const;

  const FairRuns& runs() const { return *runs_; }
  const FormulaPool& formulas() const { return formulas_; }

 private:
  const StateSet& found(FormulaId formula) const {
    const FormulaNode& node = formulas_[formula];
    return node.kind == FormulaKind::Atom ? propositions_.at(node.atom)
                                          : satisfying_.at(formula);
  }
  StateSet evaluate(FormulaId formula) const;
  // The states where a fair run of the plan begins.
  StateSet starts_of(const RunPlan& plan) const;

  std::size_t size() const { return runs_->graph().size(); }

  std::shared_ptr<const FairRuns> runs_;
  const FormulaPool& formulas_;
  std::vector<StateSet> propositions_;
  std::map<FormulaId, StateSet> satisfying_;
};

// A claim about states first to last, by position, of a path, which one path
// cannot show: that something holds on all runs from a state (`AG EF p` fails
// where EF p does), or one claim too many.
struct Unshown {
  Claim claim;
  std::size_t first = 0;
  std::size_t last = 0;
};

// A path in a stored graph, by state numbers. A finite one may be gone on with
// by any fair run; the others end with a cycle that is itself fair, if between
// two states a step of progress is taken where there is one.
struct GraphPath {
  static constexpr std::size_t kFinite = static_cast<std::size_t>(-1);

  std::vector<StateId> states;  // not empty
  // Where the last state leads back to, kFinite: nowhere.
  std::size_t loop = kFinite;
  // What the path leaves to be believed; empty: it is a proof.
  std::vector<Unshown> unshown;

  bool is_complete() const { return unshown.empty(); }
};

// A path from `state` that shows that the claim is true there. Nothing where
// that is not so, or where no path could show any of it: EF p failing, AG p
// holding. Prefixes are shortest for the operator they belong to; cycles are
// short, not shortest.
std::optional<GraphPath> demonstrate(CtlChecker& checker, Claim claim,
                                     StateId state);

}  // namespace btcheck

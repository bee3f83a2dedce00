// SPDX-License-Identifier: MIT
//
// One breadth-first search keeps every step and the truth of every condition;
// the rest is set arithmetic (ltl/branching/ctl.hpp). Quantifiers range over
// runs that make progress for ever and satisfy the strong fairness assumed.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "check/search/searched_network.hpp"
#include "check/search/searches.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/search/reachability.hpp"
#include "explore/search/stored_graph.hpp"
#include "ltl/branching/ctl.hpp"

namespace btcheck {
namespace {

// Keeps the graph, and for each predicate the states where it is true.
struct GraphKeeper : public ReachabilityVisitor {
  GraphKeeper(const ReducedNetwork& system,
              const std::vector<StatePredicate>& predicates)
      : labels(system, predicates), sets(predicates.size()) {}

  void stepped(StateId from, Step step, StateId to) {
    graph.add(from, step, to);
  }
  GoOn expanded(StateId, StateView state, bool is_dead) {
    for (std::size_t i = 0; i < sets.size(); ++i) {
      sets[i].push_back(labels.holds(i, state, is_dead));
    }
    return GoOn::Yes;
  }
  std::size_t bytes() const {
    std::size_t bytes = graph.bytes();
    for (const StateSet& set : sets) bytes += set.size() / 8;
    return bytes;
  }

  LabelledNetwork labels;
  StoredGraph graph;
  std::vector<StateSet> sets;
};

class BranchingQuestions {
 public:
  BranchingQuestions(const SearchedNetwork& searched, const FileSearch& all)
      : searched_(searched),
        file_(all.file),
        search_(searched.system(), all.limits),
        verdicts_(all.verdicts) {
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      if (file_.properties[i].form == PropertyForm::Branching) {
        asked_.push_back(i);
      }
    }
  }

  void answer() {
    GraphKeeper keeper(searched_.system(), predicates());
    const ReachabilityResult result = search_.run(keeper);
    for (const std::size_t i : asked_) {
      verdicts_[i].progress = result.progress;
      verdicts_[i].stopped = result.stopped;
    }
    if (!result.is_complete) return;
    keeper.graph.close(search_.store().size());
    auto next = std::make_move_iterator(keeper.sets.begin());
    std::vector<std::vector<StateSet>> propositions;
    for (const std::size_t i : asked_) {
      const auto first = next;
      next += std::ssize(formula(i).propositions);
      propositions.emplace_back(first, next);
    }
    std::vector<FairnessSets> fairness;
    for (std::size_t c = 0; c < file_.assumptions.strong.size(); ++c) {
      StateSet requested = *next++;
      fairness.push_back({std::move(requested), *next++});
    }
    const auto runs =
        std::make_shared<const FairRuns>(keeper.graph, std::move(fairness));
    for (std::size_t k = 0; k < asked_.size(); ++k) {
      judge(asked_[k],
            {runs, formula(asked_[k]).pool, std::move(propositions[k])});
    }
  }

 private:
  const BoundFormula& formula(std::size_t property) const {
    return file_.properties[property].formula;
  }

  // Those of each property in turn, then what is requested and granted.
  std::vector<StatePredicate> predicates() const {
    std::vector<StatePredicate> all;
    for (const std::size_t i : asked_) {
      for (const Proposition& proposition : formula(i).propositions) {
        all.push_back(proposition.of);
      }
    }
    const auto more = predicates_of(file_.assumptions.strong);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  void judge(std::size_t property, CtlChecker checker) {
    PropertyVerdict& verdict = verdicts_[property];
    const FormulaId claim = formula(property).formula;
    const StateId start{0};
    const bool holds = checker.satisfying(claim)[index(start)];
    verdict.verdict = holds ? Verdict::Holds : Verdict::Violated;
    const auto path = demonstrate(checker, {claim, holds}, start);
    if (!path) return;
    verdict.run = searched_.replayed(told(*path), verdict.error);
    if (!path->is_complete()) {
      verdict.unshown = claim_text(property, path->unshown.back().claim);
    }
  }

  std::string claim_text(std::size_t property, const Claim& claim) const {
    const BoundFormula& bound = formula(property);
    const std::vector<PropositionOrigin>& origins =
        file_.properties[property].origins;
    const FormulaNode& node = bound.pool[claim.formula];
    const auto words = [&](FormulaId id) {
      return bound.pool.text(id,
                             [&](std::uint32_t i) { return origins[i].text; });
    };
    if (!claim.holds && node.kind == FormulaKind::ExistsPath &&
        bound.pool[node.left].kind == FormulaKind::Eventually) {
      return "from here no run ever reaches " +
             words(bound.pool[node.left].left);
    }
    return fmt::format("from here {}: {}",
                       claim.holds ? "this holds" : "this does not hold",
                       words(claim.formula));
  }

  Lasso told(const GraphPath& path) const {
    if (path.loop == GraphPath::kFinite) {
      return {search_.run_along(path.states), {}, {}};
    }
    // Once around, from the state the loop begins with back to it.
    std::vector<StateId> states = path.states;
    states.push_back(path.states[path.loop]);
    const std::vector<RunState> run = search_.run_along(states);
    const auto around =
        run.begin() + static_cast<std::ptrdiff_t>(path.loop + 1);
    Lasso lasso{{run.begin(), around}, {around, run.end()}, {}};
    lasso.closing = lasso.cycle.front().step;
    return lasso;
  }

  const SearchedNetwork& searched_;
  const BoundFile& file_;
  BreadthFirst<ReducedNetwork> search_;
  std::vector<PropertyVerdict>& verdicts_;
  std::vector<std::size_t> asked_;
};

}  // namespace

// Forgetting dead values leaves a bisimilar system; ample sets, where a chooser
// and a mover are interleaved, would not.
void verify_branching(const FileSearch& all) {
  const auto is_branching = [](const BoundProperty& bound) {
    return bound.form == PropertyForm::Branching;
  };
  if (std::ranges::none_of(all.file.properties, is_branching)) return;
  Observed observed = observed_by(all.system.network(),
                                  predicates_of(all.file.assumptions.strong));
  for (const BoundProperty& bound : all.file.properties) {
    if (is_branching(bound)) observed.add(bound.formula.propositions);
  }
  const SearchedNetwork searched(all.system, observed,
                                 std::min(all.reduction, Reduction::Live));
  BranchingQuestions(searched, all).answer();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Properties evaluated on one run by their definition, with the interpreter
// of the network's tables: nothing here is shared with a search.
#include "check/replay/evidence.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "check/replay/replay.hpp"
#include "ltl/formula/lasso_evaluation.hpp"
#include "ltl/formula/normal_form.hpp"

namespace btcheck {
namespace {

bool makes_progress(const Run& run) {
  return std::ranges::any_of(
      run.loop_steps(), [](const RunStep& step) { return step.step.progress; });
}

// A proposition at a state of the run; one of steps is about run.steps[at].
bool is_true(const NetworkInterpreter& interpreter, const Network& network,
             const Proposition& proposition, const Run& run, std::size_t at) {
  const auto now = [&] {
    return interpreter.is_true(proposition.of, run.state(at));
  };
  if (proposition.kind == PropositionKind::State) return now();
  const auto next = [&] {
    return interpreter.is_true(proposition.of, run.state(at + 1));
  };
  if (proposition.kind == PropositionKind::Enter) return !now() && next();
  if (proposition.kind == PropositionKind::Leave) return now() && !next();
  const std::uint32_t edge = run.steps[at].step.edge;
  if (proposition.kind == PropositionKind::Passes) return edge == kTimeStep;
  if (edge == kTimeStep) return false;
  const Automaton* owner = &network.owner_of_edge(edge);
  return std::ranges::any_of(proposition.movers, [&](AutomatonId mover) {
    return &network.automaton(mover) == owner;
  });
}

bool is_of_steps(const Proposition& proposition) {
  return proposition.kind != PropositionKind::State;
}

// The labels of the first `count` states of a run.
std::vector<PropositionSet> labels_of(const Network& network, const Run& run,
                                      const BoundFormula& formula,
                                      std::size_t count) {
  const NetworkInterpreter interpreter(network);
  std::vector<PropositionSet> labels(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t p = 0; p < formula.propositions.size(); ++p) {
      if (is_true(interpreter, network, formula.propositions[p], run, i)) {
        labels[i] |= PropositionSet{1} << p;
      }
    }
  }
  return labels;
}

// What comes after the last state is open; with events of steps, also what is
// true there.
bool is_bad_prefix(const Network& network, const Run& run,
                   const BoundFormula& formula) {
  const std::vector<Proposition>& propositions = formula.propositions;
  const bool has_steps = std::ranges::any_of(propositions, is_of_steps);
  std::vector<PropositionSet> labels =
      labels_of(network, run, formula, run.state_count() - (has_steps ? 1 : 0));
  const std::size_t known = labels.size();
  labels.push_back(0);
  const std::size_t all = std::size_t{1}
                          << std::min<std::size_t>(propositions.size(), 6);
  for (std::size_t after = 0; after < std::min(all, kMostTriedAfter); ++after) {
    labels.back() = after;
    if (holds_on_lasso(formula.pool, formula.formula, labels, known)) {
      return false;
    }
  }
  return true;
}

// The claim with an atom of its own for each literal: atom i is i, its negation
// i + count. What makes more atoms true makes no such formula false.
FormulaId with_literals(FormulaPool& pool, FormulaId claim,
                        std::uint32_t count) {
  const FormulaId normal = negation_normal_form(pool, claim);
  std::map<FormulaId, FormulaId> images;
  for (const FormulaId part : pool.nodes(normal)) {
    const FormulaNode node = pool[part];
    if (is_leaf(node.kind)) {
      images[part] = part;
    } else if (node.kind == FormulaKind::Not) {
      images[part] = pool.atom(pool[node.left].atom + count);
    } else {
      const FormulaId left = images.at(node.left);
      images[part] = is_unary(node.kind)
                         ? pool.unary(node.kind, left)
                         : pool.binary(node.kind, left, images.at(node.right));
    }
  }
  return images.at(normal);
}

// A word of labels of atoms and their negations, as with_literals has them:
// behind what is known all that is wanted is so, and all that is wanted not to
// be so is not.
RunWord best_word(const BoundFormula& formula, FormulaId claim,
                  std::vector<PropositionSet> labels) {
  const std::size_t count = formula.propositions.size();
  RunWord word{formula.pool, {}, std::move(labels), 0};
  word.formula =
      with_literals(word.pool, claim, static_cast<std::uint32_t>(count));
  const PropositionSet every = (PropositionSet{1} << count) - 1;
  for (PropositionSet& label : word.labels) label |= (~label & every) << count;
  word.loop = word.labels.size();
  word.labels.push_back(every | every << count);
  return word;
}

// The least number up to `most` of which `is_so`, which stays so.
template <class IsSo>
std::optional<std::size_t> first_of(std::size_t most, IsSo&& is_so) {
  if (!is_so(most)) return std::nullopt;
  std::size_t low = 0;
  while (low < most) {
    const std::size_t middle = low + (most - low) / 2;
    if (is_so(middle)) {
      most = middle;
    } else {
      low = middle + 1;
    }
  }
  return most;
}

// One occurrence of a real-time pattern on one run.
class Occurrence {
 public:
  Occurrence(const Network& network, const Run& run,
             const BoundPattern& pattern)
      : interpreter_(network), run_(run), bound_(pattern) {}

  std::optional<std::size_t> first_violated() const {
    const TimedPattern& pattern = bound_.pattern;
    const std::size_t last = run_.state_count() - 1;
    std::size_t open = 0;
    if (pattern.opening != 0) {
      while (open <= last && !has(pattern.opening, open)) ++open;
    }
    if (open > last) {
      return pattern.must_open && makes_progress(run_) ? std::optional(last)
                                                       : std::nullopt;
    }
    for (std::size_t at = open; at <= last; ++at) {
      if (pattern.closing != 0 && has(pattern.closing, at)) break;
      const bool occurs = pattern.trigger == 0 || has(pattern.trigger, at);
      if (occurs && is_violated_from(at)) return at;
      if (pattern.trigger == 0) break;
    }
    return std::nullopt;
  }

 private:
  bool has(PropositionSet bit, std::size_t at) const {
    for (std::size_t i = 0; i < bound_.predicates.size(); ++i) {
      if (bit >> i & 1) {
        return interpreter_.is_true(bound_.predicates[i], run_.state(at));
      }
    }
    return false;
  }

  bool is_violated_from(std::size_t begin) const {
    const bool wants_answer = bound_.pattern.demand == Demand::Answer ||
                              bound_.pattern.demand == Demand::FirstAnswer;
    return wants_answer ? is_unanswered(begin) : is_broken(begin);
  }

  // A state that must not be, at an age at which it must not be.
  bool is_broken(std::size_t begin) const {
    const TimedPattern& pattern = bound_.pattern;
    int age = 0;
    for (std::size_t at = begin; at < run_.state_count(); ++at) {
      if (at > begin) age += run_.steps[at - 1].step.elapsed;
      if (age > pattern.to) return false;
      const bool has_answer = has(pattern.answer, at);
      const bool is_wrong = pattern.demand == Demand::Lasting
                                ? !has_answer
                                : has_answer && age >= pattern.from;
      if (is_wrong) return true;
    }
    return false;
  }

  bool is_unanswered(std::size_t begin) const {
    const TimedPattern& pattern = bound_.pattern;
    int age = 0;
    bool is_lost = false;  // no later answer counts
    for (std::size_t at = begin; at < run_.state_count(); ++at) {
      if (at > begin) age += run_.steps[at - 1].step.elapsed;
      if (pattern.closing != 0 && has(pattern.closing, at)) return true;
      is_lost |= age > pattern.to;
      if (!is_lost && has(pattern.answer, at)) {
        if (age >= pattern.from) return false;
        is_lost |= pattern.demand == Demand::FirstAnswer;
      }
      if (is_lost && pattern.closing == 0) return true;
    }
    // The scope never closes, or the answer is due for ever.
    return pattern.closing == 0 && stays_due(begin);
  }

  bool stays_due(std::size_t begin) const {
    if (begin > run_.loop || !makes_progress(run_)) return false;
    if (bound_.pattern.to != kNoEnd) return !takes_time();
    // Time passes or not: an answer on the loop would count some time.
    for (std::size_t at = run_.loop; at < run_.state_count(); ++at) {
      if (takes_time() && has(bound_.pattern.answer, at)) return false;
    }
    return true;
  }

  bool takes_time() const {
    return std::ranges::any_of(run_.loop_steps(), [](const RunStep& step) {
      return step.step.elapsed != 0;
    });
  }

  NetworkInterpreter interpreter_;
  const Run& run_;
  const BoundPattern& bound_;
};

}  // namespace

Run up_to(const Run& run, std::size_t state) {
  return {run.initial,
          {run.steps.begin(),
           run.steps.begin() + static_cast<std::ptrdiff_t>(state)},
          kNoLoop};
}

bool ends_with(const Network& network, const Run& run,
               const StatePredicate& predicate) {
  return NetworkInterpreter(network).is_true(predicate,
                                             run.state(run.steps.size()));
}

std::optional<std::size_t> first_state(const Network& network, const Run& run,
                                       const StatePredicate& predicate) {
  const NetworkInterpreter interpreter(network);
  for (std::size_t i = 0; i < run.state_count(); ++i) {
    if (interpreter.is_true(predicate, run.state(i))) return i;
  }
  return std::nullopt;
}

bool violates(const Network& network, const Run& run,
              const BoundFormula& formula) {
  if (run.loop == kNoLoop) return is_bad_prefix(network, run, formula);
  if (!makes_progress(run)) return false;
  // The last state of the run is the loop's first again.
  const std::vector<PropositionSet> labels =
      labels_of(network, run, formula, run.state_count() - 1);
  return !holds_on_lasso(formula.pool, formula.formula, labels, run.loop);
}

std::optional<RunWord> word_of(const Network& network, const Run& run,
                               const BoundFormula& formula) {
  if (run.loop != kNoLoop) {
    return RunWord{formula.pool, formula.formula,
                   labels_of(network, run, formula, run.state_count() - 1),
                   run.loop};
  }
  if (2 * formula.propositions.size() > kMaxPropositions) return std::nullopt;
  const bool has_steps = std::ranges::any_of(formula.propositions, is_of_steps);
  RunWord word = best_word(formula, formula.formula,
                           labels_of(network, run, formula,
                                     run.state_count() - (has_steps ? 1 : 0)));
  if (holds_on_lasso(word.pool, word.formula, word.labels, word.loop)) {
    return std::nullopt;
  }
  return word;
}

// What comes behind the labels that are read is the best there could be.
std::optional<std::size_t> broken_at(const Network& network, const Run& run,
                                     const BoundFormula& formula,
                                     FormulaId claim) {
  const std::size_t count = formula.propositions.size();
  if (2 * count > kMaxPropositions) return std::nullopt;
  const RunWord all = best_word(
      formula, claim, labels_of(network, run, formula, run.steps.size()));
  const bool has_steps = std::ranges::any_of(formula.propositions, is_of_steps);
  const auto read = first_of(all.loop, [&](std::size_t known) {
    std::vector<PropositionSet> labels(
        all.labels.begin(),
        all.labels.begin() + static_cast<std::ptrdiff_t>(known));
    labels.push_back(all.labels.back());
    return !holds_on_lasso(all.pool, all.formula, labels, known);
  });
  if (!read) return std::nullopt;
  return has_steps || *read == 0 ? *read : *read - 1;
}

std::optional<std::size_t> broken_at(const Network& network, const Run& run,
                                     const BoundPattern& pattern) {
  return first_of(run.steps.size(), [&](std::size_t state) {
    return violated_occurrence(network, up_to(run, state), pattern).has_value();
  });
}

bool is_fair(const Network& network, const Run& run,
             const std::vector<FairnessPair>& conditions) {
  if (conditions.empty()) return true;
  if (run.loop == kNoLoop) return false;
  const NetworkInterpreter interpreter(network);
  const auto occurs = [&](const StatePredicate& predicate) {
    for (std::size_t i = run.loop; i + 1 < run.state_count(); ++i) {
      if (interpreter.is_true(predicate, run.state(i))) return true;
    }
    return false;
  };
  return std::ranges::all_of(conditions, [&](const FairnessPair& condition) {
    return !occurs(condition.requested) || occurs(condition.granted);
  });
}

std::optional<std::size_t> violated_occurrence(const Network& network,
                                               const Run& run,
                                               const BoundPattern& pattern) {
  return Occurrence(network, run, pattern).first_violated();
}

std::vector<WatchedPart> watched_parts(const Network& network, const Run& run,
                                       const BoundProperty& bound) {
  const NetworkInterpreter interpreter(network);
  std::vector<WatchedPart> parts;
  const auto watch = [&](const std::string& text,
                         const Proposition& proposition) {
    if (text.empty() || std::ranges::count(parts, text, &WatchedPart::text)) {
      return;
    }
    WatchedPart part{text, {}};
    const bool is_of_step = is_of_steps(proposition);
    if (is_of_step) part.at.push_back(false);
    while (part.at.size() < run.state_count()) {
      const std::size_t at = part.at.size() - (is_of_step ? 1 : 0);
      part.at.push_back(is_true(interpreter, network, proposition, run, at));
    }
    parts.push_back(std::move(part));
  };
  if (bound.form == PropertyForm::Timed) {
    for (std::size_t i = 0; i < bound.timed.predicates.size(); ++i) {
      watch(bound.timed.texts[i],
            {bound.timed.predicates[i], PropositionKind::State, {}});
    }
  } else if (asks_of_states(bound.form)) {
    watch(bound.predicate_text, {bound.predicate, PropositionKind::State, {}});
  } else {
    for (std::size_t i = 0; i < bound.origins.size(); ++i) {
      watch(bound.origins[i].text, bound.formula.propositions[i]);
    }
  }
  for (const PropertyAtom& atom : bound.atoms) watch(atom.text, atom.is);
  return parts;
}

}  // namespace btcheck

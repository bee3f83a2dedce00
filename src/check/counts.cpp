// SPDX-License-Identifier: MIT
//
// The tree is lowered again with small numbers. Where no run is found even if
// it is left open how many rounds there are, none is there for any number from
// there on; a run is one of every number, or can be made one, or nothing is
// told. Below, numbers are tried one by one, as many as there are.
#include "check/counts.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "check/replay/counted_run.hpp"
#include "check/rules_network.hpp"
#include "explore/reduce/counters.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/reads.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// Counters are lowered with last values up to this one.
constexpr int kMostLast = 4;

// "num_attempts"; "" where a node of this type counts no rounds.
std::string_view attribute_of(const BehaviorTree& tree, const Node& node) {
  const bool is_paper = tree.profile == Profile::Paper;
  const bool is_py_trees = tree.profile == Profile::PyTrees;
  switch (info_of(node.type).flow) {
    case Flow::Repeats:
      return is_paper ? "repeat" : is_py_trees ? "num_success" : "num_cycles";
    case Flow::Retries:
      return is_py_trees ? "num_failures" : "num_attempts";
    case Flow::Recovers:
      return is_paper ? "num_retries" : "number_of_retries";
    default:
      return "";
  }
}

// Numbers that are no expression and not without end.
bool has_number(const Node& node) {
  const int least = info_of(node.type).flow == Flow::Recovers ? 0 : 1;
  return node.repetitions >= least;
}

// Whether the rule, with all that is assumed, looks at the variable.
bool looks_at(const BoundFile& file, const BoundProperty& rule,
              VariableId variable) {
  const auto does = [&](const StatePredicate& predicate) {
    return reads(predicate.expression, variable) ||
           (predicate.when_dead && reads(*predicate.when_dead, variable));
  };
  const auto is_about = [&](const Proposition& proposition) {
    return does(proposition.of);
  };
  return does(rule.predicate) ||
         std::ranges::any_of(rule.timed.predicates, does) ||
         std::ranges::any_of(rule.formula.propositions, is_about) ||
         std::ranges::any_of(file.assumptions.formula.propositions, is_about) ||
         std::ranges::any_of(predicates_of(file.assumptions.strong), does);
}

// What was found of some rules for one number of rounds. Others point into it.
struct NumberVerdicts {
  BehaviorTree tree;
  PropertyFile rules;  // those asked, in the order they were asked in
  RulesNetwork made = {};
  std::vector<PropertyVerdict> verdicts = {};
};

// Rounds are left uncounted for ever only where the counter is set to 0 again
// and again, as it is in every network that counts them all.
void assume_rounds_end(const BehaviorTree& tree, AutomatonId counting,
                       PropertyFile& rules) {
  FormulaPool& pool = rules.formulas;
  const auto again_and_again = [&](int value) {
    Atom atom;
    atom.kind = AtomKind::Comparison;
    atom.component = tree.node(tree.roots[0]).name;
    atom.process = static_cast<std::int32_t>(index(counting)) + 1;
    atom.left.name = kUncounted;
    atom.right.is_number = true;
    atom.right.number = {value, 0};
    const FormulaId is =
        pool.atom(static_cast<std::uint32_t>(rules.atoms.size()));
    rules.atoms.push_back(std::move(atom));
    return pool.unary(FormulaKind::Always,
                      pool.unary(FormulaKind::Eventually, is));
  };
  const FormulaId once = again_and_again(1);
  const FormulaId more =
      pool.binary(FormulaKind::And, once, again_and_again(2));
  Assumption assumption;
  assumption.kind = Assumption::Kind::Formula;
  assumption.name = kUncounted;
  assumption.formula =
      pool.binary(FormulaKind::Implies, more, again_and_again(0));
  rules.assumptions.push_back(std::move(assumption));
}

// One node that counts.
class CountedNode {
 public:
  CountedNode(const CountedRules& of, NodeId node, SearchChoices choices,
              const Limits& limits)
      : of_(of),
        node_(node),
        choices_(std::move(choices)),
        limits_(limits),
        claims_(of.verdicts.size()) {
    choices_.tells_more = false;
    for (CountClaim& claim : claims_) {
      claim.node = node;
      claim.attribute = attribute_of(of.tree, of.tree.node(node));
    }
  }

  CountClaims open_claims(const std::string& why) {
    leave_open(why);
    return std::move(claims_);
  }

  CountClaims tell() {
    try {
      look();
    } catch (const BudgetSpent&) {
      leave_open("a search was not finished");
    }
    for (CountClaim& claim : claims_) {
      if (claim.from) claim.open.clear();
    }
    return std::move(claims_);
  }

 private:
  // What is searched: the rounds as they are counted, also for runs; or any
  // number of them.
  enum class Rounds : std::uint8_t { Counted, Shown, LeftOpen };

  void look() {
    if (!find_counter()) return leave_open("it is not known how it counts");
    std::vector<std::size_t> searched, shown;
    for (std::size_t i = 0; i < claims_.size(); ++i) {
      if (!can_be_asked(i)) continue;
      (finds_none(i, of_.verdicts[i].verdict) ? searched : shown).push_back(i);
    }
    search_open(searched);
    look_at_runs(shown);
    go_down();
    for (std::size_t i = 0; i < claims_.size(); ++i) {
      const auto last = from_.find(i);
      if (last == from_.end()) continue;
      // The tree's own number has to be one of them.
      if (last->second <= own_last()) claims_[i].from = last->second + offset_;
    }
  }

  // The drawing says up to which value a node counts that is given a number.
  bool find_counter() {
    const int number = kMostLast + 1;
    const auto found = lowered(number, of_.rules);
    if (!found) return false;
    const Network& network = *found->made.network;
    const auto counter = round_counter(network, node_);
    if (!counter) return false;
    counting_ = counter->automaton;
    offset_ = number - network.variable(counter->variable).max;
    for (const BoundProperty& rule : found->made.bound.properties) {
      looks_at_.push_back(looks_at(found->made.bound, rule, counter->variable));
    }
    return true;
  }

  bool can_be_asked(std::size_t i) {
    const PropertyVerdict& verdict = of_.verdicts[i];
    std::string& open = claims_[i].open;
    open = "some other number may give another verdict";
    if (verdict.verdict == Verdict::Undecided || !verdict.error.empty()) {
      open = "the rule is undecided";
    } else if (rule(i).form == PropertyForm::Branching) {
      open = "the rule is one of branching time";
    } else if (looks_at_[i]) {
      open = "the rule looks at the counter";
    } else {
      return true;
    }
    return false;
  }

  const BoundProperty& rule(std::size_t i) const {
    return of_.bound.properties[i];
  }

  // Whether the verdict says that no run is there: against the rule, or for a
  // `possible`.
  bool finds_none(std::size_t i, Verdict verdict) const {
    return verdict == (rule(i).form == PropertyForm::Possible
                           ? Verdict::Violated
                           : Verdict::Holds);
  }

  int own_last() const { return of_.tree.node(node_).repetitions - offset_; }

  void search_open(std::vector<std::size_t> asked) {
    for (int last = 1; last <= kMostLast && !asked.empty(); ++last) {
      for (const bool of_states : {true, false}) {
        std::vector<std::size_t> alike;
        std::ranges::copy_if(asked, std::back_inserter(alike),
                             [&](std::size_t i) {
                               return asks_of_states(rule(i).form) == of_states;
                             });
        if (alike.empty()) continue;
        const auto found = verdicts(last, alike, Rounds::LeftOpen);
        if (!found) return;
        for (std::size_t k = 0; k < alike.size(); ++k) {
          const PropertyVerdict& verdict = found->verdicts[k];
          note_limits(alike[k], verdict);
          if (!finds_none(alike[k], verdict.verdict) ||
              !verdict.comparisons.empty()) {
            continue;
          }
          from_[alike[k]] = last;
          std::erase(asked, alike[k]);
        }
      }
    }
  }

  void look_at_runs(std::vector<std::size_t> asked) {
    if (asked.empty()) return;
    const auto found = verdicts(kMostLast, asked, Rounds::Shown);
    if (!found) return;
    const auto counter = round_counter(*found->made.network, node_);
    if (!counter) return;
    for (std::size_t k = 0; k < asked.size(); ++k) {
      note_limits(asked[k], found->verdicts[k]);
      if (!is_shown(*found, k, asked[k])) continue;
      const auto last = least_last_value(
          *found->made.network, counter->variable, *found->verdicts[k].run,
          found->made.bound.properties[k]);
      if (last) from_[asked[k]] = *last;
    }
  }

  // As long as a number below has the same verdict, too.
  void go_down() {
    for (int last = kMostLast - 1; last >= 0; --last) {
      std::vector<std::size_t> asked;
      for (auto& [i, from] : from_) {
        if (from == last + 1) asked.push_back(i);
      }
      if (asked.empty()) continue;
      if (last == own_last()) {
        for (const std::size_t i : asked) from_[i] = last;
        continue;
      }
      const auto found = verdicts(
          last, asked, of_.tree.programs ? Rounds::Shown : Rounds::Counted);
      if (!found) continue;
      for (std::size_t k = 0; k < asked.size(); ++k) {
        const std::size_t i = asked[k];
        const PropertyVerdict& verdict = found->verdicts[k];
        const bool is_none = finds_none(i, verdict.verdict);
        if (verdict.verdict == of_.verdicts[i].verdict &&
            verdict.comparisons.empty() &&
            (is_none || !of_.tree.programs || is_shown(*found, k, i))) {
          from_[i] = last;
        }
      }
    }
  }

  // A run shows the verdict, of number k there, and the engine has it: no
  // script on it would have to be executed on real values.
  bool is_shown(const NumberVerdicts& found, std::size_t k,
                std::size_t i) const {
    const PropertyVerdict& verdict = found.verdicts[k];
    if (!verdict.run || !verdict.error.empty() ||
        verdict.verdict != of_.verdicts[i].verdict ||
        !verdict.comparisons.empty()) {
      return false;
    }
    return std::ranges::all_of(verdict.run->steps, [&](const RunStep& step) {
      return step.step.edge == kTimeStep ||
             found.made.network->edge(step.step.edge).scripts.empty();
    });
  }

  // The tree and the rules with another number, and what `change` makes of
  // their network; null where they do not go together.
  std::unique_ptr<NumberVerdicts> lowered(
      int number, PropertyFile rules,
      const std::function<void(Network&)>& change = {}) const {
    auto found = std::make_unique<NumberVerdicts>(
        NumberVerdicts{of_.tree, std::move(rules)});
    found->tree.nodes[index(node_)].repetitions = number;
    auto made =
        network_for(found->tree, of_.tree_source, found->rules, of_.source,
                    of_.ticks, of_.extra, of_.most_whole, change);
    if (!made.value) return nullptr;
    found->made = std::move(*made.value);
    return found;
  }

  PropertyFile only(const std::vector<std::size_t>& asked) const {
    PropertyFile rules = of_.rules;
    rules.properties.clear();
    for (const std::size_t i : asked) {
      rules.properties.push_back(of_.rules.properties[i]);
    }
    return rules;
  }

  // Verdicts for a last value of the counter; null where nothing is known.
  std::unique_ptr<NumberVerdicts> verdicts(
      int last, const std::vector<std::size_t>& asked, Rounds rounds) const {
    PropertyFile rules = only(asked);
    std::function<void(Network&)> change;
    bool is_counter = true;
    if (rounds == Rounds::LeftOpen) {
      if (!asks_of_states(rule(asked.front()).form)) {
        assume_rounds_end(of_.tree, counting_, rules);
      }
      change = [&](Network& network) {
        const auto counter = round_counter(network, node_);
        is_counter = counter.has_value();
        if (counter) leave_rounds_open(*counter, network);
      };
    }
    auto found = lowered(last + offset_, std::move(rules), change);
    if (!found || !is_counter) return nullptr;
    SearchChoices choices = choices_;
    choices.keeps_runs = rounds == Rounds::Shown;
    found->verdicts = verify(CompiledNetwork(*found->made.network),
                             found->made.bound, choices, limits_)
                          .verdicts;
    return found;
  }

  void note_limits(std::size_t i, const PropertyVerdict& verdict) {
    if (verdict.verdict == Verdict::Undecided) {
      claims_[i].open = "a search was not finished";
    }
  }

  void leave_open(const std::string& why) {
    for (CountClaim& claim : claims_) claim.open = why;
  }

  const CountedRules& of_;
  NodeId node_;
  SearchChoices choices_;
  const Limits& limits_;
  std::vector<CountClaim> claims_;        // by verdict
  std::vector<bool> looks_at_ = {};       // by verdict: at the counter
  std::map<std::size_t, int> from_ = {};  // by verdict: the least last value
  AutomatonId counting_{};
  int offset_ = 0;  // the number, less the last value of the counter
};

// A subtree that is used in several places has one number for all of them.
bool stands_alone(const BehaviorTree& tree, NodeId id) {
  const Node& node = tree.node(id);
  return std::ranges::none_of(tree.nodes, [&](const Node& other) {
    return &other != &node && other.included == node.included &&
           other.type == node.type && other.span.line == node.span.line &&
           other.span.column == node.span.column;
  });
}

}  // namespace

std::vector<CountClaims> count_claims(const CountedRules& of,
                                      const SearchChoices& choices,
                                      const Limits& limits) {
  std::vector<CountClaims> all(of.verdicts.size());
  for (std::uint32_t n = 0; n < of.tree.nodes.size(); ++n) {
    const Node& node = of.tree.nodes[n];
    if (attribute_of(of.tree, node).empty() || !has_number(node)) continue;
    CountedNode counted(of, NodeId{n}, choices, limits);
    CountClaims claims =
        stands_alone(of.tree, NodeId{n})
            ? counted.tell()
            : counted.open_claims("its subtree is used in several places");
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].push_back(std::move(claims[i]));
    }
  }
  return all;
}

}  // namespace btcheck

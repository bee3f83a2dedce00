// SPDX-License-Identifier: MIT
//
// Properties are put into the form in which they are searched. Under
// assumptions A a property F is the formula A => F; strong fairness is kept
// apart, as a formula it would explode. Codes: BT1108, BT1109, BT1110.
#include "check/bind/bound_property.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "ltl/formula/formula.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

using Findings = std::vector<Diagnostic>;

// The nodes that own some of the variables.
std::vector<NodeId> owners(const Network& network,
                           const std::set<VariableId>& variables) {
  const auto is_one = [&](std::optional<VariableId> variable) {
    return variable && variables.contains(*variable);
  };
  std::vector<NodeId> nodes;
  for (std::uint32_t n = 0; n < network.node_automaton.size(); ++n) {
    const Automaton& automaton = network.automaton(NodeId{n});
    if (is_one(automaton.location) || is_one(network.node_status[n]) ||
        is_one(network.node_caller[n]) ||
        std::ranges::any_of(automaton.locals, is_one)) {
      nodes.push_back(NodeId{n});
    }
  }
  return nodes;
}

class PropertyBinder {
 public:
  PropertyBinder(const BehaviorTree& tree, const Network& network,
                 const PropertyFile& file, const SourceText& source)
      : tree_(tree),
        network_(network),
        file_(file),
        source_(source),
        pool_(file.formulas) {}

  Result<BoundFile> run(ExtraAssumption extra) {
    bind_atoms();
    bind_assumptions(extra);
    for (const Property& property : file_.properties) {
      ask_budget();
      bind(property);
    }
    for (Proposition& atom : atoms_) {
      bound_.atoms.push_back(std::move(atom.of.expression));
    }
    Result<BoundFile> result{std::nullopt, std::move(findings_)};
    if (!has_error(result.diagnostics)) result.value = std::move(bound_);
    return result;
  }

 private:
  void bind_atoms() {
    Binder binder(tree_, network_, source_, findings_);
    for (std::uint32_t number = 0; number < file_.atoms.size(); ++number) {
      ask_budget();
      atoms_.push_back(binder.proposition(file_, number, atoms_));
      open_.push_back(binder.take_open());
      given_.push_back(binder.take_given());
    }
  }

  void bind_assumptions(ExtraAssumption extra) {
    BoundAssumptions& assumptions = bound_.assumptions;
    assumption_ = pool_.constant(true);
    bool do_actions_end = extra == ExtraAssumption::ActionsEnd;
    if (do_actions_end) {
      assumptions.names.push_back("actions-end");
      assume_actions_end();
    }
    for (const Assumption& assumption : file_.assumptions) {
      const bool is_formula = assumption.kind == Assumption::Kind::Formula;
      if (!is_formula && do_actions_end) continue;
      assumptions.names.push_back(assumption.name);
      if (is_formula) warn_of_arguments(assumption.formula, assumption.span);
      if (!is_formula) {
        assume_actions_end();
        do_actions_end = true;
      } else if (!assume_as_fairness(assumption.formula)) {
        assumption_ = assumptions.has_formula
                          ? pool_.binary(FormulaKind::And, assumption_,
                                         assumption.formula)
                          : assumption.formula;
        assumptions.has_formula = true;
      }
    }
    auto formula = bind_formula(pool_, assumption_, atoms_);
    if (formula) {
      assumptions.formula = std::move(*formula);
    } else {
      refuse("BT1109", file_.assumptions.back().span,
             "the assumptions are too large to be checked", "leave some out");
    }
  }

  // For each action: if it is ticked infinitely often, then it succeeds, fails
  // or is halted infinitely often.
  void assume_actions_end() {
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (tree_.nodes[n].type != NodeType::Action) continue;
      const auto is_in = [&](LocationRole role) {
        return node_in_location(network_, NodeId{n}, role);
      };
      const auto either = [](Expression left, Expression right) {
        return Expression::binary(Operation::Or, std::move(left),
                                  std::move(right));
      };
      bound_.assumptions.strong.push_back(
          {{is_in(LocationRole::Tick), {}},
           {either(either(is_in(LocationRole::Success),
                          is_in(LocationRole::Failure)),
                   is_in(LocationRole::Halted)),
            {}}});
    }
  }

  // `[] <> p => [] <> q` and `[] <> q` of single states need no automaton.
  bool assume_as_fairness(FormulaId formula) {
    const FormulaNode& node = pool_[formula];
    const auto inside = [&](FormulaId recurrence) {
      return predicate_of(pool_, pool_[pool_[recurrence].left].left, atoms_);
    };
    std::optional<StatePredicate> requested =
        StatePredicate{Expression::constant(1), {}};
    FormulaId granted = formula;
    if (node.kind == FormulaKind::Implies && is_recurrence(node.left)) {
      requested = inside(node.left);
      granted = node.right;
    }
    if (!is_recurrence(granted)) return false;
    auto grant = inside(granted);
    if (!requested || !grant) return false;
    bound_.assumptions.strong.push_back(
        {std::move(*requested), std::move(*grant)});
    return true;
  }

  void bind(const Property& property) {
    BoundProperty bound;
    bound.property = &property;
    bound.form = property.form;
    if (!bind_claim(property, bound) || !bind_formula_of(bound)) return;
    if (bound.form == PropertyForm::Ltl ||
        bound.form == PropertyForm::Branching) {
      bound.origins = origins(bound);
    }
    bound.atoms = atoms_of(property);
    bound.subjects = subjects_of(property);
    bound.comparisons = open_of(property);
    bound_.properties.push_back(std::move(bound));
  }

  bool bind_claim(const Property& property, BoundProperty& bound) {
    if (property.form == PropertyForm::Timed)
      return bind_timed(property, bound);
    if (property.form == PropertyForm::DeadlockFree) {
      bound.predicate = {Expression::constant(0), Expression::constant(1)};
      bound.predicate_text = "stuck";
      return true;
    }
    const auto body = always_true(property);
    if (body && pool_[*body].kind == FormulaKind::Implies &&
        is_state_formula(pool_[*body].left)) {
      const FormulaId trigger = pool_[*body].left;
      if (auto predicate = certain(trigger)) {
        bound.trigger = {std::move(*predicate), formula_text(file_, trigger)};
      }
    }
    if (const auto claim = state_claim(property)) {
      auto predicate = claim->first == PropertyForm::Invariant
                           ? not_refuted(claim->second)
                           : certain(claim->second);
      if (!predicate) return refuse_size(property);
      bound.form = claim->first;
      bound.predicate = std::move(*predicate);
      bound.predicate_text = formula_text(file_, claim->second);
      return true;
    }
    warn_of_arguments(property.formula, property.span);
    const bool is_branching = property.form == PropertyForm::Branching;
    if (is_branching && speaks_of_steps(pool_, property.formula, atoms_)) {
      return refuse("BT1223", property.span,
                    "events of steps have no place in branching time",
                    "write the property as LTL");
    }
    if (is_branching && bound_.assumptions.has_formula) {
      return refuse(
          "BT1110", property.span,
          fmt::format("`{}` is branching time, and an assumption is a "
                      "formula of LTL",
                      property.name),
          "put the property into a file of its own, or assume only "
          "fairness: `[] <> P => [] <> Q`");
    }
    return true;
  }

  // Of LTL and CTL, which have two truth values.
  void warn_of_arguments(FormulaId formula, SourceSpan span) {
    if (!asks_of_arguments(formula)) return;
    const auto part = false_without_arguments(pool_, formula, file_.atoms,
                                              given_, NodeNames(tree_));
    if (!part) return;
    const bool value = pool_[*part].kind == FormulaKind::Eventually;
    findings_.push_back(source_.diagnostic(
        Severity::Warning, "BT1112", span,
        fmt::format("`{}` is {} while the node has no arguments",
                    formula_text(file_, pool_[*part].left), value),
        "it has them from its tick on until it has answered",
        value ? "write the opposite comparison: `x.z > 6` for "
                "`not x.z <= 6`"
              : "write `x.ticked => x.z <= 6`, or a rule `always x.z <= 6`"));
  }

  bool bind_timed(const Property& property, BoundProperty& bound) {
    if (network_.ticks == TickSemantics::None) {
      return refuse("BT1108", property.span,
                    fmt::format("`{}` speaks of time, but under `none` no time "
                                "passes",
                                property.name),
                    "choose " + word(Choice::Tick, "root, leaves or nodes"));
    }
    const TimedClaim& claim = property.timed;
    BoundPattern& timed = bound.timed;
    bool is_bound = true;
    // One that plays two parts is one proposition: `whenever P then P within 2
    // ticks` cannot be broken.
    std::map<std::pair<FormulaId, bool>, PropositionSet> known;
    const auto bit = [&](std::optional<FormulaId> formula,
                         bool is_lasting = false) -> PropositionSet {
      if (!formula) return 0;
      PropositionSet& same = known[{*formula, is_lasting}];
      if (same != 0) return same;
      auto predicate = is_lasting ? not_refuted(*formula) : certain(*formula);
      if (!predicate) return is_bound = false;
      timed.predicates.push_back(std::move(*predicate));
      timed.texts.push_back(formula_text(file_, *formula));
      same = PropositionSet{1} << (timed.predicates.size() - 1);
      return same;
    };
    timed.pattern = {
        .trigger = bit(claim.trigger),
        .answer = bit(claim.answer, claim.demand == Demand::Lasting),
        .from = claim.from,
        .to = claim.to,
        .demand = claim.demand,
        .opening = bit(claim.opening),
        .closing = bit(claim.closing),
        .must_open = claim.must_open};
    return is_bound || refuse_size(property);
  }

  bool asks_of_arguments(FormulaId formula) const {
    return std::ranges::any_of(pool_.atoms(formula), [&](std::uint32_t atom) {
      return atom < given_.size() && !given_[atom].nodes.empty();
    });
  }

  // Where a condition on single states holds for certain, whatever is said of
  // arguments that no node has been given.
  std::optional<StatePredicate> certain(FormulaId formula) const {
    if (!asks_of_arguments(formula)) {
      return predicate_of(pool_, formula, atoms_);
    }
    auto known = definite_predicates(pool_, formula, atoms_, given_);
    if (!known) return std::nullopt;
    return std::move(known->holds);
  }

  // Where it does not fail for certain.
  std::optional<StatePredicate> not_refuted(FormulaId formula) const {
    if (!asks_of_arguments(formula)) {
      return predicate_of(pool_, formula, atoms_);
    }
    auto known = definite_predicates(pool_, formula, atoms_, given_);
    if (!known) return std::nullopt;
    return std::move(known->may_hold);
  }

  // P of `always P`, `[] P` and `AG P`.
  std::optional<FormulaId> always_true(const Property& property) const {
    FormulaId body = property.formula;
    if (property.form == PropertyForm::Invariant) return body;
    if (pool_[body].kind == FormulaKind::ForAllPaths) body = pool_[body].left;
    if (pool_[body].kind != FormulaKind::Always) return std::nullopt;
    return pool_[body].left;
  }

  // Which formula, if any, is asked of single states, and how.
  std::optional<std::pair<PropertyForm, FormulaId>> state_claim(
      const Property& property) const {
    if (asks_of_states(property.form)) {
      return std::pair{property.form, property.formula};
    }
    const auto body = always_true(property);
    if (body && is_state_formula(*body)) {
      return std::pair{PropertyForm::Invariant, *body};
    }
    const FormulaNode& whole = pool_[property.formula];
    if (whole.kind != FormulaKind::ExistsPath) return std::nullopt;
    const FormulaNode& path = pool_[whole.left];
    if (path.kind == FormulaKind::Eventually && is_state_formula(path.left)) {
      return std::pair{PropertyForm::Possible, path.left};
    }
    return std::nullopt;
  }

  // The formula that the assumed runs with the wanted or unwanted state
  // violate.
  FormulaId violated_by(const BoundProperty& bound) {
    if (!asks_of_states(bound.form)) return bound.property->formula;
    FormulaId state = atom_for(bound.predicate);
    if (bound.form != PropertyForm::Invariant) {
      state = pool_.unary(FormulaKind::Not, state);
    }
    return pool_.unary(FormulaKind::Always, state);
  }

  // The claim, asked of the runs that satisfy the assumptions only.
  FormulaId under_assumptions(FormulaId claim) {
    if (!bound_.assumptions.has_formula) return claim;
    return pool_.binary(FormulaKind::Implies, assumption_, claim);
  }

  bool bind_formula_of(BoundProperty& bound) {
    const Property& property = *bound.property;
    const bool is_timed = bound.form == PropertyForm::Timed;
    bound.is_assumed =
        !bound_.assumptions.empty() && bound.form != PropertyForm::Branching;
    if (!bound.is_assumed && (is_timed || asks_of_states(bound.form))) {
      return true;
    }
    const std::size_t own_atoms = atoms_.size();
    FormulaId formula{};
    FormulaId due{};
    if (is_timed) {
      // `due` must be a proposition of its own, whatever it stands for.
      due = atom_for({Expression::constant(0), {}});
      formula =
          pool_.binary(FormulaKind::And, assumption_,
                       pool_.unary(FormulaKind::Eventually,
                                   pool_.unary(FormulaKind::Always, due)));
    } else {
      formula = under_assumptions(violated_by(bound));
    }
    auto whole = bind_formula(pool_, formula, atoms_);
    atoms_.resize(own_atoms);
    const std::size_t more = bound.timed.predicates.size();
    if (!whole || whole->propositions.size() + more > kMaxPropositions) {
      return refuse_size(property);
    }
    bound.formula = std::move(*whole);
    const auto& sources = bound.formula.sources;
    bound.due = static_cast<std::size_t>(std::ranges::find(sources, due) -
                                         sources.begin());
    const auto occurrence = property.timed.trigger ? property.timed.trigger
                                                   : property.timed.opening;
    if (is_timed && occurrence) {
      bound.without = bind_formula(
          pool_,
          under_assumptions(pool_.unary(
              FormulaKind::Always, pool_.unary(FormulaKind::Not, *occurrence))),
          atoms_);
    }
    return true;
  }

  std::set<VariableId> read_by(const std::vector<FormulaId>& parts) const {
    std::set<VariableId> variables;
    for (const FormulaId part : parts) {
      for (const std::uint32_t atom : pool_.atoms(part)) {
        for (const Term& term : atoms_[atom].of.expression.terms()) {
          if (term.operation != Operation::Variable) continue;
          variables.insert(
              VariableId{static_cast<std::uint32_t>(term.operand)});
        }
      }
    }
    return variables;
  }

  // Found from what is read, not from how it was written.
  Subjects subjects_of(const Property& property) const {
    std::vector<FormulaId> awaited;
    if (property.form == PropertyForm::Timed) {
      if (property.timed.demand == Demand::Answer ||
          property.timed.demand == Demand::FirstAnswer) {
        awaited.push_back(property.timed.answer);
      }
    } else if (property.form != PropertyForm::DeadlockFree) {
      const std::vector<Polarity> stands = polarities(pool_, property.formula);
      for (const FormulaId id : pool_.nodes(property.formula)) {
        if (pool_[id].kind == FormulaKind::Eventually &&
            stands[index(id)] == Polarity::Positive) {
          awaited.push_back(pool_[id].left);
        }
      }
    }
    const std::set<VariableId> variables = read_by(parts_of(property));
    Subjects found{
        owners(network_, variables), owners(network_, read_by(awaited)), {}};
    for (std::uint32_t v = 0; v < network_.state_variable.size(); ++v) {
      if (variables.contains(network_.state_variable[v])) {
        found.variables.push_back(StateVariableId{v});
      }
    }
    return found;
  }

  static std::vector<FormulaId> parts_of(const Property& property) {
    if (property.form == PropertyForm::DeadlockFree) return {};
    if (property.form != PropertyForm::Timed) return {property.formula};
    std::vector<FormulaId> parts;
    const TimedClaim& claim = property.timed;
    for (const auto& part : {claim.trigger, claim.opening, claim.closing}) {
      if (part) parts.push_back(*part);
    }
    parts.push_back(claim.answer);
    return parts;
  }

  // What is not known of the atoms of a formula, and of what they enter or
  // leave.
  void add_open(FormulaId formula, std::vector<OpenComparison>& open) const {
    for (const std::uint32_t number : pool_.atoms(formula)) {
      open.insert(open.end(), open_[number].begin(), open_[number].end());
      const Atom& atom = file_.atoms[number];
      if (is_past(atom.kind) || atom.kind == AtomKind::Enter ||
          atom.kind == AtomKind::Leave) {
        add_open(atom.of, open);
      }
      if (atom.kind == AtomKind::Since) add_open(atom.since, open);
    }
  }

  std::vector<OpenComparison> open_of(const Property& property) const {
    std::vector<OpenComparison> open;
    for (const FormulaId part : parts_of(property)) add_open(part, open);
    for (const Assumption& assumption : file_.assumptions) {
      const bool has_formula = assumption.kind != Assumption::Kind::ActionsEnd;
      if (has_formula) add_open(assumption.formula, open);
    }
    return open;
  }

  std::vector<PropertyAtom> atoms_of(const Property& property) {
    std::vector<PropertyAtom> found;
    std::set<std::uint32_t> known;
    for (const FormulaId part : parts_of(property)) {
      for (const std::uint32_t atom : pool_.atoms(part)) {
        if (!known.insert(atom).second) continue;
        found.push_back({formula_text(file_, pool_.atom(atom)), atoms_[atom]});
      }
    }
    return found;
  }

  std::vector<PropositionOrigin> origins(const BoundProperty& bound) const {
    const std::vector<FormulaId> own = pool_.nodes(bound.property->formula);
    // Conditions over the ends of the scope and nothing else.
    std::set<std::uint32_t> ends;
    for (const FormulaId end : bound.property->scope_ends) {
      const std::vector<std::uint32_t> more = pool_.atoms(end);
      ends.insert(more.begin(), more.end());
    }
    std::vector<PropositionOrigin> found;
    for (const FormulaId source : bound.formula.sources) {
      const bool is_own = std::ranges::binary_search(own, source);
      found.push_back({is_own ? formula_text(file_, source) : "",
                       std::ranges::includes(ends, pool_.atoms(source))});
    }
    return found;
  }

  bool is_recurrence(FormulaId id) const {
    const FormulaNode& always = pool_[id];
    if (always.kind != FormulaKind::Always) return false;
    const FormulaNode& eventually = pool_[always.left];
    return eventually.kind == FormulaKind::Eventually &&
           is_state_formula(eventually.left);
  }

  bool is_state_formula(FormulaId id) const {
    return !speaks_of_steps(pool_, id, atoms_) && pool_.is_state_formula(id);
  }
  FormulaId atom_for(StatePredicate predicate) {
    atoms_.push_back({std::move(predicate), PropositionKind::State, {}});
    return pool_.atom(static_cast<std::uint32_t>(atoms_.size() - 1));
  }
  bool refuse(std::string_view code, SourceSpan span, std::string message,
              std::string help) {
    findings_.push_back(source_.diagnostic(
        Severity::Error, code, span, std::move(message), "", std::move(help)));
    return false;
  }
  bool refuse_size(const Property& property) {
    return refuse("BT1109", property.span,
                  fmt::format("`{}` is too large to be checked", property.name),
                  "split it into several properties");
  }

  const BehaviorTree& tree_;
  const Network& network_;
  const PropertyFile& file_;
  const SourceText& source_;
  FormulaPool pool_;                // the file's, and what is built from it
  std::vector<Proposition> atoms_;  // the file's, and more behind them
  std::vector<std::vector<OpenComparison>> open_;  // of the file's atoms
  std::vector<GivenArguments> given_;  // likewise, for a truth value
  FormulaId assumption_{};  // the conjunction of all that are formulas
  Findings findings_;
  BoundFile bound_;
};

}  // namespace

Result<BoundFile> bind_properties(const BehaviorTree& tree,
                                  const Network& network,
                                  const PropertyFile& properties,
                                  const SourceText& source,
                                  ExtraAssumption extra) {
  const Stage stage("the rules were bound to the tree");
  // `tick leaves` counts only where no --tick overrides it.
  const TickSemantics ticks = network.ticks;
  if (is_engine(tree.profile) && properties.ticks == tick_name(ticks) &&
      (ticks == TickSemantics::Leaves || ticks == TickSemantics::Nodes)) {
    return {std::nullopt,
            {source.diagnostic(
                Severity::Error, "BT1636", {},
                "in an XML tree time passes at ticks of the root only", "",
                fmt::format("leave `tick {}` out", *properties.ticks))}};
  }
  return PropertyBinder(tree, network, properties, source).run(extra);
}

std::vector<StatePredicate> predicates_of(
    const std::vector<FairnessPair>& conditions) {
  std::vector<StatePredicate> predicates;
  for (const FairnessPair& condition : conditions) {
    predicates.push_back(condition.requested);
    predicates.push_back(condition.granted);
  }
  return predicates;
}

std::string formula_text(const PropertyFile& file, FormulaId formula) {
  return file.formulas.text(
      formula, [&](std::uint32_t atom) { return file.atoms[atom].text; });
}

}  // namespace btcheck

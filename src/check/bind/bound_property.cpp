// SPDX-License-Identifier: MIT
//
// Names were found by the binder; here properties are put into the form in
// which they are searched. A property under assumptions A is the formula
// A => F; built-in strong fairness is kept apart, as a formula it would
// explode. Codes: BT1108, BT1109, BT1110.
#include "check/bind/bound_property.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ltl/formula/formula.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

using Findings = std::vector<Diagnostic>;

// Which formula, if any, is asked of single states, and how.
struct StateClaim {
  PropertyForm form = PropertyForm::Never;
  FormulaId formula{};
};

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
    for (const Property& property : file_.properties) bind(property);
    Result<BoundFile> result{std::nullopt, std::move(findings_)};
    if (!has_error(result.diagnostics)) result.value = std::move(bound_);
    return result;
  }

 private:
  void bind_atoms();
  void bind_assumptions(ExtraAssumption extra);
  void assume_actions_end(std::string name);
  bool assume_as_fairness(FormulaId formula);
  void bind(const Property& property);
  bool bind_claim(const Property& property, BoundProperty& bound);
  bool bind_timed(const Property& property, BoundProperty& bound);
  std::optional<StateClaim> state_claim(const Property& property) const;
  std::optional<FormulaId> trigger_of(const Property& property) const;
  FormulaId violated_by(const Property& property, const BoundProperty& bound);
  // The claim, asked of the runs that satisfy the assumptions only.
  FormulaId under_assumptions(FormulaId claim);
  bool bind_assumed(const Property& property, BoundProperty& bound);
  Subjects subjects_of(const Property& property) const;
  static std::vector<FormulaId> parts_of(const Property& property);
  void add_open(FormulaId formula, std::vector<OpenComparison>& open) const;
  std::vector<OpenComparison> open_of(const Property& property) const;
  std::vector<PropositionOrigin> origins(const Property& property,
                                         const BoundProperty& bound) const;

  bool is_recurrence(FormulaId id) const;
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
  FormulaId assumption_{};  // the conjunction of all that are formulas
  Findings findings_;
  BoundFile bound_;
};

void PropertyBinder::bind_atoms() {
  Binder binder(tree_, network_, source_);
  for (const Atom& atom : file_.atoms) {
    Proposition bound;
    switch (atom.kind) {
      case AtomKind::Enter:
      case AtomKind::Leave:
        bound.kind = atom.kind == AtomKind::Enter ? PropositionKind::Enter
                                                  : PropositionKind::Leave;
        bound.of =
            predicate_of(pool_, atom.of, atoms_).value_or(StatePredicate{});
        break;
      case AtomKind::Moves:
        bound.kind = PropositionKind::Moves;
        bound.movers = binder.movers(atom, findings_);
        break;
      case AtomKind::Passes:
        bound.kind = PropositionKind::Passes;
        break;
      default:
        bound.of = binder.bind(atom, findings_).value_or(StatePredicate{});
    }
    atoms_.push_back(std::move(bound));
    open_.push_back(binder.take_open());
  }
}

// What is not known of the atoms of a formula, and of what they enter or leave.
void PropertyBinder::add_open(FormulaId formula,
                              std::vector<OpenComparison>& open) const {
  for (const std::uint32_t number : pool_.atoms(formula)) {
    open.insert(open.end(), open_[number].begin(), open_[number].end());
    const Atom& atom = file_.atoms[number];
    const bool has_formula =
        atom.kind == AtomKind::Enter || atom.kind == AtomKind::Leave;
    if (has_formula) add_open(atom.of, open);
  }
}

std::vector<OpenComparison> PropertyBinder::open_of(
    const Property& property) const {
  std::vector<OpenComparison> open;
  for (const FormulaId part : parts_of(property)) add_open(part, open);
  for (const Assumption& assumption : file_.assumptions) {
    const bool has_formula = assumption.kind != Assumption::Kind::ActionsEnd;
    if (has_formula) add_open(assumption.formula, open);
  }
  return open;
}

std::vector<FormulaId> PropertyBinder::parts_of(const Property& property) {
  if (property.form == PropertyForm::DeadlockFree) return {};
  if (property.form != PropertyForm::Timed) return {property.formula};
  std::vector<FormulaId> parts;
  if (property.timed.trigger) parts.push_back(*property.timed.trigger);
  if (property.timed.opening) parts.push_back(*property.timed.opening);
  if (property.timed.closing) parts.push_back(*property.timed.closing);
  parts.push_back(property.timed.answer);
  return parts;
}

void PropertyBinder::bind_assumptions(ExtraAssumption extra) {
  BoundAssumptions& assumptions = bound_.assumptions;
  assumption_ = pool_.constant(true);
  bool ends_twice = extra == ExtraAssumption::ActionsEnd;
  if (extra == ExtraAssumption::ActionsEnd) assume_actions_end("actions-end");
  for (const Assumption& assumption : file_.assumptions) {
    if (assumption.kind == Assumption::Kind::ActionsEnd) {
      if (!ends_twice) assume_actions_end(assumption.name);
      ends_twice = true;
      continue;
    }
    assumptions.names.push_back(assumption.name);
    if (assume_as_fairness(assumption.formula)) continue;
    assumption_ =
        assumptions.has_formula
            ? pool_.binary(FormulaKind::And, assumption_, assumption.formula)
            : assumption.formula;
    assumptions.has_formula = true;
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
void PropertyBinder::assume_actions_end(std::string name) {
  bound_.assumptions.names.push_back(std::move(name));
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    if (tree_.nodes[n].type != NodeType::Action) continue;
    bound_.assumptions.strong.push_back(
        {{node_in_location(network_, NodeId{n}, LocationRole::Tick), {}},
         {Expression::binary(
              Operation::Or,
              Expression::binary(
                  Operation::Or,
                  node_in_location(network_, NodeId{n}, LocationRole::Success),
                  node_in_location(network_, NodeId{n}, LocationRole::Failure)),
              node_in_location(network_, NodeId{n}, LocationRole::Halted)),
          {}}});
  }
}

bool PropertyBinder::is_recurrence(FormulaId id) const {
  const FormulaNode& always = pool_[id];
  if (always.kind != FormulaKind::Always) return false;
  const FormulaNode& eventually = pool_[always.left];
  return eventually.kind == FormulaKind::Eventually &&
         is_state_formula(eventually.left);
}

// `[] <> p => [] <> q` and `[] <> q` of single states need no automaton.
bool PropertyBinder::assume_as_fairness(FormulaId formula) {
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

std::optional<StateClaim> PropertyBinder::state_claim(
    const Property& property) const {
  const FormulaNode& whole = pool_[property.formula];
  switch (property.form) {
    case PropertyForm::Never:
    case PropertyForm::Invariant:
    case PropertyForm::Possible:
      return StateClaim{property.form, property.formula};
    case PropertyForm::Ltl:
      if (whole.kind == FormulaKind::Always && is_state_formula(whole.left)) {
        return StateClaim{PropertyForm::Invariant, whole.left};
      }
      return std::nullopt;
    case PropertyForm::Branching: {
      if (!is_path_quantifier(whole.kind)) return std::nullopt;
      const FormulaNode& path = pool_[whole.left];
      const bool is_all = whole.kind == FormulaKind::ForAllPaths;
      if (path.kind ==
              (is_all ? FormulaKind::Always : FormulaKind::Eventually) &&
          is_state_formula(path.left)) {
        return StateClaim{
            is_all ? PropertyForm::Invariant : PropertyForm::Possible,
            path.left};
      }
      return std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

// P of `always (P => …)`, `[] (P => …)` and `AG (P => …)`.
std::optional<FormulaId> PropertyBinder::trigger_of(
    const Property& property) const {
  FormulaId body = property.formula;
  if (property.form == PropertyForm::Branching &&
      pool_[body].kind == FormulaKind::ForAllPaths) {
    body = pool_[body].left;
  }
  if (property.form == PropertyForm::Ltl ||
      property.form == PropertyForm::Branching) {
    if (pool_[body].kind != FormulaKind::Always) return std::nullopt;
    body = pool_[body].left;
  } else if (property.form != PropertyForm::Invariant) {
    return std::nullopt;
  }
  const FormulaNode& node = pool_[body];
  if (node.kind != FormulaKind::Implies || !is_state_formula(node.left)) {
    return std::nullopt;
  }
  return node.left;
}

bool PropertyBinder::bind_timed(const Property& property,
                                BoundProperty& bound) {
  if (network_.ticks == TickSemantics::None) {
    return refuse("BT1108", property.span,
                  fmt::format("`{}` speaks of time, but under `none` no time "
                              "passes",
                              property.name),
                  "choose --tick root, leaves or nodes");
  }
  const TimedClaim& claim = property.timed;
  TimedPattern& pattern = bound.timed.pattern;
  bool is_bound = true;
  const auto bit = [&](std::optional<FormulaId> formula) -> PropositionSet {
    if (!formula) return 0;
    auto predicate = predicate_of(pool_, *formula, atoms_);
    if (!predicate) return is_bound = false;
    bound.timed.predicates.push_back(std::move(*predicate));
    return PropositionSet{1} << (bound.timed.predicates.size() - 1);
  };
  pattern.trigger = bit(claim.trigger);
  pattern.answer = bit(claim.answer);
  pattern.opening = bit(claim.opening);
  pattern.closing = bit(claim.closing);
  pattern.demand = claim.demand;
  pattern.from = claim.from;
  pattern.to = claim.to;
  pattern.must_open = claim.must_open;
  if (!is_bound) return refuse_size(property);
  const auto text = [&](std::optional<FormulaId> part) {
    return part ? formula_text(file_, *part) : std::string();
  };
  bound.timed.trigger = text(claim.trigger);
  bound.timed.answer = text(claim.answer);
  bound.timed.opening = text(claim.opening);
  bound.timed.closing = text(claim.closing);
  return true;
}

bool PropertyBinder::bind_claim(const Property& property,
                                BoundProperty& bound) {
  if (property.form == PropertyForm::Timed) return bind_timed(property, bound);
  if (property.form == PropertyForm::DeadlockFree) {
    bound.predicate = {Expression::constant(0), Expression::constant(1)};
    bound.predicate_text = "stuck";
    return true;
  }
  if (const auto trigger = trigger_of(property)) {
    if (auto predicate = predicate_of(pool_, *trigger, atoms_)) {
      bound.trigger =
          BoundTrigger{std::move(*predicate), formula_text(file_, *trigger)};
    }
  }
  if (const auto claim = state_claim(property)) {
    auto predicate = predicate_of(pool_, claim->formula, atoms_);
    if (!predicate) return refuse_size(property);
    bound.form = claim->form;
    bound.predicate = std::move(*predicate);
    bound.predicate_text = formula_text(file_, claim->formula);
    return true;
  }
  const bool is_branching = property.form == PropertyForm::Branching;
  if (is_branching && speaks_of_steps(pool_, property.formula, atoms_)) {
    return refuse("BT1223", property.span,
                  "events of steps have no place in branching time",
                  "write the property as LTL");
  }
  if (is_branching && bound_.assumptions.has_formula) {
    return refuse("BT1110", property.span,
                  fmt::format("`{}` is branching time, and an assumption is a "
                              "formula of LTL",
                              property.name),
                  "put the property into a file of its own, or assume only "
                  "fairness: `[] <> P => [] <> Q`");
  }
  auto formula = bind_formula(pool_, property.formula, atoms_);
  if (!formula) return refuse_size(property);
  bound.formula = std::move(*formula);
  return true;
}

// The formula that the assumed runs with the wanted or unwanted state violate.
FormulaId PropertyBinder::violated_by(const Property& property,
                                      const BoundProperty& bound) {
  const auto always_not = [&](FormulaId state) {
    return pool_.unary(FormulaKind::Always,
                       pool_.unary(FormulaKind::Not, state));
  };
  switch (bound.form) {
    case PropertyForm::Never:
    case PropertyForm::Possible:
    case PropertyForm::DeadlockFree:
      return always_not(atom_for(bound.predicate));
    case PropertyForm::Invariant:
      return pool_.unary(FormulaKind::Always, atom_for(bound.predicate));
    default:
      return property.formula;
  }
}

FormulaId PropertyBinder::under_assumptions(FormulaId claim) {
  if (!bound_.assumptions.has_formula) return claim;
  return pool_.binary(FormulaKind::Implies, assumption_, claim);
}

bool PropertyBinder::bind_assumed(const Property& property,
                                  BoundProperty& bound) {
  if (bound_.assumptions.empty() || bound.form == PropertyForm::Branching) {
    return true;
  }
  const std::size_t own_atoms = atoms_.size();
  UnderAssumptions assumed;
  FormulaId formula{};
  FormulaId due{};
  if (bound.form == PropertyForm::Timed) {
    // `due` must be a proposition of its own, whatever it stands for.
    due = atom_for({Expression::constant(0), {}});
    formula = pool_.binary(FormulaKind::And, assumption_,
                           pool_.unary(FormulaKind::Eventually,
                                       pool_.unary(FormulaKind::Always, due)));
  } else {
    formula = under_assumptions(violated_by(property, bound));
  }
  auto whole = bind_formula(pool_, formula, atoms_);
  atoms_.resize(own_atoms);
  const std::size_t more = bound.timed.predicates.size();
  if (!whole || whole->propositions.size() + more > kMaxPropositions) {
    return refuse_size(property);
  }
  assumed.formula = std::move(*whole);
  const auto place = std::find(assumed.formula.sources.begin(),
                               assumed.formula.sources.end(), due);
  assumed.due =
      static_cast<std::size_t>(place - assumed.formula.sources.begin());
  const auto occurrence =
      property.timed.trigger ? property.timed.trigger : property.timed.opening;
  if (bound.form == PropertyForm::Timed && occurrence) {
    assumed.without = bind_formula(
        pool_,
        under_assumptions(pool_.unary(
            FormulaKind::Always, pool_.unary(FormulaKind::Not, *occurrence))),
        atoms_);
  }
  bound.assumed = std::move(assumed);
  return true;
}

void PropertyBinder::bind(const Property& property) {
  BoundProperty bound;
  bound.property = &property;
  bound.form = property.form;
  if (!bind_claim(property, bound) || !bind_assumed(property, bound)) return;
  if (bound.form == PropertyForm::Ltl ||
      bound.form == PropertyForm::Branching) {
    bound.origins = origins(property, bound);
  }
  bound.subjects = subjects_of(property);
  bound.comparisons = open_of(property);
  bound_.properties.push_back(std::move(bound));
}

std::vector<PropositionOrigin> PropertyBinder::origins(
    const Property& property, const BoundProperty& bound) const {
  const BoundFormula& formula =
      bound.assumed ? bound.assumed->formula : bound.formula;
  const std::vector<FormulaId> own = pool_.nodes(property.formula);
  // Conditions over the ends of the scope and nothing else.
  std::vector<std::uint32_t> ends;
  for (const FormulaId end : property.scope_ends) {
    const std::vector<std::uint32_t> more = pool_.atoms(end);
    ends.insert(ends.end(), more.begin(), more.end());
  }
  std::sort(ends.begin(), ends.end());
  std::vector<PropositionOrigin> found;
  for (const FormulaId source : formula.sources) {
    const std::vector<std::uint32_t> atoms = pool_.atoms(source);
    const bool is_own = std::binary_search(own.begin(), own.end(), source);
    found.push_back(
        {is_own ? formula_text(file_, source) : std::string(),
         std::includes(ends.begin(), ends.end(), atoms.begin(), atoms.end())});
  }
  return found;
}

Subjects PropertyBinder::subjects_of(const Property& property) const {
  std::vector<StatePredicate> all;
  std::vector<StatePredicate> awaited;
  const auto add = [&](FormulaId formula, std::vector<StatePredicate>& to) {
    for (const std::uint32_t atom : pool_.atoms(formula)) {
      to.push_back(atoms_[atom].of);
    }
  };
  for (const FormulaId part : parts_of(property)) add(part, all);
  if (property.form == PropertyForm::Timed) {
    if (property.timed.demand == Demand::Answer ||
        property.timed.demand == Demand::FirstAnswer) {
      add(property.timed.answer, awaited);
    }
  } else if (property.form != PropertyForm::DeadlockFree) {
    const std::vector<Polarity> stands = polarities(pool_, property.formula);
    for (const FormulaId id : pool_.nodes(property.formula)) {
      if (pool_[id].kind == FormulaKind::Eventually &&
          stands[index(id)] == Polarity::Positive) {
        add(pool_[id].left, awaited);
      }
    }
  }
  return subjects(network_, all, awaited);
}

}  // namespace

Result<BoundFile> bind_properties(const BehaviorTree& tree,
                                  const Network& network,
                                  const PropertyFile& properties,
                                  const SourceText& source,
                                  ExtraAssumption extra) {
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

// SPDX-License-Identifier: MIT
#include "btcpp_random/naive_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "btcpp_random/progression.hpp"

namespace btcheck::reference {
namespace {

using Id = Obligations::Id;

std::string small(std::string word) {
  std::ranges::transform(word, word.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return word;
}

bool related(double left, Relation relation, double right) {
  switch (relation) {
    case Relation::Equal:
      return left == right;
    case Relation::NotEqual:
      return left != right;
    case Relation::Less:
      return left < right;
    case Relation::LessEqual:
      return left <= right;
    case Relation::Greater:
      return left > right;
    case Relation::GreaterEqual:
      break;
  }
  return left >= right;
}

// --- What holds in a state ---------------------------------------------------

// The atoms of a file in the states of a run so far; those of the past look
// back through all of them.
class Atoms {
 public:
  Atoms(const EngineRun& run, const PropertyFile& rules)
      : run_(run),
        rules_(rules),
        held_(rules.atoms.size()),
        began_(rules.atoms.size()) {}

  void add(const EngineState& state) {
    state_ = &state;
    truth_.clear();
    ends_.push_back(state.answers[0] != "none");
    for (std::size_t a = 0; a < rules_.atoms.size(); ++a) {
      const Atom& atom = rules_.atoms[a];
      if (is_past(atom.kind)) {
        held_[a].push_back(holds(atom.of));
        began_[a].push_back(atom.kind == AtomKind::Since && holds(atom.since));
      }
      truth_.push_back(is_past(atom.kind) ? remembers(a) : is_so(atom));
    }
  }

  // A formula without temporal operators, in the last state.
  bool holds(FormulaId formula) const {
    const FormulaNode& node = rules_.formulas[formula];
    const auto left = [&] { return holds(node.left); };
    const auto right = [&] { return holds(node.right); };
    switch (node.kind) {
      case FormulaKind::True:
        return true;
      case FormulaKind::False:
        return false;
      case FormulaKind::Atom:
        return truth_.at(node.atom);
      case FormulaKind::Not:
        return !left();
      case FormulaKind::And:
        return left() && right();
      case FormulaKind::Or:
        return left() || right();
      case FormulaKind::Implies:
        return !left() || right();
      case FormulaKind::Equivalent:
        return left() == right();
      default:
        throw std::runtime_error("no condition on states");
    }
  }

 private:
  bool remembers(std::size_t atom) const {
    const std::vector<bool>& held = held_[atom];
    const std::vector<bool>& began = began_[atom];
    const AtomKind kind = rules_.atoms[atom].kind;
    if (kind == AtomKind::Once) {
      return std::ranges::find(held, true) != held.end();
    }
    const std::size_t now = held.size() - 1;
    if (kind == AtomKind::Since) {
      for (std::size_t i = now + 1; i-- > 0;) {
        if (began[i]) return true;
        if (!held[i]) return false;
      }
      return false;
    }
    // Each tick has one state in which it ends.
    for (std::size_t i = now; i-- > 0;) {
      if (ends_[i]) return held[i];
    }
    return false;
  }

  std::size_t node_called(const std::string& name) const {
    if (small(name) == "root") return 0;
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      if (name == fmt::format("btn{}", n)) return n;
    }
    std::size_t found = 0;
    int count = 0;
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      if (run_.nodes[n].name != name) continue;
      found = n;
      ++count;
    }
    if (count == 1) return found;
    throw std::runtime_error("not one node is called " + name);
  }

  bool is_so(const Atom& atom) const {
    switch (atom.kind) {
      case AtomKind::NodeEvent:
        return has_event(node_called(atom.node), atom.word);
      case AtomKind::Comparison:
        return compares(atom);
      case AtomKind::Range: {
        const KeptValue& value = entry_called(atom.left.name);
        return value.is_number() && value.number >= atom.low.nearest() &&
               value.number <= atom.high.nearest();
      }
      default:
        break;
    }
    if (atom.word == "tick.ends") return ends_.back();
    throw std::runtime_error("not asked here: " + atom.text);
  }

  bool has_event(std::size_t node, const std::string& word) const {
    const std::string& here = state_->locations[node];
    const bool has_ended = here == "success" || here == "failure";
    if (word == "ended") return has_ended;
    if (word == "active") {
      if (node == 0) return !has_ended;
      return state_->called[node] || state_->statuses[node] == "running";
    }
    return here == (word == "ticked" ? "tick_node" : word);
  }

  bool compares(const Atom& atom) const {
    const auto is_of_node = [](const Operand& side) {
      return !side.node.empty();
    };
    if (is_of_node(atom.left)) {
      const std::size_t node = node_called(atom.left.node);
      const std::string& has = atom.left.name == "answer"
                                   ? state_->answers[node]
                                   : state_->statuses[node];
      const bool is_equal = has == small(atom.right.name);
      return atom.relation == Relation::Equal ? is_equal : !is_equal;
    }
    const KeptValue& value = entry_called(atom.left.name);
    std::optional<double> number;
    if (atom.right.is_number) number = atom.right.number.nearest();
    const std::string word = small(atom.right.name);
    if (word == "true") number = 1;
    if (word == "false") number = 0;
    if (number && value.is_number()) {
      return related(value.number, atom.relation, *number);
    }
    const bool is_equal = !number && small(value.word()) == word;
    if (atom.relation == Relation::Equal) return is_equal;
    return atom.relation == Relation::NotEqual && !is_equal;
  }

  const KeptValue& entry_called(const std::string& name) const {
    for (std::size_t e = 0; e < run_.entries.size(); ++e) {
      if (run_.entries[e] == name) return state_->entries[e];
    }
    throw std::runtime_error("no entry is called " + name);
  }

  const EngineRun& run_;
  const PropertyFile& rules_;
  const EngineState* state_ = nullptr;
  std::vector<bool> truth_;
  std::vector<bool> ends_;               // by state
  std::vector<std::vector<bool>> held_;  // by atom, by state
  std::vector<std::vector<bool>> began_;
};

// --- What a rule says --------------------------------------------------------

// A rule as a formula over conditions on states and, the last atom, whether a
// unit of time has passed since the state before.
class RuleWatch {
 public:
  RuleWatch(const PropertyFile& file, const Property& rule) : file_(file) {
    verdict_.rule = rule.name;
    const Id formula = made_of(rule);
    wanted_ = Obligations::begun(formula);
    unwanted_ = Obligations::begun(made_.negation(formula));
    look(EngineState{}, [] {});
  }

  void see(const EngineState& state, const Atoms& atoms, bool has_passed) {
    if (verdict_.verdict != "OPEN") return;
    std::vector<bool> truth(conditions_.size() + 1);
    truth[0] = has_passed;
    for (const auto& [formula, atom] : conditions_) {
      truth[atom] = atoms.holds(formula);
    }
    look(state, [&] {
      wanted_ = made_.after(wanted_, truth);
      unwanted_ = made_.after(unwanted_, truth);
    });
  }

  const NaiveVerdict& verdict() const { return verdict_; }

 private:
  // As a condition that could come out either way.
  Id condition(FormulaId formula) {
    const FormulaKind kind = file_.formulas[formula].kind;
    if (kind == FormulaKind::True) return made_.yes();
    if (kind == FormulaKind::False) return made_.no();
    const auto next = static_cast<std::uint32_t>(conditions_.size() + 1);
    const auto place = conditions_.emplace(formula, next).first;
    return made_.literal(place->second, true);
  }
  Id passed() { return made_.literal(0, true); }

  Id made_of(const Property& rule) {
    switch (rule.form) {
      case PropertyForm::Never:
        return made_.always(made_.negation(single(rule.formula)));
      case PropertyForm::Invariant:
        return made_.always(single(rule.formula));
      case PropertyForm::Possible:
        return made_.eventually(single(rule.formula));
      case PropertyForm::Ltl:
        return ltl(rule.formula);
      case PropertyForm::Timed:
        return timed(rule.timed);
      default:
        throw std::runtime_error("not asked here: " + rule.text);
    }
  }
  Id single(FormulaId formula) { return condition(formula); }

  Id ltl(FormulaId formula) {
    if (file_.formulas.is_state_formula(formula)) return condition(formula);
    const FormulaNode node = file_.formulas[formula];
    const Id left = ltl(node.left);
    if (node.kind == FormulaKind::Not) return made_.negation(left);
    if (node.kind == FormulaKind::Next) return made_.next(left);
    if (node.kind == FormulaKind::Eventually) return made_.eventually(left);
    if (node.kind == FormulaKind::Always) return made_.always(left);
    const Id right = ltl(node.right);
    switch (node.kind) {
      case FormulaKind::And:
        return made_.all({left, right});
      case FormulaKind::Or:
        return made_.some({left, right});
      case FormulaKind::Implies:
        return made_.implies(left, right);
      case FormulaKind::Equivalent:
        return made_.all(
            {made_.implies(left, right), made_.implies(right, left)});
      case FormulaKind::Until:
        return made_.until(left, right);
      case FormulaKind::WeakUntil:
        return made_.weak_until(left, right);
      case FormulaKind::Release:
        return made_.release(left, right);
      default:
        throw std::runtime_error("branching time");
    }
  }

  // P U_[from,to] Q: at some state, now or later, at such an age, Q; and P in
  // all states before it.
  Id until_within(int from, int to, Id p, Id q) {
    const Id pause = made_.negation(passed());
    if (from > 0) {
      const int left = to == kNoEnd ? kNoEnd : to - 1;
      const Id then = made_.all({passed(), until_within(from - 1, left, p, q)});
      return made_.all(
          {p, made_.next(made_.until(made_.all({pause, p}), then))});
    }
    if (to == kNoEnd) return made_.until(p, q);
    std::vector<Id> then = {made_.all({pause, q})};
    if (to > 0) {
      then.push_back(made_.all({passed(), until_within(0, to - 1, p, q)}));
    }
    const Id later = made_.until(made_.all({pause, p}), made_.some(then));
    return made_.some({q, made_.all({p, made_.next(later)})});
  }

  // The table of docs/properties.md, section 5.
  Id timed(const TimedClaim& claim) {
    const Id q = condition(claim.answer);
    const Id not_q = made_.negation(q);
    const auto within = [&](Id before, Id what) {
      return until_within(claim.from, claim.to, before, what);
    };
    Id not_closed = made_.yes();
    if (claim.closing) not_closed = made_.negation(condition(*claim.closing));
    Id asked = made_.no();
    switch (claim.demand) {
      case Demand::Answer:
        asked = within(not_closed, made_.all({q, not_closed}));
        break;
      case Demand::FirstAnswer:
        asked =
            within(made_.all({not_q, not_closed}), made_.all({q, not_closed}));
        break;
      case Demand::NoAnswer:
        asked = made_.negation(within(made_.yes(), q));
        break;
      case Demand::Lasting:
        asked = made_.negation(within(made_.yes(), not_q));
        break;
    }
    Id each = asked;
    if (claim.trigger) each = made_.implies(condition(*claim.trigger), asked);
    if (claim.closing) {
      const Id closes = condition(*claim.closing);
      return made_.implies(made_.eventually(closes), made_.until(each, closes));
    }
    const Id body = claim.trigger ? made_.always(each) : each;
    if (!claim.opening) return body;
    const Id opens = condition(*claim.opening);
    const Id begun = made_.all({opens, body});
    const Id shut = made_.negation(opens);
    return claim.must_open ? made_.until(shut, begun)
                           : made_.weak_until(shut, begun);
  }

  template <class Step>
  void look(const EngineState& state, Step step) {
    try {
      step();
      const bool may_hold = made_.is_satisfiable(wanted_);
      const bool may_fail = made_.is_satisfiable(unwanted_);
      if (may_hold && may_fail) return;
      verdict_.verdict = may_hold ? "SATISFIED" : "VIOLATED";
    } catch (const std::length_error&) {
      verdict_.verdict = "TOO LARGE";
    }
    verdict_.events = state.events;
    verdict_.records = state.records;
    verdict_.tick = state.tick;
  }

  const PropertyFile& file_;
  Obligations made_;
  std::map<FormulaId, std::uint32_t> conditions_;  // atoms, from 1
  Obligations::Left wanted_;  // what is left of the rule, and of its opposite
  Obligations::Left unwanted_;
  NaiveVerdict verdict_;
};

}  // namespace

std::vector<NaiveVerdict> naive_verdicts(const EngineRun& run,
                                         const PropertyFile& rules) {
  std::vector<RuleWatch> watches;
  watches.reserve(rules.properties.size());
  for (const Property& rule : rules.properties)
    watches.emplace_back(rules, rule);
  Atoms atoms(run, rules);
  int time = 0;
  play(run, [&](const EngineState& state) {
    atoms.add(state);
    for (RuleWatch& watch : watches) {
      watch.see(state, atoms, state.time > time);
    }
    time = state.time;
  });
  std::vector<NaiveVerdict> verdicts;
  for (const RuleWatch& watch : watches) verdicts.push_back(watch.verdict());
  return verdicts;
}

std::string shown(const NaiveVerdict& verdict) {
  std::string text = fmt::format("{} {}", verdict.rule, verdict.verdict);
  if (verdict.verdict != "SATISFIED" && verdict.verdict != "VIOLATED") {
    return text;
  }
  return text + fmt::format(" tick {} record {} event {}", verdict.tick,
                            verdict.records, verdict.events);
}

}  // namespace btcheck::reference

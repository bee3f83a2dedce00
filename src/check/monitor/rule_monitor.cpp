// SPDX-License-Identifier: MIT
//
// A rule about single states is the formula `[] P`, `[] not P` or `<> P`; under
// assumptions A a rule has been bound as A => F and is taken apart again.
#include "check/monitor/rule_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace btcheck {
namespace {

// What a rule asks for, as a formula over its propositions.
struct Claim {
  FormulaPool pool;
  FormulaId claim{};
  FormulaId assumed{};
  std::vector<Proposition> propositions;
};

// Of a rule about states alone.
Claim claim_about_states(const BoundProperty& rule) {
  Claim made;
  made.assumed = made.pool.constant(true);
  made.propositions = {{rule.predicate, PropositionKind::State, {}}};
  const FormulaId state = made.pool.atom(0);
  const bool is_wanted = rule.form == PropertyForm::Possible ||
                         rule.form == PropertyForm::Invariant;
  made.claim = made.pool.unary(
      rule.form == PropertyForm::Possible ? FormulaKind::Eventually
                                          : FormulaKind::Always,
      is_wanted ? state : made.pool.unary(FormulaKind::Not, state));
  return made;
}

Claim claim_of(const BoundProperty& rule, bool has_assumption) {
  const bool is_of_states = asks_of_states(rule.form);
  if (is_of_states && !(rule.is_assumed && has_assumption)) {
    return claim_about_states(rule);
  }
  Claim made;
  made.pool = rule.formula.pool;
  made.propositions = rule.formula.propositions;
  made.claim = rule.formula.formula;
  made.assumed = made.pool.constant(true);
  if (has_assumption) {
    const FormulaNode whole = made.pool[made.claim];
    made.assumed = whole.left;
    made.claim = whole.right;
  }
  // Of these the runs without such a state were bound.
  if (rule.form == PropertyForm::Possible) {
    made.claim = made.pool.unary(FormulaKind::Not, made.claim);
  }
  return made;
}

class Maker {
 public:
  Maker(const BoundFile& file, const SourceText& source)
      : file_(file), source_(source) {}

  Result<std::vector<RuleMonitor>> run() {
    for (const BoundProperty& rule : file_.properties) {
      if (auto made = monitor(rule)) monitors_.push_back(std::move(*made));
    }
    Result<std::vector<RuleMonitor>> result{std::nullopt, std::move(findings_)};
    if (!has_error(result.diagnostics)) result.value = std::move(monitors_);
    return result;
  }

 private:
  std::optional<RuleMonitor> monitor(const BoundProperty& rule) {
    if (rule.form == PropertyForm::Branching) {
      return refuse(rule, "BT1801", "`{}` speaks of several runs at once",
                    "no single run shows or breaks it: check the tree");
    }
    auto made = rule.form == PropertyForm::Timed ? timed(rule) : untimed(rule);
    if (made) warn_of_open(*made);
    return made;
  }

  std::optional<RuleMonitor> timed(const BoundProperty& rule) {
    RuleMonitor made{&rule, {}, rule.timed.predicates, 0};
    made.elapsed = PropositionSet{1} << made.propositions.size();
    auto monitor = monitor_of(rule.timed.pattern, made.elapsed);
    return finished(std::move(made), std::move(monitor));
  }

  std::optional<RuleMonitor> untimed(const BoundProperty& rule) {
    Claim claim = claim_of(rule, file_.assumptions.has_formula);
    RuleMonitor made{&rule, {}, {}, 0};
    for (Proposition& proposition : claim.propositions) {
      if (proposition.kind != PropositionKind::State) {
        return refuse(rule, "BT1802", "`{}` speaks of events of steps",
                      "a monitor sees states: write `once P` and `not P` for "
                      "`enter P`");
      }
      made.propositions.push_back(std::move(proposition.of));
    }
    auto monitor = monitor_of(claim.pool, claim.claim, claim.assumed);
    return finished(std::move(made), std::move(monitor));
  }

  std::optional<RuleMonitor> finished(RuleMonitor made,
                                      std::optional<Monitor> monitor) {
    if (!monitor) {
      return refuse(*made.rule, "BT1803", "`{}` is too large to be monitored",
                    "split it into several rules, or take shorter times");
    }
    made.monitor = std::move(*monitor);
    return made;
  }

  void warn_of_open(const RuleMonitor& made) {
    const Monitor& monitor = made.monitor;
    if (monitor.can_be(Outlook::Satisfied) ||
        monitor.can_be(Outlook::Violated)) {
      return;
    }
    add(Severity::Warning, *made.rule, "BT1804",
        "no beginning of a run shows or breaks `{}`",
        "it asks what happens in the end: give it a time, `within 10 ticks`");
  }

  std::nullopt_t refuse(const BoundProperty& rule, std::string_view code,
                        std::string_view message, std::string_view help) {
    add(Severity::Error, rule, code, message, help);
    return std::nullopt;
  }
  void add(Severity severity, const BoundProperty& rule, std::string_view code,
           std::string_view message, std::string_view help) {
    findings_.push_back(source_.diagnostic(
        severity, code, rule.property->span,
        fmt::format(fmt::runtime(message), rule.property->name), "",
        std::string(help)));
  }

  const BoundFile& file_;
  const SourceText& source_;
  std::vector<RuleMonitor> monitors_;
  std::vector<Diagnostic> findings_;
};

}  // namespace

Result<std::vector<RuleMonitor>> monitors_of(const BoundFile& file,
                                             const SourceText& source) {
  return Maker(file, source).run();
}

RunMonitor::RunMonitor(const Network& network,
                       const std::vector<RuleMonitor>& rules)
    : interpreter_(network), monitors_(rules) {
  for (const RuleMonitor& rule : rules) {
    seen_.push_back({MonitorRun(rule.monitor), std::nullopt});
  }
}

void RunMonitor::see(const Valuation& state, int elapsed) {
  for (std::size_t i = 0; i < monitors_.size(); ++i) {
    Seen& seen = seen_[i];
    if (seen.run.outlook() != Outlook::Open) continue;
    const RuleMonitor& rule = monitors_[i];
    PropositionSet label = 0;
    for (std::size_t p = 0; p < rule.propositions.size(); ++p) {
      const bool holds = interpreter_.is_true(rule.propositions[p], state);
      if (holds) label |= PropositionSet{1} << p;
    }
    const PropositionSet passed = elapsed > 0 ? rule.elapsed : 0;
    if (seen.run.read(label | passed) != Outlook::Open) seen.decided = states_;
  }
  ++states_;
}

}  // namespace btcheck

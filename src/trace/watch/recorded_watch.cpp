// SPDX-License-Identifier: MIT
//
// Where something is not known, every way that it could be is tried: a rule is
// broken when it is broken in all of them.
#include "trace/watch/recorded_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "check/bind/bind.hpp"
#include "check/bind/remembered.hpp"
#include "model/automata/past_memory.hpp"
#include "model/automata/tick_memory.hpp"

namespace btcheck {
namespace {

// Conditions with more ways than these are not known.
constexpr std::size_t kMostWays = 4096;

// What a recording cannot say: each cause once, with all that asks for it.
class Unshown {
 public:
  Unshown(const RecordedRun& run, Recording recording,
          const PropertyFile& rules, const SourceText& source)
      : is_log_(recording != Recording::Run),
        is_marked_(recording == Recording::MarkedLog),
        rules_(rules),
        source_(source) {
    if (is_marked_) entries_ = entry_names(run.variables);
  }

  std::vector<Diagnostic> find() {
    for (const Atom& atom : rules_.atoms) look_at(atom);
    for (const Property& rule : rules_.properties) look_at(rule);
    std::vector<Diagnostic> findings;
    for (const Cause& cause : causes_) {
      findings.push_back(
          source_.diagnostic(Severity::Error, "BT1805", cause.span,
                             std::string(cause.message) + list_of(cause.asked),
                             "", std::string(cause.help)));
    }
    return findings;
  }

 private:
  void look_at(const Atom& atom) {
    const bool is_end = atom.kind == AtomKind::Keyword &&
                        (atom.word == "dead" || atom.word == "stuck");
    if (is_end) {
      refuse(atom.span, "a recording does not show ", atom.text,
             "it ends, and says not why: write `root.ended`");
    }
    if (!is_log_) return;
    look_at_entries(atom);
    bool asks_skipped =
        atom.kind == AtomKind::NodeEvent && atom.word == "skipped";
    visit_leaves(atom, [&](const Operand& side) {
      asks_skipped |= side.node.empty() && side.name == "skipped";
      if (side.node.empty() || side.name == "status" ||
          side.name == "rstatus" || side.name == kAnswerName) {
        return;
      }
      refuse(atom.span, "a log does not show ",
             fmt::format("{}.{}", side.node, side.name),
             "it has statuses: write `.status`, `.answer`, `.active` or an "
             "event");
    });
    if (asks_skipped && !is_marked_) {
      refuse(atom.span, "a log does not show ", atom.text,
             "the engine logs nothing of a node that is skipped");
    }
  }

  // What two of them have in common is not told by what each is compared with.
  void look_at_entries(const Atom& atom) {
    std::vector<std::string> asked;
    visit_leaves(atom, [&](const Operand& side) {
      const bool is_entry =
          side.node.empty() &&
          std::ranges::any_of(entries_, [&](const std::string& entry) {
            return equal_ignoring_case(entry, side.name);
          });
      if (is_entry) asked.push_back(side.name);
    });
    if (asked.size() < 2) return;
    refuse(atom.span,
           "entries of a log are not compared with each other: ", atom.text,
           "compare each with a number or a word");
  }

  void look_at(const Property& rule) {
    if (rule.form == PropertyForm::DeadlockFree) {
      refuse(rule.span,
             "a recording does not show that nothing can happen, as asked by ",
             rule.name, "check the tree");
    }
    if (is_log_ && rule.form == PropertyForm::Ltl &&
        rules_.formulas.has_next(rule.formula)) {
      refuse(rule.span,
             "a log does not show single steps, which are asked for by ",
             rule.name, "write it without `X`");
    }
  }

  struct Cause {
    SourceSpan span;
    std::string_view message;  // what stands before those who ask
    std::string_view help;     // it is the cause's own
    std::vector<std::string> asked = {};
  };

  void refuse(SourceSpan span, std::string_view message, std::string asked,
              std::string_view help) {
    auto cause = std::ranges::find(causes_, help, &Cause::help);
    if (cause == causes_.end()) {
      cause = causes_.insert(cause, Cause{span, message, help});
    }
    if (std::ranges::find(cause->asked, asked) == cause->asked.end()) {
      cause->asked.push_back(std::move(asked));
    }
  }

  // "`a`, `b` and 5 more".
  static std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t kMostNamed = 3;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) {
      const bool is_last = i > 0 && i + 1 == names.size();
      list += is_last ? " and " : i > 0 ? ", " : "";
      list += "`" + names[i] + "`";
    }
    if (names.size() <= kMostNamed) return list;
    return list + fmt::format(" and {} more", names.size() - kMostNamed);
  }

  bool is_log_;
  bool is_marked_;
  std::vector<std::string> entries_;
  const PropertyFile& rules_;
  const SourceText& source_;
  std::vector<Cause> causes_;
};

// A log has no variables but the entries that the observer writes, so a name
// that fits nothing may well be one.
void explain_names(std::vector<Diagnostic>& findings) {
  for (Diagnostic& found : findings) {
    const bool is_unknown = found.code == "BT1101" || found.code == "BT1105";
    if (is_unknown && found.help.empty()) {
      found.help = "a log has nodes and no variables";
    }
  }
}

Truth truth_of(bool some_hold, bool some_fail) {
  if (some_hold && some_fail) return Truth::Unknown;
  return some_hold ? Truth::Yes : Truth::No;
}

int answer_code(std::string_view word) {
  const auto place = std::ranges::find(
      kAnswers, word, &std::pair<LocationRole, std::string_view>::second);
  return place == kAnswers.end()
             ? kNoAnswer
             : 1 + static_cast<int>(place - kAnswers.begin());
}

}  // namespace

Result<std::unique_ptr<RecordedWatch>> RecordedWatch::make(
    const RecordedRun& run, Recording recording, const PropertyFile& rules,
    const SourceText& source) {
  Result<std::unique_ptr<RecordedWatch>> result{
      std::nullopt, Unshown(run, recording, rules, source).find()};
  std::vector<Diagnostic>& findings = result.diagnostics;
  const std::string ticks = run.ticks.empty() ? "root" : run.ticks;
  if (rules.ticks && *rules.ticks != ticks) {
    findings.push_back(source.diagnostic(
        Severity::Error, "BT1805", {},
        fmt::format("the rules count time at `{}`, the run at `{}`",
                    *rules.ticks, ticks),
        "", "leave the line `tick` out"));
  }
  const auto roots = std::ranges::count_if(
      run.nodes, [](const auto& node) { return !node.parent; });
  if (recording != Recording::Run && roots > 1) {
    findings.push_back(source.diagnostic(Severity::Error, "BT1805", {},
                                         "a log has one tree, not several"));
  }
  if (has_error(findings)) return result;
  std::unique_ptr<RecordedWatch> made(new RecordedWatch(run, rules));
  Network& network = made->network_.network();
  remember_for(made->network_.tree(), rules, network);
  auto bound = bind_properties(made->network_.tree(), network, rules, source,
                               ExtraAssumption::None);
  if (recording == Recording::Log) explain_names(bound.diagnostics);
  findings = std::move(bound.diagnostics);
  if (!bound.value) return result;
  made->bound_ = std::move(*bound.value);
  auto monitors = monitors_of(made->bound_, source);
  std::ranges::move(monitors.diagnostics, std::back_inserter(findings));
  if (!monitors.value) return result;
  made->monitors_ = std::move(*monitors.value);
  for (const RuleMonitor& rule : made->monitors_) {
    made->seen_.push_back({rule.rule, MonitorRun(rule.monitor), {}, false});
  }
  made->bind_memory(source);
  made->find_asked();
  result.value = std::move(made);
  return result;
}

void RecordedWatch::bind_memory(const SourceText& source) {
  const BehaviorTree& tree = network_.tree();
  const Network& network = network_.network();
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    root_of_.push_back(index(root_of(tree, NodeId{n})));
  }
  answers_.resize(tree.nodes.size(), 1U << kNoAnswer);
  others_.resize(network.variables.size());
  has_ended_tick_.resize(nodes_, false);
  std::vector<Diagnostic> known_already;
  Binder binder(tree, network, source, known_already);
  std::vector<Proposition> known;
  for (std::uint32_t number = 0; number < rules_.atoms.size(); ++number) {
    const Atom& atom = rules_.atoms[number];
    known.push_back(binder.proposition(rules_, number, known));
    binder.take_given();
    if (!is_past(atom.kind)) continue;
    const auto meant = [&](FormulaId formula) {
      auto predicate = predicate_of(rules_.formulas, formula, known);
      return predicate ? std::move(predicate->expression)
                       : Expression::constant(0);
    };
    Past past;
    past.kind = atom.kind;
    past.bit = past_memory(network, past_key(rules_, number)).value();
    past.held = meant(atom.of);
    if (atom.kind == AtomKind::Since) past.began = meant(atom.since);
    past_.push_back(std::move(past));
  }
}

void RecordedWatch::find_asked() {
  const Network& network = network_.network();
  std::vector<bool> is_asked(nodes_, false);
  const auto note = [&](const Expression& expression) {
    for (const Term& term : expression.terms()) {
      if (term.operation != Operation::Variable) continue;
      const Variable& known = network.variable(
          VariableId{static_cast<std::uint32_t>(term.operand)});
      if (!known.owner) continue;
      const Automaton& owner = network.automaton(*known.owner);
      if (owner.kind == AutomatonKind::Node) is_asked[index(owner.node)] = true;
    }
  };
  for (const RuleMonitor& rule : monitors_) {
    for (const auto& asked : rule.propositions) note(asked.expression);
    for (const PropertyAtom& atom : rule.rule->atoms) {
      note(atom.is.of.expression);
    }
  }
  for (const Past& past : past_) {
    note(past.held);
    note(past.began);
  }
  for (const NodeId root : network_.tree().roots) is_asked[index(root)] = true;
  for (std::size_t n = 0; n < nodes_; ++n) {
    if (is_asked[n]) asked_.push_back(n);
  }
}

void RecordedWatch::may_be(VariableId variable, int value) {
  std::vector<int>& others = others_[index(variable)];
  if (others.empty()) open_.push_back(variable);
  if (std::ranges::find(others, value) == others.end()) others.push_back(value);
}

void RecordedWatch::begin(const RecordedState& state) {
  moment_.others.clear();
  moment_.answers.clear();
  moment_.ended.clear();
  network_.read(state, asked_, valuation_);
  moment_.values = valuation_.variables;
  moment_.has_passed = state.time > time_;
  time_ = state.time;
  note_answers(state);
}

// What is answered in this state. It is forgotten with the step that follows
// the root's own answer.
void RecordedWatch::note_answers(const RecordedState& state) {
  const bool is_first = locations_.empty();
  for (const NodeId root : network_.tree().roots) {
    if (has_ended_tick_[index(root)]) moment_.ended.push_back(index(root));
  }
  locations_.resize(nodes_);
  for (const std::size_t n : asked_) {
    const bool is_new = is_first || locations_[n] != state.locations[n];
    const int code = is_new ? answer_code(state.locations[n]) : kNoAnswer;
    if (code != kNoAnswer) moment_.answers.emplace_back(n, code);
    has_ended_tick_[n] = code != kNoAnswer && root_of_[n] == n;
    if (is_new) locations_[n] = state.locations[n];
  }
  moment_.ends_tick = has_ended_tick_[index(network_.tree().roots[0])];
}

void RecordedWatch::note_unseen(std::size_t node, Unseen unseen,
                                const RecordedState& state) {
  if (unseen == Unseen::Nothing) return;
  if (unseen == Unseen::Anything) return note_anything(node);
  const Network& network = network_.network();
  const NodeId id{static_cast<std::uint32_t>(node)};
  const auto any_of = [&](VariableId variable) {
    const Variable& known = network.variable(variable);
    for (int value = known.min; value <= known.max; ++value) {
      moment_.others.emplace_back(variable, value);
    }
  };
  if (unseen == Unseen::Status) return any_of(network.node_status[node]);
  const auto also = [&](std::string_view name) {
    moment_.others.emplace_back(network_.location(node),
                                RecordedNetwork::location_number(name));
  };
  if (unseen == Unseen::Halted) return also("halted");
  const auto answers = [&](std::string_view answered) {
    also(answered);
    const auto answer = answer_of(network, id);
    if (answer) moment_.others.emplace_back(*answer, answer_code(answered));
  };
  const std::string& before = state.statuses[node];
  const bool may_answer = unseen != Unseen::Skipped &&
                          (unseen != Unseen::Called || before != "idle");
  const bool may_skip = unseen == Unseen::Skipped ||
                        (unseen == Unseen::Called && before != "running");
  if (unseen != Unseen::Skipped) also("tick_node");
  const auto caller = network.node_caller[node];
  if (unseen == Unseen::Called && caller) any_of(*caller);
  if (may_answer) answers(before);
  if (may_skip) answers("skipped");
  also("done");
}

void RecordedWatch::note_anything(std::size_t node) {
  const Network& network = network_.network();
  const NodeId id{static_cast<std::uint32_t>(node)};
  std::vector<VariableId> variables = {network_.location(node),
                                       network.node_status[node]};
  if (const auto caller = network.node_caller[node]) {
    variables.push_back(*caller);
  }
  if (const auto answer = answer_of(network, id)) variables.push_back(*answer);
  for (const VariableId variable : variables) {
    const Variable& known = network.variable(variable);
    for (int value = known.min; value <= known.max; ++value) {
      moment_.others.emplace_back(variable, value);
    }
  }
}

// What an expression comes to, for all values that its variables may have.
Truth RecordedWatch::truth(const Expression& expression) const {
  std::vector<VariableId> asked;
  std::size_t ways = 1;
  for (const Term& term : expression.terms()) {
    if (term.operation != Operation::Variable) continue;
    const VariableId variable{static_cast<std::uint32_t>(term.operand)};
    const std::size_t others = others_[index(variable)].size();
    if (others == 0 || std::ranges::count(asked, variable) > 0) continue;
    asked.push_back(variable);
    ways *= others + 1;
    if (ways > kMostWays) return Truth::Unknown;
  }
  std::vector<std::size_t> way(asked.size(), 0);
  const auto value = [&](const Term& term) -> std::int64_t {
    const VariableId variable{static_cast<std::uint32_t>(term.operand)};
    const auto place = std::ranges::find(asked, variable);
    const std::size_t turn =
        place == asked.end()
            ? 0
            : way[static_cast<std::size_t>(place - asked.begin())];
    return turn == 0 ? valuation_.variables[index(variable)]
                     : others_[index(variable)][turn - 1];
  };
  bool some_hold = false;
  bool some_fail = false;
  for (std::size_t i = 0; i < ways && !(some_hold && some_fail); ++i) {
    std::size_t rest = i;
    for (std::size_t a = 0; a < asked.size(); ++a) {
      const std::size_t count = others_[index(asked[a])].size() + 1;
      way[a] = rest % count;
      rest /= count;
    }
    (expression.evaluate(value) != 0 ? some_hold : some_fail) = true;
  }
  return truth_of(some_hold, some_fail);
}

// What is remembered where something may not have been: what it was, or what
// it has become.
bool RecordedWatch::note_past(bool is_tick_end, bool is_possible) {
  const auto either = [](Truth one, Truth other) {
    if (one == Truth::Yes || other == Truth::Yes) return Truth::Yes;
    return one == Truth::No && other == Truth::No ? Truth::No : Truth::Unknown;
  };
  const auto both_of = [](Truth one, Truth other) {
    if (one == Truth::No || other == Truth::No) return Truth::No;
    return one == Truth::Yes && other == Truth::Yes ? Truth::Yes
                                                    : Truth::Unknown;
  };
  bool has_changed = false;
  for (Past& past : past_) {
    Truth now = past.now;
    if (past.kind == AtomKind::Once) {
      now = either(truth(past.held), now);
    } else if (past.kind == AtomKind::Since) {
      now = either(truth(past.began), both_of(truth(past.held), now));
    }
    valuation_.variables[index(past.bit)] = now == Truth::Yes ? 1 : 0;
    if (now == Truth::Unknown) may_be(past.bit, 1);
    // What holds where this tick ends is told from the next state on.
    if (past.kind == AtomKind::Previously && is_tick_end) {
      now = truth(past.held);
    }
    if (is_possible && now != past.now) now = Truth::Unknown;
    has_changed |= now != past.now;
    past.now = now;
  }
  return has_changed;
}

bool RecordedWatch::take_answers(const Moment& moment, bool is_possible) {
  const std::vector<unsigned> before =
      is_possible ? answers_ : std::vector<unsigned>{};
  const auto set = [&](std::size_t node, int code) {
    if (!is_possible) answers_[node] = 0;
    answers_[node] |= 1U << code;
  };
  for (const std::size_t root : moment.ended) {
    for (const std::size_t n : asked_) {
      if (root_of_[n] == root) set(n, kNoAnswer);
    }
  }
  for (const auto& [node, code] : moment.answers) set(node, code);
  for (const std::size_t n : asked_) {
    const auto answer =
        answer_of(network_.network(), NodeId{static_cast<std::uint32_t>(n)});
    if (!answer) continue;
    // Whose state this is has what it answers there.
    unsigned codes = answers_[n];
    for (const auto& [node, code] : moment.answers) {
      if (node == n) codes = 1U << code;
    }
    const int first = std::countr_zero(codes);
    valuation_.variables[index(*answer)] = first;
    for (int code = first + 1; codes >> code != 0; ++code) {
      if ((codes >> code & 1) != 0) may_be(*answer, code);
    }
  }
  return is_possible && before != answers_;
}

// Whether a condition asks for what is remembered of a tick, or of the past.
bool RecordedWatch::remembers(const Expression& condition) const {
  return std::ranges::any_of(condition.terms(), [&](const Term& term) {
    if (term.operation != Operation::Variable) return false;
    const VariableId variable{static_cast<std::uint32_t>(term.operand)};
    const SlotKind kind = meaning(variable).first;
    return kind == SlotKind::Answer || kind == SlotKind::Remembered;
  });
}

// One more label of a rule's run; true where more ways are followed.
bool RecordedWatch::read(std::size_t rule, bool has_passed, bool is_possible) {
  Seen& seen = seen_[rule];
  if (seen.run.outlook() != Outlook::Open) return false;
  const RuleMonitor& monitor = monitors_[rule];
  PropositionSet label = has_passed ? monitor.elapsed : 0;
  PropositionSet unknown = 0;
  for (std::size_t p = 0; p < monitor.propositions.size(); ++p) {
    const Truth now = truth(monitor.propositions[p].expression);
    if (now == Truth::Yes) label |= PropositionSet{1} << p;
    if (now != Truth::Unknown) continue;
    unknown |= PropositionSet{1} << p;
    seen.has_ways |=
        has_doubts_ && remembers(monitor.propositions[p].expression);
  }
  seen.has_unknown |= unknown != 0;
  const std::size_t before = seen.run.ways();
  if (is_possible) {
    seen.run.read_more(label, unknown);
  } else {
    seen.run.read(label, unknown);
  }
  if (unknown != 0) seen.run.read_more(label & ~monitor.elapsed, unknown);
  if (seen.run.outlook() != Outlook::Open) seen.decided = states_;
  const bool has_more = is_possible && seen.run.ways() > before;
  seen.has_ways |= has_more;
  return has_more;
}

// True where that leaves more open than before.
bool RecordedWatch::take(const Moment& moment, bool is_possible) {
  for (const VariableId variable : open_) others_[index(variable)].clear();
  open_.clear();
  valuation_.variables = moment.values;
  bool is_more = take_answers(moment, is_possible);
  for (const auto& [variable, value] : moment.others) may_be(variable, value);
  is_more |= note_past(moment.ends_tick, is_possible);
  has_doubts_ |= is_possible && is_more;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    is_more |= read(i, moment.has_passed, is_possible);
  }
  return is_more;
}

void RecordedWatch::finish(bool is_possible) {
  if (is_possible) {
    loop_.push_back(moment_);
  } else {
    for (bool is_more = !loop_.empty(); is_more;) {
      is_more = false;
      for (const Moment& moment : loop_) is_more |= take(moment, true);
    }
    loop_.clear();
    take(moment_, false);
  }
  ++states_;
}

std::pair<RecordedWatch::SlotKind, std::size_t> RecordedWatch::meaning(
    VariableId variable) const {
  const Network& network = network_.network();
  const Variable& known = network.variable(variable);
  std::size_t node = 0;
  if (known.owner) node = index(network.automaton(*known.owner).node);
  switch (known.role) {
    case VariableRole::Location:
      return {SlotKind::Location, node};
    case VariableRole::Status:
      return {SlotKind::LastStatus, node};
    case VariableRole::Caller:
      return {SlotKind::Called, node};
    case VariableRole::State:
    case VariableRole::Local:
    case VariableRole::Fault:
      break;
  }
  const auto& entries = network.state_variable;
  const auto entry = std::ranges::find(entries, variable);
  if (entry != entries.end()) {
    return {SlotKind::Entry, static_cast<std::size_t>(entry - entries.begin())};
  }
  return {known.name == kAnswerName ? SlotKind::Answer : SlotKind::Remembered,
          node};
}

std::vector<std::string> RecordedWatch::texts(std::size_t rule) const {
  std::vector<std::string> texts;
  for (const PropertyAtom& atom : monitors_[rule].rule->atoms) {
    texts.push_back(atom.text);
  }
  return texts;
}

std::vector<bool> RecordedWatch::truths(std::size_t rule) const {
  std::vector<bool> truths;
  for (const PropertyAtom& atom : monitors_[rule].rule->atoms) {
    truths.push_back(truth(atom.is.of.expression) == Truth::Yes);
  }
  return truths;
}

}  // namespace btcheck

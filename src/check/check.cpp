// SPDX-License-Identifier: MIT
//
// Tree → network → transition system; properties → predicates and automata;
// search → replayed runs → verdicts. Reading comes first for all inputs, then
// binding, then the searches.
#include "check/check.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "check/bind/name_help.hpp"
#include "check/doubt.hpp"
#include "check/findings/findings.hpp"
#include "check/findings/judgement.hpp"
#include "check/parts/in_parts.hpp"
#include "check/questions/earlier.hpp"
#include "check/questions/lint.hpp"
#include "check/rules_network.hpp"
#include "check/search/engine.hpp"
#include "explore/state/spent.hpp"
#include "ltl/rules/compared.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// The default report first tries a search that tells of shortest runs, of every
// value, and then of those that something reads: of as many steps, but without
// what a long tree carries along.
struct Attempt {
  Reduction reduction;
  std::uint64_t most_states;
};
constexpr Attempt kAttempts[] = {{Reduction::None, 65'536},
                                 {Reduction::Live, 200'000}};
// Where a tree is this small to a reduced search, one of the whole costs less
// than many of its parts.
constexpr std::uint64_t kStatesBeforeParts = 65'536;
// Beside rules it is one of so many states.
constexpr std::uint64_t kStatesBesideRules = 30'000;

void add(std::vector<Diagnostic>& to, std::vector<Diagnostic> found) {
  to.insert(to.end(), std::make_move_iterator(found.begin()),
            std::make_move_iterator(found.end()));
}

TickSemantics ticks_for(const CheckOptions& options,
                        const PropertyFile* properties) {
  if (options.ticks) return *options.ticks;
  if (properties != nullptr && properties->ticks) {
    return tick_semantics(*properties->ticks).value_or(TickSemantics::Root);
  }
  return TickSemantics::Root;
}

// A property file with everything bound, ready to be searched.
CheckedFile prepare(const BehaviorTree& tree, const SourceText& source,
                    const InputFile& input, PropertyFile rules,
                    const CheckOptions& options,
                    std::vector<Diagnostic>& diagnostics) {
  CheckedFile checked;
  checked.properties = std::make_unique<PropertyFile>(std::move(rules));
  auto made = network_for(tree, source, *checked.properties,
                          SourceText(input.name, input.text),
                          ticks_for(options, checked.properties.get()),
                          options.extra, options.most_whole);
  add(diagnostics, std::move(made.diagnostics));
  if (!made.value) return checked;
  checked.network = std::move(made.value->network);
  checked.bound = std::move(made.value->bound);
  if (options.start) {
    add(diagnostics, options.start(tree, *checked.network));
  }
  return checked;
}

// Without rules: the default report.
CheckedFile prepare_defaults(const BehaviorTree& tree, const SourceText& source,
                             const CheckOptions& options,
                             std::vector<Diagnostic>& diagnostics) {
  CheckedFile checked;
  const Lowering lowered = lowering(tree, ticks_for(options, nullptr));
  checked.network = std::make_unique<Network>(
      lower_to_bind(tree, lowered, options.most_whole));
  add(diagnostics, sample_regions(tree, source, {}, lowered, *checked.network,
                                  options.most_whole));
  if (options.start) {
    add(diagnostics, options.start(tree, *checked.network));
  }
  return checked;
}

// The default report of a tree that was checked before.
std::optional<EarlierReport> report_of(const CheckResult* earlier) {
  if (earlier == nullptr || !earlier->tree || earlier->files.empty()) {
    return std::nullopt;
  }
  const CheckedFile& file = earlier->files.front();
  if (!file.defaults) return std::nullopt;
  return EarlierReport{*earlier->tree, *file.network, *file.defaults};
}

// What an attempt has found that was given up stays known where the limits end
// the next one.
DefaultReport default_answers(const BehaviorTree& tree,
                              const CompiledNetwork& system,
                              const CheckOptions& options) {
  const std::uint64_t most = options.limits.max_states;
  const auto earlier = report_of(options.earlier);
  // A much smaller one may be searched as a whole.
  const bool is_large = earlier && earlier->report.searches > 0 &&
                        2 * tree.nodes.size() > earlier->tree.nodes.size();
  std::optional<DefaultReport> known;
  const auto attempt = [&](auto made, auto... how) {
    try {
      DefaultReport report = made(tree, system, how...);
      if (known) add_known(tree, std::move(*known), report);
      known = std::move(report);
    } catch (const BudgetSpent& spent) {
      if (!known) throw;
      known->stopped = stop_reason(spent.spent());
    }
  };
  // Whether that was all.
  const auto does = [&](Reduction reduction, std::uint64_t most_states) {
    Limits few = options.limits;
    few.max_states = std::min(most, most_states);
    attempt(check_defaults, reduction, few, Sampling::None, 1U);
    return known->stopped != StopReason::MaxStates || most <= most_states;
  };
  for (const auto& [reduction, most_states] : kAttempts) {
    if (!options.wants_shortest || is_large ||
        reduction >= options.choices.reduction) {
      continue;
    }
    if (does(reduction, most_states)) return std::move(*known);
  }
  if (options.choices.reduction == Reduction::Full && !options.start &&
      options.choices.parts != PartsUse::Never) {
    if (!is_large && does(Reduction::Full, kStatesBeforeParts)) {
      return std::move(*known);
    }
    // What the attempts have seen, the shortest runs among it.
    std::optional<EarlierReport> seen = earlier;
    if (known) seen.emplace(EarlierReport{tree, system.network(), *known});
    attempt(check_defaults_in_parts, options.limits,
            options.choices.components.get(), kNodesTogether,
            seen ? &*seen : nullptr);
    if (known->stopped != StopReason::MaxStates) return std::move(*known);
  }
  attempt(check_defaults, options.choices.reduction, options.limits,
          Sampling::WhenLong, options.choices.threads);
  return std::move(*known);
}

// What else is found in a tree that has rules, as far as it costs little.
void find_beside_rules(const BehaviorTree& tree, const CompiledNetwork& system,
                       const CheckOptions& options, CheckedFile& checked) {
  Limits few = options.limits;
  few.max_states = std::min(few.max_states, kStatesBesideRules);
  try {
    DefaultReport report = check_defaults(tree, system, Reduction::None, few);
    checked.findings = std::move(report.findings);
    checked.findings_are_whole =
        report.stopped == StopReason::None && report.error.empty();
  } catch (const BudgetSpent&) {
    // The verdicts are told without them.
  }
}

void search(const BehaviorTree& tree, CheckedFile& checked,
            const CheckOptions& options, bool is_first) {
  const CompiledNetwork system(*checked.network);
  if (checked.properties) {
    SearchChoices choices = options.choices;
    if (options.start) choices.parts = PartsUse::Never;
    Verification verification =
        verify(system, checked.bound, choices, options.limits);
    checked.verdicts = std::move(verification.verdicts);
    checked.has_faults = verification.has_faults;
    // Other rules would be asked from the beginning.
    checked.advice.resize(checked.verdicts.size());
    try {
      if (!options.start) {
        checked.advice =
            tick_advice(tree, *checked.properties, *checked.network,
                        options.choices, options.limits, checked.verdicts);
      }
      // Only over entries may a run be none of the engine.
      if (checked.has_faults && tree.programs) {
        checked.fault = run_to_fault(system, options.choices, options.limits);
      }
    } catch (const BudgetSpent&) {
      // What makes verdicts clearer is left out.
    }
    if (is_first && !options.start) {
      find_beside_rules(tree, system, options, checked);
    }
  } else {
    checked.defaults = default_answers(tree, system, options);
    checked.findings = std::move(checked.defaults->findings);
  }
}

// The reader says what is never ticked as well (BT1629).
void leave_out_told(const std::vector<TreeFinding>& findings,
                    const BehaviorTree& tree,
                    std::vector<Diagnostic>& diagnostics) {
  const auto is_at = [&](NodeId node, const Diagnostic& found) {
    const SourceSpan& span = tree.node(node).span;
    return tree.file_of(node) == found.file && span.line == found.span.line &&
           span.column == found.span.column;
  };
  std::erase_if(diagnostics, [&](const Diagnostic& found) {
    if (found.code != "BT1629") return false;
    return std::ranges::any_of(findings, [&](const TreeFinding& each) {
      return is_at(each.node, found) ||
             std::ranges::any_of(each.others, [&](NodeId other) {
               return is_at(other, found);
             });
    });
  });
}

std::vector<InputFile> sources_of(const TreeInput& tree) {
  std::vector<InputFile> sources = {{tree.name, tree.text}};
  for (const auto* files : {&tree.reading.included, &tree.reading.neighbours}) {
    for (const InputFile& file : *files) {
      sources.push_back({file.name, file.text});
    }
  }
  return sources;
}

std::vector<SourceText> texts_of(const std::vector<InputFile>& files) {
  std::vector<SourceText> texts;
  for (const InputFile& file : files) texts.emplace_back(file.name, file.text);
  return texts;
}

// Everything was looked for, and all of it.
bool is_whole(const CheckResult& result) {
  return !result.files.empty() && result.files[0].defaults &&
         result.files[0].defaults->stopped == StopReason::None;
}

// Its answers stand at the root.
void judge_mission(const BehaviorTree& tree, FindingsJudge& judging,
                   DefaultReport& report) {
  for (TreeReport& answer : report.tree) {
    if (!is_bad(answer)) continue;
    Severity severity = severity_of(answer);
    answer.is_meant = !judging.judge(code_of(answer.question), tree,
                                     tree.roots[0], severity, Severity::Note);
    answer.severity = severity;
  }
}

// Beside rules a fault is a warning: none of them speaks of it.
void judge_fault(const BehaviorTree& tree, FindingsJudge& judging,
                 CheckedFile& file) {
  Severity severity = Severity::Warning;
  if (judging.judge("BT2101", tree, tree.roots[0], severity, Severity::Note)) {
    file.fault_level = severity;
  }
}

// What the user has said of the findings.
void judge(const Judgement& said, const std::vector<InputFile>& properties,
           CheckResult& result) {
  const std::vector<SourceText> sources = texts_of(result.sources);
  FindingsJudge judging(said, sources);
  for (CheckedFile& file : result.files) {
    leave_out_told(file.findings, *result.tree, result.diagnostics);
    // Beside rules notes are not told.
    judging.judge(file.findings, *result.tree,
                  file.properties ? Severity::Warning : Severity::Note);
    fold_many(file.findings);
    if (file.defaults) judge_mission(*result.tree, judging, *file.defaults);
    if (file.has_faults) judge_fault(*result.tree, judging, file);
  }
  result.is_broken = has_error(result.diagnostics);
  judging.judge(result.diagnostics);
  result.judged = judging.take();
  result.judged.is_whole = is_whole(result);
  if (result.is_broken) return;
  auto& files = result.judged.files;
  for (const InputFile& file : result.sources) files.push_back(file.name);
  for (const InputFile& file : properties) files.push_back(file.name);
}

// Reads the tree and binds every property, or says why not; without a tree,
// what is wrong with the texts of the properties.
std::vector<CheckedFile> prepare_all(const TreeInput& tree,
                                     const std::vector<InputFile>& properties,
                                     const CheckOptions& options,
                                     CheckResult& result) {
  std::vector<Result<PropertyFile>> rules;
  TreeReading reading = tree.reading;
  reading.detail.most_whole = options.most_whole;
  for (const InputFile& input : properties) {
    rules.push_back(read_properties(input.name, input.text));
    const auto& read = rules.back().value;
    if (!read) continue;
    add_compared(*read, reading.detail.asked, reading.detail.beside);
  }
  std::vector<CheckedFile> prepared;
  auto read = read_tree(tree.name, tree.text, reading);
  result.diagnostics = std::move(read.diagnostics);
  if (read.value) {
    result.tree = std::make_unique<BehaviorTree>(std::move(*read.value));
    result.sources = sources_of(tree);
  }
  const SourceText source(tree.name, tree.text);
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (result.tree && !rules[i].value) {
      rules[i] =
          read_rules(properties[i].name, properties[i].text, *result.tree);
    }
    add(result.diagnostics, std::move(rules[i].diagnostics));
    if (!result.tree || !rules[i].value) continue;
    prepared.push_back(prepare(*result.tree, source, properties[i],
                               std::move(*rules[i].value), options,
                               result.diagnostics));
  }
  return prepared;
}

// The line that a finding in another file of the tree is about.
void quote_other(const std::vector<InputFile>& sources, Diagnostic& found) {
  for (const InputFile& file : sources) {
    if (file.name != found.file) continue;
    found.source_line = SourceText(file.name, file.text).line(found.span.line);
  }
}

// What lint finds beside what the readers say.
void add_lint(const TreeInput& tree, const std::vector<CheckedFile>& prepared,
              CheckResult& result) {
  if (!result.tree) return;
  std::vector<const PropertyFile*> rules;
  for (const CheckedFile& one : prepared) rules.push_back(one.properties.get());
  auto found = lint(*result.tree, SourceText(tree.name, tree.text), rules);
  for (Diagnostic& each : found) quote_other(result.sources, each);
  add(result.diagnostics, std::move(found));
}

CheckResult check_once(const TreeInput& tree,
                       const std::vector<InputFile>& properties,
                       const CheckOptions& options) {
  CheckResult result;
  result.start_text = options.start_text;
  std::vector<CheckedFile> prepared =
      prepare_all(tree, properties, options, result);
  if (!has_error(result.diagnostics) && properties.empty()) {
    prepared.push_back(prepare_defaults(*result.tree,
                                        SourceText(tree.name, tree.text),
                                        options, result.diagnostics));
  }
  if (has_error(result.diagnostics)) return result;
  for (CheckedFile& one : prepared) {
    search(*result.tree, one, options, result.files.empty());
    result.files.push_back(std::move(one));
  }
  return result;
}

// A closer look that has no answer: an entry is given up altogether, or the
// limits end the default report earlier.
bool is_cut_short(const CheckResult& before, const CheckResult& after) {
  const auto stopped = [](const CheckResult& result) {
    const auto& report = result.files.front().defaults;
    return report && report->stopped != StopReason::None;
  };
  return after.files.empty() || (stopped(after) && !stopped(before));
}

// A rule that holds for a closer look stays so where that has no answer.
void keep_holding(const CheckResult& before, CheckResult& result) {
  for (std::size_t f = 0; f < before.files.size(); ++f) {
    const auto& known = before.files[f].verdicts;
    for (std::size_t i = 0; i < known.size(); ++i) {
      PropertyVerdict& verdict = result.files[f].verdicts[i];
      const bool is_lost = verdict.verdict == Verdict::Undecided &&
                           known[i].verdict == Verdict::Holds &&
                           !known[i].run && known[i].comparisons.empty();
      if (!is_lost) continue;
      verdict.verdict = Verdict::Holds;
      verdict.stopped = StopReason::None;
    }
  }
}

// For which numbers of rounds the verdicts of each file of rules stand.
void find_counts(const TreeInput& tree,
                 const std::vector<InputFile>& properties,
                 const CheckOptions& options, CheckResult& result) {
  const SourceText tree_source(tree.name, tree.text);
  for (std::size_t f = 0; f < result.files.size(); ++f) {
    CheckedFile& file = result.files[f];
    if (!file.properties) continue;
    const SourceText source(properties[f].name, properties[f].text);
    const CountedRules rules{*result.tree,
                             tree_source,
                             *file.properties,
                             source,
                             file.bound,
                             file.verdicts,
                             ticks_for(options, file.properties.get()),
                             options.extra,
                             options.most_whole};
    file.counts = count_claims(rules, options.choices, options.limits);
  }
}

// What is broken at one moment is told up to that moment. That the run goes on
// so that it satisfies the assumptions has been found, and is of no interest.
void leave_out_rest(CheckResult& result) {
  for (CheckedFile& file : result.files) {
    for (PropertyVerdict& verdict : file.verdicts) {
      if (!verdict.run || !verdict.shown_at) continue;
      verdict.run->steps.resize(*verdict.shown_at);
      verdict.run->loop = kNoLoop;
      for (WatchedPart& part : verdict.watched) {
        part.at.resize(verdict.run->state_count());
      }
      verdict.shown_at.reset();
    }
  }
}

}  // namespace

Result<std::string> tree_of_properties(const InputFile& properties) {
  auto read = read_properties(properties.name, properties.text);
  Result<std::string> tree{std::nullopt, std::move(read.diagnostics)};
  if (read.value) tree.value = read.value->tree;
  return tree;
}

Result<std::vector<std::string>> names_of_properties(
    const InputFile& properties) {
  auto read = read_properties(properties.name, properties.text);
  Result<std::vector<std::string>> names{std::nullopt,
                                         std::move(read.diagnostics)};
  if (!read.value) return names;
  names.value.emplace();
  for (const Property& property : read.value->properties) {
    names.value->push_back(property.name);
  }
  return names;
}

CheckResult lint_inputs(const TreeInput& tree,
                        const std::vector<InputFile>& properties,
                        const Judgement& judgement) {
  // Neither rules nor contracts read an entry.
  TreeInput alone = tree;
  alone.reading.tells_unread =
      properties.empty() && tree.reading.leaves.empty();
  CheckResult result;
  const std::vector<CheckedFile> prepared =
      prepare_all(alone, properties, {}, result);
  add_lint(tree, prepared, result);
  judge(judgement, properties, result);
  result.judged.is_whole = !result.is_broken;
  return result;
}

Judged judge(const TreeInput& tree, const Judgement& judgement,
             std::vector<Diagnostic>& diagnostics) {
  const std::vector<InputFile> files = sources_of(tree);
  const std::vector<SourceText> sources = texts_of(files);
  FindingsJudge judging(judgement, sources);
  judging.judge(diagnostics);
  return judging.take();
}

Result<LoweredInput> lowered_input(const TreeInput& input,
                                   const Judgement& judgement,
                                   TickSemantics ticks) {
  auto read = read_tree(input.name, input.text, input.reading);
  std::vector<Diagnostic> found = std::move(read.diagnostics);
  LoweredInput lowered;
  lowered.is_denied = judge(input, judgement, found).is_denied;
  if (!read.value) return {std::nullopt, std::move(found)};
  lowered.tree = std::move(*read.value);
  auto network = lower_values(lowered.tree, {input.name, input.text}, ticks);
  add(found, std::move(network.diagnostics));
  if (!network.value) return {std::nullopt, std::move(found)};
  lowered.network = std::move(*network.value);
  return {std::move(lowered), std::move(found)};
}

namespace {

// However the check ends, what it has found out of parts is there for others.
class Written {
 public:
  explicit Written(const SearchChoices& choices)
      : components_(choices.components) {}
  ~Written() {
    if (components_ != nullptr) components_->write();
  }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;

 private:
  std::shared_ptr<ComponentStore> components_;
};

}  // namespace

// What was found has to be what the engine does: entries whose real values do
// not allow it are told apart more closely, and it is searched again.
CheckResult check(const TreeInput& tree,
                  const std::vector<InputFile>& properties,
                  const CheckOptions& options) {
  const Written at_the_end(options.choices);
  TreeInput closer = tree;
  CheckResult result = check_once(closer, properties, options);
  auto doubtful = groups_in_doubt(result);
  while (doubtful && !doubtful->empty()) {
    if (!look_closer(*result.tree, *doubtful, closer.reading.detail)) break;
    try {
      CheckOptions closer_options = options;
      closer_options.earlier = &result;
      CheckResult again = check_once(closer, properties, closer_options);
      if (is_cut_short(result, again)) break;
      keep_holding(result, again);
      result = std::move(again);
    } catch (const BudgetSpent&) {
      break;  // as a closer look that has no answer
    }
    doubtful = groups_in_doubt(result);
  }
  if (doubtful) withdraw_doubtful(result);
  if (options.any_count && !options.start) {
    find_counts(tree, properties, options, result);
  }
  leave_out_rest(result);
  judge(options.judgement, properties, result);
  return result;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A state variable of an entry stands for all values that the engine may have
// there, sometimes for more. So what holds on all runs holds in the engine,
// too. What a run shows is asked of the run, executed on real values; what
// holds because some run exists needs exact values.
#include "check/doubt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "check/replay/replay.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "model/tree/tree.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

using btcpp::EntryExecution;
using btcpp::EntryNumber;
using btcpp::EntryProgram;
using btcpp::EntryPrograms;

constexpr std::size_t kMostRounds = 2000;
constexpr std::size_t kMostSteps = 2'000'000;
constexpr std::size_t kMostSeen = 300;

// Why the engine cannot take a run: a script comes out otherwise.
struct Refutation {
  std::int32_t program = kNoProgram;
  std::string words;  // "`battery > 20` cannot be false: battery is 199"
  // Nothing is told apart more closely by looking again.
  bool is_for_good = false;
};

// What edges execute, by their numbers.
class ScriptsOfEdges {
 public:
  explicit ScriptsOfEdges(const Network& network) {
    for (const Automaton& automaton : network.automata) {
      for (const Edge& edge : automaton.edges)
        scripts_.push_back(&edge.scripts);
    }
  }
  const std::vector<ScriptStep>& of(const Step& step) const {
    static const std::vector<ScriptStep> kNone;
    return step.edge < scripts_.size() ? *scripts_[step.edge] : kNone;
  }

 private:
  std::vector<const std::vector<ScriptStep>*> scripts_;
};

// A run executed on real values, which only the program around the tree may
// know; a loop until its values come again, or nothing in it is left open.
class Execution {
 public:
  Execution(const BehaviorTree& tree, const ScriptsOfEdges& scripts)
      : programs_(*tree.programs), scripts_(scripts), values_(programs_) {}

  std::optional<Refutation> refutation(std::span<const Step> steps) {
    for (const Step& step : steps) {
      if (auto refused = refusal(step)) return refused;
    }
    return std::nullopt;
  }

  std::optional<Refutation> refutation(const Network& network, const Run& run) {
    const bool has_loop = run.loop != kNoLoop;
    const std::size_t stem = has_loop ? run.loop : run.steps.size();
    if (auto refused = refusal(run, 0, stem)) return refused;
    if (!has_loop) return std::nullopt;
    std::vector<std::vector<btcpp::ScriptValue>> seen;
    const std::size_t length = run.steps.size() - run.loop;
    const std::size_t rounds =
        std::min(kMostRounds, kMostSteps / std::max<std::size_t>(length, 1));
    for (std::size_t round = 0; round <= rounds; ++round) {
      const auto& values = values_.values();
      if (std::ranges::find(seen, values) != seen.end()) return std::nullopt;
      if (seen.size() < kMostSeen) seen.push_back(values);
      if (auto refused = refusal(run, run.loop, run.steps.size())) {
        return refused;
      }
    }
    const auto open = first_open_step(network, run);
    if (!open) return std::nullopt;
    return Refutation{open->program,
                      fmt::format("whether `{}` always comes out so on the "
                                  "loop is not known",
                                  program(*open).text)};
  }

 private:
  const EntryProgram& program(const ScriptStep& step) const {
    return programs_.programs[static_cast<std::size_t>(step.program)];
  }

  std::optional<Refutation> refusal(const Run& run, std::size_t begin,
                                    std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (auto refused = refusal(run.steps[i].step)) return refused;
    }
    return std::nullopt;
  }
  std::optional<Refutation> refusal(const Step& step) {
    ask_budget();
    const std::vector<ScriptStep>& scripts = scripts_.of(step);
    if (scripts.empty()) return std::nullopt;
    const ScriptStep* refused = values_.refused(scripts);
    if (refused != nullptr) {
      return Refutation{refused->program, words_of(*refused)};
    }
    if (!values_.rests_on_enumerator()) return std::nullopt;
    return Refutation{scripts.back().program,
                      words_of_enumerators(scripts.back()), true};
  }

  // "`battery > 20` cannot be false: battery is 199".
  std::string words_of(const ScriptStep& step) const {
    std::string values;
    std::set<EntryNumber> told;
    for (const EntryNumber entry : program(step).entries()) {
      if (!told.insert(entry).second) continue;
      values += fmt::format("{}{} is {}", values.empty() ? ": " : ", ",
                            programs_.entries[entry].name,
                            btcpp::shown(values_.values()[entry]));
    }
    constexpr const char* kCannot[] = {"cannot be true", "cannot be false",
                                       "cannot be executed", "does not throw"};
    return fmt::format("`{}` {}{}", program(step).text,
                       kCannot[static_cast<std::size_t>(step.outcome)], values);
  }

  // "whether `{color} == RED` comes out so depends on …".
  std::string words_of_enumerators(const ScriptStep& step) const {
    return fmt::format(
        "`{}` may come out otherwise: it depends on an enumerator that your "
        "program registers; declare it (BT1640)",
        program(step).text);
  }

  // A step of the loop beside which another outcome is allowed, too.
  std::optional<ScriptStep> first_open_step(const Network& network,
                                            const Run& run) const {
    const NetworkInterpreter interpreter(network);
    for (std::size_t i = run.loop; i < run.steps.size(); ++i) {
      const Step& step = run.steps[i].step;
      for (const ScriptStep& script : scripts_.of(step)) {
        const Automaton& automaton = network.owner_of_edge(step.edge);
        if (is_open(interpreter, automaton, run.state(i), step.edge, script)) {
          return script;
        }
      }
    }
    return std::nullopt;
  }

  static bool is_open(const NetworkInterpreter& interpreter,
                      const Automaton& automaton, const Valuation& state,
                      std::uint32_t edge, const ScriptStep& script) {
    for (std::uint32_t i = 0; i < automaton.edges.size(); ++i) {
      const std::uint32_t other = automaton.first_edge + i;
      const bool is_other_outcome = std::ranges::any_of(
          automaton.edges[i].scripts, [&](const ScriptStep& step) {
            return step.program == script.program &&
                   step.outcome != script.outcome;
          });
      if (other != edge && is_other_outcome &&
          interpreter.may_fire(state, other)) {
        return true;
      }
    }
    return false;
  }

  const EntryPrograms& programs_;
  const ScriptsOfEdges& scripts_;
  EntryExecution values_;
};

struct Doubt {
  std::set<std::size_t> groups;
  std::string words;
};

class Doubts {
 public:
  Doubts(const BehaviorTree& tree, const Network& network)
      : tree_(tree), network_(network), scripts_(network) {}

  std::optional<Doubt> of(const std::optional<Run>& run) const {
    if (!run) return std::nullopt;
    return doubt(Execution(tree_, scripts_).refutation(network_, *run));
  }

  // States are looked at in loops alone, and there are many such runs.
  std::optional<Doubt> of(const std::optional<KeptRun>& run) const {
    if (!run) return std::nullopt;
    if (run->loop() != kNoLoop) return of(std::optional(run->told()));
    return doubt(Execution(tree_, scripts_).refutation(run->steps()));
  }

  std::optional<Doubt> doubt(std::optional<Refutation> refuted) const {
    if (!refuted) return std::nullopt;
    if (refuted->is_for_good) return Doubt{{}, std::move(refuted->words)};
    std::set<std::size_t> groups;
    const EntryPrograms& programs = *tree_.programs;
    const auto number = static_cast<std::size_t>(refuted->program);
    for (const EntryNumber entry : programs.programs[number].entries()) {
      groups.insert(programs.entries[entry].group);
    }
    return because(std::move(groups), std::move(refuted->words));
  }

  std::optional<Doubt> of_branching() const {
    std::set<std::size_t> groups;
    for (const OpenEntry& entry : tree_.open_entries) {
      if (entry.is_rough) groups.insert(entry.group);
    }
    if (groups.empty()) return std::nullopt;
    return Doubt{groups, rough_words(groups)};
  }

  std::optional<Doubt> of(const PropertyVerdict& verdict) const {
    if (verdict.verdict == Verdict::Undecided) return std::nullopt;
    const bool is_branching = verdict.property->form == PropertyForm::Branching;
    auto doubt = is_branching ? of_branching() : of(verdict.run);
    for (const OpenComparison& comparison : verdict.comparisons) {
      if (doubt) break;
      if (!is_branching && is_known_along(verdict.run, comparison)) continue;
      doubt = because(groups_with(comparison), comparison.refusal.message);
    }
    return doubt;
  }

  std::optional<Doubt> of(const TreeReport& report) const {
    const bool is_promise = report.question == TreeQuestion::CanAlwaysEnd ||
                            report.question == TreeQuestion::CanAlwaysSucceed;
    if (is_promise && report.verdict != Verdict::Undecided) {
      return of_branching();
    }
    return of(report.run);
  }

 private:
  // "`n`: it takes more than 128 values (line 3)", for all of these groups.
  std::string rough_words(const std::set<std::size_t>& groups) const {
    std::string words;
    for (const OpenEntry& entry : tree_.open_entries) {
      if (!entry.is_rough || !groups.contains(entry.group)) continue;
      words += fmt::format("{}`{}`: {} (line {})", words.empty() ? "" : "; ",
                           entry.name, entry.reason, entry.span.line);
    }
    return words;
  }

  Doubt because(std::set<std::size_t> groups, std::string words) const {
    const std::string reasons = rough_words(groups);
    if (!reasons.empty()) words += "; " + reasons;
    return {std::move(groups), std::move(words)};
  }

  std::set<std::size_t> groups_with(const OpenComparison& comparison) const {
    std::set<std::size_t> groups;
    for (const btcpp::ProgramEntry& entry : tree_.programs->entries) {
      const auto& about = comparison.entries;
      const bool is_about =
          std::ranges::find(about, entry.variable) != about.end();
      if (is_about) groups.insert(entry.group);
    }
    return groups;
  }

  // Only of what a run shows: without one, it is about all states.
  bool is_known_along(const std::optional<Run>& run,
                      const OpenComparison& comparison) const {
    if (!run) return false;
    const NetworkInterpreter interpreter(network_);
    for (std::size_t i = 0; i < run->state_count(); ++i) {
      if (interpreter.is_true(comparison.where, run->state(i))) return false;
    }
    return true;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  const ScriptsOfEdges scripts_;
};

void withdraw(PropertyVerdict& verdict, std::string words) {
  verdict.verdict = Verdict::Undecided;
  verdict.stopped = StopReason::OpenEntries;
  verdict.open = std::move(words);
  verdict.run.reset();
  verdict.shown_at.reset();
  verdict.watched.clear();
  verdict.unshown.clear();
}

// Calls `see` with the doubt there is about an answer of the default report, if
// any, which is then withdrawn unless the report is const; a run takes much
// room, so nothing is copied.
template <class Report, class See>
void for_each_doubt_of(const Doubts& doubts, Report& report, See see) {
  constexpr bool kWithdraws = !std::is_const_v<Report>;
  const auto ask = [&](const auto& answer) {
    const auto doubt = doubts.of(answer);
    if (!doubt) return false;
    see(*doubt);
    if constexpr (kWithdraws) {
      report.stopped = StopReason::OpenEntries;
      if (report.open.empty()) report.open = doubt->words;
    }
    return true;
  };
  for (auto& answer : report.tree) {
    if (!ask(answer)) continue;
    if constexpr (kWithdraws) {
      answer.verdict = Verdict::Undecided;
      answer.run.reset();
    }
  }
  for (auto& node : report.nodes) {
    for (auto& answer : node.answers) {
      if (!ask(answer.run)) continue;
      if constexpr (kWithdraws) answer = {};
    }
  }
  const auto is_doubtful = [&](const auto& found) { return ask(found.run); };
  if constexpr (kWithdraws) {
    std::erase_if(report.stale_guards, is_doubtful);
    std::erase_if(report.left_running, is_doubtful);
  } else {
    for (const auto& found : report.stale_guards) is_doubtful(found);
    for (const auto& found : report.left_running) is_doubtful(found);
  }
}

// The same for all answers.
template <class Result, class See>
void for_each_doubt(Result& result, See see) {
  constexpr bool kWithdraws = !std::is_const_v<Result>;
  if (!result.tree || !result.tree->programs ||
      result.tree->programs->programs.empty()) {
    return;
  }
  for (auto& file : result.files) {
    const Doubts doubts(*result.tree, *file.network);
    for (auto& verdict : file.verdicts) {
      const auto doubt = doubts.of(verdict);
      if (!doubt) continue;
      see(*doubt);
      if constexpr (kWithdraws) withdraw(verdict, doubt->words);
    }
    if (const auto doubt = doubts.of(file.fault)) {
      see(*doubt);
      if constexpr (kWithdraws) {
        file.has_faults = false;
        file.fault.reset();
        file.open_fault = doubt->words;
      }
    }
    if (file.defaults) for_each_doubt_of(doubts, *file.defaults, see);
    // One that is not sure is not told.
    if constexpr (kWithdraws) {
      std::erase_if(file.findings, [&](const TreeFinding& finding) {
        return doubts.of(finding.run).has_value();
      });
    } else {
      for (const TreeFinding& finding : file.findings) {
        auto doubt = doubts.of(finding.run);
        if (!doubt) continue;
        // Beside rules it is not looked for again.
        if (!file.defaults) doubt->groups.clear();
        see(*doubt);
      }
    }
  }
}

}  // namespace

std::optional<std::set<std::size_t>> groups_in_doubt(
    const CheckResult& result) {
  std::optional<std::set<std::size_t>> groups;
  for_each_doubt(result, [&](const Doubt& doubt) {
    if (!groups) groups.emplace();
    groups->insert(doubt.groups.begin(), doubt.groups.end());
  });
  return groups;
}

bool look_closer(const BehaviorTree& tree, const std::set<std::size_t>& groups,
                 btcpp::ScriptDetail& detail) {
  bool is_closer = false;
  for (const btcpp::ProgramEntry& entry : tree.programs->entries) {
    if (!groups.contains(entry.group) || entry.is_foreign) continue;
    int& level = detail.levels[{entry.subtree, entry.key}];
    if (level == btcpp::ScriptDetail::kMostLevels) continue;
    ++level;
    is_closer = true;
  }
  return is_closer;
}

void withdraw_doubtful(CheckResult& result) {
  for_each_doubt(result, [](const Doubt&) {});
}

}  // namespace btcheck

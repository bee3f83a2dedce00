// SPDX-License-Identifier: MIT
//
// Each step of a run points at the node that takes it, or the variable that
// moves, in the tree's file: a reader steps through the file, not the network.
#include "report/formats/reported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "model/tree/node_types.hpp"
#include "report/formats/escapes.hpp"
#include "report/text/conditions.hpp"
#include "report/text/report.hpp"
#include "trace/run/record.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

class Teller {
 public:
  Teller(const BehaviorTree& tree, const Network& network)
      : tree_(tree), network_(network), here_(place_of(tree, tree.roots[0])) {
    told_.unit = network.ticks == TickSemantics::Root ? "tick" : "time";
  }

  // A Run or a KeptRun, and where its loop begins.
  template <class AnyRun>
  ToldRun tell(const AnyRun& run, std::size_t loop, const RunHeading& heading) {
    std::size_t i = 0;
    bool repeats = false;
    run.walk([&](const Valuation& before, const RunStep& step) {
      if (heading.trigger == i) remark(heading.trigger_words);
      if (loop == i) {
        told_.loop = told_.steps.size();
        remark("the loop begins");
      }
      take(before, step);
      repeats |= i >= loop && step.step.edge != kTimeStep;
      ++i;
    });
    if (heading.trigger == i) remark(heading.trigger_words);
    if (!heading.end_words.empty()) remark(heading.end_words);
    if (told_.loop) {
      remark(repeats ? "this repeats for ever"
                     : "the run stays here for ever while time passes");
    }
    told_.time = time_;
    return std::move(told_);
  }

 private:
  void take(const Valuation& before, const RunStep& step) {
    time_ += step.step.elapsed;
    const auto event = event_of(tree_, network_, before, step);
    if (!event) return;
    here_ = place_of(tree_, mover_of(network_, step));
    if (time_ != told_time_) {
      told_time_ = time_;
      const std::string begin = fmt::format("{} {}", told_.unit, time_);
      add(ToldStep::Kind::Time,
          told_.unit == "tick" ? begin + " begins" : begin,
          place_of(tree_, tree_.roots[0]));
    }
    add(ToldStep::Kind::Event, event->text, here_);
    told_.steps.back().is_chosen = event->is_chosen;
  }

  void remark(const std::string& words) {
    add(ToldStep::Kind::Remark, words, here_);
  }

  void add(ToldStep::Kind kind, std::string text, const Place& place) {
    told_.steps.push_back({kind, std::move(text), time_, false, place});
  }

  const BehaviorTree& tree_;
  const Network& network_;
  ToldRun told_;
  Place here_;  // of the event told last
  int time_ = 0;
  int told_time_ = 0;
};

ReportedProperty reported_property(const CheckResult& result,
                                   const CheckedFile& file,
                                   const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  ReportedProperty reported;
  reported.name = property.name;
  reported.title = property.title;
  reported.text = property.text;
  reported.tags = property.tags;
  reported.place = {file.properties->file, property.span};
  reported.verdict = verdict.verdict;
  reported.expectation = property.expectation;
  reported.is_met = verdict.met_expectation();
  reported.is_vacuous = verdict.is_vacuous();
  reported.note = note_with_conditions(result, file, verdict);
  const std::string advice = advice_text(file, verdict);
  if (!advice.empty()) reported.note += "; " + advice;
  reported.error = verdict.error;
  reported.stopped = verdict.stopped;
  reported.progress = verdict.progress;
  reported.triggers = verdict.triggers;
  reported.longest_answer = verdict.longest_answer;
  for (const CountClaim& claim : claims_of(file, verdict)) {
    if (!claim.from) continue;
    reported.for_every.push_back({stable_path(*result.tree, claim.node),
                                  place_of(*result.tree, claim.node),
                                  claim.attribute, *claim.from});
  }
  if (!verdict.run || !verdict.error.empty()) return reported;
  const RunHeading heading = heading_of(result, file, verdict);
  reported.reason = heading.why;
  reported.run = told_run(*result.tree, *file.network, *verdict.run, heading);
  reported.told = told_text(result, file, verdict, Detail::Events);
  return reported;
}

ReportedAnswer reported_answer(const CheckResult& result,
                               const CheckedFile& file,
                               const TreeReport& answer) {
  ReportedAnswer reported;
  const QuestionWords& words = words_of(answer.question);
  reported.key = words.key;
  reported.code = code_of(answer.question);
  reported.question = words.words;
  reported.answer = answer_text(result, file, answer);
  reported.verdict = answer.verdict;
  reported.is_fault = is_fault(answer);
  reported.trace = trace_name(answer);
  if (answer.run) {
    reported.run = told_run(*result.tree, *file.network, *answer.run);
  }
  return reported;
}

ReportedNode reported_node(const BehaviorTree& tree, const Network& network,
                           const NodeReport& report) {
  const Node& node = tree.node(report.node);
  ReportedNode reported;
  reported.key = unique_name(tree, report.node);
  reported.name = node.name;
  reported.type = type_name(node.type);
  reported.place = place_of(tree, report.node);
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    const Possibility& answer = report.answers[q];
    if (!can_be_asked(network, report.node, q)) continue;
    reported.answers[q] = {answer.verdict, answer.ticks()};
  }
  return reported;
}

ReportedFile reported_file(const CheckResult& result, const CheckedFile& file) {
  ReportedFile reported;
  if (file.properties) reported.properties = file.properties->file;
  reported.profile = profile_name(file.network->profile);
  reported.ticks = tick_name(file.network->ticks);
  reported.assumptions = conditions_of(result, file);
  reported.has_faults = file.has_faults;
  for (const PropertyVerdict& verdict : file.verdicts) {
    reported.verdicts.push_back(reported_property(result, file, verdict));
  }
  if (!file.defaults) return reported;
  for (const TreeReport& answer : file.defaults->tree) {
    reported.answers.push_back(reported_answer(result, file, answer));
  }
  for (const NodeReport& node : file.defaults->nodes) {
    reported.nodes.push_back(reported_node(*result.tree, *file.network, node));
  }
  reported.stopped = file.defaults->stopped;
  reported.progress = file.defaults->progress;
  reported.error = file.defaults->error;
  return reported;
}

}  // namespace

Mover mover_of(const Network& network, const RunStep& step) {
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  if (automaton.kind == AutomatonKind::StateVariable) {
    return automaton.state_variable;
  }
  return automaton.node;
}

Place place_of(const BehaviorTree& tree, const Mover& mover) {
  if (const auto* variable = std::get_if<StateVariableId>(&mover)) {
    return {tree.file, tree.variable(*variable).span};
  }
  const NodeId node = std::get<NodeId>(mover);
  return {tree.file_of(node), tree.node(node).span};
}

ToldRun told_run(const BehaviorTree& tree, const Network& network,
                 const Run& run, const RunHeading& heading) {
  return Teller(tree, network).tell(run, run.loop, heading);
}

ToldRun told_run(const BehaviorTree& tree, const Network& network,
                 const KeptRun& run) {
  return Teller(tree, network).tell(run, run.loop(), {});
}

std::string trace_name(const TreeReport& answer) {
  return is_bad(answer) && answer.run ? std::string(code_of(answer.question))
                                      : std::string();
}

std::vector<std::string> trace_names(const BehaviorTree& tree,
                                     const std::vector<TreeFinding>& findings) {
  constexpr std::size_t kMostOfName = 60;
  std::map<std::string, int> taken;
  std::vector<std::string> names;
  for (const TreeFinding& found : findings) {
    std::string& name = names.emplace_back();
    if (!found.run || is_question(found)) continue;
    name = fmt::format("{}-{}", found.code,
                       plain_word(stable_name(tree.node(found.node)), "-")
                           .substr(0, kMostOfName));
    const int count = ++taken[name];
    if (count > 1) name += fmt::format("-{}", count);
  }
  return names;
}

ExitCode Report::code() const {
  ExitCode worst = ExitCode::Met;
  for (const ReportedTree& tree : trees) worst = worst_of(worst, tree.code);
  return worst;
}

double Report::seconds() const {
  double sum = 0;
  for (const ReportedTree& tree : trees) sum += tree.seconds;
  return sum;
}

const std::string& title_of(const ReportedTree& tree) {
  return tree.entry.empty() ? tree.file : tree.entry;
}

std::uint64_t states_of(const ReportedTree& tree) {
  std::uint64_t states = 0;
  for (const ReportedFile& file : tree.files) {
    states = std::max(states, file.progress.states);
    for (const ReportedProperty& property : file.verdicts) {
      states = std::max(states, property.progress.states);
    }
  }
  return states;
}

ReportedTree reported(const CheckResult& result, const std::string& file,
                      ExitCode code) {
  ReportedTree tree;
  tree.file = file;
  tree.root.file = file;
  tree.diagnostics = result.diagnostics;
  tree.judged = result.judged;
  tree.code = code;
  if (!result.tree) return tree;
  tree.nodes = result.tree->nodes.size();
  tree.variables = result.tree->variables.size();
  tree.root = place_of(*result.tree, result.tree->roots[0]);
  for (const CheckedFile& checked : result.files) {
    tree.files.push_back(reported_file(result, checked));
    auto found = findings_of(result, checked, tree.files.back());
    std::ranges::move(found, std::back_inserter(tree.findings));
  }
  return tree;
}

std::string fingerprint_of(const Report& report, const Finding& finding) {
  return fingerprint(
      path_from(report.root, report.directory, finding.place.file) + '\n' +
      finding.identity);
}

std::string Fingerprints::next(const Finding& finding) {
  const std::string print = fingerprint_of(report_, finding);
  return fmt::format("{}:{}", print, ++seen_[print]);
}

bool is_of_tree(const Finding& finding) {
  return finding.code.starts_with("BT22") || finding.code.starts_with("BT25");
}

std::string place_text(const Place& place) {
  if (place.span.line == 0) return place.file;
  return fmt::format("{}:{}:{}", place.file, place.span.line,
                     place.span.column);
}

std::vector<Finding> all_findings(const ReportedTree& tree) {
  std::vector<Finding> findings;
  for (const Diagnostic& diagnostic : tree.diagnostics) {
    findings.push_back(finding_of(diagnostic));
    // What names no file is about the tree as a whole.
    if (diagnostic.file.empty()) findings.back().place.file = tree.file;
  }
  findings.insert(findings.end(), tree.findings.begin(), tree.findings.end());
  if (tree.not_run.empty()) return findings;
  Finding& finding = findings.emplace_back();
  finding.about = Finding::About::Input;
  finding.code = rule::kUndecided;
  finding.severity = Severity::Warning;
  finding.title = "not checked";
  finding.message = fmt::format("Not checked: {}.", tree.not_run);
  finding.place = tree.root;
  finding.identity = finding.code;
  return findings;
}

}  // namespace btcheck

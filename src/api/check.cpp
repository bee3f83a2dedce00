// SPDX-License-Identifier: MIT
//
// The door for programs: a request becomes what the command line makes of its
// words, and the report of the check is copied out.
#include "btcheck/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "check/repairs/repairs.hpp"
#include "explore/state/spent.hpp"
#include "project/sources.hpp"
#include "report/codes/codes.hpp"
#include "report/formats/formats.hpp"
#include "report/formats/reported.hpp"
#include "report/text/report.hpp"
#include "text/budget.hpp"
#include "text/version.hpp"

namespace btcheck::v1 {

struct Report::Whole {
  btcheck::Report report;
};

namespace {

using Clock = std::chrono::steady_clock;

// The time and the monitor of one call, for every stage of it.
class Call final : public Budget, public SearchMonitor {
 public:
  Call(const Request& request, Monitor* monitor)
      : seconds_(request.seconds), monitor_(monitor) {}

  // For a moment after a search has been stopped what it knows is told.
  Spent look() override { return is_telling() ? Spent::Nothing : spent({}); }
  StopReason observe(const SearchProgress& progress) override {
    return stop_reason(
        spent({progress.states, progress.transitions, seconds()}));
  }
  bool may_tell() override { return stopped_at_ < 0 || is_telling(); }
  bool has_spare() override {
    return stopped_at_ < 0 && (seconds_ == 0 || seconds() < seconds_ / 2);
  }

  double seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }

 private:
  static constexpr double kTelling = 0.3;
  static constexpr double kAskEvery = 0.005;

  bool is_telling() const {
    const double at = stopped_at_;
    return at >= 0 && seconds() - at < kTelling;
  }

  Spent spent(Progress progress) {
    const double now = seconds();
    Spent what = Spent::Nothing;
    if (is_stopped_) {
      what = Spent::Interrupted;
    } else if (seconds_ > 0 && now >= seconds_) {
      what = Spent::Time;
    } else if (monitor_ != nullptr && now >= next_) {
      next_ = now + kAskEvery;
      progress.seconds = now;
      if (!monitor_->goes_on(progress)) {
        is_stopped_ = true;
        what = Spent::Interrupted;
      }
    }
    if (what != Spent::Nothing && stopped_at_ < 0) stopped_at_ = now;
    return what;
  }

  const Clock::time_point begin_ = Clock::now();
  const double seconds_;
  Monitor* monitor_;
  std::atomic<double> next_ = 0;
  std::atomic<bool> is_stopped_ = false;
  std::atomic<double> stopped_at_ = -1;  // seconds; before: negative
};

Diagnostic error_of(std::string_view code, const std::string& file,
                    std::string message) {
  Diagnostic error;
  error.code = code;
  error.file = file;
  error.message = std::move(message);
  return error;
}

// The user's sources as those of a check.
class AskedSources final : public btcheck::Sources {
 public:
  explicit AskedSources(v1::Sources& sources) : sources_(sources) {
    for (const std::string& name : sources.files()) {
      if (!project_.is_new(name)) continue;
      auto text = sources.text(name);
      if (text) project_.add(name, std::move(*text));
    }
  }

  Result<InputFile> text(const std::string& name) override {
    const InputFile* known = project_.read_file(name);
    if (known != nullptr) return {*known, {}};
    auto found = sources_.text(name);
    if (found) return {InputFile{name, std::move(*found)}, {}};
    return {std::nullopt,
            {error_of("BT0002", name, fmt::format("cannot find `{}`", name))}};
  }
  NearestFile with_tree(std::string_view tree,
                        const std::string& from) override {
    return project_.with_tree(tree, from);
  }
  std::string package(std::string_view name,
                      const std::string& /*from*/) override {
    return sources_.package(std::string(name));
  }
  const XmlProject& project() const override { return project_; }
  bool is_of_one_program() const override { return true; }

 private:
  v1::Sources& sources_;
  XmlProject project_;
};

Profile profile_of(const std::string& name) {
  const auto profile = profile_named(name);
  if (profile) return *profile;
  throw std::invalid_argument(
      fmt::format("btcheck: there is no profile `{}`", name));
}

struct Inputs {
  TreeInput tree;
  std::vector<InputFile> rules;
};

// Nothing where a file is missing.
std::optional<Inputs> inputs_of(const Request& request, AskedSources& sources,
                                std::vector<Diagnostic>& found) {
  bool is_whole = true;
  const auto read = [&](const std::string& name) {
    auto file = sources.text(name);
    found.insert(found.end(), file.diagnostics.begin(), file.diagnostics.end());
    is_whole = is_whole && file.value.has_value();
    return file.value ? std::move(*file.value) : InputFile{name, {}};
  };
  Inputs inputs;
  for (const std::string& name : request.rules) {
    inputs.rules.push_back(read(name));
  }
  if (!request.typed_rules.empty()) {
    inputs.rules.push_back(typed_rules(request.typed_rules));
  }
  inputs.tree = TreeInput(read(request.tree));
  TreeReading& reading = inputs.tree.reading;
  if (!request.profile.empty()) reading.profile = profile_of(request.profile);
  reading.tick_ms = request.tick_milliseconds;
  reading.loops = request.loops;
  reading.wakes = request.wake_ups;
  reading.main_tree = request.main_tree;
  const auto read_all = [&](const std::vector<std::string>& names,
                            std::vector<InputFile>& to) {
    for (const std::string& name : names) {
      InputFile file = read(name);
      to.push_back({name, std::move(file.text)});
    }
  };
  read_all(request.leaves, reading.leaves);
  read_all(request.models, reading.models);
  if (!is_whole) return std::nullopt;
  if (is_xml(inputs.tree.name, inputs.tree.text)) {
    add_asked_files(inputs.tree, sources, reading, found);
  }
  return inputs;
}

// --- The report, copied out -----------------------------------------------

Level level_of(Severity severity) {
  if (severity == Severity::Error) return Level::Error;
  return severity == Severity::Warning ? Level::Warning : Level::Note;
}

Verdict verdict_of(btcheck::Verdict verdict) {
  if (verdict == btcheck::Verdict::Holds) return Verdict::Holds;
  return verdict == btcheck::Verdict::Violated ? Verdict::Violated
                                               : Verdict::Undecided;
}

Position position_of(const Place& place) {
  const auto number = [](auto value) {
    return static_cast<std::size_t>(value);
  };
  return {place.file, number(place.span.line), number(place.span.column),
          number(place.span.length)};
}

std::optional<Run> run_of(const std::optional<ToldRun>& told) {
  if (!told) return std::nullopt;
  Run run;
  for (const ToldStep& step : told->steps) {
    run.steps.push_back(
        {step.text, step.time, step.is_chosen, position_of(step.place)});
  }
  run.loop = told->loop;
  return run;
}

std::vector<Change> changes_of(const std::optional<CheckedRepair>& repair) {
  std::vector<Change> changes;
  if (!repair) return changes;
  for (const ChangedFile& file : repair->files) {
    for (const ChangedLines& lines : file.changes) {
      changes.push_back({file.file, static_cast<std::size_t>(lines.first),
                         lines.before.size(), lines.after});
    }
  }
  return changes;
}

Finding finding_of(const btcheck::Finding& of) {
  constexpr std::string_view kHelp = "\nHelp: ";
  Finding finding;
  finding.code = of.code;
  finding.level = level_of(of.severity);
  const std::size_t help = of.message.find(kHelp);
  finding.message = of.message.substr(0, help);
  if (help != std::string::npos) {
    finding.help = of.message.substr(help + kHelp.size());
  }
  finding.where = position_of(of.place);
  finding.node = of.node;
  finding.run = run_of(of.run);
  finding.repair = changes_of(of.repair);
  return finding;
}

Rule rule_of(const ReportedProperty& of) {
  Rule rule;
  rule.name = of.name;
  rule.text = of.text;
  rule.where = position_of(of.place);
  rule.verdict = verdict_of(of.verdict);
  rule.is_met = of.is_met;
  rule.is_vacuous = of.is_vacuous;
  rule.note = of.note;
  rule.reason = of.reason;
  rule.run = run_of(of.run);
  return rule;
}

Node node_of(const ReportedNode& of) {
  Node node{of.key, of.type, position_of(of.place), {}, {}, {}, {}, {}, {}};
  const auto answer = [&](NodeQuestion question) {
    const auto& given = of.answers[static_cast<std::size_t>(question)];
    return given ? std::optional(verdict_of(given->verdict)) : std::nullopt;
  };
  node.is_ticked = answer(NodeQuestion::Ticked);
  node.succeeds = answer(NodeQuestion::Success);
  node.fails = answer(NodeQuestion::Failure);
  node.runs = answer(NodeQuestion::Running);
  node.is_halted = answer(NodeQuestion::Halted);
  node.is_skipped = answer(NodeQuestion::Skipped);
  return node;
}

void add_file(const ReportedFile& file, Report& report) {
  report.profile = file.profile;
  for (const ReportedProperty& rule : file.verdicts) {
    report.rules.push_back(rule_of(rule));
  }
  for (const ReportedAnswer& answer : file.answers) {
    report.answers.push_back({answer.key, answer.question, answer.answer,
                              verdict_of(answer.verdict), answer.is_fault});
  }
  for (const ReportedNode& node : file.nodes) {
    report.nodes.push_back(node_of(node));
  }
}

Report report_of(const CheckResult& result, const std::string& tree,
                 ExitCode code, StopReason stopped, const Call& call) {
  const BudgetScope telling(nullptr);
  auto whole = std::make_shared<Report::Whole>();
  whole->report.trees.push_back(reported(result, tree, code));
  ReportedTree& told = whole->report.trees[0];
  told.seconds = call.seconds();
  Report report;
  report.outcome = static_cast<Outcome>(code);
  report.tree = tree;
  report.node_count = told.nodes;
  report.variable_count = told.variables;
  report.states = states_of(told);
  for (const btcheck::Finding& finding : all_findings(told)) {
    report.findings.push_back(finding_of(finding));
  }
  for (const CheckedFile& file : result.files) {
    const StopReason reason = stopped_by(file);
    if (reason != StopReason::None) stopped = reason;
  }
  report.stopped = stop_word(stopped);
  for (const ReportedFile& file : told.files) add_file(file, report);
  report.seconds = told.seconds;
  report.whole = std::move(whole);
  return report;
}

// What both calls have in common; `run` checks the inputs.
template <class Run>
Report called(const Request& request, Sources& sources, Monitor* monitor,
              Run run) {
  Call call(request, monitor);
  const BudgetScope budget(&call);
  CheckResult result;
  ExitCode code = ExitCode::BadInput;
  StopReason stopped = StopReason::None;
  try {
    AskedSources asked(sources);
    std::vector<Diagnostic> found;
    const auto inputs = inputs_of(request, asked, found);
    if (inputs) code = run(*inputs, call, result);
    result.diagnostics.insert(result.diagnostics.begin(), found.begin(),
                              found.end());
  } catch (const BudgetSpent& spent) {
    result = {};
    result.diagnostics = {
        error_of("BT9003", request.tree,
                 fmt::format("UNDECIDED: {} while {}",
                             spent.spent() == Spent::Time ? "the time was up"
                                                          : "interrupted",
                             spent.doing()))};
    code = ExitCode::Undecided;
    stopped = stop_reason(spent.spent());
  }
  return report_of(result, request.tree, code, stopped, call);
}

}  // namespace

void Files::add(std::string name, std::string text) {
  texts_.insert_or_assign(std::move(name), std::move(text));
}

void Files::add_package(std::string name, std::string folder) {
  packages_.insert_or_assign(std::move(name), std::move(folder));
}

std::optional<std::string> Files::text(const std::string& name) {
  const auto found = texts_.find(name);
  if (found == texts_.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string> Files::files() {
  std::vector<std::string> names;
  for (const auto& [name, text] : texts_) names.push_back(name);
  return names;
}

std::string Files::package(const std::string& name) {
  const auto found = packages_.find(name);
  return found == packages_.end() ? std::string() : found->second;
}

std::string Report::json() const {
  return whole ? json_text(whole->report) : std::string();
}

std::string Report::sarif() const {
  return whole ? sarif_text(whole->report) : std::string();
}

Report check(const Request& request, Sources& sources, Monitor* monitor) {
  return called(request, sources, monitor,
                [&](const Inputs& inputs, Call& call, CheckResult& result) {
                  CheckOptions options;
                  options.choices.threads = std::max(1U, request.threads);
                  if (request.states > 0)
                    options.limits.max_states = request.states;
                  if (request.bytes > 0)
                    options.limits.max_bytes = request.bytes;
                  options.limits.monitor = &call;
                  options.tries_repairs = request.tries_repairs;
                  result = check_and_repair(inputs.tree, inputs.rules, options);
                  return result.files.empty() ? ExitCode::BadInput
                                              : exit_code_of(result);
                });
}

Report lint(const Request& request, Sources& sources, Monitor* monitor) {
  return called(request, sources, monitor,
                [&](const Inputs& inputs, Call&, CheckResult& result) {
                  result = lint_inputs(inputs.tree, inputs.rules);
                  return lint_code_of(result);
                });
}

std::optional<Explanation> explain(std::string_view code) {
  const CodeRow* row = code_named(code);
  if (row == nullptr) return std::nullopt;
  return Explanation{std::string(row->code), std::string(row->summary),
                     std::string(row->description), std::string(row->help)};
}

std::string_view version() { return kVersion; }

}  // namespace btcheck::v1

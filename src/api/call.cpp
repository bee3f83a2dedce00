// SPDX-License-Identifier: MIT
#include "api/call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "explore/state/spent.hpp"
#include "model/tree_file.hpp"
#include "project/reading.hpp"
#include "settings/settings.hpp"

namespace btcheck::v1 {
namespace {

template <class Value>
Value meant(const std::optional<Value>& value, std::string_view what,
            const std::string& word) {
  if (value) return *value;
  throw std::invalid_argument(
      fmt::format("btcheck: there is no {} `{}`", what, word));
}

// What the request says, and nothing where it leaves something out.
ReadingChoices choices_of(const Request& request) {
  constexpr int kMostTick = 3'600'000;
  ReadingChoices said;
  if (!request.profile.empty()) {
    said.profile =
        meant(profile_named(request.profile), "profile", request.profile);
  }
  if (!request.ticks.empty()) {
    said.ticks = meant(tick_semantics(request.ticks), "tick", request.ticks);
  }
  const int tick = request.tick_milliseconds;
  if (tick < 0 || tick > kMostTick) {
    throw std::invalid_argument(
        fmt::format("btcheck: no tick takes {} ms", tick));
  }
  if (tick > 0) said.tick_ms = tick;
  if (request.loops) said.loops = true;
  if (request.wake_ups) said.wakes = true;
  if (!request.main_tree.empty()) said.main_tree = request.main_tree;
  if (!request.models.empty()) said.models = request.models;
  if (!request.leaves.empty()) said.leaves = request.leaves;
  return said;
}

void append(std::vector<Diagnostic>& all, const std::vector<Diagnostic>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// False where there are settings, and they are wrong.
bool take_settings(const InputFile& tree, const std::string& directory,
                   CallSources& sources, ReadingChoices& said,
                   Judgement& judgement, std::vector<Diagnostic>& found) {
  // Names of files are compared as if they lay in one place.
  judgement.directory = directory.empty() ? "/" : directory;
  const auto file = sources.settings(tree.name);
  if (!file) return true;
  const auto settings =
      read_settings(judgement.directory, file->name, file->text);
  append(found, settings.diagnostics);
  if (!settings.value) return false;
  said = over(std::move(said),
              fitting(settings.value->reading, is_xml(tree.name, tree.text)));
  add_judgement(*settings.value, judgement);
  return true;
}

}  // namespace

StopReason Call::observe(const SearchProgress& progress) {
  return stop_reason(spent({progress.states, progress.transitions, seconds()}));
}

Spent Call::spent(Progress progress) {
  const double now = seconds();
  Spent what = Spent::Nothing;
  if (is_stopped_) {
    what = Spent::Interrupted;
  } else if (seconds_ > 0 && now >= seconds_) {
    what = Spent::Time;
  } else if (monitor_ != nullptr && now >= next_) {
    next_ = now + kAskEvery;
    // Between searches it is where the last one stood.
    if (progress.states == 0) progress.states = states_;
    states_ = progress.states;
    progress.seconds = now;
    if (!monitor_->goes_on(progress)) {
      is_stopped_ = true;
      what = Spent::Interrupted;
    }
  }
  if (what != Spent::Nothing && stopped_at_ < 0) stopped_at_ = now;
  return what;
}

const XmlProject& AskedSources::project() const {
  if (project_) return *project_;
  project_.emplace();
  for (const std::string& name : sources_.files()) {
    if (!project_->is_new(name)) continue;
    auto text = sources_.text(name);
    if (text) project_->add(name, std::move(*text));
  }
  return *project_;
}

Result<InputFile> AskedSources::text(const std::string& name) {
  const InputFile* known = project().read_file(name);
  if (known != nullptr) return {*known, {}};
  auto found = sources_.text(name);
  if (found) return {InputFile{name, std::move(*found)}, {}};
  return {std::nullopt,
          {file_error("BT0002", name, fmt::format("cannot find `{}`", name))}};
}

NearestFile AskedSources::with_tree(std::string_view tree,
                                    const std::string& from) {
  const NearestFile near = project().with_tree(tree, from);
  if (near.file != nullptr || tree.empty()) return near;
  const std::string name = sources_.file_with_tree(std::string(tree));
  auto text = name.empty() || !around_.is_new(name) ? std::nullopt
                                                    : sources_.text(name);
  if (text) around_.add(name, std::move(*text));
  return around_.with_tree(tree, from);
}

std::optional<Inputs> inputs_of(const Request& request, CallSources& sources,
                                std::vector<Diagnostic>& found) {
  std::vector<InputFile> rules;
  bool are_all = true;
  for (const std::string& name : request.rules) {
    auto file = sources.named(name);
    append(found, file.diagnostics);
    are_all = are_all && file.value;
    if (file.value) rules.push_back(std::move(*file.value));
  }
  if (!request.typed_rules.empty()) {
    rules.push_back(typed_rules(request.typed_rules));
  }
  auto of_tree = inputs_of_tree(request, sources, found);
  if (!are_all || !of_tree) return std::nullopt;
  of_tree->rules = std::move(rules);
  return of_tree;
}

std::optional<Inputs> inputs_of_tree(const Request& request,
                                     CallSources& sources,
                                     std::vector<Diagnostic>& found) {
  ReadingChoices said = choices_of(request);
  auto tree = sources.named(request.tree);
  append(found, tree.diagnostics);
  if (!tree.value) return std::nullopt;
  Inputs inputs;
  if (!take_settings(*tree.value, request.directory, sources, said,
                     inputs.judgement, found)) {
    return std::nullopt;
  }
  inputs.ticks = said.ticks;
  auto reading = reading_of(*tree.value, said, sources, found);
  if (!reading) return std::nullopt;
  inputs.tree = {std::move(*tree.value), std::move(*reading)};
  return inputs;
}

CheckOptions options_of(const Request& request, const Inputs& inputs,
                        Call& call) {
  CheckOptions options;
  options.ticks = inputs.ticks;
  options.judgement = inputs.judgement;
  options.choices.threads = std::max(1U, request.threads);
  if (request.states > 0) options.limits.max_states = request.states;
  if (request.bytes > 0) options.limits.max_bytes = request.bytes;
  options.limits.monitor = &call;
  options.tries_repairs = request.tries_repairs;
  return options;
}

Diagnostic spent_diagnostic(const BudgetSpent& spent, const std::string& file) {
  return file_error("BT9003", file,
                    fmt::format("UNDECIDED: {} while {}",
                                spent.spent() == Spent::Time ? "the time was up"
                                                             : "interrupted",
                                spent.doing()));
}

}  // namespace btcheck::v1

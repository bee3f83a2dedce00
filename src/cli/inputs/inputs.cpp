// SPDX-License-Identifier: MIT
#include "cli/inputs/inputs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include "cli/console/console.hpp"
#include "cli/inputs/file_sources.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/looked_at.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/options/roots.hpp"
#include "cli/settings/baseline.hpp"
#include "cli/settings/choices.hpp"
#include "ltl/rules/property.hpp"
#include "model/tree_file.hpp"
#include "text/colors.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

void append(std::vector<Diagnostic>& all, const std::vector<Diagnostic>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// `btcheck rules.ltl`: the tree is the one that the file names.
std::optional<std::string> tree_named_by(const InputFile& properties,
                                         std::vector<Diagnostic>& found) {
  const Result<std::string> named = tree_of_properties(properties);
  if (!named.value) {
    append(found, named.diagnostics);
    return std::nullopt;
  }
  if (!named.value->empty())
    return included_name(properties.name, *named.value);
  found.push_back(file_error(
      "BT0003", properties.name,
      fmt::format("`{0}` names no tree; write btcheck TREE --prop {0}",
                  properties.name)));
  return std::nullopt;
}

// The options with what the settings say; nothing where those are wrong.
std::optional<Options> with_settings(const InputFile& tree,
                                     const Options& options,
                                     std::vector<Diagnostic>& found) {
  Options all = options;
  all.judgement.directory = current_directory();
  const std::string name = settings_file(options, tree.name);
  if (name.empty()) return all;
  const auto file = text_of_settings(options, name);
  append(found, file.diagnostics);
  if (!file.value) return std::nullopt;
  const auto settings =
      read_settings(all.judgement.directory, name, file.value->text);
  append(found, settings.diagnostics);
  if (!settings.value) return std::nullopt;
  return settled(all, *settings.value, tree.name, tree.text);
}

// A file of rules names the tree of these commands, and where time passes.
void take_ticks(const InputFile& properties, Options& options) {
  if (options.ticks) return;
  if (options.command != Command::Space &&
      options.command != Command::Simulate && options.command != Command::Run) {
    return;
  }
  const auto read = read_properties(properties.name, properties.text);
  if (!read.value || !read.value->ticks) return;
  options.ticks = tick_semantics(*read.value->ticks);
}

}  // namespace

std::string current_directory() {
  std::error_code fault;
  return fs::current_path(fault).string();
}

Result<InputFile> text_of_settings(const Options& options,
                                   const std::string& name) {
  std::vector<std::string> roots = options.roots;
  if (options.settings.empty() && !options.given.contains("--root")) {
    const fs::path folder = fs::path(name).parent_path();
    roots.push_back(folder.empty() ? "." : folder.string());
  }
  return read_file_in(roots, name);
}

std::string settings_file(const Options& options, const std::string& tree) {
  if (options.ignores_settings || !options.settings.empty()) {
    return options.settings;
  }
  const fs::path here = current_directory();
  const fs::path named = is_given(tree) ? fs::path("tree") : fs::path(tree);
  const fs::path from = (here / named).lexically_normal().parent_path();
  const Surroundings around = surroundings_of(from);
  const auto shown = [&](const fs::path& file) {
    return named.is_absolute() ? file.string()
                               : file.lexically_relative(here).string();
  };
  // One that comes to lie nearer to the tree counts from then on.
  for (fs::path folder = from;; folder = folder.parent_path()) {
    LookedAt::note_file(shown(folder / kSettingsFile));
    if (folder == around.settings || folder == around.repository ||
        !folder.has_relative_path()) {
      break;
    }
  }
  return around.settings.empty() ? "" : shown(around.settings / kSettingsFile);
}

Excludes excludes_of(const Options& options, const std::string& folder) {
  const std::string name = settings_file(options, folder + "/tree");
  if (name.empty()) return {};
  const auto file = text_of_settings(options, name);
  if (!file.value) return {};
  const auto settings =
      read_settings(current_directory(), name, file.value->text);
  return settings.value ? settings.value->excludes : Excludes();
}

void tell_settings(const Options& options, const std::string& tree) {
  if (!options.is_verbose) return;
  const std::string name = settings_file(options, tree);
  if (!name.empty()) tell(fmt::format("settings: {}\n", name));
}

bool take_baseline(Options& options) {
  options.judgement.directory = current_directory();
  if (options.baseline.empty()) return true;
  const auto file = read_file(options.baseline);
  show(options, file.diagnostics);
  if (!file.value) return false;
  auto read = read_baseline(options.judgement.directory, options.baseline,
                            file.value->text);
  show(options, read.diagnostics);
  if (!read.value) return false;
  options.judgement.baseline = std::move(*read.value);
  options.judgement.has_baseline = true;
  return true;
}

namespace {

// A batch has read its trees and some of their rules.
Result<InputFile> read_once(const Options& options, const std::string& name) {
  const InputFile* known =
      options.project == nullptr ? nullptr : options.project->read_file(name);
  if (known == nullptr) return read_file_in(options.roots, name);
  LookedAt::note_file(name);
  return {*known, {}};
}

// `inputs` has the files of rules, where there are any.
std::optional<Inputs> with_tree(InputFile tree, Inputs inputs,
                                const Options& options,
                                std::vector<Diagnostic>& found) {
  auto all = with_settings(tree, options, found);
  if (!all) return std::nullopt;
  allow(*all);
  if (is_property_file(options.input) && !inputs.properties.empty()) {
    take_ticks(inputs.properties[0], *all);
  }
  FileSources sources(tree, *all);
  auto reading = reading_of(tree, reading_choices(*all), sources, found);
  if (!reading) return std::nullopt;
  for (const InputFile& file : reading->neighbours) {
    LookedAt::note_file(file.name);
  }
  inputs.tree = {std::move(tree), std::move(*reading)};
  inputs.options = std::move(*all);
  return inputs;
}

}  // namespace

std::optional<Inputs> gather_inputs(const std::string& tree,
                                    const std::vector<std::string>& properties,
                                    const Options& options,
                                    std::vector<Diagnostic>& found) {
  Inputs inputs;
  std::vector<std::string> names = properties;
  if (is_property_file(tree)) names.insert(names.begin(), tree);
  for (const std::string& name : names) {
    auto read = read_once(options, name);
    append(found, read.diagnostics);
    if (read.value) inputs.properties.push_back(std::move(*read.value));
  }
  if (inputs.properties.size() < names.size()) return std::nullopt;
  if (!options.rules.empty())
    inputs.properties.push_back(typed_rules(options.rules));
  std::optional<std::string> tree_name = tree;
  if (is_property_file(tree)) {
    tree_name = tree_named_by(inputs.properties[0], found);
    if (!tree_name) return std::nullopt;
  }
  auto read = read_once(options, *tree_name);
  append(found, read.diagnostics);
  if (!read.value) return std::nullopt;
  return with_tree(std::move(*read.value), std::move(inputs), options, found);
}

std::optional<Inputs> inputs_of(InputFile tree, const Options& options,
                                std::vector<Diagnostic>& found) {
  return with_tree(std::move(tree), {}, options, found);
}

std::optional<Inputs> read_inputs(const Options& options,
                                  std::vector<Diagnostic>& found) {
  auto inputs =
      gather_inputs(options.input, options.properties, options, found);
  if (inputs) tell_settings(options, inputs->tree.name);
  show(options, found);
  return inputs;
}

std::optional<Lowered> read_and_lower(const Options& options) {
  std::vector<Diagnostic> found;
  auto inputs = read_inputs(options, found);
  if (!inputs) return std::nullopt;
  return lowered_from(std::move(*inputs), options);
}

std::optional<Lowered> lowered_from(Inputs inputs, const Options& options) {
  auto lowered =
      lowered_input(inputs.tree, inputs.options.judgement,
                    inputs.options.ticks.value_or(TickSemantics::Root));
  show(options, lowered.diagnostics);
  if (!lowered.value) return std::nullopt;
  return Lowered{std::move(*lowered.value), std::move(inputs.tree)};
}

// --- Messages ------------------------------------------------------------

namespace {

constexpr std::size_t kMostDiagnostics = 20;

bool wants_color(const Options& options, int descriptor) {
  if (options.color != When::Auto) return options.color == When::Always;
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') &&
         ::isatty(descriptor) != 0 && !is_dumb_terminal();
}

}  // namespace

std::vector<Diagnostic> without_repetitions(
    const std::vector<Diagnostic>& diagnostics) {
  std::vector<Diagnostic> distinct;
  for (const Diagnostic& diagnostic : diagnostics) {
    auto same = std::find_if(distinct.begin(), distinct.end(),
                             [&](const Diagnostic& known) {
                               return known.severity != Severity::Error &&
                                      known.code == diagnostic.code &&
                                      known.file == diagnostic.file &&
                                      known.message == diagnostic.message;
                             });
    if (same == distinct.end()) {
      distinct.push_back(diagnostic);
    } else {
      same->label += fmt::format(
          "{}line {}",
          same->label.find("line ") == std::string::npos ? "; also on " : ", ",
          diagnostic.span.line);
    }
  }
  return distinct;
}

std::string shown(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Severity severity :
       {Severity::Error, Severity::Warning, Severity::Note}) {
    std::size_t count = 0;
    for (const Diagnostic& diagnostic : without_repetitions(diagnostics)) {
      if (diagnostic.severity != severity) continue;
      if (count++ < kMostDiagnostics) text += render(diagnostic) + '\n';
    }
    if (count > kMostDiagnostics) {
      text += fmt::format("and {} more\n\n", count - kMostDiagnostics);
    }
  }
  return text;
}

std::string painted(const Options& options, std::string_view text,
                    int descriptor) {
  std::string clean = readable(text);
  return wants_color(options, descriptor) ? colored(clean) : clean;
}

void show(const Options& options, const std::vector<Diagnostic>& diagnostics) {
  tell_exactly(painted(options, shown(diagnostics), STDERR_FILENO));
}

void complain(std::string_view code, std::string_view message) {
  tell(fmt::format("error[{}]: {}\n", code, message));
}

ExitCode write_output(const std::string& file, const std::string& text) {
  if (file.empty()) {
    print_exactly(text);
    return ExitCode::Met;
  }
  const std::string complaint = write_file(file, text);
  if (!complaint.empty()) complain("BT0004", complaint);
  return complaint.empty() ? ExitCode::Met : ExitCode::BadInput;
}

}  // namespace btcheck

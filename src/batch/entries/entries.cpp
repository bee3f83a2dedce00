// SPDX-License-Identifier: MIT
#include "batch/entries/entries.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include "batch/entries/folder_search.hpp"
#include "batch/entries/manifest.hpp"
#include "cli/inputs/files.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolderManifest = "batch.toml";

bool is_folder(const std::string& name) {
  std::error_code fault;
  return fs::is_directory(name, fault);
}

// The manifest that a source is or has; "" for a folder without one.
std::string manifest_of(const std::string& source) {
  if (!is_folder(source)) return source;
  std::error_code fault;
  const fs::path own = (fs::path(source) / kFolderManifest).lexically_normal();
  return fs::is_regular_file(own, fault) ? own.string() : std::string();
}

BatchEntry broken(const std::string& name, std::vector<Diagnostic> found) {
  BatchEntry entry;
  entry.name = entry.input = name;
  entry.diagnostics = std::move(found);
  return entry;
}

std::string beside(const std::string& manifest, const std::string& file) {
  return fs::path(path_beside(manifest, file)).lexically_normal().string();
}

// What the entry is about, for reports and for people.
std::string default_name(const BatchEntry& entry) {
  return entry.properties.empty() ? entry.input : entry.properties[0];
}

// Files of contracts are named from the manifest, too.
EntryChoices choices_of(const std::string& manifest,
                        const ManifestEntry& said) {
  EntryChoices choices = said.choices;
  if (choices.leaves) {
    for (std::string& file : *choices.leaves) file = beside(manifest, file);
  }
  return choices;
}

BatchEntry single(const std::string& manifest, ManifestEntry&& said) {
  BatchEntry entry;
  for (const std::string& file : said.properties) {
    entry.properties.push_back(beside(manifest, file));
  }
  if (!said.tree.empty()) {
    entry.input = beside(manifest, said.tree);
  } else if (!entry.properties.empty()) {
    entry.input = entry.properties[0];
    entry.properties.erase(entry.properties.begin());
  } else {
    entry.input = manifest;  // and there is a diagnostic
  }
  entry.name = said.name.empty() ? default_name(entry) : said.name;
  entry.choices = choices_of(manifest, said);
  entry.expected = std::move(said.expected);
  entry.diagnostics = std::move(said.diagnostics);
  return entry;
}

void add(std::vector<BatchEntry>& to, std::vector<BatchEntry> found) {
  to.insert(to.end(), std::make_move_iterator(found.begin()),
            std::make_move_iterator(found.end()));
}

void add_manifest(std::vector<BatchEntry>& to, const std::string& name) {
  const auto file = read_file(name);
  if (!file.value) {
    to.push_back(broken(name, file.diagnostics));
    return;
  }
  Manifest manifest = read_manifest(name, file.value->text);
  if (has_error(manifest.diagnostics)) {
    to.push_back(broken(name, std::move(manifest.diagnostics)));
  }
  for (ManifestEntry& said : manifest.entries) {
    if (said.folder.empty() || has_error(said.diagnostics)) {
      to.push_back(single(name, std::move(said)));
      continue;
    }
    auto found = entries_in(beside(name, said.folder), said.exclude);
    for (BatchEntry& entry : found) entry.choices = choices_of(name, said);
    add(to, std::move(found));
  }
}

BatchEntry refused(const std::string& source) {
  Diagnostic diagnostic;
  diagnostic.code = "BT1501";
  diagnostic.message =
      fmt::format("`{}` is neither a folder nor a manifest", source);
  diagnostic.file = source;
  diagnostic.help = fmt::format(
      "a manifest ends in .toml; `btcheck {}` checks a single tree", source);
  return broken(source, {std::move(diagnostic)});
}

void add_source(std::vector<BatchEntry>& to, const std::string& source) {
  const std::string manifest = manifest_of(source);
  std::error_code fault;
  if (manifest.empty()) {
    add(to, entries_in(source, {}));
  } else if (manifest.ends_with(".toml") || !fs::exists(manifest, fault)) {
    add_manifest(to, manifest);
  } else {
    to.push_back(refused(source));
  }
}

// `name` if it is new, else `name#2`, …
std::string unused(std::set<std::string>& used, const std::string& name,
                   char mark) {
  std::string candidate = name;
  for (int i = 2; !used.insert(candidate).second; ++i) {
    candidate = fmt::format("{}{}{}", name, mark, i);
  }
  return candidate;
}

void make_names_unique(std::vector<BatchEntry>& entries) {
  std::set<std::string> names;
  std::set<std::string> folders;
  for (BatchEntry& entry : entries) {
    entry.name = unused(names, entry.name, '#');
    entry.folder = unused(folders, plain_word(entry.name, "-"), '-');
  }
}

}  // namespace

Batch gather_batch(const BatchOptions& options) {
  std::vector<BatchEntry> all;
  for (const std::string& source : options.sources) add_source(all, source);
  make_names_unique(all);
  Batch batch;
  batch.all = all.size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (options.shard.has(i)) batch.entries.push_back(std::move(all[i]));
  }
  return batch;
}

std::string results_file(const BatchOptions& options) {
  const std::string& source = options.sources.at(0);
  const std::string manifest = manifest_of(source);
  const fs::path file(manifest);
  const fs::path folder =
      manifest.empty() ? fs::path(source) : file.parent_path();
  std::string name = ".btcheck-results";
  if (!manifest.empty() && file.filename() != kFolderManifest) {
    name += "-" + file.stem().string();
  }
  const Shard& shard = options.shard;
  if (shard.count > 1) name += fmt::format("-{}-{}", shard.index, shard.count);
  return (folder / name).lexically_normal().string();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "batch/entries/entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "batch/entries/manifest.hpp"
#include "cli/inputs/file_sources.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/looked_at.hpp"
#include "cli/settings/choices.hpp"
#include "ltl/rules/property.hpp"
#include "model/foreign_format.hpp"
#include "model/tree_file.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolderManifest = "batch.toml";

// An entry that stands for a source that cannot be read.
BatchEntry broken(const std::string& name, std::vector<Diagnostic> found) {
  BatchEntry entry;
  entry.name = entry.input = name;
  entry.diagnostics = std::move(found);
  return entry;
}

BatchEntry refused(const std::string& source, std::string_view code,
                   std::string message, std::string help = {}) {
  return broken(
      source, {file_error(code, source, std::move(message), std::move(help))});
}

BatchEntry entry_of(const std::string& name, const std::string& input,
                    std::shared_ptr<const XmlProject> project) {
  BatchEntry entry;
  entry.name = name;
  entry.input = fs::path(input).lexically_normal().string();
  entry.project = std::move(project);
  return entry;
}

// One of several trees of a file.
BatchEntry entry_for(const std::string& name, const std::string& tree,
                     const std::shared_ptr<const XmlProject>& project) {
  BatchEntry entry = entry_of(fmt::format("{}#{}", name, tree), name, project);
  entry.choices.push_back(
      {"--main-tree", [tree](Options& chosen) { chosen.main_tree = tree; }});
  return entry;
}

// The entries of one XML file of a project: an ID of a tree goes with the name
// where the file has several.
void add_entries_of(const ProjectFile& file, const XmlProject& among,
                    const std::shared_ptr<const XmlProject>& project,
                    std::vector<BatchEntry>& to) {
  const std::string& name = file.file.name;
  for (const std::string& tree : among.entries_of(file)) {
    if (tree.empty()) {
      to.push_back(entry_of(name, name, project));
    } else {
      to.push_back(entry_for(name, tree, project));
    }
  }
}

// A .btproj has no trees of its own: what the files that it includes run, each
// under its name where there are several and the user names none.
void add_entries_of_btproj(const ProjectFile& file, const XmlProject& among,
                           const std::shared_ptr<const XmlProject>& project,
                           const std::string& main_tree,
                           std::vector<BatchEntry>& to) {
  const std::string& name = file.file.name;
  std::vector<std::string> trees;
  for (const std::string& path : file.outline.includes) {
    const ProjectFile* part = among.file(included_name(name, path));
    if (part == nullptr) continue;
    std::ranges::move(among.roots_of(*part), std::back_inserter(trees));
  }
  std::erase(trees, "");
  if (trees.size() < 2 || file.outline.main || !main_tree.empty()) {
    to.push_back(entry_of(name, name, project));
    return;
  }
  for (const std::string& tree : trees) {
    to.push_back(entry_for(name, tree, project));
  }
}

class FolderSearch {
 public:
  FolderSearch(const std::string& folder,
               const std::vector<std::string>& exclude,
               const Excludes& settings, std::vector<std::string> roots)
      : folder_(fs::path(folder).lexically_normal()),
        roots_(std::move(roots)),
        settings_(settings) {
    if (roots_.empty()) roots_ = {folder_.string()};
    for (const std::string& name : exclude) {
      fs::path path = (folder_ / name).lexically_normal();
      if (!path.has_filename()) path = path.parent_path();  // `drafts/`
      excluded_.insert(path.string());
    }
  }

  std::vector<BatchEntry> search() {
    collect();
    for (const std::string& name : properties_) add_pair(name);
    for (const std::string& tree : trees_) {
      if (!asked_of_.contains(tree)) entries_.push_back(of(tree, tree));
    }
    add_xml_trees();
    std::sort(entries_.begin(), entries_.end(),
              [](const BatchEntry& one, const BatchEntry& other) {
                return one.name < other.name;
              });
    if (!entries_.empty()) return std::move(entries_);
    return {refused(folder_.string(), "BT1507",
                    fmt::format("nothing to check in `{}`", folder_.string()),
                    "trees end in .btf, .xml or .btproj, property files in "
                    ".ltl or .btp")};
  }

 private:
  // The files, folder by folder, and folders that cannot be read.
  void collect() {
    const auto found = files_in(folder_.string(), excluded_, settings_);
    for (const Diagnostic& fault : found.diagnostics) {
      entries_.push_back(refused(fault.file, fault.code, fault.message));
    }
    for (const std::string& name : *found.value) take(name);
  }

  void take(const std::string& name) {
    if (is_property_file(name)) {
      properties_.push_back(name);
    } else if (name.ends_with(".btf") ||
               (is_xml_name(name) && unbroken(name) != name)) {
      trees_.insert(name);  // a name that is refused is told
    } else {
      add_file(*project_, roots_, name);
    }
  }

  void add_xml_trees() {
    for (const ProjectFile& file : project_->files()) {
      if (asked_of_.contains(file.file.name)) continue;
      add_entries_of(file, *project_, project_, entries_);
    }
  }

  void add_pair(const std::string& properties) {
    const std::string tree = tree_for(properties);
    if (tree.empty()) {
      entries_.push_back(of(properties, properties));
      return;
    }
    asked_of_.insert(fs::path(tree).lexically_normal().string());
    entries_.push_back(of(properties, tree));
    entries_.back().properties = {properties};
  }

  // "" where none can be found, or the file cannot be read: the check says so.
  std::string tree_for(const std::string& properties) {
    const auto read = read_file_in(roots_, properties);
    if (!read.value) return {};
    project_->add_rules(*read.value);
    const auto named = tree_of_properties(*read.value);
    if (named.value && !named.value->empty()) {
      return included_name(properties, *named.value);
    }
    std::error_code fault;
    for (const std::string_view ending : {".btf", ".xml", ".btproj"}) {
      const fs::path tree = fs::path(properties).replace_extension(ending);
      if (fs::exists(tree, fault)) return tree.string();
    }
    return {};
  }

  BatchEntry of(const std::string& name, const std::string& input) const {
    return entry_of(name, input, project_);
  }

  fs::path folder_;
  std::vector<std::string> roots_;
  std::set<std::string> excluded_;
  const Excludes& settings_;
  std::vector<std::string> properties_;
  std::set<std::string> trees_;
  std::shared_ptr<XmlProject> project_ = std::make_shared<XmlProject>();
  std::set<std::string> asked_of_;  // trees that property files are about
  std::vector<BatchEntry> entries_;
};

// The manifest that a source is or has; "" for a folder without one.
std::string manifest_of(const std::string& source) {
  if (!is_folder(source)) return source;
  std::error_code fault;
  const fs::path own = (fs::path(source) / kFolderManifest).lexically_normal();
  return fs::is_regular_file(own, fault) ? own.string() : std::string();
}

BatchEntry single(const std::string& manifest, ManifestEntry&& said) {
  BatchEntry entry;
  for (const std::string& file : said.properties) {
    entry.properties.push_back(included_name(manifest, file));
  }
  if (!said.tree.empty()) {
    entry.input = included_name(manifest, said.tree);
  } else if (!entry.properties.empty()) {
    entry.input = entry.properties[0];
    entry.properties.erase(entry.properties.begin());
  } else {
    entry.input = manifest;  // and there is a diagnostic
  }
  entry.name = std::move(said.name);
  if (entry.name.empty()) {
    entry.name = entry.properties.empty() ? entry.input : entry.properties[0];
  }
  entry.choices = std::move(said.choices);
  entry.expected = std::move(said.expected);
  entry.diagnostics = std::move(said.diagnostics);
  return entry;
}

void add_manifest(std::vector<BatchEntry>& to, const std::string& name,
                  const Options& options) {
  const auto file = read_file_in(options.roots, name);
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
    const std::string folder = included_name(name, said.folder);
    if (auto refused = refusal_outside(options.roots, folder)) {
      to.push_back(broken(folder, {std::move(*refused)}));
      continue;
    }
    auto found = entries_in(folder, said.exclude, excludes_of(options, folder),
                            options.roots);
    for (BatchEntry& entry : found) {
      entry.choices.insert(entry.choices.begin(), said.choices.begin(),
                           said.choices.end());
    }
    std::ranges::move(found, std::back_inserter(to));
  }
}

void add_source(std::vector<BatchEntry>& to, const std::string& source,
                const Options& options) {
  const std::string manifest = manifest_of(source);
  std::error_code fault;
  if (manifest.empty()) {
    std::ranges::move(
        entries_in(source, {}, excludes_of(options, source), options.roots),
        std::back_inserter(to));
  } else if (manifest.ends_with(".toml") || !fs::exists(manifest, fault)) {
    add_manifest(to, manifest, options);
  } else {
    const auto read = read_file_in(options.roots, manifest);
    auto foreign =
        refusal_of_foreign(source, read.value ? read.value->text : "");
    to.push_back(
        foreign ? broken(source, {std::move(*foreign)})
                : refused(source, "BT1501",
                          fmt::format("`{}` is no folder, tree or manifest",
                                      source),
                          "a tree ends in .btf, .xml or .btproj, a manifest in "
                          ".toml"));
  }
}

// Trees that are named one by one know each other, and what lies beside them.
class NamedTrees {
 public:
  explicit NamedTrees(const Options& options) : options_(options) {}

  void add(const std::string& source) {
    const fs::path file = fs::path(source).lexically_normal();
    names_.push_back(file.string());
    std::vector<std::string> roots = options_.roots;
    if (roots.empty()) roots = {(file.parent_path() / ".").string()};
    add_named(names_.back(), roots);
    add_beside(*project_, roots, names_.back());
    if (is_project_name(names_.back())) add_parts(names_.back());
  }

  void add_entries(std::vector<BatchEntry>& to) const {
    for (const std::string& name : names_) {
      const ProjectFile* file = named_.file(name);
      if (file == nullptr) {
        to.push_back(entry_of(name, name, project_));
      } else if (is_project_name(name) && file->outline.trees.empty()) {
        add_entries_of_btproj(*file, named_, project_, options_.main_tree, to);
      } else {
        add_entries_of(*file, named_, project_, to);
      }
    }
  }

 private:
  void add_named(const std::string& name,
                 const std::vector<std::string>& roots) {
    add_file(named_, roots, name);
    const ProjectFile* file = named_.file(name);
    if (file != nullptr && project_->is_new(name)) {
      project_->add(name, file->file.text);
    }
  }

  void add_parts(const std::string& name) {
    const ProjectFile* file = named_.file(name);
    if (file == nullptr) return;
    const std::vector<std::string> paths = file->outline.includes;
    for (const std::string& path : paths) {
      add_named(included_name(name, path), options_.roots);
    }
  }

  const Options& options_;
  XmlProject named_;
  std::shared_ptr<XmlProject> project_ = std::make_shared<XmlProject>();
  std::vector<std::string> names_;
};

void add_trees(std::vector<BatchEntry>& to, const Options& options) {
  NamedTrees named(options);
  for (const std::string& source : options.batch.sources) {
    if (names_tree(source)) named.add(source);
  }
  named.add_entries(to);
}

void make_names_unique(std::vector<BatchEntry>& entries) {
  std::set<std::string> names;
  std::set<std::string> folders;
  for (BatchEntry& entry : entries) {
    entry.name = unused_name(names, entry.name, "#");
    entry.folder = unused_name(folders, plain_word(entry.name, "-"), "-");
  }
}

}  // namespace

// Folder by folder. Those that are links are not followed, so this ends.
Result<std::vector<std::string>> files_in(const std::string& folder,
                                          const std::set<std::string>& exclude,
                                          const Excludes& settings) {
  std::vector<std::string> files;
  std::vector<Diagnostic> faults;
  std::vector<fs::path> folders = {fs::path(folder).lexically_normal()};
  const auto take = [&](const fs::directory_entry& found) {
    const fs::path path = found.path().lexically_normal();
    std::error_code fault;
    if (path.filename().string().starts_with('.') ||
        exclude.contains(path.string()) ||
        settings.has(fs::absolute(path, fault).lexically_normal().string())) {
      return;
    }
    if (!found.is_directory(fault)) {
      files.push_back(path.string());
    } else if (!found.is_symlink(fault)) {
      folders.push_back(path);
    }
  };
  while (!folders.empty()) {
    const fs::path next = std::move(folders.back());
    folders.pop_back();
    LookedAt::note_folder(next.string());
    std::error_code fault;
    fs::directory_iterator at(next, fault);
    for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
      take(*at);
    }
    if (!fault) continue;
    faults.push_back(file_error("BT0002", next.string(),
                                fmt::format("cannot read the folder `{}`: {}",
                                            next.string(), fault.message())));
  }
  std::ranges::sort(files);
  return {std::move(files), std::move(faults)};
}

std::vector<BatchEntry> entries_in(const std::string& folder,
                                   const std::vector<std::string>& exclude,
                                   const Excludes& settings,
                                   std::vector<std::string> roots) {
  return FolderSearch(folder, exclude, settings, std::move(roots)).search();
}

std::vector<BatchEntry> gather_batch(const Options& options) {
  std::vector<BatchEntry> all;
  add_trees(all, options);
  for (const std::string& source : options.batch.sources) {
    if (!names_tree(source)) add_source(all, source, options);
  }
  make_names_unique(all);
  std::vector<BatchEntry> entries;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (options.batch.shard.has(i)) entries.push_back(std::move(all[i]));
  }
  return entries;
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

// SPDX-License-Identifier: MIT
#include "batch/entries/folder_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

BatchEntry refused(const std::string& folder, std::string code,
                   std::string message, std::string help = {}) {
  Diagnostic diagnostic;
  diagnostic.code = std::move(code);
  diagnostic.message = std::move(message);
  diagnostic.file = folder;
  diagnostic.help = std::move(help);
  BatchEntry entry;
  entry.name = entry.input = folder;
  entry.diagnostics.push_back(std::move(diagnostic));
  return entry;
}

class FolderSearch {
 public:
  FolderSearch(const std::string& folder,
               const std::vector<std::string>& exclude)
      : folder_(fs::path(folder).lexically_normal()) {
    for (const std::string& name : exclude) {
      fs::path path = (folder_ / name).lexically_normal();
      if (!path.has_filename()) path = path.parent_path();  // `drafts/`
      excluded_.insert(path.string());
    }
  }

  std::vector<BatchEntry> search() {
    collect();
    if (!problem_.diagnostics.empty()) return {problem_};
    for (const std::string& name : properties_) add_pair(name);
    for (const std::string& tree : trees_) {
      if (!asked_of_.contains(tree)) entries_.push_back(of(tree, tree));
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const BatchEntry& one, const BatchEntry& other) {
                return one.name < other.name;
              });
    if (!entries_.empty()) return std::move(entries_);
    return {refused(folder_.string(), "BT1507",
                    fmt::format("nothing to check in `{}`", folder_.string()),
                    "trees end in .btf, property files in .ltl or .btp")};
  }

 private:
  // The files, folder by folder. Folders that are links are not followed, so
  // this ends.
  void collect() {
    std::vector<fs::path> folders = {folder_};
    while (!folders.empty() && problem_.diagnostics.empty()) {
      const fs::path folder = std::move(folders.back());
      folders.pop_back();
      std::error_code fault;
      fs::directory_iterator at(folder, fault);
      for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
        take(*at, folders);
      }
      if (fault) {
        problem_ = refused(folder.string(), "BT0002",
                           fmt::format("cannot read the folder `{}`: {}",
                                       folder.string(), fault.message()));
      }
    }
    std::sort(properties_.begin(), properties_.end());
  }

  void take(const fs::directory_entry& found, std::vector<fs::path>& folders) {
    const fs::path path = found.path().lexically_normal();
    const std::string name = path.string();
    if (path.filename().string().starts_with('.')) return;
    if (excluded_.contains(name)) return;
    std::error_code fault;
    if (found.is_directory(fault)) {
      if (!found.is_symlink(fault)) folders.push_back(path);
    } else if (is_property_file(name)) {
      properties_.push_back(name);
    } else if (name.ends_with(".btf")) {
      trees_.insert(name);
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
  static std::string tree_for(const std::string& properties) {
    const auto read = read_file(properties);
    if (!read.value) return {};
    const auto named = tree_of_properties(*read.value);
    if (named.value && !named.value->empty()) {
      return path_beside(properties, *named.value);
    }
    std::error_code fault;
    for (const std::string_view ending : {".btf", ".xml", ".btproj"}) {
      const fs::path beside = fs::path(properties).replace_extension(ending);
      if (fs::exists(beside, fault)) return beside.string();
    }
    return {};
  }

  static BatchEntry of(const std::string& name, const std::string& input) {
    BatchEntry entry;
    entry.name = name;
    entry.input = fs::path(input).lexically_normal().string();
    return entry;
  }

  fs::path folder_;
  std::set<std::string> excluded_;
  std::vector<std::string> properties_;
  std::set<std::string> trees_;
  std::set<std::string> asked_of_;  // trees that property files are about
  std::vector<BatchEntry> entries_;
  BatchEntry problem_;
};

}  // namespace

std::vector<BatchEntry> entries_in(const std::string& folder,
                                   const std::vector<std::string>& exclude) {
  return FolderSearch(folder, exclude).search();
}

}  // namespace btcheck

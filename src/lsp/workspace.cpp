// SPDX-License-Identifier: MIT
#include "lsp/workspace.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "check/check.hpp"
#include "cli/inputs/files.hpp"
#include "model/tree_file.hpp"

namespace btcheck::lsp {
namespace {

namespace fs = std::filesystem;

constexpr int kMostEntries = 50'000;  // of folders that are looked at
constexpr std::uintmax_t kMostBytes = 1 << 20;
constexpr std::size_t kMostSubjects = 16;  // of one document

bool is_of_others(const std::string& name) {
  return name.starts_with('.') || name == "node_modules" || name == "build" ||
         name == "install" || name == "log";
}

std::string_view models_in(std::string_view text) {
  const std::size_t begin = text.find("<TreeNodesModel");
  if (begin == text.npos) return {};
  const std::size_t end = text.rfind("</TreeNodesModel");
  return text.substr(begin, end == text.npos ? end : end - begin);
}

// Whether all is equal that other files may have to do with.
bool is_alike(const std::optional<XmlOutline>& one, std::string_view one_text,
              const std::optional<XmlOutline>& other,
              std::string_view other_text) {
  if (!one || !other) return one.has_value() == other.has_value();
  const auto all = [](const XmlOutline& of) {
    return std::tie(of.trees, of.uses, of.includes, of.main, of.has_models,
                    of.has_node_models);
  };
  return all(*one) == all(*other) &&
         (!other->has_node_models ||
          models_in(one_text) == models_in(other_text));
}

}  // namespace

void Workspace::read(const std::vector<std::string>& folders) {
  files_.clear();
  project_.reset();
  int looks = kMostEntries;
  std::vector<fs::path> open(folders.begin(), folders.end());
  while (!open.empty()) {
    const fs::path folder = std::move(open.back());
    open.pop_back();
    std::error_code fault;
    fs::directory_iterator at(folder, fault);
    for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
      if (--looks < 0 || files_.size() >= kMostFiles) return;
      const std::string name = at->path().filename().string();
      std::error_code ignored;
      if (is_of_others(name) || at->is_symlink(ignored)) continue;
      if (at->is_directory(ignored)) {
        open.push_back(at->path());
        continue;
      }
      const std::string path = at->path().lexically_normal().string();
      if (kind_of(path, {}) == FileKind::Other ||
          at->file_size(ignored) > kMostBytes) {
        continue;
      }
      auto text = read_file(path);
      if (text.value) put(path, text.value->text);
    }
  }
}

bool Workspace::put(const std::string& path, const FileText& text) {
  const auto known = files_.find(path);
  const FileKind kind = kind_of(path, text.text());
  if (kind == FileKind::Other) return false;
  if (kind != FileKind::Xml) {
    const bool is_new = known == files_.end();
    const bool is_other = is_new || !(known->second == text);
    const std::string tree = kind == FileKind::Rules ? tree_of(path) : "";
    files_[path] = text;
    if (kind == FileKind::Leaves) return is_other;
    return is_new || (kind == FileKind::Rules && tree_of(path) != tree);
  }
  const FileText old = known == files_.end() ? FileText() : known->second;
  const auto before =
      known == files_.end() ? std::nullopt : outline_of(known->second);
  const auto after = outline_of(text);
  if (after) {
    files_[path] = text;
  } else if (known != files_.end()) {
    files_.erase(known);
  }
  if (is_alike(before, old.text(), after, text.text())) return false;
  project_.reset();
  return true;
}

bool Workspace::remove(const std::string& path) {
  if (files_.erase(path) == 0) return false;
  project_.reset();
  return true;
}

const XmlProject& Workspace::project() const {
  if (!project_) {
    project_.emplace();
    for (const auto& [path, text] : files_) {
      if (project_->is_new(path)) project_->add(path, text);
    }
  }
  return *project_;
}

std::vector<Subject> Workspace::entries_of(const ProjectFile& file) const {
  std::vector<Subject> all;
  for (std::string& tree : project().entries_of(file)) {
    all.push_back({file.file.name, std::move(tree), {}});
  }
  return all;
}

std::vector<Subject> Workspace::users_of(const ProjectFile& file) const {
  std::set<const ProjectFile*> seen = {&file};
  std::vector<const ProjectFile*> waiting = {&file};
  std::vector<Subject> found;
  while (!waiting.empty()) {
    const ProjectFile* used = waiting.back();
    waiting.pop_back();
    for (const ProjectFile& other : project().files()) {
      if (seen.contains(&other)) continue;
      const bool uses_it =
          std::ranges::any_of(used->outline.trees,
                              [&](const std::string& tree) {
                                return !tree.empty() &&
                                       other.outline.uses.contains(tree);
                              }) ||
          std::ranges::any_of(other.outline.includes, [&](const auto& path) {
            return included_name(other.file.name, path) == used->file.name;
          });
      if (!uses_it) continue;
      seen.insert(&other);
      waiting.push_back(&other);
      std::ranges::move(entries_of(other), std::back_inserter(found));
    }
  }
  return found;
}

std::string Workspace::tree_of(const std::string& rules) const {
  const auto text = files_.find(rules);
  if (text == files_.end()) return {};
  const auto named = tree_of_properties({rules, text->second});
  if (named.value && !named.value->empty()) {
    return included_name(rules, *named.value);
  }
  std::error_code fault;
  for (const std::string_view ending : {".btf", ".xml", ".btproj"}) {
    std::string tree = fs::path(rules).replace_extension(ending).string();
    if (files_.contains(tree) || fs::exists(tree, fault)) return tree;
  }
  return {};
}

std::vector<std::string> Workspace::rules_of(const std::string& tree) const {
  std::vector<std::string> all;
  for (const auto& [path, text] : files_) {
    if (kind_of(path, {}) == FileKind::Rules && tree_of(path) == tree) {
      all.push_back(path);
    }
  }
  return all;
}

std::vector<Subject> Workspace::subjects_of(const Document& document) const {
  std::vector<Subject> all;
  if (document.kind == FileKind::Rules) {
    std::string tree = tree_of(document.path);
    if (!tree.empty()) all.push_back({std::move(tree), {}, document.path});
  } else if (document.kind == FileKind::Btf) {
    all.push_back({document.path, {}, {}});
  } else if (document.kind == FileKind::Xml) {
    const ProjectFile* file = project().file(document.path);
    if (file == nullptr) return {};
    all = entries_of(*file);
    if (all.empty()) all = users_of(*file);
    if (all.empty() && !file->outline.trees.empty()) {
      all.push_back({document.path, {}, {}});
    }
  }
  if (document.kind == FileKind::Xml || document.kind == FileKind::Btf) {
    for (std::string& rules : rules_of(document.path)) {
      all.push_back({document.path, {}, std::move(rules)});
    }
  }
  if (all.size() > kMostSubjects) all.resize(kMostSubjects);
  return all;
}

}  // namespace btcheck::lsp

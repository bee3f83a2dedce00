// SPDX-License-Identifier: MIT
#include "project/xml_project.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "model/tree_file.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// What XML was parsed into takes several times its size: of so many bytes it is
// kept for whoever reads the files.
constexpr std::size_t kMostParsed = 8 << 20;

// How many folders lie between the two files.
std::ptrdiff_t distance_of(const fs::path& one, const fs::path& other) {
  const fs::path from = one.parent_path();
  const fs::path to = other.parent_path();
  const auto [end, rest] =
      std::mismatch(from.begin(), from.end(), to.begin(), to.end());
  return std::distance(end, from.end()) + std::distance(rest, to.end());
}

}  // namespace

bool XmlProject::is_new(const std::string& name) {
  return is_xml_name(name) && looked_at_.insert(name).second;
}

void XmlProject::add(const std::string& name, FileText text) {
  auto outline = outline_of(text);
  bytes_ += outline ? text.size() : 0;
  if (!outline || bytes_ > kMostParsed) text.forget_parsed();
  if (!outline) return;
  const auto at = std::ranges::lower_bound(
      files_, name, {},
      [](const ProjectFile& file) { return std::string_view(file.file.name); });
  files_.insert(at, {{name, std::move(text)}, std::move(*outline)});
}

const ProjectFile* XmlProject::file(std::string_view name) const {
  const auto found = std::ranges::find_if(
      files_, [&](const ProjectFile& file) { return file.file.name == name; });
  return found == files_.end() ? nullptr : &*found;
}

const InputFile* XmlProject::read_file(std::string_view name) const {
  if (const ProjectFile* found = file(name)) return &found->file;
  const auto found = std::ranges::find(rules_, name, &InputFile::name);
  return found == rules_.end() ? nullptr : &*found;
}

NearestFile XmlProject::with_tree(std::string_view id,
                                  const std::string& from) const {
  if (id.empty()) return {};
  const ProjectFile* own = file(from);
  if (own != nullptr && own->outline.has(id)) return {own};
  NearestFile nearest;
  std::ptrdiff_t least = 0;
  for (const ProjectFile& file : files_) {
    if (!file.outline.has(id)) continue;
    const std::ptrdiff_t distance = distance_of(from, file.file.name);
    if (nearest.file != nullptr && distance > least) continue;
    if (nearest.file == nullptr || distance < least) {
      nearest = {&file};
      least = distance;
    } else if (file.file.text != nearest.file->file.text) {
      nearest.other = &file;
    }
  }
  return nearest;
}

// By a file with trees: a .btproj lists what there is.
bool XmlProject::is_included(const std::string& name) const {
  return std::ranges::any_of(files_, [&](const ProjectFile& file) {
    return !file.outline.trees.empty() &&
           std::ranges::any_of(
               file.outline.includes, [&](const std::string& path) {
                 return included_name(file.file.name, path) == name;
               });
  });
}

std::vector<std::string> XmlProject::roots_of(const ProjectFile& file) const {
  const XmlOutline& outline = file.outline;
  if (outline.trees.empty() || is_included(file.file.name)) return {};
  if (outline.main) return {*outline.main};
  std::vector<std::string> roots = outline.trees;
  std::erase_if(roots, [&](const std::string& tree) {
    return std::ranges::any_of(files_, [&](const ProjectFile& other) {
      return other.outline.uses.contains(tree) &&
             (&other == &file ||
              with_tree(tree, other.file.name).file == &file);
    });
  });
  return roots;
}

std::vector<std::string> XmlProject::entries_of(const ProjectFile& file) const {
  std::vector<std::string> entries = roots_of(file);
  // The one that is left is found by whoever reads the file.
  if (entries.size() == 1) entries[0].clear();
  return entries;
}

}  // namespace btcheck

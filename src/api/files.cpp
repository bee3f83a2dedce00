// SPDX-License-Identifier: MIT
//
// Texts in memory as sources: the nearest btcheck.toml is looked for as on a
// disk, folder by folder.
#include <filesystem>
#include <utility>

#include "btcheck/check.hpp"

namespace btcheck::v1 {

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

std::optional<NamedText> Files::settings(const std::string& tree) {
  namespace fs = std::filesystem;
  for (fs::path at = fs::path(tree).lexically_normal(); !at.empty();) {
    const fs::path folder = at.parent_path();
    const std::string name = (folder / "btcheck.toml").string();
    if (auto found = text(name)) return NamedText{name, std::move(*found)};
    if (folder == at) break;
    at = folder;
  }
  return std::nullopt;
}

}  // namespace btcheck::v1

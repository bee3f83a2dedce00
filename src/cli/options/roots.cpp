// SPDX-License-Identifier: MIT
#include "cli/options/roots.hpp"

#include <cstdlib>

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// Dotfiles are kept in a repository as well: it holds everything.
bool holds_too_much(const fs::path& folder) {
  const char* home = std::getenv("HOME");
  std::error_code fault;
  return !folder.has_relative_path() ||
         (home != nullptr && fs::equivalent(folder, home, fault));
}

}  // namespace

Surroundings surroundings_of(const fs::path& from) {
  Surroundings found;
  for (fs::path folder = from;; folder = folder.parent_path()) {
    std::error_code fault;
    const auto kind = fs::symlink_status(folder / kSettingsFile, fault).type();
    if (found.settings.empty() && !fault && kind != fs::file_type::not_found) {
      found.settings = folder;
    }
    if (fs::exists(folder / ".git", fault)) found.repository = folder;
    if (!found.repository.empty() || !folder.has_relative_path()) return found;
  }
}

std::string repository_of(const std::string& folder) {
  std::error_code fault;
  const fs::path here = fs::current_path(fault);
  const fs::path place = fs::weakly_canonical(here / folder, fault);
  const Surroundings around = surroundings_of(place);
  for (const fs::path& root : {around.repository, around.settings}) {
    if (root.empty() || holds_too_much(root)) continue;
    const fs::path near = root.lexically_relative(here);
    const bool is_above = near.empty() || *near.begin() == "..";
    return (is_above ? root : near).string();
  }
  return {};
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "cli/inputs/packages.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "cli/inputs/files.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr int kFoldersUp = 3;       // from a tree to the folder of all packages
constexpr int kFoldersDown = 3;     // and down to a package.xml
constexpr int kFoldersToTrees = 6;  // from that folder to a tree

// The name in a package.xml, as every ROS package has one.
std::string package_name(const fs::path& folder) {
  const auto read =
      read_file_in({folder.string()}, (folder / "package.xml").string());
  if (!read.value) return {};
  const std::string& text = read.value->text;
  const auto begin = text.find("<name>");
  const auto end = text.find("</name>");
  if (begin == text.npos || end == text.npos || end < begin) return {};
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks, begin + 6);
  const auto last = text.find_last_not_of(kBlanks, end - 1);
  return text.substr(first, last + 1 - first);
}

bool has_package(const fs::path& folder) {
  std::error_code fault;
  return fs::is_regular_file(folder / "package.xml", fault);
}

// Folders at or below `top`, those nearer to it first, until one is taken.
// `visit(folder)` says whether to go below it.
enum class Visit : std::uint8_t { Below, Beside, Taken };
template <class Visitor>
void visit_folders(const fs::path& top, int depth, int& looks, Visitor visit) {
  std::vector<std::pair<fs::path, int>> folders = {{top, 0}};
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const auto [folder, down] = folders[i];
    const Visit next = visit(folder);
    if (next == Visit::Taken) return;
    if (next == Visit::Beside || down == depth) continue;
    std::error_code fault;
    fs::directory_iterator at(folder, fault);
    for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
      if (--looks < 0) return;
      const bool is_hidden = at->path().filename().string().starts_with('.');
      if (is_hidden || at->is_symlink(fault) || !at->is_directory(fault)) {
        continue;
      }
      folders.emplace_back(folder / at->path().filename(), down + 1);
    }
  }
}

// The folder at or below this one that has the package's package.xml.
std::string package_below(const fs::path& top, std::string_view package,
                          int& looks) {
  std::string found;
  visit_folders(top, kFoldersDown, looks, [&](const fs::path& folder) {
    if (!has_package(folder)) return Visit::Below;
    if (package_name(folder) != package) {
      return Visit::Beside;  // packages do not lie in each other
    }
    found = folder.string();
    return Visit::Taken;
  });
  return found;
}

// As a path from where the program runs, unless it is asked for by a whole one.
std::string as_asked(const fs::path& found, const fs::path& here,
                     const std::string& from) {
  return fs::path(from).is_absolute() ? found.string()
                                      : found.lexically_relative(here).string();
}

// Nothing above it is of the same workspace.
bool is_top(const fs::path& folder) {
  return folder.filename() == "src" || !folder.has_relative_path();
}

// How many folders up from one the next lies that is like that, if not further
// than the folder of all packages.
template <class IsLike>
std::optional<int> folders_up(fs::path folder, IsLike is_like) {
  for (int up = 0; up <= kFoldersUp; ++up, folder = folder.parent_path()) {
    if (is_like(folder)) return up;
  }
  return std::nullopt;
}

// The folder of the package that a file lies in; "" for none.
fs::path package_around(const fs::path& file) {
  fs::path folder = file.lexically_normal().parent_path();
  while (!has_package(folder)) {
    if (is_top(folder)) return {};
    folder = folder.parent_path();
  }
  return folder;
}

// How many folders up from a package the `src` of its workspace is.
std::optional<int> folders_to_workspace(const fs::path& package) {
  return folders_up(package, [](const fs::path& folder) {
    return folder.filename() == "src";
  });
}

}  // namespace

std::string installed_package(std::string_view package) {
  // A tree gives the name: it must not lead elsewhere.
  if (package.find('/') != package.npos || package.starts_with('.')) return {};
  const char* prefixes = std::getenv("AMENT_PREFIX_PATH");
  std::string_view rest = prefixes == nullptr ? "" : prefixes;
  while (!rest.empty()) {
    const auto end = std::min(rest.find(':'), rest.size());
    const fs::path folder = fs::path(rest.substr(0, end)) / "share" / package;
    std::error_code fault;
    if (end > 0 && fs::is_directory(folder, fault)) return folder.string();
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return {};
}

std::string workspace_of(const std::string& from) {
  std::error_code fault;
  fs::path folder = package_around(fs::current_path(fault) / from);
  const auto up = folder.empty() ? std::nullopt : folders_to_workspace(folder);
  if (!up) return {};
  for (int i = 0; i < *up; ++i) folder = folder.parent_path();
  return folder.string();
}

std::string package_folder(std::string_view package, const std::string& from) {
  std::error_code fault;
  const fs::path here = fs::current_path(fault);
  int looks = kMostLooks;
  fs::path folder = (here / from).lexically_normal().parent_path();
  for (int up = 0; up <= kFoldersUp; ++up) {
    const fs::path found = package_below(folder, package, looks);
    if (!found.empty()) return as_asked(found, here, from);
    if (is_top(folder)) break;
    folder = folder.parent_path();
  }
  return {};
}

FilesAround::FilesAround(const std::string& from) : from_(from) {
  std::error_code fault;
  here_ = fs::current_path(fault);
  folder_ = package_around(here_ / from);
  if (folder_.empty()) return;
  // Repositories lie beside each other in a `src`; elsewhere one is all.
  auto up = folders_to_workspace(folder_);
  if (!up) {
    up = folders_up(folder_, [&](const fs::path& folder) {
      return fs::exists(folder / ".git", fault);
    });
  }
  levels_ = 1 + up.value_or(kFoldersUp);
}

std::vector<std::string> FilesAround::next() {
  std::vector<std::string> files;
  visit_folders(folder_, kFoldersToTrees, looks_, [&](const fs::path& at) {
    const fs::path folder = as_asked(at, here_, from_);
    std::error_code fault;
    fs::directory_iterator file(at, fault);
    for (; !fault && file != fs::directory_iterator(); file.increment(fault)) {
      if (file->path().extension() != ".xml") continue;
      files.push_back((folder / file->path().filename()).lexically_normal());
    }
    return Visit::Below;
  });
  levels_ = is_top(folder_) ? 0 : levels_ - 1;
  folder_ = folder_.parent_path();
  return files;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "cli/inputs/packages.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

#include "cli/inputs/files.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr int kFoldersUp = 3;       // from a tree to the folder of all packages
constexpr int kFoldersDown = 3;     // and down to a package.xml
constexpr int kMostLooks = 20'000;  // at names

// The name in a package.xml, as every ROS package has one.
std::string package_name(const std::string& file) {
  const auto read = read_file(file);
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

std::string installed_package(std::string_view package) {
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

// The folder at or below this one that has the package's package.xml.
std::string package_below(const fs::path& top, std::string_view package,
                          int& looks) {
  std::vector<std::pair<fs::path, int>> folders = {{top, 0}};
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const auto [folder, depth] = folders[i];
    std::error_code fault;
    const fs::path own = folder / "package.xml";
    if (fs::is_regular_file(own, fault)) {
      if (package_name(own.string()) == package) return folder.string();
      continue;  // packages do not lie in each other
    }
    if (depth == kFoldersDown) continue;
    fs::directory_iterator at(folder, fault);
    for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
      if (--looks < 0) return {};
      const bool is_hidden = at->path().filename().string().starts_with('.');
      if (is_hidden || at->is_symlink(fault) || !at->is_directory(fault)) {
        continue;
      }
      folders.emplace_back(folder / at->path().filename(), depth + 1);
    }
  }
  return {};
}

}  // namespace

std::string package_folder(std::string_view package, const std::string& from) {
  if (auto installed = installed_package(package); !installed.empty()) {
    return installed;
  }
  std::error_code fault;
  const fs::path here = fs::current_path(fault);
  int looks = kMostLooks;
  fs::path folder = (here / from).lexically_normal().parent_path();
  for (int up = 0; up <= kFoldersUp; ++up) {
    const fs::path found = package_below(folder, package, looks);
    if (!found.empty()) {
      return fs::path(from).is_absolute()
                 ? found.string()
                 : found.lexically_relative(here).string();
    }
    if (folder.filename() == "src" || !folder.has_relative_path()) break;
    folder = folder.parent_path();
  }
  return {};
}

}  // namespace btcheck

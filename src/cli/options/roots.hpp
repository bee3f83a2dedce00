// SPDX-License-Identifier: MIT
//
// Where inputs may lie. What the command line names is its user's choice; what
// is found from there, by a default name, by a link or because a file names it,
// may be a stranger's, and is read in the repository only.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck {

inline constexpr std::string_view kSettingsFile = "btcheck.toml";

// What lies around a folder; empty paths for what there is not.
struct Surroundings {
  // The folder of the next btcheck.toml at it or above it, up to the
  // repository.
  std::filesystem::path settings;
  std::filesystem::path repository;  // the next folder that has a `.git`
};

// `folder` is absolute; links in it are not followed.
Surroundings surroundings_of(const std::filesystem::path& folder);

// The repository that holds a folder: that of `.git`, else that of
// btcheck.toml; links are followed. "" where there is none, or where it would
// be the user's home or all of the machine.
std::string repository_of(const std::string& folder);

}  // namespace btcheck

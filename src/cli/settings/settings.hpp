// SPDX-License-Identifier: MIT
//
// `btcheck.toml`: what one does not want to type again, for all trees in its
// folder and below.
//
//   profile = "nav2-jazzy"
//   models = ["nav2_tree_nodes.xml"]
//   tick-ms = 10
//   deny = ["warnings"]
//   excludes = ["vendor", "build/*"]
//
//   [levels]
//   BT2205 = "note"
//
//   [[paths]]
//   match = "vendor/*"
//   levels = { BT2208 = "allow" }
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/findings/judgement.hpp"
#include "cli/settings/choices.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// What is left out when a folder is read.
struct Excludes {
  std::string folder;  // of the btcheck.toml, absolute
  std::vector<std::string> patterns;

  // A file or a folder, by its absolute path.
  bool has(const std::string& path) const;
};

struct Settings {
  OptionChoices choices;
  Excludes excludes;
  std::vector<LevelRule> levels;
  std::vector<std::string> denied;
};

// Reads the text of one. `name` is relative to `directory`, which is absolute.
Result<Settings> read_settings(const std::string& directory,
                               const std::string& name, std::string_view text);

// The options of a tree (its name and text) with these settings below them.
// What has no meaning for a tree of its kind is left out: a profile of the
// other kind; models, contracts of leaves and wake-ups beside a .btf tree.
Options settled(const Options& options, const Settings& settings,
                std::string_view tree, std::string_view text = {});

}  // namespace btcheck

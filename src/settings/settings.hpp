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
#include "project/reading.hpp"
#include "settings/key_reader.hpp"
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
  ReadingChoices reading;
  Excludes excludes;
  std::vector<LevelRule> levels;
  std::vector<std::string> denied;
};

// Reads the text of one. `name` is relative to `directory`, which is absolute.
Result<Settings> read_settings(const std::string& directory,
                               const std::string& name, std::string_view text);

// What they say of findings, added to what is said of them already.
void add_judgement(const Settings& settings, Judgement& to);

// True when the key is one of those that say how a tree is read, whatever its
// value: `main-tree`, and of the keys above those before `deny`. Files are
// named from `file`.
bool read_reading_choice(KeyReader in, const std::string& file,
                         ReadingChoices& to);

}  // namespace btcheck

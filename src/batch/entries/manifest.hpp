// SPDX-License-Identifier: MIT
//
// A batch that somebody has written down: docs/batch.md has the keys.
//
//   [defaults]
//   timeout = 60
//
//   [[entry]]
//   tree = "drone3.btf"
//   properties = "demo.ltl"
//   expect = { watched = "violated" }
//
//   [[entry]]
//   folder = "more"
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/entries/entries.hpp"

namespace btcheck {

// One [[entry]]; with `folder` it stands for all that is found there. Names of
// files are as written, relative to the manifest; in `choices` they are not.
struct ManifestEntry {
  std::string name;  // "" where none is given
  std::string tree;  // "" where the first property file names it
  std::vector<std::string> properties;
  std::string folder;
  std::vector<std::string> exclude;  // of what is found in the folder
  OptionChoices choices;             // the defaults come first
  std::vector<ExpectedVerdict> expected;
  // What is wrong with this entry; the others are checked all the same.
  std::vector<Diagnostic> diagnostics;
};

struct Manifest {
  std::vector<ManifestEntry> entries;
  // What is wrong with the file as a whole; with an error, `entries` is empty.
  std::vector<Diagnostic> diagnostics;
};

// Reads the text of a manifest, which is TOML 1.0.
Manifest read_manifest(const std::string& name, std::string_view text);

}  // namespace btcheck

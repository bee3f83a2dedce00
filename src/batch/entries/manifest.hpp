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

#include "batch/entries/entry.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// One [[entry]]: with `folder` it stands for all that is found there. Names of
// files are as written, relative to the manifest.
struct ManifestEntry {
  std::string name;  // "" where none is given
  std::string tree;  // "" where the first property file names it
  std::vector<std::string> properties;
  std::string folder;
  std::vector<std::string> exclude;  // of what is found in the folder
  EntryChoices choices;              // the defaults are in it
  std::vector<ExpectedVerdict> expected;
  Diagnostic place;  // of its first line, to say something of it
  // What is wrong with this one; the others are not touched by it.
  std::vector<Diagnostic> diagnostics;
};

struct Manifest {
  std::vector<ManifestEntry> entries;
  // What is wrong with the file as a whole; with an error, `entries` is empty.
  std::vector<Diagnostic> diagnostics;
};

// Reads the text of a manifest, which is TOML 1.0.
//
//   BT1502  the file is not TOML
//   BT1503  a key that is not known
//   BT1504  a value of the wrong kind, or a word that is not known
//   BT1505  an entry without a tree, or keys that do not go together
//   BT1507  no entry
Manifest read_manifest(std::string_view name, std::string_view text);

}  // namespace btcheck

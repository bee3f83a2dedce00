// SPDX-License-Identifier: MIT
//
// The entries of a batch: each is one check, of a tree against its property
// files. They come from folders and manifests.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "cli/options/interface.hpp"
#include "cli/settings/choices.hpp"
#include "project/xml_project.hpp"
#include "settings/settings.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A verdict that the manifest expects, whatever the property file says.
struct ExpectedVerdict {
  std::string property;
  Expectation expectation = Expectation::None;
  Diagnostic place;  // where it stands: shown if there is no such property
};

struct BatchEntry {
  std::string name;    // what reports call it; unique
  std::string folder;  // of its runs, below --trace-dir; unique
  std::string input;   // a tree, or a property file that names its tree
  std::vector<std::string> properties;
  OptionChoices choices;
  // The XML files of the folder that it was found in.
  std::shared_ptr<const XmlProject> project;
  std::vector<ExpectedVerdict> expected;
  std::vector<Diagnostic> diagnostics;  // with an error: it is not checked
};

// The trees and property files in a folder and all folders below it: an entry
// for each property file (.ltl, .btp), and one with the default report for each
// tree that no property file is about. A property file is about the tree that
// its `tree "…"` line names, else about the one beside it that has its name.
// Ascending by the names of the files.
//
// The XML files of the folder are one project: those of BehaviorTree.CPP know
// each other's trees and models, and a tree that another one uses is no entry.
//
// Left out are names that begin with a dot, folders that are links, what the
// settings exclude, and `exclude`: files or folders, relative to `folder`. A
// folder that cannot be read, or in which nothing is found, is an entry with an
// error. No file outside of `roots`, or of the folder where there are none, is
// opened.
std::vector<BatchEntry> entries_in(const std::string& folder,
                                   const std::vector<std::string>& exclude,
                                   const Excludes& settings = {},
                                   std::vector<std::string> roots = {});

// The files in a folder and all folders below it, ascending, with the same left
// out; beside them an error for each folder that cannot be read.
Result<std::vector<std::string>> files_in(
    const std::string& folder, const std::set<std::string>& exclude = {},
    const Excludes& settings = {});

// What folders and manifests name, one after the other; those of this shard. A
// folder with a `batch.toml` is what that says. A .btproj whose files name
// several trees is an entry for each. A source that cannot be read is an entry
// with an error, so that it is reported beside the others.
std::vector<BatchEntry> gather_batch(const Options& options);

// The file beside the first folder or manifest in which results are kept, one
// for each shard.
std::string results_file(const BatchOptions& options);

}  // namespace btcheck

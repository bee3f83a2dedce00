// SPDX-License-Identifier: MIT
//
// The files that a command line names, read; and messages about them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "cli/options/options.hpp"
#include "settings/settings.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct Inputs {
  TreeInput tree;  // with the files that it includes
  std::vector<InputFile> properties;
  Options options;  // with what the tree's btcheck.toml says
};

// Reads the tree and the properties in order; nothing when one of them cannot
// be read. `tree` may be a property file that names its tree. Errors are added
// to `found`. Of the options, those count that say how trees are read.
std::optional<Inputs> gather_inputs(const std::string& tree,
                                    const std::vector<std::string>& properties,
                                    const Options& options,
                                    std::vector<Diagnostic>& found);

// A tree whose text is at hand, without properties.
std::optional<Inputs> inputs_of(InputFile tree, const Options& options,
                                std::vector<Diagnostic>& found);

// The same for a command line; errors are also shown.
std::optional<Inputs> read_inputs(const Options& options,
                                  std::vector<Diagnostic>& found);

// Reads one tree and lowers it, or shows what is wrong with it.
struct Lowered : LoweredInput {
  Lowered(LoweredInput from, TreeInput read)
      : LoweredInput(std::move(from)), input(std::move(read)) {}

  // Missed: a warning of the reader is an error.
  ExitCode code() const { return is_denied ? ExitCode::Missed : ExitCode::Met; }

  TreeInput input;  // that it was read from
};
std::optional<Lowered> read_and_lower(const Options& options);
std::optional<Lowered> lowered_from(Inputs inputs, const Options& options);

// Absolute; "" where the system does not say.
std::string current_directory();

// The file whose settings a tree is read with: that of --config, else the
// btcheck.toml in the folder of the tree or the next above it, up to a folder
// with `.git`. "" for none.
std::string settings_file(const Options& options, const std::string& tree);

// Its text. Settings that are found above a tree are nothing that the tree asks
// for: they may lie outside of the roots, but not lead out of their own folder.
Result<InputFile> text_of_settings(const Options& options,
                                   const std::string& name);

// What the settings of a folder leave out of it; nothing where they cannot be
// read: each tree says why.
Excludes excludes_of(const Options& options, const std::string& folder);

// Says under -v which it is.
void tell_settings(const Options& options, const std::string& tree);

// Adds the findings of --baseline to the judgement; false, and shows why, where
// that file cannot be read.
bool take_baseline(Options& options);

// --- Messages ------------------------------------------------------------

// The errors, then the warnings, then the notes: the first twenty of each.
// Those that differ by their line only are shown as one.
void show(const Options& options, const std::vector<Diagnostic>& diagnostics);

// Warnings and notes that say the same become one, which names the other lines.
std::vector<Diagnostic> without_repetitions(
    const std::vector<Diagnostic>& diagnostics);

// The same as a text.
std::string shown(const std::vector<Diagnostic>& diagnostics);

// The text escaped, and in colours if they are wanted on that descriptor.
std::string painted(const Options& options, std::string_view text,
                    int descriptor);

// An error that is in no file: `error[BT0004]: …`.
void complain(std::string_view code, std::string_view message);

// The text to the file, or to standard output when its name is "".
ExitCode write_output(const std::string& file, const std::string& text);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Options as a file chooses them, under the names of the command line: an entry
// of a manifest, or btcheck.toml.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.hpp"
#include "project/reading.hpp"
#include "settings/key_reader.hpp"
#include "settings/settings.hpp"

namespace btcheck {

struct OptionChoice {
  std::string option;  // "--tick-ms"
  std::function<void(Options&)> make;
};
using OptionChoices = std::vector<OptionChoice>;

// What an entry says of itself wins over the command line.
Options applied(Options options, const OptionChoices& choices);

// What btcheck.toml says counts where neither of these says anything.
Options applied_below(Options options, const OptionChoices& choices);

OptionChoices option_choices(const ReadingChoices& reading);

// The options of a tree (its name and text) with these settings below them.
Options settled(const Options& options, const Settings& settings,
                std::string_view tree, std::string_view text = {});

// How the options say that a tree is read.
ReadingChoices reading_choices(const Options& options);

// The keys that read_choice knows.
extern const Words kChoiceKeys;

// True when the key is one of kChoiceKeys, whatever its value. Files are named
// from `file`.
bool read_choice(KeyReader in, const std::string& file, OptionChoices& to);

}  // namespace btcheck

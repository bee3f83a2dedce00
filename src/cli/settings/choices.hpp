// SPDX-License-Identifier: MIT
//
// Options as a file chooses them, under the names of the command line: an entry
// of a manifest, or btcheck.toml.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/settings/key_reader.hpp"

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

// The keys that read_choice knows.
extern const Words kChoiceKeys;

// True when the key is one of kChoiceKeys, whatever its value. Files are named
// from `file`.
bool read_choice(KeyReader in, const std::string& file, OptionChoices& to);

// What a file names, relative to where the program runs.
std::string beside(const std::string& file, const std::string& name);

}  // namespace btcheck

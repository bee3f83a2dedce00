// SPDX-License-Identifier: MIT
//
// What is made from the tables of commands and options: the texts of `--help`,
// the man page and the completions for shells.
#pragma once

#include <string>
#include <string_view>

#include "cli/options/tables.hpp"

namespace btcheck {

// A dozen lines, for a command line without any word.
std::string short_help();

// Every command and option; or those of one command.
std::string help_text();
std::string help_text(Command command);

std::string version_text();

// The man page as troff, for section 1.
std::string man_page();

// The completions for "bash", "zsh" or "fish"; "" for another word.
std::string completions_for(std::string_view shell);

// "--search ORDER", "-h, --help".
std::string shown_name(const OptionRow& option);

}  // namespace btcheck

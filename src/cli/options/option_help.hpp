// SPDX-License-Identifier: MIT
//
// What `--help` prints, made from the tables of commands and options.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cli/options/option_table.hpp"

namespace btcheck {

// Part of the interface.
struct ExitCodeRow {
  ExitCode code = ExitCode::Met;
  std::string_view meaning;
};
std::span<const ExitCodeRow> exit_code_rows();

// A dozen lines, for who has typed nothing but the program's name.
std::string short_help();

// Every command and option; or those of one command.
std::string help_text();
std::string help_text(Command command);

// "btcheck TREE.btf [OPTION]...", as it stands in a line of usage.
std::string usage_of(const CommandRow& command);

// "--search ORDER", "-h, --help".
std::string shown_name(const OptionRow& option);

// Its help with its choices and what holds without it.
std::string shown_help(const OptionRow& option);

// The commands that take it in this meaning, "check, space"; "" for all.
std::string commands_with_row(const OptionRow& option);

std::string version_text();

}  // namespace btcheck

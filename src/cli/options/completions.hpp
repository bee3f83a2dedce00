// SPDX-License-Identifier: MIT
//
// What shells and `man` are told of the commands and options, made from their
// tables; the build installs it.
#pragma once

#include <string>
#include <string_view>

namespace btcheck {

// The completions for "bash", "zsh" or "fish"; "" for another word.
std::string completions_for(std::string_view shell);

std::string bash_completions();
std::string zsh_completions();
std::string fish_completions();

// The man page as troff, for section 1.
std::string man_page();

}  // namespace btcheck

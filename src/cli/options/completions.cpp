// SPDX-License-Identifier: MIT
//
// Each script finds out which command is being typed and offers that one's
// options. Nothing is needed besides the shell.
#include "cli/options/completions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/codes/codes.hpp"
#include "cli/options/option_table.hpp"

namespace btcheck {
namespace {

// What bash and zsh match files against.
constexpr std::string_view kTreePattern = "*.@(btf|ltl|btp)";

std::vector<const CommandRow*> visible_rows() {
  std::vector<const CommandRow*> rows;
  for (const CommandRow& row : command_rows()) {
    if (!row.is_hidden) rows.push_back(&row);
  }
  return rows;
}

std::string command_words() {
  std::string words;
  for (const CommandRow* row : visible_rows()) {
    words += fmt::format("{}{}", words.empty() ? "" : " ", row->word);
  }
  return words;
}

std::string code_words() {
  std::string words;
  for (const CodeRow* row : all_codes()) {
    words += fmt::format("{}{}", words.empty() ? "" : " ", row->code);
  }
  return words;
}

std::vector<const OptionRow*> options_of(Command command) {
  std::vector<const OptionRow*> options;
  for (const OptionRow& option : option_rows()) {
    if (option.commands.contains(command)) options.push_back(&option);
  }
  return options;
}

std::string option_words(Command command) {
  std::string words;
  for (const OptionRow* option : options_of(command)) {
    words += fmt::format("{}{}", words.empty() ? "" : " ", option->name);
  }
  return words;
}

// The text with `sign` before each character of `special`.
std::string escaped(std::string_view text, std::string_view special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != special.npos) result += '\\';
    result += c;
  }
  return result;
}

// Between single quotes, as sh and zsh read them.
std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

// The words that bash offers for a value.
std::string bash_value(const OptionRow& option) {
  switch (option.kind) {
    case ValueKind::Flag:
      return {};
    case ValueKind::Free:
      return ":";
    case ValueKind::Choice:
    case ValueKind::Target:
      return fmt::format("offer '{}'", option.choices);
    case ValueKind::File:
      return "files '*'";
    case ValueKind::Directory:
      return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- "
             "\"$cur\")";
  }
  return {};
}

std::string bash_argument(const CommandRow& command) {
  switch (command.argument) {
    case ArgumentKind::None:
      return ":";
    case ArgumentKind::Tree:
    case ArgumentKind::Trees:
      return fmt::format("files '{}'", kTreePattern);
    case ArgumentKind::Batches:
      return "files '*.toml'";
    case ArgumentKind::Run:
      return "files '*'";
    case ArgumentKind::Code:
      return fmt::format("offer '{}'", code_words());
    case ArgumentKind::Shell:
      return "offer 'bash zsh fish'";
  }
  return {};
}

std::string zsh_value(const OptionRow& option) {
  switch (option.kind) {
    case ValueKind::Flag:
      return {};
    case ValueKind::Free:
      return fmt::format(":{}: ", option.value);
    case ValueKind::Choice:
    case ValueKind::Target:
      return fmt::format(":{}:({})", option.value, option.choices);
    case ValueKind::File:
      return fmt::format(":{}:_files", option.value);
    case ValueKind::Directory:
      return fmt::format(":{}:_files -/", option.value);
  }
  return {};
}

std::string zsh_argument(const CommandRow& command) {
  switch (command.argument) {
    case ArgumentKind::None:
      return {};
    case ArgumentKind::Tree:
      return "':tree:_files -g \"*.(btf|ltl|btp)\"'";
    case ArgumentKind::Trees:
      return "'*:tree:_files -g \"*.(btf|ltl|btp)\"'";
    case ArgumentKind::Batches:
      return "'*:batch:_files -g \"*.toml\"'";
    case ArgumentKind::Run:
      return "':run:_files'";
    case ArgumentKind::Code:
      return fmt::format("':code:({})'", code_words());
    case ArgumentKind::Shell:
      return "':shell:(bash zsh fish)'";
  }
  return {};
}

std::string zsh_option(const OptionRow& option) {
  const bool is_long = option.name.starts_with("--");
  const bool has_value = option.kind != ValueKind::Flag;
  return quoted(fmt::format("{}{}{}[{}]{}", option.is_repeatable ? "*" : "",
                            option.name, has_value ? (is_long ? "=" : "+") : "",
                            escaped(option.help, "[]:\\"), zsh_value(option)));
}

std::string fish_value(const OptionRow& option) {
  switch (option.kind) {
    case ValueKind::Flag:
      return {};
    case ValueKind::Free:
      return " -x";
    case ValueKind::Choice:
    case ValueKind::Target:
      return fmt::format(" -x -a '{}'", option.choices);
    case ValueKind::File:
      return " -r -F";
    case ValueKind::Directory:
      return " -x -a '(__fish_complete_directories)'";
  }
  return {};
}

std::string fish_argument(const CommandRow& command) {
  switch (command.argument) {
    case ArgumentKind::None:
      return {};
    case ArgumentKind::Tree:
    case ArgumentKind::Trees:
    case ArgumentKind::Batches:
    case ArgumentKind::Run:
      return " -F";
    case ArgumentKind::Code:
      return fmt::format(" -a '{}'", code_words());
    case ArgumentKind::Shell:
      return " -a 'bash zsh fish'";
  }
  return {};
}

// "-l tick" or "-s q".
std::string fish_name(const OptionRow& option) {
  if (option.name.starts_with("--")) {
    return fmt::format("-l {}", option.name.substr(2));
  }
  return fmt::format("-s {}", option.name.substr(1));
}

}  // namespace

std::string completions_for(std::string_view shell) {
  if (shell == "bash") return bash_completions();
  if (shell == "zsh") return zsh_completions();
  if (shell == "fish") return fish_completions();
  return {};
}

std::string bash_completions() {
  // A word with `=` in it comes in three pieces.
  std::string text = fmt::format(R"(# bash completion for btcheck; generated

_btcheck() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}}
  local command=check first=${{COMP_WORDS[1]}}
  if [[ $cur == = ]]; then
    cur=
  elif [[ $prev == = ]]; then
    prev=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  offer() {{ mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }}
  files() {{
    local extended
    extended=$(shopt -p extglob)
    shopt -s extglob
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <({{ compgen -f -X "!$1" -- "$cur"
      compgen -d -- "$cur"; }} | sort -u)
    eval "$extended"
  }}
  COMPREPLY=()
  local commands=' {} '
  if (( COMP_CWORD > 1 )) && [[ $commands == *" $first "* ]]; then
    command=$first
  fi
  case "$command $prev" in
)",
                                 command_words());
  for (const CommandRow* row : visible_rows()) {
    for (const OptionRow* option : options_of(row->command)) {
      const std::string value = bash_value(*option);
      if (value.empty()) continue;
      text += fmt::format("    '{} {}') {}; return ;;\n", row->word,
                          option->name, value);
    }
  }
  text += "  esac\n  if [[ $cur == -* ]]; then\n    case $command in\n";
  for (const CommandRow* row : visible_rows()) {
    text += fmt::format("      {}) offer '{}' ;;\n", row->word,
                        option_words(row->command));
  }
  text += "    esac\n    return\n  fi\n  case $command in\n";
  for (const CommandRow* row : visible_rows()) {
    text += fmt::format("    {}) {} ;;\n", row->word, bash_argument(*row));
  }
  return text + R"(  esac
  if (( COMP_CWORD == 1 )); then
    local found=("${COMPREPLY[@]}")
    offer "$commands"
    COMPREPLY+=("${found[@]}")
  fi
}
complete -F _btcheck btcheck
)";
}

std::string zsh_completions() {
  std::string text =
      "#compdef btcheck\n# zsh completion for btcheck; generated\n\n"
      "_btcheck() {\n  local -a commands\n  commands=(\n";
  for (const CommandRow* row : visible_rows()) {
    text += fmt::format(
        "    {}\n",
        quoted(fmt::format("{}:{}", row->word, escaped(row->summary, ":"))));
  }
  text += R"(  )
  local command=check
  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then
    _describe -t commands command commands
    _files -g '*.(btf|ltl|btp)'
    return
  fi
  if [[ -n ${commands[(r)$words[2]:*]} ]]; then
    command=$words[2]
    shift words
    (( CURRENT-- ))
  fi
  case $command in
)";
  for (const CommandRow* row : visible_rows()) {
    text += fmt::format("    {})\n      _arguments -s", row->word);
    for (const OptionRow* option : options_of(row->command)) {
      text += fmt::format(" \\\n        {}", zsh_option(*option));
    }
    const std::string argument = zsh_argument(*row);
    if (!argument.empty()) text += fmt::format(" \\\n        {}", argument);
    text += "\n      ;;\n";
  }
  return text + R"(  esac
}

if [[ $funcstack[1] == _btcheck ]]; then
  _btcheck "$@"
else
  compdef _btcheck btcheck
fi
)";
}

std::string fish_completions() {
  std::string text = fmt::format(R"(# fish completion for btcheck; generated

function __btcheck_command
    set -l words (commandline -opc)
    if set -q words[2]; and contains -- $words[2] {0}
        echo $words[2]
    else
        echo check
    end
end

function __btcheck_first
    test (count (commandline -opc)) -eq 1
end

complete -c btcheck -f
)",
                                 command_words());
  for (const CommandRow* row : visible_rows()) {
    text += fmt::format("complete -c btcheck -n __btcheck_first -a {} -d {}\n",
                        row->word, quoted(row->summary));
  }
  for (const CommandRow* row : visible_rows()) {
    const std::string when = fmt::format(
        "complete -c btcheck -n 'test (__btcheck_command) = {}'", row->word);
    const std::string argument = fish_argument(*row);
    if (!argument.empty()) text += when + argument + '\n';
    for (const OptionRow* option : options_of(row->command)) {
      text += fmt::format("{} {}{} -d {}\n", when, fish_name(*option),
                          fish_value(*option), quoted(option->help));
    }
  }
  return text;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Each script finds out which command is typed and offers that command's
// options. It needs nothing but the shell.
#include <fmt/format.h>

#include <array>
#include <functional>
#include <vector>

#include "cli/options/tables.hpp"
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

// What the shells offer at one place. {name} is the option's value in a line of
// usage, {words} are the words to choose from.
struct Offer {
  std::string_view bash, zsh, fish;
};

// For the value of an option, in the order of ValueKind.
constexpr std::array<Offer, 6> kValues = {
    {{"", "", ""},
     {":", ":{name}: ", " -x"},
     {"offer '{words}'", ":{name}:({words})", " -x -a '{words}'"},
     {"offer '{words}'", ":{name}:({words})", " -x -a '{words}'"},
     {"files '*'", ":{name}:_files", " -r -F"},
     {"compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$cur\")",
      ":{name}:_files -/", " -x -a '(__fish_complete_directories)'"}}};

// For the other words of a command, in the order of ArgumentKind.
constexpr std::array<Offer, 10> kArguments = {
    {{":", "", ""},
     {"files '*.@(btf|xml|btproj|ltl|btp)'",
      "':tree:_files -g \"*.(btf|xml|btproj|ltl|btp)\"'", " -F"},
     {"files '*.@(btf|xml|btproj|ltl|btp)'",
      "'*:tree:_files -g \"*.(btf|xml|btproj|ltl|btp)\"'", " -F"},
     {"files '*.@(btf|xml|btproj|toml)'",
      "'*:batch:_files -g \"*.(btf|xml|btproj|toml)\"'", " -F"},
     {"files '*.@(btf|xml|btproj|ltl|btp|leaves)'",
      "'*:file:_files -g \"*.(btf|xml|btproj|ltl|btp|leaves)\"'", " -F"},
     {"files '*'", "':run:_files'", " -F"},
     {"files '*'", "'*:log:_files'", " -F"},
     {":", "'*:robot: '", " -x"},
     {"files '*'; local named=(\"${{COMPREPLY[@]}}\"); offer '{words}'; "
      "COMPREPLY+=(\"${{named[@]}}\")",
      "':code or log:{{_files; compadd {words}}}'", " -F -a '{words}'"},
     {"offer '{words}'", "':shell:({words})'", " -a '{words}'"}}};

using Shell = std::string_view Offer::*;

std::string offer_for(const OptionRow& option, Shell shell) {
  if (option.may_stand_alone) {
    return shell == &Offer::zsh ? fmt::format("::{}: ", option.value) : "";
  }
  const Offer& offer = kValues[static_cast<std::size_t>(option.kind())];
  return fmt::format(fmt::runtime(offer.*shell), fmt::arg("name", option.value),
                     fmt::arg("words", option.choices));
}

// A member of each row, with blanks between.
template <class Rows, class Member>
std::string joined(const Rows& rows, Member member) {
  std::vector<std::string_view> words;
  for (const auto& row : rows) words.push_back(std::invoke(member, row));
  return fmt::format("{}", fmt::join(words, " "));
}

std::string offer_for(const CommandRow& command, Shell shell) {
  const Offer& offer = kArguments[static_cast<std::size_t>(command.argument)];
  return fmt::format(
      fmt::runtime(offer.*shell),
      fmt::arg("words", command.argument == ArgumentKind::CodeOrRun
                            ? joined(all_codes(), &CodeRow::code)
                            : "bash zsh fish"));
}

std::vector<const OptionRow*> options_of(Command command) {
  std::vector<const OptionRow*> options;
  for (const OptionRow& option : option_rows()) {
    if (option.commands.contains(command)) options.push_back(&option);
  }
  return options;
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

std::string zsh_option(const OptionRow& option) {
  const bool is_long = option.name.starts_with("--");
  const bool has_value = option.kind() != ValueKind::Flag;
  const std::string_view sign = option.may_stand_alone ? "=-"
                                : !has_value           ? ""
                                : is_long              ? "="
                                                       : "+";
  return quoted(fmt::format("{}{}{}[{}]{}", option.is_repeatable ? "*" : "",
                            option.name, sign, escaped(option.help, "[]:\\"),
                            offer_for(option, &Offer::zsh)));
}

// "-l tick" or "-s q".
std::string fish_name(const OptionRow& option) {
  if (option.name.starts_with("--")) {
    return fmt::format("-l {}", option.name.substr(2));
  }
  return fmt::format("-s {}", option.name.substr(1));
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
                                 joined(shown_commands(), &CommandRow::word));
  for (const CommandRow& row : shown_commands()) {
    for (const OptionRow* option : options_of(row.command)) {
      const std::string value = offer_for(*option, &Offer::bash);
      if (value.empty()) continue;
      text += fmt::format("    '{} {}') {}; return ;;\n", row.word,
                          option->name, value);
    }
  }
  text += "  esac\n  if [[ $cur == -* ]]; then\n    case $command in\n";
  for (const CommandRow& row : shown_commands()) {
    text += fmt::format("      {}) offer '{}' ;;\n", row.word,
                        joined(options_of(row.command), &OptionRow::name));
  }
  text += "    esac\n    return\n  fi\n  case $command in\n";
  for (const CommandRow& row : shown_commands()) {
    text +=
        fmt::format("    {}) {} ;;\n", row.word, offer_for(row, &Offer::bash));
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
  for (const CommandRow& row : shown_commands()) {
    text += fmt::format(
        "    {}\n",
        quoted(fmt::format("{}:{}", row.word, escaped(row.summary, ":"))));
  }
  text += R"(  )
  local command=check
  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then
    _describe -t commands command commands
    _files -g '*.(btf|xml|btproj|ltl|btp)'
    return
  fi
  if [[ -n ${commands[(r)$words[2]:*]} ]]; then
    command=$words[2]
    shift words
    (( CURRENT-- ))
  fi
  case $command in
)";
  for (const CommandRow& row : shown_commands()) {
    text += fmt::format("    {})\n      _arguments -s", row.word);
    for (const OptionRow* option : options_of(row.command)) {
      text += fmt::format(" \\\n        {}", zsh_option(*option));
    }
    const std::string argument = offer_for(row, &Offer::zsh);
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
                                 joined(shown_commands(), &CommandRow::word));
  for (const CommandRow& row : shown_commands()) {
    text += fmt::format("complete -c btcheck -n __btcheck_first -a {} -d {}\n",
                        row.word, quoted(row.summary));
  }
  for (const CommandRow& row : shown_commands()) {
    const std::string when = fmt::format(
        "complete -c btcheck -n 'test (__btcheck_command) = {}'", row.word);
    const std::string argument = offer_for(row, &Offer::fish);
    if (!argument.empty()) text += when + argument + '\n';
    for (const OptionRow* option : options_of(row.command)) {
      text +=
          fmt::format("{} {}{} -d {}\n", when, fish_name(*option),
                      offer_for(*option, &Offer::fish), quoted(option->help));
    }
  }
  return text;
}

}  // namespace

std::string completions_for(std::string_view shell) {
  if (shell == "bash") return bash_completions();
  if (shell == "zsh") return zsh_completions();
  if (shell == "fish") return fish_completions();
  return {};
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What shells and `man` are given. Each shell that is installed reads it as
// well.

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "cli/options/tables.hpp"
#include "report/codes/codes.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::completions_test {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is_installed(const std::string& program) {
  return run("command -v " + program + " >/dev/null").code == 0;
}

// Writes the text into a file and runs a command that begins with `program`.
Outcome read_by(const std::string& program, const std::string& text,
                const std::string& command) {
  if (!is_installed(program)) {
    MESSAGE(program << " is not installed");
    return {"", 0};
  }
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << text;
  return run_in(folder.path(), program + " " + command + " 2>&1");
}

TEST_CASE("every shell is told every command and option") {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const std::string script = completions_for(shell);
    for (const CommandRow& row : command_rows()) {
      CAPTURE(shell);
      CAPTURE(row.word);
      CHECK((row.is_hidden || has(script, std::string(row.word))));
    }
    for (const OptionRow& option : option_rows()) {
      CAPTURE(shell);
      CAPTURE(option.name);
      const std::string name(option.name);
      const std::string written = shell != "fish" ? name
                                  : name.starts_with("--")
                                      ? "-l " + name.substr(2)
                                      : "-s " + name.substr(1);
      CHECK(has(script, written));
      for (const std::string& choice : choices_of(option)) {
        CHECK(has(script, choice));
      }
    }
    for (const CodeRow* row : all_codes()) {
      CHECK(has(script, std::string(row->code)));
    }
  }
  CHECK(completions_for("tcsh").empty());
}

// The words that bash offers for the last word of a line.
std::string offered(const std::string& line) {
  const Outcome outcome =
      read_by("bash", completions_for("bash") + "COMP_WORDS=(" + line + R"()
COMP_CWORD=$(( ${#COMP_WORDS[@]} - 1 ))
compopt() { :; }
touch tree.btf run.json
mkdir runs
_btcheck
echo "${COMPREPLY[*]}"
)",
              "file");
  CHECK(outcome.code == 0);
  return outcome.text;
}

TEST_CASE("bash offers what may stand there") {
  CHECK(offered("btcheck s") == "space simulate serve\n");
  CHECK(offered("btcheck tr") == "trace tree.btf\n");
  CHECK(offered("btcheck ma") == "\n");  // hidden
  CHECK(offered("btcheck space --st") == "--store --stats\n");
  CHECK(offered("btcheck space --tick ''") == "root leaves nodes none\n");
  CHECK(offered("btcheck tree.btf --tick = ro") == "root\n");
  CHECK(offered("btcheck tree.btf --tick =") == "root leaves nodes none\n");
  CHECK(offered("btcheck export tree.btf --to s") == "svg smv\n");
  CHECK(offered("btcheck trace run.json --to s") == "svg strip substitution\n");
  CHECK(offered("btcheck explain BT900") == "BT9001 BT9002 BT9003\n");
  CHECK(offered("btcheck lint t") == "tree.btf\n");
  CHECK(offered("btcheck fmt t") == "tree.btf\n");
  CHECK(offered("btcheck fmt --st") == "--stdin-name\n");
  CHECK(offered("btcheck trace ru") == "run.json runs\n");
  CHECK(offered("btcheck tree.btf --trace-dir r") == "runs\n");
  CHECK(offered("btcheck tree.btf --threads ''") == "\n");
}

TEST_CASE("zsh and fish can read their scripts") {
  const Outcome zsh = read_by("zsh", completions_for("zsh"), "-n file");
  CHECK(zsh.code == 0);
  CHECK(zsh.text == "");
  const Outcome fish =
      read_by("fish", completions_for("fish"), "--no-execute file");
  CHECK(fish.code == 0);
  CHECK(fish.text == "");
}

TEST_CASE("fish offers what may stand there") {
  if (!is_installed("fish")) return;
  const auto words = [](const std::string& line) {
    return read_by("fish",
                   completions_for("fish") + "complete -C '" + line + "'\n",
                   "--no-config file")
        .text;
  };
  CHECK(has(words("btcheck sp"), "space"));
  CHECK(has(words("btcheck space --tick "), "leaves"));
  CHECK(has(words("btcheck space --sto"), "--store"));
  CHECK(!has(words("btcheck lint --sto"), "--store"));
  CHECK(has(words("btcheck explain BT900"), "BT9002"));
}

TEST_CASE("troff reads the man page without a warning, and nothing is lost") {
  const Outcome warnings =
      read_by("groff", man_page(), "-ww -man -Tascii -Z file >/dev/null");
  CHECK(warnings.text == "");
  if (!is_installed("groff")) return;
  const std::string page =
      read_by("groff", man_page(), "-man -Tascii -P-cbou -rLL=200n file").text;
  for (const OptionRow& option : option_rows()) {
    CAPTURE(option.name);
    CHECK(has(page, std::string(option.name)));
  }
  for (const CommandRow& row : command_rows()) {
    CHECK(has(page, "btcheck " + std::string(row.word)) != row.is_hidden);
  }
}

}  // namespace
}  // namespace btcheck::completions_test

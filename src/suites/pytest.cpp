// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "suites/formats.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// A literal of Python: what JSON has is one.
std::string python(std::string_view text) { return Json(text).text(); }

constexpr std::string_view kProgram = R"(import os
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
BTCHECK = os.environ.get("BTCHECK", "btcheck")
)";

constexpr std::string_view kTests = R"(

def ticks_of(script, count, folder):
    """What every node answers, tick by tick, where the leaves answer so."""
    file = folder / "leaves.txt"
    file.write_text(script)
    words = ["--script", file, "--ticks", str(count), "-q"]
    ran = subprocess.run([BTCHECK, *READING, *words],
                         cwd=HERE, capture_output=True, text=True, timeout=60)
    assert ran.returncode < 2, ran.stderr
    return [tick_of(line) for line in ran.stdout.splitlines()]


def tick_of(line):
    """`tick 2: root=running x=3 Navigate=running`, without 2 and x."""
    words = line.split(": ", 1)[1]
    if words.startswith("root=none"):
        return "throws"
    for variable in VARIABLES:
        begin = words.find(f" {variable}=")
        if begin >= 0:
            end = words.find(" ", begin + 1)
            words = words[:begin] + (words[end:] if end >= 0 else "")
    return words


@pytest.mark.parametrize("name", TESTS)
def test_tree(name, tmp_path):
    script, expected = TESTS[name]
    if script is None:
        pytest.skip("what a leaf writes by a port cannot be said in a script")
    assert ticks_of(script, len(expected), tmp_path) == expected
)";

}  // namespace

SuiteFile pytest_file(const DescribedSuite& described, const BehaviorTree& tree,
                      const Suite& suite,
                      const std::vector<std::string>& program) {
  std::string text = fmt::format(
      "# {} of {}: the tree {}.\n#\n"
      "# Runs the model of the tree, as it is in its file now, and asks "
      "whether "
      "it still\n# does what it did when these tests were written. The "
      "variable "
      "BTCHECK names the\n# program where it is not on the path.\n#\n",
      kSuiteMark, described.file, described.title);
  const std::string summary = suite_summary(suite, tree);
  for (std::size_t begin = 0; begin < summary.size();) {
    const std::size_t end = summary.find('\n', begin);
    text += "# " + unbroken(summary.substr(begin, end - begin)) + '\n';
    begin = end + 1;
  }
  text += kProgram;
  text += "READING = [";
  for (const std::string& word : program) {
    text += fmt::format("{}{}", &word == &program.front() ? "" : ", ",
                        python(word));
  }
  text += "]\nVARIABLES = [";
  for (const StateVariable& variable : tree.variables) {
    text +=
        fmt::format("{}{}", &variable == &tree.variables.front() ? "" : ", ",
                    python(variable.name));
  }
  text +=
      "]\n# By its name: what the leaves answer, and what follows.\n"
      "TESTS = {\n";
  for (const SuiteTest& test : suite.tests) {
    text += fmt::format("    # {}{}\n    {}: (\n", unbroken(test.about),
                        test.code.empty() ? "" : ": " + test.code,
                        python(test.name));
    if (test.has_script) {
      const std::string script = script_text(described, tree, test);
      for (std::size_t begin = 0; begin < script.size();) {
        const std::size_t end = script.find('\n', begin) + 1;
        text += "        " + python(script.substr(begin, end - begin)) + '\n';
        begin = end;
      }
      text += script.empty() ? "        \"\",\n" : "        ,\n";
    } else {
      text += "        None,\n";
    }
    text += "        [\n";
    for (const SuiteTick& tick : test.ticks) {
      text +=
          fmt::format("            {},\n", python(tick_text(described, tick)));
    }
    text += "        ]),\n";
  }
  text += "}\n";
  text += kTests;
  return {fmt::format("test_{}.py", described.name), std::move(text)};
}

}  // namespace btcheck

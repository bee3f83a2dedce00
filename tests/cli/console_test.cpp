// SPDX-License-Identifier: MIT
//
// What is left of a text that gives orders.
#include "cli/console/console.hpp"

#include <doctest/doctest.h>

#include <string>

namespace btcheck::console_test {
namespace {

TEST_CASE("a readable text stays what it is") {
  for (const std::string text :
       {"", "HOLDS  p\n  a::b\n\t- ::c\n", "## title [1]\n# [x]\n###\n##x",
        "Über → \U0001F600\n"}) {
    CHECK(readable(text) == text);
  }
}

TEST_CASE("no line of a readable text is a command of GitHub") {
  CHECK(readable("::add-mask::e") == "\\u{3a}:add-mask::e");
  CHECK(readable("a\n::x\n \t::y\n") == "a\n\\u{3a}:x\n \t\\u{3a}:y\n");
  // What .NET takes for blanks.
  CHECK(readable("\u00A0\u2003\u3000::x") == "\u00A0\u2003\u3000\\u{3a}:x");
  CHECK(readable("\r::x") == "\\u{d}::x");
}

TEST_CASE("orders that may stand anywhere in a line are written out") {
  CHECK(readable("a ##[add-mask]b") == "a \\u{23}#[add-mask]b");
  CHECK(readable("##vso[task.x]") == "\\u{23}#vso[task.x]");
  CHECK(readable("###[x]") == "#\\u{23}#[x]");
  CHECK(readable("##teamcity[x]") == "\\u{23}#teamcity[x]");
}

TEST_CASE("what is readable is so twice") {
  const std::string text = "::x\n##[y]\x1b[2J\xff";
  CHECK(readable(readable(text)) == readable(text));
}

}  // namespace
}  // namespace btcheck::console_test

// SPDX-License-Identifier: MIT
//
// Whatever the README and the pages on upgrading and faults show of `$
// build/release/btcheck …` is what the program prints, on stdout. With
// BTCHECK_UPDATE=1 in the environment it is written into them anew.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "file_text.hpp"
#include "shell.hpp"

namespace btcheck::readme_test {
namespace {

const std::string kPrompt = "\n```\n$ build/release/btcheck ";
const std::string kRoot = BTCHECK_SOURCES;

std::string printed_by(const std::string& words) {
  return run_in(kRoot,
                "timeout 60 '" BTCHECK_PROGRAM "' " + words + " 2>/dev/null")
      .text;
}

// How many outputs the page shows.
int look_at(const std::string& page) {
  std::string text = file_text(page);
  const bool updates = std::getenv("BTCHECK_UPDATE") != nullptr;
  int shown = 0;
  for (std::size_t at = text.find(kPrompt); at != std::string::npos;
       at = text.find(kPrompt, at + 1)) {
    const std::size_t words = at + kPrompt.size();
    const std::size_t begin = text.find('\n', words) + 1;
    const std::size_t end = text.find("```\n", begin);
    REQUIRE(end != std::string::npos);
    const std::string command = text.substr(words, begin - 1 - words);
    CAPTURE(command);
    const std::string output = printed_by(command);
    if (updates) {
      text.replace(begin, end - begin, output);
    } else {
      CHECK(text.substr(begin, end - begin) == output);
    }
    ++shown;
  }
  if (updates) std::ofstream(page, std::ios::binary) << text;
  return shown;
}

}  // namespace

TEST_CASE("the README shows what the program prints") {
  CHECK(look_at(kRoot + "/README.md") >= 5);
}

TEST_CASE("the page on upgrading shows what the program prints") {
  CHECK(look_at(kRoot + "/docs/upgrading.md") >= 8);
}

TEST_CASE("the page on faults shows what the program prints") {
  CHECK(look_at(kRoot + "/docs/whatif.md") >= 2);
}

TEST_CASE("the page on two trees shows what the program prints") {
  CHECK(look_at(kRoot + "/docs/diff.md") >= 2);
}

}  // namespace btcheck::readme_test

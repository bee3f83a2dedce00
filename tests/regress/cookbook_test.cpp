// SPDX-License-Identifier: MIT
//
// The rules of docs/properties.md, section 11: each holds on a tree and is
// violated on another.
#include <doctest/doctest.h>

#include <regex>
#include <set>
#include <string>

#include "file_text.hpp"
#include "shell.hpp"

namespace btcheck::cookbook_test {
namespace {

const std::string kRoot = BTCHECK_SOURCES;
const std::string kCookbook = kRoot + "/examples/cookbook";

// Each gap one blank.
std::string in_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

}  // namespace

TEST_CASE("each rule of the cookbook holds on one tree and not on the other") {
  const Outcome batch =
      run_in(kCookbook, "'" BTCHECK_PROGRAM "' batch . 2>/dev/null");
  CAPTURE(batch.text);
  CHECK(batch.code == 0);
  CHECK(batch.text.find("50 entries: 50 met") != std::string::npos);
  CHECK(batch.text.find("vacuously") == std::string::npos);
}

TEST_CASE("the table of the cookbook says what its files say") {
  const std::string table = file_text(kRoot + "/docs/properties.md");
  const std::regex row("\\| ([^|\n]+) \\| `([^`\n]+)` \\| `([a-z_]+)` \\|\n");
  std::set<std::string> told;
  for (std::sregex_iterator at(table.begin(), table.end(), row), end; at != end;
       ++at) {
    const std::string name = (*at)[3];
    CAPTURE(name);
    const std::string rules =
        in_one_line(file_text(kCookbook + "/" + name + ".ltl"));
    const std::string said = "## " + std::string((*at)[1]) + " property " +
                             name + ": " + std::string((*at)[2]) + " ";
    CHECK(rules.find(said) != std::string::npos);
    told.insert(name);
  }
  CHECK(told.size() == 25);
}

}  // namespace btcheck::cookbook_test

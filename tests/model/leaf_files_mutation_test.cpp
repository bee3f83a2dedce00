// SPDX-License-Identifier: MIT
//
// Damaged leaf contracts: a tree whose parts fit together, or an error.
#include <doctest/doctest.h>

#include <string>

#include "leaf_files_consistency.hpp"

namespace btcheck::leaf_files_mutation_test {
namespace {

void check_reading(const std::string& text) {
  const std::string flaw = flaw_of_leaves(text);
  if (flaw.empty()) return;
  CAPTURE(text);
  FAIL_CHECK(flaw);
}

TEST_CASE("there is nothing to say of the contracts themselves") {
  const auto read = tree_with_leaves(kLeaves);
  for (const Diagnostic& found : read.diagnostics) FAIL_CHECK(render(found));
  REQUIRE(read.value.has_value());
  CHECK(read.value->variables.size() == 3);
}

TEST_CASE("every beginning of the contracts is read or refused") {
  for (std::size_t end = 0; end <= kLeaves.size(); ++end) {
    check_reading(std::string(kLeaves.substr(0, end)));
  }
}

TEST_CASE("contracts with a byte too few or a sign too many do no harm") {
  for (std::size_t at = 0; at < kLeaves.size(); ++at) {
    check_reading(std::string(kLeaves).erase(at, 1));
    for (const char sign : {'(', ')', ':', '"', '\'', '*', '@', '-', '9'}) {
      check_reading(std::string(kLeaves).insert(at, 1, sign));
    }
  }
}

TEST_CASE("contracts without any one word, or with it twice, do no harm") {
  for (std::size_t at = 0; at < kLeaves.size();) {
    const std::size_t end =
        std::min(kLeaves.find_first_of(" \n()", at + 1), kLeaves.size());
    const std::string word(kLeaves.substr(at, end - at));
    check_reading(std::string(kLeaves).erase(at, word.size()));
    check_reading(std::string(kLeaves).insert(at, " " + word));
    at = end;
  }
}

}  // namespace
}  // namespace btcheck::leaf_files_mutation_test

// SPDX-License-Identifier: MIT
//
// Damaged trees: whatever is cut from a file or put into it, reading gives a
// consistent tree or an error, and never both.
#include <doctest/doctest.h>

#include <array>
#include <string>
#include <string_view>

#include "btf_consistency.hpp"
#include "btf_text.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf_mutation_test {
namespace {

void check_reading(const std::string& text) {
  const std::string flaw = flaw_of(read_btf("t.btf", text));
  if (flaw.empty()) return;
  CAPTURE(text);
  FAIL_CHECK(flaw);
}

TEST_CASE("every prefix of every example gives a tree or an error") {
  for (const std::string_view name : kExamples) {
    const std::string text = example(name);
    for (std::size_t end = 0; end <= text.size(); ++end) {
      check_reading(text.substr(0, end));
    }
  }
}

TEST_CASE("every example without any one byte gives a tree or an error") {
  for (const std::string_view name :
       {"recovery.btf", "roundrobin.btf", "mars_rover.btf", "train.btf"}) {
    const std::string text = example(name);
    for (std::size_t at = 0; at < text.size(); ++at) {
      check_reading(std::string(text).erase(at, 1));
    }
  }
}

TEST_CASE("every example with any one sign put in gives a tree or an error") {
  for (const std::string_view name : {"recovery.btf", "roundrobin.btf"}) {
    const std::string text = example(name);
    for (std::size_t at = 0; at < text.size(); ++at) {
      for (const char sign : {'(', ')', ':', ';', '"', '[', '$', '\0'}) {
        check_reading(std::string(text).insert(at, 1, sign));
      }
    }
  }
}

TEST_CASE("every example without any one word gives a tree or an error") {
  for (const std::string_view name : {"drone3.btf", "nav2.btf"}) {
    const std::string text = example(name);
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find_first_of(" \n()", at + 1);
      check_reading(std::string(text).erase(at, end - at));
      at = std::min(end, text.size());
    }
  }
}

}  // namespace
}  // namespace btcheck::btf_mutation_test

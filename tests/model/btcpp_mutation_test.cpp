// SPDX-License-Identifier: MIT
//
// Damaged XML: whatever is left of a text, the reader returns a tree whose
// parts fit together, or an error.
#include <doctest/doctest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <string_view>

#include "btcpp_consistency.hpp"

namespace btcheck::btcpp_mutation_test {
namespace {

constexpr std::string_view kText = R"(<?xml version="1.0"?>
<!-- a comment <A/> -->
<root BTCPP_format="4" main_tree_to_execute="Main">
  <include path="a.xml"/>
  <BehaviorTree ID="Main">
    <ReactiveSequence name="top">
      <Script code="n := 1; m := n + 2"/>
      <SubTree ID="Part" a="{n}" b="3" _autoremap="true"/>
      <Repeat num_cycles="{n}"><Action ID="Go" to="{goal}" _while="n &lt; 3"/>
      </Repeat>
      <Parallel success_count="1"><A/><SubTree ID="Included"/></Parallel>
    </ReactiveSequence>
  </BehaviorTree>
  <BehaviorTree ID="Part"><Fallback><A p="{a}"/><![CDATA[ ]]><B/></Fallback>
  </BehaviorTree>
  <TreeNodesModel>
    <Action ID="Go"><input_port name="to" default="">where</input_port></Action>
    <SubTree ID="Part"><input_port name="a"/></SubTree>
  </TreeNodesModel>
</root>
)";

TEST_CASE("the text itself is read") {
  int expanded = 0;
  CHECK(flaw_of_reading(kText, expanded) == "");
  CHECK(expanded == 1);
}

TEST_CASE("every beginning of the text is read or refused") {
  int expanded = 0;
  for (std::size_t length = 0; length < kText.size(); ++length) {
    CAPTURE(length);
    CHECK(flaw_of_reading(kText.substr(0, length), expanded) == "");
  }
}

TEST_CASE("pieces that are cut, doubled or exchanged do no harm") {
  constexpr std::string_view kOdd = "<>/\"'= {}!-[]&;A\n\t\xC3";
  int expanded = 0;
  std::mt19937 random(7);
  const auto below = [&](std::size_t end) { return random() % end; };
  for (int round = 0; round < 3000; ++round) {
    std::string text(kText);
    for (std::size_t i = 0; i <= below(3); ++i) {
      const std::size_t at = below(text.size());
      const std::size_t length = below(12);
      const std::string piece = text.substr(at, length);
      switch (below(4)) {
        case 0:
          text.erase(at, length);
          break;
        case 1:
          text.insert(below(text.size()), piece);
          break;
        case 2:
          text[at] = kOdd[below(kOdd.size())];
          break;
        default:
          text.replace(below(text.size()), length, piece);
      }
    }
    CAPTURE(text);
    REQUIRE(flaw_of_reading(text, expanded) == "");
  }
  CHECK(expanded > 300);
}

}  // namespace
}  // namespace btcheck::btcpp_mutation_test

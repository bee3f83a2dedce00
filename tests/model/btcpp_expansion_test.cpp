// SPDX-License-Identifier: MIT
//
// Subtrees in their places: numbers, paths, and which entry a name means.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "btcpp_text.hpp"
#include "model/btcpp/expand/expansion.hpp"

namespace btcheck::btcpp_expansion_test {
namespace {

using Paths = std::vector<std::string>;
using btcpp::entry_of;
using btcpp::EntryName;

// M with this inside, and S with a leaf of two ports.
std::string with_subtree(std::string_view inside) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
         "<BehaviorTree ID=\"M\"><Sequence>" +
         std::string(inside) +
         "</Sequence></BehaviorTree><BehaviorTree ID=\"S\">"
         "<A name=\"leaf\"/></BehaviorTree></root>";
}

TEST_CASE("nodes are numbered in pre-order, the SubTree before its root") {
  const ReadTree tree = good_tree(
      with_subtree("<SubTree ID=\"S\"/><A/><SubTree ID=\"S\" name=\"s\"/>"
                   "<Sequence name=\"Sequence\"><A name=\"a\"/></Sequence>"));
  CHECK(paths_of(tree) == Paths{"Sequence::1", "S::2", "S::2/leaf", "A::4", "s",
                                "s/leaf", "Sequence::7", "a"});
  CHECK(tree.expansion.subtrees.size() == 3);
  CHECK(tree.expansion.subtrees[2].path == "s");
  CHECK(tree.expansion.subtrees[2].first_node == 5);
  CHECK(tree.expansion.nodes[0].children ==
        std::vector<std::uint32_t>{1, 3, 4, 6});
  CHECK(tree.expansion.nodes[1].children == std::vector<std::uint32_t>{2});
}

TEST_CASE("names in a subtree are its own, remapped, or the parent's") {
  const ReadTree tree = good_tree(with_subtree(
      "<SubTree ID=\"S\" a=\"{b}\" c=\"{=}\" lit=\"4\" g=\"{@top}\"/>"
      "<SubTree ID=\"S\" _autoremap=\"true\" a=\"{b}\" lit=\"4\"/>"));
  const BtcppExpansion& all = tree.expansion;
  CHECK(entry_of(all, 1, "a") == EntryName{0, "b"});
  CHECK(entry_of(all, 1, "c") == EntryName{0, "c"});
  CHECK(entry_of(all, 1, "lit") == EntryName{1, "lit"});
  CHECK(entry_of(all, 1, "g") == EntryName{0, "top"});
  CHECK(entry_of(all, 1, "other") == EntryName{1, "other"});
  CHECK(entry_of(all, 1, "@other") == EntryName{0, "other"});
  CHECK(entry_of(all, 2, "other") == EntryName{0, "other"});
  CHECK(entry_of(all, 2, "lit") == EntryName{2, "lit"});
  CHECK(entry_of(all, 2, "_private") == EntryName{2, "_private"});
}

TEST_CASE("version 3 remaps without braces, shares, or is a SubTreePlus") {
  const ReadTree tree = read_tree(
      "<root main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Sequence>"
      "<SubTree ID=\"S\" a=\"b\"/>"
      "<SubTree ID=\"S\" __shared_blackboard=\"true\"/>"
      "<SubTreePlus ID=\"S\" __autoremap=\"1\" a=\"${b}\" c=\"d\"/><SubTree "
      "ID=\"S\"/>"
      "</Sequence></BehaviorTree>"
      "<BehaviorTree ID=\"S\"><A/></BehaviorTree></root>",
      {}, {.release = BtcppRelease::V3, .models = {}});
  REQUIRE(tree.is_read);
  const BtcppExpansion& all = tree.expansion;
  REQUIRE(all.subtrees.size() == 5);
  CHECK(entry_of(all, 1, "a") == EntryName{0, "b"});
  CHECK(entry_of(all, 1, "z") == EntryName{1, "z"});
  CHECK(entry_of(all, 2, "z") == EntryName{0, "z"});
  CHECK(entry_of(all, 3, "a") == EntryName{0, "b"});
  CHECK(entry_of(all, 3, "c") == EntryName{3, "c"});
  CHECK(entry_of(all, 3, "z") == EntryName{0, "z"});
  CHECK(entry_of(all, 4, "z") == EntryName{4, "z"});
}

TEST_CASE("the model of a subtree gives defaults, and says what is missing") {
  const std::string model =
      "<TreeNodesModel><SubTree ID=\"S\"><input_port name=\"p\"/>"
      "<input_port name=\"q\" default=\"{Q}\"/></SubTree></TreeNodesModel>"
      "</root>";
  const auto with_model = [&](std::string_view inside) {
    std::string text = with_subtree(inside);
    return text.substr(0, text.size() - 7) + model;
  };
  CHECK(codes_in(with_model("<SubTree ID=\"S\"/>")) == "BT1614");
  CHECK(codes_in(with_model("<SubTree ID=\"S\" _autoremap=\"1\"/>")) == "");
  const ReadTree tree = good_tree(with_model("<SubTree ID=\"S\" p=\"1\"/>"));
  CHECK(entry_of(tree.expansion, 1, "q") == EntryName{0, "Q"});
}

TEST_CASE("another tree than the document's own can be expanded") {
  const ReadTree tree = good_tree(with_subtree("<SubTree ID=\"S\"/>"));
  const auto other = expand_btcpp(*tree.document, "S");
  REQUIRE(other.value);
  CHECK(other.value->nodes.size() == 1);
  const auto none = expand_btcpp(*tree.document, "T");
  CHECK(!none.value);
  CHECK(codes_of(none.diagnostics) == "BT1611 0:0");
}

}  // namespace
}  // namespace btcheck::btcpp_expansion_test

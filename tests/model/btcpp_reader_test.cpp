// SPDX-License-Identifier: MIT
//
// What the reader of BehaviorTree.CPP's XML keeps of a file, and where from.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "btcpp_text.hpp"

namespace btcheck::btcpp_reader_test {
namespace {

using Paths = std::vector<std::string>;

TEST_CASE("the compact and the explicit form are the same node") {
  const ReadTree tree = good_tree(
      tree4("<Control ID=\"Sequence\"><A x=\"1\"/><Condition ID=\"B\"/>"
            "</Control>"));
  const auto& nodes = tree.document->trees[0].nodes;
  REQUIRE(nodes.size() == 3);
  CHECK(nodes[0].id == "Sequence");
  CHECK(nodes[0].kind == BtcppKind::Control);
  CHECK(nodes[0].is_explicit);
  CHECK(nodes[0].children == std::vector<std::uint32_t>{1, 2});
  CHECK(nodes[1].kind == BtcppKind::Action);
  CHECK(!nodes[1].is_known);
  CHECK(nodes[2].kind == BtcppKind::Condition);
}

TEST_CASE("attributes are ports, conditions, or neither") {
  const ReadTree tree =
      good_tree(tree4("<A name=\"n\" p=\"{k}\" _skipIf=\"true\" _uid=\"3\"/>"));
  const BtcppNode& node = tree.document->trees[0].nodes[0];
  CHECK(node.name == "n");
  REQUIRE(node.ports.size() == 1);
  CHECK(node.ports[0].value == "{k}");
  REQUIRE(node.conditions.size() == 1);
  CHECK(node.conditions[0].name == "_skipIf");
  REQUIRE(node.others.size() == 1);
  CHECK(node.others[0].name == "_uid");
}

TEST_CASE("everything has its line and column") {
  const ReadTree tree = good_tree(
      "<?xml version=\"1.0\"?>\n"
      "<!-- <A p='1'/> > -->\n"
      "<root BTCPP_format=\"4\"><BehaviorTree\n"
      "  ID=\"M\"> <Sequence>\n"
      "  <![CDATA[<A/><A/>]]><A p = '>' q=\"\n{k}\"/><B "
      "name=\"\xC3\xA4\"/><B/>\n"
      "</Sequence></BehaviorTree></root>\n<root/>");
  const auto& nodes = tree.document->trees[0].nodes;
  REQUIRE(nodes.size() == 4);
  CHECK(nodes[0].place.span.line == 4);
  CHECK(nodes[0].place.span.column == 12);
  CHECK(nodes[0].place.span.length == 8);
  CHECK(nodes[1].place.span.line == 5);
  CHECK(nodes[1].place.span.column == 24);
  REQUIRE(nodes[1].ports.size() == 2);
  CHECK(nodes[1].ports[0].value == ">");
  CHECK(nodes[1].ports[0].name_place.span.column == 26);
  CHECK(nodes[1].ports[0].place.span.column == 31);
  CHECK(nodes[2].place.span.line == 6);
  CHECK(nodes[2].place.span.column == 8);
  CHECK(nodes[3].place.span.column == 21);
}

TEST_CASE("what tinyxml2 lets pass is read") {
  for (const char* leaf :
       {"<A x='x && y'/>", "<A x=\"x < y\"/>", "<A x=\"&nothing;\"/>",
        "<A b=\"1\"a=\"2\"/>", "<!-- -- --><A/>"}) {
    CAPTURE(leaf);
    CHECK(good_tree(tree4(leaf)).expansion.nodes.size() == 1);
  }
  for (const char* leaf :
       {"<A x=\"1\" x=\"2\"/>", "<A x=1/>", "<A x/>", "<A>", "<A></B>"}) {
    CAPTURE(leaf);
    CHECK(codes_in(tree4(leaf)) == "BT1600");
  }
}

TEST_CASE("a model says kind, ports and defaults") {
  const ReadTree tree = good_tree(version4(
      "<BehaviorTree ID=\"M\"><IsUp where=\"{w}\"/></BehaviorTree>"
      "<TreeNodesModel><Condition ID=\"IsUp\">"
      "<input_port name=\"where\" type=\"int\" default=\"1\">which</input_port>"
      "<bidirectional_port name=\"both\"/>"
      "<MetadataFields><Metadata by=\"us\"/></MetadataFields>"
      "</Condition></TreeNodesModel>"));
  CHECK(codes_of(tree.diagnostics) == "");
  const BtcppModel* model = tree.document->model("IsUp");
  REQUIRE(model != nullptr);
  REQUIRE(model->ports.size() == 2);
  CHECK(model->ports[0].description == "which");
  CHECK(model->ports[0].default_value == "1");
  CHECK(model->ports[1].direction == BtcppDirection::InOut);
  CHECK(model->metadata[0].second == "us");
  CHECK(tree.document->trees[0].nodes[0].kind == BtcppKind::Condition);
}

TEST_CASE("models may come from another file") {
  BtcppOptions options;
  options.models = {{"m.xml",
                     "<root><TreeNodesModel><Condition ID=\"C\"/>"
                     "</TreeNodesModel><BehaviorTree ID=\"X\"><A/>"
                     "</BehaviorTree></root>"}};
  const ReadTree tree = read_tree(tree4("<C/>"), {}, options);
  REQUIRE(tree.is_read);
  CHECK(tree.document->trees.size() == 1);
  CHECK(tree.document->trees[0].nodes[0].kind == BtcppKind::Condition);
  CHECK(codes_of(tree.diagnostics) == "");
}

TEST_CASE("includes are followed, each file once") {
  const NamedTexts others = {
      {"a.xml", version4("<include path=\"b.xml\"/>"
                         "<BehaviorTree ID=\"A\"><SubTree ID=\"B\"/>"
                         "</BehaviorTree>")},
      {"b.xml", version4("<BehaviorTree ID=\"B\"><X/></BehaviorTree>")}};
  const ReadTree tree = good_tree(
      version4("<include path=\"a.xml\"/><include path=\"b.xml\"/>"
               "<BehaviorTree ID=\"M\"><SubTree ID=\"A\"/></BehaviorTree>"),
      others);
  CHECK(tree.document->files.size() == 3);
  CHECK(tree.document->files[0].name == "t.xml");
  CHECK(tree.document->main_tree == "M");
  CHECK(paths_of(tree) == Paths{"A::1", "A::1/B::2", "A::1/B::2/X::3"});
}

TEST_CASE("a project file names its trees") {
  const ReadTree tree = read_tree(
      "<root BTCPP_format=\"4\" project_name=\"P\"><include path=\"a.xml\"/>"
      "<TreeNodesModel><Action ID=\"X\"/></TreeNodesModel></root>",
      {{"a.xml", version4("<BehaviorTree ID=\"A\"><X/></BehaviorTree>")}});
  REQUIRE(tree.is_read);
  CHECK(tree.document->project_name == "P");
  CHECK(tree.document->main_tree == "A");
  CHECK(codes_of(tree.diagnostics) == "");
}

TEST_CASE("the tree that runs is named, alone in its file, or alone") {
  const std::string two =
      "<BehaviorTree ID=\"M\"><A/></BehaviorTree>"
      "<BehaviorTree ID=\"N\"><A/></BehaviorTree>";
  CHECK(codes_in(version4(two)) == "BT1611");
  const ReadTree named = good_tree(
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"N\">" + two + "</root>");
  CHECK(named.expansion.subtrees[0].tree->id == "N");
  CHECK(codes_in("<root BTCPP_format=\"4\" main_tree_to_execute=\"n\">" + two +
                 "</root>") == "BT1611");
  const ReadTree unnamed =
      good_tree(version4("<BehaviorTree><A/></BehaviorTree>"));
  CHECK(unnamed.document->trees[0].id == "BehaviorTree_0");
}

TEST_CASE("a file without its version is of version 3") {
  const std::string text =
      "<root><BehaviorTree ID=\"M\"><SequenceStar>"
      "<Parallel success_threshold=\"1\"><A/></Parallel>"
      "</SequenceStar></BehaviorTree></root>";
  const ReadTree tree = read_tree(text);
  CHECK(tree.is_read);
  CHECK(tree.document->release == BtcppRelease::V3);
  CHECK(codes_of(tree.diagnostics) == "BT1622 1:2 BT1620 1:75");
  BtcppOptions options;
  options.release = BtcppRelease::V4;
  CHECK(codes_of(read_tree(text, {}, options).diagnostics) ==
        "BT1621 1:29 BT1620 1:75 BT1609 1:52");
}

}  // namespace
}  // namespace btcheck::btcpp_reader_test

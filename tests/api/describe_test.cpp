// SPDX-License-Identifier: MIT
//
// What an editor shows of a node: from the files alone, and from a model, the
// engine or nobody.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "btcheck/check.hpp"
#include "file_text.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::describe_test {
namespace {

namespace v1 = btcheck::v1;

v1::Description described(const std::string& name, v1::Files& files) {
  v1::Request request;
  request.tree = name;
  return v1::describe(request, files);
}

v1::Description described(const std::string& text) {
  v1::Files files;
  files.add("t.xml", text);
  return described("t.xml", files);
}

const v1::DescribedNode& node(const v1::Description& all,
                              const std::string& type) {
  const auto found =
      std::ranges::find(all.nodes, type, &v1::DescribedNode::type);
  REQUIRE(found != all.nodes.end());
  return *found;
}

const v1::Port& port(const v1::DescribedNode& node, const std::string& name) {
  const auto found = std::ranges::find(node.ports, name, &v1::Port::name);
  REQUIRE(found != node.ports.end());
  return *found;
}

std::vector<std::string> types_of(const v1::Description& all,
                                  const std::vector<std::size_t>& numbers) {
  std::vector<std::string> types;
  for (const std::size_t each : numbers) types.push_back(all.nodes[each].type);
  return types;
}

using Words = std::vector<std::string>;

constexpr const char* kTree =
    "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n"
    "<BehaviorTree ID=\"M\"><Sequence>\n"
    "  <RetryUntilSuccessful num_attempts=\"3\"><Look far=\"{place}\"\n"
    "    near=\"7\"/></RetryUntilSuccessful>\n"
    "  <Script code=\"speed := 2\"/>\n"
    "  <Own goal=\"{place}\"/>\n"
    "  <SubTree ID=\"Inner\" there=\"{place}\"/>\n"
    "</Sequence></BehaviorTree>\n"
    "<BehaviorTree ID=\"Inner\"><Go to=\"{there}\"/></BehaviorTree>\n"
    "<TreeNodesModel><Action ID=\"Look\">\n"
    "  <output_port name=\"far\" type=\"Pose\">what it has seen</output_port>\n"
    "  <input_port name=\"near\" type=\"int\" default=\"5\"/>\n"
    "  <input_port name=\"lamp\" type=\"bool\"/>\n"
    "  <MetadataFields><Metadata description=\"Looks around.\"/>"
    "</MetadataFields></Action>\n"
    "<Action ID=\"Go\"><input_port name=\"to\" type=\"Pose\"/></Action>\n"
    "</TreeNodesModel></root>\n";

TEST_CASE("a node has its ports with what a model says and what is written") {
  const v1::Description all = described(kTree);
  CHECK(all.outcome == v1::Outcome::Met);
  CHECK(all.profile == "btcpp-4");
  const v1::DescribedNode& look = node(all, "Look");
  CHECK(look.kind == "Action");
  CHECK(look.about == "Looks around.");
  CHECK(look.where.line == 3);
  REQUIRE(look.ports.size() == 3);
  const v1::Port& far = port(look, "far");
  CHECK(far.direction == v1::Direction::Output);
  CHECK(far.type == "Pose");
  CHECK(far.value == "{place}");
  CHECK(far.entry == "place");
  CHECK(far.about == "what it has seen");
  CHECK(far.where.line == 3);
  CHECK(far.where.length == 7);
  const v1::Port& near = port(look, "near");
  CHECK(near.preset == "5");
  CHECK(near.value == "7");
  CHECK(near.where.line == 4);
  CHECK(near.entry.empty());
  CHECK_FALSE(port(look, "lamp").value);
  CHECK(port(look, "lamp").where.line == 0);
}

TEST_CASE("the engine's types, the program's, and those that nobody tells of") {
  const v1::Description all = described(kTree);
  const v1::DescribedNode& retry = node(all, "RetryUntilSuccessful");
  CHECK(retry.kind == "Decorator");
  CHECK(retry.about.find("after each failure") != std::string::npos);
  CHECK(port(retry, "num_attempts").type == "int");
  CHECK(port(retry, "num_attempts").value == "3");
  const v1::DescribedNode& own = node(all, "Own");
  CHECK(own.about ==
        "An action of the program; it may answer success, failure or running.");
  CHECK(port(own, "goal").direction == v1::Direction::Unknown);
  CHECK(port(own, "goal").entry == "place");
  CHECK(node(all, "Inner").kind == "SubTree");
  CHECK(port(node(all, "Inner"), "there").value == "{place}");
  CHECK(all.nodes[0].kind == "Tree");
  CHECK(all.nodes[0].parent == 0);
  CHECK(all.nodes[1].type == "Sequence");
  CHECK(node(all, "Go").parent > node(all, "Look").parent);
}

TEST_CASE("leaves of Nav2 are Nav2's, and those of py_trees its own") {
  const v1::Description nav2 = described(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence>"
      "<GoalReached/><Own/></Sequence></BehaviorTree></root>");
  CHECK(node(nav2, "GoalReached").about ==
        "A condition of Nav2; it may answer success or failure.");
  CHECK(node(nav2, "Own").about.starts_with("An action of the program"));
  const v1::Description py = described(
      "<root py_trees=\"2\"><BehaviorTree ID=\"M\"><Sequence memory=\"true\">"
      "<Dummy/></Sequence></BehaviorTree></root>");
  CHECK(node(py, "Dummy").about ==
        "An action of py_trees; it may answer running.");
}

TEST_CASE("entries have their writers and readers, through subtrees") {
  const v1::Description all = described(kTree);
  const auto place = std::ranges::find(all.entries, "place", &v1::Entry::name);
  REQUIRE(place != all.entries.end());
  // Nobody tells of `Own` whether it writes.
  CHECK(types_of(all, place->writers) == Words{"Look", "Own"});
  CHECK(types_of(all, place->readers) == Words{"Own", "Go"});
  const auto speed = std::ranges::find(all.entries, "speed", &v1::Entry::name);
  REQUIRE(speed != all.entries.end());
  CHECK(types_of(all, speed->writers) == Words{"Script"});
  const v1::DescribedNode& look = node(all, "Look");
  CHECK(look.writes == std::vector<std::size_t>{static_cast<std::size_t>(
                           place - all.entries.begin())});
  CHECK(look.reads.empty());
}

TEST_CASE("nodes are called as a report calls them") {
  v1::Files files;
  files.add("t.xml", kTree);
  v1::Request request;
  request.tree = "t.xml";
  const v1::Description all = v1::describe(request, files);
  const v1::Report report = v1::check(request, files);
  CHECK(all.nodes.size() == report.node_count);
  REQUIRE_FALSE(report.nodes.empty());
  for (const v1::Node& proven : report.nodes) {
    const auto found =
        std::ranges::find(all.nodes, proven.name, &v1::DescribedNode::name);
    REQUIRE(found != all.nodes.end());
    CHECK(found->where.line == proven.where.line);
  }
}

TEST_CASE("a .btf tree has state variables for entries") {
  v1::Files files;
  files.add("drone3.btf",
            file_text(std::string(BTCHECK_EXAMPLES) + "/drone3.btf"));
  const v1::Description all = described("drone3.btf", files);
  CHECK(all.profile == "paper");
  CHECK(all.outcome == v1::Outcome::Met);
  REQUIRE_FALSE(all.entries.empty());
  for (const v1::Entry& entry : all.entries) {
    CHECK_FALSE(entry.writers.size() + entry.readers.size() == 0);
  }
  for (const v1::DescribedNode& each : all.nodes) {
    CAPTURE(each.label);
    CHECK_FALSE(each.about.empty());
    CHECK(each.where.line > 0);
  }
}

TEST_CASE("what cannot be read is not described, and it is said why") {
  const v1::Description torn = described("<root BTCPP_format=\"4\"><A>");
  CHECK(torn.outcome == v1::Outcome::BadInput);
  CHECK(torn.nodes.empty());
  REQUIRE_FALSE(torn.findings.empty());
  CHECK(torn.findings[0].level == v1::Level::Error);
  v1::Files files;
  CHECK(described("gone.xml", files).findings[0].code == "BT0002");
}

TEST_CASE("every type that is not the program's own has a sentence") {
  for (const NodeTypeInfo& info : kNodeTypes) {
    CAPTURE(info.name);
    const bool is_own =
        info.type == NodeType::Action || info.type == NodeType::Condition;
    CHECK(info.about.empty() == is_own);
    const std::string_view text = info.about;
    CHECK((is_own || text.ends_with('.')));
  }
}

}  // namespace
}  // namespace btcheck::describe_test

// SPDX-License-Identifier: MIT
//
// The types of other libraries, and attributes that are not read.
#include <doctest/doctest.h>

#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "btcpp_text.hpp"
#include "model/btcpp/attributes.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/tree_file.hpp"

namespace btcheck::btcpp_libraries_test {
namespace {

using namespace btcpp;

std::vector<LibraryType> all_types() {
  std::vector<LibraryType> all;
  for (const auto rows :
       {behaviortree_ros2_types(), moveit_pro_data(), moveit_pro_motion()}) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

const BtcppNode& root_of(const ReadTree& read) {
  return read.document->trees.at(0).nodes.at(0);
}

// Whether something is known of the only node of a tree.
bool is_known(const std::string& node) {
  const auto read =
      read_tree(version4("<BehaviorTree ID=\"M\">" + node + "</BehaviorTree>"));
  REQUIRE(read.document != nullptr);
  return root_of(read).is_known;
}

}  // namespace

TEST_CASE("no type of a library is there twice, or another's") {
  std::set<std::string_view> ids;
  std::size_t ports = 0;
  for (const LibraryType& row : all_types()) {
    CAPTURE(row.id);
    CHECK(ids.insert(row.id).second);
    CHECK(kind_named(row.kind).has_value());
    CHECK(known_type(BtcppRelease::V4, row.id) == nullptr);
    std::set<std::string> names;
    for (const auto column : {row.inputs, row.outputs, row.both}) {
      std::istringstream words{std::string(column)};
      for (std::string port; words >> port; ++ports) {
        CAPTURE(port);
        CHECK(is_port_name(port));
        CHECK(names.insert(port).second);
      }
    }
  }
  CHECK(ids.size() == 178);
  CHECK(ports > 500);
}

TEST_CASE("a type of MoveIt Pro is known as its editor writes it") {
  CHECK(is_known("<Action ID=\"GetImage\" message_out=\"{i}\"/>"));
  CHECK(is_known("<Decorator ID=\"ForEach\"><A/></Decorator>"));
  CHECK(!is_known("<GetImage message_out=\"{i}\"/>"));
  CHECK(!is_known("<Condition ID=\"GetImage\"/>"));
  CHECK(!is_known("<ForEach><A/><A/></ForEach>"));
  CHECK(!is_known("<Action ID=\"GetImages\"/>"));
  CHECK(is_known("<SleepAction msec=\"5\"/>"));
  CHECK(is_known("<Action ID=\"SleepAction\" msec=\"5\"/>"));
  CHECK(!is_known("<Condition ID=\"SleepAction\"/>"));
}

TEST_CASE("the ports of a library have its directions, unless a model has") {
  const std::string tree =
      "<BehaviorTree ID=\"M\"><Action ID=\"PlanMTCTask\" task=\"{t}\" "
      "solution=\"{s}\" other=\"{o}\"/></BehaviorTree>";
  const auto read = read_tree(version4(tree));
  const BtcppNode& node = root_of(read);
  const BtcppDocument& document = *read.document;
  CHECK(facts_of(document, node, "task")->direction == BtcppDirection::Input);
  CHECK(facts_of(document, node, "solution")->direction ==
        BtcppDirection::Output);
  CHECK(!facts_of(document, node, "other"));
  const auto modelled = read_tree(version4(
      tree +
      "<TreeNodesModel><Action ID=\"PlanMTCTask\"><inout_port name=\"task\"/>"
      "<input_port name=\"solution\"/><input_port name=\"other\"/></Action>"
      "</TreeNodesModel>"));
  const BtcppNode& own = root_of(modelled);
  CHECK(facts_of(*modelled.document, own, "task")->direction ==
        BtcppDirection::InOut);
  CHECK(facts_of(*modelled.document, own, "solution")->direction ==
        BtcppDirection::Input);
}

TEST_CASE("the ports of Nav2's docking are known") {
  const auto read = read_tree(version4(
      "<BehaviorTree ID=\"M\"><DockRobot dock_id=\"{d}\" success=\"{s}\" "
      "num_retries=\"{n}\"/></BehaviorTree>"));
  const BtcppNode& node = root_of(read);
  CHECK(facts_of(*read.document, node, "dock_id")->direction ==
        BtcppDirection::Input);
  CHECK(facts_of(*read.document, node, "num_retries")->direction ==
        BtcppDirection::Output);
}

TEST_CASE("no type of a library names a profile") {
  const std::string text = version4(
      "<BehaviorTree ID=\"M\"><Sequence><Action ID=\"ClearSnapshot\"/>"
      "<SleepAction msec=\"5\"/></Sequence></BehaviorTree>");
  const auto tree = btcheck::read_tree("t.xml", text, TreeReading());
  REQUIRE(tree.value);
  CHECK(tree.value->profile == Profile::Btcpp4);
  CHECK(tree.diagnostics.empty());
}

TEST_CASE("attributes that are not read are told in one note for each file") {
  const auto told = [](const std::string& text, BtcppOptions options = {}) {
    std::string notes;
    for (const Diagnostic& found : read_tree(text, {}, options).diagnostics) {
      if (found.code == "BT1653") notes += found.message + '\n';
    }
    return notes;
  };
  const auto tree = [](const std::string& inside) {
    return version4("<BehaviorTree ID=\"M\">" + inside + "</BehaviorTree>");
  };
  CHECK(told(tree("<A running_guard=\"x==1\"/>")) ==
        "`running_guard` is not read\n");
  CHECK(
      told(tree("<Sequence><Condition ID=\"C\" success_guard=\"x\" "
                "failure_guard=\"y\"/><A success_guard=\"z\"/></Sequence>")) ==
      "`failure_guard` and `success_guard` are not read\n");
  CHECK(told("<root BTCPP_format=\"4\" declare=\"var x\" specification=\"G x\">"
             "<BehaviorTree ID=\"M\" speed=\"1\"><A/></BehaviorTree></root>") ==
        "`declare`, `specification` and `speed` are not read\n");
  // MoveIt Pro's values for the entries of a tree.
  CHECK(told("<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\" speed=\"1\">"
             "<A by=\"{speed}\"/></BehaviorTree></root>")
            .empty());
  // Those of editors, of ports, and of the engine.
  CHECK(
      told(tree("<A _description=\"d\" port=\"1\" _while=\"true\"/>")).empty());
  CHECK(told("<root BTCPP_format=\"4\" xmlns:x=\"u\" project_name=\"p\" "
             "main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\" "
             "_fullpath=\"\"><A _uid=\"1\"/></BehaviorTree></root>")
            .empty());
  // A warning has it.
  CHECK(told(tree("<A _skipif=\"true\"/>")).empty());
  // A leaf that has such a port.
  CHECK(told(version4("<BehaviorTree ID=\"M\"><A running_guard=\"1\"/>"
                      "</BehaviorTree><TreeNodesModel><Action ID=\"A\">"
                      "<input_port name=\"running_guard\"/></Action>"
                      "</TreeNodesModel>"))
            .empty());
  // Version 3 has no conditions.
  const std::string old =
      "<root BTCPP_format=\"3\"><BehaviorTree ID=\"M\"><A _while=\"x\"/>"
      "</BehaviorTree></root>";
  CHECK(told(old) == "`_while` is not read\n");
}

}  // namespace btcheck::btcpp_libraries_test

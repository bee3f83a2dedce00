// SPDX-License-Identifier: MIT
//
// Every code of the reader of BehaviorTree.CPP's XML, and near misses.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "btcpp_text.hpp"
#include "model/btcpp/expand/checks.hpp"

namespace btcheck::btcpp_errors_test {
namespace {

using btcpp::folded_name;
using btcpp::is_one_slip;
using btcpp::is_similar;

struct Case {
  const char* inside;  // of the tree M
  const char* codes;
};

void check_all(const std::vector<Case>& cases) {
  for (const Case& each : cases) {
    CAPTURE(each.inside);
    CHECK(codes_in(tree4(each.inside)) == each.codes);
  }
}

TEST_CASE("the number of children is checked, as loading and ticking do") {
  check_all({{"<Sequence/>", "BT1607"},
             {"", "BT1607"},
             {"<A/><A/>", "BT1607"},
             {"<Inverter/>", "BT1607"},
             {"<Delay delay_msec=\"5\"/>", "BT1607"},
             {"<AlwaysSuccess><A/></AlwaysSuccess>", "BT1607"},
             {"<TryCatch><A/></TryCatch>", "BT1607"},
             {"<IfThenElse><A/></IfThenElse>", "BT1607"},
             {"<IfThenElse><A/><A/></IfThenElse>", ""},
             {"<WhileDoElse><A/><A/><A/><A/></WhileDoElse>", "BT1607"},
             {"<Switch2 variable=\"{v}\" case_1=\"1\" case_2=\"2\"><A/><A/>"
              "</Switch2>",
              "BT1607"},
             {"<RecoveryNode><A/></RecoveryNode>", "BT1607"},
             {"<SubTree ID=\"N\"><A/></SubTree>", "BT1607"}});
}

TEST_CASE("IDs stand where they are needed, and nowhere else") {
  check_all({{"<Action/>", "BT1604"},
             {"<SubTree/>", "BT1604"},
             {"<A ID=\"A\"/>", "BT1604"},
             {"<SubTree ID=\"a b\"/>", "BT1605"},
             {"<root/>", "BT1605"},
             {"<SubTree ID=\"Sequence\"/>", "BT1606"}});
  CHECK(codes_in(version4("<BehaviorTree ID=\"a.b\"><A/></BehaviorTree>")) ==
        "BT1605");
  CHECK(codes_in(version4("<BehaviorTree ID=\"Delay\"><A/></BehaviorTree>")) ==
        "BT1606");
  CHECK(codes_in(version4("<BehaviorTree><A/></BehaviorTree>"
                          "<TreeNodesModel/>")) == "BT1604");
  CHECK(codes_in(version4("<BehaviorTree ID=\"M\"><A/></BehaviorTree>"
                          "<TreeNodesModel/><TreeNodesModel/>")) == "BT1606");
  CHECK(codes_in(version4("<BehaviorTree ID=\"M\"><A/></BehaviorTree>"
                          "<TreeNodesModel><Action/></TreeNodesModel>")) ==
        "BT1604");
}

TEST_CASE("files that are none") {
  CHECK(codes_in("") == "BT1600");
  CHECK(codes_in("<tree/>") == "BT1601");
  CHECK(codes_in(std::string("<root>\0</root>", 14)) == "BT1000");
  CHECK(codes_in(version4("<include/>")) == "BT1603");
  CHECK(codes_in(version4("<include path=\"x.xml\"/>")) == "BT1603");
  CHECK(codes_in(version4("<include path=\"a.xml\"/>"),
                 {{"a.xml", version4("<include path=\"a.xml\"/>")}}) ==
        "BT1603");
  std::string deep;
  for (int i = 0; i < 300; ++i) deep += "<Inverter>";
  deep += "<A/>";
  for (int i = 0; i < 300; ++i) deep += "</Inverter>";
  CHECK(codes_in(tree4(deep)) == "BT1602");
}

TEST_CASE("a tag with thousands of attributes is given up") {
  const auto with = [](int count, const std::string& value) {
    std::string tag = "<A";
    for (int i = 0; i < count; ++i) {
      tag += " a" + std::to_string(i) + "=\"" + value + "\"";
    }
    return codes_in(tree4("<!-- ' --><Sequence>" + tag + "/><B x='\"'/>" + tag +
                          "/></Sequence>"));
  };
  CHECK(with(1000, "x = 1 > '") == "");
  CHECK(with(1001, "x") == "BT1602");
  CHECK(with(100000, "x") == "BT1602");
}

TEST_CASE("a tree that doubles with every subtree is given up") {
  std::string trees;
  for (int i = 0; i < 20; ++i) {
    const std::string next = "<SubTree ID=\"T" + std::to_string(i + 1) + "\"/>";
    trees += "<BehaviorTree ID=\"T" + std::to_string(i) + "\"><Sequence>" +
             next + next + "</Sequence></BehaviorTree>";
  }
  trees += "<BehaviorTree ID=\"T20\"><A/></BehaviorTree>";
  CHECK(codes_in("<root BTCPP_format=\"4\" main_tree_to_execute=\"T0\">" +
                 trees + "</root>") == "BT1602");
}

TEST_CASE("long names in many paths are given up") {
  std::string leaves;
  for (int i = 0; i < 1000; ++i) leaves += "<AlwaysSuccess/>";
  const auto with_name = [&](std::size_t length) {
    return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
           "<BehaviorTree ID=\"M\"><SubTree ID=\"S\" name=\"" +
           std::string(length, 'n') +
           "\"/></BehaviorTree><BehaviorTree ID=\"S\"><Sequence>" + leaves +
           "</Sequence></BehaviorTree></root>";
  };
  CHECK(codes_in(with_name(1000)) == "");
  CHECK(codes_in(with_name(100000)) == "BT1602");
}

TEST_CASE("subtrees exist, end, and are told apart") {
  const auto with_trees = [](std::string_view inside) {
    return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
           "<BehaviorTree ID=\"M\"><Sequence>" +
           std::string(inside) +
           "</Sequence></BehaviorTree><BehaviorTree ID=\"Other\">"
           "<SubTree ID=\"M\"/></BehaviorTree><BehaviorTree ID=\"Leaf\"><A/>"
           "</BehaviorTree></root>";
  };
  CHECK(codes_in(with_trees("<SubTree ID=\"Nope\"/>")) == "BT1612");
  CHECK(codes_in(with_trees("<SubTree ID=\"M\"/>")) == "BT1613");
  CHECK(codes_in(with_trees("<SubTree ID=\"Other\"/>")) == "BT1613");
  CHECK(codes_in(with_trees("<SubTree ID=\"Leaf\" name=\"n\"/>"
                            "<SubTree ID=\"Leaf\" name=\"n\"/>")) == "BT1606");
  CHECK(codes_in(with_trees("<SubTree ID=\"Leaf\"/><SubTree ID=\"Leaf\"/>")) ==
        "BT1647");
  CHECK(codes_in(with_trees("<SubTree ID=\"Leaf\" _autoremap=\"ja\"/>")) ==
        "BT1610");
  CHECK(codes_in(with_trees("<Leaf/>")) == "BT1608");
  CHECK(codes_in(with_trees("<SubTreePlus ID=\"Leaf\"/>")) == "BT1608");
}

TEST_CASE("ports exist, have values, and are all there") {
  check_all({{"<Parallel failure_threshold=\"1\"><A/></Parallel>", "BT1609"},
             {"<Repeat num_cycles=\"x\"><A/></Repeat>", "BT1610"},
             {"<Repeat num_cycles=\"5x\"><A/></Repeat>", "BT1642"},
             {"<Repeat num_cycles=\"5.5\"><A/></Repeat>", "BT1642"},
             {"<Repeat num_cycles=\"5 \"><A/></Repeat>", ""},
             {"<Repeat num_cycles=\"{n}\"><A/></Repeat>", ""},
             {"<Repeat num_cycles=\"{=}\"><A/></Repeat>", ""},
             {"<Repeat num_cycles=\" {n}\"><A/></Repeat>", "BT1610"},
             {"<Repeat num_cycles=\"=\"><A/></Repeat>", "BT1610"},
             {"<Repeat num_cycles=\"${n}\"><A/></Repeat>", "BT1610"},
             {"<Repeat num_cycles=\"5000000000\"><A/></Repeat>", "BT1610"},
             {"<Timeout msec=\"-1\"><A/></Timeout>", "BT1610"},
             {"<Timeout><A/></Timeout>", "BT1617"},
             {"<RunOnce then_skip=\"yes\"><A/></RunOnce>", "BT1610"},
             {"<Precondition if=\"true\" else=\"DONE\"><A/></Precondition>",
              "BT1610"},
             {"<RateController hz=\"fast\"><A/></RateController>", "BT1610"},
             {"<Parallel success_count=\"3\"><A/><A/></Parallel>", "BT1618"},
             {"<Parallel success_count=\"2\"><A/><A/></Parallel>", ""},
             {"<Parallel success_count=\"-1\"><A/></Parallel>", ""},
             {"<Parallel failure_count=\"0\"><A/></Parallel>", "BT1631"},
             {"<ParallelAll max_failures=\"2\"><A/></ParallelAll>", "BT1618"}});
}

TEST_CASE("a model's ports are compared with what stands in the tree") {
  const auto with_model = [](std::string_view inside) {
    return version4("<BehaviorTree ID=\"M\">" + std::string(inside) +
                    "</BehaviorTree><TreeNodesModel><Action ID=\"Act\">"
                    "<input_port name=\"count\" type=\"int\"/>"
                    "<output_port name=\"out\"/></Action>"
                    "<Noise/></TreeNodesModel>");
  };
  CHECK(codes_in(with_model("<Act count=\"1\" out=\"{o}\"/>")) == "BT1625");
  CHECK(codes_in(with_model("<Act count=\"x\"/>")) == "BT1625 BT1610");
  CHECK(codes_in(with_model("<Act cuont=\"1\"/>")) == "BT1625 BT1626");
  CHECK(codes_in(with_model("<Act out=\"o\"/>")) == "BT1625 BT1630");
  CHECK(codes_in(with_model("<Condition ID=\"Act\"/>")) == "BT1623 BT1625");
}

TEST_CASE("models without ports are one note, however many ports are used") {
  const auto severities = [](std::string_view model) {
    const auto read = read_tree(version4(
        "<BehaviorTree ID=\"M\"><Sequence><Act a=\"1\" b=\"2\"/><Act c=\"3\"/>"
        "<Bct zzzz=\"3\"/></Sequence></BehaviorTree><TreeNodesModel>" +
        std::string(model) + "<Action ID=\"Bct\"/></TreeNodesModel>"));
    std::string text;
    for (const Diagnostic& each : read.diagnostics) {
      text += each.code + (each.severity == Severity::Note ? "? " : " ") +
              each.message;
    }
    return text;
  };
  CHECK(severities("<Action ID=\"Act\"/>") ==
        "BT1626? no model has 4 of the ports that are used: `a` of `Act`, `b` "
        "of `Act`, `c` of `Act`, …");
  CHECK(severities("<Action ID=\"Act\"><input_port name=\"count\"/></Action>")
            .starts_with("BT1626 no model has 4"));
}

TEST_CASE("a name inside a longer text of the program's node is a mention") {
  const auto codes = [](const std::string& node) {
    return codes_in(version4(
        "<BehaviorTree ID=\"M\"><Sequence><SetBlackboard "
        "output_key=\"subprop\" value=\"a\"/><SetBlackboard "
        "output_key=\"prop\" value=\"a\"/><Look prop=\"{prop}\"/>" +
        node +
        "</Sequence></BehaviorTree><TreeNodesModel><Action ID=\"Look\">"
        "<input_port name=\"prop\"/></Action></TreeNodesModel>"));
  };
  CHECK(codes("").find("BT1628") != std::string::npos);
  CHECK(codes("<Format format=\"{subprop}_frame\"/>").find("BT1628") ==
        std::string::npos);
  CHECK(codes("<Sleep msec=\"{subprop}0\"/>").find("BT1628") !=
        std::string::npos);
}

// As BehaviorTree.CPP 4.10 answered for leaves with ports of these types.
TEST_CASE("the literal of an output port is read when the tree is loaded") {
  const auto with_output = [](std::string_view type, std::string_view value) {
    return codes_in(
        version4("<BehaviorTree ID=\"M\"><Act out=\"" + std::string(value) +
                 "\"/></BehaviorTree><TreeNodesModel><Action ID=\"Act\">"
                 "<output_port name=\"out\" type=\"" +
                 std::string(type) + "\"/></Action></TreeNodesModel>"));
  };
  for (const char* type : {"int", "unsigned int", "double", "bool"}) {
    CAPTURE(type);
    CHECK(with_output(type, "") == "BT1610");
    CHECK(with_output(type, "some") == "BT1610");
    CHECK(with_output(type, "=") == "BT1610");
    CHECK(with_output(type, " {x} ") == "BT1610");
    CHECK(with_output(type, "1") == "BT1630");
    CHECK(with_output(type, "{x}") == "");
    CHECK(with_output(type, "{=}") == "");
  }
  for (const char* type : {"std::string", "NodeStatus", "Pose", ""}) {
    CAPTURE(type);
    CHECK(with_output(type, "") == "BT1630");
    CHECK(with_output(type, "some") == "BT1630");
  }
}

TEST_CASE("scripts are checked where they stand") {
  check_all({{"<Script code=\"x := 1 +\"/>", "BT1615"},
             {"<Script code=\"\"/>", ""},
             {"<Script code=\" \"/>", "BT1615"},
             {"<ScriptCondition code=\"\"/>", "BT1615"},
             {"<A _post=\"\"/>", "BT1615"},
             {"<A _skipIf=\"a &&\"/>", "BT1615"},
             {"<A _onSuccess=\"x := 1; y := (2\"/>", "BT1615"},
             {"<Script code=\"x = 1\"/>", "BT1627"},
             {"<A _while=\"nope\"/>", "BT1627"},
             {"<A _while=\"mode == IDLE_MODE\" p=\"{mode}\"/>", ""},
             {"<Script code=\"x := 1; x = x + 1\"/>", ""},
             {"<A _skipif=\"true\"/>", "BT1625"}});
  const auto found = read_tree(tree4("<A _skipIf=\"a &amp;&amp; b\"/>"));
  CHECK(found.diagnostics.back().code == "BT1627");
  const auto flaw = read_tree(tree4("<Script code=\"x := )\"/>")).diagnostics;
  REQUIRE(flaw.size() == 1);
  CHECK(flaw[0].span.column == 64);
  CHECK(flaw[0].span.length == 1);
}

TEST_CASE("what a ReactiveSequence refuses") {
  check_all({{"<ReactiveSequence><Condition ID=\"C\"/><A/></ReactiveSequence>",
              "BT1619"},
             {"<Sequence><Condition ID=\"C\"/><A/></Sequence>", ""},
             {"<ReactiveSequence><AsyncSequence><A/></AsyncSequence>"
              "<AsyncSequence><A/></AsyncSequence></ReactiveSequence>",
              "BT1619"}});
}

TEST_CASE("entries have one type, a writer, and one spelling") {
  check_all({{"<Sequence><Repeat num_cycles=\"{n}\"><A/></Repeat>"
              "<Timeout msec=\"{n}\"><A/></Timeout></Sequence>",
              "BT1616"},
             {"<Sequence><Sleep msec=\"{n}\"/>"
              "<Timeout msec=\"{n}\"><A/></Timeout></Sequence>",
              ""},
             {"<Sequence><A p=\"{n}\"/><Repeat num_cycles=\"{n}\"><A/></Repeat>"
              "<Timeout msec=\"{n}\"><A/></Timeout></Sequence>",
              ""},
             {"<Sequence><A p=\"{near_goal}\"/><A p=\"{near_goal}\"/>"
              "<A p=\"{nearGoal}\"/></Sequence>",
              "BT1628"},
             {"<Sequence><A p=\"{goal}\"/><A p=\"{goals}\"/></Sequence>", ""},
             {"<Sequence><Script code=\"speed := 1\"/>"
              "<ScriptCondition code=\"spead > 0\"/></Sequence>",
              "BT1628"}});
  const auto found =
      read_tree(tree4("<Sequence><Script code=\"speed := 1\"/>"
                      "<ScriptCondition code=\"spead > 0\"/></Sequence>"))
          .diagnostics;
  REQUIRE(found.size() == 1);
  CHECK(found[0].help == "did you mean `speed`, which `Script` writes?");
  CHECK(found[0].span.length == 5);
}

TEST_CASE("a key that is read and never written, one slip from another") {
  const auto with_model = [](std::string_view inside) {
    return version4("<BehaviorTree ID=\"M\"><Sequence>" + std::string(inside) +
                    "</Sequence></BehaviorTree><TreeNodesModel>"
                    "<Action ID=\"Find\"><output_port name=\"at\"/></Action>"
                    "<Action ID=\"Go\"><input_port name=\"to\"/></Action>"
                    "<Decorator ID=\"Each\"><input_port name=\"of\"/>"
                    "<output_port name=\"one\"/></Decorator>"
                    "</TreeNodesModel>");
  };
  CHECK(codes_in(with_model("<Find at=\"{target}\"/><Go to=\"{target}\"/>")) ==
        "");
  CHECK(codes_in(with_model("<Find at=\"{target}\"/><Go to=\"{taregt}\"/>")) ==
        "BT1628");
  CHECK(codes_in(with_model("<Find at=\"{target}\"/><Go to=\"{origin}\"/>")) ==
        "");
  CHECK(codes_in(with_model("<Find at=\"{target}\"/><Go to=\"{target2}\"/>")) ==
        "");
  // What is gone through, and what is found there.
  CHECK(codes_in(with_model("<Each of=\"{masks3d}\" one=\"{mask3d}\">"
                            "<Go to=\"{mask3d}\"/></Each>")) == "");
}

TEST_CASE("one slip of the finger") {
  CHECK(is_one_slip("waypoint", "waypiont"));
  CHECK(is_one_slip("waypoint", "waypont"));
  CHECK(is_one_slip("waypoint", "wayppoint"));
  CHECK(is_one_slip("waypoint", "waypoimt"));
  CHECK(is_one_slip("waypoint", "xwaypoint"));
}

TEST_CASE("names that are meant to differ") {
  CHECK(!is_one_slip("waypoint", "waypoint"));
  CHECK(!is_one_slip("waypoint", "waypoints"));
  CHECK(!is_one_slip("waypoint1", "waypoint2"));
  CHECK(!is_one_slip("waypoint", "waypoint2"));
  CHECK(!is_one_slip("pose_a", "pose_bc"));
  CHECK(!is_one_slip("goal", "gaol"));
  CHECK(!is_one_slip("", ""));
}

TEST_CASE("capitals and underscores are folded away") {
  CHECK(folded_name("nearGoal") == folded_name("near__goal"));
  CHECK(folded_name("near") != folded_name("fear"));
}

TEST_CASE("the later of two trees of one ID is the tree") {
  const std::string text = version4(
      "<include path=\"a.xml\"/><BehaviorTree ID=\"M\"><A/></BehaviorTree>");
  const NamedTexts others = {
      {"a.xml", version4("<BehaviorTree ID=\"M\"><Inverter><A/></Inverter>"
                         "</BehaviorTree>")}};
  CHECK(codes_in(text, others) == "BT1624");
  CHECK(good_tree(text, others).expansion.nodes.size() == 1);
}

TEST_CASE("nodes that no model has are said once") {
  const auto found =
      read_tree(tree4("<inverter><Sequence><A/><A/></Sequence></inverter>"))
          .diagnostics;
  CHECK(codes_of(found) == "BT1621 1:46 BT1620 1:66");
  CHECK(found[0].severity == Severity::Error);
  CHECK(found[0].help == "write `Inverter`");
  const auto old = read_tree(
      "<root BTCPP_format=\"3\"><BehaviorTree ID=\"M\">"
      "<inverter><A/></inverter></BehaviorTree></root>");
  CHECK(old.is_read);
  CHECK(old.diagnostics[0].help == "did you mean `Inverter`?");
}

TEST_CASE("all leaves that no model has are one note") {
  const auto found =
      read_tree(tree4("<Sequence><Grasp/><IsNear/><battery_ok/></Sequence>"))
          .diagnostics;
  REQUIRE(codes_of(found) == "BT1620 1:56");
  CHECK(found[0].message ==
        "no model has 3 leaves: `Grasp`, `IsNear` and `battery_ok`");
  CHECK(found[0].help ==
        "`IsNear` and `battery_ok` sound like conditions: say so in "
        "`<TreeNodesModel>`, or by --leaves; `btcheck leaves` begins either");
}

TEST_CASE("types that go by the names of older releases") {
  const std::string retry =
      "<BehaviorTree ID=\"M\"><RetryUntilSuccesful num_attempts=\"2\">"
      "<AlwaysFailure/></RetryUntilSuccesful></BehaviorTree></root>";
  const auto in_3 = read_tree("<root BTCPP_format=\"3\">" + retry);
  REQUIRE(in_3.is_read);
  CHECK(codes_of(in_3.diagnostics) == "BT1643 1:46");
  CHECK(in_3.expansion.nodes[0].node->id == "RetryUntilSuccessful");
  CHECK(codes_in("<root BTCPP_format=\"4\">" + retry) == "BT1608");
  check_all(
      {{"<BlackboardCheckInt value_A=\"{a}\" value_B=\"1\"><A/>"
        "</BlackboardCheckInt>",
        "BT1608"}});
}

TEST_CASE("version 3 takes an output without braces for the entry's name") {
  const std::string inside =
      "<BehaviorTree ID=\"M\"><Sequence><Find at=\"spot\"/><Go to=\"{spot}\"/>"
      "</Sequence></BehaviorTree><TreeNodesModel>"
      "<Action ID=\"Find\"><output_port name=\"at\"/></Action>"
      "<Action ID=\"Go\"><input_port name=\"to\"/></Action>"
      "</TreeNodesModel></root>";
  CHECK(codes_in("<root BTCPP_format=\"3\">" + inside) == "");
  CHECK(codes_in("<root BTCPP_format=\"4\">" + inside) == "BT1630");
}

TEST_CASE("entries that a subtree needs and is not given") {
  const auto with_call = [](std::string_view call, std::string_view inside) {
    return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
           "<BehaviorTree ID=\"M\"><Sequence><Find at=\"{spot}\"/>" +
           std::string(call) + "</Sequence></BehaviorTree>" +
           "<BehaviorTree ID=\"S\"><Sequence>" + std::string(inside) +
           "</Sequence></BehaviorTree><TreeNodesModel>"
           "<Action ID=\"Find\"><output_port name=\"at\"/></Action>"
           "<Action ID=\"Go\"><input_port name=\"to\"/>"
           "<input_port name=\"via\" default=\"none\"/></Action>"
           "</TreeNodesModel></root>";
  };
  const std::string go = "<Go to=\"{spot}\"/>";
  const auto found =
      read_tree(with_call("<SubTree ID=\"S\"/>", go)).diagnostics;
  REQUIRE(codes_of(found) == "BT1644 1:100");
  CHECK(found[0].message == "`spot` is not passed to `S`");
  CHECK(found[0].label ==
        "`Go` (line 1) reads it there, and nothing inside writes it");
  CHECK(found[0].help == "pass it: `spot=\"{spot}\"`");
  for (const std::string_view call :
       {"<SubTree ID=\"S\" spot=\"{spot}\"/>", "<SubTree ID=\"S\" spot=\"3\"/>",
        "<SubTree ID=\"S\" _autoremap=\"true\"/>"}) {
    CHECK(codes_in(with_call(call, go)) == "");
  }
  for (const std::string_view inside :
       {"<Go to=\"{@spot}\"/>", "<Go via=\"{spot}\"/>",
        "<Unknown p=\"{spot}\"/><Go to=\"{spot}\"/>",
        "<Script code=\"spot := 1\"/><Go to=\"{spot}\"/>"}) {
    CAPTURE(inside);
    CHECK(codes_in(with_call("<SubTree ID=\"S\"/>", inside)) == "");
  }
  CHECK(codes_in(with_call("<SubTree ID=\"S\"/>",
                           "<ScriptCondition code=\"spot > 1\"/>")) ==
        "BT1644");
}

TEST_CASE("entries that scripts write and nothing reads") {
  check_all(
      {{"<Script code=\"battery_okay := true\"/>", "BT1645"},
       {"<Sequence><Script code=\"x := 1\"/><A p=\"{x}\"/></Sequence>", ""},
       {"<Sequence><Script code=\"battery_ok := false\"/>"
        "<Script code=\"battery_okay := true\"/>"
        "<ScriptCondition code=\"battery_ok\"/></Sequence>",
        "BT1628"},
       {"<SetBlackboard value=\"1\" output_key=\"{x}\"/>", "BT1646"}});
  const auto found =
      read_tree(
          tree4("<Sequence><Script code=\"a := 1; b := 2\"/>"
                "<SetBlackboard value=\"1\" output_key=\"c\"/></Sequence>"))
          .diagnostics;
  REQUIRE(found.size() == 1);
  CHECK(found[0].severity == Severity::Note);
  CHECK(found[0].message ==
        "nothing in the tree reads `a`, `b` and `c`, which scripts write");
}

TEST_CASE("similar names") {
  CHECK(is_similar("sonar_ok", "sonar_okay"));
  CHECK(is_similar("cup_pos", "cup_pose"));
  CHECK(is_similar("goal", "goals"));
  CHECK(is_similar("pose", "cup_pose"));
  CHECK_FALSE(is_similar("min_x", "max_x"));
  CHECK_FALSE(is_similar("pos_x", "pos_y"));
  CHECK_FALSE(is_similar("leg_1", "leg_2"));
  CHECK_FALSE(is_similar("speed", "mode"));
}

TEST_CASE("a finding looks like this") {
  const auto found = read_tree(
      version4("\n<BehaviorTree ID=\"M\">\n  <Delay delay_msec=\"300\"/>\n"
               "</BehaviorTree>\n"));
  REQUIRE(found.diagnostics.size() == 1);
  CHECK(render(found.diagnostics[0]) ==
        "error[BT1607]: `Delay` has no children\n"
        "  --> t.xml:3:4\n"
        "  |\n"
        "3 |   <Delay delay_msec=\"300\"/>\n"
        "  |    ^^^^^ exactly 1 needed\n"
        "  |\n"
        "  = help: add one, or delete the node\n");
}

}  // namespace
}  // namespace btcheck::btcpp_errors_test

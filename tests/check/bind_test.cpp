// SPDX-License-Identifier: MIT
//
// Atoms looked up in a small tree: every way to name a node, a process or a
// variable, and what is said of a name that fits nothing or too much.
#include "check/bind/bind.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/bind/name_help.hpp"
#include "check/checked.hpp"
#include "model/tree_file.hpp"

namespace btcheck::bind_test {
namespace {

// Processes: battery 1, ok 2, land 3, safe 4, land 5, cam 6, up 7, w 8, rr 9,
// main 10, mission 11, w's timer 12.
constexpr std::string_view kMission =
    R"((defsv battery :states (Good Low Critical) :init Good)
(defsv level :min 0 :max 3)
(BehaviorTree :name mission
 (Sequence :name main
  (Fallback :name safe (Condition :ID ok)
   (Action :ID land))
  (Action :ID land)
  (Action :ID camera :name cam)
  (RoundRobin :name rr (Action :name up) (Wait :name w :duration 2)))))";

struct Row {
  std::string atom;
  std::string expected;
};

void check_rows(const std::vector<Row>& table,
                std::string_view tree = kMission) {
  const Lowered model(tree);
  for (const Row& row : table) {
    CAPTURE(row.atom);
    CHECK(bound(model, row.atom) == row.expected);
  }
}

// What is in backticks in the help for a rule.
std::vector<std::string> suggested(const std::string& help) {
  std::vector<std::string> found;
  for (std::size_t at = 0; (at = help.find('`', at)) != help.npos;) {
    const std::size_t end = help.find('`', at + 1);
    found.push_back(help.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return found;
}

// Names that need quotes in rules, in an XML tree.
constexpr std::string_view kOddNames =
    R"(<root BTCPP_format="4" main_tree_to_execute="T">
<BehaviorTree ID="T"><Sequence name="go there">
<Script code="in := 3; mode := 'On duty'; level := 2"/>
<Condition ID="lost"/><Condition ID="C" name="is fine"/>
<Fallback name="always"><Action ID="land"/><Action ID="dock-it"/></Fallback>
<Action ID="land"/><Action ID="fly_home"/><Condition ID="F"/>
<SubTree ID="U" name="a b"/></Sequence></BehaviorTree>
<BehaviorTree ID="U"><Sequence><Action ID="land"/></Sequence></BehaviorTree>
<TreeNodesModel><Action ID="land"/><Action ID="dock-it"/><Action ID="fly_home"/>
<Condition ID="lost"/><Condition ID="C"/><Condition ID="F"/></TreeNodesModel>
</root>)";

// Whether a rule about it is read and bound without a word.
bool binds(const BehaviorTree& tree, const Network& network,
           const std::string& condition) {
  const std::string text = "prove never " + condition + "\n";
  const auto file = read_properties("p.ltl", text);
  if (!file.value || file.value->atoms.size() != 1) return false;
  const SourceText source("p.ltl", text);
  std::vector<Diagnostic> found;
  return Binder(tree, network, source, found)
             .bind(file.value->atoms[0])
             .has_value() &&
         found.empty();
}

TEST_CASE("whatever is suggested for a name binds") {
  for (const std::string_view text : {kMission, kOddNames}) {
    const auto read =
        read_tree(text == kMission ? "t.btf" : "t.xml", std::string(text), {});
    REQUIRE(read.value);
    const BehaviorTree& tree = *read.value;
    const Network network = lower(tree, TickSemantics::Root);
    const NodeNames nodes(tree);
    std::vector<std::string> names = {"lost", "lnd",     "flyhome",
                                      "root", "battrey", "dock"};
    for (const Node& node : tree.nodes) names.push_back(node.name);
    for (const auto& each : tree.variables) names.push_back(each.name);
    for (const std::string& name : names) {
      for (const std::string& help :
           {condition_help(tree, nodes, name), node_help(tree, nodes, name),
            variable_help(tree, nodes, name)}) {
        CAPTURE(name);
        CAPTURE(help);
        std::vector<std::string> all = suggested(help);
        // Begins with the name that is asked about, or that several have.
        const bool tells_name = help.starts_with("no node") ||
                                help.starts_with('`') ||
                                (help.starts_with("did you") &&
                                 help.find("there are") != help.npos);
        if (tells_name) all.erase(all.begin());
        for (const std::string& each : all) {
          CAPTURE(each);
          CHECK((binds(tree, network, each) ||
                 binds(tree, network, each + ".ticked") ||
                 binds(tree, network, each + " == " + each)));
        }
      }
    }
  }
}

TEST_CASE("a name that a rule says nothing about is told what it is") {
  const Lowered model(kMission);
  const auto help = [&](const std::string& name) {
    const auto read =
        read_rules("p.ltl", "prove never " + name + " and true\n", model.tree);
    REQUIRE(read.diagnostics.size() == 1);
    return read.diagnostics[0].help;
  };
  CHECK(help("ok") == "write `ok.ticked`, `ok.success`, `ok.failure`");
  CHECK(help("battery") == "compare it: `battery == Critical`");
  CHECK(help("lost") == "no node and no variable is called `lost`");
  CHECK(help("batery") == "did you mean `battery`?");
  CHECK(help("\"safe\"") ==
        "write `safe.ticked`, `safe.success`, `safe.failure`, `safe.running`");
  CHECK(help("root") == "write `root.success`, `root.failure`, `root.ended`");
}

TEST_CASE("a node can be named in every way") {
  const std::string first = "land_btn4.location = tick_node";
  const std::string second = "land_btn5.location = tick_node";
  check_rows({{"cam.ticked", "cam_btn6.location = tick_node"},
              {"camera.ticked", "cam_btn6.location = tick_node"},
              {"cam_btn6.ticked", "cam_btn6.location = tick_node"},
              {"btn6.ticked", "cam_btn6.location = tick_node"},
              {"main/cam.ticked", "cam_btn6.location = tick_node"},
              {"land@6.ticked", first},
              {"land@7.ticked", second},
              {"safe/land.ticked", first},
              {"main/safe/land.ticked", first},
              {"main/land.ticked", second},
              {"land_btn4.ticked", first},
              {"btn5.ticked", second}});
}

TEST_CASE("an event is a location of the node's automaton") {
  check_rows({{"cam.ticked", "cam_btn6.location = tick_node"},
              {"cam.success", "cam_btn6.location = success"},
              {"cam.failure", "cam_btn6.location = failure"},
              {"cam.running", "cam_btn6.location = running"},
              {"cam.halted", "cam_btn6.location = halted"},
              {"cam.done", "cam_btn6.location = done"},
              {"cam.active",
               "cam_btn6.caller = main_btn1 or cam_btn6.rstatus = running"}});
}

TEST_CASE("an event that a node type does not have is never true") {
  check_rows({{"ok.running", "0 !BT1106"}, {"ok.halted", "0 !BT1106"}});
}

TEST_CASE("a name that fits two nodes is refused with the candidates") {
  const Lowered model(kMission);
  CHECK(bound(model, "land.ticked") == " !BT1102");
  const std::string text = complaint(model, "land.ticked");
  CHECK(text.find("`land` names 2 nodes") != std::string::npos);
  CHECK(text.find("`land@6`, `land@7`") != std::string::npos);
}

TEST_CASE("a :name wins over another node's :ID") {
  check_rows({{"cam.ticked", "cam_btn2.location = tick_node"}},
             "(BehaviorTree :name t (Sequence (Action :ID x :name cam)"
             " (Action :ID cam :name y)))");
}

TEST_CASE("an unknown node is refused with the nearest name") {
  const Lowered model(kMission);
  CHECK(bound(model, "cma.ticked") == " !BT1101");
  CHECK(complaint(model, "can.ticked").find("did you mean `cam` (line 8)") !=
        std::string::npos);
  CHECK(complaint(model, "lands.ticked").find("did you mean `land`") !=
        std::string::npos);
  CHECK(bound(model, "land@5.ticked") == " !BT1101");
  CHECK(bound(model, "fe/land.ticked") == " !BT1101");
  CHECK(bound(model, "btn10.ticked") == " !BT1101");
  CHECK(complaint(model, "xyzzy.ticked").find("did you mean") ==
        std::string::npos);
}

TEST_CASE("the root has events of its own") {
  const std::string succeeded = "mission_btn0.location = success";
  const std::string failed = "mission_btn0.location = failure";
  check_rows(
      {{"root.success", succeeded},
       {"root.failure", failed},
       {"root.ticked", "mission_btn0.location = tick_node"},
       {"root.running", "mission_btn0.location = running"},
       {"root.ended", succeeded + " or " + failed},
       {"root.active", "not (" + succeeded + " or " + failed + ")"},
       {"mission.ended", "not (not (" + succeeded + " or " + failed + "))"},
       {"mission.success", succeeded},
       {"root.status == running", "mission_btn0.rstatus = running"}});
  const Lowered model(kMission);
  CHECK(bound(model, "root.halted") == " !BT1104");
}

TEST_CASE("several trees succeed together, and fail when one does") {
  const std::string_view trees =
      "(BehaviorTree :name a (Action :name x))"
      "(BehaviorTree :name b (Action :name y)) (Trees a b)";
  check_rows(
      {{"root.success",
        "a_btn0.location = success and "
        "b_btn2.location = success"},
       {"root.failure",
        "a_btn0.location = failure or "
        "b_btn2.location = failure"},
       {"tick", "a_btn0.location = tick_node or b_btn2.location = tick_node"},
       {"root.ended",
        "(a_btn0.location = success or a_btn0.location = failure) and "
        "(b_btn2.location = success or b_btn2.location = failure)"},
       {"a.success", "a_btn0.location = success"}},
      trees);
}

TEST_CASE("tick, dead and stuck are words for states") {
  check_rows({{"tick", "mission_btn0.location = tick_node"},
              {"dead", "0 | 1"},
              {"stuck",
               "0 | not (mission_btn0.location = success or "
               "mission_btn0.location = failure)"}});
}

TEST_CASE("a run that a fault has ended is not stuck") {
  check_rows({{"stuck",
               "0 | not (t_btn0.location = success or "
               "t_btn0.location = failure) and fault = false"}},
             "(defsv k :max 2) (BehaviorTree :name t (Eval (:= k (+ k 1))))");
}

TEST_CASE("a process is found by the paper's number") {
  check_rows(
      {{"mission/3/state tick_node", "land_btn4.location = tick_node"},
       {"mission/5/state success", "land_btn5.location = success"},
       {"mission/9/state rr_btn7", " !BT1104"},
       {"mission/1/state Low", "battery = Low"},
       {"mission/11/state tick_node", "mission_btn0.location = tick_node"},
       {"MISSION/11/state tick_node", "mission_btn0.location = tick_node"},
       {"mission/12/state due", "w_btn9_timer.location = due"},
       {"mission/9/state up_btn8", "rr_btn7.location = up_btn8"}});
}

TEST_CASE("a process that is not there is refused") {
  const Lowered model(kMission);
  CHECK(bound(model, "mission/0/state done") == " !BT1103");
  CHECK(bound(model, "mission/13/state done") == " !BT1103");
  CHECK(bound(model, "other/3/state done") == " !BT1103");
  CHECK(bound(model, "mission/3/state flying") == " !BT1104");
  CHECK(bound(model, "mission/1/state Full") == " !BT1104");
  CHECK(bound(model, "mission/2/state running") == "0 !BT1106");
}

TEST_CASE("a value is looked up in the scope of its process") {
  check_rows(
      {{"mission/9/value (next = 2)", "rr_btn7.next = 2"},
       {"mission/9/value (rstatus = failure)", "rr_btn7.rstatus = failure"},
       {"mission/3/value (battery = Low)", "battery = Low"},
       {"mission/3/value (btnode[ok_btn3].rstatus = failure)",
        "ok_btn3.rstatus = failure"}});
}

TEST_CASE("state variables are compared with their values") {
  check_rows({{"battery == Low", "battery = Low"},
              {"battery != Low", "battery ~= Low"},
              {"Low == battery", "Low = battery"},
              {"level > 2", "level > 2"},
              {"level >= 2", "level >= 2"},
              {"2 < level", "level > 2"},
              {"level <= 1", "level <= 1"},
              {"level in 1..2", "level >= 1 and level <= 2"},
              {"cam.status == running", "cam_btn6.rstatus = running"},
              {"cam.status == ok.status", "cam_btn6.rstatus = ok_btn3.rstatus"},
              {"rr.failed < 2", "rr_btn7.failed < 2"},
              {"main.next_seq == 3", "main_btn1.next_seq = 3"},
              {"rr.next in 1..2", "rr_btn7.next >= 1 and rr_btn7.next <= 2"}});
}

TEST_CASE("another case than declared is matched and warned about") {
  check_rows({{"Battery == Low", "battery = Low !BT1107"},
              {"battery == low", "battery = Low !BT1107"},
              {"BATTERY == LOW", "battery = Low !BT1107 BT1107"}});
}

TEST_CASE("a comparison that is always or never true is warned about") {
  check_rows({{"level == 4", "level = 4 !BT1106"},
              {"level != -1", "level ~= -1 !BT1106"},
              {"level > 3", "level > 3"},
              {"level == 3", "level = 3"}});
}

TEST_CASE("sides that do not fit are refused") {
  check_rows({{"battery == Full", " !BT1105"},
              {"battery == 2", " !BT1105"},
              {"level == Low", " !BT1105"},
              {"level == battery", " !BT1105"},
              {"cam.status == Low", " !BT1105"},
              {"battery in 0..1", " !BT1105"},
              {"nothing in 0..1", " !BT1101"},
              {"nothing == Low", " !BT1101"},
              {"3 == nothing", " !BT1101"},
              {"cam.height == 2", " !BT1104"},
              {"nobody.status == success", " !BT1101"}});
}

TEST_CASE("a node is found without regard to case") {
  const Lowered model(kMission);
  CHECK(
      bound(model, "Cam.ticked").starts_with("cam_btn6.location = tick_node"));
  CHECK(bound(model, "Main/Cam.ticked")
            .starts_with("cam_btn6.location = tick_node"));
}

TEST_CASE("an event of a process needs a node, and says what it found") {
  const Lowered model(kMission);
  CHECK(bound(model, "mission/3.ticked") == "land_btn4.location = tick_node");
  CHECK(bound(model, "mission/1.ticked") == " !BT1104");
  CHECK(complaint(model, "mission/1.ticked")
            .find("process 1 is the state variable `battery`, not a node") !=
        std::string::npos);
  CHECK(complaint(model, "mission/12.ticked")
            .find("process 12 is the timer `w_btn9_timer`, not a node") !=
        std::string::npos);
}

}  // namespace
}  // namespace btcheck::bind_test

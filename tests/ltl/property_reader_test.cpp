// SPDX-License-Identifier: MIT
//
// What a property file may say, and what is made of it.
#include "ltl/rules/property.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "ltl/property_text.hpp"

namespace btcheck::test::property_reader_test {
namespace {

TEST_CASE("every body means what the documentation says") {
  const std::vector<Row> rows = {
      {"never a.done", "never: a.done"},
      {"absent a.done or b.done", "never: a.done or b.done"},
      {"always fls <= 3", "invariant: fls <= 3"},
      {"always (a.done => b.done)", "invariant: a.done => b.done"},
      {"always (a.done => <> b.done)", "ltl: [] (a.done => <> b.done)"},
      {"always eventually a.done", "ltl: [] <> a.done"},
      {"possible root.success", "possible: root.success"},
      {"eventually root.ended", "ltl: <> root.ended"},
      {"eventually always a.active", "ltl: <> [] a.active"},
      {"present a.done", "ltl: <> a.done"},
      {"a.done leadsto b.done", "ltl: [] (a.done => <> b.done)"},
      {"whenever a.done then b.done", "ltl: [] (a.done => <> b.done)"},
      {"a.done leadsto b.done within [1,4]",
       "response [1,4]: a.done ~> b.done"},
      {"whenever a.done and tick then b.done within 2 ticks",
       "response [0,2]: a.done and tick ~> b.done"},
      {"a.done leadsto b.done within 1 tick",
       "response [0,1]: a.done ~> b.done"},
      {"a.done leadsto b.done within [0,1000000]",
       "response [0,1000000]: a.done ~> b.done"},
      {"deadlockfree", "deadlock free"},
      {"infinitelyOften a.done", "ltl: [] <> a.done"},
      {"INFINITELYOFTEN a.done", "ltl: [] <> a.done"},
      {"mortal a.done", "ltl: <> [] not a.done"},
      {"ltl a.done", "ltl: a.done"},
      {"[] (a.done => <> b.done)", "ltl: [] (a.done => <> b.done)"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    CHECK(proves(row.text) == row.expected);
  }
}

TEST_CASE("every operator has all its spellings") {
  for (const std::string always : {"[]", "G", "□"}) {
    CHECK(proves(always + " a.done") == "ltl: [] a.done");
  }
  for (const std::string eventually : {"<>", "F", "◇", "♢"}) {
    CHECK(proves(eventually + " a.done") == "ltl: <> a.done");
  }
  for (const std::string next : {"()", "X"}) {
    CHECK(proves(next + " a.done") == "ltl: X a.done");
  }
  for (const std::string negation : {"not", "!", "-", "~", "¬", "NOT"}) {
    CHECK(proves(negation + " a.done") == "ltl: not a.done");
  }
  for (const std::string both : {"and", "&&", "/\\", "∧", "And"}) {
    CHECK(proves("a.done " + both + " tick") == "ltl: a.done and tick");
  }
  for (const std::string either : {"or", "||", "\\/", "∨"}) {
    CHECK(proves("a.done " + either + " tick") == "ltl: a.done or tick");
  }
  for (const std::string implies : {"=>", "->", "⇒"}) {
    CHECK(proves("a.done " + implies + " tick") == "ltl: a.done => tick");
  }
  for (const std::string until : {"U", "until"}) {
    CHECK(proves("a.done " + until + " tick") == "ltl: a.done U tick");
  }
  for (const std::string release : {"R", "V", "release"}) {
    CHECK(proves("a.done " + release + " tick") == "ltl: a.done R tick");
  }
  CHECK(proves("a.done W tick") == "ltl: a.done W tick");
  CHECK(proves("a.done <=> tick") == "ltl: a.done <=> tick");
}

TEST_CASE("precedence is unary, and, or, implication, equivalence") {
  const std::vector<Row> rows = {
      {"not a.done and b.done", "ltl: not a.done and b.done"},
      {"a.done and b.done or tick", "ltl: (a.done and b.done) or tick"},
      {"a.done or b.done and tick", "ltl: a.done or (b.done and tick)"},
      {"a.done or b.done => tick", "ltl: a.done or b.done => tick"},
      {"a.done => b.done <=> tick", "ltl: (a.done => b.done) <=> tick"},
      {"<> a.done and b.done", "ltl: <> a.done and b.done"},
      {"[] <> a.done => [] <> b.done", "ltl: [] <> a.done => [] <> b.done"},
      {"not not - a.done", "ltl: not not not a.done"},
      {"(a.done U b.done) and tick", "ltl: (a.done U b.done) and tick"},
      {"not a.done U b.done", "ltl: not a.done U b.done"},
      {"a.done => (b.done => tick)", "ltl: a.done => (b.done => tick)"},
      {"(a.done and b.done) and tick", "ltl: a.done and b.done and tick"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const PropertyFile file = accepted("prove " + row.text);
    const PropertyFile again =
        accepted("prove " + text_of(file, file.properties[0].formula));
    CHECK(text_of(file, file.properties[0].formula) ==
          text_of(again, again.properties[0].formula));
    CHECK(read("prove ltl " + row.text).diagnostics.empty());
  }
  CHECK(proves(rows[1].text) == rows[1].expected);
  CHECK(proves(rows[2].text) == rows[2].expected);
}

TEST_CASE("constants are words; T and F only where nothing else can be meant") {
  CHECK(proves("true") == "ltl: true");
  CHECK(proves("False or T") == "ltl: false or true");
  CHECK(proves("a.done => F") == "ltl: a.done => false");
  CHECK(codes("prove ltl a.done => F") == "BT1206");
  CHECK(proves("F a.done") == "ltl: <> a.done");
  CHECK(proves("t == f") == "ltl: t == f");
}

TEST_CASE("an event names a node in any of its ways") {
  const std::vector<Row> rows = {
      {"land.ticked", "land"},
      {"land@23.ticked", "land@23"},
      {"fail_mission/land.ticked", "fail_mission/land"},
      {"land_btn12.ticked", "land_btn12"},
      {"btn12.ticked", "btn12"},
      {"drone/8.ticked", "drone/8"},
      {"root.ticked", "root"},
      {"\"my node\".ticked", "my node"},
      {"\"a-b\"/\"c.d\"@7.TICKED", "a-b/c.d@7"},
      {"always.ticked", "always"},
      {"2nd_try.ticked", "2nd_try"},
      {"prüfen.ticked", "prüfen"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const Atom atom = atom_of(row.text);
    CHECK(atom.kind == AtomKind::NodeEvent);
    CHECK(atom.node == row.expected);
    CHECK(atom.word == "ticked");
    CHECK(atom.text == row.text);
  }
  for (const std::string event : {"ticked", "success", "failure", "running",
                                  "halted", "done", "active", "ended"}) {
    CHECK(atom_of("x." + event).word == event);
  }
  const Atom process = atom_of("drone/8.done");
  CHECK(process.component == "drone");
  CHECK(process.process == 8);
}

TEST_CASE("an event knows where its parts stand") {
  const Atom atom = atom_of("never  fail/land@31.success");
  CHECK(atom.span.column == 14);
  CHECK(atom.span.length == 20);
  CHECK(atom.node_span.column == 14);
  CHECK(atom.node_span.length == 12);
  CHECK(atom.word_span.column == 27);
  CHECK(atom.word_span.length == 7);
}

TEST_CASE("the paper's process paths give a state, or a scope for names") {
  const Atom state = atom_of("drone/5/state done");
  CHECK(state.kind == AtomKind::ProcessState);
  CHECK(state.component == "drone");
  CHECK(state.process == 5);
  CHECK(state.word == "done");

  const Atom value = atom_of("drone/12/value(battery=Low)");
  CHECK(value.kind == AtomKind::Comparison);
  CHECK(value.process == 12);
  CHECK(value.left.name == "battery");
  CHECK(value.right.name == "Low");
  CHECK(value.text == "drone/12/value (battery=Low)");

  const Atom status =
      atom_of("drone/16/value (btnode[ok_btn18].rstatus = failure)");
  CHECK(status.left.node == "ok_btn18");
  CHECK(status.left.name == "status");

  const Atom self = atom_of("drone/16/value (BTnode[self].rstatus = failure)");
  CHECK(self.process == 16);
  CHECK(self.left.node.empty());
  CHECK(self.left.name == "rstatus");

  CHECK(proves("absent p/3/value (a = 0 and not (b > 1 or c in 1..2))") ==
        "never: p/3/value (a = 0) and not (p/3/value (b > 1) or p/3/value (c "
        "in 1..2))");
}

TEST_CASE("a comparison has six relations and two sides") {
  const std::vector<std::pair<std::string, Relation>> relations = {
      {"=", Relation::Equal},        {"==", Relation::Equal},
      {"~=", Relation::NotEqual},    {"!=", Relation::NotEqual},
      {"≠", Relation::NotEqual},     {"<", Relation::Less},
      {"<=", Relation::LessEqual},   {">", Relation::Greater},
      {">=", Relation::GreaterEqual}};
  for (const auto& [sign, relation] : relations) {
    CHECK(atom_of("fls" + sign + "3").relation == relation);
    CHECK(atom_of("fls " + sign + " -3").right.number == Decimal{-3});
  }
  const Atom reversed = atom_of("-2147483648 < fls");
  CHECK(reversed.left.is_number);
  CHECK(reversed.left.number == Decimal{-2147483647 - 1});
  CHECK(reversed.right.name == "fls");

  const Atom status = atom_of("x.status == success");
  CHECK(status.left.node == "x");
  CHECK(status.left.name == "status");
  CHECK(status.right.node.empty());
  CHECK(status.right.name == "success");

  const Atom local = atom_of("RR.failed < 3");
  CHECK(local.left.node == "RR");
  CHECK(local.left.name == "failed");

  const Atom range = atom_of("fls in -1..3");
  CHECK(range.kind == AtomKind::Range);
  CHECK(range.left.name == "fls");
  CHECK(range.low == Decimal{-1});
  CHECK(range.high == Decimal{3});
}

TEST_CASE("tick, dead and stuck stand alone") {
  for (const std::string word : {"tick", "dead", "stuck"}) {
    const Atom atom = atom_of("never " + word);
    CHECK(atom.kind == AtomKind::Keyword);
    CHECK(atom.word == word);
  }
}

TEST_CASE("equal atoms are one atom, wherever they stand") {
  const PropertyFile file = accepted(
      "prove a.done => a.done\nprove never \"a\".Done\nprove never b.done");
  CHECK(file.atoms.size() == 2);
}

TEST_CASE("a file says its tree, its ticks and what it expects") {
  const PropertyFile file = accepted(R"(# a comment
// another   ; and a third
/* one over
   two lines */
tree "drone3.btf"
tick nodes
let critical = battery == Critical ; named

## Noticed
## and answered.
property land_on_critical:
    whenever measure_battery.done and critical then land@23.ticked within 2 ticks
property hole [safety, req=SR-12] expect violated : never critical
expect holds
property "a name - quoted" is absent (drone/35/value (fls > 3)) // 6 m
prove deadlockfree
assert hole
assert "a name - quoted" -true "yes" -false "no"
)");
  CHECK(file.file == "p.ltl");
  CHECK(file.tree == "drone3.btf");
  CHECK(file.ticks == "nodes");
  REQUIRE(file.properties.size() == 4);
  const Property& land = file.properties[0];
  CHECK(land.name == "land_on_critical");
  CHECK(land.title == "Noticed and answered.");
  CHECK(land.expectation == Expectation::None);
  CHECK(land.text ==
        "whenever measure_battery.done and critical then land@23.ticked within "
        "2 ticks");
  CHECK(meaning(file, land) ==
        "response [0,2]: measure_battery.done and battery == Critical ~> "
        "land@23.ticked");
  CHECK(land.span.line == 11);
  CHECK(land.span.column == 10);
  CHECK(land.span.length == 16);
  CHECK(file.properties[1].expectation == Expectation::Violated);
  CHECK(file.properties[1].title == "");
  CHECK(file.properties[1].tags ==
        std::vector<std::string>{"safety", "req=SR-12"});
  CHECK(file.properties[2].name == "a name - quoted");
  CHECK(file.properties[2].expectation == Expectation::Holds);
  CHECK(file.properties[3].name == "prove1");
  CHECK(file.properties[3].expectation == Expectation::None);
}

TEST_CASE("a title stands directly above its property or its expect") {
  const PropertyFile file = accepted(
      "## far\n\nprove dead\n## near\nexpect holds\nprove dead\n"
      "### a rule\nprove dead\nprove tick ## behind\nprove dead\n");
  REQUIRE(file.properties.size() == 5);
  CHECK(file.properties[0].title == "");
  CHECK(file.properties[1].title == "near");
  CHECK(file.properties[2].title == "");
  CHECK(file.properties[3].title == "");
  CHECK(file.properties[4].title == "");
}

TEST_CASE("items need no line of their own") {
  const PropertyFile file = accepted(
      "property a: never x.done property b is tick tick root prove dead");
  CHECK(file.properties.size() == 3);
  CHECK(file.ticks == "root");
}

TEST_CASE("tick at the start of a line is a condition where one is missing") {
  const PropertyFile file = accepted("prove a.done =>\n  tick\ntick leaves");
  CHECK(meaning(file, file.properties[0]) == "ltl: a.done => tick");
  CHECK(file.ticks == "leaves");
}

TEST_CASE("a let may use earlier lets") {
  const PropertyFile file = accepted(
      "let a = x.done\nlet \"b c\" = a and y.done\nprove never not \"b c\"");
  CHECK(meaning(file, file.properties[0]) == "never: not (x.done and y.done)");
}

TEST_CASE("line ends of any system and a byte order mark are blanks") {
  const PropertyFile file =
      accepted("\xEF\xBB\xBFtick root\r\nprove a.done\r\n  and b.done\r\n");
  CHECK(file.properties[0].text == "a.done and b.done");
  CHECK(file.properties[0].span.line == 2);
}

// --- the listings of the paper, character by character ----------------------

TEST_CASE("the paper's default properties read as printed") {
  const PropertyFile file = accepted(R"(// For the  Action_takeoff btnode
prove absent drone/12/state done 
prove absent drone/12/value (btnode[takeoff].rstatus=success)
prove absent drone/12/value (btnode[takeoff].rstatus=failure) 
prove absent drone/12/state halted 
// the 12 is the index of the Action_takeoff btnode process instance in all the processes 
// combined in parallel to build the drone component
)");
  REQUIRE(file.properties.size() == 4);
  CHECK(meaning(file, file.properties[0]) == "never: drone/12/state done");
  CHECK(meaning(file, file.properties[1]) ==
        "never: drone/12/value (btnode[takeoff].rstatus=success)");
  CHECK(meaning(file, file.properties[2]) ==
        "never: drone/12/value (btnode[takeoff].rstatus=failure)");
  CHECK(meaning(file, file.properties[3]) == "never: drone/12/state halted");
}

TEST_CASE("the paper's rover property reads as printed") {
  CHECK(proves("absent (mars_rover/3/state Unfolded and "
               "mars_rover/1/state Storm)") ==
        "never: mars_rover/3/state Unfolded and mars_rover/1/state Storm");
}

TEST_CASE("the paper's drone properties read as printed, with four warnings") {
  const std::string listing =
      R"(property attempt_to_land_if_battery_Critical is
ltl ([] ((drone/5/value (battery=Critical)) and (drone/5/state done)) =>
    	<> (drone/8/state tick_node)) // land_btn12

property attempt_to_go_to_charging_station_if_battery_Low is
ltl ([] ((drone/12/value (battery=Low))  and (drone/5/state done)) =>
    	<> (drone/13/state tick_node)) // goto_waypoint_btn16

property attempt_to_land_if_localization_failure is
ltl ([] ((drone/16/value (btnode[localization_ok_btn18].rstatus = failure) and (drone/16/state done))) =>
    	<> (drone/17/state tick_node)) // land_btn20

property camera_fails_implies_mission_fails is
ltl ([] (drone/21/state failure) => 	    // camera_tracking_camera_track 
    	<> (drone/39/state failure))        // BehaviorTree1_drone

property fly_not_higher_than_6m is absent (drone/35/value (fls > 3))
)";
  const PropertyFile file = accepted(listing);
  REQUIRE(file.properties.size() == 5);
  CHECK(meaning(file, file.properties[0]) ==
        "ltl: [] (drone/5/value (battery=Critical) and drone/5/state done) => "
        "<> (drone/8/state tick_node)");
  CHECK(meaning(file, file.properties[1]) ==
        "ltl: [] (drone/12/value (battery=Low) and drone/5/state done) => <> "
        "(drone/13/state tick_node)");
  CHECK(meaning(file, file.properties[2]) ==
        "ltl: [] (drone/16/value (btnode[localization_ok_btn18].rstatus = "
        "failure) and drone/16/state done) => <> (drone/17/state tick_node)");
  CHECK(meaning(file, file.properties[3]) ==
        "ltl: [] (drone/21/state failure) => <> (drone/39/state failure)");
  CHECK(meaning(file, file.properties[4]) == "never: drone/35/value (fls > 3)");
  CHECK(codes(listing) == "BT1203 BT1203 BT1203 BT1203");
}

TEST_CASE("the paper's timed drone property reads as printed") {
  const PropertyFile file =
      accepted(R"(property attempt_to_land_if_battery_Critical_timed is
((drone/5/value (battery=Critical))and (drone/5/state done)) leadsto (drone/8/state tick_node) within [0,2]
)");
  CHECK(meaning(file, file.properties[0]) ==
        "response [0,2]: drone/5/value (battery=Critical) and drone/5/state "
        "done ~> drone/8/state tick_node");
}

TEST_CASE("the paper's Recovery properties read as printed") {
  const std::string listing = R"(// Action_action		// 1 
// Action_recov			// 2
// Recovery_recovery		// 3
// BehaviorTree_bt_recovery	// 4

property failure_recov_leads_to_failure is // TRUE if the recovery action fails, than the recovery fails
(bt_recovery/2/state failure) leadsto (bt_recovery/3/state failure) within [0,0]

property failure_action_leads_to_recovery_failure is  // FALSE because retry is still 0 (not retried yet)
(bt_recovery/1/state failure and bt_recovery/3/value (retry = 0))  leadsto  (bt_recovery/3/state failure) within [0,0]

property failure_action_leads_to_recovery_failure is // TRUE because we already retied
(bt_recovery/1/state failure and bt_recovery/3/value (retry = 1))  leadsto  (bt_recovery/3/state failure) within [0,0]

property success_action_leads_to_success is // TRUE
(bt_recovery/1/state success) leadsto (bt_recovery/3/state success) within [0,0]
)";
  const PropertyFile file = accepted(listing);
  REQUIRE(file.properties.size() == 4);
  CHECK(meaning(file, file.properties[0]) ==
        "response [0,0]: bt_recovery/2/state failure ~> bt_recovery/3/state "
        "failure");
  CHECK(meaning(file, file.properties[1]) ==
        "response [0,0]: bt_recovery/1/state failure and bt_recovery/3/value "
        "(retry = 0) ~> bt_recovery/3/state failure");
  CHECK(meaning(file, file.properties[2]) ==
        "response [0,0]: bt_recovery/1/state failure and bt_recovery/3/value "
        "(retry = 1) ~> bt_recovery/3/state failure");
  CHECK(meaning(file, file.properties[3]) ==
        "response [0,0]: bt_recovery/1/state success ~> bt_recovery/3/state "
        "success");
  CHECK(file.properties[2].name ==
        "failure_action_leads_to_recovery_failure#2");
  CHECK(codes(listing) == "BT1202");
}

TEST_CASE("the paper's RoundRobin properties read as printed") {
  const PropertyFile file = accepted(R"(// Action_A1	// 1
// Action_A2	// 2
// Action_A3	// 3
// Action_A4	// 4
// RoundRobin_RR // 5

property failure_a1_leads_to_failure is // FALSE a failure of one child does not necessary leads to rr failure
(bt_roundrobin/1/state failure) leadsto (bt_roundrobin/5/state failure) within [0,1]

property failure_a4_leads_to_a1_ticked is  // TRUE a failure of a child with less than 3 failure so far leads to the next child to be ticked
((bt_roundrobin/4/state failure ) and (bt_roundrobin/5/value (failed < 3))) leadsto (bt_roundrobin/1/state tick_node) within [0,0]

property success_a2_leads_a3_ticked_exp_true is // TRUE success of a child leads to the next one to be ticked upon rr reticked
(bt_roundrobin/2/state success) leadsto (bt_roundrobin/3/state tick_node) within [0,3] // 3 because the tick has to go all the way up

property success_a2_leads_rr_success_exp_true is // TRUE
(bt_roundrobin/2/state success) leadsto (bt_roundrobin/5/state success) within [0,0]
)");
  REQUIRE(file.properties.size() == 4);
  CHECK(meaning(file, file.properties[0]) ==
        "response [0,1]: bt_roundrobin/1/state failure ~> "
        "bt_roundrobin/5/state failure");
  CHECK(meaning(file, file.properties[1]) ==
        "response [0,0]: bt_roundrobin/4/state failure and "
        "bt_roundrobin/5/value (failed < 3) ~> bt_roundrobin/1/state "
        "tick_node");
  CHECK(meaning(file, file.properties[2]) ==
        "response [0,3]: bt_roundrobin/2/state success ~> "
        "bt_roundrobin/3/state tick_node");
  CHECK(meaning(file, file.properties[3]) ==
        "response [0,0]: bt_roundrobin/2/state success ~> "
        "bt_roundrobin/5/state success");
}

TEST_CASE("every property file of the examples reads without an error") {
  const std::filesystem::path folder(BTCHECK_EXAMPLES);
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".ltl") continue;
    std::ifstream stream(entry.path());
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const PropertyFile file = accepted(text);
    CAPTURE(entry.path().filename().string());
    ++count;
    if (file.tree.empty()) continue;  // for whichever tree it is given with
    for (const Property& property : file.properties) {
      CHECK(property.expectation != Expectation::None);
      CHECK(!property.title.empty());
    }
  }
  CHECK(count >= 10);
}

}  // namespace
}  // namespace btcheck::test::property_reader_test

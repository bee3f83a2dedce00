// SPDX-License-Identifier: MIT
//
// Which entries become state variables, and what scripts mean over them.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "btcpp_text.hpp"
#include "model/btcpp/entries/meaning.hpp"

namespace btcheck::btcpp::btcpp_entries_test {
namespace {

// A tree, its world, and a state that starts with the initial values.
struct Modelled {
  ReadTree tree;
  ScriptWorld world;
  std::vector<int> state;

  explicit Modelled(const std::string& text) : tree(good_tree(text)) {
    world = script_world(tree.expansion);
    for (const auto& each : world.variables) state.push_back(each.initial);
  }

  std::size_t number(const std::string& name) const {
    for (std::size_t i = 0; i < world.variables.size(); ++i) {
      if (world.variables[i].name == name) return i;
    }
    FAIL(name << " is no variable");
    return 0;
  }

  void set(const std::string& name, const std::string& value) {
    const auto& states = world.variables[number(name)].states;
    const auto found = std::find(states.begin(), states.end(), value);
    REQUIRE(found != states.end());
    state[number(name)] = static_cast<int>(found - states.begin());
  }

  std::string get(const std::string& name) const {
    const std::size_t i = number(name);
    return world.variables[i].states[static_cast<std::size_t>(state[i])];
  }

  // "unknown 1 2 idle": the states of a variable.
  std::string states(const std::string& name) const {
    std::string all;
    for (const auto& each : world.variables[number(name)].states) {
      all += (all.empty() ? "" : " ") + each;
    }
    return all;
  }

  bool holds(const Expression& expression) const {
    const auto value = expression.evaluate([&](const Term& term) {
      return state[static_cast<std::size_t>(term.operand)];
    });
    return value != 0;
  }

  // "T", "F", "!" for an exception on the way, "?" for no truth at the end; in
  // this order, as far as they are possible.
  std::string told(const ScriptMeaning& meaning) const {
    std::string all;
    if (holds(meaning.may_hold)) all += 'T';
    if (holds(meaning.may_fail)) all += 'F';
    if (holds(meaning.may_throw)) all += '!';
    if (holds(meaning.may_be_no_truth)) all += '?';
    return all;
  }

  std::string assign(const ScriptMeaning& meaning) {
    const std::string outcome = told(meaning);
    for (const StateAssignment& each : meaning.assignments) {
      state[index(each.variable)] =
          static_cast<int>(each.value.evaluate([&](const Term& term) {
            return state[static_cast<std::size_t>(term.operand)];
          }));
    }
    return outcome;
  }

  std::string run(const std::string& script, std::uint32_t subtree = 0) {
    return assign(
        compile_script(tree.expansion, world, subtree, parse_script(script)));
  }
};

std::string script_leaf(std::string script) {
  std::string escaped;
  for (const char c : script) {
    escaped += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return "<Script code=\"" + escaped + "\"/>";
}

// One tree with these scripts.
std::string scripts(const std::vector<std::string>& all) {
  std::string leaves;
  for (const std::string& each : all) leaves += script_leaf(each);
  return tree4("<Sequence>" + leaves + "</Sequence>");
}

// Trees of which M runs.
std::string with_main(const std::string& inside) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">" + inside +
         "</root>";
}

std::string reasons(const ScriptWorld& world) {
  std::string all;
  for (const auto& [entry, reason] : world.abstracted) {
    all += entry.name + ": " + reason + "; ";
  }
  return all;
}

TEST_CASE("an entry has the values that scripts give it") {
  Modelled m(scripts({"mode := 'idle'; x := 1", "mode := 'fetch it'; x = 2.5",
                      "x := true; y := x; z := battery", "x := -3"}));
  CHECK(m.states("mode") == "unknown fetch_it idle");
  CHECK(m.states("x") == "unknown minus_3 minus_3_0 1 1_0 2_5");
  CHECK(m.states("y") == "unknown 1 1_0");  // as x is at that place
  CHECK(m.get("x") == "unknown");
  CHECK(m.world.of.size() == 3);
  CHECK(reasons(m.world) == "battery: nothing in the tree writes it; ");
}

TEST_CASE("counting goes as far as the numbers beside the entry") {
  Modelled m(scripts({"n := 0", "n += 1", "n >= 3", "m := 5", "m -= 2"}));
  CHECK(m.states("n") == "unknown any 0 1 2 3 from_4");
  CHECK(m.states("m") == "unknown any to_minus_1 1 3 5");
  m.run("n := 0");
  for (const char* now : {"1", "2", "3", "from_4", "from_4"}) {
    m.run("n += 1");
    CHECK(m.get("n") == now);
  }
  CHECK(m.run("n >= 3") == "T");
  CHECK(m.run("n == 3") == "F");
  CHECK(m.run("n != 4.5") == "TF");
  CHECK(m.run("n") == "?");
  m.run("n -= 1");
  CHECK(m.get("n") == "unknown");  // not a value that the tree gives it
  CHECK(m.run("n >= 3") == "TF!");
  m.run("m := 1");
  m.run("m -= 2");
  CHECK(m.get("m") == "to_minus_1");
  CHECK(m.run("m < 0") == "T");
  CHECK(m.run("m >= 1") == "F");
}

TEST_CASE("what takes too many values is given up, with its copies") {
  Modelled m(
      scripts({"n := 1000; k := n", "n -= 1; k := 2", "n > 0 && k > 1"}));
  CHECK(m.states("k") == "unknown any 2");
  CHECK(reasons(m.world) == "n: it takes more than 128 values; ");
  CHECK(m.run("n > 0") == "TF!");
}

TEST_CASE("operators on numbers") {
  Modelled m(
      scripts({"x := 2; y := 3; z := 0; h := 0.5; x := 1", "z := 1; z := 2"}));
  m.run("x := 2; y := 3; z := 0; h := 0.5");
  const std::map<std::string, std::string> kTold = {
      {"x + y == 5", "T"},
      {"x - y == -1", "T"},
      {"x * y == 6", "T"},
      {"y / x == 1.5", "T"},
      {"x / z == 1", "F"},
      {"x & y", "T"},
      {"(x & y) == 2", "T"},
      {"(x | 1) == 3", "T"},
      {"(x ^ y) == 1", "T"},
      {"x & h", "!"},
      {"~x == -3", "T"},
      {"-x == 0 - 2", "T"},
      {"!x", "F"},
      {"!z", "T"},
      {"!h", "F"},
      {"x", "?"},
      {"z", "F"},
      {"h", "T"},
      {"1", "T"},
      {"true", "T"},
      {"false", "F"},
      {"0x10 == 16", "T"},
      {"x == 2.00000001", "T"},
      {"x != 2.00000001", "F"},
      {"x < 2.00000001", "T"},
      {"x == 2.001", "F"},
      {"1 < x < y", "T"},
      {"1 < y < x", "F"},
      {"y > x >= 2 != 0", "T"},
      {"x <= 1", "F"},
      {"z == 0 && x == 2", "T"},
      {"z == 1 && x == 2", "F"},
      {"z == 1 || x == 2", "T"},
      {"z == 1 || x == 3", "F"},
      {"x && z", "!"},
      {"x - y", "?"},
      {"x - y || true", "!"},
      {"false && x - y", "!"},
      {"!(x - y)", "F"},
      {"x - y ? 1 : 0", "T"},
      {"y - x", "T"},
      {"h - 1 || 0", "!"},
      {"-z || z", "F"},
      {"-h", "?"},
      {"-x / z", "?"},
      {"x / z", "T"},
      {"z / z", "T"},
      {"z ? x : y == 3", "T"},
      {"x ? 0 : 1", "F"},
      {"h ? 1 : 0", "T"},
      {"x .. y", "!"},
      {"9007199254740993 > 0", "TF!"},
      {"x = 1; x == 1", "T"},
      {"(x := 1) + x == 2", "T"},
      {"x == 2 ? z := 1 : (z := 2); z", "T"}};
  for (const auto& [written, told] : kTold) {
    const std::string& script = written;
    CAPTURE(script);
    const std::vector<int> before = m.state;
    CHECK(m.run(script) == told);
    m.state = before;
  }
}

// One of an int64 at the least (convert_impl.hpp).
TEST_CASE("the ends of 64 bits") {
  Modelled m(scripts({"x := 1"}));
  m.run("x := 1");
  CHECK(m.run("~(-9223372036854775808.0) > 0") == "T");
  CHECK(m.run("~9223372036854775808.0") == "!");
  CHECK(m.run("(-9223372036854775808.0 & 1) == 0") == "T");
  CHECK(m.run("9223372036854775808.0 & 1") == "!");
}

// What may be 0 or 1 is a truth value whatever it is, unlike any number.
TEST_CASE("numbers that are known not to be negative") {
  Modelled m(scripts({"b := q > 1", "d := b", "n := b * 2 - 1"}));
  for (const std::string script : {"b := q > 1", "d := b", "n := b * 2 - 1"}) {
    m.run(script);
  }
  CHECK(m.get("b") == "from_0");
  CHECK(m.run("b") == "TF");
  CHECK(m.run("b && d") == "TF");
  CHECK(m.get("n") == "any_number");
  CHECK(m.run("n && d") == "TF!");
  CHECK(m.run("n") == "TF?");
}

TEST_CASE("operators on texts") {
  Modelled m(scripts({"s := 'idle'; t := '2'; e := ''; b := 'true'"}));
  m.run("s := 'idle'; t := '2'; e := ''; b := 'true'");
  CHECK(m.get("e") == "empty");
  const std::map<std::string, std::string> kTold = {
      {"s == 'idle'", "T"},
      {"s != 'idle'", "F"},
      {"s < 'j'", "T"},
      {"s >= 'j'", "F"},
      {"s .. t == 'idle2'", "T"},
      {"s + t == 'idle2'", "T"},
      {"s .. 1 == 'idle1'", "T"},
      {"s + 1", "!"},
      {"s - t", "!"},
      {"s && 1", "!"},
      {"!s", "!"},
      {"-t", "!"},
      {"s", "?"},
      {"t == 2", "T"},
      {"2.0 == t", "T"},
      {"t < 3 ", "T"},
      {"b == 1", "T"},
      {"b == 0", "F"},
      {"s == 1", "!"},
      {"t ? 1 : 0", "T"},
      {"s ? 1 : 0", "!"},
      {"e == ''", "T"},
      {"s += 'x'; s == 'idlex'", "TF"},
      {"s -= 'x'", "!"},
      {"s += 1", "!"},
      {"s = 'other'; s == 'other'", "TF"}};
  for (const auto& [written, told] : kTold) {
    const std::string& script = written;
    CAPTURE(script);
    const std::vector<int> before = m.state;
    CHECK(m.run(script) == told);
    m.state = before;
  }
}

TEST_CASE("what is unknown may go either way") {
  Modelled m(scripts({"x := 1; s := 'a'", "x == 1 && s == 'a'"}));
  CHECK(m.run("x == 1") == "TF!");
  CHECK(m.run("free > 20") == "TF!");
  CHECK(m.run("x == 1 && false") == "F!");
  CHECK(m.run("x == 1 || true") == "T!");
  CHECK(m.run("!(free == RED)") == "TF!");
  CHECK(m.run("x = 1") == "T");  // there may be none to change
  CHECK(m.get("x") == "1");
  CHECK(m.run("x := 1") == "T");
  CHECK(m.run("x == 1 && free") == "TF!");
  CHECK(m.run("x == 0 && free") == "F!");
  CHECK(m.run("x := free") == "TF!?");
  CHECK(m.get("x") == "unknown");
  m.run("x := 1");
  m.run("free > 2 ? x := 1 : (s := 'a')");
  CHECK(m.get("x") == "1");
  CHECK(m.get("s") == "unknown");
  m.run("x := free > 2");
  CHECK(m.get("x") == "unknown");
}

TEST_CASE("assignments see those before them") {
  Modelled m(scripts({"x := 1; y := 2; z := 0", "z := x; x := y; y := z",
                      "x == 1 ? x := y : (y := x)"}));
  m.run("x := 1; y := 2");
  CHECK(m.run("z := x; x := y; y := z; x == 2 && y == 1") == "T");
  CHECK(m.get("x") + m.get("y") + m.get("z") == "211");
  // Each needs what the other was.
  m.run("x == 1 ? x := y : (y := x)");
  CHECK(m.get("x") + m.get("y") == "from_0from_0");
  m.run("x := 1; y := 2");
  CHECK(m.run("x == 1 ? (y := 1) : (x := 1); y") == "T");
  CHECK(m.get("y") == "1");
  m.run("1 < 0 < (x := 2)");
  CHECK(m.get("x") == "1");
  m.run("0 < 1 < (x := 2)");
  CHECK(m.get("x") == "2");
}

TEST_CASE("an entry keeps the type that it was made with") {
  Modelled m(scripts({"x := 1", "x := 'a'", "y := 1"}));
  CHECK(m.states("x") == "unknown 1 a");
  CHECK(m.run("x := 1") == "T");
  CHECK(m.get("x") == "1");
  CHECK(m.run("x := 'a'") == "!");
  m.set("x", "a");
  CHECK(m.run("x := 1") == "!");
  CHECK(m.run("x := 'b'") == "?");
}

TEST_CASE("names follow the remapping, literals are first values") {
  Modelled m(with_main(
      "<BehaviorTree ID=\"M\"><Sequence>"
      "<SubTree ID=\"S\" name=\"one\" a=\"{goal}\" n=\"3\"/>"
      "<SubTree ID=\"S\" name=\"two\" _autoremap=\"true\" n=\"x y\"/>"
      "</Sequence></BehaviorTree><BehaviorTree ID=\"S\">"
      "<Script code=\"a := 1; @top := n; _own := 2\"/></BehaviorTree>"));
  std::vector<std::string> names;
  for (const auto& each : m.world.variables) names.push_back(each.name);
  CHECK(names == std::vector<std::string>{"a", "goal", "top", "one__own",
                                          "one_n", "two__own", "two_n"});
  CHECK(m.get("one_n") == "3");
  CHECK(m.get("two_n") == "x_y");
  CHECK(m.states("top") == "unknown any any_text 3 x_y");
  m.run("a := 1; @top := n", 1);
  CHECK(m.get("goal") == "1");
  CHECK(m.get("a") == "unknown");
  CHECK(m.get("top") == "3");
  m.run("a := 1; @top := n", 2);
  CHECK(m.get("a") == "1");
  CHECK(m.get("top") == "unknown");  // not a value that the tree gives it
}

TEST_CASE("literals are numbers as far as they are") {
  for (const auto& [written, state] :
       std::map<std::string, std::string>{{"3", "3"},
                                          {"-2", "minus_2"},
                                          {"2.5", "2_5"},
                                          {"1e2", "100"},
                                          {"1;2", "1_2"},
                                          {"0x10", "0x10"},
                                          {"true", "true"},
                                          {"", "empty"}}) {
    const std::string& literal = written;
    CAPTURE(literal);
    Modelled m(with_main("<BehaviorTree ID=\"M\"><SubTree ID=\"S\" n=\"" +
                         literal +
                         "\"/></BehaviorTree><BehaviorTree ID=\"S\">"
                         "<ScriptCondition code=\"n\"/></BehaviorTree>"));
    CHECK(m.get("n") == state);
  }
}

TEST_CASE("what may be written at any time is not modelled") {
  const std::string models =
      "<TreeNodesModel><Action ID=\"Grasp\"><output_port name=\"out\"/>"
      "<input_port name=\"in\"/><inout_port name=\"through\"/>"
      "<output_port name=\"sent\" default=\"{sent}\"/></Action>"
      "</TreeNodesModel>";
  const std::string reads = script_leaf(
      "a := 1; b := 1; c := 1; d := 1; sent := 1; e := 1;"
      "a && b && c && d && sent && e");
  Modelled m(with_main(
      "<BehaviorTree ID=\"M\"><Sequence>" + reads +
      "<Grasp out=\"{a}\" in=\"{b}\" through=\"{c}\"/><Odd any=\"{d}\"/>"
      "<LoopInt queue=\"1;2\" value=\"{e}\"><AlwaysSuccess/></LoopInt>"
      "</Sequence></BehaviorTree>" +
      models));
  CHECK(m.states("b") == "unknown 1");
  for (const std::string name : {"a", "c", "sent"}) {
    CHECK(m.states(name) == "unknown any 1 1_0");
  }
  CHECK(m.world.variables.size() == 4);
  CHECK(reasons(m.world) ==
        "d: the port `any` of Odd may write it; "
        "e: the port `value` of LoopInt may write it; ");
}

TEST_CASE("a port with a type may convert texts") {
  Modelled m(with_main(
      "<BehaviorTree ID=\"M\"><Sequence>" +
      script_leaf("a:='x'; b:='x'; c:=1") +
      "<Go pose=\"{a}\" name_of=\"{b}\" n=\"{c}\"/></Sequence></BehaviorTree>"
      "<TreeNodesModel><Action ID=\"Go\">"
      "<input_port name=\"pose\" type=\"Pose2D\"/>"
      "<input_port name=\"name_of\" type=\"std::string\"/>"
      "<input_port name=\"n\" type=\"int\"/></Action></TreeNodesModel>"));
  CHECK(m.states("b") == "unknown x");
  CHECK(m.states("c") == "unknown 1");
  CHECK(m.world.variables.size() == 2);
}

TEST_CASE("SetBlackboard and UnsetBlackboard") {
  Modelled m(
      tree4("<Sequence><SetBlackboard value=\"idle\" output_key=\"mode\"/>"
            "<SetBlackboard value=\"busy\" output_key=\"copy\"/>"
            "<SetBlackboard value=\"{n}\" output_key=\"k\"/>"
            "<UnsetBlackboard key=\"n\"/><Script code=\"n := 4; copy := 'a'\"/>"
            "</Sequence>"));
  const auto& nodes = m.tree.expansion.nodes;
  const auto set = [&](std::size_t node) {
    return m.assign(
        compile_set_blackboard(m.tree.expansion, m.world, nodes[node]));
  };
  const auto unset =
      compile_unset_blackboard(m.tree.expansion, m.world, nodes[4]);
  CHECK(m.states("mode") == "unknown idle");
  CHECK(m.states("n") == "unknown unset 4");
  CHECK(m.states("k") == "unknown any 4");
  CHECK(set(1) == "T");
  CHECK(m.get("mode") == "idle");
  CHECK(m.run("mode == 'idle'") == "T");
  CHECK(m.run("mode := 3") == "!");  // it is a text from now on
  // An entry that a script has made is left empty by a text.
  m.run("copy := 'a'");
  CHECK(set(2) == "T");
  CHECK(m.get("copy") == "no_value");
  CHECK(m.run("copy == 'busy'") == "!");
  CHECK(m.run("copy := 'b'") == "!");
  m.run("n := 4");
  CHECK(set(3) == "T");
  CHECK(m.get("k") == "4");
  CHECK(m.assign(unset) == "T");
  for (const char* script : {"n == 4", "n = 4", "n += 4", "free = n"}) {
    CAPTURE(script);
    m.set("n", "unset");
    CHECK(m.run(script) == "!");
  }
  m.set("n", "unset");
  CHECK(set(3) == "!");
  CHECK(m.run("n := 4") == "?");
  CHECK(m.get("n") == "4");
}

TEST_CASE("an entry that only the blackboard names could be any") {
  for (const char* leaf :
       {"<SetBlackboard value=\"1\" output_key=\"{which}\"/>",
        "<UnsetBlackboard key=\"{which}\"/>", "<Script code=\"{what}\"/>"}) {
    CAPTURE(leaf);
    Modelled m(tree4("<Sequence>" + script_leaf("a := 1; a == 1") +
                     std::string(leaf) + "</Sequence>"));
    CHECK(m.world.variables.empty());
    CHECK(m.world.abstracted.size() == 1);
  }
}

TEST_CASE("conditions write, too; version 3 has no scripts") {
  Modelled m(
      tree4("<AlwaysSuccess _onSuccess=\"a := 1\" _skipIf=\"a == 2\"/>"));
  CHECK(m.states("a") == "unknown 1");
  Modelled old(
      "<root main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\">"
      "<SetBlackboard value=\"1\" output_key=\"a\"/></BehaviorTree></root>");
  CHECK(old.states("a") == "unknown 1");
}

TEST_CASE("long and deep scripts stay within bounds") {
  std::string sum = "x := 1";
  for (int i = 0; i < 3000; ++i) sum += " + 1";
  std::string all = "x == 1";
  std::string count = "y := 0";
  for (int i = 0; i < 40; ++i) {
    all += " && (x == 1 || y == " + std::to_string(i) + ")";
    count += "; y += x == 1";
  }
  Modelled m(scripts({sum, all, count, "x := 1; y := 1"}));
  m.run("x := 1; y := 0");
  const ScriptMeaning meaning =
      compile_script(m.tree.expansion, m.world, 0, parse_script(all));
  CHECK(m.told(meaning) == "T");
  CHECK(meaning.may_hold.terms().size() < 4000);
  m.run(count);
  CHECK(m.get("x") == "1");
  CHECK(m.run(sum) == "TF!?");
  CHECK(m.get("x") == "lost");
}

}  // namespace
}  // namespace btcheck::btcpp::btcpp_entries_test

// SPDX-License-Identifier: MIT
//
// Small files that were given to BehaviorTree.CPP 4.10.0, with an action A of
// one port, `p`, an int: what it loaded is read, what it refused is refused,
// and what it threw at the first tick is found as well.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "btcpp_text.hpp"

namespace btcheck::btcpp_load_test {
namespace {

// RefusesUnregistered: what is registered only the program knows; the files
// alone give a warning.
enum class Engine {
  Runs,
  RefusesToLoad,
  RefusesUnregistered,
  ThrowsAtFirstTick
};

struct Probe {
  std::string text;
  Engine engine;
  const char* codes;  // ours
};

// What is said of the file, A being known.
std::vector<Diagnostic> said_of(const std::string& text) {
  BtcppOptions options;
  options.models = {{"m.xml",
                     "<root><TreeNodesModel><Action ID=\"A\">"
                     "<input_port name=\"p\" type=\"int\" default=\"1\"/>"
                     "</Action></TreeNodesModel></root>"}};
  return read_tree(text, {}, options).diagnostics;
}

std::string codes_alone(const std::vector<Diagnostic>& diagnostics) {
  std::string codes;
  for (const Diagnostic& found : diagnostics) {
    codes += (codes.empty() ? "" : " ") + found.code;
  }
  return codes;
}

void check_all(const std::vector<Probe>& probes) {
  for (const Probe& probe : probes) {
    CAPTURE(probe.text);
    const auto said = said_of(probe.text);
    CHECK(codes_alone(said) == probe.codes);
    const bool is_error =
        std::any_of(said.begin(), said.end(), [](const Diagnostic& each) {
          return each.severity == Severity::Error;
        });
    if (probe.engine == Engine::Runs) CHECK(!is_error);
    if (probe.engine == Engine::RefusesToLoad) CHECK(is_error);
    if (probe.engine == Engine::RefusesUnregistered) CHECK(!said.empty());
    if (probe.engine == Engine::ThrowsAtFirstTick) CHECK(!said.empty());
  }
}

TEST_CASE("ports and forms, as the engine takes them") {
  check_all(
      {{tree4("<A zz=\"3\"/>"), Engine::RefusesUnregistered, "BT1626"},
       {tree4("<A p=\"abc\"/>"), Engine::RefusesToLoad, "BT1610"},
       {tree4("<A _foo=\"abc\"/>"), Engine::Runs, "BT1653"},
       {tree4("<Action ID=\"A\"/>"), Engine::Runs, ""},
       {tree4("<A ID=\"A\"/>"), Engine::RefusesToLoad, "BT1604"},
       {tree4("<Condition ID=\"A\"/>"), Engine::Runs, "BT1623"},
       {tree4("<Control ID=\"Sequence\"><A/></Control>"), Engine::Runs, ""},
       {tree4("<Sequence _autoremap=\"1\"><A/></Sequence>"), Engine::Runs, ""},
       {tree4("<Sequence/>"), Engine::RefusesToLoad, "BT1607"},
       {tree4("<Parallel success_threshold=\"1\"><A/></Parallel>"),
        Engine::RefusesToLoad, "BT1609"},
       {tree4("<SequenceStar><A/></SequenceStar>"), Engine::RefusesUnregistered,
        "BT1621"}});
}

TEST_CASE("trees and subtrees, as the engine takes them") {
  const std::string s = "<BehaviorTree ID=\"S\"><A/></BehaviorTree>";
  const std::string m = "<BehaviorTree ID=\"M\">";
  const std::string end = "</BehaviorTree>";
  const std::string two = m + "<A/>" + end + s;
  check_all({{version4(m + "<SubTreePlus ID=\"S\"/>" + end + s),
              Engine::RefusesToLoad, "BT1608"},
             {version4(m + "<S/>" + end + s), Engine::RefusesToLoad, "BT1608"},
             {version4(two), Engine::RefusesToLoad, "BT1611"},
             {"<root main_tree_to_execute=\"S\">" + two + "</root>",
              Engine::Runs, "BT1622 BT1647"},
             {version4("<BehaviorTree><A/></BehaviorTree>"), Engine::Runs, ""},
             {version4("<BehaviorTree ID=\"My Tree\"><A/></BehaviorTree>"),
              Engine::RefusesToLoad, "BT1605"},
             {tree4("<SubTree ID=\"M\"/>"), Engine::RefusesToLoad, "BT1613"},
             {version4(m +
                       "<Sequence><SubTree ID=\"S\" name=\"n\"/>"
                       "<SubTree ID=\"S\" name=\"n\"/></Sequence>" +
                       end + s),
              Engine::RefusesToLoad, "BT1648 BT1606"},
             {tree4("<SubTree ID=\"Nope\"/>"), Engine::RefusesToLoad, "BT1612"},
             {"<root BTCPP_format=\"3\">" + m + "<A/>" + end + "</root>",
              Engine::Runs, ""}});
}

TEST_CASE("what the engine finds only when it ticks") {
  check_all(
      {{tree4("<Script code=\"x = 1\"/>"), Engine::ThrowsAtFirstTick, "BT1627"},
       {tree4("<A _skipIf=\"nope\"/>"), Engine::ThrowsAtFirstTick, "BT1627"},
       {tree4("<Script code=\"x := (false &amp;&amp; undefined_var)\"/>"),
        Engine::ThrowsAtFirstTick, "BT1627 BT1645"},
       {tree4("<Parallel success_count=\"5\"><A/></Parallel>"),
        Engine::ThrowsAtFirstTick, "BT1618"},
       {tree4("<IfThenElse><A/></IfThenElse>"), Engine::ThrowsAtFirstTick,
        "BT1607"},
       {tree4("<Switch2 variable=\"1\" case_1=\"1\" case_2=\"2\"><A/><A/>"
              "</Switch2>"),
        Engine::ThrowsAtFirstTick, "BT1607"},
       {tree4("<Timeout><A/></Timeout>"), Engine::ThrowsAtFirstTick,
        "BT1617"}});
}

TEST_CASE("scripts, as the engine takes them") {
  check_all(
      {{tree4("<Script code=\"x := 1 +\"/>"), Engine::RefusesToLoad, "BT1615"},
       {tree4("<Sequence><Script code=\"a:=1; b:='x'; c:= a..b; d := -a "
              "* 2 + 3 &amp; 1; e := a==1 ? 5 : 6\"/>"
              "<ScriptCondition code=\"1 &lt; 2 &lt; 3\"/></Sequence>"),
        Engine::Runs, "BT1645"}});
}

TEST_CASE("a child of a ReactiveSequence in either form") {
  check_all(
      {{tree4("<ReactiveSequence><Condition ID=\"A\"/></ReactiveSequence>"),
        Engine::RefusesToLoad, "BT1619 BT1623"},
       {tree4("<ReactiveSequence><A/></ReactiveSequence>"), Engine::Runs, ""},
       {tree4("<Sequence><Action ID=\"A\"/></Sequence>"), Engine::Runs, ""}});
}

// tinyxml2 is used by both: what stands in the attribute is compared.
TEST_CASE("XML that is none, as tinyxml2 reads it") {
  const auto value_of = [](const std::string& attributes) {
    const ReadTree tree = good_tree(tree4("<L " + attributes + "/>"));
    return tree.document->trees[0].nodes[0].ports[0].value;
  };
  CHECK(value_of("a='x && y'") == "x && y");
  CHECK(value_of("a=\"x < y\"") == "x < y");
  CHECK(value_of("a=\"&unknown;\"") == "&unknown;");
  CHECK(value_of("a=\"l1\nl2\"") == "l1\nl2");
  CHECK(value_of("a=\"&lt;&amp;&#65;\"") == "<&A");
  CHECK(value_of("b=\"1\"a=\"2\"") == "1");
  CHECK(codes_in(tree4("text & more <L/>")) == "");
  CHECK(codes_in("<!-- -- -->" + tree4("<L/>")) == "");
  CHECK(codes_in(tree4("<L/>") + "<r2/>") == "BT1625");
  for (const char* flaw : {"a=\"1\" a=\"2\"", "a=1", "a=\"x\" b"}) {
    CAPTURE(flaw);
    CHECK(codes_in(tree4("<L " + std::string(flaw) + "/>")) == "BT1600");
  }
}

}  // namespace
}  // namespace btcheck::btcpp_load_test

// SPDX-License-Identifier: MIT
#include "model/foreign_format.hpp"

#include <doctest/doctest.h>

#include <string>

namespace btcheck::foreign_format_test {
namespace {

// What the file is called, "" where it may be a tree.
std::string named(const std::string& name, std::string_view text) {
  const auto found = refusal_of_foreign(name, text);
  if (!found) return {};
  CHECK(found->code == "BT1652");
  CHECK(!found->help.empty());
  return found->message.substr(name.size() + 3);
}

}  // namespace

TEST_CASE("formats are known by what stands in the file") {
  const std::string b3 =
      R"({"title": "T", "root": "1", "nodes": {"1": {"name": "Sequence"}}})";
  for (const std::string name : {"a.json", "a.b3", "a.btf", "/dev/stdin"}) {
    CAPTURE(name);
    CHECK(named(name, b3) == "is a tree of behavior3 in JSON");
  }
  CHECK(named("a.txt", "\xEF\xBB\xBF [\n {\"a\": 1}]") == "is JSON");
  CHECK(named("a", "{}") == "is JSON");
  CHECK(named("a.xml", "{\"a\": 1}") == "is JSON");
  CHECK(named("a", "[gd_scene format=3]\n") ==
        "is a scene or resource of Godot");
  CHECK(named("a", "#!/usr/bin/env python3\n") == "is a Python program");
  const std::string behaverify = "is a tree of BehaVerify";
  CHECK(named("a.tree", "configuration {}\nvariables {}\n") == behaverify);
  CHECK(named("a.tree", "constants\n{ x := 1 }") == behaverify);
  CHECK(named("a.tree", "#{ of ours }# variables { }") == behaverify);
  CHECK(named("a.tree", "#comment# c #end_comment#\nconstants { }") ==
        behaverify);
}

TEST_CASE("SCXML is no tree, and XML has a name that says so") {
  const std::string scxml =
      "<?xml version=\"1.0\"?>\n<!-- <root> -->\n<scxml initial=\"a\"/>";
  CHECK(named("a.xml", scxml) == "is SCXML, a state machine");
  CHECK(named("a.scxml", scxml) == "is SCXML, a state machine");
  CHECK(named("a.txt", "<root BTCPP_format=\"4\"/>") ==
        "is XML, and its name does not say so");
  CHECK(named("a.xml", "<root BTCPP_format=\"4\"/>").empty());
  CHECK(named("a.xml", "<robot name=\"r\"/>").empty());  // BT1601
  CHECK(named("a.xml", "<!-- scxml").empty());
  CHECK(named("a.btproj", "<root/>").empty());
}

TEST_CASE("formats are known by the name where nothing else tells") {
  CHECK(named("a.py", "import py_trees\n") == "is a Python program");
  CHECK(named("a.yaml", "tree: a\n") == "is YAML");
  CHECK(named("a.yml", "") == "is YAML");
  CHECK(named("a.json", "") == "is JSON");
  CHECK(named("a.tscn", "; a comment").empty());
  CHECK(named("a.tres", "x") == "is a scene or resource of Godot");
}

TEST_CASE("what may be a tree is read as one") {
  const std::string tree = "; a drone\n(BehaviorTree :name t (Action :ID a))";
  for (const std::string name : {"a.btf", "a.tree", "a.py", "a", "a.json"}) {
    CAPTURE(name);
    CHECK(named(name, tree).empty());
    CHECK(named(name, "\n\n(BehaviorTree").empty());
  }
  CHECK(named("a.btf", "").empty());
  CHECK(named("a.btf", "[2,5]").empty());
  CHECK(named("a.btf", "{x").empty());
  CHECK(named("a.tree", "other { }").empty());
  CHECK(named("a.txt", "variables").empty());
}

}  // namespace btcheck::foreign_format_test

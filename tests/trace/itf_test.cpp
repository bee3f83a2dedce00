// SPDX-License-Identifier: MIT
//
// The machine's copy of a run is JSON of the promised shape.
#include "trace/itf.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "trace/told.hpp"

namespace btcheck {
namespace {

using nlohmann::json;

constexpr std::string_view kTree =
    "(defsv battery :states (Good Low)) (defsv level :max 3)\n"
    "(BehaviorTree :name t (Sequence :name s\n"
    "  (SetSV :ID measure :sv battery) (Eval (:= level 2)) (Action :ID a)))";

json told(const Lowered& model, const Run& run) {
  return json::parse(itf_text(model.tree, model.network, run,
                              {"p \"quoted\"", "[] (a => <> b)", "VIOLATED"}));
}

TEST_CASE("the document has what the format asks for") {
  const Lowered model(kTree);
  const Run run = scripted(model, {"measure: battery := Low", "a -> running"});
  const json document = told(model, run);
  CHECK(document["#meta"]["format"] == "ITF");
  CHECK(document["#meta"]["tool"] == "btcheck");
  CHECK(document["#meta"]["tree"] == "t.btf");
  CHECK(document["#meta"]["ticks"] == "root");
  CHECK(document["#meta"]["property"] == "p \"quoted\"");
  CHECK(document["#meta"]["formula"] == "[] (a => <> b)");
  CHECK(document["#meta"]["verdict"] == "VIOLATED");
  CHECK(document["vars"] == json::parse(R"(["time", "step", "chosen",
    "status", "location", "variables"])"));
  CHECK(document["states"].size() == run.state_count());
  CHECK(!document.contains("loop"));
}

TEST_CASE("every state has every variable, and its index") {
  const Lowered model(kTree);
  const Run run = scripted(model, {"measure: battery := Low", "a -> running"});
  const json document = told(model, run);
  for (std::size_t i = 0; i < run.state_count(); ++i) {
    const json& state = document["states"][i];
    for (const json& name : document["vars"]) {
      CHECK(state.contains(name.get<std::string>()));
    }
    CHECK(state.size() == document["vars"].size() + 1);
    CHECK(state["#meta"]["index"] == i);
    CHECK(state["status"].size() == model.tree.nodes.size());
    CHECK(state["location"].size() == model.tree.nodes.size());
    CHECK(state["variables"].size() == 2);
  }
}

TEST_CASE("states say what is so, and what led to them") {
  const Lowered model(kTree);
  const Run run = scripted(model, {"measure: battery := Low", "a -> running"});
  const json states = told(model, run)["states"];
  CHECK(states[0]["time"] == 0);
  CHECK(states[0]["step"] == "start");
  CHECK(states[0]["chosen"] == false);
  CHECK(states[0]["location"]["t_btn0"] == "start_");
  CHECK(states[0]["status"]["a_btn4"] == "no_ret_status");
  CHECK(states[0]["variables"]["battery"] == "Good");
  CHECK(states[0]["variables"]["level"] == 0);
  const json& last = states.back();
  CHECK(last["time"] == 1);
  CHECK(last["step"] == "a_btn4: tick_node -> running");
  CHECK(last["chosen"] == true);
  CHECK(last["location"]["a_btn4"] == "running");
  CHECK(last["status"]["measure_btn2"] == "success");
  CHECK(last["variables"]["battery"] == "Low");
  CHECK(last["variables"]["level"] == 2);
}

TEST_CASE("the table of nodes names each by the key that states use") {
  const Lowered model(kTree);
  const Run run = scripted(model, {"measure: battery := Low"});
  const json document = told(model, run);
  const json& nodes = document["#meta"]["nodes"];
  REQUIRE(nodes.size() == 5);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    CHECK(nodes[n]["id"] == n);
    CHECK(document["states"][0]["status"].contains(
        nodes[n]["key"].get<std::string>()));
    CHECK(nodes[n].contains("parent") == (n != 0));
  }
  CHECK(nodes[0]["type"] == "BehaviorTree");
  CHECK(nodes[2]["key"] == "measure_btn2");
  CHECK(nodes[2]["name"] == "measure");
  CHECK(nodes[2]["type"] == "SetSV");
  CHECK(nodes[2]["parent"] == 1);
  CHECK(nodes[2]["line"] == 3);
  CHECK(nodes[2]["column"] == 4);
}

TEST_CASE("an infinite run has its loop, and the last state returns to it") {
  const Lowered model(kTree);
  Run run = scripted(model, {"measure: battery := Low", "a -> running",
                             "a -> running", "a -> running"});
  close_loop(run);
  const json document = told(model, run);
  REQUIRE(document.contains("loop"));
  CHECK(document["loop"] == run.loop);
  CHECK(document["states"].size() == run.steps.size());
  CHECK(document["states"].back()["#meta"].contains("back"));
  const json& first = document["states"][run.loop];
  CHECK(first["#meta"]["index"] == run.loop);
}

TEST_CASE("time counts the units that have passed") {
  const Lowered model(kTree, TickSemantics::Nodes);
  const Run run = scripted(model, {"measure: battery := Low", "a -> success"});
  const json states = told(model, run)["states"];
  int time = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const int next = states[i]["time"];
    CHECK(next == time + run.steps[i - 1].step.elapsed);
    time = next;
  }
  CHECK(time == 5);
}

TEST_CASE("names beyond ASCII stay as they are") {
  const Lowered model("(BehaviorTree :name t (Action :ID a :name höhe))");
  const Run run = scripted(model, {"höhe -> success"});
  const std::string text =
      itf_text(model.tree, model.network, run, {"größe", "", "HOLDS"});
  CHECK(text.find("größe") != std::string::npos);
  CHECK(json::parse(text)["#meta"]["nodes"][1]["name"] == "höhe");
  CHECK(text.ends_with("}\n"));
}

}  // namespace
}  // namespace btcheck

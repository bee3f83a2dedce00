// SPDX-License-Identifier: MIT
//
// The machine's copy of a run is JSON of the promised shape.
#include "trace/run/itf.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "trace/example_runs.hpp"
#include "trace/run/record.hpp"
#include "trace/told.hpp"

namespace btcheck::itf_test {
namespace {

using nlohmann::json;

constexpr std::string_view kTree =
    "(defsv battery :states (Good Low)) (defsv level :max 3)\n"
    "(BehaviorTree :name t (Sequence :name s\n"
    "  (SetSV :ID measure :sv battery) (Eval (:= level 2)) (Action :ID a)))";

json told(const Lowered& model, const Run& run) {
  return json::parse(
      itf_text(recorded(model.tree, model.network, run,
                        {{"p \"quoted\"", "[] (a => <> b)", "VIOLATED"}})));
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
  CHECK(document["vars"] ==
        json::parse(R"(["time", "tick", "step", "event", "chosen", "status",
                        "location", "phase", "variables", "atoms"])"));
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
  const std::string text = itf_text(
      recorded(model.tree, model.network, run, {{"größe", "", "HOLDS"}}));
  CHECK(text.find("größe") != std::string::npos);
  CHECK(json::parse(text)["#meta"]["nodes"][1]["name"] == "höhe");
  CHECK(text.ends_with("}\n"));
}

// A run with a loop, atoms, a trigger and an end.
RecordedRun full_run(const Lowered& model) {
  Run run = scripted(model, {"measure: battery := Low", "a -> running",
                             "a -> running", "a -> running"});
  close_loop(run);
  std::vector<bool> truth(run.state_count());
  for (std::size_t i = 0; i < truth.size(); ++i) truth[i] = i % 3 == 0;
  RunHeading heading{{"p", "[] (a => <> b)", "VIOLATED"}};
  heading.why = "because";
  heading.source = "(defsv …)\n\t\"<&>\"";
  heading.watched = {{"a", truth}, {"b", std::vector<bool>(truth.size())}};
  heading.trigger = 3;
  heading.trigger_words = "asked here";
  heading.end_words = "the end";
  heading.lost = 5;
  return recorded(model.tree, model.network, run, heading);
}

TEST_CASE("what is written is read back") {
  const Lowered model(kTree);
  const RecordedRun run = full_run(model);
  REQUIRE(run.loop != kNoState);
  const auto read = read_itf("t.itf.json", itf_text(run));
  REQUIRE(read.diagnostics.empty());
  REQUIRE(read.value);
  CHECK(*read.value == run);
}

TEST_CASE("every run of the examples is read back") {
  for (const RecordedRun& run : example_runs()) {
    CAPTURE(run.tree);
    CAPTURE(run.property);
    const auto read = read_itf("t.itf.json", itf_text(run));
    REQUIRE(read.value);
    CHECK(*read.value == run);
  }
}

TEST_CASE("a text that is no trace is refused with the reason") {
  const Lowered model(kTree);
  const std::string text = itf_text(full_run(model));
  const auto refusal = [](const std::string& input) {
    const auto read = read_itf("t.itf.json", input);
    REQUIRE(!read.value);
    REQUIRE(read.diagnostics.size() == 1);
    CHECK(read.diagnostics[0].code == "BT1301");
    CHECK(read.diagnostics[0].file == "t.itf.json");
    return read.diagnostics[0];
  };
  const Diagnostic broken = refusal("{\n  \"vars\": [,]}");
  CHECK(broken.span.line == 2);
  CHECK(broken.span.column == 12);
  CHECK(refusal("{}").message.find("#meta") != std::string::npos);
  CHECK(refusal("[1, 2]").message.find("no trace") != std::string::npos);
  CHECK(refusal(R"({"#meta": {"tool": "quint"}, "states": []})")
            .message.find("another tool") != std::string::npos);
  const auto changed = [&](std::string from, const std::string& to) {
    std::string other = text;
    const std::size_t at = other.find(from);
    REQUIRE(at != std::string::npos);
    return refusal(other.replace(at, from.size(), to)).message;
  };
  CHECK(changed("\"phase\":{\"t_btn0\":\"unvisited\"",
                "\"phase\":{\"t_btn0\":\"elsewhere\"")
            .find("`elsewhere`") != std::string::npos);
  CHECK(changed("\"parent\":0", "\"parent\":9").find("parent") !=
        std::string::npos);
  CHECK(changed("\"parent\":1", "\"parent\":0").find("more than one root") !=
        std::string::npos);
  CHECK(changed("\"lost\":5", "\"lost\":99999").find("`lost`") !=
        std::string::npos);
  // Cut anywhere it is refused, and never taken for a shorter run.
  for (std::size_t size = 0; size + 2 < text.size(); size += 97) {
    refusal(text.substr(0, size));
  }
}

}  // namespace
}  // namespace btcheck::itf_test

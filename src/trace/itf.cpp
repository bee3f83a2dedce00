// SPDX-License-Identifier: MIT
//
// One JSON value per state, built from the replayed run: every other format a
// viewer may want can be made from this one without the tree at hand.
#include "trace/itf.hpp"

#include <nlohmann/json.hpp>

#include "trace/event.hpp"

namespace btcheck {
namespace {

// Keys keep the order in which they are written.
using Json = nlohmann::ordered_json;

Json node_table(const BehaviorTree& tree) {
  Json nodes = Json::array();
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    Json entry = {{"id", n},
                  {"key", unique_name(tree, NodeId{n})},
                  {"type", type_name(node.type)},
                  {"name", node.name},
                  {"line", node.span.line},
                  {"column", node.span.column}};
    if (!node.is_root()) entry["parent"] = index(node.parent);
    nodes.push_back(std::move(entry));
  }
  return nodes;
}

Json state_value(const BehaviorTree& tree, const Network& network,
                 const Valuation& state) {
  Json status = Json::object();
  Json location = Json::object();
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const std::string key = unique_name(tree, NodeId{n});
    const Automaton& automaton = network.automaton(network.node_automaton[n]);
    status[key] = kStatusNames[state.variables[index(network.node_status[n])]];
    location[key] =
        automaton.locations[state.variables[index(automaton.location)]];
  }
  Json variables = Json::object();
  for (std::size_t v = 0; v < tree.variables.size(); ++v) {
    const StateVariable& variable = tree.variables[v];
    const int value = state.variables[index(network.state_variable[v])];
    if (variable.is_enumeration()) {
      variables[variable.name] = variable.value_name(value);
    } else {
      variables[variable.name] = value;
    }
  }
  return {{"status", std::move(status)},
          {"location", std::move(location)},
          {"variables", std::move(variables)}};
}

// State number i of the run with what led to it.
Json numbered_state(const BehaviorTree& tree, const Network& network,
                    const Run& run, std::size_t i, int time) {
  Json state = {{"#meta", {{"index", i}}}, {"time", time}};
  state["step"] = i == 0 ? "start" : step_text(network, run.steps[i - 1]);
  state["chosen"] = false;
  if (i > 0) {
    const auto event =
        event_of(tree, network, run.state(i - 1), run.steps[i - 1]);
    state["chosen"] = event && event->is_chosen;
  }
  if (run.loop != kNoLoop && i + 1 == run.steps.size()) {
    state["#meta"]["back"] = step_text(network, run.steps.back());
  }
  state.update(state_value(tree, network, run.state(i)));
  return state;
}

// Bytes of a file's name that are no UTF-8 are replaced.
std::string dumped(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string itf_text(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading) {
  Json document;
  document["#meta"] = {{"format", "ITF"},
                       {"format-description",
                        "https://apalache-mc.org/docs/adr/015adr-trace.html"},
                       {"tool", "btcheck"},
                       {"tree", tree.file},
                       {"ticks", tick_name(network.ticks)},
                       {"property", heading.property},
                       {"formula", heading.formula},
                       {"verdict", heading.verdict},
                       {"nodes", node_table(tree)}};
  document["params"] = Json::array();
  document["vars"] = {"time",   "step",     "chosen",
                      "status", "location", "variables"};
  if (run.loop != kNoLoop) document["loop"] = run.loop;
  std::string text = dumped(document);
  text.back() = ',';  // the states follow, one to a line
  text += "\n\"states\":[";
  int time = 0;
  // Where the loop closes, the run has the state it returns to once more; the
  // format has not.
  const std::size_t told = run.state_count() - (run.loop == kNoLoop ? 0 : 1);
  for (std::size_t i = 0; i < told; ++i) {
    if (i > 0) time += run.steps[i - 1].step.elapsed;
    text += i > 0 ? ",\n" : "\n";
    text += dumped(numbered_state(tree, network, run, i, time));
  }
  return text + "\n]}\n";
}

}  // namespace btcheck

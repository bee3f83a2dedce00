// SPDX-License-Identifier: MIT
//
// One JSON value per state, one to a line: every other format a viewer may want
// can be made from this one without the tree at hand.
#include "trace/run/itf.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace btcheck {
namespace {

// Keys keep the order in which they are written.
using Json = nlohmann::ordered_json;

constexpr const char* kVariables[] = {
    "time",   "tick",     "step",  "event",     "chosen",
    "status", "location", "phase", "variables", "atoms"};

Json node_table(const RecordedRun& run) {
  Json nodes = Json::array();
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const RecordedNode& node = run.nodes[n];
    Json entry = {{"id", n},           {"key", node.key},
                  {"type", node.type}, {"name", node.name},
                  {"line", node.line}, {"column", node.column}};
    if (!node.file.empty()) entry["file"] = node.file;
    if (node.parent) entry["parent"] = *node.parent;
    nodes.push_back(std::move(entry));
  }
  return nodes;
}

// A number where the variable is one.
Json variable_values(const RecordedRun& run, const RecordedState& state) {
  Json variables = Json::object();
  for (std::size_t v = 0; v < run.variables.size(); ++v) {
    if (run.is_number[v]) {
      variables[run.variables[v]] = std::stoi(state.values[v]);
    } else {
      variables[run.variables[v]] = state.values[v];
    }
  }
  return variables;
}

Json state_value(const RecordedRun& run, std::size_t i) {
  const RecordedState& state = run.states[i];
  Json about = {{"index", i}};
  if (state.mover) about["mover"] = run.nodes[*state.mover].key;
  Json stale = Json::array();
  Json status = Json::object();
  Json location = Json::object();
  Json phase = Json::object();
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const std::string& key = run.nodes[n].key;
    status[key] = state.statuses[n];
    location[key] = state.locations[n];
    phase[key] = kPhaseNames[static_cast<std::size_t>(state.phases[n])];
    if (state.is_stale[n]) stale.push_back(key);
  }
  about["stale"] = std::move(stale);
  if (run.loop != kNoState && i + 1 == run.states.size()) {
    about["back"] = {{"step", run.back},
                     {"event", run.back_event},
                     {"chosen", run.back_is_chosen},
                     {"elapsed", run.back_elapsed}};
  }
  Json atoms = Json::array();
  for (const bool atom : state.atoms) atoms.push_back(atom);
  return {
      {"#meta", std::move(about)},   {"time", state.time},
      {"tick", state.tick},          {"step", state.step},
      {"event", state.event},        {"chosen", state.is_chosen},
      {"status", std::move(status)}, {"location", std::move(location)},
      {"phase", std::move(phase)},   {"variables", variable_values(run, state)},
      {"atoms", std::move(atoms)}};
}

// Bytes of a file's name that are no UTF-8 are replaced.
std::string dumped(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// What the text is not, told where it is read.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A text that every state has for each node, by its key.
std::string word_of(const Json& state, const char* record,
                    const std::string& key) {
  return state.at(record).at(key).get<std::string>();
}

Phase phase_named(const std::string& word) {
  for (std::size_t p = 0; p < kPhaseNames.size(); ++p) {
    if (kPhaseNames[p] == word) return static_cast<Phase>(p);
  }
  throw Refusal("`" + word + "` is no phase of a node");
}

std::vector<RecordedNode> nodes_from(const Json& table) {
  std::vector<RecordedNode> nodes;
  for (const Json& entry : table) {
    RecordedNode node;
    node.key = entry.at("key").get<std::string>();
    node.type = entry.at("type").get<std::string>();
    node.name = entry.at("name").get<std::string>();
    node.file = entry.value("file", "");
    node.line = entry.at("line").get<std::uint32_t>();
    node.column = entry.at("column").get<std::uint32_t>();
    if (entry.contains("parent")) {
      node.parent = entry["parent"].get<std::uint32_t>();
      if (*node.parent >= nodes.size()) {
        throw Refusal("the parent of `" + node.key +
                      "` does not come before it");
      }
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

// The number of a node among all.
std::uint32_t number_of(const RecordedRun& run, const std::string& key) {
  for (std::uint32_t n = 0; n < run.nodes.size(); ++n) {
    if (run.nodes[n].key == key) return n;
  }
  throw Refusal("no node is called `" + key + "`");
}

RecordedState state_from(const Json& value, const RecordedRun& run) {
  RecordedState state;
  state.time = value.at("time").get<int>();
  state.tick = value.at("tick").get<int>();
  state.step = value.at("step").get<std::string>();
  state.event = value.at("event").get<std::string>();
  state.is_chosen = value.at("chosen").get<bool>();
  const Json& about = value.at("#meta");
  if (about.contains("mover")) {
    state.mover = number_of(run, about["mover"].get<std::string>());
  }
  state.is_stale.resize(run.nodes.size());
  for (const Json& key : about.at("stale")) {
    state.is_stale[number_of(run, key.get<std::string>())] = true;
  }
  for (const RecordedNode& node : run.nodes) {
    state.statuses.push_back(word_of(value, "status", node.key));
    state.locations.push_back(word_of(value, "location", node.key));
    state.phases.push_back(phase_named(word_of(value, "phase", node.key)));
  }
  for (std::size_t v = 0; v < run.variables.size(); ++v) {
    const Json& found = value.at("variables").at(run.variables[v]);
    state.values.push_back(run.is_number[v] ? std::to_string(found.get<int>())
                                            : found.get<std::string>());
  }
  for (const Json& atom : value.at("atoms")) {
    state.atoms.push_back(atom.get<bool>());
  }
  if (state.atoms.size() != run.atoms.size()) {
    throw Refusal("a state has other atoms than the run");
  }
  return state;
}

std::size_t state_number(const Json& of, const char* name, std::size_t count) {
  if (!of.contains(name)) return kNoState;
  const auto number = of[name].get<std::size_t>();
  if (number < count) return number;
  throw Refusal(std::string("`") + name + "` is the number of no state");
}

RecordedRun run_from(const Json& document) {
  const Json& about = document.at("#meta");
  if (about.value("tool", "") != "btcheck" || !about.contains("nodes")) {
    throw Refusal("a trace of another tool");
  }
  RecordedRun run;
  run.tree = about.at("tree").get<std::string>();
  run.source = about.at("source").get<std::string>();
  run.ticks = about.at("ticks").get<std::string>();
  run.property = about.at("property").get<std::string>();
  run.formula = about.at("formula").get<std::string>();
  run.verdict = about.at("verdict").get<std::string>();
  run.why = about.at("why").get<std::string>();
  run.atoms = about.at("atoms").get<std::vector<std::string>>();
  run.nodes = nodes_from(about.at("nodes"));
  const Json& states = document.at("states");
  if (states.empty()) throw Refusal("a run without a state");
  for (const auto& [name, value] : states[0].at("variables").items()) {
    run.variables.push_back(name);
    run.is_number.push_back(value.is_number());
  }
  for (const Json& state : states) run.states.push_back(state_from(state, run));
  run.loop = state_number(document, "loop", run.states.size());
  if (run.loop != kNoState) {
    const Json& back = states.back().at("#meta").at("back");
    run.back = back.at("step").get<std::string>();
    run.back_event = back.at("event").get<std::string>();
    run.back_is_chosen = back.at("chosen").get<bool>();
    run.back_elapsed = back.at("elapsed").get<int>();
  }
  run.lost = state_number(about, "lost", run.states.size());
  run.trigger = state_number(about, "trigger", run.states.size());
  run.trigger_words = about.at("trigger_words").get<std::string>();
  run.end_words = about.at("end_words").get<std::string>();
  return run;
}

}  // namespace

std::string itf_text(const RecordedRun& run) {
  Json document;
  Json& about = document["#meta"];
  about = {{"format", "ITF"},
           {"format-description",
            "https://apalache-mc.org/docs/adr/015adr-trace.html"},
           {"tool", "btcheck"},
           {"tree", run.tree},
           {"ticks", run.ticks},
           {"property", run.property},
           {"formula", run.formula},
           {"verdict", run.verdict},
           {"why", run.why},
           {"atoms", run.atoms},
           {"source", run.source},
           {"nodes", node_table(run)}};
  if (run.lost != kNoState) about["lost"] = run.lost;
  if (run.trigger != kNoState) about["trigger"] = run.trigger;
  about["trigger_words"] = run.trigger_words;
  about["end_words"] = run.end_words;
  document["params"] = Json::array();
  document["vars"] = kVariables;
  if (run.loop != kNoState) document["loop"] = run.loop;
  std::string text = dumped(document);
  text.back() = ',';  // the states follow, one to a line
  text += "\n\"states\":[";
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    text += i > 0 ? ",\n" : "\n";
    text += dumped(state_value(run, i));
  }
  return text + "\n]}\n";
}

Result<RecordedRun> read_itf(std::string_view name, std::string_view text) {
  const SourceText source(name, text);
  const auto refused = [&](SourceSpan span, const std::string& message) {
    return Result<RecordedRun>{
        std::nullopt,
        {source.diagnostic(Severity::Error, "BT1301", span, message, {},
                           "write traces with btcheck --trace-dir")}};
  };
  try {
    return {run_from(Json::parse(text)), {}};
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    return refused(source.span(at > 0 ? at - 1 : 0, at), "this is no JSON");
  } catch (const Json::exception& error) {
    // After the library's own number: "[json.exception.out_of_range.403] ".
    const std::string_view what(error.what());
    return refused({}, fmt::format("no trace of btcheck: {}",
                                   what.substr(what.find("] ") + 2)));
  } catch (const Refusal& refusal) {
    return refused({}, std::string("no trace of btcheck: ") + refusal.what());
  }
}

}  // namespace btcheck

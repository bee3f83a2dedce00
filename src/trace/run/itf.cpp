// SPDX-License-Identifier: MIT
//
// One JSON value per state, one to a line: every other format a viewer may want
// can be made from this one without the tree at hand.
#include "trace/run/itf.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "text/budget.hpp"
#include "text/choice.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kVariables[] = {
    "time",   "tick",     "step",  "event",     "chosen",
    "status", "location", "phase", "variables", "atoms"};

Json node_table(const RecordedRun& run) {
  Json nodes = Json::array();
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const RecordedNode& node = run.nodes[n];
    Json entry{{"id", n},           {"key", node.key},
               {"type", node.type}, {"name", node.name},
               {"line", node.line}, {"column", node.column}};
    if (!node.file.empty()) entry.add("file", node.file);
    if (node.parent) entry.add("parent", *node.parent);
    nodes.push(entry);
  }
  return nodes;
}

Json state_value(const RecordedRun& run, std::size_t i) {
  const RecordedState& state = run.states[i];
  Json stale = Json::array();
  Json status = Json::object();
  Json location = Json::object();
  Json phase = Json::object();
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const std::string& key = run.nodes[n].key;
    status.add(key, state.statuses[n]);
    location.add(key, state.locations[n]);
    phase.add(key, phase_name(state.phases[n]));
    if (state.is_stale[n]) stale.push(key);
  }
  Json about{{"index", i}};
  if (state.mover) about.add("mover", run.nodes[*state.mover].key);
  about.add("stale", stale);
  if (run.loop != kNoState && i + 1 == run.states.size()) {
    about.add("back", step_back(run));
  }
  Json variables = Json::object();
  for (std::size_t v = 0; v < run.variables.size(); ++v) {
    variables.add(run.variables[v], value_of(run, state, v));
  }
  return {{"#meta", about},
          {"time", state.time},
          {"tick", state.tick},
          {"step", state.step},
          {"event", state.event},
          {"chosen", state.is_chosen},
          {"status", status},
          {"location", location},
          {"phase", phase},
          {"variables", variables},
          {"atoms", Json::array(state.atoms)}};
}

// What is read; members keep their order.
using OrderedJson = nlohmann::ordered_json;

// Why the text is no run of ours.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

Phase phase_named(const std::string& word) {
  const auto place = std::ranges::find(kPhaseNames, word) - kPhaseNames.begin();
  if (place < std::ssize(kPhaseNames)) return static_cast<Phase>(place);
  throw Refusal("`" + word + "` is no phase of a node");
}

std::vector<RecordedNode> nodes_from(const OrderedJson& table) {
  std::vector<RecordedNode> nodes;
  std::set<std::uint32_t> parents;  // the trees that have their root
  for (const OrderedJson& entry : table) {
    RecordedNode node;
    entry.at("key").get_to(node.key);
    entry.at("type").get_to(node.type);
    entry.at("name").get_to(node.name);
    node.file = entry.value("file", "");
    entry.at("line").get_to(node.line);
    entry.at("column").get_to(node.column);
    if (entry.contains("parent")) {
      node.parent = entry["parent"].get<std::uint32_t>();
      if (*node.parent >= nodes.size()) {
        throw Refusal("the parent of `" + node.key +
                      "` does not come before it");
      }
      const RecordedNode& above = nodes[*node.parent];
      const bool is_tree =
          above.type == "BehaviorTree" || above.type == "SubTree";
      if (is_tree && !parents.insert(*node.parent).second) {
        throw Refusal("the tree `" + above.name + "` has more than one root");
      }
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

// The number of a node among all.
std::uint32_t number_of(const RecordedRun& run, const std::string& key) {
  const auto node = std::ranges::find(run.nodes, key, &RecordedNode::key);
  if (node == run.nodes.end()) throw Refusal("no node is called `" + key + "`");
  return static_cast<std::uint32_t>(node - run.nodes.begin());
}

void read_step(const OrderedJson& from, RecordedStep& step) {
  from.at("step").get_to(step.step);
  from.at("event").get_to(step.event);
  from.at("chosen").get_to(step.is_chosen);
}

// As it was written: of ten digits at most, which a double keeps.
std::string number_text(const OrderedJson& number) {
  if (!number.is_number_float()) {
    return std::to_string(number.get<std::int64_t>());
  }
  std::string text = fmt::format("{:.9f}", number.get<double>());
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

RecordedState state_from(const OrderedJson& value, const RecordedRun& run) {
  RecordedState state;
  value.at("time").get_to(state.time);
  value.at("tick").get_to(state.tick);
  read_step(value, state);
  const OrderedJson& about = value.at("#meta");
  if (about.contains("mover")) {
    state.mover = number_of(run, about["mover"].get<std::string>());
  }
  state.is_stale.resize(run.nodes.size());
  for (const OrderedJson& key : about.at("stale")) {
    state.is_stale[number_of(run, key.get<std::string>())] = true;
  }
  for (const RecordedNode& node : run.nodes) {
    const auto word = [&](const char* record) {
      return value.at(record).at(node.key).get<std::string>();
    };
    state.statuses.push_back(word("status"));
    state.locations.push_back(word("location"));
    state.phases.push_back(phase_named(word("phase")));
  }
  for (std::size_t v = 0; v < run.variables.size(); ++v) {
    const OrderedJson& found = value.at("variables").at(run.variables[v]);
    state.values.push_back(run.is_number[v] ? number_text(found)
                                            : found.get<std::string>());
  }
  value.at("atoms").get_to(state.atoms);
  if (state.atoms.size() != run.atoms.size()) {
    throw Refusal("a state has other atoms than the run");
  }
  return state;
}

std::size_t state_number(const OrderedJson& of, const char* name,
                         std::size_t count) {
  if (!of.contains(name)) return kNoState;
  const auto number = of[name].get<std::size_t>();
  if (number < count) return number;
  throw Refusal(std::string("`") + name + "` is the number of no state");
}

RecordedRun run_from(const OrderedJson& document) {
  const OrderedJson& about = document.at("#meta");
  if (about.value("tool", "") != "btcheck" || !about.contains("nodes")) {
    throw Refusal("a trace of another tool");
  }
  RecordedRun run;
  about.at("tree").get_to(run.tree);
  about.at("source").get_to(run.source);
  const OrderedJson included = about.value("included", OrderedJson::object());
  for (const auto& [file, content] : included.items()) {
    run.included.push_back({file, content.get<std::string>()});
  }
  about.at("ticks").get_to(run.ticks);
  about.at("property").get_to(run.property);
  about.at("formula").get_to(run.formula);
  about.at("verdict").get_to(run.verdict);
  about.at("why").get_to(run.why);
  about.at("atoms").get_to(run.atoms);
  run.nodes = nodes_from(about.at("nodes"));
  const OrderedJson& states = document.at("states");
  if (states.empty()) throw Refusal("a run without a state");
  for (const auto& [name, value] : states[0].at("variables").items()) {
    run.variables.push_back(name);
    run.is_number.push_back(value.is_number());
  }
  for (const OrderedJson& state : states)
    run.states.push_back(state_from(state, run));
  run.loop = state_number(document, "loop", run.states.size());
  if (run.loop != kNoState) {
    const OrderedJson& back = states.back().at("#meta").at("back");
    read_step(back, run.back);
    back.at("elapsed").get_to(run.back_elapsed);
  }
  run.lost = state_number(about, "lost", run.states.size());
  run.trigger = state_number(about, "trigger", run.states.size());
  about.at("trigger_words").get_to(run.trigger_words);
  about.at("end_words").get_to(run.end_words);
  return run;
}

}  // namespace

Json value_of(const RecordedRun& run, const RecordedState& state,
              std::size_t variable) {
  const std::string& text = state.values[variable];
  if (!run.is_number[variable]) return text;
  return Json::number(text);
}

Json included_texts(const RecordedRun& run) {
  Json files = Json::object();
  for (const IncludedText& each : run.included) files.add(each.file, each.text);
  return files;
}

Json step_back(const RecordedRun& run) {
  return {{"step", run.back.step},
          {"event", run.back.event},
          {"chosen", run.back.is_chosen},
          {"elapsed", run.back_elapsed}};
}

std::string itf_text(const RecordedRun& run) {
  Json about{{"format", "ITF"},
             {"format-description",
              "https://apalache-mc.org/docs/adr/015adr-trace.html"},
             {"tool", "btcheck"},
             {"tree", run.tree},
             {"ticks", run.ticks},
             {"property", run.property},
             {"formula", run.formula},
             {"verdict", run.verdict},
             {"why", run.why},
             {"atoms", Json::array(run.atoms)},
             {"source", run.source},
             {"nodes", node_table(run)}};
  if (!run.included.empty()) about.add("included", included_texts(run));
  if (run.lost != kNoState) about.add("lost", run.lost);
  if (run.trigger != kNoState) about.add("trigger", run.trigger);
  about.add("trigger_words", run.trigger_words);
  about.add("end_words", run.end_words);
  Json document{{"#meta", about},
                {"params", Json::array()},
                {"vars", Json::array(kVariables)}};
  if (run.loop != kNoState) document.add("loop", run.loop);
  std::string text = document.text();
  text.back() = ',';  // the states follow, one to a line
  text += "\n\"states\":[";
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    look_at_budget();
    text += i > 0 ? ",\n" : "\n";
    text += state_value(run, i).text();
  }
  text += "\n]}\n";
  return text;
}

namespace {

// Every text but those of trees is a name or a sentence: one line.
class Unbroken {
 public:
  using Event = OrderedJson::parse_event_t;

  bool operator()(int depth, Event event, OrderedJson& parsed) {
    if (event == Event::object_end && depth == texts_end_) texts_end_ = -1;
    if (event == Event::key) {
      key_ = parsed.get<std::string>();
      if (unbroken(key_) != key_) throw Refusal("a name has a line break");
    }
    if (event == Event::object_start && key_ == "included") texts_end_ = depth;
    if (event == Event::value && parsed.is_string() && key_ != "source" &&
        texts_end_ < 0) {
      parsed = unbroken(parsed.get<std::string>());
    }
    return true;
  }

 private:
  std::string key_;
  int texts_end_ = -1;  // how deep the object of texts lies
};

}  // namespace

Result<RecordedRun> read_itf(std::string_view name, std::string_view text) {
  const SourceText source(name, text);
  const auto refused = [&](SourceSpan span, const std::string& message) {
    return Result<RecordedRun>{
        std::nullopt,
        {source.diagnostic(Severity::Error, "BT1301", span, message, {},
                           fmt::format("write traces with btcheck {}",
                                       word(Choice::TraceDir)))}};
  };
  try {
    return {run_from(OrderedJson::parse(text, Unbroken())), {}};
  } catch (const OrderedJson::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    return refused(source.span(at > 0 ? at - 1 : 0, at), "this is no JSON");
  } catch (const OrderedJson::exception& error) {
    // After the library's own number: "[json.exception.out_of_range.403] ".
    const std::string_view what(error.what());
    return refused({}, fmt::format("no trace of btcheck: {}",
                                   what.substr(what.find("] ") + 2)));
  } catch (const Refusal& refusal) {
    return refused({}, std::string("no trace of btcheck: ") + refusal.what());
  }
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Perfetto gives slices of one name one colour and lets slices of a track only
// nest. So the slices of a node are named for its phase; and what can be active
// side by side, the children of a Parallel and trees, has a stack of its own.
#include "trace/formats/recordings.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "text/json.hpp"
#include "trace/run/itf.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kStep = 1000;  // microseconds
constexpr int kProcess = 1;
// Tracks: what is about the run as a whole, then nodes, then variables.
constexpr std::size_t kTickTrack = 1;
constexpr std::size_t kLoopTrack = 2;
constexpr std::size_t kFirstNodeTrack = 3;

class ChromeWriter {
 public:
  explicit ChromeWriter(const RecordedRun& run)
      : run_(run), children_(children_of(run)) {}

  std::string write(ChromeForm form) {
    name_process();
    write_ticks();
    write_loop();
    if (form == ChromeForm::Tracks) {
      write_tracks();
    } else {
      write_stacks();
    }
    write_variables();
    write_choices(form);
    const Json document{{"traceEvents", Json::array(events_)},
                        {"displayTimeUnit", "ms"},
                        {"otherData", about()}};
    return document.text() + "\n";
  }

 private:
  Json about() const {
    return {{"tool", "btcheck"},         {"tree", run_.tree},
            {"property", run_.property}, {"formula", run_.formula},
            {"verdict", run_.verdict},   {"why", run_.why},
            {"time", "1 ms is one step"}};
  }

  void name_process() {
    events_.push_back(
        {{"ph", "M"},
         {"name", "process_name"},
         {"pid", kProcess},
         {"args", {{"name", run_.verdict + " " + run_.property}}}});
  }

  void describe_track(std::size_t track, const char* what, const Json& args) {
    events_.push_back({{"ph", "M"},
                       {"name", what},
                       {"pid", kProcess},
                       {"tid", track},
                       {"args", args}});
  }

  void name_track(std::size_t track, const std::string& name) {
    describe_track(track, "thread_name", {{"name", name}});
    describe_track(track, "thread_sort_index", {{"sort_index", track}});
  }

  // From the beginning of one state to the beginning of another.
  static Json slice(std::size_t track, const std::string& name,
                    std::size_t begin, std::size_t end, const Json& args) {
    return {{"ph", "X"},
            {"name", name},
            {"cat", "run"},
            {"ts", begin * kStep},
            {"dur", (end - begin) * kStep},
            {"pid", kProcess},
            {"tid", track},
            {"args", args}};
  }

  static Json no_args(std::size_t) { return Json::object(); }

  // A slice for each stretch of states with the same value, none for "".
  template <class Value, class Args>
  void slices(std::size_t track, Value value_at, Args args_at) {
    const std::size_t count = run_.states.size();
    for (std::size_t begin = 0; begin < count;) {
      const std::string value = value_at(begin);
      std::size_t end = begin + 1;
      while (end < count && value_at(end) == value) ++end;
      if (!value.empty()) {
        events_.push_back(slice(track, value, begin, end, args_at(begin)));
      }
      begin = end;
    }
  }

  void write_ticks() {
    name_track(kTickTrack, "ticks");
    const auto tick_at = [&](std::size_t i) {
      const int tick = run_.states[i].tick;
      return tick == 0 ? "" : "tick " + std::to_string(tick);
    };
    slices(kTickTrack, tick_at, no_args);
  }

  void write_loop() {
    if (run_.loop == kNoState) return;
    name_track(kLoopTrack, "loop");
    events_.push_back(slice(kLoopTrack, "LOOP: this part repeats for ever",
                            run_.loop, run_.states.size(),
                            {{"back", run_.back.step}}));
  }

  Json node_args(std::size_t node, std::size_t state) const {
    const RecordedNode& recorded = run_.nodes[node];
    return {{"node", recorded.key},
            {"type", recorded.type},
            {"line", recorded.line},
            {"tick", run_.states[state].tick}};
  }

  void write_tracks() {
    std::vector<std::size_t> depth(run_.nodes.size(), 0);
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      const RecordedNode& node = run_.nodes[n];
      if (node.parent) depth[n] = depth[*node.parent] + 1;
      name_track(kFirstNodeTrack + n,
                 std::string(2 * depth[n], ' ') + node.name);
      slices(
          kFirstNodeTrack + n,
          [&](std::size_t i) { return shown_phase(run_.states[i], n); },
          [&](std::size_t i) { return node_args(n, i); });
    }
  }

  // The nodes whose slices go on a stack of their own.
  bool begins_stack(std::size_t node) const {
    const auto parent = run_.nodes[node].parent;
    return !parent || (run_.nodes[*parent].type.starts_with("Parallel") &&
                       children_[*parent].size() > 1);
  }

  // The active nodes of one stack in a state, outermost first.
  std::vector<std::uint32_t> chain(std::uint32_t top,
                                   const RecordedState& state) const {
    std::vector<std::uint32_t> nodes;
    std::optional<std::uint32_t> here = top;
    while (here && is_active(state.phases[*here])) {
      nodes.push_back(*here);
      here.reset();
      for (const std::uint32_t child : children_[nodes.back()]) {
        if (begins_stack(child) || !is_active(state.phases[child])) continue;
        here = child;
        break;
      }
    }
    return nodes;
  }

  void write_stacks() {
    for (std::uint32_t top = 0; top < run_.nodes.size(); ++top) {
      if (!begins_stack(top)) continue;
      name_track(kFirstNodeTrack + top, run_.nodes[top].name);
      write_stack(top);
    }
  }

  void write_stack(std::uint32_t top) {
    struct Open {
      std::uint32_t node;
      std::size_t event;  // the place of its slice
      std::size_t begin;
    };
    std::vector<Open> open;
    const auto close = [&](std::size_t kept, std::size_t state) {
      for (; open.size() > kept; open.pop_back()) {
        const auto [node, event, begin] = open.back();
        Json args = node_args(node, begin);
        if (state < run_.states.size()) {
          args.add("returns", shown_phase(run_.states[state], node));
        }
        events_[event] = slice(kFirstNodeTrack + top, run_.nodes[node].name,
                               begin, state, args);
      }
    };
    for (std::size_t i = 0; i < run_.states.size(); ++i) {
      const auto nodes = chain(top, run_.states[i]);
      std::size_t kept = 0;
      while (kept < open.size() && kept < nodes.size() &&
             open[kept].node == nodes[kept]) {
        ++kept;
      }
      close(kept, i);
      for (; kept < nodes.size(); ++kept) {
        open.push_back({nodes[kept], events_.size(), i});
        events_.push_back(Json::null());
      }
    }
    close(0, run_.states.size());
  }

  void write_variables() {
    for (std::size_t v = 0; v < run_.variables.size(); ++v) {
      if (run_.is_number[v]) {
        write_counter(v);
        continue;
      }
      const std::size_t track = kFirstNodeTrack + run_.nodes.size() + v;
      name_track(track, run_.variables[v]);
      const auto value_at = [&](std::size_t i) {
        return run_.states[i].values[v];
      };
      slices(track, value_at, no_args);
    }
  }

  void write_counter(std::size_t variable) {
    std::string last;
    for (std::size_t i = 0; i < run_.states.size(); ++i) {
      const std::string& value = run_.states[i].values[variable];
      if (i > 0 && value == last) continue;
      last = value;
      events_.push_back(
          {{"ph", "C"},
           {"name", run_.variables[variable]},
           {"ts", i * kStep},
           {"pid", kProcess},
           {"args", {{"value", value_of(run_, run_.states[i], variable)}}}});
    }
  }

  // On the track of the node that took the step, if it has one.
  void write_choices(ChromeForm form) {
    for (std::size_t i = 0; i < run_.states.size(); ++i) {
      const RecordedState& state = run_.states[i];
      if (!state.is_chosen) continue;
      const bool is_on_node = form == ChromeForm::Tracks && state.mover;
      const std::string& text = state.event.empty() ? state.step : state.event;
      events_.push_back(
          {{"ph", "i"},
           {"name", text},
           {"cat", "choice"},
           {"s", "t"},
           {"ts", i * kStep},
           {"pid", kProcess},
           {"tid", is_on_node ? kFirstNodeTrack + *state.mover : kTickTrack},
           {"args", {{"tick", state.tick}}}});
    }
  }

  const RecordedRun& run_;
  const Children children_;
  std::vector<Json> events_;
};

}  // namespace

std::string chrome_text(const RecordedRun& run, ChromeForm form) {
  return ChromeWriter(run).write(form);
}

}  // namespace btcheck

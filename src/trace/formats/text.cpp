// SPDX-License-Identifier: MIT
//
// The text of a run has a heading for each unit of time, and the loop marked
// where it begins and where it closes. A tick of a tree is what happens from
// where its root leaves `tick_node` to where it answers.
#include "trace/formats/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "trace/run/record.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// --- A run -----------------------------------------------------------------

constexpr std::size_t kChosenColumn = 62;  // of a line of kLineWidth
constexpr std::size_t kMostShown = 400;    // steps; longer texts are cut

class Teller {
 public:
  Teller(std::string_view ticks, const TextStyle& style)
      : unit_(ticks == tick_name(TickSemantics::Root) ? "tick" : "time"),
        style_(style) {}

  void pass_time() {
    ++time_;
    is_new_time_ = true;
  }
  // Nothing has been told of this unit of time.
  bool is_untold() const { return is_new_time_ && time_ > 0; }

  void line(std::string_view text, std::string_view note = {}) {
    std::string heading;
    if (is_new_time_) {
      heading = time_ > 0 ? fmt::format("{} {}", unit_, time_) : "start";
    }
    is_new_time_ = false;
    std::string line = fmt::format("{}{:<8} {}", style_.indent, heading, text);
    lines_.push_back({std::move(line), note});
  }

  void mark(std::string_view text) {
    lines_.push_back({fmt::format("{}-- {}", style_.indent, text), {}});
    is_new_time_ = true;
  }

  std::string text() const {
    const std::size_t column = note_column();
    std::string text;
    for (const Line& line : lines_) {
      text += line.text;
      if (!line.note.empty()) {
        text.append(column - std::min(column - 1, line.text.size()), ' ');
        text += line.note;
      }
      text += '\n';
    }
    return text;
  }

 private:
  struct Line {
    std::string text;
    std::string_view note;
  };

  // Where the notes stand: behind all lines, if those leave room for them.
  std::size_t note_column() const {
    const std::size_t room = style_.width - kLineWidth;
    std::size_t column = kChosenColumn;
    for (const Line& line : lines_) {
      const bool fits = line.text.size() < kChosenColumn + room;
      if (!line.note.empty() && fits) {
        column = std::max(column, line.text.size() + 1);
      }
    }
    return column;
  }

  std::string_view unit_;
  const TextStyle& style_;
  std::vector<Line> lines_;
  int time_ = 0;
  bool is_new_time_ = true;
};

std::size_t step_count(const RecordedRun& run) {
  return run.states.size() - (run.loop == kNoState ? 1 : 0);
}

// To the next state, or back to where the loop begins.
const RecordedStep& step_from(const RecordedRun& run, std::size_t i) {
  return i + 1 == run.states.size() ? run.back : run.states[i + 1];
}

int elapsed_from(const RecordedRun& run, std::size_t i) {
  return i + 1 == run.states.size()
             ? run.back_elapsed
             : run.states[i + 1].time - run.states[i].time;
}

// The last step of a run in words: "land is ticked".
std::string last_words(const RecordedRun& run) {
  const RecordedState& last = run.states.back();
  const bool is_ticked = last.mover && *last.mover < run.nodes.size() &&
                         last.locations[*last.mover] == "tick_node";
  return is_ticked ? run.nodes[*last.mover].name + " is ticked" : last.step;
}

// What happens for ever in a loop in which nothing is told.
std::string_view silent_loop(const RecordedRun& run) {
  for (std::size_t i = run.loop; i < step_count(run); ++i) {
    if (step_from(run, i).step != kTimePasses) return "this repeats for ever";
  }
  return "the run stays here for ever while time passes";
}

// --- A tree ----------------------------------------------------------------

constexpr std::size_t kMostIndent = 40;
constexpr std::size_t kWidest = 60;  // of the first column

struct Row {
  std::string name;  // with its indentation
  std::string phase;
};

class Picture {
 public:
  Picture(const RecordedRun& run, const RecordedState& state)
      : run_(run),
        state_(state),
        depth_(run.nodes.size(), 0),
        below_(run.nodes.size(), 0),
        is_untouched_(run.nodes.size(), true) {
    for (std::size_t n = 0; n < run.nodes.size(); ++n) {
      ++uses_[run.nodes[n].name];
      if (run.nodes[n].parent) depth_[n] = depth_[*run.nodes[n].parent] + 1;
    }
    for (std::size_t n = run.nodes.size(); n-- > 0;) {
      if (state.phases[n] != Phase::Unvisited) is_untouched_[n] = false;
      if (!run.nodes[n].parent) continue;
      const std::size_t parent = *run.nodes[n].parent;
      below_[parent] += 1 + below_[n];
      if (!is_untouched_[n]) is_untouched_[parent] = false;
    }
  }

  std::vector<Row> rows(Folding folding) const {
    std::vector<Row> rows;
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      std::string name(std::min(2 * depth_[n], kMostIndent), ' ');
      name += name_of(run_.nodes[n]);
      const bool is_folded =
          folding == Folding::Unvisited && is_untouched_[n] && below_[n] > 0;
      if (is_folded) name += fmt::format(" and {} below it", below_[n]);
      rows.push_back({std::move(name), phase(n)});
      if (is_folded) n += below_[n];
    }
    return rows;
  }

 private:
  // With the line, where several nodes have the name.
  std::string name_of(const RecordedNode& node) const {
    return uses_.at(node.name) > 1 ? fmt::format("{}@{}", node.name, node.line)
                                   : node.name;
  }

  std::string phase(std::size_t node) const {
    // A root that has answered is still where it answered.
    const std::string& location = state_.locations[node];
    const bool has_answered = !run_.nodes[node].parent &&
                              std::ranges::count(kPhaseNames, location) > 0;
    return has_answered ? location : shown_phase(state_, node);
  }

  const RecordedRun& run_;
  const RecordedState& state_;
  std::map<std::string, int> uses_;  // of names
  std::vector<std::size_t> depth_;
  std::vector<std::size_t> below_;  // how many nodes
  std::vector<bool> is_untouched_;  // and all below it
};

}  // namespace

std::string run_text(const RecordedRun& run, const TextStyle& style) {
  Teller teller(run.ticks, style);
  std::size_t told = 0;
  for (std::size_t i = 0; i < step_count(run); ++i) {
    if (style.trigger_state == i) teller.line("-- " + style.trigger_words);
    if (run.loop == i) teller.mark("the loop begins");
    const RecordedStep& step = step_from(run, i);
    if (elapsed_from(run, i) > 0) teller.pass_time();
    const bool is_silent = step.event.empty();
    if (is_silent && style.detail == Detail::Events) continue;
    if (told++ >= kMostShown) continue;
    teller.line(is_silent ? step.step : step.event,
                step.is_chosen ? "chosen" : "");
  }
  if (told > kMostShown) {
    teller.mark(fmt::format("{} more steps", told - kMostShown));
  }
  // A run may end in a tick before anybody has answered in it.
  const bool ends_early = told <= kMostShown && run.loop == kNoState &&
                          teller.is_untold() &&
                          run.states.back().step != kTimePasses;
  if (ends_early) teller.line(last_words(run));
  if (style.trigger_state == step_count(run)) {
    teller.line("-- " + style.trigger_words);
  }
  if (run.loop != kNoState) teller.mark(silent_loop(run));
  return teller.text();
}

std::string run_text(const BehaviorTree& tree, const Network& network,
                     const Run& run, const TextStyle& style) {
  return run_text(recorded_steps(tree, network, run), style);
}

namespace {

constexpr std::size_t kMostBriefLines = 6;

// What is told of one tick: the events of the nodes, and the last two answers
// that the world outside has chosen.
struct BriefTick {
  int time = 0;
  std::vector<std::string> events;
  std::vector<bool> is_shown;

  // With as many of the others as find room.
  std::string text(std::size_t width) const {
    constexpr std::size_t kMostOthers = 2;
    for (std::size_t others = kMostOthers; others > 0; --others) {
      std::string line = text_with(others);
      if (line.size() <= width) return line;
    }
    return text_with(0);
  }

 private:
  // With so many of the others, the last.
  std::string text_with(std::size_t others) const {
    std::string line;
    for (std::size_t i = events.size(); i-- > 0;) {
      if (!is_shown[i] && others == 0) continue;
      if (!is_shown[i]) --others;
      line = line.empty() ? events[i] : events[i] + ", " + line;
    }
    return line;
  }
};

std::vector<BriefTick> brief_ticks(const RecordedRun& run,
                                   const std::vector<NodeId>& shown) {
  std::vector<BriefTick> ticks;
  for (std::size_t i = 1; i < run.states.size(); ++i) {
    const RecordedState& state = run.states[i];
    if (state.event.empty()) continue;
    const bool is_shown =
        state.mover && std::ranges::count(shown, NodeId{*state.mover}) > 0;
    if (!is_shown && !state.is_chosen) continue;
    if (ticks.empty() || ticks.back().time != state.time) {
      ticks.push_back({state.time, {}, {}});
    }
    ticks.back().events.push_back(state.event);
    ticks.back().is_shown.push_back(is_shown);
  }
  return ticks;
}

}  // namespace

std::string brief_text(const RecordedRun& run, const std::vector<NodeId>& shown,
                       std::size_t width) {
  const std::vector<BriefTick> ticks = brief_ticks(run, shown);
  const std::string_view unit =
      run.ticks == tick_name(TickSemantics::Root) ? "tick" : "time";
  constexpr std::size_t kFirst = 2;
  const std::size_t last = kMostBriefLines - kFirst - 1;
  std::string text;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (ticks.size() > kMostBriefLines && i >= kFirst &&
        i + last < ticks.size()) {
      if (i == kFirst) text += "    …\n";
      continue;
    }
    text += fmt::format("    {} {:<3} {}\n", unit, ticks[i].time,
                        ticks[i].text(std::max(width, kBriefWidth)));
  }
  return text;
}

std::string tree_text(const RecordedRun& run, std::size_t state,
                      Folding folding) {
  const std::vector<Row> rows = Picture(run, run.states[state]).rows(folding);
  std::size_t width = 0;
  for (const Row& row : rows) {
    if (!row.phase.empty()) width = std::max(width, row.name.size());
  }
  width = std::min(width, kWidest);
  std::string text;
  for (const Row& row : rows) {
    text += row.phase.empty()
                ? row.name + '\n'
                : fmt::format("{:<{}}  {}\n", row.name, width, row.phase);
  }
  return text;
}

std::vector<std::string> tick_line_keys(const BehaviorTree& tree) {
  std::map<std::string, int> uses = {{"root", 1}};
  for (const StateVariable& variable : tree.variables) ++uses[variable.name];
  std::vector<std::string> keys = short_names(tree);
  for (const std::string& key : keys) ++uses[key];
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (uses[keys[n]] > 1) keys[n] = unique_name(tree, NodeId{n});
    const bool is_word = keys[n].find_first_of(" \t\"=,") == keys[n].npos;
    if (!is_word) keys[n] = quoted(keys[n]);
  }
  return keys;
}

TickLines::TickLines(const BehaviorTree& tree, const Network& network)
    : tree_(tree),
      network_(network),
      keys_(tick_line_keys(tree)),
      ticks_(tree.nodes.size()),
      is_visited_(tree.nodes.size()),
      answers_(tree.nodes.size()) {
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    root_of_.push_back(node.is_root() ? NodeId{n}
                                      : root_of_[index(node.parent)]);
  }
}

void TickLines::note(NodeId node, const Location& location) {
  const std::uint32_t n = index(node);
  const LocationRole role = location.role;
  if (role == LocationRole::Tick || role == LocationRole::Halt) {
    is_visited_[n] = true;
  }
  if (!is_answer(role) && role != LocationRole::Halted &&
      role != LocationRole::Error) {
    return;
  }
  if (!answers_[n].empty()) answers_[n] += ',';
  answers_[n] += location.name;
}

std::string TickLines::take(const RunStep& step) {
  if (step.step.edge == kTimeStep) return {};
  const Automaton& mover = network_.owner_of_edge(step.step.edge);
  if (mover.kind != AutomatonKind::Node) return {};
  const Edge& edge = network_.edge(step.step.edge);
  const Location& target = mover.target(edge);
  if (!tree_.node(mover.node).is_root()) {
    note(mover.node, target);
    return {};
  }
  Tick& tick = ticks_[index(mover.node)];
  if (mover.source(edge).role == LocationRole::Tick) {
    ++tick.number;
    tick.is_open = true;
  }
  if (!is_answer(target.role) || edge.source == edge.target) return {};
  tick.is_open = false;
  const std::string text = line(mover.node, target.name, step.after);
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    if (root_of_[n] != mover.node) continue;
    is_visited_[n] = false;
    answers_[n].clear();
  }
  return text;
}

std::string TickLines::rest(const Valuation& last) const {
  std::string text;
  for (const NodeId root : tree_.roots) {
    if (ticks_[index(root)].is_open) text += line(root, "none", last) + '\n';
  }
  return text;
}

std::string TickLines::line(NodeId root, std::string_view answer,
                            const Valuation& state) const {
  std::string text = fmt::format("tick {}", ticks_[index(root)].number);
  if (tree_.roots.size() > 1) text += fmt::format(" of {}", keys_[index(root)]);
  text += fmt::format(": root={}", answer);
  for (std::size_t v = 0; v < tree_.variables.size(); ++v) {
    const int value = state.variables[index(network_.state_variable[v])];
    text += fmt::format(" {}={}", tree_.variables[v].name,
                        tree_.variables[v].value_name(value));
  }
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    if (root_of_[n] != root || !is_visited_[n]) continue;
    text += fmt::format(" {}={}", keys_[n],
                        answers_[n].empty() ? "none" : answers_[n]);
  }
  return text;
}

std::string tick_lines(const BehaviorTree& tree, const Network& network,
                       const Run& run) {
  TickLines lines(tree, network);
  std::string text;
  for (const RunStep& step : run.steps) {
    const std::string line = lines.take(step);
    if (!line.empty()) text += line + '\n';
  }
  return text + lines.rest(run.state(run.steps.size()));
}

}  // namespace btcheck

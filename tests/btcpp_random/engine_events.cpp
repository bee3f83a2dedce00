// SPDX-License-Identifier: MIT
#include "btcpp_random/engine_events.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace btcheck::reference {
namespace {

KeptValue value_in(std::istringstream& words) {
  using Kind = KeptValue::Kind;
  KeptValue value;
  std::string type;
  words >> type;
  if (type == "unset") return value;
  if (type == "no_value") {
    value.kind = Kind::NoValue;
  } else if (type == "integer" || type == "real") {
    value.kind = type == "real" ? Kind::Real : Kind::Integer;
    words >> value.number;
  } else if (type == "text") {
    value.kind = Kind::Text;
    std::getline(words >> std::ws, value.text);
    value.text = value.text.substr(1, value.text.size() - 2);
  } else {
    value.kind = Kind::Other;
  }
  return value;
}

EngineEvent event_in(const std::string& line) {
  std::istringstream words(line);
  EngineEvent event;
  words >> event.what;
  if (event.what == "end") {
    words >> event.after;
  } else if (event.what == "begin") {
    words >> event.number;
  } else if (event.what == "answer") {
    words >> event.number >> event.after;
  } else if (event.what == "change") {
    words >> event.number >> event.before >> event.after;
  } else if (event.what == "entry") {
    words >> event.number;
    event.value = value_in(words);
  } else if (event.what != "tick" && event.what != "wake" &&
             event.what != "throw") {
    throw std::runtime_error("no event: " + line);
  }
  return event;
}

bool is_end(const std::string& status) {
  return status == "success" || status == "failure";
}

// The states by what the events mean, one after another.
class Player {
 public:
  Player(const EngineRun& run,
         const std::function<void(const EngineState&)>& show)
      : run_(run), show_(show) {
    const std::size_t count = run.nodes.size();
    state_.locations.assign(count, "start_");
    state_.statuses.assign(count, "idle");
    state_.called.assign(count, false);
    state_.answers.assign(count, "none");
    state_.entries.resize(run.entries.size());
  }

  void play() {
    show_(state_);
    // What the node has answered that is to set its status; or the status that
    // it has set itself, which it is to answer.
    const EngineEvent* answer = nullptr;
    const EngineEvent* set = nullptr;
    for (const EngineEvent& event : run_.events) {
      ++state_.events;
      if (event.what == "entry") {
        state_.entries.at(event.number) = event.value;
        continue;
      }
      const auto is_same = [&](const EngineEvent* before) {
        return before != nullptr && before->number == event.number &&
               before->after == event.after;
      };
      const EngineEvent* answer_before = std::exchange(answer, nullptr);
      const EngineEvent* set_before = std::exchange(set, nullptr);
      if (event.what == "change") {
        ++state_.records;
        if (is_same(answer_before)) continue;
        if (is_end(event.after)) set = &event;
        change(event.number, event.before, event.after);
      } else if (event.what == "answer") {
        answer = &event;
        if (!is_same(set_before)) answered(event.number, event.after);
      } else {
        follow(event);
      }
    }
  }

 private:
  void follow(const EngineEvent& event) {
    if (event.what == "tick" || event.what == "wake") {
      ++state_.tick;
      forget();
      enter(0);
      state_.locations[0] = "called";
      show_(state_);
    } else if (event.what == "begin") {
      begin(event.number);
    } else if (event.what == "end") {
      leave_below(0);
      state_.statuses[0] = event.after;
      give(0, event.after);
      pass();
    } else {
      for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
        state_.locations[n] = "start_";
        state_.called[n] = false;
      }
      show_(state_);
      pass();
    }
  }

  void pass() {
    ++state_.time;
    show_(state_);
  }
  void forget() { state_.answers.assign(run_.nodes.size(), "none"); }

  bool is_out(std::size_t n) const { return state_.locations[n] == "start_"; }

  void enter(std::size_t n) {
    state_.locations[n] = "tick_node";
    state_.called[n] = true;
    show_(state_);
  }

  // Those above that have not been heard of are in their ticks.
  void enter_above(std::size_t n) {
    const std::size_t above = run_.nodes[n].parent;
    if (above == 0 || !is_out(above)) return;
    enter_above(above);
    enter(above);
    state_.locations[above] = "called";
    show_(state_);
  }

  void begin(std::size_t n) {
    enter_above(n);
    if (!is_out(n)) return;
    leave_below(run_.nodes[n].parent);
    enter(n);
    if (!run_.nodes[n].has_children) return;
    state_.locations[n] = "called";
    show_(state_);
  }

  void answered(std::size_t n, const std::string& status) {
    enter_above(n);
    if (is_out(n)) {
      leave_below(run_.nodes[n].parent);
      enter(n);
    }
    leave_below(n);
    if (status != "skipped") state_.statuses[n] = status;
    give(n, status);
  }

  // The answer, and control is given back.
  void give(std::size_t n, const std::string& answer) {
    state_.locations[n] = answer;
    state_.called[n] = false;
    if (answer != "halted") state_.answers[n] = answer;
    show_(state_);
    if (n == 0) forget();
    state_.locations[n] = "done";
    show_(state_);
    state_.locations[n] = "start_";
    show_(state_);
  }

  void leave_below(std::size_t n) {
    for (std::size_t below = n + 1; below < run_.nodes.size(); ++below) {
      if (!is_below(below, n) || is_out(below)) continue;
      // A leaf that tells no answer, such as a CoroActionNode, and runs.
      if (!run_.nodes[below].has_children &&
          state_.statuses[below] == "running") {
        give(below, "running");
        continue;
      }
      state_.locations[below] = "start_";
      state_.called[below] = false;
      show_(state_);
    }
  }
  bool is_below(std::size_t node, std::size_t above) const {
    while (node > above) node = run_.nodes[node].parent;
    return node == above;
  }

  void change(std::size_t n, const std::string& before,
              const std::string& after) {
    if (is_end(after)) return answered(n, after);
    if (after == "running") {
      begin(n);
      state_.statuses[n] = after;
      return show_(state_);
    }
    state_.statuses[n] = "idle";
    if (before == "running" && is_out(n)) return give(n, "halted");
    show_(state_);
  }

  const EngineRun& run_;
  const std::function<void(const EngineState&)>& show_;
  EngineState state_;
};

}  // namespace

std::string KeptValue::word() const {
  if (kind == Kind::Unset) return "unset";
  if (kind == Kind::NoValue) return "no_value";
  if (kind == Kind::Other) return "";
  std::string plain = text;
  if (is_number()) plain = fmt::format("{}", std::abs(number));
  std::string word = is_number() && number < 0 ? "minus_" : "";
  for (const char c : plain) {
    word += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  return word.empty() ? "empty" : word;
}

EngineRun engine_run(const std::string& text) {
  EngineRun run;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    if (what == "node") {
      EngineNode node;
      words >> node.parent >> node.type >> node.name;
      if (!run.nodes.empty()) run.nodes.at(node.parent).has_children = true;
      run.nodes.push_back(std::move(node));
    } else if (what == "entry") {
      words >> run.entries.emplace_back();
    } else {
      throw std::runtime_error("no node or entry: " + line);
    }
  }
  if (run.nodes.size() < 2) throw std::runtime_error("a run without nodes");
  for (std::string line; std::getline(lines, line);) {
    run.events.push_back(event_in(line));
    const EngineEvent& event = run.events.back();
    const std::size_t most =
        event.what == "entry" ? run.entries.size() : run.nodes.size();
    if (event.number >= most) throw std::runtime_error("no such: " + line);
  }
  return run;
}

void play(const EngineRun& run,
          const std::function<void(const EngineState&)>& show) {
  Player(run, show).play();
}

}  // namespace btcheck::reference

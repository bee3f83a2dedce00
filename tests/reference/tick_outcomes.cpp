// SPDX-License-Identifier: MIT
//
// A tick is taken again and again from the same state, with other decisions
// each time: those of the last time up to the last that can still be made
// otherwise, that one made otherwise, and the first that is allowed from there.
#include "reference/tick_outcomes.hpp"

#include <set>
#include <tuple>
#include <utility>

#include "reference/tick_interpreter.hpp"

namespace btcheck::reference {
namespace {

// One decision after another, and how many ways there were.
class DecisionTree {
 public:
  int next(std::size_t ways) {
    if (at_ == made_.size()) made_.emplace_back(0, ways);
    return static_cast<int>(made_[at_++].first);
  }
  // Goes back to the start with the next decisions; false after the last.
  bool advance() {
    at_ = 0;
    while (!made_.empty() && made_.back().first + 1 == made_.back().second) {
      made_.pop_back();
    }
    if (made_.empty()) return false;
    ++made_.back().first;
    return true;
  }

 private:
  std::vector<std::pair<std::size_t, std::size_t>> made_;
  std::size_t at_ = 0;
};

Script asking(DecisionTree& decisions) {
  Script script;
  script.action = [&](NodeId, std::span<const NodeStatus> allowed) {
    return allowed[static_cast<std::size_t>(decisions.next(allowed.size()))];
  };
  script.set_sv = [&](NodeId, std::span<const int> allowed) {
    return allowed[static_cast<std::size_t>(decisions.next(allowed.size()))];
  };
  script.due = [&](NodeId, int) { return decisions.next(2) == 1; };
  return script;
}

// All that the ticks to come depend on.
using Key = std::vector<int>;
Key key_of(const TickResult& state) {
  Key key = state.variables;
  for (const NodeStatus status : state.statuses) {
    key.push_back(static_cast<int>(status));
  }
  for (const LocalValue& local : state.locals) key.push_back(local.value);
  for (const TimerValue& timer : state.timers) {
    key.push_back(static_cast<int>(timer.phase));
    key.push_back(timer.elapsed);
  }
  return key;
}

TickAnswers answers_of(const TickResult& tick, std::size_t nodes) {
  TickAnswers answers(nodes, "none");
  for (const TickEvent& event : tick.events) {
    const bool is_answer =
        event.kind != EventKind::Ticked && event.kind != EventKind::Halted;
    if (is_answer) answers[index(event.node)] = event_name(event.kind);
  }
  return answers;
}

}  // namespace

std::optional<std::vector<TickAnswers>> tick_outcomes(const BehaviorTree& tree,
                                                      std::size_t most) {
  DecisionTree decisions;
  std::vector<TickInterpreter> open{TickInterpreter(tree, asking(decisions))};
  std::set<Key> seen{key_of(open[0].state())};
  std::set<TickAnswers> outcomes;
  std::size_t ticks = 0;
  while (!open.empty()) {
    const TickInterpreter from = std::move(open.back());
    open.pop_back();
    do {
      if (++ticks > most) return std::nullopt;
      TickInterpreter after = from;
      const TickResult tick = after.tick();
      if (tick.fault) continue;
      outcomes.insert(answers_of(tick, tree.nodes.size()));
      if (!after.ended() && seen.insert(key_of(tick)).second) {
        open.push_back(std::move(after));
      }
    } while (decisions.advance());
  }
  return std::vector<TickAnswers>(outcomes.begin(), outcomes.end());
}

}  // namespace btcheck::reference

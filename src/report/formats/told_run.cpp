// SPDX-License-Identifier: MIT
//
// Each step stands where the node that takes it, or the variable that moves, is
// written in the tree's file: a reader steps through the file, not the network.
#include "report/formats/told_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "trace/run/record.hpp"

namespace btcheck {
namespace {

// Who moves in a step that is not one of time.
Culprit mover_of(const Network& network, const RunStep& step) {
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  if (automaton.kind == AutomatonKind::StateVariable) {
    return {std::nullopt, automaton.state_variable};
  }
  return {automaton.node, std::nullopt};
}

Place place_of(const BehaviorTree& tree, const Culprit& mover) {
  if (mover.node) return btcheck::place_of(tree, *mover.node);
  return {tree.file, tree.variable(*mover.variable).span};
}

class Teller {
 public:
  Teller(const BehaviorTree& tree, const Network& network)
      : tree_(tree),
        network_(network),
        here_(btcheck::place_of(tree, tree.roots[0])) {
    told_.unit = network.ticks == TickSemantics::Root ? "tick" : "time";
  }

  ToldRun tell(const Run& run, const RunRemarks& remarks) {
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      if (remarks.state == i) remark(remarks.words);
      if (run.loop == i) {
        told_.loop = told_.steps.size();
        remark("the loop begins");
      }
      take(run.state(i), run.steps[i]);
    }
    if (remarks.state == run.steps.size()) remark(remarks.words);
    if (!remarks.end.empty()) remark(remarks.end);
    if (told_.loop) remark(closing_words(run));
    told_.time = time_;
    return std::move(told_);
  }

 private:
  void take(const Valuation& before, const RunStep& step) {
    time_ += step.step.elapsed;
    const auto event = event_of(tree_, network_, before, step);
    if (!event) return;
    here_ = place_of(tree_, mover_of(network_, step));
    if (time_ != told_time_) {
      told_time_ = time_;
      const std::string begin = fmt::format("{} {}", told_.unit, time_);
      add(ToldStep::Kind::Time,
          told_.unit == "tick" ? begin + " begins" : begin,
          btcheck::place_of(tree_, tree_.roots[0]));
    }
    add(ToldStep::Kind::Event, event->text, here_);
    told_.steps.back().is_chosen = event->is_chosen;
  }

  void remark(const std::string& words) {
    add(ToldStep::Kind::Remark, words, here_);
  }

  void add(ToldStep::Kind kind, std::string text, const Place& place) {
    told_.steps.push_back({kind, std::move(text), time_, false, place});
  }

  std::string closing_words(const Run& run) const {
    for (std::size_t i = run.loop; i < run.steps.size(); ++i) {
      if (run.steps[i].step.edge != kTimeStep) return "this repeats for ever";
    }
    return "the run stays here for ever while time passes";
  }

  const BehaviorTree& tree_;
  const Network& network_;
  ToldRun told_;
  Place here_;  // of the event told last
  int time_ = 0;
  int told_time_ = 0;
};

bool is_event(const BehaviorTree& tree, const Network& network, const Run& run,
              std::size_t step) {
  return event_of(tree, network, run.state(step), run.steps[step]).has_value();
}

}  // namespace

Place place_of(const BehaviorTree& tree, NodeId node) {
  return {tree.file_of(node), tree.node(node).span};
}

ToldRun told_run(const BehaviorTree& tree, const Network& network,
                 const Run& run, const RunRemarks& remarks) {
  return Teller(tree, network).tell(run, remarks);
}

Culprit culprit_of(const BehaviorTree& tree, const Network& network,
                   const Run& run, const std::vector<NodeId>& subjects) {
  const bool is_finite = run.loop == kNoLoop;
  std::optional<Culprit> found;
  for (std::size_t i = run.steps.size(); i-- > 0;) {
    const RunStep& step = run.steps[i];
    if (step.step.edge == kTimeStep) continue;
    const Culprit mover = mover_of(network, step);
    const bool is_last = i + 1 == run.steps.size();
    if (is_finite && is_last) return mover;
    if (!is_event(tree, network, run, i)) continue;
    if (!found) found = mover;
    if (is_finite || i < run.loop) break;
    const bool is_subject =
        mover.node && std::find(subjects.begin(), subjects.end(),
                                *mover.node) != subjects.end();
    if (is_subject) return mover;
  }
  return found.value_or(Culprit{tree.roots[0], std::nullopt});
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A choice of the run is held against the other answers of the same leaf at
// the same place (Lewis, "Causation", 1973: had it been otherwise, the rule had
// not been broken). From each answer what can follow is searched, as far as a
// few thousand states go:
//
//   - a state that must not be is certain after a choice when the states
//     without it hold no cycle, so that no run stays among them; it can be
//     avoided when steps that are progress lead to such a cycle;
//   - a state that must come can come as long as it is reachable;
//   - within as many ticks as the run has left, whether the state can be
//     avoided, or can come, whatever is assumed of what follows.
#include "trace/why/nearest.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "check/replay/replay.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/state/step.hpp"
#include "explore/store/state_store.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostStates = 2000;  // from one answer on
constexpr int kMostSearches = 24;          // for one run
constexpr std::size_t kMostSteps = 2000;   // of a run

// The kind of state that a rule is about.
struct Aim {
  StatePredicate state;
  bool holds = true;               // in the states that are meant
  bool is_wanted = false;          // there should be one; else there must not
  std::string text = {};           // of a wanted one
  std::optional<int> within = {};  // units of time
};

// Q of `<> Q`, `[] <> Q`, `[] (P => <> Q)`, with an assumption in front or not.
std::optional<std::uint32_t> awaited_in(const BoundFormula& formula) {
  FormulaId part = formula.formula;
  for (;;) {
    const FormulaNode& node = formula.pool[part];
    if (node.kind == FormulaKind::Eventually) {
      const FormulaNode& of = formula.pool[node.left];
      if (of.kind != FormulaKind::Atom) return std::nullopt;
      return of.atom;
    }
    if (node.kind == FormulaKind::Always) {
      part = node.left;
    } else if (node.kind == FormulaKind::Implies) {
      part = node.right;
    } else {
      return std::nullopt;
    }
  }
}

std::optional<Aim> aim_of(const BoundProperty& rule) {
  if (asks_of_states(rule.form)) {
    return Aim{rule.predicate, rule.form != PropertyForm::Invariant};
  }
  if (rule.form == PropertyForm::Ltl) {
    const auto awaited = awaited_in(rule.formula);
    if (!awaited) return std::nullopt;
    const Proposition& of = rule.formula.propositions[*awaited];
    if (of.kind != PropositionKind::State) return std::nullopt;
    return Aim{of.of, true, true, rule.origins[*awaited].text};
  }
  const TimedPattern& pattern = rule.timed.pattern;
  const bool is_answer =
      pattern.demand == Demand::Answer || pattern.demand == Demand::FirstAnswer;
  if (rule.form != PropertyForm::Timed || !is_answer || pattern.closing != 0 ||
      pattern.from != 0) {
    return std::nullopt;
  }
  const auto bit = static_cast<std::size_t>(std::countr_zero(pattern.answer));
  Aim aim{rule.timed.predicates[bit], true, true, rule.timed.texts[bit]};
  if (pattern.to != kNoEnd) aim.within = pattern.to;
  return aim;
}

// What can follow a state, up to states that are aimed at.
struct Following {
  bool is_whole = false;   // all of it was seen
  bool has_cycle = false;  // some run stays clear of what is aimed at
  std::optional<std::uint32_t> nearest;  // steps to what is aimed at
};

// What has to be possible within some units of time.
enum class Chance : unsigned char {
  Avoids,  // they pass without the state that is meant
  Comes    // it comes
};

// Another answer where the run has one.
struct Answer {
  StateVector state;  // after it
  std::string event;
};

class Elsewhere {
 public:
  Elsewhere(const Story& story, const Aim& aim)
      : story_(story),
        system_(story.network),
        labels_(system_, std::vector<StatePredicate>{aim.state}),
        aimed_at_(aim.holds ? 1 : 0) {
    system_.initial_states([&](StateView first) { keep(first); });
    for (const RunStep& each : story.run.steps) {
      StateVector next;
      system_.successors(states_.back(), [&](StateView to, const Step& step) {
        if (step == each.step) next.assign(to.begin(), to.end());
      });
      if (next.empty()) return;
      keep(next);
    }
  }

  // The run was found again, step by step.
  bool has_run() const { return states_.size() == story_.run.state_count(); }
  bool is_aimed_at(std::size_t state) const { return is_aim(states_[state]); }
  StateView state(std::size_t i) const { return states_[i]; }

  // Of the same leaf, or of a variable; empty where the step is no choice.
  std::vector<Answer> others(std::size_t i) const {
    std::vector<Answer> found;
    const Automaton* mover = story_.mover(i);
    if (!mover || mover->kind == AutomatonKind::Timer || event(i).empty()) {
      return found;
    }
    system_.successors(states_[i], [&](StateView to, const Step& step) {
      if (step.edge == kTimeStep || step == story_.run.steps[i].step ||
          &story_.network.owner_of_edge(step.edge) != mover) {
        return;
      }
      std::string text = event_of_step(i, step);
      if (!text.empty()) {
        found.push_back({StateVector(to.begin(), to.end()), std::move(text)});
      }
    });
    return found;
  }

  // What the world chooses in the step; "" where it chooses nothing.
  std::string event(std::size_t i) const {
    return event_of_step(i, story_.run.steps[i].step);
  }

  bool may_search() const { return searches_ < kMostSearches; }
  // With free moves of variables or without.
  Following following(StateView from, bool has_free_moves) {
    ++searches_;
    VectorSet seen(system_.word_count());
    std::vector<std::uint32_t> depth = {0};
    std::vector<std::vector<std::uint32_t>> next;
    seen.insert(from);
    Following found;
    StateVector here;
    while (next.size() < seen.size() && next.size() < kMostStates) {
      const auto number = static_cast<std::uint32_t>(next.size());
      next.emplace_back();
      const StateView stored = seen[number];
      here.assign(stored.begin(), stored.end());
      if (is_aim(here)) {
        if (!found.nearest) found.nearest = depth[number];
        continue;
      }
      system_.successors(here, [&](StateView to, const Step& step) {
        if (!has_free_moves && !step.progress) return;
        const auto inserted = seen.insert(to);
        if (inserted.is_new) depth.push_back(depth[number] + 1);
        next[number].push_back(inserted.id);
      });
    }
    found.is_whole = next.size() == seen.size();
    found.has_cycle = has_cycle(next);
    return found;
  }

  // Whether there is a way; no where a few thousand states show none.
  bool may(Chance chance, StateView from, int units) {
    ++searches_;
    const std::size_t words = system_.word_count();
    VectorSet seen(words + 1);  // the state, and the time that is left
    StateVector entry(from.begin(), from.end());
    entry.push_back(static_cast<Word>(units));
    seen.insert(entry);
    for (std::uint32_t n = 0; n < seen.size() && n < kMostStates; ++n) {
      const StateView stored = seen[n];
      entry.assign(stored.begin(), stored.end());
      const StateView here(entry.data(), words);
      const int left = static_cast<int>(entry[words]);
      if (is_aim(here)) {
        if (chance == Chance::Comes) return true;
        continue;
      }
      bool is_over = true;  // nothing can happen, or the time may pass
      bool is_first = true;
      system_.successors(here, [&](StateView to, const Step& step) {
        const bool is_late = step.elapsed > left;
        is_over = is_first ? is_late : is_over || is_late;
        is_first = false;
        if (is_late) return;
        StateVector next(to.begin(), to.end());
        next.push_back(static_cast<Word>(left - step.elapsed));
        seen.insert(next);
      });
      if (is_over && chance == Chance::Avoids) return true;
    }
    return false;
  }

 private:
  void keep(StateView state) {
    states_.emplace_back(state.begin(), state.end());
  }
  bool is_aim(StateView state) const {
    return (labels_.label(state) & 1) == aimed_at_;
  }

  std::string event_of_step(std::size_t i, const Step& step) const {
    const Valuation& before = story_.run.state(i);
    const RunStep taken{step,
                        NetworkInterpreter(story_.network).after(before, step)};
    const auto fault = story_.network.fault;
    if (fault && taken.after.variables[index(*fault)] !=
                     before.variables[index(*fault)]) {
      return "";
    }
    const auto event = event_of(story_.tree, story_.network, before, taken);
    return event && event->is_chosen ? event->text : "";
  }

  // States that nothing leads to any more are taken away, as long as there are
  // any (Kahn 1962). What was not expanded is on no cycle that is known.
  static bool has_cycle(const std::vector<std::vector<std::uint32_t>>& next) {
    std::vector<std::uint32_t> leading(next.size(), 0);
    for (const auto& targets : next) {
      for (const std::uint32_t to : targets) {
        if (to < next.size()) ++leading[to];
      }
    }
    std::vector<std::uint32_t> ready;
    for (std::uint32_t n = 0; n < next.size(); ++n) {
      if (leading[n] == 0) ready.push_back(n);
    }
    for (std::size_t i = 0; i < ready.size(); ++i) {
      for (const std::uint32_t to : next[ready[i]]) {
        if (to < next.size() && --leading[to] == 0) ready.push_back(to);
      }
    }
    return ready.size() < next.size();
  }

  const Story& story_;
  CompiledNetwork system_;
  LabelledNetwork labels_;
  PropositionSet aimed_at_;
  std::vector<StateVector> states_;  // of the run
  int searches_ = 0;
};

std::string chosen(const Story& story, const Elsewhere& run, std::size_t step) {
  const std::string when = story.when(step);
  return run.event(step) + (when.empty() ? "" : " " + when);
}

// "fly -> success or fly -> running"; of many the first.
std::string either(std::vector<std::string> events) {
  constexpr std::size_t kMost = 3;
  if (events.size() > kMost) {
    const std::size_t more = events.size() - kMost + 1;
    events.resize(kMost);
    events.back() = fmt::format("{} others", more);
  }
  std::string text = events.front();
  for (std::size_t i = 1; i < events.size(); ++i) {
    text += (i + 1 == events.size() ? " or " : ", ") + events[i];
  }
  return text;
}

// The last choice in front of step `end` with which it went wrong, and the
// other answers with which it had not.
struct Turn {
  std::size_t step = 0;
  std::vector<std::string> right;
};

// `is_lost` is asked of what follows the choice, `is_right` of the state after
// another answer. Nothing where that is not known within the bounds.
template <class IsLost, class IsRight>
std::optional<Turn> last_turn(Elsewhere& run, std::size_t end, IsLost&& is_lost,
                              IsRight&& is_right) {
  for (std::size_t i = end; i-- > 0;) {
    const std::vector<Answer> others = run.others(i);
    if (others.empty()) continue;
    const Following after = run.following(run.state(i + 1), true);
    if (!after.is_whole || !is_lost(after)) return std::nullopt;
    Turn turn{i, {}};
    for (const Answer& other : others) {
      if (!run.may_search()) return std::nullopt;
      if (is_right(other.state)) turn.right.push_back(other.event);
    }
    if (!turn.right.empty()) return turn;
  }
  return std::nullopt;
}

// The last choice after which the state at the end was certain.
std::string made_certain(const Story& story, Elsewhere& run) {
  const std::size_t end = story.run.steps.size();
  const auto turn = last_turn(
      run, end, [](const Following& after) { return !after.has_cycle; },
      [&](StateView other) { return run.following(other, false).has_cycle; });
  if (!turn) return "";
  const std::string event = chosen(story, run, turn->step);
  if (turn->step + 1 == end) {
    return fmt::format(
        "{} breaks the rule; with {} it need not have been broken.", event,
        either(turn->right));
  }
  return fmt::format(
      "After {} the rule is broken whatever comes; with {} it need not have "
      "been.",
      event, either(turn->right));
}

// The same automaton takes no other choice in the loop.
bool is_always_so(const Story& story, const Elsewhere& run, std::size_t step) {
  for (std::size_t i = story.loop()->begin; i < story.loop()->end; ++i) {
    const bool is_other = story.mover(i) == story.mover(step) &&
                          !run.event(i).empty() &&
                          run.event(i) != run.event(step);
    if (is_other) return false;
  }
  return true;
}

// A choice with which the run could still have gone well up to this time: the
// last one from step `begin` on.
std::string within_time(const Story& story, const Aim& aim, Elsewhere& run,
                        std::size_t begin, int end) {
  const Chance chance = aim.is_wanted ? Chance::Comes : Chance::Avoids;
  for (std::size_t i = story.run.steps.size(); i-- > begin;) {
    std::vector<std::string> right;
    const int left = end - story.time(i);
    if (left < 0) continue;
    for (const Answer& other : run.others(i)) {
      if (!run.may_search()) break;
      if (run.may(chance, other.state, left)) right.push_back(other.event);
    }
    if (right.empty()) continue;
    const std::string event = chosen(story, run, i);
    if (aim.is_wanted) {
      return fmt::format(
          "After {} `{}` does not come in time; with {} it could.", event,
          aim.text, either(right));
    }
    if (i + 1 == story.run.steps.size()) {
      return fmt::format(
          "{} breaks the rule; with {} it would not be broken there.", event,
          either(right));
    }
    return fmt::format(
        "{} leads to it; with {} it could have been avoided there.", event,
        either(right));
  }
  return "";
}

// The choice in the loop with another answer that leads to what is missing the
// sooner.
std::string in_every_round(const Story& story, const Aim& aim, Elsewhere& run) {
  std::optional<std::uint32_t> nearest;
  std::string sentence;
  for (std::size_t i = story.loop()->begin; i < story.loop()->end; ++i) {
    const std::vector<Answer> others = run.others(i);
    if (others.empty() || !is_always_so(story, run, i)) continue;
    for (const Answer& other : others) {
      if (!run.may_search()) return sentence;
      const auto steps = run.following(other.state, true).nearest;
      if (!steps || (nearest && *steps >= *nearest)) continue;
      nearest = steps;
      sentence = fmt::format(
          "In every round there is {}; with {} there could be `{}`.",
          run.event(i), other.event, aim.text);
    }
  }
  return sentence;
}

// The last choice before the loop after which what is missing cannot come.
std::string made_impossible(const Story& story, const Aim& aim,
                            Elsewhere& run) {
  const auto turn = last_turn(
      run, story.loop()->begin,
      [](const Following& after) { return !after.nearest; },
      [&](StateView other) {
        return run.following(other, true).nearest.has_value();
      });
  if (!turn) return "";
  return fmt::format("After {} `{}` can never come; with {} it still could.",
                     chosen(story, run, turn->step), aim.text,
                     either(turn->right));
}

bool comes_in_loop(const Story& story, const Elsewhere& run) {
  for (std::size_t i = story.loop()->begin; i < story.loop()->end; ++i) {
    if (run.is_aimed_at(i)) return true;
  }
  return false;
}

}  // namespace

std::string nearest_right(const Story& story, const BrokenRule& broken,
                          std::optional<std::size_t> trigger_state) {
  const auto aim = aim_of(*broken.rule);
  if (!aim || story.run.steps.size() > kMostSteps) return "";
  if (aim->within && story.loop()) return "";
  const bool has_deadline = aim->within && trigger_state && !story.loop();
  if (!has_deadline && aim->is_wanted != story.loop().has_value()) return "";
  Elsewhere run(story, *aim);
  if (!run.has_run()) return "";
  if (has_deadline) {
    return within_time(story, *aim, run, *trigger_state,
                       story.time(*trigger_state) + *aim->within);
  }
  if (!aim->is_wanted) {
    const std::size_t end = story.run.steps.size();
    if (!run.is_aimed_at(end)) return "";
    const std::string sentence =
        broken.is_assumed ? "" : made_certain(story, run);
    return sentence.empty() ? within_time(story, *aim, run, 0, story.time(end))
                            : sentence;
  }
  if (aim->text.empty() || comes_in_loop(story, run)) return "";
  std::string sentence = in_every_round(story, *aim, run);
  return sentence.empty() ? made_impossible(story, *aim, run) : sentence;
}

}  // namespace btcheck

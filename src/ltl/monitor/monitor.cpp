// SPDX-License-Identifier: MIT
//
// A formula and its negation are translated; the powersets of both automata, of
// states that accept some word only, are run side by side. Where one of them is
// empty, no continuation is left on its side.
#include "ltl/monitor/monitor.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "ltl/buchi/deterministic.hpp"
#include "ltl/buchi/simplify.hpp"
#include "ltl/buchi/translate.hpp"

namespace btcheck {
namespace {

// The states that accept some word.
std::optional<BuchiAutomaton> words_of(FormulaPool& pool, FormulaId formula) {
  auto automaton = translate(pool, formula);
  if (automaton) clean_up(*automaton);
  return automaton;
}

Subset beginning_of(const BuchiAutomaton& automaton) {
  return automaton.is_empty() ? Subset{} : Subset{automaton.initial};
}

// Where runs that satisfy and runs that violate a claim may be.
using Sides = std::pair<Subset, Subset>;

Outlook outlook_of(const Sides& sides) {
  if (sides.first.empty()) {
    return sides.second.empty() ? Outlook::Excluded : Outlook::Violated;
  }
  return sides.second.empty() ? Outlook::Satisfied : Outlook::Open;
}

Monitor as_monitor(const Deterministic& automaton,
                   std::vector<PropositionSet> reads) {
  Deterministic smallest = minimised(automaton);
  Monitor monitor{std::move(reads), std::move(smallest.targets), {}};
  for (const std::uint32_t colour : smallest.colours) {
    monitor.outlook.push_back(static_cast<Outlook>(colour));
  }
  return monitor;
}

// Numbers what a monitor remembers, state by state: `after(memory, label)` is
// what follows where the outlook is open.
template <class Memory, class Look, class After>
std::optional<Deterministic> explored(Memory first,
                                      const std::vector<PropositionSet>& reads,
                                      Look look, After after) {
  if (reads.size() >= 32) return std::nullopt;
  if ((std::size_t{1} << reads.size()) > kMostMonitorLetters) {
    return std::nullopt;
  }
  const std::vector<PropositionSet> labels = labels_over(reads);
  std::map<Memory, std::uint32_t> numbers;
  std::vector<const Memory*> memories;
  Deterministic automaton;
  const auto number = [&](Memory memory) {
    const auto count = static_cast<std::uint32_t>(numbers.size());
    const auto [place, is_new] = numbers.emplace(std::move(memory), count);
    if (is_new) memories.push_back(&place->first);
    return place->second;
  };
  number(std::move(first));
  for (std::size_t i = 0; i < memories.size(); ++i) {
    const Outlook here = look(*memories[i]);
    automaton.colours.push_back(static_cast<std::uint32_t>(here));
    std::vector<std::uint32_t> row(labels.size(),
                                   static_cast<std::uint32_t>(i));
    for (std::size_t letter = 0; letter < labels.size(); ++letter) {
      if (here != Outlook::Open) break;
      row[letter] = number(after(*memories[i], labels[letter]));
    }
    automaton.targets.push_back(std::move(row));
    if (memories.size() * labels.size() > kMostMonitorEntries) {
      return std::nullopt;
    }
  }
  return automaton;
}

}  // namespace

bool Monitor::can_be(Outlook wanted) const {
  return std::ranges::find(outlook, wanted) != outlook.end();
}

std::optional<Monitor> monitor_of(FormulaPool& pool, FormulaId claim,
                                  FormulaId assumed) {
  const auto under = [&](FormulaId side) {
    return words_of(pool, pool.binary(FormulaKind::And, assumed, side));
  };
  const auto good = under(claim);
  const auto bad = under(pool.unary(FormulaKind::Not, claim));
  if (!good || !bad) return std::nullopt;
  std::vector<PropositionSet> reads = used_propositions(*good);
  const std::vector<PropositionSet> more = used_propositions(*bad);
  reads.insert(reads.end(), more.begin(), more.end());
  std::ranges::sort(reads);
  reads.erase(std::unique(reads.begin(), reads.end()), reads.end());
  const auto automaton =
      explored(Sides{beginning_of(*good), beginning_of(*bad)}, reads,
               outlook_of, [&](const Sides& sides, PropositionSet label) {
                 return Sides{after(*good, sides.first, label),
                              after(*bad, sides.second, label)};
               });
  if (!automaton) return std::nullopt;
  return as_monitor(*automaton, std::move(reads));
}

// --- Real time ---------------------------------------------------------------

namespace {

// The observer of a pattern guesses which occurrence is violated; here all
// guesses are followed at once. Of those that wait, the ones that cannot be
// violated unless another is are dropped, so that few are left.
class PatternMemory {
 public:
  using Modes = std::vector<Word>;  // ascending, each once; empty: satisfied

  PatternMemory(const TimedPattern& pattern, PropositionSet elapsed)
      : observer_(pattern), elapsed_(elapsed) {}

  Modes after(const Modes& modes, PropositionSet label) const {
    const Word elapsed = (label & elapsed_) != 0 ? 1 : 0;
    Modes found;
    for (const Word mode : modes) {
      observer_.follow(mode, elapsed, label, [&](Word next) {
        if (next != PatternObserver::kSatisfied) found.push_back(next);
      });
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return weakest(found);
  }

  // A run that stays in such modes for ever violates the pattern.
  bool is_due(const Modes& modes) const {
    return std::ranges::any_of(
        modes, [&](Word mode) { return observer_.is_due(mode); });
  }

  Outlook outlook(const Modes& modes) const {
    if (modes.empty()) return Outlook::Satisfied;
    return contains(modes, PatternObserver::kViolated) || is_torn(modes)
               ? Outlook::Violated
               : Outlook::Open;
  }

 private:
  static bool contains(const Modes& modes, Word mode) {
    return std::ranges::binary_search(modes, mode);
  }
  const TimedPattern& pattern() const { return observer_.pattern(); }

  // The ages that wait, ascending.
  static std::vector<Word> ages(const Modes& modes) {
    std::vector<Word> ages;
    for (const Word mode : modes) {
      if (PatternObserver::is_pending(mode)) {
        ages.push_back(PatternObserver::age(mode));
      }
    }
    return ages;
  }

  // One occurrence needs its first answer before another one may have it.
  bool is_torn(const Modes& modes) const {
    if (pattern().demand != Demand::FirstAnswer || pattern().closing != 0 ||
        pattern().to == kNoEnd) {
      return false;
    }
    const std::vector<Word> waiting = ages(modes);
    return !waiting.empty() && waiting.back() - waiting.front() >
                                   static_cast<Word>(pattern().to) -
                                       static_cast<Word>(pattern().from);
  }

  Modes weakest(const Modes& modes) const {
    if (contains(modes, PatternObserver::kViolated)) {
      return {PatternObserver::kViolated};
    }
    // The scope has only to close.
    if (contains(modes, PatternObserver::kBroken)) {
      return {PatternObserver::kBroken};
    }
    const std::vector<Word> waiting = ages(modes);
    Modes kept;
    for (const Word mode : modes) {
      if (!PatternObserver::is_pending(mode) ||
          matters(PatternObserver::age(mode), waiting)) {
        kept.push_back(mode);
      }
    }
    return kept;
  }

  // Whether an occurrence of this age can be violated where no other is that
  // waits. An answer in time for the older one is in time for the younger,
  // unless it comes too early for that; what must not be, must not be for the
  // longest time after the youngest.
  bool matters(Word age, const std::vector<Word>& waiting) const {
    const auto from = static_cast<Word>(pattern().from);
    switch (pattern().demand) {
      case Demand::Answer:
        return age < from || age == waiting.back();
      case Demand::FirstAnswer:
        return age == waiting.back() || (age < from && age == waiting.front());
      case Demand::NoAnswer:
        return age < from || age == first_from(from, waiting);
      case Demand::Lasting:
        return age == waiting.front();
    }
    return true;
  }

  static Word first_from(Word from, const std::vector<Word>& waiting) {
    return *std::ranges::lower_bound(waiting, from);
  }

  PatternObserver observer_;
  PropositionSet elapsed_;
};

// Where nothing that endangers the pattern can be reached, it is satisfied.
void settle_safe(Deterministic& automaton, std::vector<bool> endangered) {
  const auto violated = static_cast<std::uint32_t>(Outlook::Violated);
  for (std::size_t i = 0; i < endangered.size(); ++i) {
    if (automaton.colours[i] == violated) endangered[i] = true;
  }
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    for (std::size_t i = endangered.size(); i-- > 0;) {
      if (endangered[i]) continue;
      const auto& row = automaton.targets[i];
      endangered[i] = std::ranges::any_of(
          row, [&](std::uint32_t target) { return endangered[target]; });
      has_grown |= endangered[i];
    }
  }
  for (std::size_t i = 0; i < endangered.size(); ++i) {
    if (!endangered[i]) {
      automaton.colours[i] = static_cast<std::uint32_t>(Outlook::Satisfied);
    }
  }
}

}  // namespace

std::optional<Monitor> monitor_of(const TimedPattern& pattern,
                                  PropositionSet elapsed) {
  std::vector<PropositionSet> reads = {pattern.trigger, pattern.answer,
                                       pattern.opening, pattern.closing,
                                       elapsed};
  std::erase(reads, PropositionSet{0});
  std::ranges::sort(reads);
  reads.erase(std::unique(reads.begin(), reads.end()), reads.end());
  const PatternMemory memory(pattern, elapsed);
  std::vector<bool> is_due;
  auto automaton = explored(
      PatternMemory::Modes{PatternObserver::kShut}, reads,
      [&](const auto& modes) {
        is_due.push_back(memory.is_due(modes));
        return memory.outlook(modes);
      },
      [&](const auto& modes, PropositionSet label) {
        return memory.after(modes, label);
      });
  if (!automaton) return std::nullopt;
  settle_safe(*automaton, is_due);
  return as_monitor(*automaton, std::move(reads));
}

// --- Along a run -------------------------------------------------------------

MonitorRun::MonitorRun(const Monitor& monitor) : monitor_(&monitor) {
  settle();
}

void MonitorRun::settle() {
  const auto first = monitor_->outlook[states_.front()];
  const bool do_agree = std::ranges::all_of(states_, [&](std::uint32_t state) {
    return monitor_->outlook[state] == first;
  });
  outlook_ = do_agree ? first : Outlook::Open;
  is_torn_ = !do_agree;
}

void MonitorRun::follow(PropositionSet label, PropositionSet unknown) {
  const std::uint32_t open = monitor_->letter(unknown);
  const std::uint32_t known = monitor_->letter(label) & ~open;
  // Through all subsets of `open`.
  for (std::uint32_t way = open;; way = (way - 1) & open) {
    for (const std::uint32_t state : states_) {
      next_.push_back(monitor_->next[state][known | way]);
    }
    if (way == 0) break;
  }
  std::sort(next_.begin(), next_.end());
  next_.erase(std::unique(next_.begin(), next_.end()), next_.end());
}

Outlook MonitorRun::read(PropositionSet label, PropositionSet unknown) {
  next_.clear();
  follow(label, unknown);
  states_.swap(next_);
  settle();
  return outlook_;
}

Outlook MonitorRun::read_more(PropositionSet label, PropositionSet unknown) {
  for (std::size_t before = 0; before != states_.size();) {
    before = states_.size();
    next_ = states_;
    follow(label, unknown);
    states_.swap(next_);
  }
  settle();
  return outlook_;
}

}  // namespace btcheck

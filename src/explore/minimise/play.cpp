// SPDX-License-Identifier: MIT
//
// The partition is refined round by round by signatures (Blom and Orzan 2003):
// what a state can do after silent steps within its block. The round that tells
// two states apart is how many moves that takes, and a signature that only one
// of them has is the move. (Where silent steps are answered by several ones the
// count is that of signatures, not of single steps.)
#include "explore/minimise/play.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>

#include "text/budget.hpp"

namespace btcheck {
namespace {

using Blocks = std::vector<std::uint32_t>;  // by state

// One thing that a state can do.
struct Option {
  std::uint32_t label = LabelledGraph::kSilent;
  std::uint32_t target = 0;  // a state; in a signature its block
  bool diverges = false;     // it stays where it is for ever, unseen

  friend auto operator<=>(const Option&, const Option&) = default;
};

class Approximants {
 public:
  Approximants(const LabelledGraph& graph, std::uint32_t first,
               std::uint32_t second)
      : graph_(graph), seen_(graph.size(), 0) {
    rounds_.emplace_back(graph.size(), 0);
    while (rounds_.back()[first] == rounds_.back()[second]) {
      const auto before = std::ranges::max(rounds_.back());
      refine();
      // Two states of a quotient are told apart some time.
      const bool goes_on = std::ranges::max(rounds_.back()) != before;
      assert(goes_on);
      if (!goes_on) break;
    }
  }

  // In how many rounds the two are told apart; at most all of them.
  std::size_t level(std::uint32_t one, std::uint32_t other) const {
    std::size_t k = 0;
    while (k < rounds_.size() && rounds_[k][one] == rounds_[k][other]) ++k;
    return k;
  }

  // What can be done after silent steps within the block of round `k`.
  std::vector<Option> options(std::uint32_t state, std::size_t k) {
    const Blocks& block = rounds_[k];
    std::vector<Option> all;
    Blocks open = {state};
    ++search_;
    seen_[state] = search_;
    for (std::size_t i = 0; i < open.size(); ++i) {
      ask_budget();
      for (const LabelledGraph::Arc& arc : graph_.arcs(open[i])) {
        const bool is_silent = arc.label == LabelledGraph::kSilent;
        if (is_silent && arc.target == open[i]) {
          all.push_back({arc.label, state, true});
        } else if (is_silent && block[arc.target] == block[state]) {
          if (std::exchange(seen_[arc.target], search_) == search_) continue;
          open.push_back(arc.target);
        } else {
          all.push_back({arc.label, arc.target});
        }
      }
    }
    return all;
  }

  // The same by blocks.
  Option seen_as(Option option, std::size_t k) const {
    option.target = option.diverges ? 0 : rounds_[k][option.target];
    return option;
  }

 private:
  void refine() {
    const std::size_t k = rounds_.size() - 1;
    std::map<std::pair<std::uint32_t, std::vector<Option>>, std::uint32_t>
        known;
    Blocks next;
    for (std::uint32_t s = 0; s < graph_.size(); ++s) {
      std::vector<Option> signature = options(s, k);
      for (Option& each : signature) each = seen_as(each, k);
      std::ranges::sort(signature);
      signature.erase(std::unique(signature.begin(), signature.end()),
                      signature.end());
      const auto number = static_cast<std::uint32_t>(known.size());
      next.push_back(
          known.emplace(std::pair(rounds_[k][s], std::move(signature)), number)
              .first->second);
    }
    rounds_.push_back(std::move(next));
  }

  const LabelledGraph& graph_;
  std::vector<Blocks> rounds_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t search_ = 0;
};

class Play {
 public:
  Play(const LabelledGraph& graph, std::uint32_t first, std::uint32_t second)
      : approximants_(graph, first, second), first_(first), second_(second) {}

  std::vector<PlayRound> take() {
    std::vector<PlayRound> rounds;
    for (bool goes_on = true; goes_on;) {
      const std::size_t level = approximants_.level(first_, second_);
      if (level == 0) break;  // it cannot be
      goes_on = move(level - 1, rounds);
    }
    return rounds;
  }

 private:
  using Kind = PlayRound::Kind;

  // One round, of the side that has what the other has not in round `k`.
  bool move(std::size_t k, std::vector<PlayRound>& rounds) {
    const auto of_first = approximants_.options(first_, k);
    const auto of_second = approximants_.options(second_, k);
    for (const bool is_of_first : {true, false}) {
      const auto& own = is_of_first ? of_first : of_second;
      const auto& answers = is_of_first ? of_second : of_first;
      for (const Option& option : own) {
        const bool is_answered =
            std::ranges::any_of(answers, [&](const Option& each) {
              return approximants_.seen_as(each, k) ==
                     approximants_.seen_as(option, k);
            });
        if (!is_answered) return play(option, is_of_first, answers, rounds);
      }
    }
    return false;
  }

  // Returns whether it goes on. The other side answers so that it lasts.
  bool play(const Option& option, bool is_of_first,
            const std::vector<Option>& answers,
            std::vector<PlayRound>& rounds) {
    const std::uint32_t mover = is_of_first ? first_ : second_;
    const std::uint32_t other = is_of_first ? second_ : first_;
    const bool is_silent = option.label == LabelledGraph::kSilent;
    std::optional<std::uint32_t> best;  // where the other side is then
    std::size_t longest = 0;
    bool yields = false;
    const auto offer = [&](std::uint32_t from, std::uint32_t at,
                           bool yielding) {
      const std::size_t level = approximants_.level(from, at);
      if (best && level <= longest) return;
      best = at;
      longest = level;
      yields = yielding;
    };
    if (option.diverges) {
      // Only by a choice can it stay unseen as long.
      for (const Option& each : answers) {
        if (each.label == LabelledGraph::kSilent && !each.diverges) {
          offer(mover, each.target, true);
        }
      }
    } else {
      if (is_silent) offer(option.target, other, false);
      for (const Option& each : answers) {
        if (each.label != option.label || each.diverges) continue;
        offer(option.target, each.target, false);
      }
      if (!best) {
        for (const Option& each : answers) {
          if (each.label == LabelledGraph::kSilent && !each.diverges) {
            offer(mover, each.target, true);
          }
        }
      }
    }
    if (!best) {
      rounds.push_back({option.diverges ? Kind::Stays : Kind::Wins, is_of_first,
                        option.label});
      return false;
    }
    if (yields) {
      rounds.push_back({Kind::Yields, !is_of_first, option.label});
    } else {
      rounds.push_back(
          {is_silent ? Kind::Settles : Kind::Moves, is_of_first, option.label});
    }
    const std::uint32_t moved = yields ? mover : option.target;
    first_ = is_of_first ? moved : *best;
    second_ = is_of_first ? *best : moved;
    return true;
  }

  Approximants approximants_;
  std::uint32_t first_;
  std::uint32_t second_;
};

}  // namespace

std::vector<PlayRound> distinguishing_play(const LabelledGraph& graph,
                                           std::uint32_t first,
                                           std::uint32_t second) {
  return Play(graph, first, second).take();
}

}  // namespace btcheck

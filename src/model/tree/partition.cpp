// SPDX-License-Identifier: MIT
//
// Pieces of a range are halved until interval arithmetic knows how each comes
// out of every comparison, and in which region each assignment puts it: a
// threshold is found in as many steps as its number has bits. Pieces that come
// out alike are one region; this is repeated until no region falls apart.
#include "model/tree/partition.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace btcheck {
namespace {

// Pieces looked at before a number's values are all told apart.
constexpr std::uint64_t kMostWork = 300'000;

// A stretch of values that belong to one region.
struct Piece {
  ValueRange values;
  std::size_t region = 0;
};

// A number as far as it is split.
struct Split {
  std::vector<Piece> pieces = {};  // ascending, without gaps
  std::size_t regions = 1;
  std::uint64_t work = 0;  // pieces looked at

  const Piece* piece_with(std::int64_t value) const {
    const auto found = std::ranges::lower_bound(
        pieces, value, {},
        [](const Piece& piece) { return piece.values.high; });
    const bool is_there = found != pieces.end() && found->values.has(value);
    return is_there ? &*found : nullptr;
  }
};

template <class Value>
void add_new(std::vector<Value>& to, Value value) {
  if (std::ranges::find(to, value) == to.end()) to.push_back(std::move(value));
}

class Partition {
 public:
  explicit Partition(std::vector<PartitionedNumber> numbers)
      : numbers_(std::move(numbers)), splits_(numbers_.size()) {}

  // Until these numbers are split, or given up, and all that they are assigned
  // to.
  void run(std::span<const std::size_t> wanted) {
    leave_out_others(wanted);
    while (!is_stable()) {
      const auto hardest = std::ranges::max_element(splits_, {}, &Split::work);
      numbers_[static_cast<std::size_t>(hardest - splits_.begin())].is_whole =
          true;
    }
  }

  bool is_whole(std::size_t number) const { return numbers_[number].is_whole; }

  std::vector<int> samples(std::size_t number) const {
    using Rank = std::tuple<int, std::int64_t, std::int64_t>;
    const Split& split = splits_[number];
    std::map<std::size_t, Rank> best;
    const std::int64_t initial = numbers_[number].initial;
    const auto offer = [&](std::size_t region, int kind, std::int64_t value) {
      const Rank rank{kind, std::max(value - initial, initial - value), value};
      const auto [known, is_new] = best.emplace(region, rank);
      if (!is_new) known->second = std::min(known->second, rank);
    };
    for (const Piece& piece : split.pieces) {
      const auto& [low, high] = piece.values;
      const std::int64_t nearest = std::clamp(initial, low, high);
      offer(piece.region, nearest == initial ? 0 : 2, nearest);
    }
    for (const std::int64_t value : numbers_[number].constants) {
      const Piece* piece = split.piece_with(value);
      if (piece != nullptr) offer(piece->region, 1, value);
    }
    std::vector<int> values;
    for (const auto& [region, rank] : best) {
      values.push_back(static_cast<int>(std::get<2>(rank)));
    }
    std::ranges::sort(values);
    return values;
  }

 private:
  void leave_out_others(std::span<const std::size_t> wanted) {
    std::vector<std::size_t> open(wanted.begin(), wanted.end());
    std::vector<bool> is_needed(numbers_.size());
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      if (is_needed[at]) continue;
      is_needed[at] = true;
      for (const NumberMove& move : numbers_[at].moves) {
        if (move.to) open.push_back(*move.to);
      }
    }
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      numbers_[i].is_whole = numbers_[i].is_whole || !is_needed[i];
    }
  }

  // From one region each until none falls apart; false where that is too much
  // work.
  bool is_stable() {
    work_ = 0;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      splits_[i] = {};
      if (!numbers_[i].is_whole) splits_[i].pieces = {{numbers_[i].values, 0}};
    }
    for (bool falls_apart = true; falls_apart;) {
      falls_apart = false;
      for (std::size_t i = 0; i < numbers_.size(); ++i) {
        if (numbers_[i].is_whole) continue;
        const std::size_t before = splits_[i].regions;
        if (!refine(numbers_[i], splits_[i])) return false;
        falls_apart = falls_apart || splits_[i].regions != before;
      }
    }
    return true;
  }

  bool refine(const PartitionedNumber& number, Split& split) {
    std::vector<Piece> refined;
    std::map<std::vector<std::int64_t>, std::size_t> regions;
    for (const Piece& piece : split.pieces) {
      std::vector<ValueRange> open = {piece.values};
      while (!open.empty()) {
        ++split.work;
        if (++work_ > kMostWork) return false;
        const ValueRange values = open.back();
        open.pop_back();
        std::vector<std::int64_t> outcome = {
            static_cast<std::int64_t>(piece.region)};
        if (!add_outcome(number, values, outcome)) {
          assert(!values.is_one());
          const std::int64_t middle =
              values.low + (values.high - values.low) / 2;
          open.push_back({middle + 1, values.high});
          open.push_back({values.low, middle});
          continue;
        }
        const std::size_t region =
            regions.emplace(std::move(outcome), regions.size()).first->second;
        if (!refined.empty() && refined.back().region == region) {
          refined.back().values.high = values.high;
        } else {
          refined.push_back({values, region});
        }
      }
    }
    split.pieces = std::move(refined);
    split.regions = regions.size();
    return true;
  }

  // How these values come out of each comparison and assignment; false where
  // not all come out alike, or it is not known.
  bool add_outcome(const PartitionedNumber& number, ValueRange values,
                   std::vector<std::int64_t>& outcome) const {
    for (const std::vector<Term>& atom : number.atoms) {
      const ValueRange truth = range_of(atom, values);
      const bool is_true = !truth.has(0);
      if (!is_true && !truth.is_one()) return false;
      outcome.push_back(is_true);
    }
    return std::ranges::all_of(number.moves, [&](const NumberMove& move) {
      const auto target = place_of(move, range_of(move.value, values));
      if (target) outcome.push_back(*target);
      return target.has_value();
    });
  }

  // The region of these values of the target, or the only value; one number for
  // all that lie out of its range, which ends the run.
  std::optional<std::int64_t> place_of(const NumberMove& move,
                                       ValueRange values) const {
    constexpr auto kOutside = std::numeric_limits<std::int64_t>::min();
    if (values.high < move.within.low || values.low > move.within.high) {
      return kOutside;
    }
    if (!move.to || numbers_[*move.to].is_whole) {
      return values.is_one() ? std::optional(values.low) : std::nullopt;
    }
    const Piece* piece = splits_[*move.to].piece_with(values.low);
    if (piece == nullptr || !piece->values.has(values.high)) {
      return std::nullopt;
    }
    return static_cast<std::int64_t>(piece->region);
  }

  std::vector<PartitionedNumber> numbers_;
  std::vector<Split> splits_;  // of each
  std::uint64_t work_ = 0;
};

}  // namespace

void PartitionedNumber::add_atom(std::span<const Term> atom) {
  add_new(atoms, std::vector<Term>(atom.begin(), atom.end()));
}

void PartitionedNumber::add_move(NumberMove move) {
  add_new(moves, std::move(move));
}

std::vector<std::optional<std::vector<int>>> representatives(
    std::vector<PartitionedNumber> numbers,
    std::span<const std::size_t> wanted) {
  std::vector<std::optional<std::vector<int>>> all(numbers.size());
  Partition partition(std::move(numbers));
  partition.run(wanted);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!partition.is_whole(i)) all[i] = partition.samples(i);
  }
  return all;
}

}  // namespace btcheck

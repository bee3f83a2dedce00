// SPDX-License-Identifier: MIT
//
// The halves that occur are counted for every cut at once: a state's groups of
// variables are hashed one by one, the sum of the first k hashes stands for the
// low half at cut k, what is left of the total for the high one. Distinct sums
// are counted by the bits that they set in a bitmap (linear counting: Whang,
// Vander-Zanden, Taylor 1990). The states are those of breadth-first searches
// that expand only some of each depth: they see every phase of a mission, while
// random runs mostly fail early. What such a search sees of a half says little
// of how many there are: a large half looks small where its states come in
// families. So there are two searches, and how much of what one has seen the
// other sees again tells the rest (capture and recapture: Lincoln 1930).
#include "explore/halves/cut.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "explore/halves/pair_coding.hpp"
#include "explore/store/in_parallel.hpp"
#include "explore/store/state_store.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kBeam = 128;  // states expanded of each depth
constexpr std::size_t kMostStates = 400'000;
constexpr std::size_t kMostWords = std::size_t{1} << 22;  // in all of them
// Of groups of variables, in all states that are expanded: about a second.
constexpr std::size_t kMostLooks = 8'000'000;

Word mixed(Word word) { return ExactCoding().scatter(word) ^ (word >> 7); }

// Estimates how many different numbers it was shown.
class DistinctCount {
 public:
  void show(Word number) {
    const std::size_t bit = mixed(number) >> (64 - kBits);
    words_[bit / 64] |= Word{1} << (bit % 64);
  }
  double estimate() const { return estimate_with(*this); }
  // Of those that either was shown.
  double estimate_with(const DistinctCount& other) const {
    int set = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      set += std::popcount(words_[i] | other.words_[i]);
    }
    const double unset = std::max(1, kSize - set);
    return kSize * std::log(kSize / unset);
  }

 private:
  static constexpr int kBits = 16;
  static constexpr int kSize = 1 << kBits;
  std::vector<Word> words_ = std::vector<Word>(kSize / 64);
};

// The bits of each group, as masks of the words they lie in.
struct GroupMask {
  std::uint32_t word;
  Word mask;
};
using GroupMasks = std::vector<std::vector<GroupMask>>;

GroupMasks masks_of(const CompiledNetwork& system) {
  GroupMasks masks;
  for (const std::vector<Field>& fields : system.layout().groups) {
    auto& group = masks.emplace_back();
    for (const Field& field : fields) {
      const auto known = std::find_if(
          group.begin(), group.end(),
          [&](const GroupMask& mask) { return mask.word == field.word; });
      if (known == group.end()) {
        group.push_back({field.word, field.mask()});
      } else {
        known->mask |= field.mask();
      }
    }
  }
  return masks;
}

// How many there are in all, of which two have drawn some each.
double recaptured(const DistinctCount& one, const DistinctCount& other) {
  const double first = one.estimate();
  const double second = other.estimate();
  const double common = first + second - one.estimate_with(other);
  return first * second / std::max(1.0, common);
}

// Shown states, counts their halves at every cut; of thousands of cuts at
// some.
class HalfCensus {
 public:
  explicit HalfCensus(const CompiledNetwork& system)
      : masks_(masks_of(system)),
        stride_(masks_.size() / kMostCuts + 1),
        hashes_(masks_.size()),
        low_(masks_.size() / stride_ + 1),
        high_(low_.size()) {}

  std::size_t groups() const { return masks_.size(); }

  void show(StateView state) {
    Word total = 0;
    for (std::size_t g = 0; g < masks_.size(); ++g) {
      Word hash = g + 1;
      for (const GroupMask& mask : masks_[g]) {
        hash = mixed(hash ^ (state[mask.word] & mask.mask));
      }
      hashes_[g] = mixed(hash);
      total += hashes_[g];
    }
    Word low = 0;
    std::size_t cut = 0;
    for (std::size_t shown = 0; shown < low_.size(); ++shown) {
      for (; cut < shown * stride_; ++cut) low += hashes_[cut];
      low_[shown].show(low);
      high_[shown].show(total - low);
    }
  }

  // With as few halves as possible, as far as the two can tell.
  std::size_t best_with(const HalfCensus& other) const {
    std::vector<double> halves;
    for (std::size_t cut = 0; cut < low_.size(); ++cut) {
      halves.push_back(recaptured(low_[cut], other.low_[cut]) +
                       recaptured(high_[cut], other.high_[cut]));
    }
    return stride_ * static_cast<std::size_t>(std::ranges::min_element(halves) -
                                              halves.begin());
  }

 private:
  static constexpr std::size_t kMostCuts = 512;

  GroupMasks masks_;
  std::size_t stride_;
  std::vector<Word> hashes_;
  std::vector<DistinctCount> low_;  // by cut, of each stride the first
  std::vector<DistinctCount> high_;
};

// Breadth first from the initial state, but of each depth only some states are
// expanded, chosen at random: these the census is shown.
void explore_beam(const CompiledNetwork& system, Word random,
                  HalfCensus& census) {
  VectorSet states(system.word_count());
  std::vector<std::uint32_t> depth;
  const auto found = [&](StateView state) {
    const auto [number, is_new] = states.insert(state);
    if (is_new) depth.push_back(number);
  };
  system.initial_states(found);
  StateVector state;
  std::size_t looks = 0;
  const std::size_t most =
      std::min(kMostStates, kMostWords / system.word_count());
  while (!depth.empty() && states.size() < most && looks < kMostLooks) {
    std::vector<std::uint32_t> expanded = std::exchange(depth, {});
    for (std::size_t i = 0;
         i < expanded.size() && i < kBeam && states.size() < most; ++i) {
      random = mixed(random + 0x9e3779b97f4a7c15ull);
      std::swap(expanded[i], expanded[i + random % (expanded.size() - i)]);
      const StateView chosen = states[expanded[i]];
      state.assign(chosen.begin(), chosen.end());
      census.show(state);
      looks += census.groups();
      system.successors(state, [&](StateView target, Step) { found(target); });
    }
  }
}

}  // namespace

std::size_t best_cut(const CompiledNetwork& system, unsigned threads) {
  HalfCensus one(system);
  HalfCensus other(system);
  tbb::task_arena arena(threads > 1 ? tbb::task_arena::automatic : 1);
  arena.execute([&] {
    in_parallel(2, [&](std::size_t i) {
      explore_beam(system, i + 1, i == 0 ? one : other);
    });
  });
  return one.best_with(other);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "ltl/product/strong_fairness.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace btcheck {

namespace {

constexpr std::size_t kWordBits = std::numeric_limits<Word>::digits;

}  // namespace

MarkTable::MarkTable(std::size_t conditions)
    : words_(conditions / kWordBits + 1),
      both_(2 * words_),
      marks_(2 * words_) {
  marks_.insert(both_);
}

std::uint32_t MarkTable::number(const boost::dynamic_bitset<>& requested,
                                const boost::dynamic_bitset<>& granted) {
  static_assert(boost::dynamic_bitset<>::bits_per_block == kWordBits);
  assert(requested.num_blocks() <= words_ && granted.num_blocks() <= words_);
  boost::to_block_range(requested, both_.begin());
  boost::to_block_range(granted,
                        both_.begin() + static_cast<std::ptrdiff_t>(words_));
  return marks_.insert(both_).id;
}

bool ConditionTally::add(std::uint32_t marks) {
  const StateView requested = table_->requested(marks);
  const StateView granted = table_->granted(marks);
  Word news = 0;
  for (std::size_t i = 0; i < requested_.size(); ++i) {
    requested_[i] |= requested[i];
    news |= granted[i] & ~granted_[i];
    granted_[i] |= granted[i];
  }
  return news != 0;
}

void ConditionTally::add_unanswered(const ConditionTally& other) {
  for (std::size_t i = 0; i < requested_.size(); ++i) {
    requested_[i] |= other.requested_[i] & ~other.granted_[i];
  }
}

bool ConditionTally::is_fair() const { return !is_missing_one_of(requested_); }

bool ConditionTally::requests_in_vain(std::uint32_t marks) const {
  return is_missing_one_of(table_->requested(marks));
}

bool ConditionTally::grants_missing(std::uint32_t marks) const {
  return is_missing_one_of(table_->granted(marks));
}

bool ConditionTally::is_missing_one_of(StateView conditions) const {
  for (std::size_t i = 0; i < requested_.size(); ++i) {
    if ((conditions[i] & requested_[i] & ~granted_[i]) != 0) return true;
  }
  return false;
}

std::uint32_t StateMarks::number(StateId state) {
  if (!has_conditions()) return MarkTable::kNothing;
  if (index(state) >= numbers_.size()) {
    numbers_.resize(index(state) + 1, kUnknown);
  }
  std::uint32_t& number = numbers_[index(state)];
  if (number == kUnknown) number = asked(state);
  return number;
}

std::uint32_t StateMarks::asked(StateId state) {
  present_.resize(store_.word_count());
  store_.load(state, present_);
  requested_.reset();
  granted_.reset();
  requested_.resize(fairness_.size);
  granted_.resize(fairness_.size);
  fairness_.mark(present_, requested_, granted_);
  return table_.number(requested_, granted_);
}

}  // namespace btcheck

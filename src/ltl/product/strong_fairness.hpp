// SPDX-License-Identifier: MIT
//
// Strong fairness: what is requested for ever is also granted for ever.
//
// A condition is a pair of predicates on states. A run is strongly fair when
// each condition that is requested infinitely often is granted infinitely
// often: Streett acceptance (Streett 1982; Francez, "Fairness", 1986). There
// may be hundreds of conditions, two for each action of a tree, far more than
// an automaton could carry: they never become part of a formula, but say which
// components hold a fair run (component_refinement.hpp). What a state requests
// and grants, its marks, recurs: equal marks are kept once, under a number.
#pragma once

#include <boost/dynamic_bitset.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "explore/store/growing_array.hpp"
#include "explore/store/state_store.hpp"

namespace btcheck {

// Conditions on the states of the system that is searched (of a product its
// last word included). `mark` is given both sets with `size` bits, none of them
// set, and sets those of the conditions that the state requests and grants.
// Without conditions every run is fair.
struct StrongFairness {
  std::size_t size = 0;
  std::function<void(StateView state, boost::dynamic_bitset<>& requested,
                     boost::dynamic_bitset<>& granted)>
      mark = {};
};
inline const StrongFairness kEveryRunIsFair;

// Marks that occur, numbered.
class MarkTable {
 public:
  // The number of the marks that request and grant nothing.
  static constexpr std::uint32_t kNothing = 0;

  explicit MarkTable(std::size_t conditions);

  // Both of as many bits as there are conditions.
  std::uint32_t number(const boost::dynamic_bitset<>& requested,
                       const boost::dynamic_bitset<>& granted);

  // One bit for each condition. Valid until the next new number.
  StateView requested(std::uint32_t number) const {
    return marks_[number].first(words_);
  }
  StateView granted(std::uint32_t number) const {
    return marks_[number].last(words_);
  }

  std::size_t word_count() const { return words_; }  // of each of the two
  std::size_t bytes() const { return marks_.bytes(); }

 private:
  std::size_t words_;
  std::vector<Word> both_;
  VectorSet marks_;
};

// What the states of a walk, or of a component, request and grant together.
class ConditionTally {
 public:
  // The table must outlive it.
  explicit ConditionTally(const MarkTable& table)
      : table_(&table),
        requested_(table.word_count()),
        granted_(table.word_count()) {}

  // One state more. True when it grants what no state before it did.
  bool add(std::uint32_t marks);
  // Requests what the other tally requests in vain.
  void add_unanswered(const ConditionTally& other);

  // All that is requested is granted too.
  bool is_fair() const;
  // Marks that request what is requested here in vain, or that grant it.
  bool requests_in_vain(std::uint32_t marks) const;
  bool grants_missing(std::uint32_t marks) const;

 private:
  bool is_missing_one_of(StateView conditions) const;

  const MarkTable* table_;
  std::vector<Word> requested_;
  std::vector<Word> granted_;
};

// The marks of stored states, asked for when they are first needed.
class StateMarks {
 public:
  // Both must outlive it.
  StateMarks(const StrongFairness& fairness, const StateStore& store)
      : fairness_(fairness), store_(store), table_(fairness.size) {}

  bool has_conditions() const { return fairness_.size > 0; }
  // The number of the marks of a state.
  std::uint32_t number(StateId state);

  const MarkTable& table() const { return table_; }
  std::size_t bytes() const { return table_.bytes() + numbers_.bytes(); }

 private:
  static constexpr std::uint32_t kUnknown = UINT32_MAX;

  std::uint32_t asked(StateId state);

  const StrongFairness& fairness_;
  const StateStore& store_;
  MarkTable table_;
  GrowingArray<std::uint32_t> numbers_;  // by state
  StateVector present_;
  boost::dynamic_bitset<> requested_;
  boost::dynamic_bitset<> granted_;
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Small random trees as .btf text, and the smallest one that still fails.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck::reference {

// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  // A number in [0, bound), bound >= 1.
  int below(int bound);
  bool percent(int chance) { return below(100) < chance; }

 private:
  std::uint64_t state_;
};

// How likely each ingredient is, in percent unless said otherwise. The
// defaults make halts frequent and state spaces small.
struct RandomTreeWeights {
  int min_nodes = 2;  // the root included
  int max_nodes = 9;
  int max_depth = 4;  // of control nodes above a leaf
  int max_variables = 2;
  int max_parallels = 1;   // per tree
  int max_running = 3;     // leaves per tree that may answer running
  int halting_top = 70;    // a node that halts stands below the root
  int halt_option = 70;    // :halt 1 on reactive and parallel nodes
  int wait_option = 25;    // :wait 1 on the same
  int guard_first = 60;    // a reactive node begins with a leaf that decides
  int runs_below = 40;     // a leaf below such a node is an Action or Wait
  int contract = 20;       // of an Action or Condition
  int duration = 20;       // of an Action that may run
  int sampled = 50;        // an enumeration says :moves sampled
  int leaving_range = 35;  // an assignment may leave the variable's range
  int looping_root = 40;   // :loop 1
  int number = 40;         // a variable is no enumeration
  int most_number = 2;     // the greatest :max of a number, not in percent
  int timed_moves = 0;     // a free enumeration moves in its own time
  int computed = 0;        // a number is sampled, computed and compared freely
  int moving_number = 0;   // a number moves by itself
  int decided = 0;         // a contract says :succeeds-when
};

// Of trees with all there is, several at a time.
inline RandomTreeWeights large_trees() {
  RandomTreeWeights large;
  large.max_nodes = 16;
  large.max_parallels = 3;
  large.max_running = 6;
  large.duration = 40;
  large.looping_root = 90;
  large.leaving_range = 60;
  return large;
}

// Small ones with weather that takes its time.
inline RandomTreeWeights timed_weather() {
  RandomTreeWeights weathered;
  weathered.max_nodes = 6;
  weathered.number = 10;
  weathered.sampled = 10;
  weathered.timed_moves = 80;
  return weathered;
}

// The text of a tree; equal for equal arguments, on every machine.
std::string random_tree(std::uint64_t seed,
                        const RandomTreeWeights& weights = {});

// A text from which nothing can be taken such that it still fails: subtrees,
// options, variables, parts of expressions go one after another, numbers get
// smaller. `fails(text)` must hold; it must be false for what cannot be read.
std::string shrink(const std::string& text,
                   const std::function<bool(const std::string&)>& fails);

// A .btf text as nested lists of words; what the two functions work on.
struct SExpression {
  std::string word;               // empty for a list
  std::vector<SExpression> list;  // empty for a word
  bool is_list = false;

  friend bool operator==(const SExpression&, const SExpression&) = default;
};
// Comments are dropped; a missing parenthesis is supplied at the end.
SExpression parse_s_expression(std::string_view text);
// One node or definition per line.
std::string print_s_expression(const SExpression& expression);

}  // namespace btcheck::reference

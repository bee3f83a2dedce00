// SPDX-License-Identifier: MIT
//
// What a piece of work may take, from the first byte that is read to the last
// line that is told.
//
// Whoever begins the work makes a Budget and installs it in its thread by a
// BudgetScope: two checks in two threads have two budgets. A stage says by a
// Stage what is being done, and its loops call ask_budget(), which throws
// BudgetSpent when nothing is left. It is caught where what has been found by
// then can still be told, and nowhere else: at the rim of a command, around
// what is done beside an answer, and around each entry of a batch. Searches do
// not throw: they ask their Limits, behind which the same budget stands.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>

namespace btcheck {

enum class Spent : std::uint8_t { Nothing, Time, Memory, Interrupted };

class Budget {
 public:
  Budget() = default;
  virtual ~Budget() = default;
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  // What is used up now.
  virtual Spent look() = 0;

  // What is done now: "the rules were bound to the tree". May be asked by any
  // thread.
  const char* doing() const { return doing_; }

 private:
  friend class Stage;
  std::atomic<const char*> doing_ = "the command began";
};

class BudgetSpent : public std::exception {
 public:
  BudgetSpent(Spent what, const char* doing) : what_(what), doing_(doing) {}

  Spent spent() const { return what_; }
  const char* doing() const { return doing_; }
  const char* what() const noexcept override { return "the budget is spent"; }

 private:
  Spent what_;
  const char* doing_;
};

// The budget of this thread while the scope lives; nullptr: nobody asks, for
// what has to be finished. A thread begins without one.
class BudgetScope {
 public:
  explicit BudgetScope(Budget* budget);
  ~BudgetScope();
  BudgetScope(const BudgetScope&) = delete;
  BudgetScope& operator=(const BudgetScope&) = delete;

 private:
  Budget* before_;
};

// What this thread does while the stage lives, as a clause in the past that
// follows "while": a text that lives for ever. Looks at the budget first.
class Stage {
 public:
  explicit Stage(const char* doing);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  Budget* budget_;
  const char* before_ = nullptr;
};

// Throws BudgetSpent where the budget of this thread is used up. Looks at each
// kAsksPerLook-th call: a call costs as much as an addition, so that it may
// stand in any loop whose rounds take less than a millisecond.
inline constexpr std::uint32_t kAsksPerLook = 32;
void ask_budget();

// Looks at once, before or in rounds that take longer.
void look_at_budget();

}  // namespace btcheck

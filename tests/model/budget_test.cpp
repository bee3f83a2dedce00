// SPDX-License-Identifier: MIT
//
// A budget is asked by the thread that it was given to, and by no other.
#include "text/budget.hpp"

#include <doctest/doctest.h>

#include <string>
#include <thread>

namespace btcheck::budget_test {
namespace {

// Has so many looks.
class Looks : public Budget {
 public:
  explicit Looks(int count, Spent spent = Spent::Time)
      : left_(count), spent_(spent) {}
  Spent look() override { return left_-- > 0 ? Spent::Nothing : spent_; }
  int left() const { return left_; }

 private:
  int left_;
  Spent spent_;
};

// How often it can be asked before it is spent.
int asked_before_spent(Budget& budget, int most) {
  const BudgetScope scope(&budget);
  int asked = 0;
  try {
    for (; asked < most; ++asked) ask_budget();
  } catch (const BudgetSpent&) {
  }
  return asked;
}

TEST_CASE("without a budget nobody is stopped") {
  for (int i = 0; i < 1000; ++i) ask_budget();
  look_at_budget();
  const Stage stage("nothing was done");
}

TEST_CASE("it is looked at now and then, and stops what goes on") {
  Looks budget(10);
  const int asked = asked_before_spent(budget, 100'000);
  CHECK(asked >= 10 * static_cast<int>(kAsksPerLook));
  CHECK(asked < 11 * static_cast<int>(kAsksPerLook));
}

TEST_CASE("what is told is the stage in which it was spent") {
  Looks budget(2, Spent::Memory);
  const BudgetScope scope(&budget);
  std::string doing;
  try {
    const Stage outer("the tree was read");
    {
      const Stage inner("the names were looked up");
      CHECK(std::string(budget.doing()) == "the names were looked up");
    }
    CHECK(std::string(budget.doing()) == "the tree was read");
    look_at_budget();
  } catch (const BudgetSpent& spent) {
    CHECK(spent.spent() == Spent::Memory);
    doing = spent.doing();
  }
  CHECK(doing == "the tree was read");
}

TEST_CASE("a stage does not begin where nothing is left") {
  Looks budget(0, Spent::Interrupted);
  const BudgetScope scope(&budget);
  try {
    const Stage stage("the rules were bound");
    FAIL("it has begun");
  } catch (const BudgetSpent& spent) {
    CHECK(std::string(spent.doing()) == "the rules were bound");
  }
}

TEST_CASE("what has to be finished is not stopped") {
  Looks budget(0);
  const BudgetScope scope(&budget);
  {
    const BudgetScope telling(nullptr);
    look_at_budget();
    const Stage stage("it was told");
  }
  CHECK_THROWS_AS(look_at_budget(), BudgetSpent);
}

TEST_CASE("two threads have two budgets, and a third has none") {
  Looks narrow(3);
  Looks wide(1'000'000);
  int of_narrow = 0;
  int of_wide = 0;
  std::thread one([&] { of_narrow = asked_before_spent(narrow, 10'000); });
  std::thread other([&] { of_wide = asked_before_spent(wide, 10'000); });
  const BudgetScope scope(&narrow);
  std::thread([] {
    for (int i = 0; i < 10'000; ++i) ask_budget();
  }).join();
  one.join();
  other.join();
  CHECK(of_narrow < 10'000);
  CHECK(of_wide == 10'000);
}

}  // namespace
}  // namespace btcheck::budget_test

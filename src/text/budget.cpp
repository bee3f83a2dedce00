// SPDX-License-Identifier: MIT
#include "text/budget.hpp"

namespace btcheck {
namespace {

thread_local Budget* budget_of_thread = nullptr;
thread_local std::uint32_t asked = 0;

}  // namespace

BudgetScope::BudgetScope(Budget* budget) : before_(budget_of_thread) {
  budget_of_thread = budget;
}

BudgetScope::~BudgetScope() { budget_of_thread = before_; }

Stage::Stage(const char* doing) : budget_(budget_of_thread) {
  if (budget_ == nullptr) return;
  const Spent spent = budget_->look();
  if (spent != Spent::Nothing) throw BudgetSpent(spent, doing);
  before_ = budget_->doing_.exchange(doing);
}

// What has thrown stays the one that is told.
Stage::~Stage() {
  if (budget_ != nullptr) budget_->doing_ = before_;
}

void ask_budget() {
  if (++asked % kAsksPerLook == 0) look_at_budget();
}

void look_at_budget() {
  if (budget_of_thread == nullptr) return;
  const Spent spent = budget_of_thread->look();
  if (spent != Spent::Nothing)
    throw BudgetSpent(spent, budget_of_thread->doing());
}

}  // namespace btcheck

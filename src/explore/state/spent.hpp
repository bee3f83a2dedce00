// SPDX-License-Identifier: MIT
//
// A budget that is spent, as a search tells it.
#pragma once

#include "explore/state/limits.hpp"
#include "text/budget.hpp"

namespace btcheck {

inline StopReason stop_reason(Spent spent) {
  switch (spent) {
    case Spent::Nothing:
      return StopReason::None;
    case Spent::Time:
      return StopReason::Timeout;
    case Spent::Memory:
      return StopReason::Memory;
    case Spent::Interrupted:
      return StopReason::Interrupted;
  }
  return StopReason::None;
}

}  // namespace btcheck

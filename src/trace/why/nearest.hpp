// SPDX-License-Identifier: MIT
//
// What distinguishes a run from the nearest one that does right: the choice of
// the world after which it was too late, or that comes in every round.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "trace/why/story.hpp"
#include "trace/why/why.hpp"

namespace btcheck {

// "fly -> failure in tick 1 breaks the rule; with fly -> success it need not be
// broken."; "" for rules that are not about one kind of state, and where a few
// thousand states from each choice do not show it. `trigger_state` is that from
// which an answer is waited for.
std::string nearest_right(const Story& story, const BrokenRule& rule,
                          std::optional<std::size_t> trigger_state);

}  // namespace btcheck

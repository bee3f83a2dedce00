// SPDX-License-Identifier: MIT
//
// Rules in the syntax of LTSmin, and the command lines that check them there.
// What the rules speak of by name, libbtcheck-pins.so gives LTSmin as labels.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/bind/bind.hpp"
#include "check/export/claims.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Of a state, `rule_watched_p0`; true where the predicate is.
struct LtsminLabel {
  std::string name;
  StatePredicate of;
};

// The label that stands for a proposition of a claim.
std::string label_name(const LtsminClaim& claim, std::size_t number);
// All labels that claims speak of.
std::vector<LtsminLabel> labels_of(const std::vector<LtsminClaim>& claims);

// What a step is called: by the number of its edge, and last the one of time.
// No two are called alike, and none has a blank, a comma or a quotation mark.
std::vector<std::string> action_names(const Network& network);
// And by whom it is taken: by the number of the automaton, and last time.
std::vector<std::string> mover_names(const Network& network);

// The words of the module's own, in the environment variable BTCHECK_PINS.
inline constexpr std::string_view kTellsIdle = "--idle";

// A script: the file that names tree and options, which holds `words`, and a
// line for each way to search and for each claim. `name` is that of the tree.
std::string ltsmin_text(std::string_view name, std::string_view words,
                        const Network& network,
                        const std::vector<LtsminClaim>& claims);

}  // namespace btcheck

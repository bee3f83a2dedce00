// SPDX-License-Identifier: MIT
//
// What the owner of a project says of a leaf beside what it answers. No tree
// says that, and no verdict depends on it: it answers the questions that the
// findings ask (docs/findings.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck {

// Nothing where nothing is said. `false` is an answer, too: what could then
// happen is a warning.
struct LeafMeaning {
  std::optional<bool> asked_once;      // its answer need not be asked again
  std::optional<bool> may_be_lost;     // nobody has to hear of its failure
  std::optional<bool> may_be_cut_off;  // it may be halted before it has ended
  std::optional<bool> may_stay;        // what it begins may outlast the mission
  std::optional<bool> idempotent;      // done twice is as good as once
  std::optional<bool> tells_only;      // it informs somebody, and does nothing
  // Leaves, as contracts name them: while these run the condition has to hold;
  // these end what the action begins.
  std::vector<std::string> holds_while = {};
  std::vector<std::string> undone_by = {};

  bool operator==(const LeafMeaning&) const = default;
};

// As contracts write them, without the colon.
struct MeaningFlag {
  std::string_view keyword;
  std::optional<bool> LeafMeaning::*value;
};
inline constexpr std::array kMeaningFlags = {
    MeaningFlag{"asked-once", &LeafMeaning::asked_once},
    MeaningFlag{"may-be-lost", &LeafMeaning::may_be_lost},
    MeaningFlag{"may-be-cut-off", &LeafMeaning::may_be_cut_off},
    MeaningFlag{"may-stay", &LeafMeaning::may_stay},
    MeaningFlag{"idempotent", &LeafMeaning::idempotent},
    MeaningFlag{"tells-only", &LeafMeaning::tells_only}};

struct MeaningList {
  std::string_view keyword;
  std::vector<std::string> LeafMeaning::*names;
};
inline constexpr std::array kMeaningLists = {
    MeaningList{"holds-while", &LeafMeaning::holds_while},
    MeaningList{"undone-by", &LeafMeaning::undone_by}};

// What `more` says, where `meaning` does not say it yet.
void add_meaning(const LeafMeaning& more, LeafMeaning& meaning);

}  // namespace btcheck

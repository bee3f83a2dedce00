// SPDX-License-Identifier: MIT
//
// What comes of one entry: from what is kept, from others, or from a check; and
// how a worker hands it over.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "batch/entries/entries.hpp"
#include "batch/results/kept_results.hpp"
#include "cli/inputs/looked_at.hpp"
#include "cli/options/options.hpp"
#include "report/formats/reported.hpp"
#include "text/budget.hpp"

namespace btcheck {

// The result of an entry, and where it comes from.
struct EntryResult {
  enum class Origin : char {
    Kept = 'k',
    New = 'n',
    Mended = 'm',  // new, in place of a damaged one
    Missing = '-',
    Held = 'h'  // by others; without a tree
  };
  Origin origin = Origin::New;
  ReportedTree tree;
  LookedAt looked_at = {};  // of files and folders, as far as it came
};

// Called with the key of an entry, where it has one, before anything is done
// under it; and with what was looked at to read it.
using KeyListener = std::function<void(const std::string&, const LookedAt&)>;

// Takes what is kept of an entry, or claims it, reads it and checks it. Nothing
// for one that was broken off. Whatever is thrown on the way is a result, too.
std::optional<EntryResult> result_of(const BatchEntry& entry,
                                     const Options& all, KeptResults& kept,
                                     const KeyListener& tell_key);

// The result of an entry for which the budget was not enough.
ReportedTree spent_tree(const BatchEntry& entry, const BudgetSpent& spent);

// The result of an entry whose worker has ended without one, by a signal if it
// is not 0.
ReportedTree ended_tree(const BatchEntry& entry, int signal);

// What a worker writes and the batch reads: as soon as they are known, the key
// and what was looked at, a line for each name, and an empty line; then the
// origin, and the tree.
struct Received {
  std::string key;  // "" of what cannot be read, and is not kept
  LookedAt looked_at = {};
  std::optional<EntryResult> result;
};

std::string sent_head(const std::string& key, const LookedAt& looked_at);
std::string sent_text(const EntryResult& result);
Received received(std::string_view text);

}  // namespace btcheck

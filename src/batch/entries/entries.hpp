// SPDX-License-Identifier: MIT
//
// From what the command line names to the entries of a batch.
#pragma once

#include <string>
#include <vector>

#include "batch/entries/entry.hpp"
#include "cli/options/interface.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct Batch {
  std::vector<BatchEntry> entries;  // of this shard, in order
  std::size_t all = 0;              // with those of the other shards
};

// Folders and manifests, one after the other. A folder with a `batch.toml` is
// what that says. What cannot be read is an entry with a diagnostic, so that it
// is reported beside the others: BT0002, or BT1501 for what is neither a folder
// nor a manifest.
Batch gather_batch(const BatchOptions& options);

// The file beside the first folder or manifest in which results are kept, one
// for each shard.
std::string results_file(const BatchOptions& options);

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "model/tree/leaf_meaning.hpp"

namespace btcheck {

void add_meaning(const LeafMeaning& more, LeafMeaning& meaning) {
  for (const MeaningFlag& flag : kMeaningFlags) {
    auto& known = meaning.*flag.value;
    if (!known) known = more.*flag.value;
  }
  for (const MeaningList& list : kMeaningLists) {
    auto& known = meaning.*list.names;
    if (known.empty()) known = more.*list.names;
  }
}

}  // namespace btcheck

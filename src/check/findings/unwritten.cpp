// SPDX-License-Identifier: MIT
//
// A port reads an entry that a node of the tree writes, on a run on which that
// node has not been ticked yet (BT2217).
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "check/findings/kinds.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// A port that is read on a run on which none of those that write the entry has
// been ticked.
class Unwritten : Look {
 public:
  Unwritten(const TreeFacts& facts, Suspicions& found)
      : Look(facts, found), beginning_(with_first_value(facts.tree())) {}

  void look_at_entries() {
    std::map<std::uint32_t, Uses> by_entry;
    for (const EntryUse& use : facts_.uses()) {
      Uses& uses = by_entry[use.entry];
      if (use.reads && use.writes) uses.is_updated = true;
      if (use.writes) uses.writers.push_back(use.node);
      if (use.reads && use.is_port) uses.readers.push_back(use.node);
    }
    for (const auto& [entry, uses] : by_entry) look_at(entry, uses);
  }

 private:
  struct Uses {
    std::vector<NodeId> writers;
    std::vector<NodeId> readers;
    bool is_updated = false;  // by one that has read it
  };

  void look_at(std::uint32_t entry, const Uses& uses) {
    if (uses.writers.empty() || uses.is_updated) return;
    if (begins_with_value(entry)) return;
    for (const NodeId reader : uses.readers) {
      if (is_known_to_both(reader, uses.writers)) return;
    }
    for (const NodeId reader : uses.readers) {
      if (!facts_.is_deed(reader)) return;  // it may ask whether it is there
      if (!is_written_beside(reader, uses.writers)) continue;
      add(entry, reader, uses);
      return;
    }
  }

  // A file beside the tree says what the program puts there at first.
  bool begins_with_value(std::uint32_t entry) const {
    return beginning_.contains(facts_.tree().entries[entry]);
  }

  static std::unordered_set<std::string_view> with_first_value(
      const BehaviorTree& tree) {
    std::unordered_set<std::string_view> names;
    for (const StateVariable& each : tree.variables) {
      if (each.values.empty()) continue;
      const EntryValue& first =
          each.values[static_cast<std::size_t>(each.initial)];
      if (first.numbers || first.text || first.is_any_text) {
        names.insert(each.name);
      }
    }
    return names;
  }

  bool is_known_to_both(NodeId reader,
                        const std::vector<NodeId>& writers) const {
    return std::ranges::count(writers, reader) > 0;
  }

  // Some Sequence has both below it, so the writer is meant for the reader.
  bool is_written_beside(NodeId reader,
                         const std::vector<NodeId>& writers) const {
    return std::ranges::any_of(writers, [&](NodeId writer) {
      ask_budget();
      const auto fork = fork_of(facts_.tree(), writer, reader);
      return fork &&
             info_of(facts_.node(fork->node).type).flow == Flow::OnSuccess;
    });
  }

  void add(std::uint32_t entry, NodeId reader, const Uses& uses) {
    Suspicion made{
        .finding = {
            .code = "BT2217",
            .node = reader,
            .others = uses.writers,
            .message = fmt::format("{} reads `{}` before anything has written "
                                   "it",
                                   told(reader), facts_.tree().entries[entry]),
            .why = fmt::format("{} {} it, and {} not ticked on this run",
                               facts_.told(uses.writers),
                               uses.writers.size() == 1 ? "writes" : "write",
                               uses.writers.size() == 1 ? "is" : "are"),
            .help = "write it on every way that leads here, or give it a "
                    "value before"}};
    Sighting seen{reader, LocationRole::Tick};
    for (const NodeId writer : uses.writers) {
      seen.with.emplace_back(writer, NodeStatus::NoRetStatus);
    }
    made.shown_by = {std::move(seen)};
    found_.push_back(std::move(made));
  }

  const std::unordered_set<std::string_view> beginning_;  // names of entries
};

}  // namespace

void suspect_unwritten(const TreeFacts& facts, Suspicions& found) {
  if (!is_engine(facts.tree().profile)) return;
  Unwritten(facts, found).look_at_entries();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A port reads an entry that a node of the tree writes, on a run on which that
// node has not been ticked yet (BT2217); or one that nothing writes, where the
// same port of another leaf reads what the tree has written (BT2514).
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
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
    for (const auto& [entry, uses] : by_entry) {
      if (uses.readers.size() != 1) continue;
      // Of ports that no model tells of both ways are possible.
      const NodeId reader = uses.readers[0];
      const bool is_foreign = std::ranges::all_of(
          uses.writers, [reader](NodeId writer) { return writer == reader; });
      if (is_foreign) ask_for_writer(entry, reader, by_entry);
    }
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

  // FollowPath path="{way}", which a planner writes, and FollowPath
  // path="{path}": perhaps the program does.
  void ask_for_writer(std::uint32_t entry, NodeId reader,
                      const std::map<std::uint32_t, Uses>& by_entry) {
    const std::string& name = facts_.tree().entries[entry];
    const Node& node = facts_.node(reader);
    if (begins_with_value(entry) || !is_leaf(node.type)) return;
    const auto port =
        std::ranges::find(node.arguments, braced(name), &Argument::value);
    if (port == node.arguments.end()) return;
    for (const auto& [other, uses] : by_entry) {
      const auto writer = std::ranges::find_if(uses.writers, [&](NodeId each) {
        return facts_.node(each).id != node.id;
      });
      if (writer == uses.writers.end()) continue;
      const std::string value = braced(facts_.tree().entries[other]);
      for (const NodeId alike : uses.readers) {
        ask_budget();
        const bool is_given = gives(facts_.node(alike), node.id, *port, value);
        if (!is_given) continue;
        Look::add(
            {.code = "BT2514",
             .severity = Severity::Note,
             .node = reader,
             .others = {alike, *writer},
             .message = fmt::format("{} reads `{}`, which nothing in the tree "
                                    "writes: does the program?",
                                    told(reader), name),
             .why = fmt::format("by the same port {} reads `{}`, which {} "
                                "writes",
                                told(alike), facts_.tree().entries[other],
                                told(*writer)),
             .help = fmt::format("if not, write `{}` here, or what was meant",
                                 facts_.tree().entries[other]),
             .rank = 21})
            .shown_by.push_back({reader, LocationRole::Tick});
        return;
      }
    }
  }

  static std::string braced(const std::string& entry) {
    return "{" + entry + "}";
  }
  static bool gives(const Node& node, const std::string& type,
                    const Argument& port, const std::string& value) {
    return node.id == type &&
           std::ranges::any_of(node.arguments, [&](const Argument& each) {
             return each.key == port.key && each.value == value;
           });
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

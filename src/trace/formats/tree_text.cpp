// SPDX-License-Identifier: MIT
//
// Two columns: the tree by indentation, and beside it the phase of each node.
#include "trace/formats/tree_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace btcheck {
namespace {

constexpr std::size_t kMostIndent = 40;
constexpr std::size_t kWidest = 60;  // of the first column

struct Row {
  std::string name;  // with its indentation
  std::string phase;
};

class Picture {
 public:
  Picture(const RecordedRun& run, const RecordedState& state)
      : run_(run),
        state_(state),
        depth_(run.nodes.size(), 0),
        below_(run.nodes.size(), 0),
        is_untouched_(run.nodes.size(), true) {
    for (std::size_t n = 0; n < run.nodes.size(); ++n) {
      ++uses_[run.nodes[n].name];
      if (run.nodes[n].parent) depth_[n] = depth_[*run.nodes[n].parent] + 1;
    }
    for (std::size_t n = run.nodes.size(); n-- > 0;) {
      if (state.phases[n] != Phase::Unvisited) is_untouched_[n] = false;
      if (!run.nodes[n].parent) continue;
      const std::size_t parent = *run.nodes[n].parent;
      below_[parent] += 1 + below_[n];
      if (!is_untouched_[n]) is_untouched_[parent] = false;
    }
  }

  std::vector<Row> rows(Folding folding) const {
    std::vector<Row> rows;
    for (std::size_t n = 0; n < run_.nodes.size(); ++n) {
      std::string name(std::min(2 * depth_[n], kMostIndent), ' ');
      name += name_of(run_.nodes[n]);
      if (folding == Folding::Unvisited && is_untouched_[n] && below_[n] > 0) {
        name += fmt::format(" and {} below it", below_[n]);
        rows.push_back({std::move(name), phase(n)});
        n += below_[n];
      } else {
        rows.push_back({std::move(name), phase(n)});
      }
    }
    return rows;
  }

 private:
  // With the line, where several nodes have the name.
  std::string name_of(const RecordedNode& node) const {
    return uses_.at(node.name) > 1 ? fmt::format("{}@{}", node.name, node.line)
                                   : node.name;
  }

  std::string phase(std::size_t node) const {
    // A root that has answered is still where it answered.
    const std::string& location = state_.locations[node];
    if (!run_.nodes[node].parent && location != "start_" &&
        std::find(kPhaseNames.begin(), kPhaseNames.end(), location) !=
            kPhaseNames.end()) {
      return location;
    }
    const Phase phase = state_.phases[node];
    if (phase == Phase::Unvisited) return {};
    const std::string_view name = kPhaseNames[static_cast<std::size_t>(phase)];
    return state_.is_stale[node] ? fmt::format("({})", name)
                                 : std::string(name);
  }

  const RecordedRun& run_;
  const RecordedState& state_;
  std::map<std::string, int> uses_;  // of names
  std::vector<std::size_t> depth_;
  std::vector<std::size_t> below_;  // how many nodes
  std::vector<bool> is_untouched_;  // and all below it
};

}  // namespace

std::string tree_text(const RecordedRun& run, std::size_t state,
                      Folding folding) {
  const std::vector<Row> rows = Picture(run, run.states[state]).rows(folding);
  std::size_t width = 0;
  for (const Row& row : rows) {
    if (!row.phase.empty()) width = std::max(width, row.name.size());
  }
  width = std::min(width, kWidest);
  std::string text;
  for (const Row& row : rows) {
    text += row.phase.empty()
                ? row.name + '\n'
                : fmt::format("{:<{}}  {}\n", row.name, width, row.phase);
  }
  return text;
}

}  // namespace btcheck

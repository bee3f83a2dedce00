// SPDX-License-Identifier: MIT
//
// All runs of a tree as a graph of what an observer sees of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/whatif/answer_graph.hpp"
#include "explore/minimise/labelled_graph.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What happens to something that is watched, by its number; in both trees the
// same. As a label it is never LabelledGraph::kSilent.
class SeenEvent {
 public:
  SeenEvent(std::uint32_t number, Happening what)
      : label_((number << 3 | static_cast<std::uint32_t>(what)) + 1) {}
  explicit SeenEvent(std::uint32_t label) : label_(label) {}
  std::uint32_t number() const { return (label_ - 1) >> 3; }
  Happening what() const { return static_cast<Happening>((label_ - 1) & 7); }
  std::uint32_t label() const { return label_; }
  friend auto operator<=>(const SeenEvent&, const SeenEvent&) = default;

 private:
  std::uint32_t label_;
};

// An exception leaves the tree: what happens to nobody.
inline const SeenEvent kThrown{0xfffffff, Happening::Struck};

// The reduction of a search whose graph says when each choice is made: what
// moves alone is one step with what follows; where several may move at a time
// each order of theirs is kept.
Reduction exact_reduction(const Network& network);

class SeenGraph {
 public:
  // `number_of` by node; nothing of what is not watched.
  SeenGraph(const AnswerGraph& answers,
            std::span<const std::optional<std::uint32_t>> number_of);

  // The states of the answers, then those between events of one step.
  const LabelledGraph& graph() const { return graph_; }
  // The same without what is no run: free variables that move and let nothing
  // else happen do so for a while only. So states between which only they move
  // are one. State 0 stays.
  LabelledGraph fair() const;

  // A shortest run that is seen as `events`, as numbers of arcs of the answers;
  // up to the event itself and no further. Nothing where there is none.
  std::optional<std::vector<std::uint32_t>> run_of(
      std::span<const SeenEvent> events) const;

 private:
  LabelledGraph graph_;
  // By arc of the graph, of states of the answers; and whether it is seen, or
  // something else than a free variable moves.
  std::vector<std::uint32_t> arc_of_;
  std::vector<bool> is_progress_;
};

}  // namespace btcheck

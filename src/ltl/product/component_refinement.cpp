// SPDX-License-Identifier: MIT
//
// Sets of states wait on a list. Each is cut into its components by one
// path-based search; a component with all acceptance sets loses the states that
// request in vain, and what is left of it goes back to the list.
#include "ltl/product/component_refinement.hpp"

#include <cassert>

namespace btcheck {

void Candidates::closed_cycle(std::uint32_t root) {
  std::size_t examined = 0;
  while (!stack_.empty() && stack_.back().root >= root) {
    examined = std::max(examined, stack_.back().examined);
    stack_.pop_back();
  }
  stack_.push_back({root, true, examined});
}

bool Candidates::is_due(std::uint32_t root, std::size_t size) {
  if (stack_.empty() || stack_.back().root != root) return false;
  Candidate& candidate = stack_.back();
  if (!candidate.has_changed || size < 2 * candidate.examined) return false;
  candidate.has_changed = false;
  candidate.examined = size;
  return true;
}

bool Candidates::is_due_when_complete(std::uint32_t root) {
  if (stack_.empty() || stack_.back().root != root) return false;
  const bool has_changed = stack_.back().has_changed;
  stack_.pop_back();
  return has_changed;
}

void MarkedGraph::add_state(std::uint32_t marks) {
  marks_.push_back(marks);
  first_.push_back(arcs_.size());
}

std::span<const MarkedGraph::Arc> MarkedGraph::arcs(std::uint32_t state) const {
  const std::uint64_t end =
      state + 1 < first_.size() ? first_[state + 1] : arcs_.size();
  return std::span(arcs_).subspan(first_[state], end - first_[state]);
}

std::size_t MarkedGraph::bytes() const {
  return marks_.capacity() * sizeof(std::uint32_t) +
         first_.capacity() * sizeof(std::uint64_t) +
         arcs_.capacity() * sizeof(Arc);
}

namespace {

using Part = std::vector<std::uint32_t>;

class PartSearch {
 public:
  PartSearch(const MarkedGraph& graph, const MarkTable& table,
             AcceptanceSet all_sets, const MayGoOn& may_go_on)
      : graph_(graph),
        table_(table),
        all_sets_(all_sets),
        may_go_on_(may_go_on),
        numbers_(graph.size(), kOutside) {}

  Part run() {
    Part whole(graph_.size());
    for (std::uint32_t i = 0; i < graph_.size(); ++i) whole[i] = i;
    waiting_.push_back(std::move(whole));
    while (!waiting_.empty() && found_.empty() && !is_stopped_) {
      const Part part = std::move(waiting_.back());
      waiting_.pop_back();
      cut(part);
    }
    return is_stopped_ ? Part{} : std::move(found_);
  }

 private:
  struct Frame {
    std::uint32_t state;
    std::uint32_t next_arc;
  };

  static constexpr std::uint32_t kNew = 0;
  static constexpr std::uint32_t kOutside = UINT32_MAX;

  // Looks at each component of the steps within the part.
  void cut(const Part& part) {
    for (const std::uint32_t state : part) numbers_[state] = kNew;
    for (const std::uint32_t state : part) {
      if (numbers_[state] == kNew) search_from(state);
      if (!found_.empty() || is_stopped_) return;
    }
  }

  void search_from(std::uint32_t first) {
    enter(first, 0);
    while (!path_.empty() && found_.empty() && !is_stopped_) {
      Frame& frame = path_.back();
      const std::span<const MarkedGraph::Arc> arcs = graph_.arcs(frame.state);
      if (frame.next_arc == arcs.size()) {
        leave();
        continue;
      }
      const MarkedGraph::Arc arc = arcs[frame.next_arc++];
      const std::uint32_t number = numbers_[arc.target];
      if (number == kNew) {
        enter(arc.target, graph_.sets(arc));
      } else if (number != kOutside) {
        components_.merge(number, graph_.sets(arc));
      }
    }
  }

  void enter(std::uint32_t state, AcceptanceSet sets) {
    open_.push_back(state);
    numbers_[state] = static_cast<std::uint32_t>(open_.size());
    components_.open(numbers_[state], sets);
    path_.push_back({state, 0});
    if (++entered_ % kPollInterval == 0) is_stopped_ = !may_go_on_(bytes());
  }

  // Takes the last state off the path, with its component if it is the root.
  void leave() {
    const std::uint32_t state = path_.back().state;
    path_.pop_back();
    const std::uint32_t root = components_.root();
    if (numbers_[state] != root) return;
    const AcceptanceSet sets = components_.sets();
    components_.close();
    const auto begin = open_.begin() + (root - 1);
    for (auto it = begin; it != open_.end(); ++it) numbers_[*it] = kOutside;
    if (has_step({begin, open_.end()}) && (sets & all_sets_) == all_sets_) {
      judge({begin, open_.end()});
    }
    open_.erase(begin, open_.end());
  }

  bool has_step(std::span<const std::uint32_t> component) const {
    if (component.size() > 1) return true;
    const auto arcs = graph_.arcs(component[0]);
    return std::any_of(arcs.begin(), arcs.end(),
                       [&](auto arc) { return arc.target == component[0]; });
  }

  // A component with all sets: found, or what is left of it waits.
  void judge(Part component) {
    ConditionTally tally(table_);
    for (const std::uint32_t state : component) tally.add(graph_.marks(state));
    if (tally.is_fair()) {
      found_ = std::move(component);
      return;
    }
    std::erase_if(component, [&](std::uint32_t state) {
      return tally.requests_in_vain(graph_.marks(state));
    });
    if (!component.empty()) waiting_.push_back(std::move(component));
  }

  std::size_t bytes() const {
    return graph_.bytes() + components_.bytes() +
           path_.capacity() * sizeof(Frame) +
           (numbers_.capacity() + open_.capacity() + graph_.size()) *
               sizeof(std::uint32_t);
  }

  const MarkedGraph& graph_;
  const MarkTable& table_;
  const AcceptanceSet all_sets_;
  const MayGoOn& may_go_on_;
  // By state: its place in open_ counted from 1, kNew or kOutside.
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> open_;
  std::vector<Frame> path_;
  OpenComponents components_;
  std::vector<Part> waiting_;  // no state is in two of them
  Part found_;
  std::uint64_t entered_ = 0;
  bool is_stopped_ = false;
};

}  // namespace

std::vector<std::uint32_t> strongly_fair_part(const MarkedGraph& graph,
                                              const MarkTable& table,
                                              AcceptanceSet all_sets,
                                              const MayGoOn& may_go_on) {
  return PartSearch(graph, table, all_sets, may_go_on).run();
}

}  // namespace btcheck

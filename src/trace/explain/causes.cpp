// SPDX-License-Identifier: MIT
#include "trace/explain/causes.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace btcheck {
namespace {

class Chain {
 public:
  explicit Chain(const LogMoments& moments)
      : moments_(moments), begin_(moments.last().begin) {}

  // Why a node did so in these moments.
  Cause cause(NodeId node, std::vector<std::size_t> done) const {
    std::ranges::sort(done);
    Cause made{node, moments_.at(done.back()).what, done, {}};
    for (const NodeId child : moments_.children(node)) {
      // The reasons of all times together.
      std::vector<std::size_t> reasons;
      for (const std::size_t each : done) {
        const auto some = reasons_in(node, child, each);
        reasons.insert(reasons.end(), some.begin(), some.end());
      }
      if (reasons.empty()) continue;
      // Several kinds: the last one counts.
      const Happening what = moments_.at(reasons.back()).what;
      std::erase_if(reasons, [&](std::size_t each) {
        return moments_.at(each).what != what;
      });
      made.because.push_back(cause(child, std::move(reasons)));
    }
    return made;
  }

  // The moment since which a node runs that does so at the end.
  std::size_t since(NodeId node) const {
    return since(node, answers(node, begin_, moments_.last().end),
                 moments_.last().end);
  }

 private:
  // Where it began to work towards what it did there.
  std::size_t beginning(NodeId node, std::size_t done) const {
    const auto before = moments_.of(node, begin_, done);
    for (auto at = before.rbegin(); at != before.rend(); ++at) {
      const Happening what = moments_.at(*at).what;
      const bool is_over = what == Happening::Success ||
                           what == Happening::Failure ||
                           what == Happening::Halted;
      if (is_over) return *at + 1;
    }
    return begin_;
  }

  std::vector<std::size_t> answers(NodeId child, std::size_t from,
                                   std::size_t to) const {
    auto some = moments_.of(child, from, to);
    std::erase_if(some, [&](std::size_t each) {
      return moments_.at(each).what == Happening::Asked;
    });
    return some;
  }

  // How strong a reason what a child did last is for its parent.
  enum class Weight { None, Halted, Answer, Same };
  Weight weight(NodeId child, Happening what, std::size_t from,
                std::size_t to) const {
    const auto some = answers(child, from, to);
    if (some.empty()) return Weight::None;
    const Happening last = moments_.at(some.back()).what;
    if (last == what) return Weight::Same;
    if (last == Happening::Halted) return Weight::Halted;
    if (what == Happening::Running || what == Happening::Halted) {
      return Weight::None;
    }
    return last == Happening::Running ? Weight::Halted : Weight::Answer;
  }

  std::vector<std::size_t> reasons_in(NodeId node, NodeId child,
                                      std::size_t done) const {
    const Happening what = moments_.at(done).what;
    if (what == Happening::Halted) return {};
    // What runs does so because of what is below it now.
    const std::size_t from = beginning(node, done);
    const std::size_t to = what == Happening::Running
                               ? std::max(done + 1, moments_.last().end)
                               : done;
    Weight most = Weight::None;
    for (const NodeId each : moments_.children(node)) {
      most = std::max(most, weight(each, what, from, to));
    }
    if (most == Weight::None || weight(child, what, from, to) != most) {
      return {};
    }
    auto some = answers(child, from, to);
    const Happening last = moments_.at(some.back()).what;
    std::erase_if(
        some, [&](std::size_t each) { return moments_.at(each).what != last; });
    // It runs since then.
    if (last == Happening::Running) some = {since(child, some, to)};
    return some;
  }

  std::size_t since(NodeId node, const std::vector<std::size_t>& running,
                    std::size_t to) const {
    std::size_t first = running.back();
    const std::size_t from = beginning(node, to);
    for (const std::size_t each : running) {
      if (each >= from) first = std::min(first, each);
    }
    return first;
  }

  const LogMoments& moments_;
  std::size_t begin_;
};

// From the top down those that were left, each below the one before.
std::vector<Cause> left(const LogMoments& moments) {
  std::vector<Cause> causes;
  std::vector<Cause>* into = &causes;
  for (const NodeId node : moments.left_by_exception()) {
    const auto asked = moments.last_of(node, 0, moments.all().size());
    into->push_back({node, Happening::Asked, {*asked}, {}});
    into = &into->back().because;
  }
  return causes;
}

void collect(const std::vector<Cause>& causes, std::vector<NodeId>& found) {
  for (const Cause& cause : causes) {
    if (cause.because.empty() &&
        std::ranges::find(found, cause.node) == found.end()) {
      found.push_back(cause.node);
    }
    collect(cause.because, found);
  }
}

}  // namespace

std::vector<Cause> causes_of(const LogMoments& moments) {
  const Mission& mission = moments.last();
  if (mission.outcome == Outcome::Exception) return left(moments);
  if (!moments.top() || mission.outcome == Outcome::Nothing) return {};
  const auto some = moments.of(*moments.top(), mission.begin, mission.end);
  for (auto at = some.rbegin(); at != some.rend(); ++at) {
    const Happening what = moments.at(*at).what;
    if (what == Happening::Asked) continue;
    const Chain chain(moments);
    const std::size_t done =
        what == Happening::Running ? chain.since(*moments.top()) : *at;
    return {chain.cause(*moments.top(), {done})};
  }
  return {};
}

std::vector<NodeId> first_causes(const std::vector<Cause>& causes) {
  std::vector<NodeId> found;
  collect(causes, found);
  return found;
}

}  // namespace btcheck

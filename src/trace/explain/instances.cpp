// SPDX-License-Identifier: MIT
#include "trace/explain/instances.hpp"

#include <algorithm>

#include "check/findings/findings.hpp"
#include "check/findings/normal_tree.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// What a node with this status has done last; nothing where it has done
// nothing yet.
std::optional<Happening> shown_as(NodeStatus status) {
  switch (status) {
    case NodeStatus::Success:
      return Happening::Success;
    case NodeStatus::Failure:
      return Happening::Failure;
    case NodeStatus::Running:
      return Happening::Running;
    default:
      return std::nullopt;
  }
}

class Sights {
 public:
  explicit Sights(const LogMoments& moments) : moments_(moments) {}

  // The moment in which the log shows what a suspicion names.
  std::optional<std::size_t> of(const Suspicion& suspicion) const {
    const Mission& mission = moments_.last();
    for (std::size_t i = mission.begin; i < mission.end; ++i) {
      const bool is_shown = std::ranges::any_of(
          suspicion.shown_by,
          [&](const Sighting& each) { return is_seen(each, i); });
      if (is_shown && follows(suspicion, i) && went_before(suspicion, i)) {
        return i;
      }
    }
    return std::nullopt;
  }

 private:
  // What a node has done last, being asked left out.
  std::optional<Happening> last(NodeId node, std::size_t before) const {
    const auto all = moments_.of(node, moments_.last().begin, before);
    for (auto at = all.rbegin(); at != all.rend(); ++at) {
      const Happening what = moments_.at(*at).what;
      if (what != Happening::Asked) return what;
    }
    return std::nullopt;
  }

  bool is_seen(const Sighting& sighting, std::size_t at) const {
    const Moment& moment = moments_.at(at);
    if (moment.node != sighting.node) return false;
    if (shown_as(sighting.role) != moment.what) return false;
    for (const auto& [node, status] : sighting.with) {
      if (last(node, at) != shown_as(status)) return false;
    }
    if (!sighting.retried) return true;
    // It has failed and begun again.
    const auto all = moments_.of(*sighting.retried, moments_.last().begin, at);
    const auto failed = std::ranges::find_if(all, [&](std::size_t each) {
      return moments_.at(each).what == Happening::Failure;
    });
    return failed != all.end() && failed + 1 != all.end();
  }

  bool follows(const Suspicion& suspicion, std::size_t at) const {
    if (!suspicion.then) return true;
    const auto wanted = shown_as(suspicion.then->answer);
    for (const std::size_t each :
         moments_.of(suspicion.then->node, at, moments_.last().end)) {
      if (moments_.at(each).what == Happening::Asked) continue;
      return moments_.at(each).what == wanted;
    }
    return false;
  }

  bool went_before(const Suspicion& suspicion, std::size_t at) const {
    if (!suspicion.after) return true;
    const auto wanted = shown_as(suspicion.after->answer);
    const auto all =
        moments_.of(suspicion.after->node, moments_.last().begin, at);
    return std::ranges::any_of(all, [&](std::size_t each) {
      return moments_.at(each).what == wanted;
    });
  }

  const LogMoments& moments_;
};

}  // namespace

std::vector<FindingInLog> findings_in(const BehaviorTree& tree,
                                      const DefaultReport& report,
                                      const LogMoments& moments) {
  const NormalTree normal(tree);
  const std::vector<Suspicion> suspicions = suspicions_of(normal);
  const Sights sights(moments);
  std::vector<FindingInLog> found;
  for (const TreeFinding& finding : report.findings) {
    if (is_question(finding)) continue;
    for (const Suspicion& suspicion : suspicions) {
      if (suspicion.finding.code != finding.code ||
          suspicion.finding.node != finding.node) {
        continue;
      }
      if (const auto at = sights.of(suspicion)) {
        found.push_back({finding.code, finding.node, finding.message,
                         moments.at(*at).tick});
        break;
      }
    }
  }
  return found;
}

}  // namespace btcheck

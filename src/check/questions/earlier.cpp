// SPDX-License-Identifier: MIT
#include "check/questions/earlier.hpp"

#include <algorithm>
#include <utility>

#include "check/findings/findings.hpp"

namespace btcheck {

void add_known(const BehaviorTree& tree, DefaultReport known,
               DefaultReport& report) {
  if (report.stopped == StopReason::None) return;
  const auto take = [](const Possibility& from, Possibility& to) {
    if (to.verdict == Verdict::Undecided) to = from;
  };
  for (std::size_t i = 0; i < report.tree.size(); ++i) {
    take(known.tree[i], report.tree[i]);
  }
  for (std::size_t n = 0; n < report.nodes.size(); ++n) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      take(known.nodes[n].answers[q], report.nodes[n].answers[q]);
    }
  }
  for (TreeFinding& finding : known.findings) {
    const bool is_there =
        std::ranges::any_of(report.findings, [&](const TreeFinding& each) {
          return each.code == finding.code && each.node == finding.node;
        });
    if (!is_there) report.findings.push_back(std::move(finding));
  }
  rank(report.findings, tree);
  if (known.progress.states > report.progress.states) {
    report.progress = known.progress;
  }
}

}  // namespace btcheck

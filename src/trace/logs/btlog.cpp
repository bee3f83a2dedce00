// SPDX-License-Identifier: MIT
//
// Layout after src/loggers/bt_file_logger_v2.cpp of BehaviorTree.CPP 4.10,
// checked against a file it wrote. Every number has the least significant byte
// first.
//
// What TreeNode::setStatus of BehaviorTree.CPP 4.10 would have told a logger,
// worked out from the phases of a run. Only changes are told, and:
//
//   a node with children is RUNNING as soon as it is ticked, a leaf only once
//   it has answered so;
//   before a node completes it resets its children to IDLE, a running one by
//   halting it, which resets its children first; a SequenceWithMemory that
//   fails keeps those that succeeded;
//   a decorator resets its child as soon as that completes, and so does the
//   tree with its top node;
//   a Reactive node that answers RUNNING resets all children that completed.
//
// Where the paper's nodes differ (who is halted, and when), the run is told. A
// node that is ticked anew while its last answer still stands is reset then.
#include <algorithm>
#include <utility>
#include <vector>

#include "trace/logs/behavior_log.hpp"
#include "trace/logs/btcpp_tree.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostNodes = 0xFFFF;

struct StatusChange {
  std::size_t node = 0;  // its place in LoggedTree::nodes
  LogStatus status = LogStatus::Idle;
  int tick = 0;
};

// A run as changes of status.
class Logger {
 public:
  Logger(const RecordedRun& run, const LoggedTree& tree)
      : run_(run),
        tree_(tree),
        last_(tree.nodes.size(), Phase::Unvisited),
        status_(tree.nodes.size(), LogStatus::Idle) {
    for (std::size_t top = 0; top < tree_.nodes.size(); ++top) {
      if (tree_.nodes[top].parent) continue;
      in_post_order(
          top, [](std::size_t) { return true; },
          [&](std::size_t node) { post_order_.push_back(node); });
    }
  }

  void pass(const Passing& passing) {
    tick_ = passing.tick;
    const RecordedState& state = run_.states[passing.state];
    std::vector<Phase> now;
    for (const LoggedNode& node : tree_.nodes)
      now.push_back(phase(node, state));
    for (const std::size_t node : post_order_) {
      if (now[node] != last_[node]) leave(node, now[node]);
    }
    for (std::size_t node = 0; node < now.size(); ++node) {
      if (now[node] == last_[node] || !is_active(now[node])) continue;
      if (now[node] != Phase::Halting) {
        enter(node);
      } else {
        reset_left_of(node);  // one that is halted is not ticked
      }
    }
    last_ = std::move(now);
  }

  std::vector<StatusChange> take() { return std::move(changes_); }

 private:
  // Calls visit for the node and those below it, children first; not for those
  // below a node that `enters` is false for.
  template <class Enters, class Visit>
  void in_post_order(std::size_t top, const Enters& enters,
                     const Visit& visit) const {
    struct Open {
      std::size_t node;
      std::size_t next = 0;
    };
    std::vector<Open> open{{top}};
    while (!open.empty()) {
      Open& here = open.back();
      const auto& children = tree_.nodes[here.node].children;
      if (here.next < children.size() && enters(here.node)) {
        open.push_back({children[here.next++]});
        continue;
      }
      visit(here.node);
      open.pop_back();
    }
  }

  Phase phase(const LoggedNode& node, const RecordedState& state) const {
    if (node.recorded) return state.phases[*node.recorded];
    // The node above several trees: it has ended when all of them have.
    bool is_ticked = false;
    bool has_ended = true;
    bool has_failed = false;
    bool has_begun = false;
    for (const std::size_t child : node.children) {
      const Phase below = phase(tree_.nodes[child], state);
      is_ticked |= is_active(below);
      has_ended &= is_completed(below);
      has_failed |= below == Phase::Failure;
      has_begun |= below != Phase::Unvisited;
    }
    if (is_ticked) return Phase::Waiting;
    if (has_ended) return has_failed ? Phase::Failure : Phase::Success;
    return has_begun ? Phase::Running : Phase::Unvisited;
  }

  void set(std::size_t node, LogStatus status) {
    if (status_[node] == status) return;
    status_[node] = status;
    changes_.push_back({node, status, tick_});
  }

  // To IDLE; one that runs is halted, and so are those below it.
  void reset(std::size_t top) {
    in_post_order(
        top,
        [&](std::size_t node) { return status_[node] == LogStatus::Running; },
        [&](std::size_t node) { set(node, LogStatus::Idle); });
  }

  void reset_completed_children(std::size_t node) {
    for (const std::size_t child : tree_.nodes[node].children) {
      if (is_completed(status_[child])) reset(child);
    }
  }

  void leave(std::size_t node, Phase phase) {
    switch (phase) {
      case Phase::Success:
        return complete(node, LogStatus::Success);
      case Phase::Failure:
        return complete(node, LogStatus::Failure);
      case Phase::Running:
        if (tree_.nodes[node].id.starts_with("Reactive")) {
          reset_completed_children(node);
        }
        return set(node, LogStatus::Running);
      case Phase::Halted:
        reset_left_of(node);
        return reset(node);
      case Phase::Unvisited:
      case Phase::Skipped:  // the engine leaves it idle
        return reset(node);
      default:
        return;  // it is ticked
    }
  }

  void complete(std::size_t node, LogStatus answer) {
    const LoggedNode& completed = tree_.nodes[node];
    const bool remembers =
        completed.id == "SequenceWithMemory" && answer == LogStatus::Failure;
    for (const std::size_t child : completed.children) {
      if (remembers && status_[child] == LogStatus::Success) continue;
      reset(child);
    }
    set(node, answer);
    if (is_reset_at_once(completed)) reset(node);
  }

  bool is_reset_at_once(const LoggedNode& node) const {
    if (!node.parent) return true;
    const BtcppKind above = tree_.nodes[*node.parent].kind;
    return above == BtcppKind::Decorator || above == BtcppKind::SubTree;
  }

  // Who halts a child goes along all of them, so those to its left come first.
  void reset_left_of(std::size_t node) {
    const auto parent = tree_.nodes[node].parent;
    if (!parent) return;
    for (const std::size_t sibling : tree_.nodes[*parent].children) {
      if (sibling == node) return;
      if (is_completed(status_[sibling])) reset(sibling);
    }
  }

  void enter(std::size_t node) {
    if (is_completed(status_[node])) reset(node);
    if (!tree_.nodes[node].children.empty()) set(node, LogStatus::Running);
  }

  const RecordedRun& run_;
  const LoggedTree& tree_;
  std::vector<Phase> last_;              // by place in the tree
  std::vector<LogStatus> status_;        // likewise
  std::vector<std::size_t> post_order_;  // places
  int tick_ = 0;
  std::vector<StatusChange> changes_;
};

}  // namespace

std::string btlog_heading(std::string_view xml, std::int64_t begin) {
  std::string bytes(kBtlogMagic);
  append_number(bytes, kBtlogVersion, 1);
  append_number(bytes, xml.size(), 4);
  bytes += xml;
  append_number(bytes, static_cast<std::uint64_t>(begin), 8);
  return bytes;
}

void append_record(std::string& bytes, std::int64_t time, std::uint16_t uid,
                   LogStatus status) {
  append_number(bytes, static_cast<std::uint64_t>(time), 6);
  append_number(bytes, uid, 2);
  append_number(bytes, static_cast<std::uint64_t>(status), 1);
}

std::string btlog_bytes(const RecordedRun& run, int passes) {
  const LoggedTree tree = btcpp_tree(run);
  std::string bytes = btlog_heading(btcpp_xml(tree), kLogBegin);
  std::int64_t next = 0;
  Logger logger(run, tree);
  for (const Passing& passing : unrolled(run, passes)) logger.pass(passing);
  for (const StatusChange& change : logger.take()) {
    if (change.node >= kMostNodes) continue;
    const std::int64_t time = std::max(next, change.tick * kTickTime);
    append_record(bytes, time, static_cast<std::uint16_t>(change.node + 1),
                  change.status);
    next = time + 1;
  }
  return bytes;
}

}  // namespace btcheck

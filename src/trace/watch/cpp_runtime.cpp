// SPDX-License-Identifier: MIT
//
// Nothing is allocated after the start, and what an event costs depends on the
// rules alone.
#include "trace/watch/cpp_runtime.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kAbout = R"text(//
//   btcheck_monitor::Monitor monitor;
//   monitor.on_verdict = [](std::size_t rule,
//                           btcheck_monitor::Verdict verdict) {...};
//   monitor.require_tree(nodes);          // once: is it the tree of the rules?
//   monitor.begin_tick();                  // before each tick of the tree
//   monitor.change(node, before, after);   // each change of a node's status
//   monitor.end_tick();                    // after it
//
// Nodes are numbered as the tree has them in pre-order, the tree itself is 0.
// Where a program has several such headers, each has a namespace of its own
// within btcheck_monitor.
)text";

constexpr std::string_view kIncludes = R"text(
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck_monitor {
)text";

constexpr std::string_view kTypes = R"text(
// The numbers of BehaviorTree.CPP.
enum class Status : std::uint8_t { Idle, Running, Success, Failure, Skipped };

enum class Verdict : std::uint8_t { Open, Satisfied, Violated, Excluded };

// A node of the tree that runs, as its program knows it.
struct RunningNode {
  std::size_t parent = 0;  // its number
  std::string name;
  std::string type;  // as it is registered
};

// Another tree runs than the one that the rules were written for.
class WrongTree : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace tables {

struct Node {
  const char* name = "";
  const char* id = "";    // what it is called where it has no name
  const char* type = "";  // none: a program may register it as it likes
  std::size_t parent = 0;
  bool is_leaf = false;
};
struct Slot {
  enum Kind { Location, LastStatus, Called, Answer, Remembered };
  Kind kind = Location;
  std::size_t node = 0;
};
using Condition = bool (*)(const int*);
// once, since or previously, by number; the slot that shows it; its
// conditions.
struct Past {
  int kind = 0;
  std::size_t slot = 0;
  std::size_t held = 0;
  std::size_t began = 0;
};
// Bit i of a letter is condition `first + bits[i]`, -1: a unit of time.
struct Rule {
  const char* name = "";
  const char* text = "";
  const std::uint32_t* next = nullptr;
  const std::uint8_t* outlook = nullptr;
  const int* bits = nullptr;
  std::size_t bit_count = 0;
  std::size_t first = 0;
};
)text";

constexpr std::string_view kBody = R"text(
  }  // namespace tables

  class Monitor {
   public:
    // Called once for each rule that is decided, with its number.
    std::function<void(std::size_t, Verdict)> on_verdict;

    Monitor() {
      for (auto& states : states_) states[0] = 1;
      for (std::size_t rule = 0; rule < tables::kRuleCount; ++rule) {
        settle(rule);
      }
      see();
    }

    // The nodes of the tree that runs, in pre-order: the first is number 1.
    // Throws WrongTree at the first that the tree of the rules does not have.
    static void require_tree(const std::vector<RunningNode>& nodes) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i + 1 >= tables::kNodeCount) break;
        const RunningNode& runs = nodes[i];
        const tables::Node& known = tables::kNodes[i + 1];
        const bool fits = runs.parent == known.parent &&
                          has_name(known, runs) && has_type(known, runs);
        if (fits) continue;
        throw WrongTree(wrong_tree() + "its node " + std::to_string(i + 1) +
                        " is " + described(runs) + ", where " + tables::kTree +
                        " has " +
                        described({known.parent, known.name, known.type}));
      }
      if (nodes.size() + 1 != tables::kNodeCount) {
        throw WrongTree(wrong_tree() + "it has " +
                        std::to_string(nodes.size()) + " nodes, " +
                        tables::kTree + " has " +
                        std::to_string(tables::kNodeCount - 1));
      }
    }

    static constexpr std::size_t rule_count() { return tables::kRuleCount; }
    static constexpr std::size_t node_count() { return tables::kNodeCount; }
    static const char* name(std::size_t rule) {
      return tables::kRules[rule].name;
    }
    static const char* text(std::size_t rule) {
      return tables::kRules[rule].text;
    }
    static const char* node_name(std::size_t node) {
      return tables::kNodes[node].name;
    }
    Verdict verdict(std::size_t rule) const { return verdicts_[rule]; }

    // `units` of time have passed since the tick before began: ticks, where
    // none was left out. A tick takes one at least.
    void begin_tick(std::uint64_t units = 1) {
      end_tick();
      if (!has_begun_) tell_decided();
      has_begun_ = true;
      is_in_tick_ = true;
      for (; units > 1; --units) pass_time();
      outcome_ = Status::Running;
      reach(0, kTick, true);
      location_[0] = kElsewhere;
      see();
    }

    // And with the tick its time is over: what had to come by then is lost
    // here. What is told before the next tick begins comes later than that.
    void end_tick() {
      settle();
      if (!is_in_tick_) return;
      let_go_below(0);
      is_in_tick_ = false;
      if (outcome_ != Status::Running) {
        const bool has_succeeded = outcome_ == Status::Success;
        last_[0] = has_succeeded ? kLastSuccess : kLastFailure;
        reach(0, has_succeeded ? kSuccess : kFailure, false);
      } else {
        last_[0] = kLastRunning;
        reach(0, kRunning, false);
        rest(0);
      }
      pass_time();
    }

    // Throws std::out_of_range for a number that no node has, std::logic_error
    // before the first tick: without ticks no rule could be lost in time.
    void change(std::size_t node, Status before, Status after) {
      if (node == 0 || node >= tables::kNodeCount) {
        throw std::out_of_range("btcheck_monitor: there is no node " +
                                std::to_string(node));
      }
      if (!has_begun_) {
        throw std::logic_error(
            "btcheck_monitor: begin_tick() comes before the first change");
      }
      if (taken_up_ == node && after != Status::Running &&
          after != Status::Idle) {
        taken_up_ = 0;
      } else {
        settle();
      }
      const std::size_t halted = halted_before_;
      halted_before_ = 0;
      if (after != Status::Idle) call(tables::kNodes[node].parent);
      status_[node] = after;
      const bool is_leaf = tables::kNodes[node].is_leaf;
      if (after == Status::Running) {
        if (!is_leaf && location_[node] == kElsewhere) {
          last_[node] = kLastRunning;
          return see();
        }
        reach(node, kTick, true);
        last_[node] = kLastRunning;
        if (!is_leaf) {
          location_[node] = kElsewhere;
          return see();
        }
        taken_up_ = node;
        return;
      }
      if (after != Status::Idle) {
        const bool is_called =
            before == Status::Running || location_[node] == kElsewhere;
        if (!is_called) reach(node, kTick, true);
        return answer(node, after);
      }
      last_[node] = kLastIdle;
      if (before != Status::Running) return see();
      halted_before_ = node;
      const bool is_certain =
          is_leaf || (halted != 0 && tables::kNodes[halted].parent == node);
      if (is_certain) {
        reach(node, kHalted, false);
        return rest(node);
      }
      maybe_halted_ = node;
      reach(node, kStart, false);
      maybe_halted_ = 0;
    }

   private:
    enum Location {
      kStart,
      kTick,
      kSuccess,
      kFailure,
      kRunning,
      kSkipped,
      kHalt,
      kHalted,
      kDone,
      kElsewhere
    };
    enum Last { kLastIdle, kLastSuccess, kLastFailure, kLastRunning };
    enum Truth { kNo, kYes, kUnknown };
    static constexpr std::size_t kWords = (tables::kMostStates + 63) / 64;
    using States = std::array<std::uint64_t, kWords>;

    static std::string wrong_tree() {
      return "btcheck_monitor: another tree runs than the one of the rules: ";
    }

    static std::string described(const RunningNode& node) {
      const bool is_typed = !node.type.empty() && node.type != node.name;
      return "`" + node.name + "`" + (is_typed ? " (" + node.type + ")" : "") +
             (node.parent == 0 ? " at the top"
                               : " below node " + std::to_string(node.parent));
    }

    static bool has_name(const tables::Node& known, const RunningNode& runs) {
      return runs.name == known.name || runs.name == known.id;
    }

    // Releases call a subtree SubTree or SubTreePlus.
    static bool has_type(const tables::Node& known, const RunningNode& runs) {
      const std::string_view type = known.type;
      if (type == "SubTree") return runs.type.compare(0, 7, type) == 0;
      return type.empty() || runs.type == type;
    }

    // What else a slot may be.
    struct Others {
      int count = 0;
      std::array<int, 3> values{};
    };

    // The leaf that became RUNNING last has answered so. An answer in the next
    // change would have come first: SimpleActionNode is RUNNING before it calls
    // its function.
    void settle() {
      const std::size_t leaf = taken_up_;
      taken_up_ = 0;
      if (leaf == 0) return;
      reach(leaf, kRunning, false);
      rest(leaf);
    }

    // A node whose child changes is ticked. Some, such as Switch, tell it at
    // their answer only.
    void call(std::size_t node) {
      if (node == 0 || location_[node] != kStart) return;
      call(tables::kNodes[node].parent);
      unsaid_[unsaid_count_++] = node;
      reach(node, kTick, true);
      location_[node] = kElsewhere;
      see();
    }

    static bool is_below(std::size_t node, std::size_t above) {
      while (node > above) node = tables::kNodes[node].parent;
      return node == above;
    }

    // What was ticked and tells no answer was skipped, or has answered what it
    // had: its parent has gone on.
    void let_go_below(std::size_t above) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < unsaid_count_; ++i) {
        const std::size_t node = unsaid_[i];
        const bool is_said =
            node == above || status_[node] == Status::Running;
        if (is_said) continue;
        if (!is_below(node, above)) {
          unsaid_[kept++] = node;
          continue;
        }
        location_[node] = kStart;
        called_[node] = false;
        see();
      }
      unsaid_count_ = kept;
    }

    void pass_time() {
      has_passed_ = true;
      see();
    }

    void reach(std::size_t node, Location location, bool is_called) {
      location_[node] = location;
      called_[node] = is_called;
      see();
    }

    void answer(std::size_t node, Status status) {
      let_go_below(node);
      if (tables::kNodes[node].parent == 0) outcome_ = status;
      last_[node] = status == Status::Success   ? kLastSuccess
                    : status == Status::Failure ? kLastFailure
       : kLastIdle;
      reach(node,
            status == Status::Success   ? kSuccess
            : status == Status::Failure ? kFailure
                                        : kSkipped,
            false);
      rest(node);
    }

    void rest(std::size_t node) {
      location_[node] = kDone;
      see();
      location_[node] = kStart;
      see();
    }

    // The answer that a location gives: success, failure, running, skipped.
    static int answer_in(Location location) {
      switch (location) {
        case kSuccess:
          return 1;
        case kFailure:
          return 2;
        case kRunning:
          return 3;
        case kSkipped:
          return 4;
        default:
          return 0;
      }
    }

    void add(std::size_t slot, int value) {
      Others& others = others_[slot];
      others.values[static_cast<std::size_t>(others.count++)] = value;
    }

    // A node that runs may be ticked and answer so again; one that has ended
    // and was not reset may answer as before.
    void note_unseen(std::size_t slot, std::size_t node, bool is_answer) {
      const Location here = location_[node];
      if ((here != kStart && here != kElsewhere) || node == 0) return;
      if (maybe_halted_ == node) {
        if (!is_answer) add(slot, kHalted);
        return;
      }
      const Status status = status_[node];
      if (status == Status::Idle || status == Status::Skipped) {
        if (here != kElsewhere) return;
        if (is_answer) return add(slot, answer_in(kSkipped));
        add(slot, kSkipped);
        return add(slot, kDone);
      }
      const Location again = status == Status::Running   ? kRunning
                             : status == Status::Success ? kSuccess
                : kFailure;
      if (is_answer) return add(slot, answer_in(again));
      add(slot, kTick);
      add(slot, again);
      add(slot, kDone);
    }

    void read_slots() {
      for (std::size_t s = 0; s < tables::kSlotCount; ++s) {
        const tables::Slot& slot = tables::kSlots[s];
        if (slot.kind == tables::Slot::Remembered) continue;
        others_[s].count = 0;
        switch (slot.kind) {
          case tables::Slot::Location:
            v_[s] = location_[slot.node];
            note_unseen(s, slot.node, false);
            break;
          case tables::Slot::LastStatus:
            v_[s] = last_[slot.node];
            break;
          case tables::Slot::Called:
            v_[s] = called_[slot.node];
            break;
          case tables::Slot::Answer: {
            if (has_ended_) v_[s] = 0;
            const int code = answer_in(location_[slot.node]);
            if (code != 0 && location_[slot.node] != before_[slot.node])
              v_[s] = code;
            note_unseen(s, slot.node, true);
            break;
          }
          case tables::Slot::Remembered:
            break;
        }
      }
    }

    Truth truth(std::size_t condition) {
      const std::size_t begin = tables::kReadsBegin[condition];
      const std::size_t end = tables::kReadsBegin[condition + 1];
      std::size_t ways = 1;
      for (std::size_t r = begin; r < end && ways <= 4096; ++r) {
        ways *= static_cast<std::size_t>(others_[tables::kReads[r]].count) + 1;
      }
      if (ways == 1)
        return tables::kConditions[condition](v_.data()) ? kYes : kNo;
      if (ways > 4096) return kUnknown;
      const auto kept = v_;
      bool some_hold = false;
      bool some_fail = false;
      for (std::size_t way = 0;
           way < ways && !(some_hold && some_fail); ++way) {
        std::size_t rest = way;
        for (std::size_t r = begin; r < end; ++r) {
          const std::size_t slot = tables::kReads[r];
          const Others& others = others_[slot];
          const std::size_t turn =
              rest % (static_cast<std::size_t>(others.count) + 1);
          rest /= static_cast<std::size_t>(others.count) + 1;
          v_[slot] = turn == 0 ? kept[slot] : others.values[turn - 1];
        }
        (tables::kConditions[condition](v_.data()) ? some_hold : some_fail) =
            true;
      }
      v_ = kept;
      return some_hold && some_fail ? kUnknown : some_hold ? kYes : kNo;
    }

    void note_past(bool is_tick_end) {
      for (std::size_t p = 0; p < tables::kPastCount; ++p) {
        const tables::Past& past = tables::kPast[p];
        Truth& now = past_[p];
        if (past.kind == 0) {
          now = either(truth(past.held), now);
        } else if (past.kind == 1) {
          now = either(truth(past.began), both(truth(past.held), now));
        }
        v_[past.slot] = now == kYes;
        others_[past.slot].count = 0;
        if (now == kUnknown) add(past.slot, 1);
        if (past.kind == 2 && is_tick_end) now = truth(past.held);
      }
    }

    static Truth either(Truth one, Truth other) {
      if (one == kYes || other == kYes) return kYes;
      return one == kNo && other == kNo ? kNo : kUnknown;
    }
    static Truth both(Truth one, Truth other) {
      if (one == kNo || other == kNo) return kNo;
      return one == kYes && other == kYes ? kYes : kUnknown;
    }

    // The present state.
    void see() {
      read_slots();
      has_ended_ = answer_in(location_[0]) != 0 && location_[0] != before_[0];
      before_ = location_;
      note_past(has_ended_);
      for (std::size_t rule = 0; rule < tables::kRuleCount; ++rule) {
        if (verdicts_[rule] == Verdict::Open) read(rule);
      }
      has_passed_ = false;
    }

    void read(std::size_t number) {
      const tables::Rule& rule = tables::kRules[number];
      std::uint32_t known = 0;
      std::uint32_t unknown = 0;
      std::uint32_t passed = 0;
      for (std::size_t i = 0; i < rule.bit_count; ++i) {
        const std::uint32_t bit = std::uint32_t{1} << i;
        if (rule.bits[i] < 0) {
          if (has_passed_) passed = bit;
          continue;
        }
        const Truth now =
            truth(rule.first + static_cast<std::size_t>(rule.bits[i]));
        if (now == kYes) known |= bit;
        if (now == kUnknown) unknown |= bit;
      }
      States next{};
      follow(number, known | passed, unknown, next);
      states_[number] = next;
      while (unknown != 0) {
        follow(number, known, unknown, next);
        if (next == states_[number]) break;
        states_[number] = next;
      }
      settle(number);
    }

    void follow(std::size_t number, std::uint32_t known, std::uint32_t unknown,
                States& next) const {
      const tables::Rule& rule = tables::kRules[number];
      for (std::size_t w = 0; w < kWords; ++w) {
        std::uint64_t bits = states_[number][w];
        for (std::size_t state = w * 64; bits != 0; ++state, bits >>= 1) {
          if ((bits & 1) == 0) continue;
          for (std::uint32_t way = unknown;; way = (way - 1) & unknown) {
            const std::uint32_t target =
                rule.next[(state << rule.bit_count) | known | way];
            next[target / 64] |= std::uint64_t{1} << (target % 64);
            if (way == 0) break;
          }
        }
      }
    }

    void settle(std::size_t number) {
      const tables::Rule& rule = tables::kRules[number];
      bool is_first = true;
      std::uint8_t outlook = 0;
      for (std::size_t w = 0; w < kWords; ++w) {
        std::uint64_t bits = states_[number][w];
        for (std::size_t state = w * 64; bits != 0; ++state, bits >>= 1) {
          if ((bits & 1) == 0) continue;
          if (!is_first && rule.outlook[state] != outlook) return;
          outlook = rule.outlook[state];
          is_first = false;
        }
      }
      verdicts_[number] = static_cast<Verdict>(outlook);
      if (outlook != 0 && on_verdict) on_verdict(number, verdicts_[number]);
    }

    // What is decided before anything has happened.
    void tell_decided() const {
      if (!on_verdict) return;
      for (std::size_t rule = 0; rule < tables::kRuleCount; ++rule) {
        if (verdicts_[rule] != Verdict::Open) on_verdict(rule, verdicts_[rule]);
      }
    }

    std::array<Location, tables::kNodeCount> location_{};
    std::array<Location, tables::kNodeCount> before_{};
    std::array<Last, tables::kNodeCount> last_{};
    std::array<bool, tables::kNodeCount> called_{};
    std::array<std::size_t, tables::kNodeCount> unsaid_{};
    std::size_t unsaid_count_ = 0;
    std::array<Status, tables::kNodeCount> status_{};
    std::array<int, tables::kSlotCount + 1> v_{};
    std::array<Others, tables::kSlotCount + 1> others_{};
    std::array<Truth, tables::kPastCount + 1> past_{};
    std::array<States, tables::kRuleCount + 1> states_{};
    std::array<Verdict, tables::kRuleCount + 1> verdicts_{};
    Status outcome_ = Status::Running;
    std::size_t maybe_halted_ = 0;
    std::size_t halted_before_ = 0;
    std::size_t taken_up_ = 0;  // a leaf, by the change before
    bool has_begun_ = false;
    bool is_in_tick_ = false;
    bool has_ended_ = false;
    bool has_passed_ = false;
  };

  // For BehaviorTree.CPP 4 and 3.8: #include its headers first, and define
  // BTCHECK_MONITOR_BTCPP. btcheck_monitor::BtcppLogger logger(tree,
  // monitor); logger.begin_tick(); tree.tickExactlyOnce(); logger.end_tick();
#ifdef BTCHECK_MONITOR_BTCPP
  class BtcppLogger : public BT::StatusChangeLogger {
   public:
    // Throws WrongTree. The monitor must outlive it.
    BtcppLogger(const BT::Tree& tree, Monitor& monitor)
        : BT::StatusChangeLogger(tree.rootNode()), monitor_(monitor) {
      std::vector<RunningNode> nodes;
      std::map<const BT::TreeNode*, std::size_t> parents;
      BT::applyRecursiveVisitor(
          static_cast<const BT::TreeNode*>(tree.rootNode()),
          [&](const BT::TreeNode* node) {
            nodes.push_back(
                {parents[node], node->name(), node->registrationName()});
            const std::size_t number = nodes.size();
            numbers_[node] = number;
            if (auto* control = dynamic_cast<const BT::ControlNode*>(node)) {
              for (const auto* child : control->children()) {
                parents[child] = number;
              }
            }
            if (auto* above = dynamic_cast<const BT::DecoratorNode*>(node)) {
              parents[above->child()] = number;
            }
          });
      Monitor::require_tree(nodes);
    }
    // A tick that was begun is over, unless it has thrown.
    ~BtcppLogger() override {
      if (std::uncaught_exceptions() == thrown_) monitor_.end_tick();
    }

    void begin_tick(std::uint64_t units = 1) { monitor_.begin_tick(units); }
    void end_tick() { monitor_.end_tick(); }

    void callback(BT::Duration, const BT::TreeNode& node, BT::NodeStatus before,
                  BT::NodeStatus after) override {
      const auto number = numbers_.find(&node);
      if (number == numbers_.end()) return;
      monitor_.change(number->second, static_cast<Status>(before),
                      static_cast<Status>(after));
    }
    void flush() override {}

   private:
    Monitor& monitor_;
    std::map<const BT::TreeNode*, std::size_t> numbers_;
    int thrown_ = std::uncaught_exceptions();
  };
#endif
)text";

}  // namespace

CppRuntime cpp_runtime() { return {kAbout, kIncludes, kTypes, kBody}; }

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Rules that watch a program with BehaviorTree.CPP, 4 or 3.8: C++17, the
// standard library, that engine and btcheck/monitor.hpp.
//
//   BT::Tree tree = factory.createTreeFromFile("nav.xml");
//   btcheck::Observer observer(tree, btcheck::read_table("rules.monitor"));
//   observer.halt("battery_low");
//   while (observer.tickOnce() == BT::NodeStatus::RUNNING) tree.sleep(10ms);
//
// A table is what `btcheck export nav.xml --prop rules.ltl --to monitor`
// writes, or what btcheck::monitor_table of libbtcheck gives in the program
// itself. docs/robots.md tells more.
//
// The tree is heard by its nodes' callbacks (TreeNode::subscribeToStatusChange,
// setPreTickFunction and setPostTickFunction of 4; setPostTickOverrideFunction
// of 3.8, which declares and calls it and does not define it). A program that
// sets one of these on a node takes it away from the observer; breakpoints of
// Groot2 set the first of the two.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#if __has_include(<behaviortree_cpp/bt_factory.h>)
#include <behaviortree_cpp/bt_factory.h>
#if __has_include(<behaviortree_cpp/xml_parsing.h>)
#include <behaviortree_cpp/xml_parsing.h>
#endif
#define BTCHECK_ENGINE 4
#elif __has_include(<behaviortree_cpp_v3/bt_factory.h>)
#include <behaviortree_cpp_v3/bt_factory.h>
#define BTCHECK_ENGINE 3
#else
#error "btcheck/observer.hpp needs BehaviorTree.CPP, 4 or 3.8"
#endif

#include "btcheck/marked_log.hpp"
#include "btcheck/monitor.hpp"

#if BTCHECK_ENGINE == 3
// Declared by 3.8 and used by it, but not defined (src/tree_node.cpp of 3.8.8).
inline void BT::TreeNode::setPostTickOverrideFunction(
    PostTickOverrideCallback callback) {
  post_condition_callback_ = std::move(callback);
}
#endif

namespace btcheck {

using monitor::WrongTable;
using monitor::WrongTree;

// The text of a table. Throws std::runtime_error where it cannot be read.
inline std::string read_table(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("btcheck: cannot read " + file);
  return text.str();
}

// A rule that has been decided.
struct Decision {
  std::size_t rule = 0;
  std::string name;
  std::string text;
  monitor::Verdict verdict = monitor::Verdict::Open;
  std::uint64_t tick = 0;  // how many had begun
  std::string evidence;    // what happened last, a line for each event

  // "battery_low: VIOLATED in tick 12"
  std::string words() const {
    return name + ": " + monitor::verdict_name(verdict) +
           (tick == 0 ? " before the first tick"
                      : " in tick " + std::to_string(tick));
  }
};

// Thrown out of the tick in which a rule is violated, at its end, or where the
// next one begins; see Observer::raise.
class RuleViolated : public std::runtime_error {
 public:
  explicit RuleViolated(Decision decision)
      : std::runtime_error("btcheck: " + decision.words() + ": " +
                           decision.text),
        decision_(std::move(decision)) {}
  const Decision& decision() const { return decision_; }

 private:
  Decision decision_;
};

class Observer;

// --- The engine ------------------------------------------------------------

// What differs from release to release.
namespace engine {

#if BTCHECK_ENGINE == 4
using Config = BT::NodeConfig;
#else
using Config = BT::NodeConfiguration;
#endif

inline monitor::Status status_of(BT::NodeStatus status) {
  return static_cast<monitor::Status>(status);
}

inline bool is_completed(BT::NodeStatus status) {
  return status == BT::NodeStatus::SUCCESS || status == BT::NodeStatus::FAILURE;
}

inline std::vector<std::weak_ptr<BT::TreeNode>> nodes_of(const BT::Tree& tree) {
  std::vector<std::weak_ptr<BT::TreeNode>> nodes;
#if BTCHECK_ENGINE == 4
  for (const auto& subtree : tree.subtrees) {
    nodes.insert(nodes.end(), subtree->nodes.begin(), subtree->nodes.end());
  }
#else
  nodes.insert(nodes.end(), tree.nodes.begin(), tree.nodes.end());
#endif
  return nodes;
}

inline std::vector<BT::TreeNode*> children_of(BT::TreeNode* node) {
  std::vector<BT::TreeNode*> children;
  if (auto* control = dynamic_cast<BT::ControlNode*>(node)) {
    for (const auto* child : control->children()) {
      children.push_back(const_cast<BT::TreeNode*>(child));
    }
  } else if (auto* above = dynamic_cast<BT::DecoratorNode*>(node)) {
    if (auto* child = const_cast<BT::TreeNode*>(above->child())) {
      children.push_back(child);
    }
  }
  return children;
}

// The answers of such a node are given on a thread of its own.
inline bool is_threaded(const BT::TreeNode* node) {
#if BTCHECK_ENGINE == 4
  return dynamic_cast<const BT::ThreadedAction*>(node) != nullptr;
#else
  return dynamic_cast<const BT::AsyncActionNode*>(node) != nullptr;
#endif
}

inline void halt(BT::TreeNode& node) {
#if BTCHECK_ENGINE == 4
  node.haltNode();
#else
  node.halt();
#endif
}

inline monitor::EntryValue value_of(const BT::Any* any) {
  monitor::EntryValue value;
  if (any == nullptr) return value;
  if (any->empty()) {
    value.kind = monitor::EntryValue::NoValue;
  } else if (any->isString()) {
    value.kind = monitor::EntryValue::Text;
    value.text = any->template cast<std::string>();
  } else if (any->isNumber()) {
    const auto& type = any->castedType();
    if (type == typeid(double)) {
      value.kind = monitor::EntryValue::Real;
      value.real = any->template cast<double>();
    } else if (type == typeid(std::uint64_t)) {
      value.kind = monitor::EntryValue::Real;
      value.real = static_cast<double>(any->template cast<std::uint64_t>());
    } else {
      value.kind = monitor::EntryValue::Integer;
      value.integer = any->template cast<std::int64_t>();
    }
  } else {
    value.kind = monitor::EntryValue::Other;
  }
  return value;
}

template <class Board_, class = void>
struct HasLockedEntries : std::false_type {};
template <class Board_>
struct HasLockedEntries<
    Board_, std::void_t<decltype(std::declval<Board_&>().getAnyLocked(""))>>
    : std::true_type {};

template <class Board_, class = void>
struct HasEntryMutex : std::false_type {};
template <class Board_>
struct HasEntryMutex<
    Board_, std::void_t<decltype(std::declval<Board_&>().entryMutex())>>
    : std::true_type {};

template <class Board_>
monitor::EntryValue value_in(Board_& board, const std::string& key) {
  if constexpr (HasLockedEntries<Board_>::value) {
    const auto any = board.getAnyLocked(key);
    return value_of(any ? any.get() : nullptr);
  } else if constexpr (HasEntryMutex<Board_>::value) {
    const std::unique_lock<std::decay_t<decltype(board.entryMutex())>> lock(
        board.entryMutex());
    return value_of(board.getAny(key));
  } else {
    return value_of(board.getAny(key));
  }
}

#if BTCHECK_ENGINE == 4
inline std::uint16_t uid_of(const BT::TreeNode& node, std::size_t) {
  return node.UID();
}
#else
// Its own go on from tree to tree.
inline std::uint16_t uid_of(const BT::TreeNode&, std::size_t number) {
  return static_cast<std::uint16_t>(number);
}
#endif

// Where the engine has no writer that tells the uids of nodes: 3.8, and 4 up to
// 4.2.
class TreeXml {
 public:
  std::string write(const BT::Tree& tree) {
    std::string main;
    add_tree("MainTree", "", tree.rootNode());
    for (const std::string& each : trees_) main += each;
    return "<root BTCPP_format=\"4\" main_tree_to_execute=\"MainTree\">\n" +
           main + "</root>\n";
  }

 private:
  void add_tree(const std::string& id, const std::string& path,
                BT::TreeNode* top) {
    const std::size_t place = trees_.size();
    trees_.emplace_back();
    std::string text;
    add(text, path, top, 2);
    trees_[place] = "  <BehaviorTree ID=\"" + escaped(id) + "\" _fullpath=\"" +
                    escaped(path) + "\">\n" + text + "  </BehaviorTree>\n";
  }
  void add(std::string& text, const std::string& path, BT::TreeNode* node,
           std::size_t depth) {
    const std::string blanks(2 * depth, ' ');
    const std::size_t uid = uid_of(*node, ++count_);
    const std::string type = node->registrationName();
    const bool is_tree = type.compare(0, 7, "SubTree") == 0;
    const std::string own =
        (path.empty() ? "" : path + "/") +
        (is_tree ? node->name() + "::" + std::to_string(uid) : node->name());
    text += blanks + "<" + (is_tree ? "SubTree" : escaped(type)) +
            (is_tree ? " ID=\"" : " name=\"") + escaped(node->name()) +
            "\" _uid=\"" + std::to_string(uid) + "\"";
    if (is_tree) text += " _fullpath=\"" + escaped(own) + "\"";
    const auto children = children_of(node);
    if (is_tree || children.empty()) {
      text += "/>\n";
      for (BT::TreeNode* child : children) add_tree(node->name(), own, child);
      return;
    }
    text += ">\n";
    for (BT::TreeNode* child : children) add(text, path, child, depth + 1);
    text += blanks + "</" + escaped(type) + ">\n";
  }
  static std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
      result += c == '&'   ? "&amp;"
                : c == '<' ? "&lt;"
                : c == '>' ? "&gt;"
                : c == '"' ? "&quot;"
                           : std::string(1, c);
    }
    return result;
  }

  std::vector<std::string> trees_;
  std::size_t count_ = 0;
};
// What FileLogger2 writes: a tree for each subtree, with the uids of its nodes.
template <class Tree_, class = void>
struct XmlOf {
  static std::string text(const Tree_& tree) { return TreeXml().write(tree); }
};
#if BTCHECK_ENGINE == 4
template <class Tree_>
struct XmlOf<Tree_, std::void_t<decltype(BT::WriteTreeToXML(
                        std::declval<const Tree_&>(), true, true))>> {
  static std::string text(const Tree_& tree) {
    return BT::WriteTreeToXML(tree, true, true);
  }
};
#endif

}  // namespace engine

// --- The verdict as a node -------------------------------------------------

// <Verdict rule="battery_low" is="violated"/>: succeeds while the rule
// of that name has that verdict, so that the tree can react to what was seen.
// btcheck knows the node (docs/robots.md).
class VerdictCondition : public BT::ConditionNode {
 public:
  VerdictCondition(const std::string& name, const engine::Config& config)
      : BT::ConditionNode(name, config) {}

  static BT::PortsList providedPorts() {
    return {BT::InputPort<std::string>("rule", "its name"),
            BT::InputPort<std::string>(
                "is", "violated", "open, satisfied, violated or excluded")};
  }

 private:
  friend class Observer;

  BT::NodeStatus tick() override {
    const monitor::Monitor* watched = watched_.load();
    if (watched == nullptr) {
      throw BT::RuntimeError("Verdict: no observer watches the rule `", rule_,
                             "`");
    }
    return watched->verdict(number_) == verdict_ ? BT::NodeStatus::SUCCESS
                                                 : BT::NodeStatus::FAILURE;
  }

  std::string rule_;
  std::size_t number_ = 0;
  monitor::Verdict verdict_ = monitor::Verdict::Violated;
  std::atomic<const monitor::Monitor*> watched_{nullptr};
};

// Before trees are created that have one.
inline void register_nodes(BT::BehaviorTreeFactory& factory) {
  factory.registerNodeType<VerdictCondition>("Verdict");
}

// --- What hears a tree -----------------------------------------------------

// Who is told by a Hub, one event after another.
class Hearer {
 public:
  virtual ~Hearer() = default;
  virtual void tick_begins(bool is_wake_up) = 0;
  virtual void tick_ends(monitor::Status answer) = 0;
  virtual void tick_is_left() = 0;
  virtual void begins(std::size_t node) = 0;
  virtual void answers(std::size_t node, monitor::Status status) = 0;
  virtual void changes(std::size_t node, monitor::Status before,
                       monitor::Status after) = 0;
  // Outside of the lock, once the event has been told.
  virtual void settle() = 0;
  // What becomes of the tick, asked where it ends, or begins.
  virtual bool wants_halt() const = 0;
  virtual void halted() = 0;
  virtual void raise() = 0;
};

// One for each tree, however many observe it: the engine has room for one
// callback of a kind.
class Hub {
 public:
  static std::shared_ptr<Hub> of(BT::Tree& tree) {
    static std::mutex mutex;
    static std::map<const BT::TreeNode*, std::weak_ptr<Hub>> hubs;
    const std::lock_guard<std::mutex> lock(mutex);
    for (auto at = hubs.begin(); at != hubs.end();) {
      at = at->second.expired() ? hubs.erase(at) : std::next(at);
    }
    BT::TreeNode* root = tree.rootNode();
    if (root == nullptr) {
      throw std::invalid_argument("btcheck: the tree is empty");
    }
    std::shared_ptr<Hub> hub = hubs[root].lock();
    if (!hub || !hub->is_alive()) {
      hub = std::make_shared<Hub>(tree);
      hub->listen();
      hubs[root] = hub;
    }
    return hub;
  }

  explicit Hub(BT::Tree& tree) : kept_(engine::nodes_of(tree)) {
    number(tree.rootNode(), 0);
    pending_.reserve(64);
  }
  ~Hub() {
    subscribers_.clear();
    for (const auto& kept : kept_) {
      if (const auto node = kept.lock()) silence(*node);
    }
  }
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  // Number 1 is the top node; in pre-order.
  const std::vector<BT::TreeNode*>& nodes() const { return nodes_; }
  const std::vector<std::size_t>& parents() const { return parents_; }

  void add(Hearer* hearer) {
    const Hold hold(*this);
    hearers_.push_back(hearer);
  }
  void remove(Hearer* hearer) {
    const Hold hold(*this);
    hearers_.erase(std::find(hearers_.begin(), hearers_.end(), hearer));
  }

  // Nodes that still are.
  bool is_alive() const {
    return std::none_of(kept_.begin(), kept_.end(),
                        [](const auto& node) { return node.expired(); });
  }

  // Around a call of tickOnce: ticks behind its first were woken up.
  void enter_call() {
    ticks_of_call_ = 0;
    is_in_call_ = true;
  }
  void leave_call(bool has_thrown) {
    is_in_call_ = false;
    if (!has_thrown) return;
    {
      const Hold hold(*this);
#if BTCHECK_ENGINE == 3
      // A leaf that is running throws before anything is heard of the tick.
      if (!is_in_tick_) begin_tick();
#endif
      leave_tick();
    }
    settle();
  }

  // Held by those who tell something, for as long as that takes. A
  // ThreadedAction tells that it has ended from a thread of its own.
  class Hold {
   public:
    explicit Hold(Hub& hub) : hub_(hub) {
      while (hub_.lock_.test_and_set(std::memory_order_acquire)) {
        std::this_thread::yield();
      }
    }
    ~Hold() { hub_.lock_.clear(std::memory_order_release); }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    Hub& hub_;
  };

 private:
  void number(BT::TreeNode* node, std::size_t parent) {
    nodes_.push_back(node);
    parents_.push_back(parent);
    is_threaded_.push_back(engine::is_threaded(node));
    const std::size_t number_of_node = nodes_.size();
    for (BT::TreeNode* child : engine::children_of(node)) {
      number(child, number_of_node);
    }
  }

  void listen() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const std::size_t node = i + 1;
      BT::TreeNode& heard = *nodes_[i];
#if BTCHECK_ENGINE == 4
      heard.setPreTickFunction(
          [this, node](BT::TreeNode& self) { return begins(node, self); });
      heard.setPostTickFunction(
          [this, node](BT::TreeNode& self, BT::NodeStatus status) {
            return answers(node, self, status);
          });
#else
      heard.setPostTickOverrideFunction(
          [this, node](BT::TreeNode& self, BT::NodeStatus,
                       BT::NodeStatus status) -> BT::Optional<BT::NodeStatus> {
            const BT::NodeStatus instead = answers(node, self, status);
            if (engine::is_completed(instead)) return instead;
            return nonstd::make_unexpected("");
          });
#endif
      subscribers_.push_back(heard.subscribeToStatusChange(
          [this, node](BT::TimePoint, const BT::TreeNode&,
                       BT::NodeStatus before, BT::NodeStatus after) {
            changes(node, engine::status_of(before), engine::status_of(after));
          }));
    }
  }
  static void silence(BT::TreeNode& node) {
#if BTCHECK_ENGINE == 4
    node.setPreTickFunction({});
    node.setPostTickFunction({});
#else
    node.setPostTickOverrideFunction({});
#endif
  }

  template <class Tell_>
  void tell(Tell_ tell) {
    for (Hearer* hearer : hearers_) tell(*hearer);
  }
  void settle() {
    for (Hearer* hearer : hearers_) hearer->settle();
  }
  void raise() {
    for (Hearer* hearer : hearers_) hearer->raise();
  }
  bool wants_halt() const {
    return std::any_of(
        hearers_.begin(), hearers_.end(),
        [](const Hearer* hearer) { return hearer->wants_halt(); });
  }

  // --- Events: of the thread that ticks, but for changes ---

  // An answer of the tree that ends here, or IDLE.
  BT::NodeStatus begins(std::size_t node, BT::TreeNode& self) {
    if (node == 1) {  // what was decided where the tick before ended
      settle();
      raise();
      if (wants_halt()) return end_by_halt(self);
    }
    {
      const Hold hold(*this);
      if (node == 1) begin_tick();
      tell_pending_beside(node);
      tell([&](Hearer& hearer) { hearer.begins(node); });
    }
    settle();
    return BT::NodeStatus::IDLE;  // which changes nothing
  }

  BT::NodeStatus answers(std::size_t node, BT::TreeNode& self,
                         BT::NodeStatus status) {
    // No answer: what comes next is an exception.
    if (status == BT::NodeStatus::IDLE && node != 1) return status;
    {
      const Hold hold(*this);
      if (!is_in_tick_) begin_tick();
      tell_pending_beside(node);
      tell_pending_below(node);
      tell([&](Hearer& hearer) {
        hearer.answers(node, engine::status_of(status));
      });
      if (node == 1) {
        answer_ = engine::status_of(status);
        is_ending_ =
            status != self.status() && answer_ != monitor::Status::Skipped;
      }
    }
    settle();
    if (node != 1) return BT::NodeStatus::IDLE;
    raise();
    if (wants_halt()) return halt_in_tick(self, status);
    end_unless_changing();
    return BT::NodeStatus::IDLE;
  }

  void changes(std::size_t node, monitor::Status before,
               monitor::Status after) {
    bool is_of_tick = true;  // or of a thread beside it
    {
      const Hold hold(*this);
      is_of_tick =
          !is_in_tick_ || std::this_thread::get_id() == ticking_thread_;
      const bool is_answer = after == monitor::Status::Success ||
                             after == monitor::Status::Failure;
      if (is_threaded_[node - 1] && is_answer &&
          std::this_thread::get_id() != ticking_thread_) {
        pending_.push_back({node, before, after});
        return;
      }
      tell_pending(node);
      // 3.8 has no callback where a tick begins.
      if (!is_in_tick_ && after != monitor::Status::Idle) begin_tick();
      if (after != monitor::Status::Idle) tell_pending_beside(node);
      tell([&](Hearer& hearer) { hearer.changes(node, before, after); });
      if (node == 1 && is_ending_ && after != monitor::Status::Idle) end_tick();
    }
    if (is_of_tick) settle();
  }

  // --- Ticks; the lock is held by who calls the first three ---

  void begin_tick() {
    leave_tick();
    ticking_thread_ = std::this_thread::get_id();
    is_in_tick_ = true;
    const bool is_wake_up = is_in_call_ && ticks_of_call_++ > 0;
    tell([&](Hearer& hearer) { hearer.tick_begins(is_wake_up); });
  }
  void end_tick() {
    is_in_tick_ = false;
    is_ending_ = false;
    tell([this](Hearer& hearer) { hearer.tick_ends(answer_); });
  }
  // By an exception, if it has not ended.
  void leave_tick() {
    is_ending_ = false;
    if (!std::exchange(is_in_tick_, false)) return;
    tell([](Hearer& hearer) { hearer.tick_is_left(); });
  }
  // The change of the top node's status ends it, if there is one to come.
  void end_unless_changing() {
    if (is_ending_) return;
    {
      const Hold hold(*this);
      end_tick();
    }
    settle();
  }

  // The mission ends: all that runs is halted, and the tree fails. Where it
  // ends by itself there is nothing to halt.
  BT::NodeStatus halt_in_tick(BT::TreeNode& root, BT::NodeStatus status) {
    tell([](Hearer& hearer) { hearer.halted(); });
    if (!engine::is_completed(status)) {
      engine::halt(root);
      const Hold hold(*this);
      answer_ = monitor::Status::Failure;
      tell([](Hearer& hearer) { hearer.answers(1, monitor::Status::Failure); });
      status = BT::NodeStatus::FAILURE;
    }
    is_ending_ = root.status() != status;
    end_unless_changing();
    return status;
  }
  BT::NodeStatus end_by_halt(BT::TreeNode& root) {
    tell([](Hearer& hearer) { hearer.halted(); });
    {
      const Hold hold(*this);
      begin_tick();
      tell([](Hearer& hearer) { hearer.begins(1); });
    }
    engine::halt(root);
    return BT::NodeStatus::FAILURE;  // which answers() is told of
  }

  // --- Answers of other threads; the lock is held ---

  struct Pending {
    std::size_t node;
    monitor::Status before;
    monitor::Status after;
  };
  template <class Chosen_>
  void tell_pending_where(Chosen_ is_chosen) {
    for (std::size_t i = 0; i < pending_.size();) {
      const Pending pending = pending_[i];
      if (!is_chosen(pending.node)) {
        ++i;
        continue;
      }
      pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(i));
      tell([&](Hearer& hearer) {
        hearer.changes(pending.node, pending.before, pending.after);
      });
    }
  }
  void tell_pending(std::size_t node) {
    tell_pending_where([&](std::size_t n) { return n == node; });
  }
  // Who goes on with another child has seen the answers of those before: of the
  // node, and of those above it that may not have been heard of.
  void tell_pending_beside(std::size_t node) {
    for (std::size_t n = node; n != 0 && !pending_.empty();
         n = parents_[n - 1]) {
      tell_pending_where([&](std::size_t other) {
        return other != n && parents_[other - 1] == parents_[n - 1];
      });
    }
  }
  void tell_pending_below(std::size_t parent) {
    tell_pending_where(
        [&](std::size_t n) { return parents_[n - 1] == parent; });
  }

  const std::vector<std::weak_ptr<BT::TreeNode>> kept_;
  std::vector<BT::TreeNode*> nodes_;
  std::vector<std::size_t> parents_;
  std::vector<char> is_threaded_;
  std::vector<BT::TreeNode::StatusChangeSubscriber> subscribers_;
  std::atomic_flag lock_ = ATOMIC_FLAG_INIT;
  std::vector<Hearer*> hearers_;
  std::vector<Pending> pending_;
  std::thread::id ticking_thread_;
  monitor::Status answer_ = monitor::Status::Running;  // of the tick that ends
  bool is_in_tick_ = false;
  bool is_ending_ = false;  // with the change of the top node's status
  bool is_in_call_ = false;
  int ticks_of_call_ = 0;
};

// --- The observer ----------------------------------------------------------

struct ObserverOptions {
  // NAME.btlog, and NAME.btlog.marks beside it; "": none is written.
  std::string log;
  std::size_t log_bytes = std::size_t{32}
                          << 20U;  // of one, then another begins
  std::size_t log_files = 4;       // as many are kept, the oldest go
};

class Observer final : private Hearer {
 public:
  // Throws WrongTable for a text that is no table, WrongTree where another tree
  // runs than the one of the table, std::runtime_error where the log cannot be
  // written, std::invalid_argument for a Verdict node of a rule that
  // the table does not have. Not while the tree is being ticked.
  Observer(BT::Tree& tree, std::string_view table,
           const ObserverOptions& options = {})
      : tree_(tree),
        table_(monitor::Table::read(table)),
        hub_(Hub::of(tree)),
        monitor_(required(table_, *hub_), monitor::Knowledge::Exact) {
    policies_.resize(monitor_.rule_count());
    decided_.reserve(monitor_.rule_count());
    last_values_.resize(table_.entries.size());
    for (const monitor::Table::Entry& entry : table_.entries) {
      boards_.push_back(board_of(entry.node));
    }
    monitor_.on_verdict = [this](std::size_t rule, monitor::Verdict verdict) {
      decided_.push_back({rule, verdict, monitor_.ticks()});
      has_decided_.store(true, std::memory_order_release);
    };
    for (std::size_t r = 0; r < monitor_.rule_count(); ++r) {
      if (monitor_.verdict(r) != monitor::Verdict::Open) {
        decided_.push_back({r, monitor_.verdict(r), 0});
        has_decided_ = true;
      }
    }
    lend_verdicts();
    if (!options.log.empty()) open_log(options);
    hub_->add(this);
  }
  ~Observer() override {
    hub_->remove(this);
    take_verdicts_back();
  }
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  // --- Ticks: as Tree has them, and wake-ups are told from ticks ---

#if BTCHECK_ENGINE == 4
  BT::NodeStatus tickOnce() {
    return called([this] { return tree_.tickOnce(); });
  }
  BT::NodeStatus tickExactlyOnce() {
    return called([this] { return tree_.tickExactlyOnce(); });
  }
  BT::NodeStatus tickWhileRunning(
      std::chrono::milliseconds sleep = std::chrono::milliseconds(10)) {
    return while_running([this] { return tickOnce(); }, sleep);
  }
#else
  BT::NodeStatus tickRoot() {
    return called([this] { return tree_.tickRoot(); });
  }
  BT::NodeStatus tickRootWhileRunning(
      std::chrono::milliseconds sleep = std::chrono::milliseconds(10)) {
    return while_running([this] { return tickRoot(); }, sleep);
  }
#endif

  // --- Rules; of any thread ---

  std::size_t rule_count() const { return monitor_.rule_count(); }
  const std::string& rule_name(std::size_t rule) const {
    return table_.automata.at(rule).name;
  }
  monitor::Verdict verdict(std::size_t rule) const {
    return monitor_.verdict(rule);
  }
  monitor::Verdict verdict(std::string_view rule) const {
    return monitor_.verdict(number_of(rule));
  }
  bool is_violated() const {
    for (std::size_t r = 0; r < rule_count(); ++r) {
      if (verdict(r) == monitor::Verdict::Violated) return true;
    }
    return false;
  }

  // --- What becomes of it: not while the tree is being ticked ---
  //
  // Of one rule by its name, or of all by "*". Each throws
  // std::invalid_argument for a name that no rule has. Callbacks are called by
  // the thread that ticks, where the rule is decided.

  // Whatever the verdict is.
  Observer& call(std::string_view rule,
                 const std::function<void(const Decision&)>& callback) {
    return with(rule,
                [&](Policy& policy) { policy.callbacks.push_back(callback); });
  }
  // These where the rule is violated. A line to std::clog:
  Observer& log(std::string_view rule = "*") {
    return with(rule, [](Policy& policy) { policy.is_logged = true; });
  }
  // The mission ends with this tick: all that runs is halted, the tree fails.
  // A rule that is lost with the time of a tick ends the next one.
  Observer& halt(std::string_view rule = "*") {
    return with(rule, [](Policy& policy) { policy.is_halting = true; });
  }
  // RuleViolated leaves the tick instead of its answer.
  Observer& raise(std::string_view rule) {
    return with(rule, [](Policy& policy) { policy.is_thrown = true; });
  }
  // An entry of the tree's own blackboard gets a value.
  template <class Value_>
  Observer& set_entry(std::string_view rule, std::string key, Value_ value) {
    const auto board = tree_.rootBlackboard();
    return with(rule, [&](Policy& policy) {
      policy.callbacks.push_back([board, key, value](const Decision& decided) {
        if (decided.verdict == monitor::Verdict::Violated)
          board->set(key, value);
      });
    });
  }

  // Writes what the log does not have yet, and waits until it is written.
  void flush() {
    if (log_) log_->flush();
  }
  // How many events the log has lost, the disk being too slow.
  std::uint64_t lost_events() const { return log_ ? log_->lost() : 0; }

 private:
  struct Policy {
    std::vector<std::function<void(const Decision&)>> callbacks;
    bool is_logged = false;
    bool is_halting = false;
    bool is_thrown = false;
  };
  struct Decided {
    std::size_t rule;
    monitor::Verdict verdict;
    std::uint64_t tick;
  };
  // What happened last, for the evidence.
  struct Happened {
    enum Kind : std::uint8_t { Ticked, Answered, Halted, TickEnded, Left };
    std::uint64_t tick = 0;
    std::size_t node = 0;
    Kind kind = Ticked;
    monitor::Status status = monitor::Status::Idle;
  };
  static constexpr std::size_t kRemembered = 16;

  // Of the subtree with that first node. In 3.8 a node without ports does not
  // know its blackboard: another one of the subtree does, or nothing there has
  // entries.
  BT::Blackboard::Ptr board_of(std::size_t first) const {
    if (first == 1) return tree_.rootBlackboard();
    const std::size_t above = hub_->parents()[first - 1];
    std::vector<char> is_inside(hub_->nodes().size() + 1, false);
    is_inside[above] = true;
    for (std::size_t n = first; n <= hub_->nodes().size(); ++n) {
      if (!is_inside[hub_->parents()[n - 1]]) continue;
      const BT::TreeNode& node = *hub_->nodes()[n - 1];
      if (node.config().blackboard) return node.config().blackboard;
      is_inside[n] = node.registrationName().compare(0, 7, "SubTree") != 0;
    }
    return nullptr;
  }

  static const monitor::Table& required(const monitor::Table& table,
                                        const Hub& hub) {
    std::vector<monitor::RunningNode> running;
    for (std::size_t i = 0; i < hub.nodes().size(); ++i) {
      const BT::TreeNode& node = *hub.nodes()[i];
      running.push_back(
          {hub.parents()[i], node.name(), node.registrationName()});
    }
    table.require(running);
    return table;
  }

  std::size_t number_of(std::string_view rule) const {
    std::string names;
    for (std::size_t r = 0; r < table_.automata.size(); ++r) {
      if (table_.automata[r].name == rule) return r;
      names += (r == 0 ? "" : ", ") + table_.automata[r].name;
    }
    throw std::invalid_argument("btcheck: there is no rule `" +
                                std::string(rule) + "`; there are: " + names);
  }
  template <class Change_>
  Observer& with(std::string_view rule, Change_ change) {
    if (rule != "*") {
      change(policies_[number_of(rule)]);
    } else {
      for (Policy& policy : policies_) change(policy);
    }
    return *this;
  }

  template <class Call_>
  BT::NodeStatus called(Call_ call) {
    hub_->enter_call();
    try {
      const BT::NodeStatus status = call();
      hub_->leave_call(false);
      return status;
    } catch (...) {
      hub_->leave_call(true);
      throw;
    }
  }

  template <class Tick_>
  BT::NodeStatus while_running(Tick_ tick, std::chrono::milliseconds sleep) {
    BT::NodeStatus status = tick();
    while (status == BT::NodeStatus::RUNNING) {
      tree_.sleep(sleep);
      status = tick();
    }
    return status;
  }

  void lend_verdicts() {
    for (BT::TreeNode* node : hub_->nodes()) {
      auto* condition = dynamic_cast<VerdictCondition*>(node);
      if (condition == nullptr) continue;
      const auto rule = condition->getInput<std::string>("rule");
      const auto is = condition->getInput<std::string>("is");
      if (!rule) {
        throw std::invalid_argument("btcheck: the node `" + node->name() +
                                    "` does not say which rule it asks");
      }
      condition->rule_ = rule.value();
      condition->number_ = number_of(rule.value());
      condition->verdict_ = verdict_called(is ? is.value() : "violated");
      condition->watched_ = &monitor_;
      borrowers_.push_back(condition);
    }
  }
  void take_verdicts_back() {
    if (!hub_->is_alive()) return;  // the tree is gone
    for (VerdictCondition* condition : borrowers_) {
      const monitor::Monitor* own = &monitor_;
      condition->watched_.compare_exchange_strong(own, nullptr);
    }
  }
  static monitor::Verdict verdict_called(std::string_view word) {
    if (word == "open") return monitor::Verdict::Open;
    if (word == "satisfied") return monitor::Verdict::Satisfied;
    if (word == "violated") return monitor::Verdict::Violated;
    if (word == "excluded") return monitor::Verdict::Excluded;
    throw std::invalid_argument("btcheck: `" + std::string(word) +
                                "` is no verdict; write open, satisfied, "
                                "violated or excluded");
  }

  void open_log(const ObserverOptions& options) {
    MarkedLog::Heading heading;
    heading.file = options.log;
    heading.most_bytes = options.log_bytes;
    heading.most_files = options.log_files;
    heading.engine = BTCHECK_ENGINE;
    heading.xml = engine::XmlOf<BT::Tree>::text(tree_);
    for (const BT::TreeNode* node : hub_->nodes()) {
      heading.uids.push_back(engine::uid_of(*node, heading.uids.size() + 1));
    }
    for (const monitor::Table::Entry& entry : table_.entries) {
      heading.entries.push_back(entry.name);
    }
    log_ = std::make_unique<MarkedLog>(std::move(heading));
  }
  // --- Hearer ---

  void tick_begins(bool is_wake_up) override {
    look_at_entries();
    if (log_) log_->begin_tick(is_wake_up);
    monitor_.begin_tick();
  }
  void tick_ends(monitor::Status answer) override {
    look_at_entries();
    if (log_) log_->end_tick(answer);
    remember(0, Happened::TickEnded, answer);
    monitor_.end_tick();
  }
  void tick_is_left() override {
    look_at_entries();
    if (log_) log_->leave_tick();
    remember(0, Happened::Left, monitor::Status::Idle);
    monitor_.leave_tick();
  }
  void begins(std::size_t node) override {
    look_at_entries();
    if (log_) log_->begin_node(node);
    monitor_.begin_node(node);
  }
  void answers(std::size_t node, monitor::Status status) override {
    look_at_entries();
    if (log_) log_->answer(node, status);
    remember(node, Happened::Answered, status);
    monitor_.answer(node, status);
  }
  void changes(std::size_t node, monitor::Status before,
               monitor::Status after) override {
    if (log_) log_->change(node, before, after);
    if (before == monitor::Status::Running && after == monitor::Status::Idle) {
      remember(node, Happened::Halted, after);
    }
    if (after == monitor::Status::Success ||
        after == monitor::Status::Failure) {
      remember(node, Happened::Answered, after);
    }
    monitor_.change(node, before, after);
  }

  void look_at_entries() {
    for (std::size_t i = 0; i < boards_.size(); ++i) {
      if (!boards_[i]) continue;
      monitor::EntryValue value =
          engine::value_in(*boards_[i], table_.entries[i].key);
      if (value == last_values_[i]) continue;
      if (log_) log_->entry(i, value);
      monitor_.set_entry(i, value);
      last_values_[i] = std::move(value);
    }
  }

  void remember(std::size_t node, Happened::Kind kind, monitor::Status status) {
    // An answer and the change of status that it makes are one.
    const Happened& last = happened_[(happened_count_ - 1) % kRemembered];
    if (happened_count_ > 0 && last.tick == monitor_.ticks() &&
        last.node == node && last.kind == kind && last.status == status) {
      return;
    }
    happened_[happened_count_++ % kRemembered] = {monitor_.ticks(), node, kind,
                                                  status};
  }
  std::string evidence() const {
    std::string text;
    const std::size_t first =
        happened_count_ > kRemembered ? happened_count_ - kRemembered : 0;
    for (std::size_t i = first; i < happened_count_; ++i) {
      const Happened& each = happened_[i % kRemembered];
      text += "tick " + std::to_string(each.tick) + ": ";
      if (each.kind == Happened::Left) {
        text += "an exception left it";
      } else if (each.kind == Happened::TickEnded) {
        text += std::string("ends, ") + monitor::status_name(each.status);
      } else {
        text += hub_->nodes()[each.node - 1]->name();
        text += each.kind == Happened::Halted
                    ? " is halted"
                    : std::string(" -> ") + monitor::status_name(each.status);
      }
      text += '\n';
    }
    return text;
  }

  // A callback may halt the tree or read verdicts: what it brings about comes
  // behind what is being told.
  void settle() override {
    while (has_decided_.load(std::memory_order_acquire)) {
      Decided decided{};
      {
        const Hub::Hold hold(*hub_);
        if (decided_.empty()) return;
        decided = decided_.front();
        decided_.erase(decided_.begin());
        has_decided_ = !decided_.empty();
      }
      tell(decided);
    }
  }
  void tell(const Decided& decided) {
    const Policy& policy = policies_[decided.rule];
    const bool is_violated = decided.verdict == monitor::Verdict::Violated;
    if (policy.callbacks.empty() &&
        !(is_violated &&
          (policy.is_logged || policy.is_halting || policy.is_thrown))) {
      return;
    }
    const monitor::Table::Rule& rule = table_.automata[decided.rule];
    Decision decision{decided.rule,    rule.name,    rule.text,
                      decided.verdict, decided.tick, evidence()};
    if (is_violated && policy.is_logged) {
      std::clog << "btcheck: " << decision.words() << ": " << decision.text
                << std::endl;
    }
    for (const auto& callback : policy.callbacks) callback(decision);
    if (!is_violated) return;
    if (policy.is_halting) wants_halt_ = true;
    if (policy.is_thrown)
      thrown_ = std::make_unique<Decision>(std::move(decision));
  }

  bool wants_halt() const override { return wants_halt_; }
  void halted() override { wants_halt_ = false; }
  void raise() override {
    if (!thrown_) return;
    const std::unique_ptr<Decision> thrown = std::move(thrown_);
    throw RuleViolated(*thrown);
  }

  BT::Tree& tree_;
  const monitor::Table table_;
  const std::shared_ptr<Hub> hub_;
  monitor::Monitor monitor_;
  std::vector<Policy> policies_;  // by rule
  std::vector<Decided> decided_;  // and not told yet
  std::atomic<bool> has_decided_{false};
  std::vector<BT::Blackboard::Ptr> boards_;  // by entry
  std::vector<monitor::EntryValue> last_values_;
  std::vector<VerdictCondition*> borrowers_;
  std::unique_ptr<MarkedLog> log_;
  std::array<Happened, kRemembered> happened_{};
  std::size_t happened_count_ = 0;
  std::unique_ptr<Decision> thrown_;
  bool wants_halt_ = false;
};

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Writes down what a tree does, event by event, as btcpp_random/engine_events
// reads it. It is told by the engine's own callbacks, of which a node has one
// of each kind: a tree has a recorder or an observer, not both.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include "scripted_leaves.hpp"

namespace {

// "integer 3", `text "a"`, "unset".
inline std::string told_value(const std::optional<BT::Any>& value) {
  if (!value) return "unset";
  if (value->empty()) return "no_value";
  if (value->isString()) return "text \"" + value->cast<std::string>() + "\"";
  if (!value->isNumber()) return "other";
  std::ostringstream text;
  text.precision(17);
  if (value->type() == typeid(double) || value->type() == typeid(float)) {
    text << "real " << value->cast<double>();
  } else {
    text << "integer " << value->cast<int64_t>();
  }
  return text.str();
}

class EventRecorder {
 public:
  // Of entries, lines `NAME PATH ENTRY`; those that cannot be found are left
  // out.
  EventRecorder(BT::Tree& tree, const std::string& entries) {
    head_ = "node 0 BehaviorTree tree\n";
    add(tree.rootNode(), 0);
    std::istringstream words(entries);
    std::string name;
    std::string path;
    std::string key;
    while (words >> name >> path >> key) {
      const auto board = blackboard_of(tree, path);
      if (!board) continue;
      entries_.push_back({board, key, "unset"});
      head_ += "entry " + name + "\n";
    }
    for (auto& [node, number] : numbers_) {
      listen_to(*const_cast<BT::TreeNode*>(node), number);
    }
  }

  // Whatever is told from now on happens in a tick. It ends where the top node
  // has answered, and its status is what it has answered; that the tree resets
  // it comes later.
  void begin_tick() {
    const std::scoped_lock lock(mutex_);
    note("tick");
    is_over_ = false;
  }
  void leave_tick() {
    const std::scoped_lock lock(mutex_);
    note("throw");
    is_over_ = true;
  }

  std::string text() const { return head_ + "\n" + events_; }

 private:
  void add(BT::TreeNode* node, std::size_t parent) {
    const std::size_t number = numbers_.size() + 1;
    numbers_[node] = number;
    head_ += "node " + std::to_string(parent) + " " + node->registrationName() +
             " " + node->name() + "\n";
    if (auto* control = dynamic_cast<BT::ControlNode*>(node)) {
      for (BT::TreeNode* child : control->children()) add(child, number);
    } else if (auto* decorator = dynamic_cast<BT::DecoratorNode*>(node)) {
      if (decorator->child() != nullptr) add(decorator->child(), number);
    }
  }

  void listen_to(BT::TreeNode& node, std::size_t number) {
    const std::string told = std::to_string(number);
#if ENGINE_4
    node.setPreTickFunction([this, number, told](BT::TreeNode&) {
      const std::scoped_lock lock(mutex_);
      if (number == 1) go_on();
      note("begin " + told);
      return BT::NodeStatus::IDLE;  // ticks it
    });
    node.setPostTickFunction(
        [this, number, told](BT::TreeNode& self, BT::NodeStatus status) {
          note_answer(number, told, self, status);
          return BT::NodeStatus::IDLE;  // changes nothing
        });
#else
    node.setPostTickOverrideFunction(
        [this, number, told](
            BT::TreeNode& self, BT::NodeStatus,
            BT::NodeStatus status) -> BT::Optional<BT::NodeStatus> {
          note_answer(number, told, self, status);
          return nonstd::make_unexpected("");  // changes nothing
        });
#endif
    subscribers_.push_back(node.subscribeToStatusChange(
        [this, number, told](BT::TimePoint, const BT::TreeNode&,
                             BT::NodeStatus before, BT::NodeStatus after) {
          const std::scoped_lock lock(mutex_);
          note("change " + told + " " + word_of(before) + " " + word_of(after));
          if (number == 1) end_tick();
        }));
  }

  void note_answer(std::size_t number, const std::string& told,
                   const BT::TreeNode& node, BT::NodeStatus status) {
    // No answer: what comes next is an exception.
    if (number != 1 && status == BT::NodeStatus::IDLE) return;
    const std::scoped_lock lock(mutex_);
    if (number == 1) go_on();
    note("answer " + told + " " + word_of(status));
    if (number != 1) return;
    end_ = "end " + word_of(status);
    const bool is_kept =
        node.status() == status || word_of(status) == "skipped";
    if (is_kept) end_tick();
  }
  void end_tick() {
    if (end_.empty()) return;
    note(std::exchange(end_, ""));
    is_over_ = true;
  }

  // The tree was woken up within one tickOnce().
  void go_on() {
    if (!is_over_) return;
    note("wake");
    is_over_ = false;
  }

  // What an event finds in the entries is told before it.
  void note(const std::string& event) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      Entry& entry = entries_[i];
      const std::string value = told_value(value_in(*entry.board, entry.key));
      if (value == entry.value) continue;
      entry.value = value;
      events_ += "entry " + std::to_string(i) + " " + value + "\n";
    }
    events_ += event + "\n";
  }

  struct Entry {
    BT::Blackboard::Ptr board;
    std::string key;
    std::string value;
  };

  std::map<const BT::TreeNode*, std::size_t> numbers_;
  std::vector<Entry> entries_;
  std::string head_;
  std::string events_;
  std::string end_;      // of the tick, which the next change of the top brings
  bool is_over_ = true;  // this tick
  std::mutex mutex_;
  std::vector<BT::TreeNode::StatusChangeSubscriber> subscribers_;
};

}  // namespace

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

  // Whatever is told from now on happens in a tick, until it ends.
  void begin_tick() { tick("tick"); }
  void end_tick(BT::NodeStatus status) {
    const std::scoped_lock lock(mutex_);
    note("end " + word_of(status));
    is_answered_ = false;
  }
  void leave_tick() {
    const std::scoped_lock lock(mutex_);
    note("throw");
    is_answered_ = false;
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

  void tick(const char* what) {
    const std::scoped_lock lock(mutex_);
    note(what);
    is_answered_ = false;
  }

  void listen_to(BT::TreeNode& node, std::size_t number) {
    const std::string told = std::to_string(number);
#if ENGINE_4
    node.setPreTickFunction([this, number, told](BT::TreeNode&) {
      const std::scoped_lock lock(mutex_);
      if (number == 1 && is_answered_) go_on();
      note("begin " + told);
      return BT::NodeStatus::IDLE;  // ticks it
    });
    node.setPostTickFunction(
        [this, number, told](BT::TreeNode&, BT::NodeStatus status) {
          note_answer(number, told, status);
          return BT::NodeStatus::IDLE;  // changes nothing
        });
#else
    node.setPostTickOverrideFunction(
        [this, number, told](
            BT::TreeNode&, BT::NodeStatus,
            BT::NodeStatus status) -> BT::Optional<BT::NodeStatus> {
          note_answer(number, told, status);
          return nonstd::make_unexpected("");  // changes nothing
        });
#endif
    subscribers_.push_back(node.subscribeToStatusChange(
        [this, told](BT::TimePoint, const BT::TreeNode&, BT::NodeStatus before,
                     BT::NodeStatus after) {
          const std::scoped_lock lock(mutex_);
          note("change " + told + " " + word_of(before) + " " + word_of(after));
        }));
  }

  void note_answer(std::size_t number, const std::string& told,
                   BT::NodeStatus status) {
    const std::scoped_lock lock(mutex_);
    if (number == 1) {
      if (is_answered_) go_on();
      is_answered_ = true;
    }
    note("answer " + told + " " + word_of(status));
  }

  // The tree was woken up within one tickOnce().
  void go_on() {
    note("end running");
    note("wake");
    is_answered_ = false;
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
  bool is_answered_ = false;  // by the top node, in this tick
  std::mutex mutex_;
  std::vector<BT::TreeNode::StatusChangeSubscriber> subscribers_;
};

}  // namespace

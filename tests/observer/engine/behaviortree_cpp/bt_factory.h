// SPDX-License-Identifier: MIT
//
// As much of BehaviorTree.CPP 4 as btcheck/observer.hpp hears of it, for
// machines that do not have it: what calls what, and when, is as in 4.10
// (src/tree_node.cpp, src/bt_factory.cpp). tests/btcpp_engine has the same
// tests on the engine itself.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <typeinfo>
#include <utility>
#include <variant>
#include <vector>

namespace BT {

enum class NodeStatus { IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED };
using Duration = std::chrono::high_resolution_clock::duration;
using TimePoint = std::chrono::high_resolution_clock::time_point;

class RuntimeError : public std::runtime_error {
 public:
  template <class... Parts_>
  explicit RuntimeError(const Parts_&... parts)
      : std::runtime_error((std::string() + ... + std::string(parts))) {}
};

class Any {
 public:
  Any() = default;
  explicit Any(std::int64_t value) : value_(value) {}
  explicit Any(double value) : value_(value) {}
  explicit Any(std::string value) : value_(std::move(value)) {}
  bool empty() const { return value_.index() == 0; }
  bool isString() const { return value_.index() == 3; }
  bool isNumber() const { return value_.index() == 1 || value_.index() == 2; }
  const std::type_info& castedType() const {
    return value_.index() == 2 ? typeid(double) : typeid(std::int64_t);
  }
  template <class Value_>
  Value_ cast() const {
    return std::get<Value_>(value_);
  }

 private:
  std::variant<std::monostate, std::int64_t, double, std::string> value_;
};
template <>
inline std::uint64_t Any::cast<std::uint64_t>() const {
  return static_cast<std::uint64_t>(std::get<std::int64_t>(value_));
}

class Blackboard {
 public:
  using Ptr = std::shared_ptr<Blackboard>;
  struct Locked {
    const Any* value;
    explicit operator bool() const { return value != nullptr; }
    const Any* get() const { return value; }
  };
  Locked getAnyLocked(const std::string& key) {
    const auto at = values_.find(key);
    return {at == values_.end() ? nullptr : &at->second};
  }
  void set(const std::string& key, std::int64_t value) {
    values_[key] = Any(value);
  }
  void set(const std::string& key, int value) {
    set(key, static_cast<std::int64_t>(value));
  }
  void set(const std::string& key, double value) { values_[key] = Any(value); }
  void set(const std::string& key, const std::string& value) {
    values_[key] = Any(value);
  }
  void unset(const std::string& key) { values_.erase(key); }

 private:
  std::map<std::string, Any> values_;
};

struct NodeConfig {
  Blackboard::Ptr blackboard;
  std::map<std::string, std::string> ports;
};

class TreeNode {
 public:
  using Ptr = std::shared_ptr<TreeNode>;
  using StatusChangeCallback =
      std::function<void(TimePoint, const TreeNode&, NodeStatus, NodeStatus)>;
  using StatusChangeSubscriber = std::shared_ptr<StatusChangeCallback>;

  TreeNode(std::string name, NodeConfig config)
      : name_(std::move(name)), config_(std::move(config)) {}
  virtual ~TreeNode() = default;

  virtual NodeStatus executeTick() {
    NodeStatus answer = status_;
    bool is_replaced = false;
    if (pre_ && status_ != NodeStatus::SUCCESS &&
        status_ != NodeStatus::FAILURE) {
      const NodeStatus instead = pre_(*this);
      is_replaced = is_end(instead);
      if (is_replaced) answer = instead;
    }
    if (!is_replaced) answer = tick();
    if (post_) {
      const NodeStatus instead = post_(*this, answer);
      if (is_end(instead)) answer = instead;
    }
    if (answer != NodeStatus::SKIPPED) setStatus(answer);
    return answer;
  }
  void haltNode() { halt(); }
  virtual void halt() { resetStatus(); }
  virtual NodeStatus tick() = 0;

  void setStatus(NodeStatus status) {
    const NodeStatus before = std::exchange(status_, status);
    if (before != status) notify(before, status);
  }
  void resetStatus() { setStatus(NodeStatus::IDLE); }
  NodeStatus status() const { return status_; }

  const std::string& name() const { return name_; }
  const std::string& registrationName() const { return type_; }
  std::uint16_t UID() const { return uid_; }
  const NodeConfig& config() const { return config_; }
  void name_type(std::string type, std::uint16_t uid) {
    type_ = std::move(type);
    uid_ = uid;
  }

  void setPreTickFunction(std::function<NodeStatus(TreeNode&)> call) {
    pre_ = std::move(call);
  }
  void setPostTickFunction(
      std::function<NodeStatus(TreeNode&, NodeStatus)> call) {
    post_ = std::move(call);
  }
  StatusChangeSubscriber subscribeToStatusChange(StatusChangeCallback call) {
    auto made = std::make_shared<StatusChangeCallback>(std::move(call));
    subscribers_.push_back(made);
    return made;
  }

  template <class Value_>
  struct Got {
    const std::string* text;
    explicit operator bool() const { return text != nullptr; }
    const std::string& value() const { return *text; }
  };
  template <class Value_>
  Got<Value_> getInput(const std::string& port) const {
    const auto at = config_.ports.find(port);
    return {at == config_.ports.end() ? nullptr : &at->second};
  }

 private:
  static bool is_end(NodeStatus status) {
    return status == NodeStatus::SUCCESS || status == NodeStatus::FAILURE;
  }
  void notify(NodeStatus before, NodeStatus after) {
    for (const auto& each : subscribers_) {
      if (const auto call = each.lock()) {
        (*call)(TimePoint::clock::now(), *this, before, after);
      }
    }
  }

  std::string name_;
  std::string type_;
  std::uint16_t uid_ = 0;
  NodeConfig config_;
  NodeStatus status_ = NodeStatus::IDLE;
  std::function<NodeStatus(TreeNode&)> pre_;
  std::function<NodeStatus(TreeNode&, NodeStatus)> post_;
  std::vector<std::weak_ptr<StatusChangeCallback>> subscribers_;
};

class ControlNode : public TreeNode {
 public:
  using TreeNode::TreeNode;
  const std::vector<TreeNode*>& children() const { return all; }
  void halt() override {
    for (TreeNode* child : all) {
      if (child->status() == NodeStatus::RUNNING) child->haltNode();
      child->resetStatus();
    }
    resetStatus();
  }
  std::vector<TreeNode*> all;
};
class DecoratorNode : public TreeNode {
 public:
  using TreeNode::TreeNode;
  const TreeNode* child() const { return one; }
  TreeNode* one = nullptr;
};
class ConditionNode : public TreeNode {
 public:
  using TreeNode::TreeNode;
};
class ThreadedAction : public TreeNode {
 public:
  using TreeNode::TreeNode;
};

// Goes on where a child was running.
class Sequence : public ControlNode {
 public:
  using ControlNode::ControlNode;
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    while (at_ < all.size()) {
      const NodeStatus answer = all[at_]->executeTick();
      if (answer == NodeStatus::RUNNING) return answer;
      if (answer == NodeStatus::FAILURE) {
        at_ = 0;
        for (TreeNode* child : all) child->resetStatus();
        return answer;
      }
      ++at_;
    }
    at_ = 0;
    for (TreeNode* child : all) child->resetStatus();
    return NodeStatus::SUCCESS;
  }
  void halt() override {
    at_ = 0;
    ControlNode::halt();
  }

 private:
  std::size_t at_ = 0;
};

// Begins anew in each tick.
class ReactiveSequence : public ControlNode {
 public:
  using ControlNode::ControlNode;
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    for (TreeNode* child : all) {
      const NodeStatus answer = child->executeTick();
      if (answer == NodeStatus::SUCCESS || answer == NodeStatus::SKIPPED) {
        continue;
      }
      for (TreeNode* other : all) {
        if (other == child && answer == NodeStatus::RUNNING) continue;
        if (other->status() == NodeStatus::RUNNING) other->haltNode();
        other->resetStatus();
      }
      return answer;
    }
    for (TreeNode* child : all) child->resetStatus();
    return NodeStatus::SUCCESS;
  }
};

struct PortInfo {};
using PortsList = std::map<std::string, PortInfo>;
template <class Value_>
std::pair<std::string, PortInfo> InputPort(const std::string& name,
                                           const std::string& = "") {
  return {name, {}};
}
template <class Value_>
std::pair<std::string, PortInfo> InputPort(const std::string& name,
                                           const std::string&,
                                           const std::string&) {
  return {name, {}};
}

class Tree {
 public:
  struct Subtree {
    std::vector<TreeNode::Ptr> nodes;
    Blackboard::Ptr blackboard = std::make_shared<Blackboard>();
  };
  std::vector<std::shared_ptr<Subtree>> subtrees;

  TreeNode* rootNode() const {
    return subtrees.empty() || subtrees[0]->nodes.empty()
               ? nullptr
               : subtrees[0]->nodes[0].get();
  }
  Blackboard::Ptr rootBlackboard() const { return subtrees[0]->blackboard; }
  void haltTree() { rootNode()->haltNode(); }
  void emitWakeUpSignal() { is_woken_ = true; }
  bool sleep(std::chrono::system_clock::duration) { return false; }

  NodeStatus tickExactlyOnce() { return end(rootNode()->executeTick()); }
  NodeStatus tickOnce() {
    NodeStatus answer = rootNode()->executeTick();
    while (answer == NodeStatus::RUNNING && std::exchange(is_woken_, false)) {
      answer = rootNode()->executeTick();
    }
    return end(answer);
  }

 private:
  NodeStatus end(NodeStatus answer) {
    if (answer == NodeStatus::SUCCESS || answer == NodeStatus::FAILURE) {
      rootNode()->resetStatus();
    }
    return answer;
  }
  bool is_woken_ = false;
};

class BehaviorTreeFactory {
 public:
  template <class Node_>
  void registerNodeType(const std::string& id) {
    registered.push_back(id);
    (void)Node_::providedPorts();
  }
  std::vector<std::string> registered;
};

inline std::string WriteTreeToXML(const Tree& tree, bool, bool) {
  std::string text =
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">\n"
      "  <BehaviorTree ID=\"Main\" _fullpath=\"\">\n";
  const std::function<void(const TreeNode*)> add = [&](const TreeNode* node) {
    text += "<" + node->registrationName() + " name=\"" + node->name() +
            "\" _uid=\"" + std::to_string(node->UID()) + "\">";
    if (auto* control = dynamic_cast<const ControlNode*>(node)) {
      for (const TreeNode* child : control->all) add(child);
    }
    text += "</" + node->registrationName() + ">\n";
  };
  add(tree.rootNode());
  return text + "  </BehaviorTree>\n</root>\n";
}

}  // namespace BT

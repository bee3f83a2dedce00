// SPDX-License-Identifier: MIT
//
// Scripted runs of a tree in BehaviorTree.CPP, 4 or 3.8: C++17, the standard
// library and that engine. `btcheck tests` writes it into each file of tests.
//
// Leaves are fakes that answer what a test says, and write what it says; all
// other nodes are the engine's own, or those that a program registers. What
// every node answers is heard by its callbacks.
#pragma once

#include <algorithm>
#include <cctype>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// A tree of release 3 wants that engine.
#if defined(BTCHECK_SUITE_RELEASE) && BTCHECK_SUITE_RELEASE == 3
#include <behaviortree_cpp_v3/bt_factory.h>
#define BTCHECK_SUITE_ENGINE 3
#elif __has_include(<behaviortree_cpp/bt_factory.h>)
#include <behaviortree_cpp/bt_factory.h>
#define BTCHECK_SUITE_ENGINE 4
#elif __has_include(<behaviortree_cpp_v3/bt_factory.h>)
#include <behaviortree_cpp_v3/bt_factory.h>
#define BTCHECK_SUITE_ENGINE 3
#else
#error "these tests need BehaviorTree.CPP, 4 or 3.8"
#endif

#if BTCHECK_SUITE_ENGINE == 3 && !defined(BTCHECK_ENGINE)
// Declared by 3.8 and used by it, but not defined (src/tree_node.cpp of 3.8.8).
inline void BT::TreeNode::setPostTickOverrideFunction(
    PostTickOverrideCallback callback) {
  post_condition_callback_ = std::move(callback);
}
#endif

namespace btcheck {
namespace suite {

#if BTCHECK_SUITE_ENGINE == 4
using Config = BT::NodeConfig;
#else
using Config = BT::NodeConfiguration;
#endif

// A port of a leaf: 'i', 'o' or 'b' for both, and its type where the model of
// the leaf names one of the standard library.
struct Port {
  std::string name;
  char direction;
  std::string type;
};

// A type of leaf that the program registers.
struct Leaf {
  std::string id;
  bool is_condition;
  std::vector<Port> ports;
};

// A node of the tree, in pre-order. `keeps`: a leaf that keeps its answer until
// it is reset, as a StatefulActionNode does.
struct Node {
  std::string key;  // what tests call it
  std::string type;
  bool keeps;
};

// An answer or a halt: the number of the node, and the word.
using Cell = std::pair<std::size_t, std::string>;

struct Tree {
  std::string xml;
  std::vector<Leaf> leaves;
  std::vector<Node> nodes;
};

inline std::string word_of(BT::NodeStatus status) {
  std::string word = BT::toStr(status);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return word;
}

inline BT::NodeStatus status_of(const std::string& word) {
  if (word == "success") return BT::NodeStatus::SUCCESS;
  if (word == "failure") return BT::NodeStatus::FAILURE;
#if BTCHECK_SUITE_ENGINE == 4
  if (word == "skipped") return BT::NodeStatus::SKIPPED;
#endif
  if (word == "running") return BT::NodeStatus::RUNNING;
  throw std::invalid_argument("no answer: " + word);
}

// What a leaf does when it is asked: it writes, then it answers.
struct Answer {
  BT::NodeStatus status;
  std::vector<std::function<void()>> writes;
};

// What stands behind a leaf, once a run has found it in its tree.
struct Script {
  std::string key;
  bool keeps = false;
  std::vector<Answer> answers;
  std::size_t next = 0;
  std::string* complaint = nullptr;

  BT::NodeStatus ask(BT::NodeStatus now) {
    if (keeps &&
        (now == BT::NodeStatus::SUCCESS || now == BT::NodeStatus::FAILURE)) {
      return now;
    }
    if (next == answers.size()) {
      if (complaint != nullptr) {
        *complaint += " [" + key + " is ticked once more than the model says]";
      }
      return BT::NodeStatus::FAILURE;
    }
    for (const auto& write : answers[next].writes) write();
    return answers[next++].status;
  }
};

class Fake {
 public:
  virtual ~Fake() = default;
  std::shared_ptr<Script> script = std::make_shared<Script>();
};

class FakeAction : public BT::ActionNodeBase, public Fake {
 public:
  using BT::ActionNodeBase::ActionNodeBase;
  static BT::PortsList providedPorts() { return {}; }

 private:
  BT::NodeStatus tick() override { return script->ask(status()); }
#if BTCHECK_SUITE_ENGINE == 4
  void halt() override { resetStatus(); }
#else
  void halt() override { setStatus(BT::NodeStatus::IDLE); }
#endif
};

class FakeCondition : public BT::ConditionNode, public Fake {
 public:
  using BT::ConditionNode::ConditionNode;
  static BT::PortsList providedPorts() { return {}; }

 private:
  BT::NodeStatus tick() override { return script->ask(status()); }
};

template <class Type>
std::pair<std::string, BT::PortInfo> typed_port(const Port& port) {
  if (port.direction == 'o') return BT::OutputPort<Type>(port.name);
  if (port.direction == 'b') return BT::BidirectionalPort<Type>(port.name);
  return BT::InputPort<Type>(port.name);
}

inline std::pair<std::string, BT::PortInfo> port_of(const Port& port) {
  if (port.type == "int") return typed_port<int>(port);
  if (port.type == "unsigned") return typed_port<unsigned>(port);
  if (port.type == "bool") return typed_port<bool>(port);
  if (port.type == "double") return typed_port<double>(port);
  if (port.type == "string") return typed_port<std::string>(port);
  if (port.direction == 'o') return BT::OutputPort(port.name);
  if (port.direction == 'b') return BT::BidirectionalPort(port.name);
  return BT::InputPort(port.name);
}

template <class Node_>
void register_leaf(BT::BehaviorTreeFactory& factory, const Leaf& leaf) {
  BT::PortsList ports;
  for (const Port& port : leaf.ports) ports.insert(port_of(port));
  factory.registerBuilder(BT::CreateManifest<Node_>(leaf.id, ports),
                          [](const std::string& name, const Config& config) {
                            return std::make_unique<Node_>(name, config);
                          });
}

// What programs with nodes of their own define, Nav2's control nodes for
// instance: called for each factory, before the fakes are registered.
inline std::function<void(BT::BehaviorTreeFactory&)>& more_nodes() {
  static std::function<void(BT::BehaviorTreeFactory&)> hook;
  return hook;
}

// All that nodes have answered in the runs so far.
inline std::set<Cell>& reached() {
  static std::set<Cell> cells;
  return cells;
}

template <class Tree_, class = void>
struct Ticks {
  static BT::NodeStatus tick(Tree_& tree) { return tree.tickRoot(); }
};
template <class Tree_>
struct Ticks<Tree_,
             std::void_t<decltype(std::declval<Tree_&>().tickExactlyOnce())>> {
  static BT::NodeStatus tick(Tree_& tree) { return tree.tickExactlyOnce(); }
};

// One test: first what the leaves do, then tick by tick.
class ScriptedRun {
 public:
  explicit ScriptedRun(const Tree& described) : described_(described) {
    if (more_nodes()) more_nodes()(factory_);
    for (const Leaf& leaf : described.leaves) {
      if (factory_.manifests().count(leaf.id) != 0) continue;
      if (leaf.is_condition) {
        register_leaf<FakeCondition>(factory_, leaf);
      } else {
        register_leaf<FakeAction>(factory_, leaf);
      }
    }
    tree_ =
        std::make_unique<BT::Tree>(factory_.createTreeFromText(described.xml));
    add(tree_->rootNode());
    compare_shape();
    answers_.resize(nodes_.size());
    begins_.resize(nodes_.size());
    answered_.resize(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (auto* fake = dynamic_cast<Fake*>(nodes_[i])) {
        fake->script->key = described.nodes[i].key;
        fake->script->keeps = described.nodes[i].keeps;
        fake->script->complaint = &complaint_;
      }
      listen_to(i);
    }
  }
  // What throws while it is halted has been told before.
  ~ScriptedRun() {
    subscribers_.clear();
    for (BT::TreeNode* node : nodes_) silence(*node);
    try {
      tree_->haltTree();
    } catch (const std::exception&) {
      static_cast<void>(tree_.release());
    }
  }
  ScriptedRun(const ScriptedRun&) = delete;
  ScriptedRun& operator=(const ScriptedRun&) = delete;

  // What a leaf answers, each time it is asked: "running*2 success".
  void leaf(const std::string& key, const std::string& answers) {
    std::vector<Answer>& all = script_of(key).answers;
    std::string word;
    for (const char c : answers + " ") {
      if (c != ' ') {
        word += c;
        continue;
      }
      if (word.empty()) continue;
      const std::size_t star = word.find('*');
      const int times =
          star == std::string::npos ? 1 : std::stoi(word.substr(star + 1));
      for (int i = 0; i < times; ++i) {
        all.push_back({status_of(word.substr(0, star)), {}});
      }
      word.clear();
    }
  }

  // What it writes before its n-th answer, counted from 1: into an entry of the
  // blackboard that the node `home` has.
  template <class Value>
  void writes(const std::string& key, std::size_t n, const std::string& home,
              const std::string& entry, const Value& value) {
    script_of(key).answers.at(n - 1).writes.push_back(
        [this, home, entry, value] { set(home, entry, value); });
  }

  // What the program writes before the next tick.
  template <class Value>
  void set(const std::string& home, const std::string& entry,
           const Value& value) {
    const BT::TreeNode& node = *nodes_[number_of(home)];
    const auto& board = node.config().blackboard;
    if constexpr (std::is_same<Value, int>::value) {
      // An entry that a port has given another type of number.
      try {
        board->set(entry, value);
        return;
      } catch (const std::exception&) {
      }
      try {
        board->set(entry, static_cast<double>(value));
        return;
      } catch (const std::exception&) {
      }
      board->set(entry, value != 0);
    } else {
      board->set(entry, value);
    }
  }

  // One tick: "root=running Navigate=running FollowPath=running,halted".
  std::string tick() {
    std::string root;
    try {
      root = word_of(Ticks<BT::Tree>::tick(*tree_));
    } catch (const std::exception& thrown) {
      why_ = thrown.what();
      note_all();
      return "throws" + complaint_;
    }
    return "root=" + root + note_all() + complaint_;
  }
  // What was thrown.
  const std::string& why() const { return why_; }

 private:
  void add(BT::TreeNode* node) {
    numbers_[node] = nodes_.size();
    nodes_.push_back(node);
    if (auto* control = dynamic_cast<BT::ControlNode*>(node)) {
      for (const auto* child : control->children()) {
        add(const_cast<BT::TreeNode*>(child));
      }
    } else if (auto* decorator = dynamic_cast<BT::DecoratorNode*>(node)) {
      if (auto* child = const_cast<BT::TreeNode*>(decorator->child())) {
        add(child);
      }
    }
  }

  // The tree that runs is the one that the tests were made of.
  void compare_shape() const {
    bool is_same = nodes_.size() == described_.nodes.size();
    for (std::size_t i = 0; is_same && i < nodes_.size(); ++i) {
      const std::string& type = described_.nodes[i].type;
      is_same = type == "SubTree" || nodes_[i]->registrationName() == type;
    }
    if (!is_same) {
      throw std::runtime_error(
          "the tree is not the one that the tests were "
          "made of: write them anew");
    }
  }

  std::size_t number_of(const std::string& key) const {
    for (std::size_t i = 0; i < described_.nodes.size(); ++i) {
      if (described_.nodes[i].key == key) return i;
    }
    throw std::invalid_argument("no node " + key);
  }

  Script& script_of(const std::string& key) {
    auto* fake = dynamic_cast<Fake*>(nodes_[number_of(key)]);
    // One of the engine's own leaves answers by itself.
    return fake == nullptr ? unheard_ : *fake->script;
  }

  void listen_to(std::size_t i) {
    BT::TreeNode& node = *nodes_[i];
#if BTCHECK_SUITE_ENGINE == 4
    node.setPreTickFunction([this, i](BT::TreeNode&) {
      begins_[i] = true;
      return BT::NodeStatus::IDLE;  // ticks it
    });
    node.setPostTickFunction(
        [this, i](BT::TreeNode& self, BT::NodeStatus status) {
          note_answer(i, self, status);
          return BT::NodeStatus::IDLE;  // changes nothing
        });
#else
    node.setPostTickOverrideFunction(
        [this, i](BT::TreeNode& self, BT::NodeStatus,
                  BT::NodeStatus status) -> BT::Optional<BT::NodeStatus> {
          note_answer(i, self, status);
          return nonstd::make_unexpected("");  // changes nothing
        });
#endif
    subscribers_.push_back(node.subscribeToStatusChange(
        [this, i](BT::TimePoint, const BT::TreeNode&, BT::NodeStatus before,
                  BT::NodeStatus after) { see(i, before, after); }));
  }

  static void silence(BT::TreeNode& node) {
#if BTCHECK_SUITE_ENGINE == 4
    node.setPreTickFunction({});
    node.setPostTickFunction({});
#else
    node.setPostTickOverrideFunction({});
#endif
  }

  void note_answer(std::size_t i, const BT::TreeNode& node,
                   BT::NodeStatus answer) {
    begins_[i] = false;
    answered_[i] = node.status() != answer && word_of(answer) != "skipped";
    note(i, word_of(answer));
  }

  // Only a halt makes a running node idle, outside of its own tick. A node that
  // has ended and was not reset is ticked without the pre-tick function: that
  // it sets itself running before it answers tells of its tick.
  void see(std::size_t i, BT::NodeStatus before, BT::NodeStatus after) {
    const bool has_answered = std::exchange(answered_[i], false);
    if (after == BT::NodeStatus::RUNNING) {
      begins_[i] = begins_[i] || !has_answered;
    } else if (before == BT::NodeStatus::RUNNING &&
               after == BT::NodeStatus::IDLE && !begins_[i]) {
      note(i, "halted");
    }
  }

  void note(std::size_t i, const std::string& what) {
    answers_[i] += (answers_[i].empty() ? "" : ",") + what;
    reached().insert({i, what});
  }

  std::string note_all() {
    std::string text;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (answers_[i].empty()) continue;
      text += " " + described_.nodes[i].key + "=" + answers_[i];
      answers_[i].clear();
    }
    return text;
  }

  const Tree& described_;
  BT::BehaviorTreeFactory factory_;
  std::unique_ptr<BT::Tree> tree_;
  std::vector<BT::TreeNode*> nodes_;  // in pre-order
  std::map<const BT::TreeNode*, std::size_t> numbers_;
  std::vector<std::string> answers_;  // by node, in this tick
  std::vector<char> begins_;          // is in its tick
  std::vector<char> answered_;        // and the status not yet set
  std::vector<BT::TreeNode::StatusChangeSubscriber> subscribers_;
  std::string complaint_;
  std::string why_;
  Script unheard_;
};

}  // namespace suite
}  // namespace btcheck

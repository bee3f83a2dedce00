// SPDX-License-Identifier: MIT
//
// BehaviorTree.CPP, 4 or 3.8, with the leaves of the trees of btcpp_random:
// what a program of one file needs to run them.
#pragma once

#if __has_include(<behaviortree_cpp/bt_factory.h>)
#include <behaviortree_cpp/bt_factory.h>
#define ENGINE_4 1
#else
#include <behaviortree_cpp_v3/bt_factory.h>
#define ENGINE_4 0
#endif

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

#if !ENGINE_4 && !defined(BTCHECK_ENGINE)  // not with an observer
// Declared by 3.8 and used by it, but not defined.
void BT::TreeNode::setPostTickOverrideFunction(
    PostTickOverrideCallback callback) {
  post_condition_callback_ = std::move(callback);
}
#endif

namespace {

#if ENGINE_4
using Config = BT::NodeConfig;
#else
using Config = BT::NodeConfiguration;
#endif

std::string word_of(BT::NodeStatus status) {
  std::string word = BT::toStr(status);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return word;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// --- Leaves ----------------------------------------------------------------

using Results = std::vector<BT::NodeStatus>;

BT::NodeStatus status_of(const std::string& word) {
  if (word == "success") return BT::NodeStatus::SUCCESS;
  if (word == "failure") return BT::NodeStatus::FAILURE;
  if (word == "throws") return BT::NodeStatus::IDLE;  // no answer
#if ENGINE_4
  if (word == "skipped") return BT::NodeStatus::SKIPPED;
#endif
  return BT::NodeStatus::RUNNING;
}

// "success*2" as two results; `*` alone, for ever, as one, for the last stays.
void append_results(const std::string& word, Results& results) {
  const std::size_t star = word.find('*');
  int times = 1;
  if (star != std::string::npos && star + 1 < word.size()) {
    times = std::stoi(word.substr(star + 1));
  }
  results.insert(results.end(), static_cast<std::size_t>(times),
                 status_of(word.substr(0, star)));
}

std::map<std::string, Results> script_in(const std::string& text) {
  std::map<std::string, Results> script;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (line.empty() || line[0] == '#' || colon == std::string::npos) continue;
    std::istringstream words(line.substr(colon + 1));
    for (std::string word; words >> word;) {
      append_results(word, script[line.substr(0, colon)]);
    }
  }
  return script;
}

// What a leaf writes into one entry: a number, or a text in quotes.
struct Effect {
  std::string entry;
  std::string value;
};

struct Contract {
  bool answers_once = false;
  std::vector<Effect> on_success;
  std::vector<Effect> on_failure;
};

// `((:= x1 2) (:= t1 "a"))` behind the keyword; nothing where it is not there.
std::vector<Effect> effects_in(const std::string& line,
                               const std::string& keyword) {
  std::vector<Effect> effects;
  const std::size_t begin = line.find(keyword);
  if (begin == std::string::npos) return effects;
  const std::string part =
      line.substr(begin, line.find("))", begin) - begin + 2);
  const std::regex effect("\\(:= ([^ ]+) ([^)]+)\\)");
  for (std::sregex_iterator at(part.begin(), part.end(), effect), end;
       at != end; ++at) {
    effects.push_back({(*at)[1], (*at)[2]});
  }
  return effects;
}

// Contracts as btcpp_random writes them: each on a line of its own, the name
// of a type first.
std::map<std::string, Contract> contracts_in(const std::string& text) {
  std::map<std::string, Contract> contracts;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    std::string id;
    if (!(words >> keyword >> id)) continue;
    Contract& contract = contracts[id];
    contract.answers_once = line.find(":answers once") != std::string::npos;
    contract.on_success = effects_in(line, ":on-success");
    contract.on_failure = effects_in(line, ":on-failure");
  }
  return contracts;
}

struct Leaf {
  Results results;
  Contract contract;
  bool has_port = false;  // `out`, remapped to the entry that it writes
};

// What stands behind a leaf: takes the next result each time it is asked, and
// does what its contract says of that.
class Script {
 public:
  explicit Script(Leaf leaf) : leaf_(std::move(leaf)) {}

  BT::NodeStatus next(BT::TreeNode& node) {
    const BT::NodeStatus result = leaf_.results.at(next_);
    if (next_ + 1 < leaf_.results.size()) ++next_;
    if (result == BT::NodeStatus::IDLE) throw std::runtime_error("a fault");
    if (result == BT::NodeStatus::SUCCESS) {
      for (const Effect& effect : leaf_.contract.on_success) {
        write(node, effect);
      }
    } else if (result == BT::NodeStatus::FAILURE) {
      for (const Effect& effect : leaf_.contract.on_failure) {
        write(node, effect);
      }
    }
    return result;
  }

 private:
  void write(BT::TreeNode& node, const Effect& effect) const {
    if (effect.value[0] == '"') {
      put(node, effect.entry, effect.value.substr(1, effect.value.size() - 2));
    } else {
      put(node, effect.entry, std::stoi(effect.value));
    }
  }

  // By its port, or past it.
  template <class Value>
  void put(BT::TreeNode& node, const std::string& entry,
           const Value& value) const {
    if (!leaf_.has_port) {
      std::as_const(node).config().blackboard->set(entry, value);
    } else if (const auto set = node.setOutput("out", value); !set) {
      throw std::runtime_error(set.error());
    }
  }

  Leaf leaf_;
  std::size_t next_ = 0;
};

BT::PortsList ports_of(const Leaf& leaf) {
  return leaf.has_port ? BT::PortsList{BT::OutputPort("out")} : BT::PortsList{};
}

// Takes the next result each time it is ticked, whatever its status is.
template <class Base>
class ScriptedLeaf : public Base {
 public:
  ScriptedLeaf(const std::string& name, const Config& config, const Leaf& leaf)
      : Base(name, config), script_(leaf) {}

  static BT::PortsList providedPorts() { return {}; }

 private:
  BT::NodeStatus tick() override { return script_.next(*this); }

  Script script_;
};

class ScriptedAction : public ScriptedLeaf<BT::ActionNodeBase> {
 public:
  using ScriptedLeaf::ScriptedLeaf;

 private:
#if ENGINE_4
  void halt() override { resetStatus(); }
#else
  void halt() override { setStatus(BT::NodeStatus::IDLE); }
#endif
};

using ScriptedCondition = ScriptedLeaf<BT::ConditionNode>;

// Keeps what it has answered until it is reset, as that class has it.
class KeepingAction : public BT::StatefulActionNode {
 public:
  KeepingAction(const std::string& name, const Config& config, const Leaf& leaf)
      : BT::StatefulActionNode(name, config), script_(leaf) {}

  static BT::PortsList providedPorts() { return {}; }

 private:
  BT::NodeStatus onStart() override { return script_.next(*this); }
  BT::NodeStatus onRunning() override { return script_.next(*this); }
  void onHalted() override {}

  Script script_;
};

template <class Node>
void register_leaf(BT::BehaviorTreeFactory& factory, const std::string& id,
                   const Leaf& leaf) {
  factory.registerBuilder(
      BT::CreateManifest<Node>(id, ports_of(leaf)),
      [leaf](const std::string& name, const Config& config) {
        return std::make_unique<Node>(name, config, leaf);
      });
}

void register_leaves(BT::BehaviorTreeFactory& factory, const std::string& xml,
                     const std::map<std::string, Results>& script,
                     const std::map<std::string, Contract>& contracts) {
  const std::regex model("<(Action|Condition) ID=\"([^\"]*)\"(/?)>");
  for (std::sregex_iterator at(xml.begin(), xml.end(), model), end; at != end;
       ++at) {
    const std::string id = (*at)[2];
    Leaf leaf{script.at(id), {}, (*at)[3].length() == 0};
    const auto contract = contracts.find(id);
    if (contract != contracts.end()) leaf.contract = contract->second;
    if ((*at)[1] == "Condition") {
      register_leaf<ScriptedCondition>(factory, id, leaf);
    } else if (leaf.contract.answers_once) {
      register_leaf<KeepingAction>(factory, id, leaf);
    } else {
      register_leaf<ScriptedAction>(factory, id, leaf);
    }
  }
}

// --- Entries ---------------------------------------------------------------

// In 3.8 the entries of the main tree alone are looked at.
inline BT::Blackboard::Ptr blackboard_of(BT::Tree& tree,
                                         const std::string& path) {
#if ENGINE_4
  for (const auto& subtree : tree.subtrees) {
    if (subtree->instance_name == (path == "/" ? "" : path)) {
      return subtree->blackboard;
    }
  }
  return nullptr;
#else
  return path == "/" ? tree.rootBlackboard() : nullptr;
#endif
}

// From 4.2 on an entry is locked.
template <class Blackboard>
std::optional<BT::Any> value_in(Blackboard& board, const std::string& key) {
  if constexpr (requires { board.getAnyLocked(key); }) {
    const auto value = board.getAnyLocked(key);
    return value ? std::optional<BT::Any>(*value.get()) : std::nullopt;
  } else {
    const BT::Any* value = board.getAny(key);
    return value != nullptr ? std::optional<BT::Any>(*value) : std::nullopt;
  }
}
// From 4.1 on a tick by itself has a name of its own.
template <class Tree>
BT::NodeStatus tick(Tree& tree) {
  if constexpr (requires { tree.tickExactlyOnce(); }) {
    return tree.tickExactlyOnce();
  } else {
    return tree.tickRoot();
  }
}

}  // namespace

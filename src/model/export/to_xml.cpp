// SPDX-License-Identifier: MIT
//
// A .btf tree as XML of BehaviorTree.CPP 4: a <BehaviorTree> for the root and
// for each subtree, and a model of every leaf.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "model/btcpp/known_types.hpp"
#include "model/export/told.hpp"
#include "model/tree/node_types.hpp"
#include "text/choice.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace conversion {
namespace {

std::string attribute(std::string_view name, std::string_view value) {
  return fmt::format(" {}=\"{}\"", name, with_entities(value));
}

// A name that a port may have: one of XML that is not the engine's.
bool is_port_name(std::string_view word) {
  const auto may_follow = [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '.';
  };
  return !word.empty() && std::ranges::all_of(word, may_follow) &&
         is_letter(word[0]) && word != "name" && word != "ID";
}

std::string unquoted(std::string_view value) {
  const bool is_quoted =
      value.size() >= 2 && value.front() == '"' && value.back() == '"';
  return std::string(is_quoted ? value.substr(1, value.size() - 2) : value);
}

class XmlWriter {
 public:
  XmlWriter(const BehaviorTree& tree, const SourceText& source, int tick_ms)
      : tree_(tree), told_(tree, source), tick_ms_(tick_ms) {}

  Result<std::string> write() {
    const std::vector<NodeId> trees = subtrees_of(tree_);
    for (std::size_t i = 1; i < tree_.roots.size(); ++i) {
      told_.error(tree_.node(tree_.roots[i]), "several trees run in parallel",
                  "BehaviorTree.CPP runs one: leave one in `(Trees ...)`");
    }
    text_ = fmt::format(
        "<root BTCPP_format=\"4\"{}>\n",
        attribute("main_tree_to_execute", tree_.node(tree_.roots[0]).name));
    for (const NodeId tree : trees) add_tree(tree);
    add_models();
    text_ += "</root>\n";
    Result<std::string> result{std::nullopt, told_.take()};
    if (!has_error(result.diagnostics)) result.value = std::move(text_);
    return result;
  }

 private:
  void add_tree(NodeId id) {
    const Node& node = tree_.node(id);
    if (node.type == NodeType::BehaviorTree && node.loop) {
      told_.left_out(
          node, "`:loop 1` is not carried over",
          fmt::format("say {} when the XML is checked", word(Choice::Loop)));
    }
    text_ +=
        fmt::format("  <BehaviorTree{}>\n", attribute("ID", tree_name(node)));
    add_node(node.children.at(0), 4);
    text_ += "  </BehaviorTree>\n";
  }

  // Trees nest at most 500 deep.
  void add_node(NodeId id, std::size_t indent) {
    const Node& node = tree_.node(id);
    const Counterpart* other = counterpart_of(node.type);
    if (other == nullptr) {
      return told_.error(
          node, fmt::format("BehaviorTree.CPP has no {}", type_name(node.type)),
          "state variables are blackboard entries there, for scripts: convert "
          "a tree without it, and add the scripts by hand");
    }
    told_.differs(node);
    const bool is_leaf_or_tree =
        node.children.empty() || node.type == NodeType::SubTree;
    text_ += fmt::format("{:{}}<{}{}{}", "", indent, element(node, *other),
                         name(node), ports(node));
    if (is_leaf_or_tree) {
      text_ += "/>\n";
      return;
    }
    text_ += ">\n";
    for (const NodeId child : node.children) add_node(child, indent + 2);
    text_ += fmt::format("{:{}}</{}>\n", "", indent, element(node, *other));
  }

  // A leaf's is its ID: the engine refuses the explicit form below reactive
  // nodes.
  static std::string element(const Node& node, const Counterpart& other) {
    if (!other.xml.empty()) return std::string(other.xml);
    const std::string id = leaf_id(node);
    return is_port_name(id) ? id : std::string(type_name(node.type));
  }

  std::string name(const Node& node) const {
    std::string text;
    const bool is_action =
        node.type == NodeType::Action || node.type == NodeType::Condition;
    if (is_action && !is_port_name(leaf_id(node))) {
      text = attribute("ID", leaf_id(node));
    }
    if (node.type == NodeType::SubTree) text = attribute("ID", tree_name(node));
    const bool is_the_id = is_action && node.name == leaf_id(node);
    const bool is_reference =
        node.type == NodeType::SubTree && node.name == tree_name(node);
    if (is_the_id || is_reference || stable_name(node) != node.name) {
      return text;
    }
    return text + attribute("name", node.name);
  }

  static std::string leaf_id(const Node& node) {
    return node.id.empty() ? stable_name(node) : node.id;
  }

  // The options of the type, and its arguments.
  std::string ports(const Node& node) {
    switch (node.type) {
      case NodeType::ReactiveSequence:
      case NodeType::ReactiveFallback:
        tell_of_halting(node);
        break;
      case NodeType::Parallel:
      case NodeType::ParallelAll:
        return parallel(node);
      case NodeType::Repeat:
        return count("num_cycles", node.repetitions);
      case NodeType::RetryUntilSuccessful:
        return count("num_attempts", node.repetitions);
      case NodeType::Recovery:
        return count("number_of_retries", node.repetitions);
      case NodeType::RateController:
        return attribute("hz", fmt::format("{}", node.rate_hz));
      case NodeType::Wait:
      case NodeType::Timeout:
        return milliseconds(node) + arguments(node);
      case NodeType::Action:
      case NodeType::Condition:
        refuse_taken_id(node);
        tell_of_contract(node);
        leaves_[{node.type, leaf_id(node)}];
        break;
      default:
        break;
    }
    return arguments(node);
  }

  static std::string count(std::string_view name, int number) {
    return attribute(name, std::to_string(number));
  }

  std::string parallel(const Node& node) {
    const int children = static_cast<int>(node.children.size());
    tell_of_halting(node);
    return count("success_count", node.threshold) +
           count("failure_count", children - node.threshold + 1);
  }

  void tell_of_halting(const Node& node) {
    if (node.halt) return;
    told_.left_out(
        node,
        fmt::format("`{}` is not carried over",
                    node.wait ? ":wait 1" : ":halt 0"),
        "the engine's halts its children when it answers, as with `:halt 1`");
  }

  std::string milliseconds(const Node& node) {
    const Duration& ticks = *node.duration;
    if (ticks.min != ticks.max) {
      told_.error(node,
                  fmt::format("a duration of {} ticks", duration_text(ticks)),
                  "the engine's is a number of milliseconds: write one number");
    }
    return attribute(
        "msec",
        std::to_string(static_cast<std::int64_t>(ticks.max) * tick_ms_));
  }

  // What its tag would be taken for, if not for the leaf.
  void refuse_taken_id(const Node& node) {
    using enum NodeType;
    const auto* known = btcpp::known_type(BtcppRelease::V4, leaf_id(node));
    if (!known || known->type == Action || known->type == Condition) return;
    told_.error(node,
                fmt::format("`{}` is a node type of the engine", leaf_id(node)),
                "give the leaf another :ID");
  }

  void tell_of_contract(const Node& node) {
    const LeafContract& contract = node.contract;
    const bool may_run = node.type == NodeType::Action;
    const bool is_open = contract.may_succeed && contract.may_fail &&
                         contract.may_run == may_run && !node.duration &&
                         contract.needed().is_true() &&
                         contract.on_success.empty() &&
                         contract.on_failure.empty();
    if (is_open || !told_leaves_.insert(leaf_id(node)).second) return;
    told_.left_out(
        node,
        fmt::format("the contract of `{}` is not carried over", leaf_id(node)),
        fmt::format("say it in a file of leaf contracts, for {}: what it "
                    "returns, its duration, what it requires and writes",
                    word(Choice::Leaves)));
  }

  std::string arguments(const Node& node) {
    std::string text;
    for (const Argument& each : node.arguments) {
      if (!is_port_name(each.key)) {
        told_.left_out(
            node,
            fmt::format("the argument `{}` is not carried over", each.key),
            "no port can have this name");
        continue;
      }
      text += attribute(each.key, unquoted(each.value));
      const bool is_leaf =
          node.type == NodeType::Action || node.type == NodeType::Condition;
      if (is_leaf) leaves_[{node.type, leaf_id(node)}].insert(each.key);
    }
    return text;
  }

  void add_models() {
    if (leaves_.empty()) return;
    text_ += "  <TreeNodesModel>\n";
    for (const auto& [leaf, ports] : leaves_) {
      text_ += fmt::format("    <{}{}", type_name(leaf.first),
                           attribute("ID", leaf.second));
      if (ports.empty()) {
        text_ += "/>\n";
        continue;
      }
      text_ += ">\n";
      for (const std::string& port : ports) {
        text_ +=
            fmt::format("      <input_port{}/>\n", attribute("name", port));
      }
      text_ += fmt::format("    </{}>\n", type_name(leaf.first));
    }
    text_ += "  </TreeNodesModel>\n";
  }

  const BehaviorTree& tree_;
  Told told_;
  const int tick_ms_;
  std::string text_;
  std::map<std::pair<NodeType, std::string>, std::set<std::string>> leaves_;
  std::set<std::string> told_leaves_;
};

}  // namespace
}  // namespace conversion

Result<std::string> xml_text(const BehaviorTree& tree, const SourceText& source,
                             int tick_ms) {
  return conversion::XmlWriter(tree, source, tick_ms).write();
}

}  // namespace btcheck

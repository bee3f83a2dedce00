// SPDX-License-Identifier: MIT
//
// An XML tree as .btf: a (BehaviorTree …) for the root and for each subtree,
// and a contract for every leaf of which more is known than its kind.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/export/told.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace conversion {
namespace {

constexpr std::array<std::string_view, 9> kNotCarried = {
    "_failureIf", "_successIf", "_skipIf",    "_while",
    "_onHalted",  "_onFailure", "_onSuccess", "_post"};

// Of a node's answers, those that its contract allows.
std::string answers_of(const LeafContract& contract) {
  std::vector<std::string_view> words;
  if (contract.may_succeed) words.push_back("success");
  if (contract.may_fail) words.push_back("failure");
  if (contract.may_run) words.push_back("running");
  return fmt::format("{}", fmt::join(words, " "));
}

class BtfWriter {
 public:
  BtfWriter(const BehaviorTree& tree, const SourceText& source, int tick_ms)
      : tree_(tree), told_(tree, source), tick_ms_(tick_ms) {}

  Result<std::string> write() {
    for (const NodeId tree : subtrees_of(tree_)) add_tree(tree);
    if (!tree_.entry_uses.empty()) {
      told_.left_out(tree_.node(tree_.roots[0]),
                     "blackboard entries are not carried over: ports keep the "
                     "text that is written there",
                     "declare by `(defsv ...)` what rules speak of");
    }
    std::string text;
    for (const auto& [name, contract] : contracts_) text += contract;
    text += text_;
    text += fmt::format("(Trees {})\n", word(tree_.node(tree_.roots[0]),
                                             tree_.node(tree_.roots[0]).name));
    Result<std::string> result{std::nullopt, told_.take()};
    if (!has_error(result.diagnostics)) result.value = std::move(text);
    return result;
  }

 private:
  void add_tree(NodeId id) {
    const Node& node = tree_.node(id);
    text_ += fmt::format(
        "(BehaviorTree :name {}{}", word(node, tree_name(node)),
        node.type == NodeType::BehaviorTree && node.loop ? " :loop 1" : "");
    add_node(node.children.at(0), 2);
    text_ += ")\n";
  }

  // The XML nests at most 100 deep.
  void add_node(NodeId id, std::size_t indent) {
    const Node& node = tree_.node(id);
    tell_of_scripts(node);
    const Counterpart* other = counterpart_of(node.type);
    if (other == nullptr || node.type == NodeType::ParallelAll) {
      return told_.error(node, fmt::format(".btf has no {}", node.id),
                         "convert a tree without it");
    }
    told_.differs(node);
    text_ += fmt::format("\n{:{}}({}{}{}", "", indent, type_name(node.type),
                         names(node), keywords(node));
    const bool has_inside =
        !node.children.empty() && node.type != NodeType::SubTree;
    if (has_inside) {
      for (const NodeId child : node.children) add_node(child, indent + 2);
    }
    text_ += ')';
  }

  void tell_of_scripts(const Node& node) {
    for (const auto& [time, script] : node.scripts) {
      told_.error(node,
                  fmt::format(".btf has no {}, as `{}` has",
                              kNotCarried.at(static_cast<std::size_t>(time)),
                              node.name),
                  "write a condition beside the node");
    }
  }

  std::string names(const Node& node) {
    const bool is_leaf =
        node.type == NodeType::Action || node.type == NodeType::Condition;
    std::string text;
    if (is_leaf) text = " :ID " + word(node, node.id);
    if (node.type == NodeType::SubTree) {
      text = " :ID " + word(node, tree_name(node));
    }
    const bool says_more = node.name != node.id && node.name != tree_name(node);
    if (says_more) text += " :name " + word(node, node.name);
    return text;
  }

  std::string keywords(const Node& node) {
    switch (node.type) {
      case NodeType::ReactiveSequence:
      case NodeType::ReactiveFallback:
        return " :halt 1";
      case NodeType::Parallel:
        return parallel(node);
      case NodeType::Repeat:
        return rounds(node, "repeat", 1);
      case NodeType::RetryUntilSuccessful:
        return rounds(node, "num_attempts", 1);
      case NodeType::Recovery:
        return rounds(node, "num_retries", 0);
      case NodeType::RoundRobin:
        tell_of_wrapping(node);
        return "";
      case NodeType::RateController:
        return rate(node);
      case NodeType::Timeout:
        return duration(node, 1);
      case NodeType::Wait:
        return duration(node, 0);
      case NodeType::Action:
      case NodeType::Condition:
        return leaf(node);
      default:
        return "";
    }
  }

  std::string parallel(const Node& node) {
    const int children = static_cast<int>(node.children.size());
    const int successes = threshold_of(node.threshold, children);
    const int failures = threshold_of(node.failure_threshold, children);
    const bool is_said = successes >= 1 && successes <= children &&
                         failures == children - successes + 1 &&
                         !node.counts_skipped;
    // A count of all children is the same as all of them.
    const bool counts_all = node.threshold == -1 && failures == 1;
    if (!is_said && !counts_all) {
      told_.error(node,
                  fmt::format("{} successes or {} failures decide `{}`",
                              successes, failures, node.name),
                  "in .btf it fails when the successes that it needs have "
                  "become impossible");
    }
    return fmt::format(" :success {} :halt 1", successes);
  }

  std::string rounds(const Node& node, std::string_view keyword, int least) {
    if (node.repetitions < least) {
      told_.error(
          node,
          fmt::format("the rounds of `{}` have no number in .btf", node.name),
          node.repetitions == kEndlessRounds
              ? "a mission that does not end is `:loop 1` of its tree"
              : "write the number instead of an entry");
    }
    return fmt::format(" :{} {}", keyword, node.repetitions);
  }

  void tell_of_wrapping(const Node& node) {
    const bool begins_again = wraps_round(tree_.profile) || node.option;
    if (begins_again) return;
    told_.error(node,
                fmt::format("`{}` fails behind its last child", node.name),
                "in .btf it begins again, as with `wrap_around`");
  }

  std::string rate(const Node& node) {
    const std::optional<int> ticks = fixed(node);
    if (!ticks) return "";
    return fmt::format(" :hz {}", 1000.0 / (double{1} * *ticks * tick_ms_));
  }

  std::string duration(const Node& node, int least) {
    const std::optional<int> ticks = fixed(node);
    if (!ticks) return "";
    if (*ticks < least) {
      told_.error(node, fmt::format("`{}` has no limit", node.name),
                  "leave it out: its child alone does the same");
    }
    return fmt::format(" :duration {}", *ticks);
  }

  // Its time in ticks, where that is one number.
  std::optional<int> fixed(const Node& node) {
    if (node.duration && node.duration->min == node.duration->max) {
      return node.duration->min;
    }
    told_.error(node, fmt::format("the time of `{}` is left open", node.name),
                "write a number instead of an entry");
    return std::nullopt;
  }

  std::string leaf(const Node& node) {
    add_contract(node);
    std::string text;
    const bool is_action = node.type == NodeType::Action;
    if (is_action && !node.contract.may_run) text = " :SF";
    if (is_action && node.duration) {
      text += " :duration " + duration_text(*node.duration);
    }
    std::string arguments;
    for (const Argument& each : node.arguments) {
      const bool is_plain =
          each.value.find_first_of("\"\n") == std::string::npos;
      if (!is_plain || !is_word(each.key)) {
        told_.left_out(
            node, fmt::format("the port `{}` is not carried over", each.key));
        continue;
      }
      arguments += fmt::format("{}{} \"{}\"", arguments.empty() ? "" : " ",
                               each.key, each.value);
    }
    if (!arguments.empty()) text += fmt::format(" :args ({})", arguments);
    return text;
  }

  // One for each ID. :SF says already that an action does not run.
  void add_contract(const Node& node) {
    const LeafContract& contract = node.contract;
    if (!told_leaves_.insert(node.id).second) return;
    if (contract.may_skip) {
      told_.left_out(node, fmt::format("`{}` may be skipped, which .btf does "
                                       "not have",
                                       node.id));
    }
    const bool depends = !contract.needed().is_true() ||
                         !contract.on_success.empty() ||
                         !contract.on_failure.empty();
    if (depends) {
      told_.left_out(node,
                     fmt::format("what `{}` requires and writes is not carried "
                                 "over",
                                 node.id),
                     "write it over state variables, in its contract");
    }
    if (contract.may_succeed && contract.may_fail) return;
    contracts_[node.id] = fmt::format(
        "({} {} :returns ({}))\n",
        node.type == NodeType::Action ? "defaction" : "defcondition",
        word(node, node.id), answers_of(contract));
  }

  static bool is_word(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, is_letter) &&
           !(text[0] >= '0' && text[0] <= '9') &&
           text.find_first_not_of("-+.") == 0;
  }
  // What a word of .btf may consist of; bytes of UTF-8 are letters.
  static bool is_letter(char c) {
    return static_cast<unsigned char>(c) > ' ' && c != '(' && c != ')' &&
           c != ';' && c != '"' && c != ':' && c != '$' && c != '[' &&
           c != ']' && c != '.' && c != '@' && c != '=' && c != '<' &&
           c != '>' && c != '~' && c != 127;
  }

  // The name as a word; told where it has to be another one.
  std::string word(const Node& node, const std::string& name) {
    std::string result = name;
    std::ranges::replace_if(
        result, [](char c) { return !is_letter(c); }, '_');
    if (!is_word(result)) result = "n_" + result;
    if (result != name && told_names_.insert(name).second) {
      told_.left_out(node, fmt::format("`{}` is called `{}`", name, result),
                     "a name of .btf is one word");
    }
    return result;
  }

  const BehaviorTree& tree_;
  Told told_;
  const int tick_ms_;
  std::string text_;
  std::map<std::string, std::string> contracts_;
  std::set<std::string> told_leaves_;
  std::set<std::string> told_names_;
};

}  // namespace
}  // namespace conversion

Result<std::string> btf_text(const BehaviorTree& tree, const SourceText& source,
                             int tick_ms) {
  return conversion::BtfWriter(tree, source, tick_ms).write();
}

}  // namespace btcheck

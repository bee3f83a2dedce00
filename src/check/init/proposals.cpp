// SPDX-License-Identifier: MIT
#include "check/init/proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "check/bind/name_help.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

enum class Pattern : std::uint8_t {
  Mission,
  Watched,  // a guard is asked in each tick of an action
  Halted,   // and ends it
  Order,
  Instead,  // where plan A fails, plan B is tried
  Apart,    // never side by side
  Undone,   // what is started is stopped
};
constexpr std::size_t kPatterns = 7;
constexpr std::size_t kMostOfEach = 3;

// Letters, digits and `_`, as names of rules are.
std::string rule_word(const BehaviorTree& tree, NodeId node) {
  std::string word;
  for (const char c : stable_name(tree.node(node))) {
    word += is_letter(c) || is_digit(c) ? lowered(c) : '_';
  }
  return word;
}

class Proposer {
 public:
  explicit Proposer(const BehaviorTree& tree) : tree_(tree) {}

  std::vector<Proposal> run() {
    if (tree_.roots.size() == 1) {
      add(Pattern::Mission, "can_succeed", "The mission can succeed.",
          "possible root.success");
    }
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      const NodeTypeInfo& type = info_of(tree_.nodes[n].type);
      if (type.flow == Flow::OnSuccess) look_at_sequence(NodeId{n});
      if (type.flow == Flow::OnFailure) look_at_fallback(NodeId{n});
      if (type.beside == Beside::Counted) look_at_parallel(NodeId{n});
      if (is_action(NodeId{n})) look_at_undoing(NodeId{n});
    }
    return std::move(found_);
  }

 private:
  bool is_action(NodeId node) const {
    return tree_.node(node).type == NodeType::Action &&
           !sounds_like_condition(tree_.node(node).name);
  }
  bool is_guard(NodeId node) const {
    const NodeType type = tree_.node(node).type;
    return type == NodeType::Condition || type == NodeType::Eval ||
           (type == NodeType::Action &&
            sounds_like_condition(tree_.node(node).name));
  }

  // The first action of the child, itself or below it.
  std::optional<NodeId> action_in(NodeId child) const {
    std::vector<NodeId> open = {child};
    while (!open.empty()) {
      const NodeId node = open.back();
      open.pop_back();
      if (is_action(node)) return node;
      const auto& children = tree_.node(node).children;
      open.insert(open.end(), children.rbegin(), children.rend());
    }
    return std::nullopt;
  }

  void look_at_sequence(NodeId id) {
    const auto& children = tree_.node(id).children;
    for (std::size_t i = 0; i + 1 < children.size(); ++i) {
      const auto next = action_in(children[i + 1]);
      if (!next) continue;
      if (is_guard(children[i])) watch(children[i], *next, "success");
      if (wants(Pattern::Order) && is_action(children[i]) &&
          is_action(children[i + 1])) {
        const std::string first = name_in_rules(tree_, children[i]);
        const std::string second = name_in_rules(tree_, children[i + 1]);
        add(Pattern::Order, rule_word(tree_, children[i + 1]) + "_in_order",
            fmt::format("`{}` is begun only after `{}` has succeeded.", second,
                        first),
            fmt::format("never {}.ticked and not once {}.success", second,
                        first));
      }
    }
  }

  void look_at_fallback(NodeId id) {
    const auto& children = tree_.node(id).children;
    for (std::size_t i = 0; i + 1 < children.size(); ++i) {
      const auto next = action_in(children[i + 1]);
      if (!next) continue;
      if (is_guard(children[i])) {
        watch(children[i], *next, "failure");
      } else if (wants(Pattern::Instead) && is_action(children[i])) {
        const std::string first = name_in_rules(tree_, children[i]);
        const std::string second = name_in_rules(tree_, children[i + 1]);
        add(Pattern::Instead, rule_word(tree_, children[i + 1]) + "_instead",
            fmt::format("Where `{}` fails, `{}` is tried in the same tick.",
                        first, second),
            fmt::format("every tick: {}.answered failure => {}.answer != none",
                        first, second));
      }
    }
  }

  void watch(NodeId guard, NodeId action, std::string_view good) {
    if (!wants(Pattern::Watched)) return;  // nor Halted
    const std::string asked = name_in_rules(tree_, guard);
    const std::string done = name_in_rules(tree_, action);
    add(Pattern::Watched, rule_word(tree_, action) + "_watched",
        fmt::format("While `{}` runs, `{}` is asked in each tick, and answers "
                    "{}.",
                    done, asked, good),
        fmt::format("every tick: {}.answered running => {}.answered {}", done,
                    asked, good));
    const std::string_view bad = good == "success" ? "failure" : "success";
    add(Pattern::Halted, rule_word(tree_, action) + "_halted",
        fmt::format("Where `{}` answers {}, `{}` is halted within the tick.",
                    asked, bad, done),
        fmt::format("whenever {0}.{1} and {2}.status == running then "
                    "{2}.halted within 0 ticks",
                    asked, bad, done));
  }

  void look_at_parallel(NodeId id) {
    const auto& children = tree_.node(id).children;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const auto one = action_in(children[i]);
      for (std::size_t j = i + 1; one && j < children.size(); ++j) {
        if (!wants(Pattern::Apart)) return;
        const auto other = action_in(children[j]);
        if (!other) continue;
        const std::string first = name_in_rules(tree_, *one);
        const std::string second = name_in_rules(tree_, *other);
        add(Pattern::Apart,
            fmt::format("{}_and_{}_apart", rule_word(tree_, *one),
                        rule_word(tree_, *other)),
            fmt::format("`{}` and `{}` never run side by side.", first, second),
            fmt::format("never {}.status == running and {}.status == running",
                        first, second));
      }
    }
  }

  void look_at_undoing(NodeId action) {
    if (!wants(Pattern::Undone)) return;
    const auto undoing = words_of_undoing(tree_.node(action).name);
    if (undoing.empty() || tree_.roots.size() != 1) return;
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (!is_action(NodeId{n}) || words_in(tree_.nodes[n].name) != undoing) {
        continue;
      }
      const std::string begun = name_in_rules(tree_, action);
      const std::string undone = name_in_rules(tree_, NodeId{n});
      return add(Pattern::Undone, rule_word(tree_, action) + "_undone",
                 fmt::format("The mission never ends between `{}` and `{}`.",
                             begun, undone),
                 fmt::format("absent root.ended between {}.success and "
                             "{}.ticked",
                             begun, undone));
    }
  }

  // Asked before names are made, which takes as long as the tree is large.
  bool wants(Pattern pattern) const {
    return counts_[static_cast<std::size_t>(pattern)] < kMostOfEach;
  }

  void add(Pattern pattern, std::string name, std::string title,
           std::string body) {
    ++counts_[static_cast<std::size_t>(pattern)];
    std::string unique = name;
    for (int i = 2; !names_.insert(unique).second; ++i) {
      unique = fmt::format("{}_{}", name, i);
    }
    found_.push_back({std::move(unique), std::move(title), std::move(body)});
  }

  const BehaviorTree& tree_;
  std::vector<Proposal> found_;
  std::set<std::string> names_;
  std::array<std::size_t, kPatterns> counts_{};
};

}  // namespace

std::vector<Proposal> proposals_for(const BehaviorTree& tree) {
  const Stage stage("rules were proposed");
  return Proposer(tree).run();
}

}  // namespace btcheck

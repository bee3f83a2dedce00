// SPDX-License-Identifier: MIT
//
// Most types are told by their row (node_types). What stands here is what ids
// of types say more, and what is known of leaves.
#include "report/text/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "model/btcpp/known_types.hpp"

namespace btcheck {
namespace {

struct IdSentence {
  std::string_view id;
  std::string_view text;
};
// Types that are lowered as one of several, and say more by their names.
constexpr auto kOfIds = std::to_array<IdSentence>({
    {"ScriptCondition",
     "Succeeds where its script is true, and fails where it is not."},
    {"SetBlackboard", "Writes a value to an entry of the blackboard."},
    {"UnsetBlackboard", "Removes an entry of the blackboard."},
    {"WasEntryUpdated",
     "Succeeds where an entry of the blackboard has been written since the "
     "last time."},
    {"SkipUnlessUpdated",
     "Ticks its child where an entry of the blackboard has been written since "
     "the last time; else it is skipped."},
    {"WaitValueUpdate",
     "Runs until an entry of the blackboard has been written, then ticks its "
     "child."},
    {"AlwaysSuccess", "Succeeds."},
    {"AlwaysFailure", "Fails."},
    {"DistanceController",
     "Ticks its child when the robot has come so far, and whenever it runs."},
    {"SpeedController",
     "Ticks its child the more often the faster the robot is, and whenever it "
     "runs."},
    {"GoalUpdatedController",
     "Ticks its child when the goal has changed, and whenever it runs."},
});

// "success, failure or running".
std::string answers_of(const LeafContract& contract) {
  std::vector<std::string_view> words;
  if (contract.may_succeed) words.push_back("success");
  if (contract.may_fail) words.push_back("failure");
  if (contract.may_run) words.push_back("running");
  if (contract.may_skip) words.push_back("skipped");
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text.empty() ? "nothing" : text;
}

// Whose program has the leaf.
std::string_view owner_of(const Node& node, Profile profile) {
  const bool is_of_py_trees =
      profile == Profile::PyTrees &&
      btcpp::builtin_type(BtcppRelease::PyTrees, node.id) != nullptr;
  if (is_of_py_trees) return "py_trees";
  return has_nav2(profile) && btcpp::nav2_type(node.id) != nullptr
             ? "Nav2"
             : "the program";
}

}  // namespace

std::string type_text(const Node& node, Profile profile) {
  const auto own = std::ranges::find(kOfIds, node.id, &IdSentence::id);
  if (own != kOfIds.end()) return std::string(own->text);
  const std::string_view text = info_of(node.type).about;
  if (!text.empty()) return std::string(text);
  if (!is_leaf(node.type)) return {};
  return fmt::format(
      "{} of {}; it may answer {}.",
      node.type == NodeType::Condition ? "A condition" : "An action",
      owner_of(node, profile), answers_of(node.contract));
}

}  // namespace btcheck

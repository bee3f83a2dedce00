// SPDX-License-Identifier: MIT
#include "reference/random_xml_tree.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "reference/random_tree.hpp"

namespace btcheck::reference {
namespace {

// A node with children: its ID, how many it takes, its ports with `#` for a
// small number, and where it is to be had.
enum class Where : std::uint8_t { Everywhere, Release3, Release4, Nav2, Main };
struct Inner {
  std::string_view id;
  int least;
  int most;
  std::string_view ports;
  Where where = Where::Everywhere;
};

constexpr auto kInner = std::to_array<Inner>({
    {"Sequence", 1, 3, ""},
    {"Fallback", 1, 3, ""},
    {"ReactiveSequence", 1, 3, ""},
    {"ReactiveFallback", 1, 3, ""},
    {"IfThenElse", 2, 3, "", Where::Release4},
    {"IfThenElse", 3, 3, "", Where::Release3},
    {"WhileDoElse", 2, 3, "", Where::Release4},
    {"WhileDoElse", 3, 3, "", Where::Release3},
    {"Switch2", 3, 3, " variable=\"{e}\" case_1=\"1\" case_2=\"2\""},
    {"Inverter", 1, 1, ""},
    {"ForceSuccess", 1, 1, ""},
    {"ForceFailure", 1, 1, ""},
    {"KeepRunningUntilFailure", 1, 1, ""},
    {"Repeat", 1, 1, " num_cycles=\"#\""},
    {"RetryUntilSuccessful", 1, 1, " num_attempts=\"#\""},
    {"Timeout", 1, 1, " msec=\"#00\""},
    {"Delay", 1, 1, " delay_msec=\"#00\""},
    {"SequenceStar", 1, 3, "", Where::Release3},
    {"Parallel", 2, 3, " success_threshold=\"#\" failure_threshold=\"1\"",
     Where::Release3},
    {"Parallel", 2, 3, " success_threshold=\"1\" failure_threshold=\"2\"",
     Where::Release3},
    {"SequenceWithMemory", 1, 3, "", Where::Release4},
    {"AsyncSequence", 1, 3, "", Where::Release4},
    {"AsyncFallback", 1, 3, "", Where::Release4},
    {"Parallel", 2, 3, " success_count=\"#\" failure_count=\"#\"",
     Where::Release4},
    {"Parallel", 2, 3, "", Where::Release4},
    {"ParallelAll", 1, 3, " max_failures=\"1\"", Where::Release4},
    {"TryCatch", 2, 3, "", Where::Release4},
    {"TryCatch", 2, 3, " catch_on_halt=\"true\"", Where::Release4},
    {"RunOnce", 1, 1, "", Where::Release4},
    {"RunOnce", 1, 1, " then_skip=\"false\"", Where::Release4},
    {"Precondition", 1, 1, " if=\"p\" else=\"RUNNING\"", Where::Release4},
    {"Precondition", 1, 1, " if=\"p\" else=\"SKIPPED\"", Where::Release4},
    {"LoopInt", 1, 1, " queue=\"1;2\" value=\"{v}\"", Where::Release4},
    {"SkipUnlessUpdated", 1, 1, " entry=\"{u}\"", Where::Release4},
    {"WaitValueUpdate", 1, 1, " entry=\"{u}\"", Where::Release4},
    {"RecoveryNode", 2, 2, " number_of_retries=\"#\"", Where::Nav2},
    {"PipelineSequence", 1, 3, "", Where::Nav2},
    {"RoundRobin", 1, 3, "", Where::Nav2},
    {"RoundRobin", 1, 3, " wrap_around=\"true\"", Where::Main},
    {"RateController", 1, 1, " hz=\"5\"", Where::Nav2},
    {"DistanceController", 1, 1, "", Where::Nav2},
    {"GoalUpdatedController", 1, 1, "", Where::Nav2},
    {"PathLongerOnApproach", 1, 1, "", Where::Nav2},
    {"SingleTrigger", 1, 1, "", Where::Nav2},
    {"NonblockingSequence", 1, 3, "", Where::Main},
});

class Writer {
 public:
  Writer(std::uint64_t seed, Profile profile)
      : random_(seed), profile_(profile) {
    for (const Inner& inner : kInner) {
      if (is_had(inner.where)) inner_.push_back(&inner);
    }
    left_ = 3 + random_.below(9);
  }

  std::string text() {
    // Compact tags with their models: some releases refuse the explicit form
    // directly in a ReactiveSequence.
    const std::string tree = node(0);
    std::string models;
    for (int i = 1; i <= actions_; ++i) {
      models += fmt::format("<Action ID=\"a{}\"/>", i);
    }
    for (int i = 1; i <= conditions_; ++i) {
      models += fmt::format("<Condition ID=\"c{}\"/>", i);
    }
    return fmt::format(
        "<root BTCPP_format=\"{}\">\n<BehaviorTree ID=\"T\">\n{}"
        "</BehaviorTree>\n<TreeNodesModel>{}</TreeNodesModel>\n</root>\n",
        is_release_3(profile_) ? 3 : 4, tree, models);
  }

 private:
  bool is_had(Where where) const {
    switch (where) {
      case Where::Everywhere:
        return true;
      case Where::Release3:
        return is_release_3(profile_);
      case Where::Release4:
        return !is_release_3(profile_);
      case Where::Nav2:
        return has_nav2(profile_);
      case Where::Main:
        return profile_ == Profile::Nav2Main;
    }
    return false;
  }

  std::string node(int depth) {
    --left_;
    if (depth > 0 && (left_ <= 0 || depth >= 5 || random_.percent(30))) {
      return leaf();
    }
    const Inner& inner = *inner_[static_cast<std::size_t>(
        random_.below(static_cast<int>(inner_.size())))];
    std::string ports(inner.ports);
    for (char& c : ports) {
      if (c == '#') c = static_cast<char>('1' + random_.below(2));
    }
    std::string text = fmt::format("<{}{}{}>\n", inner.id, ports, conditions());
    const int count = inner.least + random_.below(inner.most - inner.least + 1);
    for (int i = 0; i < count; ++i) text += node(depth + 1);
    return text + fmt::format("</{}>\n", inner.id);
  }

  std::string leaf() {
    const int kind = random_.below(has_nav2(profile_) ? 10 : 8);
    if (kind < 5) {
      return fmt::format("<a{}{}/>\n", ++actions_, conditions());
    }
    if (kind < 8 && !is_release_3(profile_) && random_.percent(25)) {
      return fmt::format("<Sleep msec=\"{}00\"/>\n", 1 + random_.below(2));
    }
    if (kind < 8) {
      return fmt::format("<c{}{}/>\n", ++conditions_, conditions());
    }
    constexpr std::array<std::string_view, 4> kNav2 = {
        "GoalUpdated", "GlobalUpdatedGoal", "PathExpiringTimer",
        "TransformAvailable"};
    return fmt::format(
        "<{}/>\n",
        kNav2[static_cast<std::size_t>(random_.below(kNav2.size()))]);
  }

  std::string conditions() {
    if (is_release_3(profile_) || !random_.percent(25)) return "";
    constexpr std::array<std::string_view, 4> kNames = {
        "_failureIf", "_successIf", "_skipIf", "_while"};
    std::string text;
    for (const std::string_view name : kNames) {
      const bool is_skip = name == "_skipIf" || name == "_while";
      if (random_.percent(is_skip ? 50 : 15)) {
        text += fmt::format(" {}=\"x{}\"", name, ++entries_);
      }
    }
    return text;
  }

  SplitMix64 random_;
  Profile profile_;
  std::vector<const Inner*> inner_;
  int left_ = 0;
  int actions_ = 0;
  int conditions_ = 0;
  int entries_ = 0;
};

}  // namespace

std::string random_xml_tree(std::uint64_t seed, Profile profile) {
  return Writer(seed, profile).text();
}

}  // namespace btcheck::reference

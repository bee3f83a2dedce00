// SPDX-License-Identifier: MIT
#include "reference/random_xml_nodes.hpp"

#include <array>

#include "model/btcpp/known_types.hpp"
#include "model/tree/releases.hpp"

namespace btcheck::reference {
namespace {

constexpr auto kInner = std::to_array<InnerNode>({
    {"Sequence", 1, 3, ""},
    {"Fallback", 1, 3, ""},
    {"ReactiveSequence", 1, 3, ""},
    {"ReactiveFallback", 1, 3, ""},
    {"IfThenElse", 2, 3, ""},
    {"WhileDoElse", 2, 3, "", Where::Release4},
    {"WhileDoElse", 3, 3, "", Where::Release3},
    {"Switch2", 3, 3, " variable=\"{$}\" case_1=\"1\" case_2=\"2\"",
     Where::Everywhere, World::Open},
    {"Switch2", 3, 3, " variable=\"{$}\" case_1=\"1\" case_2=\"2\"",
     Where::Release4, World::Scripted},
    {"Switch3", 4, 4,
     " variable=\"{$}\" case_1=\"0\" case_2=\"1\" case_3=\"a\"",
     Where::Release4, World::Scripted},
    {"Switch2", 3, 3, " variable=\"{v1}\" case_1=\"1\" case_2=\"a\"",
     Where::Release3, World::Scripted},
    {"BlackboardCheckInt", 1, 1,
     " value_A=\"{v1}\" value_B=\"1\" return_on_mismatch=\"FAILURE\"",
     Where::Release3, World::Scripted},
    {"BlackboardCheckString", 1, 1,
     " value_A=\"{v1}\" value_B=\"{v2}\" return_on_mismatch=\"SUCCESS\"",
     Where::Release3, World::Scripted},
    {"BlackboardCheckDouble", 1, 1,
     " value_A=\"2.0\" value_B=\"{v2}\" return_on_mismatch=\"RUNNING\"",
     Where::Release3, World::Scripted},
    {"BlackboardCheckBool", 1, 1,
     " value_A=\"{v2}\" value_B=\"true\" return_on_mismatch=\"FAILURE\"",
     Where::Release3, World::Scripted},
    {"Inverter", 1, 1, ""},
    {"ForceSuccess", 1, 1, ""},
    {"ForceFailure", 1, 1, ""},
    {"KeepRunningUntilFailure", 1, 1, ""},
    {"Repeat", 1, 1, " num_cycles=\"#\""},
    {"Repeat", 1, 1, " num_cycles=\"-1\"", Where::Release4},
    {"RetryUntilSuccessful", 1, 1, " num_attempts=\"#\""},
    {"RetryUntilSuccessful", 1, 1, " num_attempts=\"-1\"", Where::Release4},
    {"RetryUntilSuccesful", 1, 1, " num_attempts=\"#\"", Where::Misspelt},
    {"Timeout", 1, 1, " msec=\"#00\"", Where::Everywhere, World::Open},
    {"Timeout", 1, 1, " msec=\"#50\"", Where::Everywhere, World::Clocked},
    {"Timeout", 1, 1, " msec=\"0\""},
    {"Timeout", 1, 1, " msec=\"3600000\""},
    {"Delay", 1, 1, " delay_msec=\"#00\"", Where::Everywhere, World::Open},
    {"Delay", 1, 1, " delay_msec=\"#50\"", Where::Everywhere, World::Clocked},
    {"Delay", 1, 1, " delay_msec=\"3600000\""},
    {"SequenceStar", 1, 3, "", Where::Release3},
    {"Parallel", 2, 3, " threshold=\"#\"", Where::OneThreshold},
    {"Parallel", 2, 3, " success_threshold=\"#\" failure_threshold=\"1\"",
     Where::TwoThresholds},
    {"Parallel", 2, 3, " success_threshold=\"1\" failure_threshold=\"2\"",
     Where::TwoThresholds},
    {"SequenceWithMemory", 1, 3, "", Where::Release4},
    {"AsyncSequence", 1, 3, "", Where::Release4},
    {"AsyncFallback", 1, 3, "", Where::Release4},
    {"Parallel", 2, 3, " success_count=\"#\" failure_count=\"#\"",
     Where::Release4},
    {"Parallel", 2, 3, " success_count=\"-#\" failure_count=\"-#\"",
     Where::Release4},
    {"Parallel", 2, 3, "", Where::Release4},
    {"ParallelAll", 1, 3, " max_failures=\"1\"", Where::Release4},
    {"ParallelAll", 1, 3, " max_failures=\"-1\"", Where::Release4},
    {"TryCatch", 2, 3, "", Where::Release4},
    {"TryCatch", 2, 3, " catch_on_halt=\"true\"", Where::Release4},
    {"RunOnce", 1, 1, "", Where::Release4},
    {"RunOnce", 1, 1, " then_skip=\"false\"", Where::Release4},
    {"Precondition", 1, 1, " if=\"?\" else=\"RUNNING\"", Where::Release4},
    {"Precondition", 1, 1, " if=\"?\" else=\"SKIPPED\"", Where::Release4},
    {"Precondition", 1, 1, " if=\"?\" else=\"FAILURE\"", Where::Release4},
    {"LoopInt", 1, 1, " queue=\"1;2\" value=\"{v}\"", Where::Release4},
    {"LoopString", 1, 1, " queue=\"a;b;c\" if_empty=\"FAILURE\" value=\"{w}\"",
     Where::Release4},
    {"LoopInt", 1, 1, " queue=\"7\" if_empty=\"SKIPPED\" value=\"{v}\"",
     Where::Release4},
    {"LoopString", 1, 1, " queue=\"c;d\" if_empty=\"RUNNING\" value=\"{w}\"",
     Where::Release4},
    {"SkipUnlessUpdated", 1, 1, " entry=\"{u}\"", Where::Release4, World::Open},
    {"WaitValueUpdate", 1, 1, " entry=\"{u}\"", Where::Release4, World::Open},
    {"RecoveryNode", 2, 2, " number_of_retries=\"#\"", Where::Nav2},
    {"PipelineSequence", 1, 3, "", Where::Nav2},
    {"RoundRobin", 1, 3, "", Where::Nav2},
    {"RoundRobin", 1, 3, " wrap_around=\"true\"", Where::Main},
    {"RateController", 1, 1, " hz=\"5\"", Where::Nav2, World::Open},
    {"RateController", 1, 1, " hz=\"0.000278\"", Where::Nav2, World::Scripted},
    {"RateController", 1, 1, " hz=\"4\"", Where::Nav2, World::Clocked},
    {"RateController", 1, 1, " hz=\"6.6666667\"", Where::Nav2, World::Clocked},
    {"DistanceController", 1, 1, "", Where::Nav2, World::Open},
    {"GoalUpdatedController", 1, 1, "", Where::Nav2, World::Open},
    {"PathLongerOnApproach", 1, 1, "", Where::Nav2, World::Open},
    {"SingleTrigger", 1, 1, "", Where::Nav2},
    {"NonblockingSequence", 1, 3, "", Where::Main},
});

bool is_had(Where where, Profile profile) {
  const int release = engine_release(profile);
  switch (where) {
    case Where::Everywhere:
      return true;
    case Where::Release3:
      return is_release_3(profile);
    case Where::Misspelt:
      return releases::kMisspellsRetry.has(release);
    case Where::OneThreshold:
      return releases::kHasOneThreshold.has(release);
    case Where::TwoThresholds:
      return is_release_3(profile) && !releases::kHasOneThreshold.has(release);
    case Where::Release4:
      return !is_release_3(profile);
    case Where::Nav2:
      return has_nav2(profile);
    case Where::Main:
      return profile == Profile::Nav2Main;
  }
  return false;
}

}  // namespace

std::vector<InnerNode> inner_nodes(Profile profile, World world) {
  std::vector<InnerNode> nodes;
  for (const InnerNode& node : kInner) {
    const bool suits =
        node.world == World::Any || node.world == world ||
        (node.world == World::Scripted && world == World::Clocked);
    const bool is_there =
        is_had(node.where, profile) &&
        btcpp::first_release(node.id) <= engine_release(profile);
    if (suits && is_there) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace btcheck::reference

// SPDX-License-Identifier: MIT
#include "model/btcpp/nav2_branches.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <string>

#include "model/btcpp/findings.hpp"
#include "model/btcpp/known_types.hpp"

namespace btcheck::btcpp {
namespace {

std::string names_of(Nav2Branches branches) {
  using enum Nav2Branch;
  std::vector<std::string> names;
  for (const Nav2Branch branch :
       {Galactic, Humble, Iron, Jazzy, Kilted, Lyrical}) {
    if (!branches.has(branch)) continue;
    if (branch == Lyrical) {
      names.emplace_back(profile_name(Profile::Nav2Lyrical));
    }
    names.emplace_back(profile_name(profile_of_branch(branch)));
  }
  return listed(names);
}

class BranchCheck {
 public:
  BranchCheck(const BtcppDocument& document, Profile profile)
      : document_(document),
        profile_(profile),
        branch_(branch_of(profile)),
        findings_(document.files) {}

  std::vector<Diagnostic> check() {
    for (const BtcppTree& tree : document_.trees) {
      for (const BtcppNode& node : tree.nodes) look_at(node);
    }
    return findings_.take();
  }

 private:
  void look_at(const BtcppNode& node) {
    const NodeTypeRow* type = nav2_type(node.id);
    const bool is_other = builtin_type(document_.release, node.id) != nullptr ||
                          document_.model(node.id) != nullptr;
    if (type == nullptr || is_other) return;
    if (!type->branches.has(branch_)) return warn_of_type(node, *type);
    for (const BtcppAttribute& port : node.ports) {
      const Nav2Branches have = branches_with_port(node.id, port.name);
      if (!have.has(branch_)) refuse_port(node, port, have);
    }
  }

  // Once for each type.
  void warn_of_type(const BtcppNode& node, const NodeTypeRow& type) {
    if (!told_.insert(node.id).second) return;
    findings_.warning(
        node.place,
        {"BT1654",
         fmt::format("{} has no node `{}`", profile_name(profile_), node.id),
         "taken as one of the project's own, which does the same",
         fmt::format("it is a node of {}", names_of(type.branches))});
  }

  void refuse_port(const BtcppNode& node, const BtcppAttribute& port,
                   Nav2Branches have) {
    findings_.error(
        port.name_place,
        {"BT1609",
         fmt::format("`{}` of {} has no port `{}`", node.id,
                     profile_name(profile_), port.name),
         "unknown port",
         fmt::format("delete it; it is a port of {}", names_of(have))});
  }

  const BtcppDocument& document_;
  Profile profile_;
  Nav2Branch branch_;
  FileFindings findings_;
  std::set<std::string> told_;
};

}  // namespace

std::vector<Diagnostic> missing_in_branch(const BtcppDocument& document,
                                          Profile profile) {
  return BranchCheck(document, profile).check();
}

namespace {

// Ports of Nav2's nodes that only some branches know; "" for any node.
struct PortOfBranches {
  std::string_view node;
  std::string_view port;
  Nav2Branches branches;
};
constexpr std::array kPortsOfBranches = {
    PortOfBranches{"SpeedController", "filter_duration", kGalactic},
    PortOfBranches{"BackUp", "time_allowance", kFromHumble},
    PortOfBranches{"Spin", "time_allowance", kFromHumble},
    PortOfBranches{"Spin", "is_recovery", kFromHumble},
    PortOfBranches{"NavigateToPose", "behavior_tree", kFromHumble},
    PortOfBranches{"NavigateThroughPoses", "behavior_tree", kFromHumble},
    PortOfBranches{"RoundRobin", "wrap_around", kFromLyrical},
    PortOfBranches{"", "error_msg", kFromKilted},
    PortOfBranches{"", "error_code_id", kFromIron},
    PortOfBranches{"", "disable_collision_checks", kFromKilted},
    PortOfBranches{"FollowPath", "progress_checker_id", kFromIron},
    PortOfBranches{"FollowPath", "path_handler_id", kFromLyrical},
    PortOfBranches{"FollowPath", "tracking_feedback", kFromLyrical},
    PortOfBranches{"ComputePathToPose", "viapoints", kFromLyrical},
    PortOfBranches{"ComputePathToPose", "use_start", kFromJazzy},
    PortOfBranches{"GoalUpdater", "input_goals", kFromKilted},
    PortOfBranches{"GoalUpdater", "output_goals", kFromKilted},
    PortOfBranches{"GoalUpdated", "goal", kFromJazzy},
    PortOfBranches{"GoalUpdated", "goals", kFromJazzy},
    PortOfBranches{"GlobalUpdatedGoal", "goal", kFromJazzy},
    PortOfBranches{"GlobalUpdatedGoal", "goals", kFromJazzy},
    PortOfBranches{"IsPathValid", "max_cost", kKilted},
    PortOfBranches{"IsPathValid", "consider_unknown_as_obstacle", kKilted},
    PortOfBranches{"GoalReached", "global_frame", kUntilJazzy},
    PortOfBranches{"RemovePassedGoals", "global_frame", kUntilJazzy},
    PortOfBranches{"TruncatePathLocal", "robot_frame", kUntilKilted},
    PortOfBranches{"TruncatePathLocal", "robot_base_frame", kFromLyrical}};

Nav2Branches branches_for(const BtcppNode& node, const NodeTypeRow& type) {
  Nav2Branches branches = type.branches;
  for (const BtcppAttribute& port : node.ports) {
    branches = branches & branches_with_port(node.id, port.name);
  }
  return branches;
}

}  // namespace

Nav2Branches branches_with_port(std::string_view node, std::string_view port) {
  Nav2Branches branches = Nav2Branches::all();
  for (const PortOfBranches& row : kPortsOfBranches) {
    const bool is_meant = row.node.empty() || row.node == node;
    if (is_meant && row.port == port) branches = branches & row.branches;
  }
  return branches;
}

std::vector<std::string_view> ports_of_branches(std::string_view node) {
  std::vector<std::string_view> ports;
  for (const PortOfBranches& row : kPortsOfBranches) {
    if (row.node == node) ports.push_back(row.port);
  }
  return ports;
}

Nav2Branches branches_for(const BtcppDocument& document) {
  constexpr Nav2Branches kOn3 =
      Nav2Branches::between(Nav2Branch::Galactic, Nav2Branch::Iron);
  Nav2Branches branches =
      document.release == BtcppRelease::V3 ? kOn3 : kFromJazzy;
  for (const BtcppTree& tree : document.trees) {
    for (const BtcppNode& node : tree.nodes) {
      const NodeTypeRow* type = nav2_type(node.id);
      const bool is_other =
          builtin_type(document.release, node.id) != nullptr ||
          document.model(node.id) != nullptr;
      if (type == nullptr || is_other) continue;
      branches = branches & branches_for(node, *type);
    }
  }
  return branches;
}

}  // namespace btcheck::btcpp

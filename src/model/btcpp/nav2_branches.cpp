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

}  // namespace btcheck::btcpp

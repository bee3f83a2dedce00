// SPDX-License-Identifier: MIT
//
// Each node gets a set of results that it may return, from its children's; the
// sets are too large rather than too small. A child is not reached when the
// children before it can only return what ends the round.
#include "model/btcpp/expand/reachability.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/attributes.hpp"

namespace btcheck::btcpp {
namespace {

using Results = std::uint8_t;
constexpr Results kSuccess = 1;
constexpr Results kFailure = 2;
constexpr Results kRunning = 4;
constexpr Results kSkipped = 8;
constexpr Results kAll = 15;

// Which results of a child let its parent go on to the next one.
std::optional<Results> passing(std::string_view type) {
  if (type == "Sequence" || type == "AsyncSequence" ||
      type == "SequenceWithMemory" || type == "SequenceStar" ||
      type == "ReactiveSequence") {
    return kSuccess | kSkipped;
  }
  if (type == "Fallback" || type == "AsyncFallback" ||
      type == "ReactiveFallback") {
    return kFailure | kSkipped;
  }
  // A child that runs lets the next one be ticked, if that was reached before.
  if (type == "PipelineSequence") return kSuccess | kSkipped | kRunning;
  return std::nullopt;
}

struct FixedResults {
  std::string_view type;
  Results results;
};

class Reachability {
 public:
  Reachability(const BtcppExpansion& expansion, FileFindings& findings)
      : expansion_(expansion),
        findings_(findings),
        results_(expansion.nodes.size(), kAll) {}

  // Children have larger numbers than their parents.
  void check() {
    for (std::size_t i = expansion_.nodes.size(); i-- > 0;) {
      const BtcppInstance& instance = expansion_.nodes[i];
      check_children(instance);
      results_[i] = with_conditions(instance, results_of(instance));
    }
  }

 private:
  Results child(const BtcppInstance& instance, std::size_t which) const {
    return which < instance.children.size() ? results_[instance.children[which]]
                                            : kAll;
  }

  Results results_of(const BtcppInstance& instance) const {
    const BtcppNode& node = *instance.node;
    constexpr std::array kFixed = {
        FixedResults{"AlwaysSuccess", kSuccess},
        FixedResults{"AlwaysFailure", kFailure},
        FixedResults{"Script", kSuccess},
        FixedResults{"ScriptCondition", kSuccess | kFailure},
        FixedResults{"UnsetBlackboard", kSuccess},
        FixedResults{"Sleep", kSuccess | kRunning},
        FixedResults{"SetBlackboard", kSuccess | kFailure}};
    for (const FixedResults& row : kFixed) {
      if (row.type == node.id) return row.results;
    }
    if (passing(node.id)) return results_in_turn(instance);
    if (node.kind == BtcppKind::SubTree) return child(instance, 0);
    if (node.kind == BtcppKind::Decorator) return decorated(instance);
    return kAll;
  }

  Results results_in_turn(const BtcppInstance& instance) const {
    const Results pass = *passing(instance.node->id);
    Results all = 0;
    bool goes_on = true;
    for (std::size_t i = 0; goes_on && i < instance.children.size(); ++i) {
      const Results one = child(instance, i);
      all |= static_cast<Results>(one & ~pass) | (one & kRunning);
      goes_on = (one & pass) != 0;
      if (i + 1 == instance.children.size() && goes_on) {
        all |= static_cast<Results>(pass | kSkipped) & ~kRunning;
      }
    }
    return static_cast<Results>(all);
  }

  Results decorated(const BtcppInstance& instance) const {
    const std::string& type = instance.node->id;
    const Results below = child(instance, 0);
    const Results kept = below & (kRunning | kSkipped);
    const Results done = below & (kSuccess | kFailure);
    if (type == "Inverter") {
      return static_cast<Results>(kept |
                                  ((below & kSuccess) != 0 ? kFailure : 0) |
                                  ((below & kFailure) != 0 ? kSuccess : 0));
    }
    if (type == "ForceSuccess") return kept | (done != 0 ? kSuccess : 0);
    if (type == "ForceFailure") return kept | (done != 0 ? kFailure : 0);
    if (type == "KeepRunningUntilFailure") {
      return kRunning | (below & kFailure);
    }
    return kAll;
  }

  static Results with_conditions(const BtcppInstance& instance,
                                 Results results) {
    for (const BtcppAttribute& condition : instance.node->conditions) {
      if (condition.name == "_failureIf") results |= kFailure;
      if (condition.name == "_successIf") results |= kSuccess;
      if (condition.name == "_skipIf") results |= kSkipped;
      if (condition.name == "_while") results |= kSkipped;
    }
    return results;
  }

  void check_children(const BtcppInstance& instance) {
    const std::string& type = instance.node->id;
    if (passing(type)) check_turns(instance);
    if (type == "IfThenElse" || type == "WhileDoElse") check_choice(instance);
    if (type.starts_with("Switch")) check_cases(instance);
    if (type == "RecoveryNode" && (child(instance, 0) & kFailure) == 0) {
      report(instance, 1, "the child before it cannot fail");
    }
    if (type == "Repeat") check_rounds(instance, "num_cycles");
    if (type == "RetryUntilSuccessful") check_rounds(instance, "num_attempts");
  }

  void check_turns(const BtcppInstance& instance) {
    const Results pass = *passing(instance.node->id);
    for (std::size_t i = 0; i + 1 < instance.children.size(); ++i) {
      if ((child(instance, i) & pass) != 0) continue;
      return report(instance, i + 1,
                    (pass & kSuccess) != 0 ? "a child before it cannot succeed"
                                           : "a child before it cannot fail");
    }
  }

  void check_choice(const BtcppInstance& instance) {
    const Results condition = child(instance, 0);
    if ((condition & kSuccess) == 0) {
      report(instance, 1, "the condition cannot succeed");
    }
    if ((condition & kFailure) == 0) {
      report(instance, 2, "the condition cannot fail");
    }
  }

  // The first case that matches is taken.
  void check_cases(const BtcppInstance& instance) {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i + 1 < instance.children.size(); ++i) {
      const BtcppAttribute* port =
          find_attribute(instance.node->ports, fmt::format("case_{}", i + 1));
      if (port == nullptr) continue;
      const auto [same, is_new] = first.emplace(port->value, i + 1);
      if (is_new) continue;
      report(instance, i,
             fmt::format("`case_{}` has the same value", same->second));
    }
  }

  void check_rounds(const BtcppInstance& instance, std::string_view port) {
    const BtcppAttribute* rounds = find_attribute(instance.node->ports, port);
    if (rounds == nullptr || parse_integer(rounds->value) != 0) return;
    report(instance, 0, fmt::format("`{}` is 0", port));
  }

  void report(const BtcppInstance& parent, std::size_t which, std::string why) {
    if (which >= parent.children.size()) return;
    const BtcppNode& node = *expansion_.nodes[parent.children[which]].node;
    findings_.warning(
        node.place,
        {"BT1629", fmt::format("`{}` is never ticked", node.id), std::move(why),
         "delete it, or mend what stands before it"});
  }

  const BtcppExpansion& expansion_;
  FileFindings& findings_;
  std::vector<Results> results_;
};

}  // namespace

void check_reachability(const BtcppExpansion& expansion,
                        FileFindings& findings) {
  Reachability(expansion, findings).check();
}

}  // namespace btcheck::btcpp

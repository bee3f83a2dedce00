// SPDX-License-Identifier: MIT
//
// Version 4: `a="{b}"` remaps, `a="b"` gives the entry a value, `_autoremap`
// lets every name through that does not begin with `_`. Version 3: a SubTree
// remaps without braces, or shares the blackboard by `__shared_blackboard`; a
// SubTreePlus is version 4's SubTree with `__autoremap`.
#include "model/btcpp/expand/subtrees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "model/btcpp/literals.hpp"
#include "model/btcpp/names.hpp"

namespace btcheck::btcpp {
namespace {

bool read_flag(const BtcppNode& node, std::string_view name,
               FileFindings& findings) {
  const BtcppAttribute* flag = find_attribute(node.others, name);
  if (flag == nullptr) return false;
  const std::optional<bool> value = parse_bool(flag->value);
  if (!value) {
    findings.error(
        flag->place,
        {"BT1610", fmt::format("`{}` is no Boolean", flag->value),
         fmt::format("the value of `{}`", name), "write `true` or `false`"});
  }
  return value.value_or(false);
}

BtcppRemapping remapping_of(BtcppRelease release, std::string_view inner,
                            std::string_view value) {
  if (value == "{=}") return {std::string(inner), std::string(inner), false};
  const auto key = blackboard_key(release, value);
  return {std::string(inner), std::string(key.value_or(value)), !key};
}

bool has_remapping(const BtcppSubtree& subtree, std::string_view inner) {
  return std::any_of(subtree.remappings.begin(), subtree.remappings.end(),
                     [&](const auto& r) { return r.inner == inner; });
}

void apply_model(const BtcppModel& model, const BtcppNode& node,
                 BtcppSubtree& subtree, FileFindings& findings) {
  if (subtree.is_autoremapped) return;
  for (const BtcppPort& port : model.ports) {
    if (has_remapping(subtree, port.name)) continue;
    const std::string value = port.default_value.value_or("");
    if (!value.empty()) {
      subtree.remappings.push_back(
          remapping_of(BtcppRelease::V4, port.name, value));
      continue;
    }
    findings.error(
        node.place,
        {"BT1614",
         fmt::format("the port `{}` of `{}` is not remapped", port.name,
                     node.id),
         "its model gives no default",
         fmt::format("write `{}=\"{{…}}\"`, or `_autoremap=\"true\"`",
                     port.name)});
  }
}

}  // namespace

void read_remapping(const BtcppDocument& document, const BtcppNode& node,
                    BtcppSubtree& subtree, FileFindings& findings) {
  const bool is_v4 = document.release == BtcppRelease::V4;
  const bool has_braces = is_v4 || node.tag == "SubTreePlus";
  subtree.is_autoremapped =
      has_braces &&
      read_flag(node, is_v4 ? "_autoremap" : "__autoremap", findings);
  subtree.is_shared =
      !has_braces && read_flag(node, "__shared_blackboard", findings);
  for (const BtcppAttribute& port : node.ports) {
    if (has_braces) {
      subtree.remappings.push_back(
          remapping_of(document.release, port.name, port.value));
    } else {
      subtree.remappings.push_back({port.name, port.value, false});
    }
  }
  const BtcppModel* model = document.subtree_model(node.id);
  if (is_v4 && model != nullptr) apply_model(*model, node, subtree, findings);
}

}  // namespace btcheck::btcpp

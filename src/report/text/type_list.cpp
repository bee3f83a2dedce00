// SPDX-License-Identifier: MIT
#include "report/text/type_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "model/tree/node_types.hpp"
#include "report/text/type_text.hpp"

namespace btcheck {
namespace {

using btcpp::NodeTypeRow;
using btcpp::PortRow;

std::string lower(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return small;
}

std::string port_text(const PortRow& port) {
  std::string text =
      fmt::format("{}{}: {}",
                  port.direction == BtcppDirection::Input    ? ""
                  : port.direction == BtcppDirection::Output ? "out "
                                                             : "inout ",
                  port.name,
                  port.type_word.empty() ? btcpp::port_type_name(port.type)
                                         : port.type_word);
  if (!port.preset.empty()) text += fmt::format(" = {}", port.preset);
  if (port.need == btcpp::Need::Mandatory) text += ", needed";
  return text;
}

std::string ports_text(const NodeTypeRow& row, int release) {
  std::string text;
  for (const PortRow& port : row.ports) {
    if (!port.in.has(release)) continue;
    text += (text.empty() ? " (" : "; ") + port_text(port);
  }
  return text.empty() ? text : text + ')';
}

std::string line_of(const NodeTypeRow& row, Profile profile) {
  return fmt::format("{}: {}{}. {}", row.id, kind_name(row.kind),
                     ports_text(row, engine_release(profile)),
                     about_type(row, profile));
}

// Of a .btf tree.
std::string line_of(const NodeTypeInfo& info) {
  const std::string children =
      info.max_children == 0   ? "no child"
      : info.max_children == 1 ? "one child"
      : info.max_children == kAnyNumber
          ? "any number of children"
          : fmt::format("{} children", info.max_children);
  return fmt::format("{}: {}.{}{}", info.name, children,
                     info.about.empty() ? "" : " ", info.about);
}

std::vector<std::string> all_lines(Profile profile) {
  std::vector<std::string> lines;
  if (!is_engine(profile)) {
    for (const NodeTypeInfo& info : kNodeTypes) {
      if (has(info.in, In::Btf)) lines.push_back(line_of(info));
    }
    return lines;
  }
  const BtcppRelease release = btcpp::dialect_of(profile);
  for (const std::string& name : btcpp::builtin_names(release)) {
    const NodeTypeRow* row = btcpp::builtin_type(release, name);
    if (row->since > engine_release(profile)) continue;
    lines.push_back(line_of(*row, profile));
  }
  if (!has_nav2(profile)) return lines;
  const btcpp::Nav2Branch branch = btcpp::branch_of(profile);
  for (const NodeTypeRow& row : btcpp::nav2_types()) {
    if (row.branches.has(branch)) lines.push_back(line_of(row, profile));
  }
  return lines;
}

}  // namespace

std::string about_type(const NodeTypeRow& row, Profile profile) {
  Node node;
  node.type = row.type;
  node.id = row.id;
  node.contract.may_succeed = row.answers.may_succeed;
  node.contract.may_fail = row.answers.may_fail;
  node.contract.may_run = row.answers.may_run;
  node.contract.may_skip = false;
  return type_text(node, profile);
}

std::vector<std::string> type_lines(Profile profile, std::string_view part) {
  std::vector<std::string> lines = all_lines(profile);
  const std::string asked = lower(part);
  std::erase_if(lines, [&](const std::string& line) {
    return lower(line.substr(0, line.find(':'))).find(asked) == line.npos;
  });
  std::ranges::sort(lines);
  return lines;
}

}  // namespace btcheck

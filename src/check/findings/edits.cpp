// SPDX-License-Identifier: MIT
#include "check/findings/edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/tree/releases.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

bool is_word(std::string_view script) {
  return std::ranges::all_of(
      script, [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

// "'day'" and "'late'" of "shift == 'day' || shift == 'late'".
std::vector<std::string> texts_in(std::string_view script) {
  std::vector<std::string> texts;
  for (std::size_t at = 0; (at = script.find('\'', at)) != script.npos;) {
    const std::size_t end = script.find('\'', at + 1);
    if (end == script.npos) break;
    texts.emplace_back(script.substr(at, end + 1 - at));
    at = end + 1;
  }
  return texts;
}

std::vector<std::string> scripts_of(const Node& node,
                                    std::optional<ScriptTime> when) {
  std::vector<std::string> scripts;
  if (when) {
    if (node.script(*when)) scripts.push_back(node.script(*when)->text);
    return scripts;
  }
  for (const Script& each : node.own_scripts) scripts.push_back(each.text);
  return scripts;
}

// What scripts write into the entries that are asked for.
std::vector<EntryUse> texts_written(const TreeFacts& facts, NodeId asked,
                                    std::optional<ScriptTime> when) {
  std::set<std::uint32_t> entries;
  for (const EntryUse& use : facts.uses()) {
    const bool is_read = use.node == asked && use.reads && use.when == when;
    if (is_read) entries.insert(use.entry);
  }
  std::vector<EntryUse> written;
  for (const EntryUse& use : facts.uses()) {
    if (use.writes && entries.contains(use.entry) &&
        use.literal.starts_with('\'')) {
      written.push_back(use);
    }
  }
  return written;
}

}  // namespace

std::string negated_script(std::string_view script) {
  if (is_word(script)) return fmt::format("!{}", script);
  const bool is_turned = script.starts_with('!') && is_word(script.substr(1));
  return is_turned ? std::string(script.substr(1))
                   : fmt::format("!({})", script);
}

Repair asking_for(const TreeFacts& facts, NodeId parallel, int successes) {
  const BehaviorTree& tree = facts.tree();
  const std::string_view name =
      is_engine(tree.profile)
          ? releases::success_port(engine_release(tree.profile))
          : "success";
  return {SetAttribute{facts.place(parallel), std::string(name),
                       std::to_string(successes)}};
}

std::vector<Repair> spelt_alike(const TreeFacts& facts, NodeId node,
                                std::optional<ScriptTime> when) {
  const std::vector<EntryUse> written = texts_written(facts, node, when);
  std::vector<std::string> values;
  for (const EntryUse& use : written) values.push_back(use.literal);
  std::vector<Repair> repairs;
  for (const std::string& script : scripts_of(facts.node(node), when)) {
    for (const std::string& asked : texts_in(script)) {
      if (std::ranges::count(values, asked) > 0) continue;
      const auto near = closest_match(asked, values);
      if (!near) continue;
      const auto writer = std::ranges::find(written, *near, &EntryUse::literal);
      repairs.push_back(
          {ReplaceInAttributes{facts.place(writer->node), *near, asked}});
      repairs.push_back({ReplaceInAttributes{facts.place(node), asked, *near}});
    }
  }
  return repairs;
}

}  // namespace btcheck

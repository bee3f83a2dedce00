// SPDX-License-Identifier: MIT
#include "project/reading.hpp"

#include <fmt/format.h>

#include <utility>

#include "text/choice.hpp"

namespace btcheck {
namespace {

template <class Value>
void lay_over(std::optional<Value>& said, const std::optional<Value>& below) {
  if (!said) said = below;
}

// False where one of them cannot be read.
bool add_files(const std::optional<std::vector<std::string>>& names,
               Sources& sources, std::vector<InputFile>& to,
               std::vector<Diagnostic>& found) {
  bool are_all = true;
  for (const std::string& name : names.value_or(std::vector<std::string>())) {
    auto read = sources.named(name);
    found.insert(found.end(), read.diagnostics.begin(), read.diagnostics.end());
    if (read.value) to.push_back({name, std::move(read.value->text)});
    are_all = are_all && read.value.has_value();
  }
  return are_all;
}

// In BehaviorTree.CPP the nodes of one tick take no time.
bool has_ticks_of_btf(const ReadingChoices& how) {
  return how.ticks == TickSemantics::Leaves ||
         how.ticks == TickSemantics::Nodes;
}

}  // namespace

ReadingChoices fitting(ReadingChoices choices, bool is_xml) {
  if (choices.profile && is_engine(*choices.profile) != is_xml) {
    choices.profile.reset();
  }
  if (!is_xml) {
    choices.models.reset();
    choices.leaves.reset();
    choices.enums.clear();
    choices.wakes.reset();
  }
  return choices;
}

ReadingChoices over(ReadingChoices said, const ReadingChoices& below) {
  lay_over(said.profile, below.profile);
  lay_over(said.ticks, below.ticks);
  lay_over(said.tick_ms, below.tick_ms);
  lay_over(said.loops, below.loops);
  lay_over(said.wakes, below.wakes);
  lay_over(said.main_tree, below.main_tree);
  lay_over(said.models, below.models);
  lay_over(said.leaves, below.leaves);
  if (said.enums.empty()) said.enums = below.enums;
  return said;
}

std::optional<TreeReading> reading_of(const InputFile& tree,
                                      const ReadingChoices& how,
                                      Sources& sources,
                                      std::vector<Diagnostic>& found) {
  TreeReading reading;
  reading.profile = how.profile;
  reading.tick_ms = how.tick_ms.value_or(reading.tick_ms);
  reading.loops = how.loops.value_or(false);
  reading.wakes = how.wakes.value_or(false);
  reading.main_tree = how.main_tree.value_or("");
  const bool has_leaves = add_files(how.leaves, sources, reading.leaves, found);
  const bool has_models = add_files(how.models, sources, reading.models, found);
  if (!has_leaves || !has_models) return std::nullopt;
  if (!how.enums.empty()) reading.leaves.push_back({"enums", how.enums});
  if (!is_xml(tree.name, tree.text)) return reading;
  if (has_ticks_of_btf(how)) {
    found.push_back(
        file_error("BT1636", tree.name,
                   "in an XML tree time passes at ticks of the root only",
                   fmt::format("leave {} out, or `tick` of the rules; {} says "
                               "how long a tick takes",
                               word(Choice::Tick), word(Choice::TickMs))));
    return std::nullopt;
  }
  add_asked_files(tree, sources, reading, found);
  return reading;
}

}  // namespace btcheck

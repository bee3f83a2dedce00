// SPDX-License-Identifier: MIT
#include "run/record/rule_watch.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "check/bind/bind.hpp"
#include "check/bind/name_help.hpp"
#include "check/bind/remembered.hpp"
#include "run/record/recorder.hpp"

namespace btcheck {

Result<RunRules> RunRules::make(const BehaviorTree& tree, Network& network,
                                const std::vector<InputFile>& files) {
  RunRules made;
  Result<RunRules> result;
  const auto add = [&](std::vector<Diagnostic> found) {
    std::ranges::move(found, std::back_inserter(result.diagnostics));
  };
  std::vector<const PropertyFile*> all;
  for (const InputFile& file : files) {
    auto read = read_rules(file.name, file.text, tree);
    add(std::move(read.diagnostics));
    if (!read.value) continue;
    const Bound& made_of = made.files_.emplace_back(
        Bound{SourceText(file.name, file.text), std::move(*read.value)});
    const auto& ticks = made_of.rules.ticks;
    if (ticks && *ticks != tick_name(TickSemantics::Root)) {
      add({made_of.source.diagnostic(
          Severity::Error, "BT1702", {},
          "the rules say `tick " + *ticks + "`, and a run ticks the root", "",
          "leave `tick` out")});
    }
    all.push_back(&made_of.rules);
  }
  if (has_error(result.diagnostics)) return result;
  remember_for(tree, all, network);
  for (Bound& file : made.files_) {
    auto bound = bind_properties(tree, network, file.rules, file.source,
                                 ExtraAssumption::None);
    add(std::move(bound.diagnostics));
    if (!bound.value) continue;
    file.bound = std::move(*bound.value);
    auto monitors = monitors_of(file.bound, file.source);
    add(std::move(monitors.diagnostics));
    if (!monitors.value) continue;
    made.source_of_.insert(made.source_of_.end(), monitors.value->size(),
                           &file.source);
    std::ranges::move(*monitors.value, std::back_inserter(made.monitors_));
  }
  if (!has_error(result.diagnostics)) result.value = std::move(made);
  return result;
}

RuleWatch::RuleWatch(const TreeEngine& engine, const RunRules& rules,
                     Broken broken)
    : engine_(engine),
      monitor_(engine.system().network(), rules.monitors()),
      decided_(rules.monitors().size(), 0),
      broken_(std::move(broken)) {}

void RuleWatch::see(StateView state, int elapsed) {
  monitor_.see(unpacked(engine_.system(), state), elapsed);
  const int begun = engine_.ticks();
  if (elapsed > 0) last_ = begun;
  const int tick = begun == last_ ? begun + 1 : begun;
  for (std::size_t i = 0; i < decided_.size(); ++i) {
    const auto& at = monitor_.rules()[i].decided;
    if (!at || *at + 1 != monitor_.states()) continue;
    decided_[i] = tick;
    if (outlook(i) == Outlook::Violated) broken_(i, tick);
  }
}

}  // namespace btcheck

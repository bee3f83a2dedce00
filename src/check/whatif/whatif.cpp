// SPDX-License-Identifier: MIT
//
// One search for each fault, of the tree with that leaf drawn as the fault has
// it. What healthy runs do is searched once, and each fault is told by what it
// does beyond that.
#include "check/whatif/whatif.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "check/bind/name_help.hpp"
#include "check/rules_network.hpp"
#include "check/search/engine.hpp"
#include "check/whatif/cut_sets.hpp"
#include "check/whatif/effects.hpp"
#include "explore/state/spent.hpp"
#include "ltl/rules/compared.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"

namespace btcheck {
namespace {

// Several searches ask one monitor.
class SharedMonitor : public SearchMonitor {
 public:
  explicit SharedMonitor(SearchMonitor* monitor) : monitor_(monitor) {}

  StopReason observe(const SearchProgress& progress) override {
    const std::lock_guard lock(mutex_);
    if (stopped_ == StopReason::None && monitor_ != nullptr) {
      SearchProgress all = progress;
      all.states += done_.states;
      all.expanded += done_.expanded;
      all.transitions += done_.transitions;
      stopped_ = monitor_->observe(all);
    }
    return stopped_;
  }
  bool may_tell() override { return true; }
  bool has_spare() override { return true; }

  void ended(const SearchProgress& progress) {
    const std::lock_guard lock(mutex_);
    done_.states += progress.states;
    done_.expanded += progress.expanded;
    done_.transitions += progress.transitions;
  }

  void stop(StopReason reason) {
    const std::lock_guard lock(mutex_);
    if (stopped_ == StopReason::None) stopped_ = reason;
  }

  // Of a search that ended by its own limit others go on.
  StopReason stopped() {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

 private:
  std::mutex mutex_;
  SearchMonitor* monitor_;
  StopReason stopped_ = StopReason::None;
  SearchProgress done_;  // by searches that have ended
};

// The number of the tick in which an event of a run comes; from 1.
int tick_of(const BehaviorTree& tree, const std::vector<NodeEvent>& run,
            std::size_t before) {
  int ticks = 0;
  for (std::size_t i = 0; i < before && i < run.size(); ++i) {
    if (run[i] == NodeEvent(tree.roots[0], Happening::Asked)) ++ticks;
  }
  return ticks;
}

// Of these faults, and of what is told of leaves, what concerns such nodes.
void keep_heard(const std::vector<bool>& heard, PossibleFaults& possible) {
  const auto is_below = [&](NodeId leaf) { return !heard[index(leaf)]; };
  std::erase_if(possible.faults,
                [&](const InjectedFault& each) { return is_below(each.leaf); });
  std::erase_if(possible.guessed, is_below);
  for (OmittedFaults& each : possible.left_out) {
    std::erase_if(each.leaves, is_below);
  }
  std::erase_if(possible.left_out,
                [](const OmittedFaults& each) { return each.leaves.empty(); });
}

class Searcher {
 public:
  Searcher(const WhatIfInput& input, const WhatIfOptions& options,
           WhatIf& result)
      : tree_(input.tree),
        input_(input),
        options_(options),
        monitor_(options.limits.monitor),
        result_(result) {
    result.rules = input.rules;
    limits_ = options.limits;
    limits_.monitor = &monitor_;
    heard_ = {options.heard, known_.get()};
  }

  // What is so without faults; errors are those of the rules.
  std::vector<Diagnostic> look_at_healthy() {
    const Stage stage("the tree was searched without faults");
    healthy_tree_ = with_faults(tree_, {}, options_.choices.others);
    auto network = lower_regions(healthy_tree_, input_.source, options_.ticks);
    if (!network.value) return std::move(network.diagnostics);
    healthy_network_ = std::move(*network.value);
    healthy_.emplace(healthy_tree_, healthy_network_, limits_, Reduction::Full,
                     heard_);
    pairs_ = on_and_off(tree_);
    std::erase_if(pairs_,
                  [&](const OnOff& pair) { return !can_be_told(pair); });
    Shown shown;
    result_.healthy = effect_of(*healthy_, pairs_, nullptr, shown);
    result_.stopped = result_.healthy.stopped;
    asked_ = asked_behind(tree_, *healthy_);
    for (std::size_t file = 0; file < result_.rules.size(); ++file) {
      auto judged = judged_rules(healthy_tree_, file);
      if (!judged.value) return std::move(judged.diagnostics);
      std::vector<Property> kept;
      for (std::size_t i = 0; i < judged.value->size(); ++i) {
        Property& rule = result_.rules[file].properties[i];
        if ((*judged.value)[i].verdict == Verdict::Holds) {
          kept.push_back(rule);
        } else {
          result_.broken_rules.push_back(rule.name);
        }
      }
      result_.rules[file].properties = std::move(kept);
    }
    return {};
  }

  // `runs`: of the leaf of a fault that comes alone; kept for its next one.
  FaultRow row_of(std::vector<InjectedFault> faults,
                  std::optional<HealthyRuns>& runs) {
    FaultRow row;
    row.faults = std::move(faults);
    const BehaviorTree tree =
        with_faults(tree_, row.faults, options_.choices.others);
    const auto network = lower_regions(tree, input_.source, options_.ticks);
    if (!network.value) return row;
    const AnswerGraph graph(tree, *network.value, limits_, Reduction::Full,
                            heard_);
    monitor_.ended(graph.progress());
    Shown shown;
    row.effect = effect_of(graph, pairs_, &result_.healthy, shown);
    row.asked = asked_behind(tree, graph);
    for (std::size_t file = 0; file < result_.rules.size(); ++file) {
      if (row.effect.strikes) break_rules(tree, file, row);
    }
    Silence silence;
    const bool is_alone = row.faults.size() == 1;
    if (is_alone && row.effect.strikes && is_whole()) {
      if (!runs) runs.emplace(healthy_tree_, *healthy_, row.faults[0].leaf);
      if (row.effect.stopped == StopReason::None) {
        silence = silence_of(tree, *runs, graph, row.faults[0]);
        row.within = silence.within;
      }
    }
    row.healthy = healthy_with(row.faults);
    row.harm = harm_of(row.healthy, row.effect, silence);
    show(tree, graph, shown, silence, runs, row);
    return row;
  }

  // The rows of all these sets of faults, in their order.
  std::vector<FaultRow> rows_of(
      const std::vector<std::vector<InjectedFault>>& sets) {
    std::vector<FaultRow> rows(sets.size());
    // Those of one leaf that come alone have much in common.
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const bool goes_on = i > 0 && sets[i].size() == 1 &&
                           sets[i - 1].size() == 1 &&
                           sets[i][0].leaf == sets[i - 1][0].leaf;
      if (!goes_on) first.push_back(i);
    }
    first.push_back(sets.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t g = next++; g + 1 < first.size(); g = next++) {
        std::optional<HealthyRuns> runs;
        for (std::size_t i = first[g]; i < first[g + 1]; ++i) {
          rows[i] = row_or_none(sets[i], runs);
        }
      }
    };
    std::vector<std::jthread> threads;
    const std::size_t others =
        std::min<std::size_t>(std::max(1u, options_.threads), first.size() - 1);
    for (std::size_t i = 1; i < others; ++i) threads.emplace_back(work);
    work();
    threads.clear();
    if (result_.stopped == StopReason::None) {
      result_.stopped = monitor_.stopped();
    }
    return rows;
  }

  const std::vector<bool>& asked() const { return asked_; }
  std::string error() {
    const std::lock_guard lock(mutex_);
    return error_;
  }

 private:
  FaultRow row_or_none(const std::vector<InjectedFault>& faults,
                       std::optional<HealthyRuns>& runs) {
    FaultRow none;
    none.faults = faults;
    none.effect.stopped = monitor_.stopped();
    if (none.effect.stopped != StopReason::None) return none;
    try {
      return row_of(faults, runs);
    } catch (const BudgetSpent& spent) {
      // What is known of the others is told.
      none.effect.stopped = stop_reason(spent.spent());
      monitor_.stop(none.effect.stopped);
      return none;
    }
  }

  // What it ends by may happen unheard.
  bool can_be_told(const OnOff& pair) const {
    return heard_.hears(pair.on) &&
           std::ranges::all_of(
               pair.off, [this](NodeId leaf) { return heard_.hears(leaf); });
  }

  bool is_whole() const { return result_.healthy.stopped == StopReason::None; }

  Result<std::vector<PropertyVerdict>> judged_rules(const BehaviorTree& tree,
                                                    std::size_t file) {
    auto made = network_for(tree, input_.source, result_.rules[file],
                            input_.rule_texts[file], options_.ticks);
    if (!made.value) return {std::nullopt, std::move(made.diagnostics)};
    const CompiledNetwork system(*made.value->network);
    Verification found = verify(system, made.value->bound, {}, limits_);
    return {std::move(found.verdicts), {}};
  }

  void break_rules(const BehaviorTree& tree, std::size_t file, FaultRow& row) {
    if (result_.rules[file].properties.empty()) return;
    auto judged = judged_rules(tree, file);
    if (!judged.value) return;
    for (std::size_t i = 0; i < judged.value->size(); ++i) {
      const PropertyVerdict& verdict = (*judged.value)[i];
      if (verdict.verdict == Verdict::Undecided &&
          row.effect.stopped == StopReason::None) {
        row.effect.stopped = verdict.stopped;
      }
      if (verdict.verdict != Verdict::Violated) continue;
      row.effect.broken.push_back({file, i});
      if (row.rules || !verdict.run) continue;
      row.rules = file;
      for (const RunStep& step : verdict.run->steps) {
        row.steps.push_back(step.step);
      }
    }
  }

  // How the runs end that ask these leaves and have no fault; where none does,
  // all of them.
  Effect healthy_with(const std::vector<InjectedFault>& faults) const {
    if (faults.size() > 1) return result_.healthy;
    Effect ends = ends_behind(*healthy_, faults[0].leaf);
    return ends.strikes ? ends : result_.healthy;
  }

  static Harm harm_of(const Effect& healthy, const Effect& effect,
                      const Silence& silence) {
    if (!effect.strikes) {
      return effect.stopped == StopReason::None ? Harm::NotAsked
                                                : Harm::Undecided;
    }
    if (silence.run) return Harm::Silent;
    if (effect.hangs && !healthy.hangs) return Harm::NeverEnds;
    if (!effect.broken.empty()) return Harm::RuleBreaks;
    if (!effect.left_running.empty() || !effect.left_on.empty()) {
      return Harm::LeftOn;
    }
    if (effect.throws && !healthy.throws) return Harm::Throws;
    if (effect.stopped != StopReason::None) return Harm::Undecided;
    if (healthy.succeeds && !effect.succeeds) return Harm::Fails;
    if (effect.fails && !healthy.fails) return Harm::MayFail;
    return Harm::Survives;
  }

  void show(const BehaviorTree& tree, const AnswerGraph& graph,
            const Shown& shown, const Silence& silence,
            std::optional<HealthyRuns>& runs, FaultRow& row) {
    // A run that shows it; else one that tells what happens then at all.
    const std::optional<Shown::Path>* path = nullptr;
    switch (row.harm) {
      case Harm::Silent:
        path = &silence.run;
        break;
      case Harm::NeverEnds:
        path = &shown.hangs;
        break;
      case Harm::LeftOn:
        path = &shown.left;
        break;
      case Harm::Throws:
        path = &shown.throws;
        break;
      case Harm::Survives:
        path = &shown.succeeds;
        break;
      default:
        break;
    }
    for (const auto* each :
         {&shown.fails, &shown.succeeds, &shown.throws, &shown.hangs}) {
      if (path == nullptr || !*path) path = each;
    }
    if (!*path) return;
    const std::vector<NodeEvent> run = events_along(graph, **path);
    const NodeId leaf = row.faults[0].leaf;
    const auto strike =
        std::ranges::find(run, NodeEvent(leaf, Happening::Struck));
    row.struck_in =
        tick_of(tree, run, static_cast<std::size_t>(strike - run.begin()));
    row.ended_in = tick_of(tree, run, run.size());
    if (runs) {
      row.notice = notice_on(tree, *runs, run);
      const bool gets_on =
          row.harm != Harm::Silent && row.harm != Harm::NeverEnds;
      if (shown.succeeds && gets_on) {
        const auto well = events_along(graph, *shown.succeeds);
        row.recovery = recovery_on(tree, leaf, well, asked_);
      }
    }
    // The run of a rule is there already.
    if (row.harm == Harm::RuleBreaks && row.rules) return;
    row.rules.reset();
    std::string error;
    row.steps = graph.steps_along(**path, error);
    if (error.empty()) return;
    const std::lock_guard lock(mutex_);
    error_ = std::move(error);
  }

  const BehaviorTree& tree_;
  const WhatIfInput& input_;
  const WhatIfOptions& options_;
  SharedMonitor monitor_;
  Limits limits_;
  WhatIf& result_;
  const std::shared_ptr<ComponentStore> known_ = ComponentStore::of_program();
  Heard heard_;

  BehaviorTree healthy_tree_;
  Network healthy_network_;
  std::optional<AnswerGraph> healthy_;
  std::vector<OnOff> pairs_;
  std::vector<bool> asked_;
  std::mutex mutex_;
  std::string error_;
};

std::size_t place_in(const std::vector<InjectedFault>& all,
                     const InjectedFault& fault) {
  return static_cast<std::size_t>(std::ranges::find(all, fault) - all.begin());
}

void rank(const std::vector<InjectedFault>& all, std::vector<FaultRow>& rows) {
  std::ranges::stable_sort(
      rows, [&](const FaultRow& one, const FaultRow& other) {
        if (one.harm != other.harm) return one.harm < other.harm;
        return std::ranges::lexicographical_compare(
            one.faults, other.faults, {},
            [&](const InjectedFault& fault) { return place_in(all, fault); },
            [&](const InjectedFault& fault) { return place_in(all, fault); });
      });
}

}  // namespace

std::size_t Score::total() const {
  return std::accumulate(of.begin(), of.end(), std::size_t{0});
}

Score WhatIf::score() const {
  Score score;
  for (const FaultRow& row : rows) {
    ++score.of[static_cast<std::size_t>(row.harm)];
  }
  return score;
}

Score WhatIf::score_below(const BehaviorTree& tree, NodeId node) const {
  Score score;
  for (const FaultRow& row : rows) {
    NodeId at = row.faults[0].leaf;
    while (at != node && !tree.node(at).is_root()) at = tree.node(at).parent;
    if (at == node) ++score.of[static_cast<std::size_t>(row.harm)];
  }
  return score;
}

Result<WhatIfInput> what_if_input(const TreeInput& tree,
                                  const std::vector<InputFile>& rules) {
  Result<WhatIfInput> result;
  const auto add = [&](std::vector<Diagnostic> found) {
    result.diagnostics.insert(result.diagnostics.end(),
                              std::make_move_iterator(found.begin()),
                              std::make_move_iterator(found.end()));
  };
  // What rules compare entries with is told apart.
  TreeReading reading = tree.reading;
  for (const InputFile& file : rules) {
    const auto read = read_properties(file.name, file.text);
    if (!read.value) continue;
    add_compared(*read.value, reading.detail.asked, reading.detail.beside);
  }
  auto read = read_tree(tree.name, tree.text, reading);
  add(std::move(read.diagnostics));
  if (!read.value) return result;
  WhatIfInput input{
      std::move(*read.value), SourceText(tree.name, tree.text), {}, {}};
  for (const InputFile& file : rules) {
    auto named = read_rules(file.name, file.text, input.tree);
    add(std::move(named.diagnostics));
    if (!named.value) continue;
    input.rules.push_back(std::move(*named.value));
    input.rule_texts.emplace_back(file.name, file.text);
  }
  if (!has_error(result.diagnostics)) result.value = std::move(input);
  return result;
}

std::vector<bool> own_nodes(const BehaviorTree& tree) {
  std::vector<bool> own(tree.nodes.size(), true);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (tree.nodes[n].is_root()) continue;
    const NodeId above = tree.nodes[n].parent;
    own[n] = own[index(above)] && tree.node(above).type != NodeType::SubTree;
  }
  return own;
}

Result<WhatIf> what_if(const WhatIfInput& input, const WhatIfOptions& options) {
  WhatIf result;
  result.choices = options.choices;
  result.order = options.order;
  result.possible = possible_faults(input.tree, options.choices);
  if (!options.heard.empty()) keep_heard(options.heard, result.possible);
  Searcher searcher(input, options, result);
  auto found = searcher.look_at_healthy();
  if (has_error(found)) return {std::nullopt, std::move(found)};
  // Beside runs of which some are not known no fault can be told.
  if (result.stopped != StopReason::None) {
    for (const InjectedFault& each : result.possible.faults) {
      FaultRow& row = result.rows.emplace_back();
      row.faults = {each};
      row.effect.stopped = result.stopped;
    }
    return {std::move(result), std::move(found)};
  }
  const Stage stage("faults were put into the tree");
  std::vector<std::vector<InjectedFault>> sets;
  for (const InjectedFault& each : result.possible.faults) {
    sets.push_back({each});
  }
  result.rows = searcher.rows_of(sets);
  if (options.order > 1) {
    add_pairs(result,
              [&](const std::vector<std::vector<InjectedFault>>& pairs) {
                return searcher.rows_of(pairs);
              });
  }
  add_cut_sets(result);
  rank(result.possible.faults, result.rows);
  rank(result.possible.faults, result.pairs);
  result.error = searcher.error();
  return {std::move(result), std::move(found)};
}

RowNetwork network_of(const WhatIfInput& input, const WhatIf& result,
                      const FaultRow& row, TickSemantics ticks) {
  RowNetwork made{with_faults(input.tree, row.faults, result.choices.others),
                  {}};
  if (row.rules) {
    auto bound = network_for(made.tree, input.source, result.rules[*row.rules],
                             input.rule_texts[*row.rules], ticks);
    if (bound.value) made.network = std::move(*bound.value->network);
    return made;
  }
  auto network = lower_regions(made.tree, input.source, ticks);
  if (network.value) made.network = std::move(*network.value);
  return made;
}

}  // namespace btcheck

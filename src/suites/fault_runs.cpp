// SPDX-License-Identifier: MIT
//
// A leaf with a fault answers as the leaf of a test can be made to answer. So a
// run of the tree with the fault is told by the answers of its leaves, these
// are given in the tree as it is, and what the nodes do there is compared.
#include "suites/fault_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// Of one that never ends so many ticks are played.
constexpr int kMostFaultTicks = 40;

// The answer, or the halt, of a step.
std::optional<NodeEvent> told_by(const Network& network, const Step& step) {
  const auto event = event_of(network, step.edge);
  return event && event->what() != Happening::Asked ? event : std::nullopt;
}

// Up to the end of the last whole tick, and of few ticks.
std::vector<NodeEvent> answers_of(const BehaviorTree& tree,
                                  const Network& network,
                                  const std::vector<Step>& steps) {
  std::vector<NodeEvent> all;
  std::size_t whole = 0;
  int ticks = 0;
  for (const Step& step : steps) {
    if (const auto told = told_by(network, step)) all.push_back(*told);
    if (step.edge == kTimeStep || !ends_tick(tree, network, step)) continue;
    whole = all.size();
    if (++ticks == kMostFaultTicks) break;
  }
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(whole), all.end());
  return all;
}

// Gives these answers; nothing where the tree does something else then.
std::optional<std::vector<Step>> played(const ForcedNetwork& forced,
                                        const std::vector<NodeEvent>& answers) {
  const Network& network = forced.network();
  const BehaviorTree& tree = forced.tree();
  std::vector<Step> steps;
  StateVector here;
  forced.initial_states(
      [&](StateView state) { here.assign(state.begin(), state.end()); });
  std::size_t done = 0;
  while (done < answers.size()) {
    ask_budget();
    auto ways = forced.ways(here);
    // Of the ways of a leaf the one that its next answer names.
    const auto fits = [&](const ForcedNetwork::Way& way) {
      const auto told = told_by(network, way.step);
      if (!told || !is_leaf(tree.node(told->node()).type)) return true;
      const auto next = std::find_if(
          answers.begin() + static_cast<std::ptrdiff_t>(done), answers.end(),
          [&](NodeEvent each) { return each.node() == told->node(); });
      return next != answers.end() && *next == *told;
    };
    const auto way = std::ranges::find_if(ways, fits);
    if (way == ways.end()) return std::nullopt;
    if (const auto told = told_by(network, way->step)) {
      if (*told != answers[done]) return std::nullopt;
      ++done;
    }
    steps.push_back(way->step);
    here = std::move(way->after);
  }
  return steps;
}

std::string about(const BehaviorTree& tree, const FaultRow& row) {
  const InjectedFault& fault = row.faults[0];
  return fmt::format("{} {}", short_name(tree, fault.leaf),
                     facts_of(fault.fault.kind).word);
}

}  // namespace

FaultRuns fault_runs(const ForcedNetwork& forced, const WhatIfInput& input,
                     const WhatIf& result, TickSemantics ticks) {
  const Stage stage("tests of faults were made");
  FaultRuns made;
  std::map<std::vector<std::uint32_t>, std::size_t> known;
  for (const FaultRow& row : result.rows) {
    if (row.harm == Harm::NotAsked) continue;
    const std::string name = about(input.tree, row);
    const FaultKind kind = row.faults[0].fault.kind;
    const auto leave_out = [&](std::string_view why) {
      made.left_out[std::string(why)].push_back(name);
    };
    if (kind == FaultKind::Throws || kind == FaultKind::Halted) {
      leave_out("no leaf of a test does that");
      continue;
    }
    if (row.steps.empty()) {
      leave_out("no run is known within the limits");
      continue;
    }
    const RowNetwork faulty = network_of(input, result, row, ticks);
    const auto steps =
        played(forced, answers_of(faulty.tree, faulty.network, row.steps));
    if (!steps || steps->empty()) {
      leave_out("it hangs on more than the answers of leaves");
      continue;
    }
    ++made.shown;
    std::vector<std::uint32_t> edges;
    for (const Step& step : *steps) edges.push_back(step.edge);
    const auto [place, is_new] = known.emplace(edges, made.runs.size());
    if (is_new) {
      made.runs.push_back({name, "", *steps});
    } else {
      made.runs[place->second].about += ", " + name;
    }
  }
  return made;
}

std::string faults_summary(const FaultRuns& runs) {
  std::size_t count = runs.shown;
  std::string text;
  for (const auto& [why, names] : runs.left_out) {
    count += names.size();
    text += fmt::format("  {}: {}\n", why, fmt::join(names, ", "));
  }
  if (count == 0) return "";
  return fmt::format("{} of {} single faults have a test{}\n{}", runs.shown,
                     count, text.empty() ? "" : "; left out by name:", text);
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// What the network says of entries is sound: the engine's runs are among its
// own. So a rule that holds, holds; and of a run that is found it has to be
// asked whether the engine takes it.
#include "check/real_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "check/replay/replay.hpp"
#include "model/btcpp/tree/entry_programs.hpp"

namespace btcheck {
namespace {

using btcpp::EntryExecution;
using btcpp::EntryNumber;
using btcpp::EntryProgram;
using btcpp::EntryPrograms;

constexpr std::size_t kMostRounds = 2000;
constexpr std::size_t kMostSteps = 2'000'000;
constexpr std::size_t kMostSeen = 300;

class Execution {
 public:
  Execution(const BehaviorTree& tree, const Network& network, const Run& run)
      : programs_(*tree.programs),
        network_(network),
        run_(run),
        values_(programs_) {}

  std::optional<Refutation> refutation() {
    const bool has_loop = run_.loop != kNoLoop;
    if (!takes(0, has_loop ? run_.loop : run_.steps.size())) return refuted_;
    if (!has_loop) return std::nullopt;
    std::vector<std::vector<btcpp::ScriptValue>> seen;
    const std::size_t length = run_.steps.size() - run_.loop;
    const std::size_t rounds =
        std::min(kMostRounds, kMostSteps / std::max<std::size_t>(length, 1));
    for (std::size_t round = 0; round <= rounds; ++round) {
      if (std::find(seen.begin(), seen.end(), values_.values()) != seen.end()) {
        return std::nullopt;
      }
      if (seen.size() < kMostSeen) seen.push_back(values_.values());
      if (!takes(run_.loop, run_.steps.size())) return refuted_;
    }
    const auto open = first_open_step();
    if (!open) return std::nullopt;
    return Refutation{open->program,
                      fmt::format("whether `{}` always comes out so on the "
                                  "loop is not known",
                                  program(*open).text)};
  }

 private:
  const EntryProgram& program(const ScriptStep& step) const {
    return programs_.programs[static_cast<std::size_t>(step.program)];
  }
  const std::vector<ScriptStep>& scripts_of(const RunStep& step) const {
    static const std::vector<ScriptStep> kNone;
    if (step.step.edge >= network_.edge_count()) return kNone;
    return network_.edge(step.step.edge).scripts;
  }

  bool takes(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const ScriptStep* refused = values_.refused(scripts_of(run_.steps[i]));
      if (refused == nullptr) continue;
      refuted_ = {refused->program, words_of(*refused)};
      return false;
    }
    return true;
  }

  // "`battery > 20` cannot be false: battery is 199".
  std::string words_of(const ScriptStep& step) const {
    std::string values;
    const std::vector<EntryNumber> mentioned = program(step).entries();
    std::set<EntryNumber> told;
    for (const EntryNumber entry : mentioned) {
      if (!told.insert(entry).second) continue;
      values += fmt::format("{}{} is {}", values.empty() ? ": " : ", ",
                            programs_.entries[entry].name,
                            btcpp::shown(values_.values()[entry]));
    }
    constexpr const char* kCannot[] = {"cannot be true", "cannot be false",
                                       "cannot be executed", "does not throw"};
    return fmt::format("`{}` {}{}", program(step).text,
                       kCannot[static_cast<std::size_t>(step.outcome)], values);
  }

  // A step of the loop beside which another outcome is allowed, too.
  std::optional<ScriptStep> first_open_step() const {
    const NetworkInterpreter interpreter(network_);
    for (std::size_t i = run_.loop; i < run_.steps.size(); ++i) {
      for (const ScriptStep& script : scripts_of(run_.steps[i])) {
        if (is_open(interpreter, run_.state(i), run_.steps[i].step.edge,
                    script)) {
          return script;
        }
      }
    }
    return std::nullopt;
  }

  bool is_open(const NetworkInterpreter& interpreter, const Valuation& state,
               std::uint32_t edge, const ScriptStep& script) const {
    const Automaton& automaton = network_.owner_of_edge(edge);
    for (std::uint32_t i = 0; i < automaton.edges.size(); ++i) {
      const std::uint32_t other = automaton.first_edge + i;
      const bool is_other_outcome = std::any_of(
          automaton.edges[i].scripts.begin(), automaton.edges[i].scripts.end(),
          [&](const ScriptStep& step) {
            return step.program == script.program &&
                   step.outcome != script.outcome;
          });
      if (other != edge && is_other_outcome &&
          interpreter.may_fire(state, other)) {
        return true;
      }
    }
    return false;
  }

  const EntryPrograms& programs_;
  const Network& network_;
  const Run& run_;
  EntryExecution values_;
  Refutation refuted_;
};

}  // namespace

std::optional<Refutation> refutation_of(const BehaviorTree& tree,
                                        const Network& network,
                                        const Run& run) {
  if (!tree.programs || tree.programs->programs.empty()) return std::nullopt;
  return Execution(tree, network, run).refutation();
}

std::set<std::size_t> groups_of(const BehaviorTree& tree,
                                std::int32_t program) {
  std::set<std::size_t> groups;
  const auto& programs = *tree.programs;
  for (const EntryNumber entry :
       programs.programs[static_cast<std::size_t>(program)].entries()) {
    groups.insert(programs.entries[entry].group);
  }
  return groups;
}

std::set<std::size_t> rough_groups(const BehaviorTree& tree) {
  std::set<std::size_t> groups;
  for (const OpenEntry& entry : tree.open_entries) {
    if (entry.is_rough) groups.insert(entry.group);
  }
  return groups;
}

std::string rough_words(const BehaviorTree& tree,
                        const std::set<std::size_t>& groups) {
  std::string words;
  for (const OpenEntry& entry : tree.open_entries) {
    if (!entry.is_rough || !groups.contains(entry.group)) continue;
    words += fmt::format("{}`{}`: {} (line {})", words.empty() ? "" : "; ",
                         entry.name, entry.reason, entry.span.line);
  }
  return words;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A run becomes a test: what leaves answer and write, and what nodes do.
#include <algorithm>

#include "check/replay/replay.hpp"
#include "check/simulate/simulation.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "model/tree/node_types.hpp"
#include "suites/suite.hpp"

namespace btcheck {
namespace {

using btcpp::EntryPrograms;
using btcpp::ScriptKind;
using btcpp::ScriptValue;

bool is_known(const ScriptValue& value) {
  return value.kind == ScriptKind::Number || value.kind == ScriptKind::Text;
}

std::optional<EntryWrite> write_of(const BehaviorTree& tree,
                                   const btcpp::ProgramEntry& entry,
                                   const ScriptValue& value) {
  const auto home =
      std::ranges::find(tree.entry_homes, entry.name, &EntryHome::name);
  if (home == tree.entry_homes.end()) return std::nullopt;
  return EntryWrite{home->node, entry.key, value};
}

class TestTeller {
 public:
  explicit TestTeller(const ForcedNetwork& forced)
      : forced_(forced),
        tree_(forced.tree()),
        network_(forced.network()),
        interpreter_(network_),
        state_(interpreter_.initial()),
        answers_(tree_.nodes.size()),
        is_visited_(tree_.nodes.size()) {
    if (tree_.programs) values_.emplace(*tree_.programs);
  }

  // False where the real values of entries do not let the step be taken.
  bool take(const Step& step) {
    if (step.edge == kTimeStep) {
      interpreter_.take(state_, step);
      return true;
    }
    const std::vector<EntryWrite> written = writes_of(step);
    if (is_refused_) return false;
    const Automaton& mover = network_.owner_of_edge(step.edge);
    const Edge& edge = network_.edge(step.edge);
    interpreter_.take(state_, step);
    if (mover.kind == AutomatonKind::StateVariable) {
      tick_.before.insert(tick_.before.end(), written.begin(), written.end());
      const auto variable = mover.state_variable;
      tick_.variables[variable] =
          state_.variables[index(network_.state_variable[index(variable)])];
      return true;
    }
    if (mover.kind != AutomatonKind::Node) return true;
    edges_.insert(step.edge);
    if (begins_tick(tree_, network_, step)) is_open_ = true;
    if (tree_.node(mover.node).is_root()) {
      if (ends_tick(tree_, network_, step)) {
        end_tick(mover.target(edge).name);
      }
      return true;
    }
    note(mover, edge, written);
    return true;
  }

  // What throws in the middle of a tick ends the run, and is told.
  bool ends_by_fault() {
    const bool is_faulty =
        network_.fault && state_.variables[index(*network_.fault)] != 0;
    if (is_faulty && is_open_) end_tick("");
    return is_faulty;
  }

  // The ticks that are over.
  std::optional<SuiteTest> test() const {
    if (test_.ticks.empty()) return std::nullopt;
    return test_;
  }

 private:
  std::vector<EntryWrite> writes_of(const Step& step) {
    std::vector<EntryWrite> writes;
    if (!values_) return writes;
    const std::vector<ScriptValue> before = values_->values();
    is_refused_ = values_->refused(network_.edge(step.edge).scripts) != nullptr;
    const EntryPrograms& programs = *tree_.programs;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const ScriptValue& now = values_->values()[i];
      if (now == before[i] || !is_known(now)) continue;
      if (auto write = write_of(tree_, programs.entries[i], now)) {
        writes.push_back(std::move(*write));
      }
    }
    return writes;
  }

  void note(const Automaton& mover, const Edge& edge,
            const std::vector<EntryWrite>& written) {
    const Location& target = mover.target(edge);
    const NodeId node = mover.node;
    if (target.role == LocationRole::Tick ||
        target.role == LocationRole::Halt) {
      is_visited_[index(node)] = true;
    }
    if (is_scripted(tree_.node(node).type) && !written.empty()) {
      std::vector<EntryWrite>& waiting = waiting_[node];
      waiting.insert(waiting.end(), written.begin(), written.end());
    }
    if (!is_answer(target.role) && target.role != LocationRole::Halted &&
        target.role != LocationRole::Error) {
      return;
    }
    std::string& answers = answers_[index(node)];
    if (!answers.empty()) answers += ',';
    answers += target.name;
    for (std::size_t q = 1; q < kNodeQuestionCount; ++q) {
      if (kNodeQuestionRoles[q] == target.role) {
        cells_.insert({node, static_cast<NodeQuestion>(q)});
      }
    }
    if (forced_.is_leafs_answer(mover, edge)) {
      leaves_[node].push_back({answer_of(node, target), take_waiting(node)});
    }
  }

  std::vector<EntryWrite> take_waiting(NodeId node) {
    const auto found = waiting_.find(node);
    if (found == waiting_.end()) return {};
    std::vector<EntryWrite> writes = std::move(found->second);
    waiting_.erase(found);
    return writes;
  }

  std::string answer_of(NodeId id, const Location& target) const {
    const Node& node = tree_.node(id);
    if (node.type != NodeType::SetSV) return target.name;
    const VariableId found = network_.state_variable[index(node.variable)];
    return tree_.variable(node.variable)
        .value_name(state_.variables[index(found)]);
  }

  void end_tick(const std::string& answer) {
    is_open_ = false;
    tick_.root = answer;
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (is_visited_[n]) {
        tick_.nodes.emplace_back(NodeId{n},
                                 answers_[n].empty() ? "none" : answers_[n]);
      }
      is_visited_[n] = false;
      answers_[n].clear();
    }
    test_.ticks.push_back(std::move(tick_));
    tick_ = {};
    test_.leaves = leaves_;
    // A tick that throws is not compared any further.
    if (!answer.empty()) test_.cells = cells_;
    test_.edges = edges_;
  }

  const ForcedNetwork& forced_;
  const BehaviorTree& tree_;
  const Network& network_;
  NetworkInterpreter interpreter_;
  Valuation state_;
  std::optional<btcpp::EntryExecution> values_;
  bool is_refused_ = false;
  bool is_open_ = false;  // a tick has begun
  SuiteTick tick_;
  std::vector<std::string> answers_;  // by node, in this tick
  std::vector<bool> is_visited_;
  // Of all ticks so far, with the one that is not over.
  std::map<NodeId, std::vector<LeafAnswer>> leaves_;
  std::map<NodeId, std::vector<EntryWrite>> waiting_;
  std::set<Cell> cells_;
  std::set<std::uint32_t> edges_;
  SuiteTest test_;  // as it was when the last tick was over
};

}  // namespace

std::vector<EntryWrite> initial_writes(const BehaviorTree& tree) {
  std::vector<EntryWrite> writes;
  if (!tree.programs) return writes;
  for (const btcpp::ProgramEntry& entry : tree.programs->entries) {
    // Those of subtrees are made by the engine.
    if (entry.subtree != 0 || !is_known(entry.initial)) continue;
    if (auto write = write_of(tree, entry, entry.initial)) {
      writes.push_back(std::move(*write));
    }
  }
  return writes;
}

std::optional<SuiteTest> told_test(const ForcedNetwork& forced,
                                   const std::vector<Step>& steps) {
  TestTeller teller(forced);
  for (const Step& step : steps) {
    if (!teller.take(step) || teller.ends_by_fault()) break;
  }
  return teller.test();
}

}  // namespace btcheck

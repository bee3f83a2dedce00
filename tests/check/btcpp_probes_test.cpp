// SPDX-License-Identifier: MIT
//
// The recorded runs of BehaviorTree.CPP 4.10 in tests/btcpp_probes, tick by
// tick: with the recorded answers of the leaves the automata call, halt and
// answer exactly as the engine did.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "check/simulate/simulation.hpp"
#include "file_text.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"

namespace fs = std::filesystem;

namespace btcheck::btcpp_probes_test {
namespace {

// "tick 1 RUNNING a:S b:R": what the tree answered, and the leaves.
struct Line {
  std::string answer;
  std::vector<std::string> leaves;
};

std::vector<Line> record_of(const fs::path& file) {
  std::vector<Line> lines;
  std::istringstream text(file_text(file.string()));
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("tick")) continue;
    std::istringstream words(line);
    std::string word;
    Line read;
    words >> word >> word >> read.answer;
    while (words >> word) read.leaves.push_back(word);
    lines.push_back(std::move(read));
  }
  return lines;
}

class Replay {
 public:
  Replay(const BehaviorTree& tree, const std::vector<Line>& record)
      : tree_(tree),
        network_(lower(tree, TickSemantics::Root)),
        simulation_(tree_, network_, Interleaving::InOrder),
        record_(record) {}

  // The ticks that were replayed, in the words of the record.
  std::vector<Line> run() {
    note();
    while (played_.size() < record_.size() && !simulation_.choices().empty()) {
      simulation_.take(choice());
      note();
    }
    return played_;
  }

 private:
  const Automaton& owner(const SimulationChoice& choice) const {
    return network_.owner_of_edge(choice.step.edge);
  }

  static std::string letter(std::string_view location) {
    if (location == "success") return "S";
    if (location == "failure") return "F";
    if (location == "running") return "R";
    if (location == "skipped") return "K";
    return location == "halted" ? "halt" : "";
  }

  // What the record has of this leaf after what has been played of the tick.
  std::string next_of(const std::string& leaf) const {
    const std::vector<std::string>& expected = record_[played_.size()].leaves;
    for (std::size_t i = now_.leaves.size(); i < expected.size(); ++i) {
      if (expected[i].starts_with(leaf + ":")) return expected[i];
    }
    return "";
  }

  // The answer that the record has next; where none is asked for, the first.
  std::size_t choice() const {
    const auto choices = simulation_.choices();
    std::size_t otherwise = 0;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (choices[i].kind != ChoiceKind::Answer) continue;
      const Automaton& leaf = owner(choices[i]);
      const Edge& edge = network_.edge(choices[i].step.edge);
      // A result that stands is no call, which the record would have.
      if (edge.label == "has ended already") {
        otherwise = i;
        continue;
      }
      if (fmt::format("{}:{}", tree_.node(leaf.node).name,
                      letter(leaf.target(edge).name)) ==
          next_of(tree_.node(leaf.node).name)) {
        return i;
      }
    }
    return otherwise;
  }

  void note() {
    simulation_.for_each_latest([&](const Valuation&, const RunStep& step) {
      if (step.step.edge == kTimeStep) return;
      const Automaton& automaton = network_.owner_of_edge(step.step.edge);
      if (automaton.kind != AutomatonKind::Node) return;
      const Node& node = tree_.node(automaton.node);
      const Edge& edge = network_.edge(step.step.edge);
      const std::string& target = automaton.target(edge).name;
      if (target == "error") end_tick("EXCEPTION");
      // The engine's timer halts the child before the tick begins.
      if (edge.label == "the time is up") is_late_ = true;
      if (node.is_root()) {
        if (target == "running") end_tick("RUNNING");
        if (target == "success") end_tick("SUCCESS");
        if (target == "failure") end_tick("FAILURE");
        if (target == "skipped") end_tick("SKIPPED");
        return;
      }
      const bool is_leaf =
          (node.type == NodeType::Action || node.type == NodeType::Condition) &&
          !node.id.starts_with("Always");
      // What was answered earlier and stands is not called.
      if (!is_leaf || edge.label == "has ended already" ||
          edge.label == "halts itself") {
        return;
      }
      const std::string what = letter(target);
      if (what.empty()) return;
      const std::string event = node.name + ":" + what;
      if (what == "halt" && is_late_) {
        now_.leaves.insert(now_.leaves.begin(), event);
        is_late_ = false;
      } else {
        now_.leaves.push_back(event);
      }
    });
  }

  void end_tick(std::string answer) {
    now_.answer = std::move(answer);
    if (played_.size() < record_.size()) played_.push_back(std::move(now_));
    now_ = {};
  }

  const BehaviorTree& tree_;
  Network network_;
  Simulation simulation_;
  const std::vector<Line>& record_;
  std::vector<Line> played_;
  Line now_;
  bool is_late_ = false;
};

std::string text_of(const std::vector<Line>& lines) {
  std::string text;
  for (const Line& line : lines) {
    text += fmt::format("{} {}\n", line.answer, fmt::join(line.leaves, " "));
  }
  return text;
}

bool uses_nav2(const std::string& text) {
  for (const std::string_view node :
       {"<RecoveryNode", "<RoundRobin", "<PipelineSequence",
        "<NonblockingSequence", "<PersistentSequence", "<SingleTrigger"}) {
    if (text.find(node) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("recorded runs of the engine are runs of the automata") {
  std::vector<fs::path> trees;
  for (const auto& entry : fs::directory_iterator(BTCHECK_BTCPP_PROBES)) {
    if (entry.path().extension() == ".xml") trees.push_back(entry.path());
  }
  std::sort(trees.begin(), trees.end());
  REQUIRE(trees.size() == 63);
  std::size_t ticks = 0;
  for (const fs::path& file : trees) {
    CAPTURE(file.filename());
    // An entry that nothing in the tree writes may have been set by the
    // program; the reader warns (BT1627).
    if (file.stem() == "P21") continue;
    const std::string text = file_text(file.string());
    TreeReading reading;
    reading.profile = uses_nav2(text) ? Profile::Nav2Main : Profile::Btcpp4;
    reading.loops = true;
    const fs::path expected = fs::path(file).replace_extension(".expected");
    reading.wakes =
        file_text(expected.string()).find("tickOnce") != std::string::npos;
    const auto tree = read_tree(file.string(), text, reading);
    REQUIRE(tree.value.has_value());
    const std::vector<Line> record = record_of(expected);
    CHECK(text_of(Replay(*tree.value, record).run()) == text_of(record));
    ticks += record.size();
  }
  MESSAGE((trees.size() - 1) << " recorded runs, " << ticks << " ticks");
}

}  // namespace btcheck::btcpp_probes_test

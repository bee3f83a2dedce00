// SPDX-License-Identifier: MIT
//
// Logs to be explained: of a tree and a script of what its leaves answer.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "check/check.hpp"
#include "check/simulate/script.hpp"
#include "check/simulate/simulation.hpp"
#include "model/sampling.hpp"
#include "model/tree_file.hpp"
#include "report/explain/text.hpp"
#include "trace/explain/explain.hpp"
#include "trace/run/record.hpp"

namespace btcheck {

// A tree in XML, as it is and as it is explained: its network must stay where
// it is.
class ScriptedTreeLog {
 public:
  ScriptedTreeLog(const std::string& inside, const std::string& leaves,
                  const std::string& script, int ticks = 40)
      : xml_("<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"M\">\n" + inside +
             "\n</BehaviorTree>\n</root>\n"),
        tree_(read(leaves)),
        network_(
            lower_values(tree_, SourceText("t.xml", xml_), TickSemantics::Root)
                .value.value()) {
    const auto read = read_simulation_script(tree_, network_, "script", script);
    REQUIRE(read.value.has_value());
    const SourceText source("script", script);
    ScriptPlayer player(*read.value, source);
    Simulation simulation(tree_, network_, Interleaving::InOrder);
    while (simulation.end() == RunEnd::None) {
      const bool begins = simulation.choices()[0].kind == ChoiceKind::Tick;
      if (begins && simulation.ticks(tree_.roots[0]) >= ticks) break;
      const ScriptedChoice choice = player.choose(simulation);
      const auto* number = std::get_if<std::size_t>(&choice);
      REQUIRE(number != nullptr);
      simulation.take(*number);
    }
    const RecordedRun run = recorded(tree_, network_, simulation.run(), {});
    log_ = read_log("t.btlog", btlog_bytes(run, 1)).value.value();
  }

  const BehaviorTree& tree() const { return tree_; }
  BehaviorLog& log() { return log_; }

  Explanation explained(Limits limits = {}) {
    follow();
    return explain({{tree_, SourceText("t.xml", xml_), TickSemantics::Root},
                    network_,
                    tree_,
                    1},
                   *asked_, limits);
  }
  std::string text(const Explanation& found) const {
    return explain_text({"t.btlog", tree_, *asked_, found});
  }
  std::string json(const Explanation& found) const {
    return explain_json({"t.btlog", tree_, *asked_, found});
  }
  std::string text() { return text(explained()); }

 private:
  BehaviorTree read(const std::string& leaves) const {
    TreeReading reading;
    reading.leaves = {{"t.leaves", leaves}};
    auto made = read_tree("t.xml", xml_, reading);
    REQUIRE(made.value.has_value());
    return std::move(*made.value);
  }
  void follow() {
    auto nodes = LoggedNodes::match(
        log_, tree_, recorded_tree(tree_, TreeInput("t.xml", xml_)));
    REQUIRE(nodes.value.has_value());
    nodes_ = std::move(nodes.value);
    moments_.emplace(log_, *nodes_, reading_);
    asked_.emplace(ExplainedLog{log_, *nodes_, reading_, *moments_});
  }

  std::string xml_;
  BehaviorTree tree_;
  Network network_;
  BehaviorLog log_;
  LogReading reading_;
  std::optional<LoggedNodes> nodes_;
  std::optional<LogMoments> moments_;
  std::optional<ExplainedLog> asked_;
};

}  // namespace btcheck

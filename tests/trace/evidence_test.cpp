// SPDX-License-Identifier: MIT
//
// What logs show of leaves, as a contract.
#include "trace/conform/evidence_of_logs.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "model/tree_file.hpp"
#include "trace/run/record.hpp"

namespace btcheck::evidence_test {
namespace {

const std::string kTree = R"(<root BTCPP_format="4">
  <BehaviorTree ID="M">
    <ReactiveSequence name="guarded">
      <Battery name="battery"/>
      <Recover name="recover"/>
    </ReactiveSequence>
  </BehaviorTree>
</root>)";

using Record = std::pair<std::uint16_t, LogStatus>;  // uid, status

// `battery` is a SimpleActionNode, `recover` answers after so many ticks; 0: it
// is still running at the end.
BehaviorLog log_of(int ticks, int most) {
  BehaviorLog log;
  log.begin = 1'700'000'000'000'000;
  log.tree = "M";
  log.nodes = {{1, "guarded", "ReactiveSequence", {}, 0},
               {2, "battery", "Battery", 1, 1},
               {3, "recover", "Recover", 1, 1}};
  std::vector<LogStatus> status(4, LogStatus::Idle);
  std::int64_t time = 0;
  const auto change = [&](std::uint16_t uid, LogStatus after) {
    log.transitions.push_back({++time, uid, status[uid], after});
    status[uid] = after;
  };
  for (int tick = 0; tick <= most; ++tick) {
    time = tick * 100'000;
    if (tick == 0) change(1, LogStatus::Running);
    change(2, LogStatus::Running);
    change(2, LogStatus::Success);
    if (tick == 0) change(3, LogStatus::Running);
    if (tick > 0 && tick == ticks) {
      change(3, LogStatus::Success);
      change(2, LogStatus::Idle);
      change(3, LogStatus::Idle);
      change(1, LogStatus::Success);
      break;
    }
  }
  return log;
}

std::string learned(const std::vector<BehaviorLog>& logs) {
  const TreeInput input{InputFile{"t.xml", kTree}};
  const auto tree = read_tree("t.xml", kTree, {});
  REQUIRE(tree.value);
  LogEvidence evidence(*tree.value);
  for (const BehaviorLog& log : logs) {
    const auto nodes =
        LoggedNodes::match(log, *tree.value, recorded_tree(*tree.value, input));
    REQUIRE(nodes.value);
    evidence.add(log, *nodes.value, {});
  }
  const std::string text = evidence.leaves_text();
  return text.substr(text.find("(defaction"));
}

TEST_CASE("a duration is learned with a margin and the number of samples") {
  CHECK(learned({log_of(6, 6)}) ==
        "(defaction Battery  ; success 7, failure 0, began to run 0, halted 0\n"
        "  :returns (success))\n"
        "(defaction Recover  ; success 1, failure 0, began to run 1, halted 0\n"
        "  :returns (success running)\n"
        "  :duration [1,12])  ; 1 sample: 6 ticks, and a margin of 6\n");
  std::vector<BehaviorLog> many;
  for (int ticks = 3; ticks <= 8; ++ticks) many.push_back(log_of(ticks, 8));
  CHECK(
      learned(many).find("  :duration [1,10])  ; 6 samples: 3 to 8 ticks, and "
                         "a margin of 2\n") != std::string::npos);
  many.push_back(log_of(0, 20));
  CHECK(learned(many).find(
            "[1,inf])  ; 6 samples: 3 to 8 ticks, and a margin of "
            "2; 21 ticks without an answer\n") != std::string::npos);
  CHECK(learned({log_of(0, 3)}).find("[1,inf])  ; it never answered\n") !=
        std::string::npos);
}

}  // namespace
}  // namespace btcheck::evidence_test

// SPDX-License-Identifier: MIT
//
// btcheck/observer.hpp over a stand-in for the engine: verdicts at their
// moments, what becomes of them, and a log that says the same afterwards.
// tests/btcpp_engine asks the engine itself.
#include "btcheck/observer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "file_text.hpp"
#include "ltl/rules/name_help.hpp"
#include "model/tree_file.hpp"
#include "temporary_folder.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/marks.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/monitor_table.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck::observer_test {
namespace {

using BT::NodeStatus;
using monitor::Verdict;
using Answers = std::vector<NodeStatus>;
constexpr NodeStatus kRuns = NodeStatus::RUNNING;
constexpr NodeStatus kSucceeds = NodeStatus::SUCCESS;
constexpr NodeStatus kFails = NodeStatus::FAILURE;
constexpr NodeStatus kSkips = NodeStatus::SKIPPED;

constexpr std::string_view kXml = R"(<root BTCPP_format="4">
  <BehaviorTree ID="Main">
    <ReactiveSequence name="mission">
      <Ask name="safe"/>
      <Verdict name="lost" rule="power" is="open"/>
      <Sequence name="tour">
        <Act name="plan" level="{battery}"/>
        <Act name="drive"/>
      </Sequence>
    </ReactiveSequence>
  </BehaviorTree>
  <TreeNodesModel>
    <Condition ID="Ask"/>
    <Action ID="Act"><output_port name="level" type="int"/></Action>
  </TreeNodesModel>
</root>
)";

constexpr std::string_view kRules = R"(
property power: never battery < 20
property drives: plan.success precedes drive.ticked
property soon: whenever plan.success then drive.success within 2 ticks
property unskipped: never safe.skipped
property halted: never drive.halted
property fine: never root.failure
)";

class Leaf : public BT::TreeNode {
 public:
  Leaf(const std::string& name, Answers answers)
      : BT::TreeNode(name, {}), answers_(std::move(answers)) {}
  NodeStatus tick() override {
    if (does) does(at_);
    const NodeStatus answer = answers_.at(at_);
    if (at_ + 1 < answers_.size()) ++at_;
    return answer;
  }
  std::function<void(std::size_t)> does;

 private:
  Answers answers_;
  std::size_t at_ = 0;
};

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

// The tree of kXml, with these answers of its leaves.
struct Robot {
  Robot(Answers safe_answers, Answers plan_answers, Answers drive_answers,
        bool has_verdict = true) {
    auto board = std::make_shared<BT::Blackboard>();
    const auto add = [&](std::shared_ptr<BT::TreeNode> node,
                         const std::string& type) {
      tree.subtrees[0]->nodes.push_back(node);
      node->name_type(
          type, static_cast<std::uint16_t>(tree.subtrees[0]->nodes.size()));
      return node.get();
    };
    tree.subtrees.push_back(std::make_shared<BT::Tree::Subtree>());
    tree.subtrees[0]->blackboard = board;
    const BT::NodeConfig config{board, {}};
    auto top = std::make_shared<BT::ReactiveSequence>("mission", config);
    add(top, "ReactiveSequence");
    safe = static_cast<Leaf*>(
        add(std::make_shared<Leaf>("safe", std::move(safe_answers)), "Ask"));
    BT::TreeNode* lost =
        has_verdict ? add(std::make_shared<VerdictCondition>(
                              "lost",
                              BT::NodeConfig{
                                  board, {{"rule", "power"}, {"is", "open"}}}),
                          "Verdict")
                    : add(std::make_shared<Leaf>("lost", Answers{kSucceeds}),
                          "Verdict");
    auto tour = std::make_shared<BT::Sequence>("tour", config);
    add(tour, "Sequence");
    plan = static_cast<Leaf*>(
        add(std::make_shared<Leaf>("plan", std::move(plan_answers)), "Act"));
    drive = static_cast<Leaf*>(
        add(std::make_shared<Leaf>("drive", std::move(drive_answers)), "Act"));
    tour->all = {plan, drive};
    top->all = {safe, lost, tour.get()};
  }

  BT::Tree tree;
  Leaf* safe = nullptr;
  Leaf* plan = nullptr;
  Leaf* drive = nullptr;
};

struct Rules {
  explicit Rules(std::string_view text = kRules)
      : text_(text), source("r.ltl", text_) {
    auto read = read_tree("t.xml", std::string(kXml), {});
    REQUIRE(read.value);
    tree = std::make_unique<BehaviorTree>(std::move(*read.value));
    auto rules = read_properties("r.ltl", text_);
    REQUIRE(rules.value);
    file = std::move(*rules.value);
    const InputFile input{"t.xml", std::string(kXml)};
    nodes = recorded_tree(*tree, TreeInput(input));
    auto made = monitor_table(*tree, nodes, file, source);
    for (const Diagnostic& each : made.diagnostics) MESSAGE(render(each));
    REQUIRE(made.value);
    table = *made.value;
  }

  // What `btcheck trace` says of a log, as "power: VIOLATED 3".
  std::vector<std::string> told(const std::string& name) const {
    auto log = read_log(name, file_text(name));
    REQUIRE(log.value);
    const std::string marks = name + ".marks";
    for (const Diagnostic& each :
         read_marks(marks, file_text(marks), *log.value)) {
      FAIL(render(each));
    }
    const auto report = watch_log_as(nodes, name, *log.value, {}, file, source);
    REQUIRE(report.value);
    std::vector<std::string> lines;
    for (const WatchedRule& rule : report.value->rules) {
      if (rule.outlook == Outlook::Open) continue;
      lines.push_back(
          rule.name + ": " +
          std::string(kOutlookNames[static_cast<std::size_t>(rule.outlook)]) +
          " " + std::to_string(rule.tick.value_or(0)));
    }
    std::ranges::sort(lines);
    return lines;
  }

  std::string text_;
  SourceText source;
  std::unique_ptr<BehaviorTree> tree;
  PropertyFile file;
  RecordedRun nodes;
  std::string table;
};

TEST_CASE("a run is decided where it happens, and its log says the same") {
  const Rules rules;
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "run.btlog").string();
  Robot robot({kSucceeds, kSucceeds, kSkips, kFails, kSucceeds},
              {kSucceeds, kRuns}, {kRuns, kRuns, kRuns});
  const auto board = robot.tree.rootBlackboard();
  robot.plan->does = [&](std::size_t) { board->set("battery", 30); };
  robot.drive->does = [&](std::size_t n) {
    board->set("battery", 30 - 6 * static_cast<int>(n));
  };
  ObserverOptions options;
  options.log = log;
  std::vector<std::string> heard;
  {
    Observer observer(robot.tree, rules.table, options);
    observer.call("*", [&](const Decision& decided) {
      heard.push_back(decided.name + ": " +
                      monitor::verdict_name(decided.verdict) + " " +
                      std::to_string(decided.tick));
    });
    for (int tick = 0; tick < 6; ++tick) observer.tickExactlyOnce();
    CHECK(observer.verdict("power") == Verdict::Violated);
    CHECK(observer.verdict("fine") == Verdict::Violated);
    CHECK_THROWS_AS((void)observer.verdict("nobody"), std::invalid_argument);
    CHECK(observer.lost_events() == 0);
  }
  std::ranges::sort(heard);
  const std::vector<std::string> expected = {
      "drives: SATISFIED 1", "fine: VIOLATED 4", "halted: VIOLATED 4",
      "power: VIOLATED 3",   "soon: VIOLATED 3", "unskipped: VIOLATED 3"};
  CHECK(joined(heard) == joined(expected));
  CHECK(joined(rules.told(log)) == joined(heard));
}

TEST_CASE("a rule that is violated ends the mission, or leaves the tick") {
  const Rules rules;
  const auto drives = [](Robot& robot) {
    const auto board = robot.tree.rootBlackboard();
    robot.plan->does = [board](std::size_t) { board->set("battery", 10); };
  };
  SUBCASE("the mission ends in that tick") {
    Robot robot({kSucceeds}, {kRuns}, {kRuns}, false);
    drives(robot);
    Observer observer(robot.tree, rules.table);
    observer.halt("power");
    CHECK(observer.tickOnce() == kFails);
    CHECK(robot.plan->status() == NodeStatus::IDLE);
    CHECK(robot.tree.rootNode()->status() == NodeStatus::IDLE);
    CHECK(observer.tickOnce() == kRuns);  // another mission
  }
  SUBCASE("a deadline that is lost with its tick ends the next one") {
    Robot robot({kSucceeds}, {kSucceeds, kRuns}, {kRuns}, false);
    Observer observer(robot.tree, rules.table);
    observer.halt("soon");
    CHECK(observer.tickOnce() == kRuns);
    CHECK(observer.tickOnce() == kRuns);
    CHECK(observer.tickOnce() == kRuns);
    CHECK(observer.verdict("soon") == Verdict::Violated);
    CHECK(observer.tickOnce() == kFails);
    CHECK(robot.drive->status() == NodeStatus::IDLE);
  }
  SUBCASE("an exception leaves it") {
    Robot robot({kSucceeds}, {kRuns}, {kRuns}, false);
    drives(robot);
    Observer observer(robot.tree, rules.table);
    observer.raise("power");
    try {
      observer.tickOnce();
      FAIL("nothing was thrown");
    } catch (const RuleViolated& violated) {
      CHECK(violated.decision().name == "power");
      CHECK(violated.decision().evidence.find("plan -> RUNNING") !=
            std::string::npos);
    }
    CHECK(observer.tickOnce() == kRuns);
  }
  SUBCASE("an entry says so, and a node of the tree asks") {
    Robot robot({kSucceeds}, {kRuns}, {kRuns});
    drives(robot);
    Observer observer(robot.tree, rules.table);
    observer.set_entry("power", "alarm", 1);
    CHECK(observer.tickOnce() == kRuns);
    const auto alarm = robot.tree.rootBlackboard()->getAnyLocked("alarm");
    REQUIRE(alarm);
    CHECK(alarm.get()->cast<std::int64_t>() == 1);
    CHECK(observer.tickOnce() == kFails);  // `lost` is not open any more
  }
}

TEST_CASE("a Verdict that nobody watches, or of no rule, is an error") {
  const Rules other("property other: never root.failure\n");
  Robot robot({kSucceeds}, {kRuns}, {kRuns});
  CHECK_THROWS_AS(robot.tree.tickOnce(), BT::RuntimeError);
  CHECK_THROWS_AS(Observer(robot.tree, other.table), std::invalid_argument);
}

TEST_CASE("an exception is an end of a tick without an answer") {
  const Rules rules(
      "property a: never root.running and previously true\n"
      "property b: whenever plan.ticked then root.running "
      "within 1 tick\n");
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "run.btlog").string();
  for (const bool by_observer : {true, false}) {
    Robot robot({kSucceeds}, {kRuns}, {kRuns}, false);
    robot.plan->does = [](std::size_t) { throw std::runtime_error("no plan"); };
    ObserverOptions options;
    options.log = log;
    std::vector<std::string> heard;
    {
      Observer observer(robot.tree, rules.table, options);
      observer.call("*", [&](const Decision& decided) {
        heard.push_back(decided.name + ": " +
                        monitor::verdict_name(decided.verdict) + " " +
                        std::to_string(decided.tick));
      });
      for (int tick = 0; tick < 3; ++tick) {
        if (by_observer) {
          CHECK_THROWS(observer.tickOnce());
        } else {
          CHECK_THROWS(robot.tree.tickOnce());
        }
      }
    }
    CHECK(joined(heard) == "b: VIOLATED 2\n");
    CHECK(rules.told(log).size() <= heard.size());
  }
}

TEST_CASE("another tree is refused, by its first node that differs") {
  const Rules rules;
  const auto refusal = [&](const std::function<void(Robot&)>& change) {
    Robot robot({kSucceeds}, {kRuns}, {kRuns}, false);
    change(robot);
    try {
      const Observer observer(robot.tree, rules.table);
    } catch (const WrongTree& wrong) {
      return std::string(wrong.what());
    }
    return std::string();
  };
  CHECK(refusal([](Robot&) {}).empty());
  const auto top = [](Robot& robot) -> BT::ControlNode& {
    return dynamic_cast<BT::ControlNode&>(*robot.tree.rootNode());
  };
  CHECK(refusal([](Robot& robot) {
          robot.drive->name_type("Action", 6);
        }).find("its node 6 is `drive` (Action)") != std::string::npos);
  CHECK(refusal([&](Robot& robot) {
          std::swap(top(robot).all[0], top(robot).all[1]);
        }).find("its node 2") != std::string::npos);
  CHECK(refusal([&](Robot& robot) {
          top(robot).all.pop_back();
        }).find("it has 3 nodes") != std::string::npos);
}

TEST_CASE("a table that is not as it was written is refused") {
  const Rules rules;
  Robot robot({kSucceeds}, {kRuns}, {kRuns}, false);
  for (std::size_t length = 0; length < rules.table.size();
       length += 1 + rules.table.size() / 300) {
    CHECK_THROWS_AS(Observer(robot.tree, rules.table.substr(0, length)),
                    WrongTable);
    std::string other = rules.table;
    other[length] = static_cast<char>(other[length] ^ 1);
    CHECK_THROWS_AS(Observer(robot.tree, other), WrongTable);
  }
}

TEST_CASE("two observers of one tree, and two trees") {
  const Rules rules;
  const Rules other("property fine: never root.success\n");
  Robot robot({kSucceeds}, {kSucceeds, kRuns}, {kSucceeds}, false);
  Robot second({kFails}, {kRuns}, {kRuns}, false);
  Observer one(robot.tree, rules.table);
  Observer third(second.tree, rules.table);
  {
    Observer two(robot.tree, other.table);
    CHECK(one.tickOnce() == kSucceeds);
    CHECK(two.verdict("fine") == Verdict::Violated);
    CHECK(one.verdict("drives") == Verdict::Satisfied);
    CHECK(third.verdict("drives") == Verdict::Open);
  }
  CHECK(third.tickOnce() == kFails);
  CHECK(third.verdict("fine") == Verdict::Violated);
  CHECK(one.verdict("fine") == Verdict::Open);
}

TEST_CASE("ticks that were woken up are told from others") {
  const Rules rules(
      "property soon: whenever plan.ticked then plan.success "
      "within 2 ticks\n");
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "run.btlog").string();
  Robot robot({kSucceeds}, {kRuns}, {kRuns}, false);
  robot.plan->does = [&](std::size_t) {
    static int left = 1;
    if (left-- > 0) robot.tree.emitWakeUpSignal();
  };
  ObserverOptions options;
  options.log = log;
  {
    Observer observer(robot.tree, rules.table, options);
    observer.tickOnce();
    observer.tickOnce();
  }
  auto read = read_log(log, file_text(log));
  REQUIRE(read.value);
  REQUIRE(read_marks(log + ".marks", file_text(log + ".marks"), *read.value)
              .empty());
  std::string ticks;
  each_mark(*read.value->marks, [&](const LogMark& mark) {
    if (begins_tick(mark)) {
      ticks += mark.kind == MarkKind::TickIsWoken ? 'w' : 't';
    }
  });
  CHECK(ticks == "twt");
}

TEST_CASE("files of a log are bounded, and each can be read alone") {
  const Rules rules;
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "run.btlog").string();
  Robot robot({kSucceeds}, {kSucceeds, kRuns}, {kRuns, kRuns, kSucceeds},
              false);
  ObserverOptions options;
  options.log = log;
  options.log_bytes = 4096;
  options.log_files = 2;
  {
    Observer observer(robot.tree, rules.table, options);
    for (int tick = 0; tick < 2000; ++tick) {
      robot.tree.rootBlackboard()->set("battery", tick);
      observer.tickOnce();
    }
  }
  std::size_t count = 0;
  for (const auto& each : std::filesystem::directory_iterator(folder.path())) {
    if (each.path().extension() == ".marks") continue;
    ++count;
    CHECK(each.file_size() < 8192);
    const std::string name = each.path().string();
    auto read = read_log(name, file_text(name));
    REQUIRE(read.value);
    CHECK(read_marks(name + ".marks", file_text(name + ".marks"), *read.value)
              .empty());
  }
  CHECK(count == 2);
  CHECK(!std::filesystem::exists(log));
}

}  // namespace
}  // namespace btcheck::observer_test

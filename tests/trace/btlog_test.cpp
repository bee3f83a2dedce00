// SPDX-License-Identifier: MIT
//
// What we write as a .btlog is what BehaviorTree.CPP would have written.

#include <doctest/doctest.h>

#include <random>
#include <regex>
#include <string>
#include <vector>

#include "trace/btcpp_engine.hpp"
#include "trace/example_runs.hpp"
#include "trace/log_files.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/btcpp_tree.hpp"
#include "trace/recorded_run_maker.hpp"

namespace btcheck::btlog_test {
namespace {

// The models of BehaviorTree.CPP 4.10 as the sample has them, without the ones
// that the program that wrote it had registered itself.
std::string builtin_models() {
  const std::string sample = data_file("btcpp4.10_sample.btlog");
  const std::size_t begin = sample.find("    <TreeNodesModel>");
  const std::size_t end = sample.find("    </TreeNodesModel>");
  REQUIRE(end != std::string::npos);
  std::string models = sample.substr(begin, end - begin);
  for (const char* other :
       {"Act", "Sync", "NonblockingSequence", "PersistentSequence",
        "PipelineSequence", "RecoveryNode", "RoundRobin", "SingleTrigger"}) {
    const std::regex model(std::string("        <(\\w+) ID=\"") + other +
                           "\"(/>|>[^]*?</\\1>)\n");
    models = std::regex_replace(models, model, "",
                                std::regex_constants::format_first_only);
  }
  // The order of ports is that of a hash table and means nothing: the last
  // first, but for this one.
  const std::string port =
      "            <input_port name=\"case_6\" type=\"std::string\"/>\n";
  models.erase(models.find(port), port.size());
  models.insert(models.find("            <input_port name=\"case_5\"",
                            models.find("ID=\"Switch6\"")),
                port);
  return models;
}

std::string with_model(std::string models, const std::string& before,
                       const std::string& line) {
  models.insert(models.find("        <" + before), "        " + line + "\n");
  return models;
}

std::string bytes_of(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

std::vector<BtcppEngine::Event> events_in(const std::string& bytes) {
  const auto log = read_log("x.btlog", bytes);
  REQUIRE(log.value);
  CHECK(log.diagnostics.empty());
  std::vector<BtcppEngine::Event> events;
  for (const LogTransition& change : log.value->transitions) {
    events.push_back({change.uid, change.after});
  }
  return events;
}

TEST_CASE("a hand-made run is the log of BehaviorTree.CPP, byte for byte") {
  BtcppEngine engine;
  const auto sequence = engine.add("Sequence", "do it", 0);
  engine.add("Condition", "ok?", sequence);
  engine.add("Action", "go", sequence);
  engine.tick([](std::uint32_t leaf) {
    return leaf == 2 ? LogStatus::Success : LogStatus::Running;
  });
  engine.tick([](std::uint32_t) { return LogStatus::Failure; });

  std::string models = builtin_models();
  models = with_model(models, "Control ID=\"IfThenElse", "<Action ID=\"go\"/>");
  // "go" comes after every capital, "ok_" after it.
  const std::string go = "        <Action ID=\"go\"/>\n";
  models.erase(models.find(go), go.size());
  models += go + "        <Condition ID=\"ok_\"/>\n";
  const std::string xml =
      "<root BTCPP_format=\"4\">\n"
      "    <BehaviorTree ID=\"main\" _fullpath=\"\">\n"
      "        <Sequence name=\"do it\" _uid=\"1\">\n"
      "            <ok_ name=\"ok?\" _uid=\"2\"/>\n"
      "            <go name=\"go\" _uid=\"3\"/>\n"
      "        </Sequence>\n"
      "    </BehaviorTree>\n" +
      models +
      "    </TreeNodesModel>\n"
      "</root>\n";
  const auto size = static_cast<int>(xml.size());
  const std::string expected =
      "BTCPP4-FileLogger2" + bytes_of({1, size & 0xFF, size >> 8, 0, 0}) + xml +
      // 946,684,800,000,000 us are 0x35D013B37E000
      bytes_of({0x00, 0xE0, 0x37, 0x3B, 0x01, 0x5D, 0x03, 0x00}) +
      // 100,000 us are 0x186A0
      bytes_of({0xA0, 0x86, 0x01, 0, 0, 0, 1, 0, 1}) +  // sequence RUNNING
      bytes_of({0xA1, 0x86, 0x01, 0, 0, 0, 2, 0, 2}) +  // ok? SUCCESS
      bytes_of({0xA2, 0x86, 0x01, 0, 0, 0, 3, 0, 1}) +  // go RUNNING
      // 200,000 us are 0x30D40
      bytes_of({0x40, 0x0D, 0x03, 0, 0, 0, 3, 0, 3}) +  // go FAILURE
      bytes_of({0x41, 0x0D, 0x03, 0, 0, 0, 2, 0, 0}) +  // ok? IDLE
      bytes_of({0x42, 0x0D, 0x03, 0, 0, 0, 3, 0, 0}) +  // go IDLE
      bytes_of({0x43, 0x0D, 0x03, 0, 0, 0, 1, 0, 3}) +  // sequence FAILURE
      bytes_of({0x44, 0x0D, 0x03, 0, 0, 0, 1, 0, 0});   // sequence IDLE
  const std::string written = btlog_bytes(engine.run());
  CHECK(written.substr(23, xml.size()) == xml);
  CHECK(written == expected);
}

TEST_CASE("the sample's tree is written as BehaviorTree.CPP wrote it") {
  const std::string sample = data_file("btcpp4.10_sample.btlog");
  const std::string written = btlog_bytes(sample_execution().run());
  std::string trees =
      sample.substr(23, sample.find("    <TreeNodesModel") - 23);
  // Types and ports that the run does not know.
  const auto replace = [&](const std::string& from, const std::string& to) {
    REQUIRE(trees.find(from) != std::string::npos);
    trees.replace(trees.find(from), from.size(), to);
  };
  replace("ID=\"Main\"", "ID=\"main\"");
  replace("<Act name", "<a name");
  replace("<Sync name", "<s name");
  replace(" seq=\"RS\"", "");
  replace(" seq=\"F\"", "");
  replace(" p=\"{x}\"", "");
  CHECK(written.substr(23, trees.size()) == trees);
}

TEST_CASE("the sample's changes come out in BehaviorTree.CPP's order") {
  const std::string sample = data_file("btcpp4.10_sample.btlog");
  const BtcppEngine engine = sample_execution();
  BtcppEngine copy = engine;
  CHECK(events_in(sample) == engine.events());  // the engine is one as well
  CHECK(events_in(btlog_bytes(copy.run())) == engine.events());
}

TEST_CASE("random executions read back as the changes that were logged") {
  std::mt19937 random(5);
  std::size_t events = 0;
  for (int round = 0; round < 400; ++round) {
    CAPTURE(round);
    BtcppEngine engine = random_execution(random);
    const auto read = events_in(btlog_bytes(engine.run()));
    REQUIRE(read == engine.events());
    events += read.size();
  }
  CHECK(events > 5000);
}

// Each completion of a finite run of one tree is in its log, in its tick.
void check_completions(const RecordedRun& run) {
  const auto log = read_log("x.btlog", btlog_bytes(run));
  REQUIRE(log.value);
  struct Completion {
    std::size_t node;
    LogStatus status;
    std::int64_t tick;
    bool operator==(const Completion&) const = default;
  };
  std::vector<Completion> told;
  for (const LogTransition& change : log.value->transitions) {
    CHECK(change.before != change.after);
    if (!is_completed(change.after)) continue;
    told.push_back({change.uid, change.after, change.time / kTickTime});
  }
  std::vector<std::vector<Completion>> wanted(run.nodes.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    for (std::size_t n = 1; n < run.nodes.size(); ++n) {
      const Phase now = run.states[i].phases[n];
      const bool is_new = i == 0 || run.states[i - 1].phases[n] != now;
      const bool succeeds = now == Phase::Success;
      if (!is_new || (!succeeds && now != Phase::Failure)) continue;
      wanted[n].push_back({n,
                           succeeds ? LogStatus::Success : LogStatus::Failure,
                           run.states[i].tick});
      ++count;
    }
  }
  REQUIRE(told.size() == count);
  std::vector<std::size_t> next(run.nodes.size(), 0);
  for (const Completion& completion : told) {
    REQUIRE(wanted[completion.node][next[completion.node]++] == completion);
  }
}

TEST_CASE("whatever the phases, each completion is in the log, in its tick") {
  std::mt19937 random(6);
  for (int round = 0; round < 400; ++round) {
    CAPTURE(round);
    RecordedRun run = random_phases(random);
    run.loop = kNoState;
    // Who is being halted answers nothing.
    for (std::size_t i = 1; i < run.states.size(); ++i) {
      for (std::size_t n = 0; n < run.nodes.size(); ++n) {
        Phase& now = run.states[i].phases[n];
        const bool has_answered =
            now == Phase::Success || now == Phase::Failure;
        if (has_answered && run.states[i - 1].phases[n] == Phase::Halting) {
          now = Phase::Halted;
        }
      }
    }
    check_completions(run);
  }
}

TEST_CASE("so is each of the runs of the examples") {
  for (RecordedRun run : example_runs()) {
    CAPTURE(run.tree);
    CAPTURE(run.property);
    run.loop = kNoState;
    check_completions(run);
  }
}

TEST_CASE("times increase, and say the tick") {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    BtcppEngine engine = random_execution(random);
    const auto log = read_log("x.btlog", btlog_bytes(engine.run()));
    REQUIRE(log.value);
    CHECK(log.value->begin == kLogBegin);
    std::int64_t last = 0;
    for (const LogTransition& change : log.value->transitions) {
      CHECK(change.time > last);
      last = change.time;
    }
    CHECK(last / kTickTime <= engine.run().states.back().tick);
  }
}

TEST_CASE("a loop is gone through as often as asked") {
  RecordedRun run = looping_run();
  RecordedRun straight = run;
  const std::size_t count = run.states.size();
  for (int pass = 1; pass < 4; ++pass) {
    for (std::size_t i = run.loop; i < count; ++i) {
      straight.states.push_back(run.states[i]);
      straight.states.back().tick += pass;
    }
  }
  straight.loop = kNoState;
  CHECK(btlog_bytes(run, 4) == btlog_bytes(straight));
  CHECK(btlog_bytes(run) == btlog_bytes(run, 2));
  CHECK(btlog_bytes(run, 2).size() < btlog_bytes(run, 4).size());
  straight.states.resize(count);
  CHECK(btlog_bytes(run, 1) == btlog_bytes(straight));
  CHECK(btlog_bytes(run, 0) == btlog_bytes(straight));
}

TEST_CASE("trees in parallel stand as subtrees below one node") {
  RecordedRun run = sample_execution().run();
  RecordedNode root;
  root.type = "BehaviorTree";
  root.name = "other tree";
  run.nodes.push_back(root);
  RecordedNode leaf;
  leaf.type = "Action";
  leaf.name = "b";
  leaf.parent = 7;
  run.nodes.push_back(leaf);
  for (RecordedState& state : run.states) {
    for (int i = 0; i < 2; ++i) {
      state.phases.push_back(state.tick == 2 ? Phase::Failure
                                             : Phase::Unvisited);
      state.is_stale.push_back(false);
    }
  }
  const auto log = read_log("x.btlog", btlog_bytes(run));
  REQUIRE(log.value);
  REQUIRE(log.value->nodes.size() == 10);
  const auto name = [&](std::uint16_t uid) {
    const LogNode* node = log.value->find(uid);
    return node->type + " " + node->name + " " +
           std::to_string(node->parent.value_or(0));
  };
  CHECK(name(1) == "ParallelAll ParallelAll 0");
  CHECK(name(2) == "SubTree main 1");
  CHECK(name(3) == "Sequence Sequence 2");
  CHECK(name(5) == "SubTree Sub 3");
  CHECK(name(6) == "Fallback Fallback 5");
  CHECK(name(9) == "SubTree other_tree 1");
  CHECK(name(10) == "b b 9");
  const LogTransition last = log.value->transitions.back();
  CHECK(last.uid == 1);
  CHECK(last.before == LogStatus::Failure);
  CHECK(last.after == LogStatus::Idle);
}

TEST_CASE("names of types are fit for XML, names of nodes are kept") {
  RecordedRun run;
  const auto add = [&](const char* type, const char* name,
                       std::optional<std::uint32_t> parent) {
    RecordedNode node;
    node.type = type;
    node.name = name;
    node.parent = parent;
    run.nodes.push_back(node);
  };
  add("BehaviorTree", "root", {});
  add("Recovery", "r&d <1>", 0);
  add("Action", "Sequence", 1);
  add("Condition", "höhe 3", 1);
  add("Action", "h_he_3", 1);
  add("Eval", "Eval9", 1);
  add("Action", "9 lives", 1);
  add("RateController", "RateController5", 1);
  add("SetSV", "measure", 7);
  RecordedState state;
  state.phases.assign(run.nodes.size(), Phase::Unvisited);
  state.is_stale.assign(run.nodes.size(), false);
  run.states.push_back(state);
  const LoggedTree tree = btcpp_tree(run);
  CHECK(tree.id == "root_");
  const std::string xml = btcpp_xml(tree);
  CHECK(xml.find("<RecoveryNode name=\"r&amp;d &lt;1&gt;\" _uid=\"1\">") !=
        std::string::npos);
  CHECK(xml.find("<Sequence_ name=\"Sequence\" _uid=\"2\"/>") !=
        std::string::npos);
  CHECK(xml.find("<h_he_3 name=\"höhe 3\" _uid=\"3\"/>") != std::string::npos);
  CHECK(xml.find("<h_he_3_ name=\"h_he_3\" _uid=\"4\"/>") != std::string::npos);
  CHECK(xml.find("<Eval name=\"Eval9\" _uid=\"5\"/>") != std::string::npos);
  CHECK(xml.find("<_9_lives name=\"9 lives\" _uid=\"6\"/>") !=
        std::string::npos);
  CHECK(xml.find("<Condition ID=\"h_he_3\"/>") != std::string::npos);
  CHECK(xml.find("<Action ID=\"h_he_3_\"/>") != std::string::npos);
  CHECK(xml.find("<Condition ID=\"Eval\"/>") != std::string::npos);
  CHECK(xml.find("<Control ID=\"RecoveryNode\"/>") != std::string::npos);
  CHECK(xml.find("<Decorator ID=\"RateController\"/>") != std::string::npos);
  CHECK(xml.find("<Action ID=\"SetSV\"/>") != std::string::npos);
  const auto log = read_log("x.btlog", btlog_bytes(run));
  REQUIRE(log.value);
  CHECK(log.value->find(3)->name == "höhe 3");
  CHECK(log.value->find(1)->name == "r&d <1>");
  CHECK(log.value->find(8)->parent == 7);
}

}  // namespace
}  // namespace btcheck::btlog_test

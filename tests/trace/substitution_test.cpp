// SPDX-License-Identifier: MIT
//
// Test nodes made from a run answer what the run's leaves answered: tried on
// nodes that behave like BehaviorTree.CPP's TestNode.
#include "trace/run/itf.hpp"

#include <doctest/doctest.h>

#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "trace/example_runs.hpp"
#include "trace/recorded_run_maker.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck::substitution_test {
namespace {

using nlohmann::json;

// The part of BehaviorTree.CPP's scripting that the rules use: numbers, names,
// + < ? : := and parentheses.
class Script {
 public:
  Script(std::string text, std::map<std::string, int>& blackboard)
      : text_(std::move(text)), blackboard_(blackboard) {}

  int value() {
    const int result = expression();
    REQUIRE(at_ == text_.size());
    return result;
  }

 private:
  bool take(const std::string& token) {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }

  int expression() {
    const std::size_t begin = at_;
    const std::string target = name();
    if (!target.empty() && take(":="))
      return blackboard_[target] = expression();
    at_ = begin;
    const int condition = comparison();
    if (!take("?")) return condition;
    const int yes = expression();
    REQUIRE(take(":"));
    const int no = expression();
    return condition != 0 ? yes : no;
  }
  int comparison() {
    const int left = sum();
    return take("<") ? left < sum() : left;
  }
  int sum() {
    int result = operand();
    while (take("+")) result += operand();
    return result;
  }
  int operand() {
    if (take("(")) {
      const int inside = expression();
      REQUIRE(take(")"));
      return inside;
    }
    const std::string word = name();
    for (int status = 0; status < 5; ++status) {
      if (word == kLogStatusNames[static_cast<std::size_t>(status)]) {
        return status;
      }
    }
    if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) {
      return std::stoi(word);
    }
    REQUIRE(word[0] == '@');
    REQUIRE(blackboard_.contains(word));  // else the script throws
    return blackboard_[word];
  }
  std::string name() {
    take("");
    std::string word;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 ||
            text_[at_] == '_' || text_[at_] == '@')) {
      word += text_[at_++];
    }
    return word;
  }

  std::string text_;
  std::map<std::string, int>& blackboard_;
  std::size_t at_ = 0;
};

// StatefulActionNode and TestNode of BehaviorTree.CPP 4.10; ticks are so far
// apart that every delay has passed by the next one.
class TestNode {
 public:
  TestNode(json config, std::map<std::string, int>& blackboard)
      : config_(std::move(config)), blackboard_(blackboard) {}

  LogStatus tick() {
    if (status_ != LogStatus::Running) {
      is_delayed_ = config_.value("async_delay", 0) > 0;
      status_ = is_delayed_ ? LogStatus::Running : completed();
    } else if (is_delayed_) {
      status_ = completed();
    }
    return status_;
  }
  void halt() { status_ = LogStatus::Idle; }

 private:
  LogStatus completed() {
    LogStatus status = LogStatus::Idle;
    if (config_.contains("return_status_script")) {
      status = static_cast<LogStatus>(
          Script(config_["return_status_script"], blackboard_).value());
    } else {
      for (std::size_t i = 0; i < kLogStatusNames.size(); ++i) {
        if (config_["return_status"] == kLogStatusNames[i]) {
          status = static_cast<LogStatus>(i);
        }
      }
    }
    REQUIRE(status != LogStatus::Idle);
    if (config_.contains("post_script")) {
      Script(config_["post_script"], blackboard_).value();
    }
    return status;
  }

  json config_;
  std::map<std::string, int>& blackboard_;
  LogStatus status_ = LogStatus::Idle;
  bool is_delayed_ = false;
};

// Goes along the run and ticks a test node whenever its leaf answers. How many
// answers were compared; `is_exact` false: only completions are.
std::size_t check_answers(const RecordedRun& run, int passes,
                          const json& document, const std::string& name,
                          bool is_exact) {
  std::map<std::string, int> blackboard;
  for (const auto& [entry, value] : document["Blackboard"].items()) {
    blackboard["@" + entry] = value;
  }
  const json& rule = document["SubstitutionRules"][name];
  std::map<std::size_t, TestNode> nodes;
  std::vector<Phase> last(run.nodes.size(), Phase::Unvisited);
  std::size_t compared = 0;
  for (const Passing& passing : unrolled(run, passes)) {
    for (std::size_t n = 0; n < run.nodes.size(); ++n) {
      const Phase now = run.states[passing.state].phases[n];
      const Phase before = std::exchange(last[n], now);
      if (run.nodes[n].name != name || now == before) continue;
      TestNode& node =
          nodes.try_emplace(n, document["TestNodeConfigs"][rule], blackboard)
              .first->second;
      const bool runs = now == Phase::Running;
      if (is_completed(now) || (runs && is_exact)) {
        const auto wanted = runs                    ? LogStatus::Running
                            : now == Phase::Success ? LogStatus::Success
                                                    : LogStatus::Failure;
        CAPTURE(name);
        CAPTURE(passing.state);
        REQUIRE(node.tick() == wanted);
        ++compared;
      } else if (!is_active(now) && !runs) {
        node.halt();
      }
    }
  }
  return compared;
}

bool is_named(const json& note, const std::string& name) {
  return note.get<std::string>().find("`" + name + "`") != std::string::npos;
}

// The note says that not all of the leaf's answers are given.
bool is_reservation(const json& note, const std::string& name) {
  return is_named(note, name) &&
         note.get<std::string>().find("never running") != std::string::npos;
}

std::size_t check_run(const RecordedRun& run, int passes) {
  const json document = json::parse(substitution_text(run));
  std::size_t compared = 0;
  for (const auto& [name, config] : document["SubstitutionRules"].items()) {
    bool is_exact = true;
    for (const json& note : document["Notes"]) {
      if (is_reservation(note, name)) is_exact = false;
    }
    compared += check_answers(run, passes, document, name, is_exact);
  }
  return compared;
}

TEST_CASE("test nodes answer what the leaves of random executions answered") {
  std::mt19937 random(12);
  std::size_t compared = 0;
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    compared += check_run(random_execution(random).run(), 1);
  }
  CHECK(compared > 1500);
}

TEST_CASE("and so they do for ever where the run loops") {
  std::mt19937 random(13);
  std::size_t compared = 0;
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    RecordedRun run = random_execution(random).run();
    // From a state to itself: the answers of the loop are of any kind.
    run.loop = random() % run.states.size();
    compared += check_run(run, 5);
  }
  CHECK(compared > 5000);
}

TEST_CASE("and what they answered in the runs of the examples") {
  std::size_t compared = 0;
  for (const RecordedRun& run : example_runs()) {
    CAPTURE(run.tree);
    CAPTURE(run.property);
    compared += check_run(run, 3);
  }
  CHECK(compared > 300);
}

// One leaf with these answers, one in each tick; H halts it.
json rules_for(const std::string& answers, std::size_t loop = kNoState) {
  RecordedRun run;
  for (const char* name : {"main", "go"}) {
    RecordedNode node;
    node.name = name;
    node.type = run.nodes.empty() ? "BehaviorTree" : "Action";
    if (!run.nodes.empty()) node.parent = 0;
    run.nodes.push_back(node);
  }
  for (const char answer : answers) {
    for (const Phase phase : {Phase::Here, answer == 'R'   ? Phase::Running
                                           : answer == 'S' ? Phase::Success
                                           : answer == 'F' ? Phase::Failure
                                                           : Phase::Halted}) {
      RecordedState state;
      state.phases = {Phase::Waiting, phase};
      state.is_stale = {false, false};
      run.states.push_back(state);
    }
  }
  if (loop != kNoState) run.loop = 2 * loop;
  check_run(run, loop == kNoState ? 1 : 6);
  return json::parse(substitution_text(run));
}

TEST_CASE("a leaf that always answers the same needs no script") {
  CHECK(rules_for("SSS") == json::parse(R"({
    "TestNodeConfigs": {"go": {"return_status": "SUCCESS"}},
    "SubstitutionRules": {"go": "go"}, "Blackboard": {}, "Notes": []})"));
  CHECK(rules_for("F", 0)["TestNodeConfigs"]["go"]["return_status"] ==
        "FAILURE");
  CHECK(rules_for("RRR")["TestNodeConfigs"]["go"] ==
        json::parse(R"({"async_delay": 1, "return_status": "RUNNING"})"));
  CHECK(rules_for("RSRS")["TestNodeConfigs"]["go"] ==
        json::parse(R"({"async_delay": 1, "return_status": "SUCCESS"})"));
}

TEST_CASE("a leaf that answers this and that counts") {
  const json rules = rules_for("SSFSF");
  const json& config = rules["TestNodeConfigs"]["go"];
  CHECK(config.size() == 3);
  CHECK(config["return_status"] == "SUCCESS");
  CHECK(config["return_status_script"] ==
        "(@btcheck_go < 3 ? (@btcheck_go < 2 ? SUCCESS : FAILURE) : "
        "(@btcheck_go < 4 ? SUCCESS : FAILURE))");
  CHECK(config["post_script"] ==
        "@btcheck_go := (@btcheck_go + 1 < 5 ? @btcheck_go + 1 : 4)");
  CHECK(rules["Blackboard"] == json{{"btcheck_go", 0}});
  REQUIRE(rules["Notes"].size() == 1);
  CHECK(rules["Notes"][0].get<std::string>().find("4.10") != std::string::npos);
}

TEST_CASE("in a loop the counter goes back to where the loop began") {
  const json rules = rules_for("SFS", 1);
  CHECK(rules["TestNodeConfigs"]["go"]["post_script"] ==
        "@btcheck_go := (@btcheck_go + 1 < 3 ? @btcheck_go + 1 : 1)");
}

TEST_CASE("what a test node cannot do is said") {
  // It ran before it failed, and succeeded at once.
  const json rules = rules_for("RFS");
  CHECK(rules["TestNodeConfigs"]["go"]["return_status"] == "FAILURE");
  CHECK(!rules["TestNodeConfigs"]["go"].contains("async_delay"));
  CHECK(is_named(rules["Notes"][0], "go"));
  // It ran until it was halted, and succeeded at once: that it can.
  const json halted = rules_for("RRHS");
  CHECK(halted["Notes"].size() == 1);
  CHECK(halted["TestNodeConfigs"]["go"]["return_status_script"] ==
        "(@btcheck_go < 1 ? RUNNING : SUCCESS)");
}

TEST_CASE("leaves of one name share a rule, an inner node's name has none") {
  BtcppEngine engine;
  const auto sequence = engine.add("Sequence", "fail", 0);
  engine.add("Action", "go there", sequence);
  engine.add("Action", "go there", sequence);
  engine.add("Action", "go_there", sequence);
  engine.add("Action", "fail", sequence);
  engine.add("Action", "Sequence", sequence);
  engine.add("Action", "never", sequence);
  engine.tick([](std::uint32_t leaf) {
    return leaf == 7   ? LogStatus::Running
           : leaf == 4 ? LogStatus::Success
                       : static_cast<LogStatus>(2);
  });
  RecordedRun run = engine.run();
  const json rules = json::parse(substitution_text(run));
  CHECK(rules["SubstitutionRules"] ==
        json::parse(R"({"go there": "go there", "go_there": "go_there",
                        "never": "never"})"));
  CHECK(rules["Notes"].size() == 3);
  CHECK(is_named(rules["Notes"][0], "go there"));
  CHECK(is_named(rules["Notes"][1], "fail"));
  CHECK(is_named(rules["Notes"][2], "Sequence"));
}

TEST_CASE("leaves that the run never ticks keep their own nodes") {
  const BtcppEngine engine = [] {
    BtcppEngine made;
    const auto sequence = made.add("Sequence", "s", 0);
    made.add("Action", "a", sequence);
    made.add("Action", "b", sequence);
    made.tick([](std::uint32_t) { return LogStatus::Failure; });
    return made;
  }();
  BtcppEngine copy = engine;
  const json rules = json::parse(substitution_text(copy.run()));
  CHECK(rules["SubstitutionRules"] == json{{"a", "a"}});
}

TEST_CASE("counters of different leaves differ") {
  BtcppEngine engine;
  const auto sequence = engine.add("Sequence", "s", 0);
  engine.add("Action", "a b", sequence);
  engine.add("Action", "a_b", sequence);
  const BtcppEngine::World fails = [](std::uint32_t leaf) {
    return leaf == 2 ? LogStatus::Success : LogStatus::Failure;
  };
  const BtcppEngine::World succeeds = [](std::uint32_t) {
    return LogStatus::Success;
  };
  const BtcppEngine::World all_fail = [](std::uint32_t) {
    return LogStatus::Failure;
  };
  for (const auto* world : {&fails, &succeeds, &all_fail}) engine.tick(*world);
  const json rules = json::parse(substitution_text(engine.run()));
  CHECK(rules["Blackboard"] == json{{"btcheck_a_b", 0}, {"btcheck_a_b_", 0}});
  check_run(engine.run(), 1);
}

}  // namespace
}  // namespace btcheck::substitution_test

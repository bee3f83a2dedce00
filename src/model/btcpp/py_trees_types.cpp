// SPDX-License-Identifier: MIT
//
// The node types of py_trees 2.2.3, one row each, as the exporter
// (contrib/py_trees) writes them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "model/btcpp/known_types.hpp"
#include "text/numbers.hpp"

// What known_types.cpp has for the engine's types has the same name here.
namespace btcheck::btcpp::py_trees {
namespace {

using enum NodeStatus;
using enum PortType;
using enum Need;
constexpr auto kIn = BtcppDirection::Input;

constexpr int kMostRounds = 1 << 20;

std::optional<NodeStatus> status_named(std::string_view word) {
  if (word == "SUCCESS") return Success;
  if (word == "FAILURE") return Failure;
  if (word == "RUNNING") return Running;
  return std::nullopt;
}

// "a;b;c"
std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(';'), text.size());
    parts.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

class Ports {
 public:
  Ports(PortReader& ports, Node& made)
      : ports_(ports), written_(ports.element()), made_(made) {}

  // Without memory it is the reactive one.
  void set_memory(NodeType reactive) {
    if (text("memory") != "true") made_.type = reactive;
    expect("memory", {"true", "false"});
  }

  // It compares only behind a success, with a count from 1 on.
  void set_rounds() {
    made_.repetitions = rounds("num_success");
    if (made_.repetitions < 1) made_.repetitions = kEndlessRounds;
  }

  void set_attempts() {
    made_.repetitions = std::max(1, rounds("num_failures"));
  }

  void set_one_shot() {
    made_.option = text("policy") == "ON_COMPLETION";
    expect("policy", {"ON_COMPLETION", "ON_SUCCESSFUL_COMPLETION"});
  }

  void set_seconds() { made_.duration = ports_.ticks("duration", 1000); }

  void set_policy() {
    const std::string_view policy = text("policy");
    expect("policy", {"SuccessOnAll", "SuccessOnOne", "SuccessOnSelected"});
    made_.option = policy == "SuccessOnOne";
    // As the constructors of the policies have it.
    made_.is_synchronised =
        has("synchronise") ? text("synchronise") == "true" : !made_.option;
    if (has("synchronise")) expect("synchronise", {"true", "false"});
    if (policy == "SuccessOnSelected") {
      set_selected();
    } else if (has("selected")) {
      refuse("selected", "nothing, with this policy,");
    } else if (!made_.option) {
      for (std::size_t i = 0; i < made_.children.size(); ++i) {
        made_.selected.push_back(i);
      }
    }
    if (made_.option && made_.is_synchronised) {
      refuse("synchronise", "`false`, with this policy,");
    }
  }

  void check_guard() {
    const BtcppNode* asked = ports_.first_child();
    if (asked == nullptr || asked->kind == BtcppKind::Condition) return;
    ports_.refuse(
        asked->place,
        {"BT1660", fmt::format("`{}` is no condition", asked->id),
         "the first child of an EternalGuard stands for its condition",
         "write `<Condition ID=\"…\"/>`"});
  }

  void set_awaited() {
    const auto answer = [&](std::string_view word) {
      return text("status") == word ? Success : Running;
    };
    made_.becomes = {answer("SUCCESS"), answer("FAILURE"), answer("RUNNING")};
    expect("status", {"SUCCESS", "FAILURE", "RUNNING", "INVALID"});
  }

  void set_tick_counter() {
    const int duration = whole("duration", 0);
    if (duration > 0) made_.queue.push_back({Running, duration});
    made_.queue.push_back({status("completion_status"), 1});
    made_.option = true;
  }

  void set_every_n() {
    const int n = whole("n", 1);
    if (n > 1) made_.queue.push_back({Failure, n - 1});
    made_.queue.push_back({Success, 1});
  }

  // It counts from 0 at first, and from the tick of the change later on.
  void set_periodic() {
    const int n = whole("n", 1);
    made_.queue = {
        {Running, n}, {Success, n + 1}, {Failure, n + 1}, {Running, n + 1}};
    made_.queue_goes_on = 1;
  }

  void set_status_queue() {
    for (const std::string_view word : parts_of(text("queue"))) {
      const auto found = status_named(word);
      if (!found) refuse("queue", "a list like `RUNNING;SUCCESS`");
      made_.queue.push_back({found.value_or(Success), 1});
    }
    if (has("eventually")) {
      made_.queue_goes_on = made_.queue.size();
      made_.queue.push_back({status("eventually"), 1});
    } else if (made_.queue.empty()) {
      refuse("queue", "a list like `RUNNING;SUCCESS`");
      made_.queue = {{Success, 1}};
    }
  }

  void set_overwrite() {
    if (!has("overwrite")) return;
    expect("overwrite", {"true", "false"});
    made_.contract.may_fail = text("overwrite") == "false";
  }

  void set_weights() {
    if (!has("weights")) return;
    const auto weights = parts_of(text("weights"));
    std::vector<double> likely;
    for (const std::string_view weight : weights) {
      likely.push_back(as_number<double>(weight).value_or(-1));
    }
    const bool is_weight =
        std::ranges::all_of(likely, [](double weight) { return weight >= 0; });
    if (likely.size() != 3 || !is_weight ||
        std::ranges::none_of(likely, [](double each) { return each > 0; })) {
      return refuse("weights", "three numbers like `0.5;0.5;0`");
    }
    made_.contract.may_succeed = likely[0] > 0;
    made_.contract.may_fail = likely[1] > 0;
    made_.contract.may_run = likely[2] > 0;
  }

 private:
  std::string_view text(std::string_view name) const {
    const auto* attribute = find_attribute(written_.ports, name);
    return attribute == nullptr ? std::string_view() : attribute->value;
  }
  bool has(std::string_view name) const {
    return find_attribute(written_.ports, name) != nullptr;
  }

  // What is missing altogether is told elsewhere.
  void refuse(std::string_view name, std::string expected) {
    const auto* attribute = find_attribute(written_.ports, name);
    if (attribute == nullptr) return;
    ports_.refuse(attribute->place, {"BT1610",
                                     fmt::format("`{}` is not a value of `{}`",
                                                 attribute->value, name),
                                     fmt::format("{} is expected", expected),
                                     "write it as docs/pytrees.md has it"});
  }

  void expect(std::string_view name,
              const std::vector<std::string_view>& words) {
    if (std::ranges::find(words, text(name)) != words.end()) return;
    refuse(name, fmt::format("{}", fmt::join(words, " or ")));
  }

  int whole(std::string_view name, int least) {
    const auto number = as_number<int>(text(name));
    if (number && *number >= least) return std::min(*number, kMostRounds);
    refuse(name, least > 0 ? fmt::format("a whole number from {} on", least)
                           : "a whole number");
    return std::max(1, least);
  }
  int rounds(std::string_view name) { return whole(name, -kMostRounds); }

  NodeStatus status(std::string_view name) {
    const auto found = status_named(text(name));
    if (!found) refuse(name, "SUCCESS, FAILURE or RUNNING");
    return found.value_or(Success);
  }

  void set_selected() {
    if (!has("selected")) {
      return ports_.refuse(
          written_.place,
          {"BT1617", fmt::format("`{}` has no `selected`", written_.id),
           "this policy needs it",
           "write the numbers of the children that have to succeed: "
           "`selected=\"1;3\"`"});
    }
    for (const std::string_view part : parts_of(text("selected"))) {
      const auto number = as_number<std::size_t>(part);
      if (!number || *number == 0 || *number > made_.children.size()) break;
      made_.selected.push_back(*number - 1);
    }
    if (made_.selected.empty() ||
        made_.selected.size() != parts_of(text("selected")).size()) {
      refuse("selected", fmt::format("numbers of children, from 1 to {},",
                                     made_.children.size()));
    }
  }

  PortReader& ports_;
  const BtcppNode& written_;
  Node& made_;
};

template <void (Ports::*read)()>
void read_by(PortReader& ports, Node& node) {
  (Ports(ports, node).*read)();
}
template <NodeType reactive>
void read_memory(PortReader& ports, Node& node) {
  Ports(ports, node).set_memory(reactive);
}
template <NodeStatus of_success, NodeStatus of_failure, NodeStatus of_running>
void read_map(PortReader&, Node& node) {
  node.becomes = {of_success, of_failure, of_running};
}

// The arguments of the constructors.
constexpr std::array kMemory = {PortRow{"memory", kIn, Bool, Mandatory}};
constexpr std::array kPolicy = {PortRow{"policy", kIn, String, Mandatory},
                                PortRow{"synchronise", kIn, Bool},
                                PortRow{"selected", kIn, String}};
constexpr std::array kNumSuccess = {
    PortRow{"num_success", kIn, Int, Mandatory}};
constexpr std::array kNumFailures = {
    PortRow{"num_failures", kIn, Int, Mandatory}};
constexpr std::array kSeconds = {PortRow{"duration", kIn, Double, Mandatory}};
constexpr std::array kOneShot = {PortRow{"policy", kIn, String, Mandatory}};
constexpr std::array kAwaited = {PortRow{"status", kIn, String, Mandatory}};
constexpr std::array kVariable = {PortRow{"variable_name", kIn, String}};
constexpr std::array kCheckOf = {PortRow{"check", kIn, String}};
constexpr std::array kSetVariable = {PortRow{"variable_name", kIn, String},
                                     PortRow{"overwrite", kIn, Bool}};
constexpr std::array kWeights = {PortRow{"weights", kIn, String}};
constexpr std::array kTickCounter = {
    PortRow{"duration", kIn, Int, Mandatory},
    PortRow{"completion_status", kIn, String, Mandatory}};
constexpr std::array kQueue = {PortRow{"queue", kIn, String, Mandatory},
                               PortRow{"eventually", kIn, String}};
constexpr std::array kPeriod = {PortRow{"n", kIn, Int, Mandatory}};

constexpr LeafAnswers kSucceeds = {true, false};
constexpr LeafAnswers kFails = {false, true};
constexpr LeafAnswers kRuns = {false, false, true};
constexpr LeafAnswers kAwaits = {true, false, true};
constexpr LeafAnswers kAnything = {true, true, true};
// Answers at once, either way.
constexpr LeafAnswers kAnswers = {};

constexpr NodeTypeRow inner(std::string_view id, NodeType type,
                            std::span<const PortRow> ports = {},
                            ReadPorts read = nullptr) {
  const bool is_one = info_of(type).max_children == 1;
  const auto kind = is_one ? BtcppKind::Decorator : BtcppKind::Control;
  return {id, kind, type, ports, 0, {}, read};
}
constexpr NodeTypeRow action(std::string_view id, LeafAnswers answers,
                             std::span<const PortRow> ports = {},
                             ReadPorts read = nullptr,
                             NodeType type = NodeType::Action) {
  return {id, BtcppKind::Action, type, ports, 0, answers, read};
}

constexpr std::array kRows = {
    NodeTypeRow{"SubTree", BtcppKind::SubTree, NodeType::SubTree},
    inner("Sequence", NodeType::Sequence, kMemory,
          read_memory<NodeType::ReactiveSequence>),
    inner("Selector", NodeType::Fallback, kMemory,
          read_memory<NodeType::ReactiveFallback>),
    inner("Parallel", NodeType::PolicyParallel, kPolicy,
          read_by<&Ports::set_policy>),
    inner("EternalGuard", NodeType::EternalGuard, {},
          read_by<&Ports::check_guard>),
    inner("Inverter", NodeType::Inverter),
    inner("FailureIsSuccess", NodeType::ForceSuccess),
    inner("SuccessIsFailure", NodeType::ForceFailure),
    inner("SuccessIsRunning", NodeType::KeepRunningUntilFailure),
    inner("FailureIsRunning", NodeType::AnswerMap, {},
          read_map<Success, Running, Running>),
    inner("RunningIsFailure", NodeType::AnswerMap, {},
          read_map<Success, Failure, Failure>),
    inner("RunningIsSuccess", NodeType::AnswerMap, {},
          read_map<Success, Failure, Success>),
    inner("Condition", NodeType::AnswerMap, kAwaited,
          read_by<&Ports::set_awaited>),
    inner("PassThrough", NodeType::AnswerMap),
    inner("Count", NodeType::AnswerMap),
    inner("StatusToBlackboard", NodeType::AnswerMap, kVariable),
    inner("Repeat", NodeType::Repeat, kNumSuccess, read_by<&Ports::set_rounds>),
    inner("Retry", NodeType::RetryUntilSuccessful, kNumFailures,
          read_by<&Ports::set_attempts>),
    inner("Timeout", NodeType::Timeout, kSeconds, read_by<&Ports::set_seconds>),
    inner("OneShot", NodeType::RunOnce, kOneShot,
          read_by<&Ports::set_one_shot>),
    action("Success", kSucceeds), action("Failure", kFails),
    action("Running", kRuns), action("Dummy", kRuns),
    action("TickCounter", {}, kTickCounter, read_by<&Ports::set_tick_counter>,
           NodeType::AnswerQueue),
    action("StatusQueue", {}, kQueue, read_by<&Ports::set_status_queue>,
           NodeType::AnswerQueue),
    action("Periodic", {}, kPeriod, read_by<&Ports::set_periodic>,
           NodeType::AnswerQueue),
    action("SuccessEveryN", {}, kPeriod, read_by<&Ports::set_every_n>,
           NodeType::AnswerQueue),
    action("Timer", kAwaits, kSeconds, read_by<&Ports::set_seconds>,
           NodeType::Wait),
    action("ProbabilisticBehaviour", kAnything, kWeights,
           read_by<&Ports::set_weights>),
    // What is on the blackboard is left open.
    action("CheckBlackboardVariableExists", kAnswers, kVariable),
    action("CheckBlackboardVariableValue", kAnswers, kCheckOf),
    action("CheckBlackboardVariableValues", kAnswers, kCheckOf),
    action("WaitForBlackboardVariable", kAwaits, kVariable),
    action("WaitForBlackboardVariableValue", kAwaits, kCheckOf),
    action("SetBlackboardVariable", kAnswers, kSetVariable,
           read_by<&Ports::set_overwrite>),
    action("UnsetBlackboardVariable", kSucceeds, kVariable),
    action("BlackboardToStatus", kAnything, kVariable)};

// A Sequence or Selector is reactive by its port.
static_assert(are_all_types(In::PyTrees, {kRows},
                            {NodeType::BehaviorTree, NodeType::Condition,
                             NodeType::ReactiveSequence,
                             NodeType::ReactiveFallback}));
static_assert(is_unique(kRows, &NodeTypeRow::id));

}  // namespace
}  // namespace btcheck::btcpp::py_trees

namespace btcheck::btcpp {

std::span<const NodeTypeRow> py_trees_types() { return py_trees::kRows; }

}  // namespace btcheck::btcpp

// SPDX-License-Identifier: MIT
#include "model/btcpp/tree/py_trees_ports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "model/tree/node_types.hpp"
#include "text/numbers.hpp"

namespace btcheck::btcpp {
namespace {

constexpr int kMostRounds = 1 << 20;

std::optional<NodeStatus> status_named(std::string_view word) {
  if (word == "SUCCESS") return NodeStatus::Success;
  if (word == "FAILURE") return NodeStatus::Failure;
  if (word == "RUNNING") return NodeStatus::Running;
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

// What a decorator answers by its type alone; nothing for Condition.
std::optional<AnswerTable> table_named(std::string_view id) {
  using enum NodeStatus;
  if (id == "FailureIsRunning") return AnswerTable{Success, Running, Running};
  if (id == "RunningIsFailure") return AnswerTable{Success, Failure, Failure};
  if (id == "RunningIsSuccess") return AnswerTable{Success, Failure, Success};
  if (id == "Condition") return std::nullopt;
  return AnswerTable{};  // PassThrough, Count, StatusToBlackboard
}

class PyTreesPorts {
 public:
  PyTreesPorts(const BtcppNode& written,
               const std::vector<const BtcppNode*>& children, Node& made,
               FileFindings& findings)
      : written_(written),
        children_(children),
        made_(made),
        findings_(findings) {}

  void set() {
    switch (made_.type) {
      case NodeType::Sequence:
        if (text("memory") != "true") made_.type = NodeType::ReactiveSequence;
        return expect("memory", {"true", "false"});
      case NodeType::Fallback:
        if (text("memory") != "true") made_.type = NodeType::ReactiveFallback;
        return expect("memory", {"true", "false"});
      case NodeType::PolicyParallel:
        return set_policy();
      case NodeType::EternalGuard:
        return check_guard();
      case NodeType::AnswerMap:
        return set_table();
      case NodeType::Repeat:
        made_.repetitions = rounds("num_success");
        // It compares only behind a success, with a count from 1 on.
        if (made_.repetitions < 1) made_.repetitions = kEndlessRounds;
        return;
      case NodeType::RetryUntilSuccessful:
        made_.repetitions = std::max(1, rounds("num_failures"));
        return;
      case NodeType::RunOnce:
        made_.option = text("policy") == "ON_COMPLETION";
        return expect("policy", {"ON_COMPLETION", "ON_SUCCESSFUL_COMPLETION"});
      case NodeType::AnswerQueue:
        return set_queue();
      case NodeType::Action:
        return set_answers();
      default:
        return;
    }
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
    findings_.error(
        attribute->place,
        {"BT1610",
         fmt::format("`{}` is not a value of `{}`", attribute->value, name),
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
    return found.value_or(NodeStatus::Success);
  }

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

  void set_selected() {
    if (!has("selected")) {
      return findings_.error(
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

  void check_guard() {
    if (children_.empty()) return;
    const BtcppNode& asked = *children_.front();
    if (asked.kind == BtcppKind::Condition) return;
    findings_.error(
        asked.place,
        {"BT1660", fmt::format("`{}` is no condition", asked.id),
         "the first child of an EternalGuard stands for its condition",
         "write `<Condition ID=\"…\"/>`"});
  }

  void set_table() {
    if (const auto table = table_named(written_.id)) {
      made_.becomes = *table;
      return;
    }
    using enum NodeStatus;
    const auto answer = [&](std::string_view word) {
      return text("status") == word ? Success : Running;
    };
    made_.becomes = {answer("SUCCESS"), answer("FAILURE"), answer("RUNNING")};
    expect("status", {"SUCCESS", "FAILURE", "RUNNING", "INVALID"});
  }

  void set_queue() {
    using enum NodeStatus;
    if (written_.id == "TickCounter") {
      const int duration = whole("duration", 0);
      if (duration > 0) made_.queue.push_back({Running, duration});
      made_.queue.push_back({status("completion_status"), 1});
      made_.option = true;
    } else if (written_.id == "SuccessEveryN") {
      const int n = whole("n", 1);
      if (n > 1) made_.queue.push_back({Failure, n - 1});
      made_.queue.push_back({Success, 1});
    } else if (written_.id == "Periodic") {
      // It counts from 0 at first, and from the tick of the change later on.
      const int n = whole("n", 1);
      made_.queue = {
          {Running, n}, {Success, n + 1}, {Failure, n + 1}, {Running, n + 1}};
      made_.queue_goes_on = 1;
    } else {
      set_status_queue();
    }
  }

  void set_status_queue() {
    for (const std::string_view word : parts_of(text("queue"))) {
      const auto found = status_named(word);
      if (!found) refuse("queue", "a list like `RUNNING;SUCCESS`");
      made_.queue.push_back({found.value_or(NodeStatus::Success), 1});
    }
    if (has("eventually")) {
      made_.queue_goes_on = made_.queue.size();
      made_.queue.push_back({status("eventually"), 1});
    } else if (made_.queue.empty()) {
      refuse("queue", "a list like `RUNNING;SUCCESS`");
      made_.queue = {{NodeStatus::Success, 1}};
    }
  }

  // Those of py_trees that the attributes keep from some answers.
  void set_answers() {
    LeafContract& contract = made_.contract;
    if (written_.id == "SetBlackboardVariable" && has("overwrite")) {
      expect("overwrite", {"true", "false"});
      contract.may_fail = text("overwrite") == "false";
    }
    if (written_.id != "ProbabilisticBehaviour" || !has("weights")) return;
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
    contract.may_succeed = likely[0] > 0;
    contract.may_fail = likely[1] > 0;
    contract.may_run = likely[2] > 0;
  }

  const BtcppNode& written_;
  const std::vector<const BtcppNode*>& children_;
  Node& made_;
  FileFindings& findings_;
};

}  // namespace

void set_py_trees_ports(const BtcppNode& written,
                        const std::vector<const BtcppNode*>& children,
                        Node& made, FileFindings& findings) {
  PyTreesPorts(written, children, made, findings).set();
}

}  // namespace btcheck::btcpp

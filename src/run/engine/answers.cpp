// SPDX-License-Identifier: MIT
//
// What becomes of a reply. An answer that the model allows is taken. One that
// the model allows only when the time of the action is up lets it be up, if it
// may be. Everything else is a breach, and the policy finds a step that the
// model does allow; where there is none, or only one that would claim a
// success, the run ends. So whatever a leaf does, the run stays one of the
// model.
#include <algorithm>
#include <utility>
#include <vector>

#include "check/simulate/script.hpp"
#include "model/tree/node_types.hpp"
#include "run/engine/tree_engine.hpp"

namespace btcheck {
namespace {

constexpr int kSucceeds = static_cast<int>(NodeStatus::Success);
constexpr int kFails = static_cast<int>(NodeStatus::Failure);
constexpr int kRuns = static_cast<int>(NodeStatus::Running);

// A leaf that has said this has come to its end.
bool has_ended(const Reply& reply) {
  switch (reply.kind) {
    case Reply::Kind::Answer:
      return reply.value != kRuns;
    case Reply::Kind::Silence:
      return false;
    case Reply::Kind::Breach:
      return reply.breach == BreachKind::Threw ||
             reply.breach == BreachKind::Gone;
  }
  return false;
}

}  // namespace

std::string_view breach_name(BreachKind kind) {
  static constexpr std::array<std::string_view, kBreachKinds> kNames = {
      "forbidden answer", "wrong answer", "too early", "too late",
      "answered twice",   "no answer",    "exception", "process gone",
      "nonsense",         "not halted"};
  return kNames[static_cast<std::size_t>(kind)];
}

// --- Asking --------------------------------------------------------------

void TreeEngine::decide(NodeId leaf) {
  possible_.clear();
  for (const std::uint32_t place : enabled_) {
    possible_.push_back({place, table_.edge(place).result});
  }
  put_unchanged_first(leaf);
  const auto is_fault = [](const PossibleAnswer& answer) {
    return answer.result == kFaultResult;
  };
  if (std::ranges::all_of(possible_, is_fault)) {
    return fire(possible_[0].edge);
  }
  Reply reply = reply_of(leaf);
  Flight& flight = flights_[index(leaf)];
  if (has_ended(reply)) flight.runs = false;
  switch (reply.kind) {
    case Reply::Kind::Silence:
      return take(leaf, possible_[0]);
    case Reply::Kind::Answer:
      return settle_answer(leaf, reply.value);
    case Reply::Kind::Breach:
      return settle_breach(leaf, reply.breach, std::move(reply.text));
  }
}

// A SetSV that finds nothing new is what goes without saying.
void TreeEngine::put_unchanged_first(NodeId leaf) {
  const Node& node = tree_.node(leaf);
  if (node.type != NodeType::SetSV) return;
  const std::int64_t present = system_.value(
      now(), system_.network().state_variable[index(node.variable)]);
  const auto same =
      std::ranges::find(possible_, present, &PossibleAnswer::result);
  if (same != possible_.end()) {
    std::rotate(possible_.begin(), same, same + 1);
  }
}

Reply TreeEngine::reply_of(NodeId leaf) {
  Flight& flight = flights_[index(leaf)];
  LeafQuestion question{leaf,      flight.runs ? Asked::Again : Asked::Anew,
                        ticks_,    table_.leaf(leaf).given,
                        possible_, timer_of(leaf).has_value(),
                        now()};
  if (!table_.meets_requirement(leaf, now())) {
    if (std::exchange(flight.runs, false)) leaves_.halt(leaf);
    return leaves_.refused(question);
  }
  if (flight.answered) {
    const bool is_allowed =
        possible(*flight.answered) != nullptr || question.may_be_due;
    return is_allowed ? Reply::answer(*flight.answered) : Reply::answer(kRuns);
  }
  flight.runs = tree_.node(leaf).type == NodeType::Action;
  return leaves_.ask(question);
}

// --- Taking --------------------------------------------------------------

void TreeEngine::take(NodeId leaf, const PossibleAnswer& answer) {
  if (answer.result != kRuns) flights_[index(leaf)] = {};
  fire(answer.edge);
}

const PossibleAnswer* TreeEngine::possible(int result) const {
  const auto found =
      std::ranges::find(possible_, result, &PossibleAnswer::result);
  return found == possible_.end() ? nullptr : &*found;
}

// The edge by which the time of an action is up, if it may be now.
std::optional<std::uint32_t> TreeEngine::timer_of(NodeId leaf) {
  const auto timer = table_.leaf(leaf).timer;
  if (!timer) return std::nullopt;
  collect(*timer, candidate_);
  if (candidate_.empty()) return std::nullopt;
  return candidate_[0];
}

// What its contract has, whenever that is.
bool TreeEngine::may_answer(NodeId leaf, int answer) const {
  const LeafContract& contract = tree_.node(leaf).contract;
  return (answer == kSucceeds && contract.may_succeed) ||
         (answer == kFails && contract.may_fail);
}

void TreeEngine::settle_answer(NodeId leaf, int answer) {
  if (const auto* allowed = possible(answer)) return take(leaf, *allowed);
  const bool is_measured = tree_.node(leaf).type == NodeType::SetSV;
  if (!is_measured && may_answer(leaf, answer) &&
      table_.meets_requirement(leaf, now())) {
    if (const auto timer = timer_of(leaf)) {
      flights_[index(leaf)].answered = answer;
      return fire(*timer);
    }
    if (const auto* fault = possible(kFaultResult)) return take(leaf, *fault);
    if (table_.leaf(leaf).timer && possible(kRuns) != nullptr) {
      return settle_breach(leaf, BreachKind::TooEarly, refusal(leaf, answer),
                           answer);
    }
  }
  settle_breach(leaf, kind_of_refusal(leaf, answer), refusal(leaf, answer));
}

BreachKind TreeEngine::kind_of_refusal(NodeId leaf, int answer) const {
  const Node& node = tree_.node(leaf);
  if (node.type == NodeType::SetSV || answer != kRuns) {
    return BreachKind::Forbidden;
  }
  if (node.type == NodeType::Condition) return BreachKind::WrongAnswer;
  return node.duration ? BreachKind::TooLate : BreachKind::Forbidden;
}

// --- Breaches ------------------------------------------------------------

void TreeEngine::settle_breach(NodeId leaf, BreachKind kind, std::string text,
                               std::optional<int> early) {
  report({kind, leaf, ticks_, std::move(text)});
  switch (policy_) {
    case OnBreach::Stop:
      end_ = EngineState::Breached;
      return;
    case OnBreach::Fail:
      return fail(leaf);
    case OnBreach::GoOn:
      return go_on(leaf, early);
  }
}

// The leaf fails: now, or when the model lets it.
void TreeEngine::fail(NodeId leaf) {
  // Its results are values, and no failure is among them.
  if (tree_.node(leaf).type == NodeType::SetSV) return give_up(leaf, "fail");
  Flight& flight = flights_[index(leaf)];
  if (std::exchange(flight.runs, false)) leaves_.halt(leaf);
  if (const auto* failure = possible(kFails)) return take(leaf, *failure);
  const bool is_action = tree_.node(leaf).type == NodeType::Action;
  if (is_action && may_answer(leaf, kFails)) {
    flight.answered = kFails;
    if (const auto timer = timer_of(leaf)) return fire(*timer);
    if (const auto* runs = possible(kRuns)) return take(leaf, *runs);
  }
  give_up(leaf, "fail");
}

// The leaf runs on, an answer that came too early waiting until it may be
// given; a measurement finds nothing new. A success is never made up.
void TreeEngine::go_on(NodeId leaf, std::optional<int> early) {
  Flight& flight = flights_[index(leaf)];
  const Node& node = tree_.node(leaf);
  if (node.type == NodeType::SetSV) return take(leaf, possible_[0]);
  if (const auto* runs = possible(kRuns)) {
    flight.answered = early;
    return take(leaf, *runs);
  }
  if (std::exchange(flight.runs, false)) leaves_.halt(leaf);
  if (const auto* failure = possible(kFails)) return take(leaf, *failure);
  give_up(leaf, "go on or fail");
}

void TreeEngine::give_up(NodeId leaf, std::string_view wanted) {
  end_ = EngineState::Breached;
  reason_ = "the model does not let `" + short_name(tree_, leaf) + "` " +
            std::string(wanted) + " there";
}

// --- Words ---------------------------------------------------------------

std::string TreeEngine::result_name(const Node& leaf, int result) const {
  if (leaf.type == NodeType::SetSV) {
    return tree_.variable(leaf.variable).value_name(result);
  }
  return std::string(kStatusNames[static_cast<std::size_t>(result)]);
}

// "`land` answered failure; there it can answer success or running".
std::string TreeEngine::refusal(NodeId leaf, int answer) const {
  const Node& node = tree_.node(leaf);
  const bool measures = node.type == NodeType::SetSV;
  std::string text = "`" + short_name(tree_, leaf) + "` " +
                     (measures ? "found " : "answered ") +
                     result_name(node, answer);
  if (table_.leaf(leaf).timer) {
    const std::int64_t clock = system_.clock(now(), *table_.leaf(leaf).timer);
    if (possible(kRuns) != nullptr) {
      text +=
          " after " + std::to_string(clock) + (clock == 1 ? " tick" : " ticks");
    }
    text += "; its duration is " + duration_text(*node.duration);
  }
  if (!table_.meets_requirement(leaf, now())) {
    text += "; its requirement is false";
  }
  std::vector<std::string> words;
  for (const PossibleAnswer& allowed : possible_) {
    if (allowed.result != kFaultResult) {
      words.push_back(result_name(node, allowed.result));
    }
  }
  return text + "; there it can " + (measures ? "find " : "answer ") +
         alternatives(words);
}

}  // namespace btcheck

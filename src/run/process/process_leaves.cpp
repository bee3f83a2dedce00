// SPDX-License-Identifier: MIT
#include "run/process/process_leaves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "model/tree/node_types.hpp"
#include "run/leaves/function_leaves.hpp"
#include "text/json.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::chrono::milliseconds kToBeReady{10'000};
constexpr std::size_t kMostComplaints = 100;  // that wait to be heard
constexpr std::size_t kMostMoves = 1000;      // of one tick
constexpr std::uint64_t kNoQuestion = UINT64_MAX;
constexpr const char* kEndlessLine =
    "the process of the leaves has written a line without an end";

// A member of an object that is written by hand: numbers have decimals.
std::string member(std::string_view name, const std::string& value) {
  return Json(name).text() + ":" + value;
}

std::string arguments_text(std::span<const GivenArgument> arguments) {
  std::string text;
  for (const GivenArgument& given : arguments) {
    const auto& known = given.argument->known;
    text += text.empty() ? "" : ",";
    text += member(given.argument->key,
                   !known ? Json(given.argument->value).text()
                   : known->names.empty()
                       ? decimal_text(given.value, known->decimals)
                       : Json(known->names[static_cast<std::size_t>(
                                  given.value - known->min)])
                             .text());
  }
  return "{" + text + "}";
}

// A word, or a number as it is written.
std::string json_value(const StateVariable& variable, int value) {
  const std::string name = variable.value_name(value);
  return variable.is_enumeration() ? Json(name).text() : name;
}

// What begins the conversation: the leaves that will be asked for.
std::string begin_line(const BehaviorTree& tree, const ProcessPlan& plan) {
  Json leaves = Json::array();
  const std::vector<std::string> names = short_names(tree);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    if (!is_leaf(node.type) || node.id.empty()) continue;
    leaves.push(Json{
        {"leaf", node.id}, {"node", names[n]}, {"type", type_name(node.type)}});
  }
  std::string variables;
  for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
    const StateVariable& variable = tree.variables[v];
    const bool is_free = moves_freely(tree, StateVariableId{v});
    std::string about = member("value", json_value(variable, variable.initial));
    about += variable.is_enumeration()
                 ? "," + member("values", Json::array(variable.states).text())
                 : "," + member("min", json_value(variable, variable.min)) +
                       "," + member("max", json_value(variable, variable.max));
    about += "," + member("settable", is_free ? "true" : "false");
    variables += variables.empty() ? "" : ",";
    variables += member(variable.name, "{" + about + "}");
  }
  Json begin{{"id", 0}, {"do", "begin"}, {"tree", tree.file}};
  begin.add("tick_ms", plan.tick_ms);
  if (plan.seed) begin.add("seed", *plan.seed);
  begin.add("leaves", leaves);
  std::string line = begin.text();
  line.pop_back();
  return line + "," + member("variables", "{" + variables + "}") + "}";
}

}  // namespace

ProcessLeaves::ProcessLeaves(const BehaviorTree& tree,
                             const CompiledNetwork& system, ProcessPlan plan)
    : tree_(tree), system_(system), plan_(std::move(plan)) {}

std::string ProcessLeaves::begin() {
  system_.initial_states(
      [&](StateView state) { state_.assign(state.begin(), state.end()); });
  process_.emplace(plan_.command);
  if (!process_->error().empty()) {
    return fmt::format("`{}` cannot be started: {}", plan_.command,
                       process_->error());
  }
  const Heard heard =
      exchange(0, begin_line(tree_, plan_), "the process", kToBeReady);
  if (!heard.answer) return heard.text;
  const auto* answer = std::get_if<AnswerMessage>(&*heard.answer);
  if (answer == nullptr || answer->answer != "ready") {
    return "the process did not answer `ready` to `begin`";
  }
  return {};
}

void ProcessLeaves::end(const std::string& how) {
  if (!process_) return;
  process_->send(Json{{"do", "end"}, {"result", how}}.text(),
                 Clock::now() + plan_.within);
  process_->close(has_gone_ ? std::chrono::milliseconds(0) : plan_.within);
}

// --- Questions -----------------------------------------------------------

std::string ProcessLeaves::question_line(std::uint64_t id,
                                         std::string_view what,
                                         NodeId node) const {
  return fmt::format(R"("id":{},"do":{},"leaf":{},"node":{})", id,
                     Json(what).text(), Json(tree_.node(node).id).text(),
                     Json(short_name(tree_, node)).text());
}

Reply ProcessLeaves::ask(const LeafQuestion& question) {
  state_.assign(question.state.begin(), question.state.end());
  const Node& leaf = tree_.node(question.node);
  const bool measures = leaf.type == NodeType::SetSV;
  const std::string_view what = measures                           ? "measure"
                                : leaf.type == NodeType::Condition ? "ask"
                                : question.asked == Asked::Anew    ? "start"
                                                                   : "poll";
  const std::uint64_t id = ++last_id_;
  std::string line = question_line(id, what, question.node) +
                     fmt::format(R"(,"tick":{})", question.tick);
  if (measures) {
    line += "," +
            member("variable", Json(tree_.variable(leaf.variable).name).text());
  }
  if (!question.arguments.empty()) {
    line += "," + member("arguments", arguments_text(question.arguments));
  }
  Heard heard =
      exchange(id, "{" + line + "}",
               "`" + short_name(tree_, question.node) + "`", plan_.within);
  if (!heard.answer) return Reply::broken(heard.breach, std::move(heard.text));
  return reply_to(question, *heard.answer);
}

Reply ProcessLeaves::reply_to(const LeafQuestion& question,
                              const LeafMessage& message) {
  const Node& leaf = tree_.node(question.node);
  const std::string name = short_name(tree_, question.node);
  const auto wrong = [&](const std::string& said) {
    return Reply::broken(BreachKind::WrongAnswer,
                         fmt::format("`{}` answered {}", name, said));
  };
  if (leaf.type == NodeType::SetSV) {
    const auto* value = std::get_if<ValueMessage>(&message);
    if (value == nullptr) return wrong("no value");
    const StateVariable& variable = tree_.variable(leaf.variable);
    const auto found = value_of(variable, value->value);
    if (found) return Reply::answer(*found);
    return wrong(fmt::format("{}, which `{}` cannot be",
                             shortened(one_line(value->value.text()), 40),
                             variable.name));
  }
  const auto* answer = std::get_if<AnswerMessage>(&message);
  if (answer == nullptr) return wrong("a value");
  for (const NodeStatus status :
       {NodeStatus::Success, NodeStatus::Failure, NodeStatus::Running}) {
    if (answer->answer == kStatusNames[static_cast<std::size_t>(status)]) {
      return Reply::answer(status);
    }
  }
  return wrong(fmt::format("`{}`; an answer is success, failure or running",
                           shortened(one_line(answer->answer), 40)));
}

// --- Halting -------------------------------------------------------------

// All that are to halt are told before one of them is waited for: several that
// take long take as long as the one that takes longest.
void ProcessLeaves::halt(NodeId node) {
  const std::uint64_t id = ++last_id_;
  const std::string name = "`" + short_name(tree_, node) + "`";
  halted_by_ = Clock::now() + plan_.within;
  halts_.push_back({id, name});
  const auto sent =
      process_->send("{" + question_line(id, "halt", node) + "}", halted_by_);
  if (sent == LineProcess::Sent::Gone) give_up_halts(BreachKind::Gone);
}

void ProcessLeaves::await_halted() {
  while (!halts_.empty()) hear_halted();
}

// The next line, for whoever is to halt; or their time is over.
void ProcessLeaves::hear_halted() {
  std::string said;
  const auto got = process_->receive(said, halted_by_);
  if (got == LineProcess::Got::Gone) return give_up_halts(BreachKind::Gone);
  if (got == LineProcess::Got::Late) {
    return give_up_halts(BreachKind::NotHalted);
  }
  const Halt first = halts_.front();
  std::optional<Heard> heard;
  if (got == LineProcess::Got::Line) {
    heard = take(read_message(said), first.id, first.name);
    if (!heard) {
      // Somebody who sets a variable without end does not halt either.
      const bool is_late = Clock::now() >= halted_by_;
      return is_late ? give_up_halts(BreachKind::NotHalted) : void();
    }
  } else {
    heard = Heard{std::nullopt, BreachKind::Nonsense, kEndlessLine};
  }
  late_.insert(first.id);
  complain(heard->breach, heard->text + ", when it was halted");
  std::erase_if(halts_, [&](const Halt& halt) { return halt.id == first.id; });
}

// No answer of theirs is waited for any more.
void ProcessLeaves::give_up_halts(BreachKind kind) {
  for (const Halt& halt : std::exchange(halts_, {})) {
    late_.insert(halt.id);
    if (kind == BreachKind::NotHalted) {
      complain(kind, fmt::format("{} has not answered within {} ms, when it "
                                 "was halted",
                                 halt.name, plan_.within.count()));
    } else if (!has_gone_) {
      complain(kind, gone_text() + ", when " + halt.name + " was halted");
    }
  }
}

void ProcessLeaves::take_halted(const LeafMessage& message,
                                const std::string& name) {
  const auto* answer = std::get_if<AnswerMessage>(&message);
  if (answer != nullptr && answer->answer == "halted") return;
  complain(BreachKind::WrongAnswer,
           fmt::format("{} did not answer `halted` to `halt`", name));
}

// --- The conversation ----------------------------------------------------

// Sends a question and listens until it is answered.
ProcessLeaves::Heard ProcessLeaves::exchange(std::uint64_t id,
                                             const std::string& line,
                                             const std::string& who,
                                             std::chrono::milliseconds within) {
  await_halted();
  const Clock::time_point until = Clock::now() + within;
  const auto late = [&] {
    late_.insert(id);
    return Heard{
        std::nullopt, BreachKind::NoAnswer,
        fmt::format("{} has not answered within {} ms", who, within.count())};
  };
  switch (process_->send(line, until)) {
    case LineProcess::Sent::Late:
      return late();
    case LineProcess::Sent::Gone:
      return {std::nullopt, BreachKind::Gone, gone_text()};
    case LineProcess::Sent::Yes:
      break;
  }
  std::string said;
  while (true) {
    switch (process_->receive(said, until)) {
      case LineProcess::Got::Late:
        return late();
      case LineProcess::Got::Gone:
        return {std::nullopt, BreachKind::Gone, gone_text()};
      case LineProcess::Got::TooLong:
        return {std::nullopt, BreachKind::Nonsense, kEndlessLine};
      case LineProcess::Got::Line:
        break;
    }
    if (auto heard = take(read_message(said), id, who)) return *heard;
    // Somebody who sets a variable without end does not answer either.
    if (Clock::now() >= until) return late();
  }
}

// What a message is for the question that waits; nothing where it is not about
// that.
std::optional<ProcessLeaves::Heard> ProcessLeaves::take(
    const LeafMessage& message, std::uint64_t id, const std::string& who) {
  if (const auto* nonsense = std::get_if<NonsenseMessage>(&message)) {
    late_.insert(id);
    return Heard{std::nullopt, BreachKind::Nonsense,
                 fmt::format("the process of the leaves, asked about {}, says "
                             "what is not understood: {}",
                             who, nonsense->why)};
  }
  if (const auto* set = std::get_if<SetMessage>(&message)) {
    take_set(*set);
    return std::nullopt;
  }
  if (const auto* get = std::get_if<GetMessage>(&message)) {
    take_get(*get);
    return std::nullopt;
  }
  const auto* answer = std::get_if<AnswerMessage>(&message);
  const std::uint64_t answered =
      answer != nullptr ? answer->id : std::get<ValueMessage>(message).id;
  const auto halt = std::ranges::find(halts_, answered, &Halt::id);
  if (halt != halts_.end()) {
    take_halted(message, halt->name);
    halts_.erase(halt);
    return std::nullopt;
  }
  if (answered == id) return Heard{message, {}, {}};
  if (answered > last_id_) {
    const std::string text =
        fmt::format("question {} is answered, which was not asked", answered);
    if (id == kNoQuestion) {
      complain(BreachKind::Nonsense, text);
      return std::nullopt;
    }
    // Who counts otherwise does not answer the one that waits.
    late_.insert(id);
    return Heard{std::nullopt, BreachKind::Nonsense,
                 fmt::format("{}; {} was asked question {}", text, who, id)};
  }
  if (late_.erase(answered) == 0) {
    complain(BreachKind::AnsweredTwice,
             fmt::format("question {} is answered twice", answered));
  }
  return std::nullopt;
}

// --- State variables -----------------------------------------------------

void ProcessLeaves::take_set(const SetMessage& message) {
  const std::string name = shortened(one_line(message.variable), 40);
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    const StateVariableId id{v};
    if (tree_.variables[v].name != message.variable) continue;
    const auto value = value_of(tree_.variables[v], message.value);
    if (!moves_freely(tree_, id)) {
      complain(BreachKind::WrongAnswer,
               fmt::format("`{}` is set, which does not move by itself", name));
    } else if (!value) {
      complain(BreachKind::WrongAnswer,
               fmt::format("`{}` is set to {}, which it cannot be", name,
                           shortened(one_line(message.value.text()), 40)));
    } else if (moves_.size() < kMostMoves) {
      moves_.push_back({id, *value});
    }
    return;
  }
  complain(BreachKind::WrongAnswer,
           fmt::format("`{}` is set, and the tree has no such variable", name));
}

void ProcessLeaves::take_get(const GetMessage& message) {
  std::string value = "null";
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    const StateVariable& variable = tree_.variables[v];
    if (variable.name != message.variable) continue;
    value = json_value(
        variable, static_cast<int>(system_.value(
                      view_of(state_), system_.network().state_variable[v])));
  }
  process_->send(fmt::format(R"({{"do":"value",{},{}}})",
                             member("variable", Json(message.variable).text()),
                             member("value", value)),
                 Clock::now() + plan_.within);
}

// What is set while the engine goes through them is for the next tick.
std::optional<VariableMove> ProcessLeaves::next_move(int tick, StateView now) {
  state_.assign(now.begin(), now.end());
  if (moved_in_tick_ != tick) {
    moved_in_tick_ = tick;
    left_for_tick_ = moves_.size();
  }
  if (left_for_tick_ == 0) return std::nullopt;
  --left_for_tick_;
  const VariableMove move = moves_.front();
  moves_.pop_front();
  return move;
}

// --- What comes without a question ---------------------------------------

void ProcessLeaves::complain(BreachKind kind, std::string text) {
  if (complaints_.size() < kMostComplaints) {
    complaints_.push_back({kind, std::nullopt, std::move(text)});
  }
}

std::string ProcessLeaves::gone_text() {
  has_gone_ = true;
  return "the process of the leaves " + process_->ending();
}

std::optional<Complaint> ProcessLeaves::complaint() {
  if (!halts_.empty() && Clock::now() >= halted_by_) await_halted();
  std::string said;
  for (std::size_t i = 0; i < kMostMoves && complaints_.empty(); ++i) {
    if (process_->receive(said, Clock::now()) != LineProcess::Got::Line) break;
    const auto heard = take(read_message(said), kNoQuestion, "nothing");
    if (heard) complain(heard->breach, heard->text);
  }
  if (complaints_.empty()) return std::nullopt;
  Complaint first = std::move(complaints_.front());
  complaints_.pop_front();
  return first;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Where the model ends and the robot begins: what an engine asks of leaves,
// what they reply, and what is said where a reply is none that the model
// allows.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What is done about an answer that the model does not allow.
enum class OnBreach : std::uint8_t {
  Stop,  // the run ends
  Fail,  // the leaf fails, as soon as the model lets it
  GoOn   // the leaf runs on where the model has that, else it fails
};

enum class BreachKind : std::uint8_t {
  Forbidden,      // the contract excludes the answer, or :transitions the value
  WrongAnswer,    // no answer that a leaf of this type can give at all
  TooEarly,       // before the least :duration is over
  TooLate,        // still running when the greatest is
  AnsweredTwice,  // an answer that nobody has asked for
  NoAnswer,       // within the deadline
  Threw,          // an exception
  Gone,           // the process of the leaves has ended
  Nonsense,       // what that process says is not understood
  NotHalted       // told to stop, and not stopped within the deadline
};
inline constexpr std::size_t kBreachKinds = 10;
std::string_view breach_name(BreachKind kind);

struct Breach {
  BreachKind kind = BreachKind::Forbidden;
  std::optional<NodeId> node;  // none: a variable, or the leaves as a whole
  int tick = 0;
  std::string text;  // "`land` answered failure; there it can answer success"
};

// What a leaf replies. An answer is a NodeStatus, of a SetSV the value
// measured.
struct Reply {
  enum class Kind : std::uint8_t {
    Answer,
    Silence,  // whatever the model takes first: of an action success
    Breach    // none; `breach` and `text` tell why
  };
  Kind kind = Kind::Silence;
  int value = 0;
  BreachKind breach = BreachKind::NoAnswer;
  std::string text = {};

  static Reply answer(int value) { return {Kind::Answer, value}; }
  static Reply answer(NodeStatus status) {
    return answer(static_cast<int>(status));
  }
  static Reply broken(BreachKind kind, std::string text) {
    return {Kind::Breach, 0, kind, std::move(text)};
  }
};

// An argument of :args as the node was ticked with it. What is not `known` to
// the model stands as it was written.
struct GivenArgument {
  const Argument* argument = nullptr;
  std::int64_t value = 0;  // divided by 10^decimals where it is a number
};

// One answer that the model allows now. Of an answer whose effects leave a
// range, or divide by zero, the result is kFaultResult.
struct PossibleAnswer {
  std::uint32_t edge = 0;  // by its place among the compiled ones
  int result = 0;
};
inline constexpr int kFaultResult = -1;

enum class Asked : std::uint8_t {
  Anew,  // an action is started
  Again  // and polled while it runs
};

// What an engine asks when the tick has come to a leaf. Views die with the
// call.
struct LeafQuestion {
  NodeId node{};
  Asked asked = Asked::Anew;
  int tick = 0;
  std::span<const GivenArgument> arguments;
  std::span<const PossibleAnswer> possible;
  // The action may end now, though its time is not yet up.
  bool may_be_due = false;
  StateView state;
};

// A free variable that has changed.
struct VariableMove {
  StateVariableId variable{};
  int value = 0;
};

// What came without a question.
struct Complaint {
  BreachKind kind = BreachKind::Nonsense;
  std::optional<NodeId> node;
  std::string text;
};

// Whoever answers for the leaves. All calls come from the thread of the engine.
class Leaves {
 public:
  virtual ~Leaves() = default;

  // Replies at once, or within a deadline of its own.
  virtual Reply ask(const LeafQuestion& question) = 0;
  // Not asked: its requirement is false, so it fails.
  virtual Reply refused(const LeafQuestion&) { return {}; }
  // An action that was running is to stop. It is not waited for here.
  virtual void halt(NodeId) {}
  // Waits for those that are to stop, as long as they may take.
  virtual void await_halted() {}
  // Before each tick of the first tree, until there is none: what has changed
  // in the world, in this order.
  virtual std::optional<VariableMove> next_move(int /*tick*/,
                                                StateView /*now*/) {
    return std::nullopt;
  }
  // Whether a variable whose time is over moves without being told of here.
  virtual bool lets_variables_move() const { return false; }
  virtual std::optional<Complaint> complaint() { return std::nullopt; }
};

}  // namespace btcheck

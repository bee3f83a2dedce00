// SPDX-License-Identifier: MIT
//
// A verified tree, executed: the header of btcheck::run for other people's
// programs. It needs the standard library alone.
//
//     btcheck::run::Engine engine("drone.btf", text);
//     engine.action("takeoff", [](const Call& call, std::stop_token stop) {
//       return drone.take_off(call.number("height"), stop) ? Answer::Success
//                                                          : Answer::Failure;
//     });
//     engine.condition("localization_ok", [](const Call&) { return gps.ok();
//     }); engine.measure("measure_battery", [](const Call&) { return "Low"; });
//     const Report report = engine.run();
//
// The engine steps the very automata that `btcheck drone.btf` searches, so each
// run is one of those that were checked. An answer that the model does not
// allow is never taken: it is a breach, and Options::on_breach says what
// follows. docs/run.md has the order of steps, the breaches and what each
// policy does.
//
// Mistakes in the set-up (a tree that cannot be read, a leaf that the tree does
// not have, a leaf without a function) are thrown as Error. Whatever happens
// later is told in events, breaches and the report; nothing else is thrown.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>

namespace btcheck::run {

// What is wrong with the set-up, as btcheck says it: perhaps several lines.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// How an action ends.
enum class Answer : std::uint8_t { Success, Failure };

// What a node answered last.
enum class Status : std::uint8_t { Success, Failure, Running, Halted };

// One of a node's :args.
struct Argument {
  enum class Kind : std::uint8_t {
    Number,  // evaluated
    Word,    // evaluated, a value of an enumeration
    Written  // the model does not know it: as it stands in the tree
  };
  std::string_view key;
  Kind kind = Kind::Written;
  double number = 0;      // of a Number
  std::string_view text;  // of the others; it lives as long as the engine
};

// What a leaf is called with. It lives as long as the call; views into it
// likewise.
class Call {
 public:
  Call(std::string_view leaf, std::string_view node, int tick,
       std::span<const Argument> arguments)
      : leaf_(leaf), node_(node), tick_(tick), arguments_(arguments) {}

  std::string_view leaf() const { return leaf_; }  // the :ID
  std::string_view node() const { return node_; }  // unique: "land@23"
  int tick() const { return tick_; }               // counted from 1
  // As they were when the node was started; an action keeps them while it runs.
  std::span<const Argument> arguments() const { return arguments_; }

  // Those of a key. std::out_of_range where there is none, or none of the kind;
  // what is Written and is a number is one, too.
  double number(std::string_view key) const;
  std::string_view text(std::string_view key) const;

 private:
  std::string_view leaf_;
  std::string_view node_;
  int tick_;
  std::span<const Argument> arguments_;
};

// The value of a state variable: a word of an enumeration, or a number.
class Value {
 public:
  Value(double number) : number_(number) {}
  Value(int number) : number_(number) {}
  Value(std::string word) : word_(std::move(word)), is_word_(true) {}
  Value(const char* word) : Value(std::string(word)) {}
  // The word as it is spelled in the tree, the number without superfluous
  // zeros.
  std::string text() const;

  bool is_word() const { return is_word_; }
  const std::string& word() const { return word_; }
  double number() const { return number_; }

 private:
  std::string word_;
  double number_ = 0;
  bool is_word_ = false;
};

// An action with a task of its own: called once when it is started, on a thread
// that belongs to its node. Until it returns the node answers running. When it
// is halted a stop is requested: it returns soon, whatever it answers then.
using ActionFunction = std::function<Answer(const Call&, std::stop_token)>;

// Success or failure of a condition; what a SetSV finds.
using ConditionFunction = std::function<bool(const Call&)>;
using MeasureFunction = std::function<Value(const Call&)>;

// An action without a thread, called within the tick: once with Start, with
// Poll in each tick in which it is ticked again, with Halt when it is to stop
// (what it returns then does not matter). Never returns Halted.
enum class Turn : std::uint8_t { Start, Poll, Halt };
using PolledFunction = std::function<Status(const Call&, Turn)>;

// Where a condition or a measurement is called. InTask: on a thread of its
// node, which the tick waits for until Options::answer_within is over. InTick:
// on the thread of the engine, some microseconds sooner; one that does not
// return stops the tree.
enum class Runs : std::uint8_t { InTask, InTick };

enum class Pace : std::uint8_t {
  RealTime,  // ticks begin Options::period apart
  AtOnce     // one tick after the other: time is what the model counts
};

enum class OnBreach : std::uint8_t {
  Stop,  // the run ends
  Fail,  // the leaf fails, as soon as the model lets it; else the run ends
  GoOn  // it runs on where the model has that, else it fails, else the run ends
};

struct Options {
  std::chrono::milliseconds period{100};  // of a tick, at least 1
  Pace pace = Pace::RealTime;
  // How long the tick waits for a leaf that cannot answer running, and how long
  // a halted action may take to return.
  std::chrono::milliseconds answer_within{100};
  OnBreach on_breach = OnBreach::Stop;
  // Whether the run is kept, eight bytes a step, for itf() and btlog().
  enum class Keep : std::uint8_t { Nothing, Run } keep = Keep::Run;
};

// What happens, on the thread of the engine. Views die with the call.
struct Event {
  enum class Kind : std::uint8_t {
    TickBegins,  // of a tree; `node` is its root
    Ticked,      // the tick has come to a node
    Answered,    // a node has answered `status`; Halted: it was halted
    Changed      // a variable: `node` is its name, `value` its new value
  };
  Kind kind = Kind::Ticked;
  int tick = 0;
  std::string_view node;
  Status status = Status::Running;  // of Answered
  std::string_view value = {};      // of Changed; "" where it is a number
  double number = 0;                // then this
};

struct Breach {
  int tick = 0;
  std::string node;  // "" for a variable
  std::string kind;  // "too early"; docs/run.md lists them
  std::string text;  // "`fly` answered success after 1 tick; …"
};

enum class End : std::uint8_t {
  None,      // it can go on
  Success,   // the tree has succeeded; of several trees, all have
  Failure,   // the tree has failed; of several trees, some have
  Fault,     // an assignment out of range, or a division by zero
  Stuck,     // no node can go on
  Breached,  // a leaf has ended it
  Stopped    // stop() was called
};

struct Report {
  End end = End::None;
  int ticks = 0;
  std::uint64_t breaches = 0;
  std::uint64_t overruns = 0;  // ticks that took longer than their period
  std::chrono::nanoseconds longest_tick{0};
  std::string text;  // a sentence on how it ended
};

// One run of one tree file. All functions but stop() and set() are called by
// one thread.
class Engine {
 public:
  // Reads a tree in .btf: `name` for messages, `text` the file's content. Error
  // where it cannot be read.
  Engine(std::string name, std::string text, Options options = {});
  // Tasks are told to stop; one that does not return within the deadline is
  // left alone with its thread.
  ~Engine();
  Engine(Engine&&) noexcept;
  Engine& operator=(Engine&&) noexcept;

  // --- Before the first tick -----------------------------------------------

  // Leaves by :ID or by any name that properties have for a node: `land`,
  // `land@23`. The name that fits fewer nodes goes first. Error where no leaf
  // of the kind is so called.
  void action(const std::string& leaf, ActionFunction function);
  void polled(const std::string& leaf, PolledFunction function);
  void condition(const std::string& leaf, ConditionFunction function,
                 Runs where = Runs::InTask);
  void measure(const std::string& leaf, MeasureFunction function,
               Runs where = Runs::InTask);

  void on_event(std::function<void(const Event&)> told);
  void on_breach(std::function<void(const Breach&)> told);

  // --- Running -------------------------------------------------------------

  // Ticks until the tree has ended, something ends the run, or so many ticks
  // are over (0: no limit). Then all actions that run are told to stop. Error
  // where a leaf has no function.
  Report run(int most_ticks = 0);
  // One tick at once, whatever the period; None where there may be another.
  End tick();
  Report report() const;

  // Ends the run before the next tick. From any thread, and from a signal's
  // handler.
  void stop() noexcept;
  // A variable that moves by itself has changed; taken over when the next tick
  // begins, in the order of the calls. A change that :transitions exclude is a
  // breach. From any thread. Error where the tree has no such variable, it does
  // not move by itself, or it has no such value.
  void set(const std::string& variable, const Value& value);

  // --- Between ticks -------------------------------------------------------

  Value value(const std::string& variable) const;  // Error: there is none

  // The run so far: ITF JSON, which `btcheck trace` reads, and a log of
  // BehaviorTree.CPP for Groot2. Each step has been executed again. Of a long
  // run the beginning, as much as `trace` reads (64 MiB). Error where the run
  // was not kept.
  std::string itf() const;
  std::string btlog() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace btcheck::run

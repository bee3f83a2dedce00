// SPDX-License-Identifier: MIT
//
// A log as a run: the states that its records tell of, one after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trace/logs/behavior_log.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// Where a state of the run stands in the log.
struct LogPlace {
  std::optional<std::size_t> record;  // read last; none: before the first
  std::int64_t time = 0;  // of that, microseconds since the log began
};

// "success", and as a viewer colours it.
const char* word_of(LogStatus answer);
Phase phase_of(LogStatus answer);

// What may have happened to a node without a record: a node that runs is ticked
// and answers running again, and none of it is a change of status.
enum class Unseen : std::uint8_t {
  Nothing,
  Running,   // it may be ticked, and answer running
  Halted,    // it may have been halted, or been skipped as all below it were
  Skipped,   // it is ticked, and may have answered skipped
  Repeated,  // it may be ticked, and answer as before; not in logs of btcheck
  Called,    // its tick may be over, and another may have begun
  Status,    // it may have had another status before
  Anything   // its records are not told apart from those of others
};

// A run of a log as it is shown: by its file, and no property of it.
RecordedRun titled(RecordedRun heading, const std::string& file,
                   const BehaviorLog& log);

// Gives a run the entries of a log as its variables, in the place of others.
void take_entries(RecordedRun& run, const LogMarks& marks);

// Goes through a log. A node whose child has a record is being ticked, also
// where it sets RUNNING at its answer only, such as a Switch. Node 0 of the run
// is the tree itself, which no record is about: it is ticked where a tick
// begins and answers where it ends. The nodes of the log follow in the order of
// their uids.
//
// A record is one or more states: a node is ticked, answers, gives control
// back. Behind the last of them no node is in an event, as between the steps of
// a tree; but for a leaf that became RUNNING last. The next record tells
// whether that was its answer: SimpleActionNode sets it before it calls its
// function, and answers in the same tick (src/action_node.cpp of 4.10
// and 3.8.8). At the end of a log it is not known.
//
// Where it is not known between which records ticks end and begin, a log can be
// told with all ways: between two records come the states of a tick that ends,
// of time that passes and of a tick that begins, and `is_possible` says that
// all of them may not have been, or have been several times over. What is
// certain is told as such: a tree that has answered begins anew with the next
// record that is no reset.
enum class TickWays : std::uint8_t {
  Likely,  // one way: ticks are parted where there is a long pause
  All      // but where it is known
};

class LogPlayer {
 public:
  // The log must outlive it.
  LogPlayer(const BehaviorLog& log, const LogReading& reading,
            TickWays ways = TickWays::Likely);

  // The run without its states.
  const RecordedRun& heading() const { return heading_; }

  // Calls see() for each state, the first one included, until it is false.
  void play(const std::function<bool()>& see);

  // The same in parts, for a log that grows: the states of the records that
  // follow those before. False once see() was.
  bool play_on(std::span<const LogTransition> records,
               const std::function<bool()>& see);
  // Of a log with marks: all that they have more than when it was last played.
  bool play_marks(const std::function<bool()>& see);
  // And the end of the last tick, where the tree has ended in it.
  bool play_end(const std::function<bool()>& see);
  // The tick is over: no record of it follows but those of nodes being reset.
  bool end_here(const std::function<bool()>& see);

  // While see() is called: the present state, where it stands in the log, and
  // what may have happened unseen in it, by node.
  const RecordedState& state() const { return state_; }
  const LogPlace& place() const { return place_; }
  Unseen unseen(std::size_t node) const;
  // It and those before it that are so, back to the last one that is not, may
  // not have been, or may have come several times over.
  bool is_possible() const { return is_possible_; }
  // The tree has answered in the last tick, which is over.
  bool has_ended() const;

 private:
  bool play(const LogMark& mark);
  bool play_again(const LogMark& again);
  bool begin_node(std::size_t node);
  bool hear_answer(std::size_t node, LogStatus status);
  bool change(const LogTransition& record);
  void take_as_given(const LogTransition& record);
  bool end_with(LogStatus status);
  bool leave_tick(const std::string& why);
  bool begin_tick(std::int64_t tick);
  bool end_tick();
  bool end_for_good();
  bool enter_tick(std::int64_t tick);
  bool pass_time();
  bool part_before(const LogTransition& record);
  bool may_part(bool is_in_tick);
  bool part_at_gap(std::int64_t time);
  bool part_at_end(const LogTransition& record);
  bool is_answer_known() const;
  LogStatus answer_of_tick() const;
  bool read(const LogTransition& record);
  bool take_up(std::size_t node, bool is_leaf);
  bool call_above(std::size_t node);
  bool let_go_below(std::size_t node);
  bool is_below(std::size_t node, std::size_t above) const;
  bool settle();
  bool answer(std::size_t node, LogStatus status);
  bool reach(std::size_t node, const char* location, Phase phase);
  bool show(std::size_t node, std::string event);
  bool rest(std::size_t node, Phase phase);
  std::size_t number_of(std::uint16_t uid) const;

  const BehaviorLog& log_;
  const LogReading reading_;
  const bool has_all_ways_;
  RecordedRun heading_;
  std::vector<bool> is_leaf_;       // by node
  std::vector<LogStatus> status_;   // by node, as the records say
  std::vector<LogStatus> outcome_;  // of the tops: what they ended a tick with
  std::vector<bool> is_silent_;     // by node; the tree is with its top node
  std::optional<std::size_t> maybe_halted_;
  std::optional<std::size_t> halted_before_;  // by the record before
  std::optional<std::size_t> taken_up_;       // a leaf, by the record before
  std::vector<std::size_t> called_;  // ticked without a record of their own
  RecordedState state_;
  LogPlace place_;
  const std::function<bool()>* see_ = nullptr;
  TickCounter ticks_;
  bool has_begun_ = false;  // the first state has been seen
  bool is_over_ = false;    // this tick
  bool is_possible_ = false;
  bool is_root_known_ = true;    // where the tree itself is
  bool is_status_known_ = true;  // of the tree itself
  bool is_time_open_ = false;    // the time behind a tick may have passed
  bool has_answered_ = false;    // the tree, in the tick that is over
  std::int64_t begin_ = 0;       // of the tick
  std::size_t tops_ = 0;         // nodes without a parent
  std::size_t top_ = 0;          // the last of them
  std::size_t played_ = 0;       // records
  std::size_t mark_ = 0;         // that is played next
  // What a node has just answered.
  std::optional<std::pair<std::size_t, LogStatus>> has_said_;
  // Has set its own status so, by the record before, and is to answer that.
  std::optional<std::pair<std::size_t, LogStatus>> has_set_;
};

}  // namespace btcheck

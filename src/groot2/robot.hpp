// SPDX-License-Identifier: MIT
//
// A robot that is followed: what its publisher says, put together to recordings
// without a gap. A recording ends where the program has been started anew, or
// where changes of status were lost, and the next one begins.
//
// A publisher keeps the last 1,000 changes for who asks next, so it is asked
// fifty times a second, and at once where much has come. That nothing is lost
// is known where fewer have come, where each node's status is another than it
// had, and where the changes lead, twice a second, to the statuses that the
// publisher itself has: somebody else may ask it for changes as well.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "groot2/faults.hpp"
#include "groot2/link.hpp"
#include "groot2/wire.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck::groot2 {

// The values of entries, by name: "battery", "dock/pose" below a subtree.
using EntryValues = std::map<std::string, std::string>;

// Who is told of a robot, by the thread that follows it.
class Listener {
 public:
  virtual ~Listener() = default;

  // Whether nobody wants to know any more; asked often.
  virtual bool is_over() = 0;

  // Nobody answers, or nobody answers any more.
  virtual void waits(std::string_view why) = 0;
  // Somebody answers again.
  virtual void is_back() = 0;

  // A recording begins. Its records are what nodes had done before that: the
  // status of each that is not idle. It lasts until `ends`; errors in what is
  // returned end it all.
  virtual std::vector<Diagnostic> begins(const BehaviorLog& log,
                                         const EntryValues& entries) = 0;
  // Records that follow.
  virtual void goes_on(std::span<const LogTransition> records) = 0;
  virtual void knows_entries(const EntryValues& entries) = 0;
  // The recording is over, for this reason; others may follow.
  virtual void ends(std::string_view why) = 0;

  // A node with a hook is reached: it answers what it was told to, or it waits
  // until `may_go_on`, which is asked often.
  virtual void is_injected(std::size_t fault) = 0;
  virtual void stands_at(std::size_t fault) = 0;
  virtual bool may_go_on(std::size_t fault) = 0;
};

struct Following {
  std::vector<Fault> faults;
  bool asks_for_entries = false;
  std::chrono::milliseconds patience{1000};  // with one request
  LogReading reading = {};                   // of its ticks
};

class Robot {
 public:
  // All must outlive it.
  Robot(Context& context, const Address& address, const Following& following,
        Listener& listener);

  // Until it is over, or nothing more can come of it: then an error says why.
  // Hooks are removed.
  std::vector<Diagnostic> follow();

 private:
  using Clock = std::chrono::steady_clock;
  struct Stop {  // thrown: errors
    std::vector<Diagnostic> found;
  };
  struct Over {};  // thrown: nobody listens any more
  struct Gap {     // thrown
    std::string why;
  };

  Answer meet();
  Answer ask(Request kind,
             std::optional<std::string_view> argument = std::nullopt);
  [[noreturn]] void refuse(const Answer& answer) const;
  [[noreturn]] void stop(std::string_view code, std::string message,
                         std::string help = {}) const;

  void read_tree(std::string_view xml);
  std::size_t place_of(std::uint16_t uid) const;

  void record();
  void begin();
  bool begin_in(std::vector<LogStatus>& before);
  void go_on();
  void end(std::string_view why);
  std::vector<LogStatus> statuses();
  std::vector<Change> changes();
  void take(const std::vector<Change>& changes);
  EntryValues entries();

  void arm();
  void hear();
  void leave(std::vector<Diagnostic>& found);

  const Address address_;
  const Following& following_;
  Listener& listener_;
  std::atomic<bool> is_leaving_ = false;
  Link link_;
  std::optional<Ear> ear_;
  bool is_met_ = false;
  Clock::time_point met_;
  TreeId id_{};
  std::vector<std::string> boards_;  // the names of blackboards
  bool has_entries_ = false;         // it can be asked for them
  std::vector<Hook> hooks_;          // of the faults
  std::vector<bool> is_armed_;       // likewise
  std::vector<bool> stands_;         // likewise

  // Of the recording.
  BehaviorLog log_;  // with the records at its beginning
  bool has_begun_ = false;
  std::vector<LogStatus> known_;  // by node
  std::vector<Change> first_;     // that came while it began
  std::int64_t time_ = 0;         // of the last change
  std::optional<TickCounter> ticks_;
  std::int64_t tick_ = 0;
  std::size_t came_ = 0;  // changes, the last time
  int quick_gaps_ = 0;
  Clock::time_point begin_;
  Clock::time_point compared_;  // with the publisher's statuses
  Clock::time_point looked_;    // at entries
};

}  // namespace btcheck::groot2

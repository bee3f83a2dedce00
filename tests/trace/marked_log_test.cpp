// SPDX-License-Identifier: MIT
//
// Logs with the marks of btcheck::observer, against a player that does nothing
// but what their meaning says, one line for each sentence.
#include "trace/marked_log.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ltl/rules/property.hpp"
#include "trace/live/live_log.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck::marked_log_test {
namespace {

constexpr LogStatus kIdle = LogStatus::Idle;
constexpr LogStatus kRunning = LogStatus::Running;
constexpr LogStatus kSuccess = LogStatus::Success;
constexpr LogStatus kFailure = LogStatus::Failure;
constexpr LogStatus kSkipped = LogStatus::Skipped;

const std::string kXml =
    "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\" _fullpath=\"\">"
    "<Sequence name=\"top\" _uid=\"1\"><Look name=\"look\" _uid=\"2\"/>"
    "<Fallback name=\"try\" _uid=\"3\"><Go name=\"go\" _uid=\"4\"/>"
    "<Wait name=\"wait\" _uid=\"5\"/></Fallback></Sequence></BehaviorTree>"
    "<TreeNodesModel><Action ID=\"Look\"/><Action ID=\"Go\"/>"
    "<Action ID=\"Wait\"/></TreeNodesModel></root>";
// By node of the run: 0 is the tree, the others their uids.
constexpr std::size_t kParents[] = {0, 0, 1, 1, 3, 3};
constexpr bool kIsLeaf[] = {false, false, true, false, true, true};
constexpr std::size_t kCount = 6;

struct Read {
  BehaviorLog log;
  std::vector<Diagnostic> found;
};

Read read(const std::string& bytes, const std::string& marks) {
  auto log = read_log("a.btlog", bytes);
  REQUIRE(log.value);
  Read result{std::move(*log.value), {}};
  result.found = read_marks("a.btlog.marks", marks, result.log);
  return result;
}

Read read(const MarkedLogWriter& writer) {
  return read(writer.log(), writer.marks());
}

struct Seen {
  std::vector<std::string> locations;
  std::vector<std::string> statuses;
  std::vector<std::string> values;
  int time = 0;
  int tick = 0;

  friend bool operator==(const Seen&, const Seen&) = default;
};

std::vector<Seen> played(const BehaviorLog& log) {
  std::vector<Seen> seen;
  LogPlayer player(log, {});
  player.play([&] {
    const RecordedState& state = player.state();
    seen.push_back({state.locations, state.statuses, state.values, state.time,
                    state.tick});
    for (std::size_t n = 0; n < state.locations.size(); ++n) {
      CHECK(player.unseen(n) == Unseen::Nothing);
    }
    return true;
  });
  return seen;
}

// What marks mean, told a second time, and the marks themselves.
class NaivePlayer {
 public:
  explicit NaivePlayer(MarkedLogWriter& writer) : writer_(writer) {
    now_.locations.assign(kCount, "start_");
    now_.statuses.assign(kCount, "idle");
    now_.values = {"unset", "unset"};
    show();
  }

  void begin_tick(bool is_woken) {
    has_set_.reset();
    writer_.begin_tick(100'000, is_woken);
    ++now_.tick;
    go(0, "tick_node");
    go(0, "called");
  }
  void begin(std::size_t n) {
    has_set_.reset();
    writer_.begin_node(static_cast<std::uint16_t>(n));
    enter(n);
  }
  void answer(std::size_t n, LogStatus status) {
    writer_.answer(static_cast<std::uint16_t>(n), status);
    const bool is_told = has_set_ == std::pair(n, status);
    has_set_.reset();
    if (!is_told) settle(n, status);
    if (status == kSkipped || said_[n] == status) return;
    writer_.change(static_cast<std::uint16_t>(n), status);
    said_[n] = status;
  }
  // From outside of what is heard.
  void change(std::size_t n, LogStatus status) {
    if (said_[n] == status) return;
    writer_.change(static_cast<std::uint16_t>(n), status);
    has_set_.reset();
    const LogStatus before = std::exchange(said_[n], status);
    if (status == kRunning) {
      enter(n);
      now_.statuses[n] = "running";
      show();
    } else if (status != kIdle) {
      settle(n, status);
      has_set_ = {n, status};
    } else {
      now_.statuses[n] = "idle";
      if (before == kRunning && now_.locations[n] == "start_") {
        go(n, "halted");
        go(n, "done");
        go(n, "start_");
      } else {
        show();
      }
    }
  }
  void end_tick(LogStatus status) {
    has_set_.reset();
    writer_.end_tick(status);
    let_go(0);
    now_.statuses[0] = word(status);
    go(0, word(status));
    go(0, "done");
    go(0, "start_");
    pass();
  }
  void leave_tick() {
    has_set_.reset();
    writer_.leave_tick("out of power");
    for (auto& location : now_.locations) {
      if (location == "called" || location == "tick_node") location = "start_";
    }
    order_.clear();
    show();
    pass();
  }
  void set(std::size_t entry, std::int64_t value) {
    writer_.set(entry, value);
    now_.values[entry] = std::to_string(value);
  }

  const std::vector<Seen>& seen() const { return seen_; }

 private:
  static std::string word(LogStatus status) {
    return status == kSuccess   ? "success"
           : status == kFailure ? "failure"
           : status == kRunning ? "running"
                                : "skipped";
  }
  void show() { seen_.push_back(now_); }
  void go(std::size_t n, const std::string& location) {
    now_.locations[n] = location;
    show();
  }
  void pass() {
    ++now_.time;
    show();
  }
  void call_above(std::size_t n) {
    std::vector<std::size_t> above;
    for (std::size_t p = kParents[n]; p != 0; p = kParents[p]) {
      if (now_.locations[p] != "start_") break;
      above.push_back(p);
    }
    std::ranges::reverse(above);
    for (const std::size_t p : above) {
      order_.push_back(p);
      go(p, "tick_node");
      go(p, "called");
    }
  }
  void enter(std::size_t n) {
    call_above(n);
    if (now_.locations[n] != "start_") return;
    let_go(kParents[n]);
    order_.push_back(n);
    go(n, "tick_node");
    if (!kIsLeaf[n]) go(n, "called");
  }
  static bool is_below(std::size_t n, std::size_t above) {
    while (n != 0 && n != above) n = kParents[n];
    return n == above;
  }
  void let_go(std::size_t above) {
    for (const std::size_t n : std::vector(order_)) {
      if (n == above || !is_below(n, above)) continue;
      std::erase(order_, n);
      if (kIsLeaf[n] && said_[n] == kRunning) {
        go(n, "running");
        go(n, "done");
      }
      go(n, "start_");
    }
  }
  void settle(std::size_t n, LogStatus status) {
    call_above(n);
    if (now_.locations[n] == "start_") {
      let_go(kParents[n]);
      go(n, "tick_node");
    }
    let_go(n);
    std::erase(order_, n);
    if (status != kSkipped) now_.statuses[n] = word(status);
    go(n, word(status));
    go(n, "done");
    go(n, "start_");
  }

  MarkedLogWriter& writer_;
  Seen now_;
  std::vector<Seen> seen_;
  std::vector<std::size_t> order_;  // of those in their tick
  LogStatus said_[kCount] = {};
  // Has set its own status, and is to answer that.
  std::optional<std::pair<std::size_t, LogStatus>> has_set_;
};

TEST_CASE("a marked log is played as its marks say, state by state") {
  std::mt19937 random(11);
  const auto up_to = [&](std::size_t most) {
    return static_cast<std::size_t>(random() % (most + 1));
  };
  const auto some_answer = [&] {
    constexpr LogStatus kAll[] = {kRunning, kSuccess, kFailure, kSkipped};
    return kAll[random() % 4];
  };
  std::size_t states = 0;
  for (int i = 0; i < 400; ++i) {
    CAPTURE(i);
    MarkedLogWriter writer(kXml, {"battery", "sub/mode"});
    NaivePlayer naive(writer);
    for (std::size_t ticks = 1 + up_to(5); ticks > 0; --ticks) {
      if (up_to(3) == 0)
        naive.set(up_to(1), static_cast<int>(random() % 9) - 4);
      naive.begin_tick(up_to(4) == 0);
      for (std::size_t events = up_to(12); events > 0; --events) {
        const std::size_t node = 1 + up_to(kCount - 2);
        switch (up_to(5)) {
          case 0:
          case 1:
            naive.begin(node);
            break;
          case 2:
          case 3:
            naive.answer(node, some_answer());
            break;
          case 4: {
            constexpr LogStatus kAll[] = {kIdle, kRunning, kSuccess, kFailure};
            naive.change(node, kAll[random() % 4]);
            break;
          }
          default:
            naive.set(up_to(1), static_cast<std::int64_t>(random()));
        }
      }
      if (up_to(9) == 0) {
        naive.leave_tick();
      } else {
        naive.end_tick(some_answer());
      }
      if (up_to(3) == 0) naive.change(1 + up_to(kCount - 2), kIdle);
    }
    const Read made = read(writer);
    REQUIRE(made.found.empty());
    const std::vector<Seen> seen = played(made.log);
    REQUIRE(seen.size() == naive.seen().size());
    for (std::size_t s = 0; s < seen.size(); ++s) {
      CAPTURE(s);
      REQUIRE(seen[s].locations == naive.seen()[s].locations);
      REQUIRE(seen[s].statuses == naive.seen()[s].statuses);
      REQUIRE(seen[s] == naive.seen()[s]);
    }
    states += seen.size();
  }
  CHECK(states > 10'000);
}

// Three ticks: `look` runs, runs on twice, and then all goes well.
MarkedLogWriter some_ticks() {
  MarkedLogWriter writer(kXml, {"battery", "first/mode", "mode"});
  writer.set(0, std::int64_t{80});
  writer.begin_tick(10);
  writer.begin_node(1);
  writer.change(1, kRunning);
  writer.begin_node(2);
  writer.say(2, kRunning);
  writer.say(1, kRunning);
  writer.end_tick(kRunning);
  writer.begin_tick(100'000);
  writer.begin_node(1);
  writer.begin_node(2);
  writer.answer(2, kRunning);
  writer.answer(1, kRunning);
  writer.end_tick(kRunning);
  writer.tick_again(100'000, 40);
  writer.tick_again(100'000, 40);
  writer.set(0, 19.5);
  writer.set(2, std::string_view("go home"));
  writer.begin_tick(100'000, true);
  writer.begin_node(1);
  writer.begin_node(2);
  writer.say(2, kSuccess);
  writer.begin_node(3);
  writer.change(3, kRunning);
  writer.begin_node(4);
  writer.answer(4, kSkipped);
  writer.begin_node(5);
  writer.say(5, kSuccess);
  writer.change(5, kIdle);
  writer.say(3, kSuccess);
  writer.change(2, kIdle);
  writer.change(3, kIdle);
  writer.say(1, kSuccess);
  writer.end_tick(kSuccess);
  writer.change(1, kIdle);
  return writer;
}

TEST_CASE("ticks that come again are told as often as they do") {
  const MarkedLogWriter writer = some_ticks();
  const Read made = read(writer);
  REQUIRE(made.found.empty());
  const std::vector<Seen> seen = played(made.log);
  CHECK(seen.back().tick == 5);
  CHECK(seen.back().time == 5);
  CHECK(seen.back().values ==
        std::vector<std::string>{"19.5", "unset", "'go home'"});
  const auto answered = std::ranges::count_if(
      seen, [](const Seen& state) { return state.locations[2] == "running"; });
  CHECK(answered == 4);
  CHECK(ticks_of(made.log, {}) ==
        std::vector<std::int64_t>{1, 1, 5, 5, 5, 5, 5, 5, 5, 5, 5});
}

TEST_CASE("rules are exact over a marked log, and speak of entries") {
  const Read made = read(some_ticks());
  const std::string text =
      "property four: never look.running and previously look.answer == "
      "running\n"
      "property late: whenever look.ticked then look.success within 2 ticks\n"
      "property skipped: possible go.skipped\n"
      "property low: never battery < 20\n"
      "property full: never battery > 80\n"
      "property home: possible mode == go_home\n"
      "property inner: never first_mode != unset\n"
      "property point: possible battery == 19.5\n"
      "property other: never battery == 19\n"
      "property no_text: never mode > 3\n";
  const auto rules = read_properties("r.ltl", text);
  REQUIRE(rules.value);
  const SourceText source("r.ltl", text);
  const auto report = watch_log("a.btlog", made.log, {}, *rules.value, source);
  for (const Diagnostic& found : report.diagnostics) MESSAGE(render(found));
  REQUIRE(report.value);
  CHECK(report.value->heading == "a.btlog: 5 nodes, 11 records, 5 ticks");
  const auto said = [&](std::size_t rule) {
    const WatchedRule& found = report.value->rules[rule];
    const auto outlook = static_cast<std::size_t>(found.outlook);
    return fmt::format("{} {}", kOutlookNames[outlook], moment_text(found));
  };
  CHECK(said(0) == "VIOLATED record 2, tick 2, after 0.100060 s");
  CHECK(said(1).starts_with("VIOLATED record 2, tick 3"));
  CHECK(said(2).starts_with("SATISFIED record 4, tick 5"));
  CHECK(said(3).starts_with("VIOLATED record 2, tick 5"));
  CHECK(said(4) == "OPEN ");
  CHECK(said(5).starts_with("SATISFIED record 2, tick 5"));
  CHECK(said(6) == "OPEN ");
  CHECK(said(7).starts_with("SATISFIED"));
  CHECK(said(8) == "OPEN ");
  CHECK(said(9) == "OPEN ");

  const std::string beside = "property p: never mode == first_mode\n";
  const auto refused = read_properties("r.ltl", beside);
  const auto none = watch_log("a.btlog", made.log, {}, *refused.value,
                              SourceText("r.ltl", beside));
  REQUIRE_FALSE(none.value);
  CHECK(none.diagnostics.at(0).code == "BT1805");
  CHECK(none.diagnostics.at(0).message ==
        "entries of a log are not compared with each other: `mode == "
        "first_mode`");
}

TEST_CASE("a marked log as text has its ticks, what is skipped, and entries") {
  const std::string text = log_text(read(some_ticks()).log);
  CHECK(text.find("battery := 80\n\ntick 1, after 0.000010 s\n") !=
        std::string::npos);
  CHECK(text.find("tick 3, after ") != std::string::npos);
  CHECK(text.find("tick 5, after 0.400190 s, woken up\n") != std::string::npos);
  CHECK(text.find("  mode := 'go home'\n") != std::string::npos);
  CHECK(text.find("    4 go is skipped\n") != std::string::npos);
  MarkedLogWriter thrown(kXml);
  thrown.begin_tick();
  thrown.begin_node(1);
  thrown.leave_tick("no\nport");
  const std::string left = log_text(read(thrown).log);
  CHECK(left.find("left by an exception: no") != std::string::npos);
}

std::string codes(const std::vector<Diagnostic>& found) {
  std::string text;
  for (const Diagnostic& each : found) {
    text += fmt::format("{}{}", text.empty() ? "" : " ", each.code);
  }
  return text;
}

TEST_CASE("marks that are cut off end before the event, at every byte") {
  const MarkedLogWriter writer = some_ticks();
  const std::vector<Seen> whole = played(read(writer).log);
  std::size_t last = 0;
  for (std::size_t size = 0; size <= writer.marks().size(); ++size) {
    CAPTURE(size);
    const Read cut = read(writer.log(), writer.marks().substr(0, size));
    if (size < writer.heading()) {
      CHECK(codes(cut.found) == "BT1303");
      CHECK_FALSE(cut.log.marks);
      CHECK(cut.log.transitions.size() == 11);
      continue;
    }
    for (const Diagnostic& found : cut.found) {
      CHECK(found.severity == Severity::Warning);
      CHECK(found.code == "BT1304");
    }
    REQUIRE(cut.log.marks);
    const std::vector<Seen> seen = played(cut.log);
    REQUIRE(seen.size() <= whole.size());
    CHECK(seen.size() >= last);
    CHECK(std::ranges::equal(seen, std::span(whole).first(seen.size())));
    CHECK_FALSE(log_text(cut.log).empty());
    last = seen.size();
  }
  CHECK(last == whole.size());
  // The log is the shorter one.
  for (std::size_t size = writer.log().size() - 99; size < writer.log().size();
       ++size) {
    const Read cut = read(writer.log().substr(0, size), writer.marks());
    CHECK(codes(cut.found) == "BT1304");
    const std::vector<Seen> seen = played(cut.log);
    CHECK(std::ranges::equal(seen, std::span(whole).first(seen.size())));
  }
}

TEST_CASE("damaged marks are named, and no byte makes the reader stop") {
  const auto said = [](const std::string& bytes, const auto& change) {
    MarkedLogWriter writer(kXml, {"battery"});
    writer.begin_tick();
    writer.add(bytes);
    std::string marks = writer.marks();
    change(marks);
    const Read found = read(writer.log(), marks);
    REQUIRE(found.found.size() == 1);
    return found.found[0].code + " " + found.found[0].message;
  };
  const auto as_it_is = [](std::string&) {};
  CHECK(
      said("\14", as_it_is).starts_with("BT1303 the marks are damaged: byte "));
  CHECK(said("\1\1", as_it_is).ends_with("a tick begins within another"));
  CHECK(
      said("\5\11", as_it_is).ends_with("the tree has no node with the uid 9"));
  CHECK(said("\6\1\5", as_it_is).ends_with("there is no answer 5"));
  CHECK(said(std::string("\6\1\0", 3), as_it_is)
            .ends_with("there is no answer 0"));
  CHECK(said("\10\1\1", as_it_is).ends_with("there is no entry 1"));
  CHECK(said(std::string("\10\0\6", 3), as_it_is)
            .ends_with("an entry has a value of a kind that is not known"));
  CHECK(said("\3\1\2\3\1\2", as_it_is)
            .ends_with("a tick ends that has not begun"));
  CHECK(said("\11\1\1", as_it_is)
            .ends_with("a tick comes again that was not there before"));
  CHECK(said("\3\1\2\5\1", as_it_is)
            .ends_with("a node is ticked outside of a tick"));
  CHECK(said("\5" + std::string(11, '\xff'), as_it_is)
            .ends_with("a number is too long"));
  CHECK(said("", [](std::string& marks) { marks[0] = 'x'; }) ==
        "BT1302 this file has no marks of btcheck::observer");
  CHECK(said("", [](std::string& marks) { marks[13] = 2; }) ==
        "BT1302 the marks have version 2; version 1 is known");
  CHECK(said("", [](std::string& marks) {
          marks[14] = 5;
        }).ends_with("they are of engine 5"));
  CHECK(said("", [](std::string& marks) { ++marks[15]; }) ==
        "BT1312 these marks are of another log: it began at another time");
  CHECK(said("", [](std::string& marks) { ++marks[23]; }) ==
        "BT1312 these marks are of another log: its tree is another");

  // An entry changes in a tick, so it cannot come again.
  MarkedLogWriter writer(kXml, {"battery"});
  writer.begin_tick();
  writer.set_kind(0, 5);
  writer.end_tick(kRunning);
  writer.tick_again(1, 1);
  CHECK(codes(read(writer).found) == "BT1303");

  MarkedLogWriter lost(kXml);
  lost.begin_tick();
  lost.end_tick(kRunning);
  lost.lose();
  lost.begin_tick();
  const Read found = read(lost);
  CHECK(codes(found.found) == "BT1313");
  CHECK(played(found.log).back().tick == 1);

  std::mt19937 random(8);
  const MarkedLogWriter good = some_ticks();
  for (int i = 0; i < 3000; ++i) {
    std::string marks = good.marks();
    for (auto flaws = 1 + random() % 3; flaws > 0; --flaws) {
      marks[good.heading() + random() % (marks.size() - good.heading())] =
          static_cast<char>(random());
    }
    const Read read_so = read(good.log(), marks);
    if (!read_so.log.marks) continue;
    const auto seen = played(read_so.log);
    CHECK(!log_text(read_so.log).empty());
    CHECK(!seen.empty());
  }
}

TEST_CASE("a marked log that grows says of rules what the whole one says") {
  const MarkedLogWriter writer = some_ticks();
  const std::string text =
      "property late: whenever look.ticked then look.success within 2 ticks\n"
      "property low: never battery < 20\n";
  const auto asked = [&] {
    std::vector<LiveRules> rules;
    rules.push_back(
        {*read_properties("r.ltl", text).value, SourceText("r.ltl", text)});
    return rules;
  };
  LiveLog whole("a.btlog", {}, "", asked());
  REQUIRE(whole.take(writer.log(), &writer.marks()).empty());
  REQUIRE(whole.verdicts().size() == 2);
  CHECK(whole.verdicts()[0].verdict == "VIOLATED");
  CHECK(whole.verdicts()[1].verdict == "VIOLATED");
  CHECK(whole.verdicts()[0].state < whole.verdicts()[1].state);
  CHECK(whole.is_broken());
  LiveLog growing("a.btlog", {}, "", asked());
  bool was_open = false;
  for (std::size_t size = writer.heading(); size <= writer.marks().size();
       ++size) {
    const std::string marks = writer.marks().substr(0, size);
    REQUIRE(growing.take(writer.log(), &marks).empty());
    was_open |= growing.verdicts()[0].verdict == "OPEN";
  }
  CHECK(was_open);
  // As far as pages go to it, the state is that of its record and tick.
  REQUIRE(growing.verdicts().size() == whole.verdicts().size());
  for (std::size_t i = 0; i < whole.verdicts().size(); ++i) {
    CHECK(growing.verdicts()[i].verdict == whole.verdicts()[i].verdict);
    CHECK(growing.verdicts()[i].moment == whole.verdicts()[i].moment);
    CHECK(growing.verdicts()[i].state <= whole.verdicts()[i].state);
  }
}

}  // namespace
}  // namespace btcheck::marked_log_test

// SPDX-License-Identifier: MIT
//
// A thread follows each robot; this one prints, and hears of signals and of the
// Enter key.
#include "cli/robots/watch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "cli/console/console.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/process_limits.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/options/tables.hpp"
#include "cli/options/words.hpp"
#include "cli/outputs/open_view.hpp"
#include "cli/robots/board.hpp"
#include "cli/robots/robot_teller.hpp"
#include "groot2/link.hpp"
#include "groot2/robot.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

constexpr std::chrono::milliseconds kLook{20};

std::vector<groot2::Address> addresses_of(const Options& options) {
  std::vector<groot2::Address> addresses;
  for (const std::string& word : options.inputs) {
    auto read = groot2::address_in(word);
    if (!read.address) {
      refuse(fmt::format("`{}`: {}", word, read.flaw),
             "btcheck watch groot2://robot:1667");
    }
    if (std::ranges::count(addresses, *read.address) > 0) {
      refuse(fmt::format("`{}` is given twice", word), "leave out one of them");
    }
    addresses.push_back(std::move(*read.address));
  }
  return addresses;
}

std::vector<groot2::Fault> faults_of(const RobotPlan& plan) {
  std::vector<groot2::Fault> faults;
  const auto add = [&](std::string_view option, const std::string& word,
                       groot2::ReadFault read) {
    if (!read.fault) {
      refuse(fmt::format("{} '{}' is not understood", option, word), read.flaw);
    }
    faults.push_back(std::move(*read.fault));
  };
  for (const std::string& word : plan.faults) {
    add("--inject", word, groot2::fault_in(word));
  }
  for (const std::string& word : plan.breaks) {
    add("--break", word, groot2::break_in(word));
  }
  return faults;
}

// A robot, and the thread that follows it.
class Followed {
 public:
  Followed(groot2::Context& context, const groot2::Address& address,
           const WatchPlan& plan, std::vector<LiveRules> rules, Board& board,
           std::function<void(LiveRun&)> show)
      : address_(address),
        teller_(address, plan, std::move(rules), board, std::move(show)),
        robot_(context, address, plan.following, teller_),
        thread_([this] { follow(); }) {}
  ~Followed() {
    teller_.end();
    thread_.join();
  }
  Followed(const Followed&) = delete;
  Followed& operator=(const Followed&) = delete;

  RobotTeller& teller() { return teller_; }
  bool is_over() const { return is_over_; }

  // What it comes to, once it is over.
  ExitCode judge(const Options& options) {
    ExitCode code = teller_.is_broken() ? ExitCode::Missed : ExitCode::Met;
    if (!teller_.complaint().empty()) complain("BT0004", teller_.complaint());
    if (!teller_.was_met() && found_.empty()) {
      found_.push_back(file_error(
          "BT1901", "groot2://" + address_.text(), "nobody answered there",
          "start the program, and look at the address: its port is that of "
          "the Groot2Publisher"));
    }
    show(options, found_);
    if (has_error(found_) || !teller_.complaint().empty()) {
      code = ExitCode::BadInput;
    }
    return code;
  }

 private:
  void follow() {
    try {
      found_ = robot_.follow();
    } catch (const std::exception& fault) {
      found_ = {file_error("BT9002", "groot2://" + address_.text(),
                           fmt::format("internal error: {}", fault.what()))};
    }
    teller_.close();
    is_over_ = true;
  }

  const groot2::Address address_;
  RobotTeller teller_;
  groot2::Robot robot_;
  std::vector<Diagnostic> found_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

// Whether a line was entered since the last look, or there will be none.
bool has_entered() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::poll(&input, 1, 0) <= 0) return false;
  std::array<char, 256> line;
  const ssize_t count = ::read(STDIN_FILENO, line.data(), line.size());
  return count <= 0 || std::count(line.data(), line.data() + count, '\n') > 0;
}

void print_lines(const Options& options, Board& board,
                 std::chrono::milliseconds patience) {
  const auto lines = board.take(patience);
  for (const Board::Line& line : lines) {
    if (line.is_result) {
      print(line.text);
      flush_output();
    } else if (!options.is_quiet) {
      tell(line.text);
    }
  }
}

// Until it is interrupted, a limit is reached or all robots are done with;
// returns the limit.
StopReason watch_all(const Options& options, Board& board,
                     std::vector<std::unique_ptr<Followed>>& robots) {
  for (;;) {
    print_lines(options, board, kLook);
    const StopReason reason = limits_of_command().reached();
    if (reason != StopReason::None) return reason;
    if (InterruptWatch::is_interrupted()) return StopReason::Interrupted;
    if (std::ranges::all_of(
            robots, [](const auto& robot) { return robot->is_over(); })) {
      return StopReason::None;
    }
    const bool one_stands = std::ranges::any_of(
        robots, [](const auto& robot) { return robot->teller().stands(); });
    if (!one_stands || options.robots.break_ms || !has_entered()) continue;
    for (const auto& robot : robots) robot->teller().let_go();
  }
}

}  // namespace

ExitCode watch_robots(const Options& options, const LogReading& reading,
                      const RulesFor& rules_for) {
  const std::vector<groot2::Address> addresses = addresses_of(options);
  WatchPlan plan;
  plan.following.faults = faults_of(options.robots);
  std::vector<std::string> names;
  std::vector<std::vector<LiveRules>> rules;
  for (const groot2::Address& address : addresses) {
    names.push_back("groot2://" + address.text());
    auto read = rules_for(names.back());
    if (!read) return ExitCode::BadInput;
    rules.push_back(std::move(*read));
  }
  plan.reading = reading;
  plan.output = options.output;
  plan.robots = addresses.size();
  plan.tells_records = rules[0].empty() && plan.output.empty() && !options.view;
  plan.is_shown = options.view.has_value();
  plan.following.asks_for_entries = plan.is_shown;
  plan.following.reading = plan.reading;
  if (options.robots.break_ms) {
    plan.break_time = std::chrono::milliseconds(*options.robots.break_ms);
  }
  Guard::dismiss();
  const BudgetScope own_way(nullptr);
  Board board;
  groot2::Context context;
  // The server is gone before their runs are.
  std::vector<std::unique_ptr<Followed>> robots;
  LiveServer server(names);
  if (options.view && !open_view(options, server)) return ExitCode::BadInput;
  // Signals are for this thread.
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  for (std::size_t i = 0; i < addresses.size(); ++i) {
    std::function<void(LiveRun&)> to_server;
    if (options.view) {
      to_server = [&server, i](LiveRun& run) { server.show(i, run); };
    }
    robots.push_back(std::make_unique<Followed>(context, addresses[i], plan,
                                                std::move(rules[i]), board,
                                                std::move(to_server)));
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  const StopReason reason = watch_all(options, board, robots);
  for (const auto& robot : robots) robot->teller().end();
  while (!std::ranges::all_of(
      robots, [](const auto& robot) { return robot->is_over(); })) {
    print_lines(options, board, kLook);
  }
  print_lines(options, board, std::chrono::milliseconds(0));
  if (options.view) server.finish(kViewPatience);
  ExitCode code = ExitCode::Met;
  for (const auto& robot : robots) {
    code = worst_of(code, robot->judge(options));
  }
  if (reason == StopReason::Memory && code == ExitCode::Met) {
    complain("BT9003", "watching takes more memory than --memory allows");
    return ExitCode::Undecided;
  }
  return code;
}

}  // namespace btcheck

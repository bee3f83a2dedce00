// SPDX-License-Identifier: MIT
//
// A child process that is spoken to in lines: its standard input and output are
// ours, its standard error is where ours is.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace btcheck {

class LineProcess {
 public:
  using Clock = std::chrono::steady_clock;

  // Runs the command with `/bin/sh -c`, in a process group of its own, so that
  // Ctrl-C at a terminal does not reach it.
  explicit LineProcess(const std::string& command);
  // Ends the whole group.
  ~LineProcess();
  LineProcess(const LineProcess&) = delete;
  LineProcess& operator=(const LineProcess&) = delete;

  // Why it could not be started, or "".
  const std::string& error() const { return error_; }

  enum class Sent : std::uint8_t { Yes, Late, Gone };
  // A line, without its newline. Late: it does not read.
  Sent send(std::string line, Clock::time_point until);

  enum class Got : std::uint8_t {
    Line,
    Late,
    Gone,    // the end of what it writes
    TooLong  // more than kMostBytes without a newline
  };
  // The next line, without its newline; with a time that is over only what has
  // arrived.
  Got receive(std::string& line, Clock::time_point until);
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20;

  // Closes its input and waits so long for it to end.
  void close(std::chrono::milliseconds patience);
  // "has ended with exit code 1", "was ended by signal 9", "has closed its
  // output". Waits, once, for what has closed its output to end.
  std::string ending();

 private:
  bool is_running();
  bool wait_for(int file, short event, Clock::time_point until) const;

  std::string error_;
  pid_t process_ = -1;
  int input_ = -1;   // that it reads
  int output_ = -1;  // that it writes
  int status_ = 0;   // once it has ended
  bool has_ended_ = false;
  bool has_waited_ = false;  // for its end
  std::string read_;         // and not yet handed out
};

}  // namespace btcheck

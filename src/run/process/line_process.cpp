// SPDX-License-Identifier: MIT
//
// Both pipes are read and written without blocking, so that a child that
// neither reads nor writes costs a deadline and not the tick.
#include "run/process/line_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

extern char** environ;

namespace btcheck {
namespace {

constexpr std::chrono::milliseconds kLook{5};     // while it is waited for
constexpr std::chrono::milliseconds kMercy{500};  // between two signals

void close_file(int& file) {
  if (file >= 0) ::close(file);
  file = -1;
}

// Writing to who has gone is an error, and no signal that ends us.
class NoBrokenPipe {
 public:
  NoBrokenPipe() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoBrokenPipe() {
    const timespec at_once{0, 0};
    while (::sigtimedwait(&pipe_, nullptr, &at_once) > 0) {
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  sigset_t pipe_{};
  sigset_t before_{};
};

// The command as a process, with these two as its input and output; 0, or what
// went wrong.
int spawn(const std::string& command, int input, int output, pid_t& process) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP |
                                              POSIX_SPAWN_SETSIGMASK |
                                              POSIX_SPAWN_SETSIGDEF);
  std::string shell = "sh";
  std::string option = "-c";
  std::string words = command;
  char* arguments[] = {shell.data(), option.data(), words.data(), nullptr};
  const int fault = ::posix_spawn(&process, "/bin/sh", &files, &attributes,
                                  arguments, environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  return fault;
}

}  // namespace

LineProcess::LineProcess(const std::string& command) {
  std::array<int, 2> to{-1, -1};
  std::array<int, 2> from{-1, -1};
  if (::pipe2(to.data(), O_CLOEXEC) != 0 ||
      ::pipe2(from.data(), O_CLOEXEC) != 0) {
    error_ = std::strerror(errno);
  } else if (const int fault = spawn(command, to[0], from[1], process_)) {
    error_ = std::strerror(fault);
    process_ = -1;
  }
  close_file(to[0]);
  close_file(from[1]);
  input_ = to[1];
  output_ = from[0];
  if (input_ >= 0) ::fcntl(input_, F_SETFL, O_NONBLOCK);
  if (output_ >= 0) ::fcntl(output_, F_SETFL, O_NONBLOCK);
}

LineProcess::~LineProcess() {
  close_file(input_);
  close_file(output_);
  if (process_ <= 0) return;
  for (const int signal : {SIGTERM, SIGKILL}) {
    if (has_ended_ && signal == SIGTERM) continue;
    ::kill(-process_, signal);
    const Clock::time_point until = Clock::now() + kMercy;
    while (is_running() && Clock::now() < until) {
      std::this_thread::sleep_for(kLook);
    }
  }
}

bool LineProcess::wait_for(int file, short event,
                           Clock::time_point until) const {
  while (true) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    pollfd asked{file, event, 0};
    const int most = static_cast<int>(
        std::clamp<std::int64_t>(left.count(), 0, std::int64_t{1} << 30));
    const int ready = ::poll(&asked, 1, most);
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

LineProcess::Sent LineProcess::send(std::string line, Clock::time_point until) {
  if (input_ < 0) return Sent::Gone;
  const NoBrokenPipe quiet;
  line += '\n';
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t count = ::write(input_, rest.data(), rest.size());
    if (count > 0) {
      rest.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      if (!wait_for(input_, POLLOUT, until)) {
        // A half-written line could not be told from the next one.
        if (rest.size() < line.size()) close_file(input_);
        return Sent::Late;
      }
    } else if (errno != EINTR) {
      close_file(input_);
      return Sent::Gone;
    }
  }
  return Sent::Yes;
}

LineProcess::Got LineProcess::receive(std::string& line,
                                      Clock::time_point until) {
  std::array<char, 4096> block;
  std::size_t looked = 0;
  while (true) {
    const std::size_t end = read_.find('\n', looked);
    if (end != std::string::npos) {
      line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return Got::Line;
    }
    looked = read_.size();
    if (read_.size() > kMostBytes) {
      read_.clear();
      return Got::TooLong;
    }
    if (output_ < 0) return Got::Gone;
    const ssize_t count = ::read(output_, block.data(), block.size());
    if (count > 0) {
      read_.append(block.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
      close_file(output_);
    } else if (errno == EAGAIN && !wait_for(output_, POLLIN, until)) {
      return Got::Late;
    }
  }
}

void LineProcess::close(std::chrono::milliseconds patience) {
  close_file(input_);
  const Clock::time_point until = Clock::now() + patience;
  std::string line;
  while (is_running() && Clock::now() < until) {
    receive(line, Clock::now() + kLook);  // it may be waiting to be read
    std::this_thread::sleep_for(kLook);
  }
}

bool LineProcess::is_running() {
  if (process_ <= 0 || has_ended_) return false;
  has_ended_ = ::waitpid(process_, &status_, WNOHANG) == process_;
  return !has_ended_;
}

// The end of its output is seen a moment before its own.
std::string LineProcess::ending() {
  const Clock::time_point until =
      Clock::now() +
      (std::exchange(has_waited_, true) ? Clock::duration::zero() : kMercy);
  while (is_running() && Clock::now() < until) {
    std::this_thread::sleep_for(kLook);
  }
  if (!has_ended_) return "has closed its output";
  if (WIFSIGNALED(status_)) {
    return fmt::format("was ended by signal {}", WTERMSIG(status_));
  }
  return fmt::format("has ended with exit code {}", WEXITSTATUS(status_));
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// A program that runs beside the test, to be interrupted or killed.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace btcheck {

struct Ending {
  int code = -1;         // of the exit; -1 when a signal was the end
  int signal = 0;        // that ended it
  double seconds = 0;    // from the last signal sent to the end
  double processor = 0;  // seconds of it, in all
  std::uint64_t peak_bytes = 0;
};

class ChildProcess {
 public:
  // Runs words[0] in a folder; its stdout and stderr go to files there.
  // Those of a program before it are gone: what is there, this one has told.
  ChildProcess(std::vector<std::string> words, const std::string& folder) {
    for (const char* name : {"/stdout", "/stderr"}) {
      ::unlink((folder + name).c_str());
    }
    child_ = ::fork();
    if (child_ < 0) throw std::system_error(errno, std::generic_category());
    if (child_ == 0) become(words, folder);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }

  pid_t id() const { return child_; }

  void send(int signal) {
    sent_ = std::chrono::steady_clock::now();
    ::kill(child_, signal);
  }

  Ending wait() {
    int status = 0;
    rusage usage{};
    if (::wait4(child_, &status, 0, &usage) < 0) {
      throw std::system_error(errno, std::generic_category());
    }
    child_ = -1;
    Ending ending;
    if (WIFEXITED(status)) ending.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
    ending.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - sent_)
            .count();
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) +
             static_cast<double>(time.tv_usec) * 1e-6;
    };
    ending.processor = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    ending.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return ending;
  }

 private:
  [[noreturn]] static void become(std::vector<std::string>& words,
                                  const std::string& folder) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const bool is_there = ::chdir(folder.c_str()) == 0 &&
                          opens(STDOUT_FILENO, "stdout") &&
                          opens(STDERR_FILENO, "stderr");
    if (is_there) ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  static bool opens(int descriptor, const char* file) {
    const int opened = ::open(file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    return opened >= 0 && ::dup2(opened, descriptor) >= 0;
  }

  pid_t child_ = -1;
  std::chrono::steady_clock::time_point sent_ =
      std::chrono::steady_clock::now();
};

}  // namespace btcheck

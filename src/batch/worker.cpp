// SPDX-License-Identifier: MIT
#include "batch/worker.hpp"

#include <fcntl.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

namespace btcheck {
namespace {

[[noreturn]] void fail() {
  throw std::system_error(errno, std::generic_category());
}

// Its end to read from, and that to write to.
std::array<int, 2> new_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail();
  return ends;
}

}  // namespace

Worker::Worker(std::size_t entry, const Work& work)
    : Worker(entry, work, new_pipe()) {}

Worker::Worker(std::size_t entry, const Work& work, std::array<int, 2> ends)
    : entry_(entry), output_(ends[0]) {
  const OpenFile input(ends[1]);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) fail();
  if (process_ > 0) return;
  ::setpgid(0, 0);  // Ctrl-C is for the batch, which tells its workers
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  const bool is_wanted = ::getppid() == parent;  // not killed already
  // What is thrown must not get into the batch's own code, of which this is a
  // copy: it ends the process.
  const auto run = [&]() noexcept { work(input); };
  if (is_wanted) run();
  ::_exit(0);
}

Worker::~Worker() {
  if (process_ > 0) end();
}

void Worker::cancel() {
  if (!std::exchange(is_cancelled_, true)) ::kill(process_, SIGTERM);
}

bool Worker::read() {
  char block[1 << 16];
  const ssize_t count = output_.read(block);
  if (count > 0) text_.append(block, static_cast<std::size_t>(count));
  return count > 0;
}

int Worker::end() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace btcheck

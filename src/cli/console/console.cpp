// SPDX-License-Identifier: MIT
#include "cli/console/console.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ostream>
#include <sstream>
#include <system_error>

#include "text/utf8.hpp"

namespace btcheck {
namespace {

[[noreturn]] void fail(int reason) {
  throw std::system_error(reason, std::generic_category());
}

// Prints what was put into it when it is flushed.
class PrintingBuffer : public std::stringbuf {
 protected:
  int sync() override {
    print(view());
    str({});
    flush_output();
    return 0;
  }
};

class PrintingStream : public std::ostream {
 public:
  PrintingStream() : std::ostream(&buffer_) { exceptions(badbit); }
  ~PrintingStream() override {
    try {
      flush();
    } catch (const std::system_error&) {
      // flush_output throws again at the end of the program.
    }
  }

 private:
  PrintingBuffer buffer_;
};

}  // namespace

void open_standard_files() {
  // Each the other way round: reading from what was closed fails, and so does
  // writing.
  constexpr int kModes[] = {O_WRONLY, O_RDONLY, O_RDONLY};
  for (int file = 0; file < 3; ++file) {
    if (::fcntl(file, F_GETFD) >= 0) continue;
    // The lowest number that is free: this one.
    if (::open("/dev/null", kModes[file]) < 0) return;
  }
}

void print(std::string_view text) { print_exactly(harmless(text)); }

void print_exactly(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
    fail(errno);
  }
}

void tell(std::string_view text) { tell_exactly(harmless(text)); }

void tell_exactly(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

std::size_t terminal_width() {
  winsize size{};
  const bool is_terminal = ::isatty(STDOUT_FILENO) != 0 &&
                           ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0;
  return is_terminal ? std::max<std::size_t>(size.ws_col, kLineWidth)
                     : kLineWidth;
}

void flush_output() {
  if (std::fflush(stdout) != 0) fail(errno);
  if (std::ferror(stdout) != 0) fail(EIO);  // some time ago
}

std::unique_ptr<std::ostream> printing_stream() {
  return std::make_unique<PrintingStream>();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "cli/console/console.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <ostream>
#include <sstream>
#include <system_error>

#include "cli/console/writing.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// What .NET takes for white, of what `harmless` leaves.
bool is_white(char32_t c) {
  return c == ' ' || c == '\t' || c == 0xA0 || c == 0x1680 ||
         (c >= 0x2000 && c <= 0x200A) || c == 0x202F || c == 0x205F ||
         c == 0x3000;
}

// `##[`, `##vso[`.
bool begins_order(std::string_view text) {
  if (!text.starts_with("##")) return false;
  std::size_t at = 2;
  while (at < text.size() && is_letter(text[at])) ++at;
  return at < text.size() && text[at] == '[';
}

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

std::string readable(std::string_view text) {
  const std::string clean = harmless(text);
  const std::string_view rest = clean;
  std::string result;
  result.reserve(clean.size());
  bool is_first = true;  // of its line, but for blanks
  for (std::size_t at = 0; at < rest.size();) {
    const CodePoint point = decode(rest, at);
    const std::string_view here = rest.substr(at);
    if (is_first && here.starts_with("::")) {
      result += "\\u{3a}";
    } else if (begins_order(here)) {
      result += "\\u{23}";
    } else {
      result += here.substr(0, point.length);
    }
    is_first = point.value == '\n' || (is_first && is_white(point.value));
    at += point.length;
  }
  return result;
}

void print(std::string_view text) { print_exactly(readable(text)); }

std::timed_mutex& output_mutex() {
  static std::timed_mutex mutex;
  return mutex;
}

void print_exactly(std::string_view text) {
  const std::scoped_lock writing(output_mutex());
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
    fail(errno);
  }
}

void tell(std::string_view text) { tell_exactly(readable(text)); }

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

bool is_dumb_terminal() {
  const char* terminal = std::getenv("TERM");
  return terminal == nullptr || terminal == std::string_view("dumb");
}

}  // namespace btcheck

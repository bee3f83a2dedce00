// SPDX-License-Identifier: MIT
//
// Reading is bounded, writing is all or nothing.
#include "cli/inputs/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "cli/console/writing.hpp"
#include "cli/inputs/looked_at.hpp"
#include "cli/options/options.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

Result<InputFile> refused(const std::string& name, std::string message,
                          std::string help = {}) {
  return {std::nullopt,
          {file_error("BT0002", name, std::move(message), std::move(help))}};
}

// A file must not take the place of /dev/stderr, even where that leads to an
// ordinary file, nor of a pipe.
bool is_device(const std::string& name) {
  std::error_code fault;
  const auto kind = std::filesystem::status(name, fault).type();
  return name.starts_with("/dev/") ||
         kind == std::filesystem::file_type::fifo ||
         kind == std::filesystem::file_type::character;
}

// Where a file lies, once links are followed. Hidden is what a name with a dot
// at its beginning leads to below the root, `.git/config` for instance.
enum class Place : std::uint8_t { Outside, Hidden, Inside };

Place place_in(const std::filesystem::path& root,
               const std::filesystem::path& file) {
  std::error_code fault;
  const auto folder = std::filesystem::weakly_canonical(
      std::filesystem::absolute(root, fault), fault);
  // Of what does not exist a relative name would stay one.
  const auto place = std::filesystem::weakly_canonical(
      std::filesystem::absolute(file, fault), fault);
  const auto [end, rest] = std::ranges::mismatch(folder, place);
  // `DIR/` has an empty name at its end.
  const bool is_in = end == folder.end() || end->empty();
  if (fault || !is_in) return Place::Outside;
  return std::any_of(
             rest, place.end(),
             [](const auto& name) { return name.string().starts_with('.'); })
             ? Place::Hidden
             : Place::Inside;
}

std::string cannot_write(const std::string& name) {
  return fmt::format("cannot write `{}`: {}", name, std::strerror(errno));
}

// To the end of a file that may be there. Returns what went wrong, or "".
std::string put(const std::string& name, const std::string& text, int flags) {
  const OpenFile file(name, flags | O_WRONLY);
  const bool is_written = file.is_open() && file.write(text);
  return is_written ? std::string() : cannot_write(name);
}

}  // namespace

OpenFile::OpenFile(const std::string& name, int flags)
    : file_(::open(name.c_str(), flags | O_CLOEXEC | O_NOCTTY, 0666)) {}

OpenFile::~OpenFile() {
  if (file_ >= 0) ::close(file_);
}

mode_t OpenFile::mode() const {
  struct stat status {};
  return ::fstat(file_, &status) == 0 ? status.st_mode : 0;
}

ssize_t OpenFile::read(std::span<char> block) const {
  ssize_t count = 0;
  do {
    count = ::read(file_, block.data(), block.size());
  } while (count < 0 && errno == EINTR);
  return count;
}

bool OpenFile::write(std::string_view text) const {
  while (!text.empty()) {
    const auto count = ::write(file_, text.data(), text.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

// Read to its end, however long that takes.
bool is_given(const std::string& name) {
  return name == kStandardInput || name == "/dev/stdin" ||
         name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/");
}

Result<InputFile> read_file(const std::string& name) {
  if (!is_given(name)) LookedAt::note_file(name);
  if (unbroken(name) != name) {
    return refused(name, fmt::format("`{}` has a line break in its name", name),
                   "give the file or its folder another name");
  }
  const OpenFile stream(name == kStandardInput ? "/dev/stdin" : name,
                        is_given(name) ? O_RDONLY : O_RDONLY | O_NONBLOCK);
  if (!stream.is_open()) {
    const int reason = errno;
    return refused(name, reason == ENOENT || reason == ENOTDIR
                             ? fmt::format("cannot find `{}`", name)
                             : fmt::format("cannot read `{}`: {}", name,
                                           std::strerror(reason)));
  }
  if (S_ISDIR(stream.mode())) {
    return refused(name, fmt::format("`{}` is a directory", name),
                   "name a file in it");
  }
  if (!S_ISREG(stream.mode()) && !is_given(name)) {
    return refused(name, fmt::format("`{}` is a pipe or a device", name),
                   "name a file, or - for standard input");
  }
  std::string text;
  std::vector<char> block(1 << 16);
  for (ssize_t count; (count = stream.read(block)) != 0;) {
    if (count < 0) {
      return refused(name, fmt::format("cannot read `{}`: {}", name,
                                       std::strerror(errno)));
    }
    text.append(block.data(), static_cast<std::size_t>(count));
    if (text.size() > kMostInputBytes) {
      return refused(name, fmt::format("`{}` is larger than 64 MiB, the most "
                                       "that is read of a file",
                                       name));
    }
  }
  return {InputFile{name, std::move(text)}, {}};
}

std::optional<Diagnostic> refusal_outside(const std::vector<std::string>& roots,
                                          const std::string& name) {
  if (roots.empty()) return {};
  const std::string* hidden_in = nullptr;
  for (const std::string& root : roots) {
    const Place place = place_in(root, name);
    if (place == Place::Inside) return {};
    if (place == Place::Outside) continue;
    hidden_in = hidden_in == nullptr ? &root : hidden_in;
  }
  return file_error(
      "BT0009", name,
      hidden_in != nullptr
          ? fmt::format("`{}` is hidden in `{}`", name, *hidden_in)
          : fmt::format("`{}` is outside of `{}`", name, roots[0]),
      "--root names a folder whose files may be read");
}

Result<InputFile> read_file_in(const std::vector<std::string>& roots,
                               const std::string& name) {
  auto refused = refusal_outside(roots, name);
  if (refused) return {std::nullopt, {std::move(*refused)}};
  return read_file(name);
}

std::string write_file(const std::string& name, const std::string& text) {
  return is_device(name) ? put(name, text, O_APPEND) : replace_file(name, text);
}

namespace {

// Opens a new file beside the one that is meant, and says how it is called.
// Nobody has that name: neither another process, on another machine perhaps,
// nor somebody who has put a link there. Where it is not open, errno says why.
std::string open_beside(const std::string& name,
                        std::optional<OpenFile>& file) {
  static std::atomic<std::uint64_t> count = 0;
  std::string temporary;
  do {
    temporary = fmt::format("{}.{}-{}.tmp", name, ::getpid(), ++count);
    file.emplace(temporary, O_WRONLY | O_CREAT | O_EXCL);
  } while (!file->is_open() && errno == EEXIST);
  return temporary;
}

// Gives the temporary file its name, or removes it.
std::string put_under(const std::string& name, const std::string& temporary) {
  std::error_code fault;
  std::filesystem::rename(temporary, name, fault);
  if (!fault) return {};
  std::remove(temporary.c_str());
  return fmt::format("cannot write `{}`: {}", name, fault.message());
}

// With these permissions, or those that a new file has.
std::string put_in_place(const std::string& name, const std::string& text,
                         std::optional<mode_t> mode) {
  const std::scoped_lock writing(output_mutex());
  std::optional<OpenFile> file;
  const std::string temporary = open_beside(name, file);
  if (!file->is_open() || (mode && ::fchmod(file->number(), *mode) != 0) ||
      !file->write(text)) {
    const std::string complaint = cannot_write(name);
    std::remove(temporary.c_str());
    return complaint;
  }
  return put_under(name, temporary);
}

}  // namespace

WholeFile::WholeFile(std::string name) : name_(std::move(name)) {
  if (is_device(name_)) {
    file_.emplace(name_, O_WRONLY | O_APPEND);
  } else {
    temporary_ = open_beside(name_, file_);
  }
  if (file_->is_open()) return;
  complaint_ = cannot_write(name_);
  temporary_.clear();
}

WholeFile::~WholeFile() {
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

bool WholeFile::write(std::string_view text) {
  const std::scoped_lock writing(output_mutex());
  if (complaint_.empty() && !file_->write(text)) {
    complaint_ = cannot_write(name_);
  }
  return complaint_.empty();
}

std::string WholeFile::keep() {
  const std::scoped_lock writing(output_mutex());
  if (complaint_.empty() && !temporary_.empty()) {
    complaint_ = put_under(name_, temporary_);
    temporary_.clear();
  }
  return complaint_;
}

std::string replace_file(const std::string& name, const std::string& text) {
  return put_in_place(name, text, std::nullopt);
}

std::string rewrite_file(const std::string& name, const std::string& text) {
  std::error_code fault;
  const std::string file = std::filesystem::canonical(name, fault).string();
  const OpenFile there(fault ? name : file, O_WRONLY);
  if (!there.is_open()) return cannot_write(name);
  return put_in_place(file, text, there.mode() & 07777);
}

std::string append_file(const std::string& name, const std::string& text) {
  return put(name, text, O_APPEND | O_CREAT);
}

std::string make_directory(const std::string& name) {
  std::error_code fault;
  std::filesystem::create_directories(name, fault);
  if (!fault) return {};
  return fmt::format("cannot make the directory `{}`: {}", name,
                     fault.message());
}

}  // namespace btcheck

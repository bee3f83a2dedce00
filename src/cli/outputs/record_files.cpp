// SPDX-License-Identifier: MIT
//
// A lock on the open file, which the system takes off however we end. Writing
// replaces the file, so it is written once, at the end.
#include "cli/outputs/record_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace btcheck {
namespace {

// Whether the name still leads to that file, and nothing is in it.
bool is_empty_still(const std::string& name, const OpenFile& file) {
  struct stat named {};
  struct stat open {};
  return ::stat(name.c_str(), &named) == 0 &&
         ::fstat(file.number(), &open) == 0 && named.st_ino == open.st_ino &&
         named.st_dev == open.st_dev && named.st_size == 0;
}

bool is_device(const std::string& name) {
  struct stat status {};
  return name.starts_with("/dev/") ||
         (::stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode));
}

}  // namespace

std::string ClaimedFiles::claim(const std::string& name) {
  if (name.empty() || is_device(name)) return {};
  const bool is_new = ::access(name.c_str(), F_OK) != 0;
  auto file = std::make_unique<OpenFile>(name, O_RDWR | O_CREAT);
  if (!file->is_open()) {
    return fmt::format("cannot write `{}`: {}", name, std::strerror(errno));
  }
  if (::flock(file->number(), LOCK_EX | LOCK_NB) != 0) {
    return fmt::format("`{}` is being written by another run", name);
  }
  files_.push_back({name, std::move(file), is_new});
  return {};
}

ClaimedFiles::~ClaimedFiles() {
  for (const Claimed& claimed : files_) {
    if (claimed.is_new && is_empty_still(claimed.name, *claimed.file)) {
      ::unlink(claimed.name.c_str());
    }
  }
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
#include "cli/robots/log_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace btcheck {
namespace {

constexpr std::string_view kEnding = ".btlog";

std::string bytes_of(std::span<const LogTransition> records) {
  std::string bytes;
  for (const LogTransition& record : records) {
    append_record(bytes, record.time, record.uid, record.after);
  }
  return bytes;
}

}  // namespace

std::string recording_name(const std::string& name, const std::string& word,
                           int number) {
  std::string result = name.substr(0, name.size() - kEnding.size());
  if (!word.empty()) result += "-" + word;
  if (number > 1) result += fmt::format("-{}", number);
  return result + std::string(kEnding);
}

std::string LogFile::flaw() const {
  return fmt::format("cannot write `{}`: {}", name_, std::strerror(errno));
}

// Nobody sees a half of the heading: it is there at once, with its name.
std::string LogFile::begin(const std::string& name, const BehaviorLog& log) {
  name_ = name;
  const std::string part = fmt::format("{}.{}.part", name, ::getpid());
  ::unlink(part.c_str());
  file_ = std::make_unique<OpenFile>(part, O_WRONLY | O_CREAT | O_EXCL);
  const std::string bytes =
      btlog_heading(log.xml, log.begin) + bytes_of(log.transitions);
  if (file_->is_open() && file_->write(bytes) &&
      std::rename(part.c_str(), name.c_str()) == 0) {
    return {};
  }
  std::string why = flaw();
  ::unlink(part.c_str());
  file_.reset();
  return why;
}

std::string LogFile::add(std::span<const LogTransition> records) {
  if (!file_ || file_->write(bytes_of(records))) return {};
  std::string why = flaw();
  file_.reset();
  return why;
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Reading is bounded, writing is all or nothing.
#include "cli/inputs/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

namespace btcheck {
namespace {

constexpr std::uintmax_t kMostBytes = 64u << 20;

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

bool put(const std::string& name, const std::string& text,
         std::ios::openmode mode) {
  std::ofstream stream(name, std::ios::binary | mode);
  stream << text;
  stream.close();
  return !stream.fail();
}

std::string cannot_write(const std::string& name) {
  return fmt::format("cannot write `{}`: {}", name, std::strerror(errno));
}

}  // namespace

Diagnostic file_error(std::string_view code, const std::string& name,
                      std::string message, std::string help) {
  return {
      Severity::Error, std::string(code), std::move(message), name, {}, {}, {},
      std::move(help)};
}

Result<InputFile> read_file(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code fault;
  const fs::file_status status = fs::status(name, fault);
  if (!fs::exists(status)) {
    return refused(name, fmt::format("cannot find `{}`", name));
  }
  if (fs::is_directory(status)) {
    return refused(name, fmt::format("`{}` is a directory", name),
                   "name a file in it");
  }
  std::ifstream stream(name, std::ios::binary);
  if (!stream) {
    return refused(
        name, fmt::format("cannot read `{}`: {}", name, std::strerror(errno)));
  }
  InputFile file{name, {}};
  char block[1 << 16];
  while (stream.read(block, sizeof block), stream.gcount() > 0) {
    file.text.append(block, static_cast<std::size_t>(stream.gcount()));
    if (file.text.size() > kMostBytes) {
      return refused(name, fmt::format("`{}` is larger than 64 MiB", name));
    }
  }
  return {std::move(file), {}};
}

std::string write_file(const std::string& name, const std::string& text) {
  if (is_device(name)) {
    return put(name, text, std::ios::app) ? std::string() : cannot_write(name);
  }
  const std::string temporary = fmt::format("{}.{}.tmp", name, ::getpid());
  if (!put(temporary, text, std::ios::trunc)) {
    const std::string complaint = cannot_write(name);
    std::remove(temporary.c_str());
    return complaint;
  }
  std::error_code fault;
  std::filesystem::rename(temporary, name, fault);
  if (!fault) return {};
  std::remove(temporary.c_str());
  return fmt::format("cannot write `{}`: {}", name, fault.message());
}

std::string append_file(const std::string& name, const std::string& text) {
  const int file =
      ::open(name.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return cannot_write(name);
  std::string complaint;
  for (std::size_t done = 0; done < text.size() && complaint.empty();) {
    const auto count = ::write(file, text.data() + done, text.size() - done);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      complaint = cannot_write(name);
    }
  }
  ::close(file);
  return complaint;
}

std::string make_directory(const std::string& name) {
  std::error_code fault;
  std::filesystem::create_directories(name, fault);
  if (!fault) return {};
  return fmt::format("cannot make the directory `{}`: {}", name,
                     fault.message());
}

std::string path_beside(const std::string& beside, const std::string& file) {
  const std::filesystem::path path(file);
  if (path.is_absolute()) return file;
  return (std::filesystem::path(beside).parent_path() / path).string();
}

}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Reading is bounded, writing is all or nothing.
#include "cli/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace btcheck {
namespace {

constexpr std::uintmax_t kMostBytes = 64u << 20;

Result<InputFile> refused(const std::string& name, std::string message,
                          std::string help = {}) {
  Diagnostic diagnostic;
  diagnostic.code = "BT0002";
  diagnostic.message = std::move(message);
  diagnostic.file = name;
  diagnostic.help = std::move(help);
  return {std::nullopt, {std::move(diagnostic)}};
}

}  // namespace

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
  const std::string temporary = fmt::format("{}.{}.tmp", name, ::getpid());
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) {
    const std::string why = std::strerror(errno);
    std::remove(temporary.c_str());
    return fmt::format("cannot write `{}`: {}", name, why);
  }
  std::error_code fault;
  std::filesystem::rename(temporary, name, fault);
  if (!fault) return {};
  std::remove(temporary.c_str());
  return fmt::format("cannot write `{}`: {}", name, fault.message());
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

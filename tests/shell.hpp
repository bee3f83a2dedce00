// SPDX-License-Identifier: MIT
//
// Command lines, run by the shell as a user would type them.
#pragma once

#include <sys/wait.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

namespace btcheck {

struct Outcome {
  std::string text;  // stdout
  int code = -1;     // of the exit; -1 when a signal was the end
};

// Throws std::system_error when there is no process to be had. A command that
// does not exist is an exit code.
inline Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) {
    throw std::system_error(errno, std::generic_category(), command);
  }
  char block[4096];
  for (std::size_t n; (n = std::fread(block, 1, sizeof block, pipe)) > 0;) {
    outcome.text.append(block, n);
  }
  const int status = ::pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

// A path without apostrophes as one word of a command line.
inline std::string quoted(const std::filesystem::path& path) {
  return "'" + path.string() + "'";
}

// Runs a command line from within a folder.
inline Outcome run_in(const std::filesystem::path& folder,
                      const std::string& command) {
  return run("cd " + quoted(folder) + " && " + command);
}

}  // namespace btcheck

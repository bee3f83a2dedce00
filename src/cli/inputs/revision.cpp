// SPDX-License-Identifier: MIT
//
// git writes the files by an index of their own, so that neither the working
// copy nor its index changes. No shell is asked, and no hook runs.
#include "cli/inputs/revision.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "cli/inputs/files.hpp"

extern char** environ;

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// Runs git with its output, and what it says of errors, in a file. Whether it
// succeeds.
bool git(std::vector<std::string> words, const fs::path& index,
         const fs::path& output) {
  words.insert(words.begin(), "git");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::vector<char*> environment;
  std::string own = "GIT_INDEX_FILE=" + index.string();
  for (char** each = environ; *each != nullptr; ++each) {
    if (!std::string_view(*each).starts_with("GIT_INDEX_FILE=")) {
      environment.push_back(*each);
    }
  }
  environment.push_back(own.data());
  environment.push_back(nullptr);
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int fault = ::posix_spawnp(&process, "git", &files, nullptr,
                                   arguments.data(), environment.data());
  ::posix_spawn_file_actions_destroy(&files);
  if (fault != 0) {
    std::ofstream(output) << "git cannot be run";
    return false;
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::vector<std::string> lines_in(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

Revision::Revision(Revision&& other) noexcept
    : revision_(std::move(other.revision_)),
      folder_(std::exchange(other.folder_, {})),
      files_(std::move(other.files_)),
      input_(std::move(other.input_)) {}

Revision::~Revision() {
  std::error_code fault;
  if (!folder_.empty()) fs::remove_all(folder_, fault);
}

Result<Revision> Revision::with(const std::string& revision,
                                const std::string& input) {
  Result<Revision> result;
  const auto refuse = [&](std::string message) {
    result.value.reset();
    result.diagnostics = {file_error("BT0003", input, std::move(message))};
    return std::move(result);
  };
  std::error_code fault;
  const fs::path given = fs::absolute(input, fault).lexically_normal();
  const bool is_folder = fs::is_directory(given, fault);
  const fs::path from = is_folder ? given : given.parent_path();
  Revision made;
  made.revision_ = revision;
  std::string pattern =
      (fs::temp_directory_path(fault) / "btcheck-diff-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    return refuse(fmt::format("`{}` cannot be made", pattern));
  }
  made.folder_ = pattern;
  made.files_ = (made.folder_ / "files").string();
  const fs::path said = made.folder_ / "said";
  const fs::path index = made.folder_ / "index";
  const auto run = [&](const fs::path& in, std::vector<std::string> words) {
    words.insert(words.begin(), {"-C", in.string()});
    return git(std::move(words), index, said);
  };
  const auto why = [&] {
    const auto lines = lines_in(said);
    return lines.empty() ? std::string("git fails") : lines[0];
  };
  if (!run(from, {"rev-parse", "--show-toplevel", "--show-prefix"})) {
    return refuse(fmt::format("it is in no repository of git: {}", why()));
  }
  auto lines = lines_in(said);
  lines.resize(2);
  const fs::path top = lines[0];
  const std::string prefix = lines[1];
  if (!run(top, {"read-tree", revision})) {
    return refuse(
        fmt::format("git knows no revision `{}`: {}", revision, why()));
  }
  // Settings are looked for up to a repository.
  fs::create_directories(fs::path(made.files_) / ".git", fault);
  if (!run(top, {"checkout-index", "--all", "--quiet",
                 "--prefix=" + made.files_ + "/"})) {
    return refuse(
        fmt::format("git cannot write revision `{}`: {}", revision, why()));
  }
  fs::path found = fs::path(made.files_) / prefix;
  if (!is_folder) found /= given.filename();
  if (!fs::exists(found, fault)) {
    return refuse(fmt::format("revision `{}` has it not", revision));
  }
  made.input_ = found.string();
  while (made.input_.ends_with('/')) made.input_.pop_back();
  result.value.emplace(std::move(made));
  return result;
}

std::string Revision::shown(const std::string& name) const {
  const std::string before = files_ + '/';
  if (!name.starts_with(before)) return name;
  return revision_ + ':' + name.substr(before.size());
}

}  // namespace btcheck

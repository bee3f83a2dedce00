// SPDX-License-Identifier: MIT
//
// The program as a user meets it: a folder for each case, with a file `cmd`
// (the words after `btcheck`), perhaps a file `stdin` that it reads, and a file
// `expected` (what it printed on stdout and stderr, and its exit code),
// compared to the letter. With BTCHECK_UPDATE set in the environment `expected`
// is written instead; look at the change.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck::regress_test {
namespace {

// What differs from run to run, in reports of every format.
std::string without_timing(const std::string& text) {
  static const std::vector<std::pair<std::regex, std::string>> kTimings = {
      {std::regex("(\"(seconds|peak_bytes)\": ?)[-+.0-9e]+"), "$1_"},
      {std::regex("(\"started\": ?)\"[^\"]*\""), "$1_"},
      {std::regex("( (time|timestamp)=)\"[-.:0-9TZ]+\""), "$1_"},
      {std::regex("(\"peak_bytes\" value=)\"[0-9]+\""), "$1_"},
      // How far a search is, where it takes so long that this is told.
      {std::regex("[0-9]+ s  depth [^\n]*\n"), ""},
      {std::regex("\\{\"event\":\"progress\"[^\n]*\n"), ""}};
  std::string masked = text;
  for (const auto& [timing, mask] : kTimings) {
    masked = std::regex_replace(masked, timing, mask);
  }
  return masked;
}

// stdout and stderr apart, so that neither depends on the other's buffering.
std::string transcript(const fs::path& folder) {
  std::string words = file_text(folder / "cmd");
  while (!words.empty() && words.back() == '\n') words.pop_back();
  if (fs::exists(folder / "stdin")) words += " <stdin";
  const TemporaryFolder place;
  const fs::path err = place.path() / "stderr";
  // In braces, since a command may be a pipe.
  const Outcome out = run_in(
      folder, "{ '" BTCHECK_PROGRAM "' " + words + "; } 2>" + quoted(err));
  return without_timing("exit code " + std::to_string(out.code) +
                        "\n--- stdout\n" + out.text + "--- stderr\n" +
                        file_text(err));
}

std::vector<fs::path> cases() {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(BTCHECK_REGRESS)) {
    if (fs::exists(entry.path() / "cmd")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace

TEST_CASE("every recorded command prints what it printed") {
  // Reports would name files from there.
  ::unsetenv("GITHUB_WORKSPACE");
  ::unsetenv("CI_PROJECT_DIR");
  const std::vector<fs::path> folders = cases();
  REQUIRE(folders.size() >= 20);
  std::vector<std::string> found(folders.size());
  std::atomic<std::size_t> next = 0;
  const auto run_some = [&] {
    for (std::size_t i; (i = next++) < folders.size();) {
      found[i] = transcript(folders[i]);
    }
  };
  std::future<void> others = std::async(std::launch::async, run_some);
  run_some();
  others.get();
  for (std::size_t i = 0; i < folders.size(); ++i) {
    CAPTURE(folders[i].filename().string());
    const fs::path expected = folders[i] / "expected";
    if (std::getenv("BTCHECK_UPDATE") != nullptr) {
      std::ofstream(expected, std::ios::binary) << found[i];
      continue;
    }
    CHECK(found[i] == file_text(expected));
  }
}

}  // namespace btcheck::regress_test

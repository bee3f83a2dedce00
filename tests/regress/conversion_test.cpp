// SPDX-License-Identifier: MIT
//
// Trees written in the other language and back. What comes back says the same:
// its XML is the XML it came from.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::conversion_test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> trees_below(const fs::path& folder) {
  std::vector<fs::path> trees;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".btf") trees.push_back(entry.path());
  }
  std::sort(trees.begin(), trees.end());
  return trees;
}

// Exports in `folder`; the exit code. What is said goes to the file `said`.
int converted(const fs::path& folder, const fs::path& from,
              const std::string& to, const std::string& into) {
  return run_in(folder, quoted(BTCHECK_PROGRAM) + " export " + quoted(from) +
                            " --no-config --to " + to + " >" + into + " 2>said")
      .code;
}

TEST_CASE("XML of a .btf tree comes back as it went") {
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  int count = 0;
  for (const char* room : {"/properties", "/examples"}) {
    for (const fs::path& tree :
         trees_below(BTCHECK_SOURCES + std::string(room))) {
      CAPTURE(tree.string());
      const int code = converted(folder, tree, "xml", "one.xml");
      const std::string said = file_text(folder / "said");
      if (code != 0) {
        // Never silently.
        CHECK(said.find("error[BT0010]") != std::string::npos);
        CHECK(fs::file_size(folder / "one.xml") == 0);
        continue;
      }
      ++count;
      CHECK(converted(folder, "one.xml", "btf", "two.btf") == 0);
      CAPTURE(file_text(folder / "one.xml"));
      CAPTURE(file_text(folder / "two.btf"));
      CHECK(converted(folder, "two.btf", "xml", "three.xml") == 0);
      CHECK(file_text(folder / "three.xml") == file_text(folder / "one.xml"));
    }
  }
  CHECK(count >= 20);
}

}  // namespace
}  // namespace btcheck::conversion_test

// SPDX-License-Identifier: MIT
//
// Which repository holds a folder.
#include "cli/options/roots.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "temporary_folder.hpp"

namespace btcheck::roots_test {
namespace {

namespace fs = std::filesystem;

class Place {
 public:
  Place() : top_(fs::canonical(folder_.path())) {}

  void make(const std::string& name) const {
    fs::create_directories((top_ / name).parent_path());
    std::ofstream(top_ / name) << "";
  }
  // Below the temporary folder; "" where there is none.
  std::string repository(const std::string& name) const {
    fs::create_directories(top_ / name);
    const fs::path found = repository_of((top_ / name).string());
    return found.empty() ? "" : found.lexically_relative(top_).string();
  }
  const fs::path& top() const { return top_; }

 private:
  TemporaryFolder folder_;
  fs::path top_;
};

TEST_CASE("the repository is that of .git, or else of btcheck.toml") {
  const Place place;
  CHECK(place.repository("a/b/c").empty());
  place.make("a/b/btcheck.toml");
  CHECK(place.repository("a/b/c") == "a/b");
  CHECK(place.repository("a") == "");
  // Of a submodule and of a work tree `.git` is a file.
  place.make("a/.git");
  CHECK(place.repository("a/b/c") == "a");
  place.make("a/b/c/.git/config");
  CHECK(place.repository("a/b/c/d") == "a/b/c");
  CHECK(place.repository("a/b") == "a");
  const Surroundings around = surroundings_of(place.top() / "a/b");
  CHECK(around.settings == place.top() / "a/b");
  CHECK(around.repository == place.top() / "a");
  CHECK(surroundings_of(place.top() / "a/b/c/d").settings.empty());
}

TEST_CASE("links are followed to the repository that holds a folder") {
  const Place place;
  place.make("a/.git");
  place.make("b/trees/t.btf");
  fs::create_symlink("../b/trees", place.top() / "a/trees");
  CHECK(place.repository("a/trees").empty());
  place.make("b/.git");
  CHECK(place.repository("a/trees") == "b");
}

TEST_CASE("a home and the root of the machine are no repositories") {
  const Place place;
  place.make("home/.git");
  place.make("home/ws/btcheck.toml");
  const char* before = std::getenv("HOME");
  const std::string kept = before == nullptr ? "/" : before;
  CHECK(place.repository("home/ws/trees") == "home");
  ::setenv("HOME", (place.top() / "home").c_str(), 1);
  CHECK(place.repository("home/ws/trees") == "home/ws");
  CHECK(place.repository("home/other").empty());
  ::setenv("HOME", kept.c_str(), 1);
  CHECK(repository_of("/").empty());
}

}  // namespace
}  // namespace btcheck::roots_test

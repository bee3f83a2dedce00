// SPDX-License-Identifier: MIT
//
// Files in and out: what cannot be read is said, what cannot be written leaves
// nothing behind.
#include "cli/inputs/files.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "model/tree_file.hpp"
#include "temporary_folder.hpp"

namespace btcheck::files_test {
namespace {

namespace fs = std::filesystem;

struct Folder : TemporaryFolder {
  std::string file(const std::string& name) const { return path() / name; }
  std::size_t count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(path()), {}));
  }
};

void put(const std::string& name, const std::string& text) {
  std::ofstream(name, std::ios::binary) << text;
}

// The message of the only diagnostic of a file that cannot be read.
std::string refusal(const std::string& name) {
  const Result<InputFile> read = read_file(name);
  CHECK(!read.value.has_value());
  REQUIRE(read.diagnostics.size() == 1);
  CHECK(read.diagnostics[0].severity == Severity::Error);
  CHECK(read.diagnostics[0].code == "BT0002");
  CHECK(read.diagnostics[0].file == name);
  return read.diagnostics[0].message;
}

TEST_CASE("a file is read as it is, byte by byte") {
  const Folder folder;
  const std::string text = std::string("a\r\nb\0c\xff", 7) + "\n";
  for (const std::string& content :
       {std::string(), text, std::string(200'000, 'x')}) {
    put(folder.file("in"), content);
    const Result<InputFile> read = read_file(folder.file("in"));
    REQUIRE(read.value.has_value());
    CHECK(read.value->name == folder.file("in"));
    CHECK(read.value->text == content);
    CHECK(read.diagnostics.empty());
  }
}

TEST_CASE("a missing file and a directory are refused") {
  const Folder folder;
  const std::string missing = folder.file("none.btf");
  CHECK(refusal(missing) == "cannot find `" + missing + "`");
  CHECK(refusal("") == "cannot find ``");
  const std::string directory = folder.path();
  CHECK(refusal(directory) == "`" + directory + "` is a directory");
}

TEST_CASE("a file of more than 64 MiB is refused, one of just that is not") {
  const Folder folder;
  const std::string name = folder.file("large");
  put(name, "");
  fs::resize_file(name, (64u << 20) + 1);
  CHECK(refusal(name) == "`" + name +
                             "` is larger than 64 MiB, the most that is read "
                             "of a file");
  fs::resize_file(name, 64u << 20);
  CHECK(read_file(name).value.has_value());
}

TEST_CASE("a device is refused") {
  if (!fs::exists("/dev/zero")) return;
  CHECK(refusal("/dev/zero") == "`/dev/zero` is a pipe or a device");
}

TEST_CASE("a file is written as a whole, or replaced as a whole") {
  const Folder folder;
  CHECK(write_file(folder.file("out"), "one") == "");
  CHECK(read_file(folder.file("out")).value->text == "one");
  CHECK(write_file(folder.file("out"), "two\n") == "");
  CHECK(read_file(folder.file("out")).value->text == "two\n");
  CHECK(folder.count() == 1);
}

TEST_CASE("in a directory that is missing nothing is written") {
  const Folder folder;
  const std::string name = folder.file("no/out");
  CHECK(write_file(name, "text") ==
        "cannot write `" + name + "`: No such file or directory");
  CHECK(folder.count() == 0);
}

TEST_CASE("in a directory that is read-only nothing is written") {
  if (::geteuid() == 0) return;  // who may write everywhere
  const Folder folder;
  put(folder.file("out"), "old");
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const std::string name = folder.file("out");
  CHECK(write_file(name, "new") ==
        "cannot write `" + name + "`: Permission denied");
  CHECK(folder.count() == 1);
  CHECK(read_file(name).value->text == "old");
}

TEST_CASE("where a directory stands no file is written, and none left over") {
  const Folder folder;
  fs::create_directory(folder.path() / "out");
  CHECK(write_file(folder.file("out"), "text")
            .starts_with("cannot write `" + folder.file("out") + "`: "));
  CHECK(folder.count() == 1);
  CHECK(fs::is_directory(folder.path() / "out"));
}

TEST_CASE("a full disk is noticed, and nothing is left behind") {
  const Folder folder;
  const std::string name = folder.file("out");
  // As `ulimit -f` does.
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{4096, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &little) == 0);
  const std::string complaint = write_file(name, std::string(100'000, 'x'));
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, SIG_DFL);
  CHECK(complaint == "cannot write `" + name + "`: File too large");
  CHECK(folder.count() == 0);
}

TEST_CASE("a directory is made with those above it, once or again") {
  const Folder folder;
  const std::string name = folder.file("a/b/c");
  CHECK(make_directory(name) == "");
  CHECK(fs::is_directory(name));
  CHECK(make_directory(name) == "");
  put(folder.file("file"), "");
  CHECK(make_directory(folder.file("file/under"))
            .starts_with("cannot make the directory `"));
}

TEST_CASE("a path is taken as seen from beside another") {
  CHECK(included_name("a/b/p.ltl", "t.btf") == "a/b/t.btf");
  CHECK(included_name("p.ltl", "t.btf") == "t.btf");
  CHECK(included_name("a/p.ltl", "../t.btf") == "t.btf");
  CHECK(included_name("a/p.ltl", "/x/t.btf") == "/x/t.btf");
}

TEST_CASE("a pipe is written to and stays one") {
  const Folder folder;
  const std::string pipe = folder.file("pipe");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  REQUIRE(reader >= 0);
  CHECK(write_file(pipe, "hello\n") == "");
  char read[16] = {};
  CHECK(::read(reader, read, sizeof read) == 6);
  CHECK(std::string(read) == "hello\n");
  ::close(reader);
  CHECK(fs::is_fifo(pipe));
  CHECK(folder.count() == 1);
}

}  // namespace
}  // namespace btcheck::files_test

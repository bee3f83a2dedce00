// SPDX-License-Identifier: MIT
//
// `btcheck fmt`: which files it takes, what it writes and says, and what it
// leaves alone.
#include <doctest/doctest.h>

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck::fmt_test {
namespace {

const std::string kProgram = "'" BTCHECK_PROGRAM "' ";

constexpr std::string_view kTree =
    "<root BTCPP_format=\"4\"><BehaviorTree ID='T'><Sequence>\n"
    "<!-- one --><SetBlackboard output_key='e' value='1'/></Sequence>"
    "</BehaviorTree></root>";
constexpr std::string_view kStyledTree = R"(<root BTCPP_format="4">
  <BehaviorTree ID="T">
    <Sequence>
      <!-- one -->
      <SetBlackboard value="1" output_key="e"/>
    </Sequence>
  </BehaviorTree>
</root>
)";
constexpr std::string_view kPaper =
    "(BehaviorTree :name t\n (Sequence\n  (Action :ID a)))\n";
constexpr std::string_view kStyledPaper =
    "(BehaviorTree :name t\n  (Sequence\n    (Action :ID a)))\n";

struct Files : TemporaryFolder {
  Files() {
    write("t.xml", kTree);
    write("sub/p.btf", kPaper);
    write("sub/p.ltl", "tree \"p.btf\"\nproperty p:\n  never  dead\n");
    write("sub/l.leaves", "(defaction a\n :returns (success))\n");
    write("sub/package.xml", "<package><name>x</name ></package>");
    write("sub/notes.txt", "(a b)");
    write(".hidden/t.xml", kTree);
    write("vendor/t.xml", kTree);
    write("btcheck.toml", "excludes = [\"vendor\"]\n");
  }
  Outcome run(const std::string& words) const {
    return run_in(path(), kProgram + words + " 2>&1");
  }
  void write(const std::string& name, std::string_view text) const {
    const fs::path file = path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
  }
  std::string text_of(const std::string& name) const {
    return file_text(path() / name);
  }
};

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a folder: what is checked in it, and what settings leave in") {
  const Files files;
  const Outcome first = files.run("fmt .");
  CHECK(first.code == 0);
  CHECK(first.text ==
        "sub/l.leaves\nsub/p.btf\nsub/p.ltl\nt.xml\n"
        "4 of 4 files formatted\n");
  CHECK(files.text_of("t.xml") == kStyledTree);
  CHECK(files.text_of("sub/p.btf") == kStyledPaper);
  CHECK(files.text_of("sub/p.ltl") ==
        "tree \"p.btf\"\nproperty p:\n    never dead\n");
  CHECK(files.text_of("sub/l.leaves") ==
        "(defaction a\n  :returns (success))\n");
  CHECK(files.text_of("sub/package.xml") ==
        "<package><name>x</name ></package>");
  CHECK(files.text_of("sub/notes.txt") == "(a b)");
  CHECK(files.text_of(".hidden/t.xml") == kTree);
  CHECK(files.text_of("vendor/t.xml") == kTree);
  const Outcome again = files.run("fmt .");
  CHECK(again.text == "0 of 4 files formatted\n");
  CHECK(files.run("fmt . -q").text.empty());
  CHECK(has(files.run("fmt . --no-config").text, "vendor/t.xml\n"));
}

TEST_CASE("--check and --diff change nothing") {
  const Files files;
  const Outcome check = files.run("fmt --check t.xml sub/p.btf");
  CHECK(check.code == 1);
  CHECK(check.text == "t.xml\nsub/p.btf\n2 of 2 files would be formatted\n");
  const Outcome diff = files.run("fmt --diff -q sub/p.btf");
  CHECK(diff.code == 0);
  CHECK(diff.text ==
        "--- sub/p.btf\n+++ sub/p.btf\n@@ -1,3 +1,3 @@\n"
        " (BehaviorTree :name t\n- (Sequence\n-  (Action :ID a)))\n"
        "+  (Sequence\n+    (Action :ID a)))\n");
  CHECK(files.run("fmt --diff --check -q sub/p.btf").code == 1);
  CHECK(files.text_of("t.xml") == kTree);
  CHECK(files.text_of("sub/p.btf") == kPaper);
  files.run("fmt -q t.xml");
  CHECK(files.run("fmt --check t.xml").code == 0);
}

TEST_CASE("a diff is one that `patch` takes, whatever the lines are") {
  const Files files;
  if (run("command -v patch >/dev/null").code != 0) return;
  files.write("t.xml", "\xEF\xBB\xBF<root>\r\n\t<a/></root>");
  CHECK(files.run("fmt --diff -q t.xml >t.patch").code == 0);
  CHECK(files.run("fmt - --stdin-name t.xml <t.xml >styled.xml").code == 0);
  CHECK(run_in(files.path(), "patch --binary -s t.xml t.patch").code == 0);
  CHECK(files.text_of("t.xml") == files.text_of("styled.xml"));
  CHECK(files.text_of("t.xml") ==
        "\xEF\xBB\xBF<root>\r\n  <a/>\r\n</root>\r\n");
}

TEST_CASE("--verify compares the networks, and tells what it cannot read") {
  const Files files;
  files.write("u.xml",
              "<root BTCPP_format='4'><BehaviorTree ID='A'><SubTree ID='B'/>"
              "</BehaviorTree><BehaviorTree ID='B'><AlwaysSuccess/>"
              "</BehaviorTree></root>");
  const Outcome verified = files.run("fmt --verify . u.xml");
  CHECK(verified.code == 0);
  CHECK(has(verified.text, "5 of 6 files formatted"));
  files.write("u.xml",
              "<root BTCPP_format='4'><BehaviorTree ID='A'><SubTree ID='B'/>"
              "</BehaviorTree></root>");
  const std::string before = files.text_of("u.xml");
  const Outcome open = files.run("fmt --verify u.xml");
  CHECK(open.code == 2);
  CHECK(has(open.text, "`B`"));
  CHECK(files.text_of("u.xml") == before);
  CHECK(files.run("fmt u.xml").code == 0);
}

TEST_CASE("standard input goes to standard output") {
  const Files files;
  CHECK(files.run("fmt - <t.xml").text == kStyledTree);
  CHECK(files.run("fmt - <sub/p.btf").text == kStyledPaper);
  CHECK(files.run("fmt - <sub/p.ltl").text ==
        "tree \"p.btf\"\nproperty p:\n    never dead\n");
  CHECK(files.run("fmt - --stdin-name a/b.leaves <sub/l.leaves").text ==
        "(defaction a\n  :returns (success))\n");
  CHECK(files.run("fmt --check - --stdin-name x.xml <t.xml").text == "x.xml\n");
  const Outcome broken = run_in(
      files.path(), kProgram + "fmt - --stdin-name x.btf <t.xml 2>/dev/null");
  CHECK(broken.code == 2);
  CHECK(broken.text.empty());
  CHECK(has(files.run("fmt - <sub/notes.txt").text, "(a b)"));
  CHECK(has(files.run("fmt t.xml --stdin-name x.xml").text,
            "error[BT0001]: --stdin-name goes with `-`"));
  CHECK(has(files.run("fmt - t.xml <t.xml").text,
            "error[BT0001]: `-` goes with no other file"));
}

TEST_CASE("a file that cannot be read or written is left as it is") {
  const Files files;
  files.write("bad.xml", "<root>\n <a></root>");
  const Outcome bad = files.run("fmt bad.xml t.xml");
  CHECK(bad.code == 2);
  CHECK(has(bad.text, "error[BT1600]"));
  CHECK(has(bad.text, "--> bad.xml:2:1"));
  CHECK(files.text_of("bad.xml") == "<root>\n <a></root>");
  CHECK(files.text_of("t.xml") == kStyledTree);  // the others are formatted
  CHECK(has(files.run("fmt sub/package.json").text, "error[BT0002]"));
  files.write("x.yaml", "a: 1\n");
  CHECK(has(files.run("fmt x.yaml").text, "error[BT1652]"));
  fs::create_directory(files.path() / "empty");
  const Outcome empty = files.run("fmt empty");
  CHECK(empty.code == 2);
  CHECK(has(empty.text, "error[BT1507]: nothing to format in `empty`"));
  CHECK(has(files.run("fmt").text, "no folder and no file"));
}

TEST_CASE("permissions stay, a link stays one, and nothing else is left") {
  const Files files;
  const fs::path file = files.path() / "t.xml";
  ::chmod(file.c_str(), 0755);
  fs::create_symlink("t.xml", files.path() / "link.xml");
  CHECK(files.run("fmt -q link.xml").text == "link.xml\n");
  CHECK(files.text_of("t.xml") == kStyledTree);
  CHECK(fs::is_symlink(files.path() / "link.xml"));
  CHECK((fs::status(file).permissions() & fs::perms::mask) == fs::perms(0755));
  for (const auto& each : fs::directory_iterator(files.path())) {
    CHECK_FALSE(each.path().string().ends_with(".tmp"));
  }
}

TEST_CASE("rules that name nodes by lines are told when those move") {
  const Files files;
  files.write("m.btf",
              "\n\n(BehaviorTree :name t (Sequence\n(Action :ID a) "
              "(Action :ID b)))\n");
  files.write("m.ltl", "property p: never a@4.failure or Sequence3.failure\n");
  const Outcome told = files.run("fmt m.btf");
  CHECK(told.code == 0);
  CHECK(has(told.text, "warning[BT0014]"));
  CHECK(has(told.text, "m.ltl:1:21"));
  CHECK(has(told.text, "what stood on line 4 of `m.btf` stands on line 3"));
  CHECK(has(told.text, "what stood on line 3 of `m.btf` stands on line 2"));
  CHECK_FALSE(has(files.run("fmt m.btf").text, "BT0014"));
}

}  // namespace btcheck::fmt_test

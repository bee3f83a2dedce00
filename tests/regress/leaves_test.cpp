// SPDX-License-Identifier: MIT
//
// `btcheck leaves`: what it writes is read back, and says no more than is
// known.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck::leaves_test {
namespace {

const std::string kProgram = "'" BTCHECK_PROGRAM "' ";

struct Project : TemporaryFolder {
  Project() {
    fs::copy(BTCHECK_REGRESS "/leaves_of_folder/trees", path() / "trees",
             fs::copy_options::recursive);
  }
  Outcome run(const std::string& words) const {
    return run_in(path(), kProgram + words + " 2>&1 </dev/null");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(fs::path(path()) / name) << text;
  }
  std::string text_of(const std::string& name) const {
    return file_text(fs::path(path()) / name);
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The findings of a tree that are errors or warnings, or speak of leaves of
// which nothing is known.
std::string complaints(const std::string& text) {
  for (const char* sign : {"error[", "warning[", "BT1620"}) {
    if (has(text, sign)) return text;
  }
  return {};
}

// Names as bad as files can have them.
constexpr const char* kHostile = R"(<root>
  <BehaviorTree ID="T">
    <Sequence>
      <Action ID="say &quot;hi&quot;" text="a -- b"/>
      <Action ID="a&lt;b &amp; c--d" key="{k}" word="entry" number="3"/>
      <Condition ID="is *?" out="{k}"/>
      <Action ID="(x) ; y"/>
    </Sequence>
  </BehaviorTree>
</root>
)";

}  // namespace

TEST_CASE("what leaves writes is read back without a warning") {
  const Project project;
  REQUIRE(project.run("leaves trees -o nodes.xml").code == 0);
  REQUIRE(project.run("leaves trees -o robot.leaves").code == 0);
  for (const std::string tree : {"patrol.xml", "dock--station.xml"}) {
    CAPTURE(tree);
    const std::string lint = "lint trees/" + tree;
    CHECK(has(project.run(lint).text, "BT1620"));
    for (const std::string file :
         {"--models nodes.xml", "--leaves robot.leaves"}) {
      CAPTURE(file);
      const Outcome read = project.run(lint + " " + file);
      CHECK(complaints(read.text).empty());
      CHECK(read.code == 0);
    }
  }
  const Outcome all = project.run("batch trees -v --leaves robot.leaves");
  CHECK(complaints(all.text).empty());
  // Nothing is left to describe.
  CHECK(has(project.run("leaves trees --models nodes.xml").text,
            "there is no leaf"));
  CHECK(has(project.run("leaves trees --leaves robot.leaves").text,
            "there is no leaf"));
  fs::copy(project.path() / "nodes.xml", project.path() / "trees/nodes.xml");
  CHECK(has(project.run("leaves trees").text, "there is no leaf"));
  CHECK(complaints(project.run("batch trees -v").text).empty());
}

TEST_CASE("a contract of leaves begins with what holds without it") {
  const Project project;
  REQUIRE(project.run("leaves trees --to leaves -o robot.txt").code == 0);
  const auto figures = [&](const std::string& words) {
    return run_in(
        project.path(),
        kProgram + "space trees/patrol.xml " + words +
            " --stats json 2>/dev/null | grep -o '\"states\":[0-9]*'");
  };
  // But for the conditions, which are taken for actions without it.
  project.write("conditions.leaves",
                "(defcondition IsTrayFull :returns (success failure))\n");
  const std::string with = figures("--leaves robot.txt").text;
  CHECK(!with.empty());
  CHECK(with == figures("--leaves conditions.leaves").text);
}

TEST_CASE("no file is written over") {
  const Project project;
  project.write("nodes.xml", "<root>filled in</root>\n");
  const Outcome refused = project.run("leaves trees -o nodes.xml");
  CHECK(refused.code == 2);
  CHECK(has(refused.text, "error[BT0004]"));
  CHECK(project.text_of("nodes.xml") == "<root>filled in</root>\n");
  CHECK(project.run("leaves trees -o /dev/stdout").code == 0);
}

TEST_CASE("names of leaves are written as they can be read") {
  const Project project;
  project.write("trees/patrol.xml", kHostile);
  const std::string tree = " trees/patrol.xml";
  REQUIRE(project.run("leaves" + tree + " -o nodes.xml").code == 0);
  REQUIRE(project.run("leaves" + tree + " -o robot.leaves").code == 0);
  CAPTURE(project.text_of("nodes.xml"));
  CHECK(complaints(project.run("lint" + tree + " --models nodes.xml").text)
            .empty());
  // In version 3 an output port may be given a name without braces.
  CHECK(has(project.text_of("nodes.xml"), "<inout_port name=\"word\"/>"));
  CHECK(has(project.text_of("nodes.xml"), "<input_port name=\"number\"/>"));
  // One name has quotes in it, which no contract can have.
  const std::string read =
      project.run("lint" + tree + " --leaves robot.leaves").text;
  CHECK(!has(read, "warning["));
  CHECK(!has(read, "error["));
  CHECK(has(read, "no model has the leaf `say \"hi\"`"));
}

TEST_CASE("the trees that can be read are read") {
  const Project project;
  project.write("trees/broken.xml", "<root BTCPP_format=\"4\"><BehaviorTree>");
  const Outcome some = project.run("leaves trees");
  CHECK(some.code == 2);
  CHECK(has(some.text, "error[BT1600]"));
  CHECK(has(some.text, "<Action ID=\"MoveTo\">"));
  CHECK(project.run("leaves nowhere.xml").code == 2);
}

TEST_CASE("what most trees do is proposed") {
  const Project project;
  const auto tree = [](const std::string& node, const std::string& report) {
    return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><" + node +
           "><IsAhead/><Drive/>" + report + "</" + node +
           "></BehaviorTree><TreeNodesModel><Condition ID=\"IsAhead\"/>"
           "<Action ID=\"Drive\"/><Action ID=\"Report\"/></TreeNodesModel>"
           "</root>";
  };
  const std::string forgiven = "<ForceSuccess><Report/></ForceSuccess>";
  fs::create_directory(project.path() / "own");
  project.write("own/a.xml", tree("ReactiveSequence", forgiven));
  project.write("own/b.xml", tree("ReactiveSequence", forgiven));
  project.write("own/c.xml", tree("Sequence", "<Report/>"));
  const std::string said = project.run("leaves own --to leaves").text;
  CHECK(has(said,
            "; In 2 of 3 places IsAhead is asked as long as Drive and Report "
            "run:\n; (defcondition IsAhead :holds-while (Drive Report))\n"));
  CHECK(has(said,
            "; In 2 of 3 places nobody hears of a failure of Report:\n"
            "; (defaction Report :may-be-lost)\n"));
  // What is proposed is a comment until somebody takes its sign away.
  CHECK(
      has(project.run("leaves own -o own/p.leaves").text, "nothing is known"));
  CHECK(!has(project.run("own/c.xml --leaves own/p.leaves").text, "warning["));
  std::string text = project.text_of("own/p.leaves");
  const auto at = text.find("; (defcondition IsAhead");
  REQUIRE(at != text.npos);
  project.write("own/p.leaves", text.erase(at, 2));
  CHECK(has(project.run("own/c.xml --leaves own/p.leaves").text,
            "warning[BT2205]: `IsAhead` is not asked again while `Drive` and "
            "`Report` run"));
}

}  // namespace btcheck::leaves_test

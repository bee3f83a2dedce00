// SPDX-License-Identifier: MIT
//
// `btcheck answer`: an answered project stays answered, and what comes to
// violate an answer is a warning with its run.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck::answer_test {
namespace {

const std::string kProgram = "'" BTCHECK_PROGRAM "' ";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != text.npos;
       at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

// The twelve clean trees, and more where a test wants them.
struct Workspace : TemporaryFolder {
  Workspace() {
    for (const auto& file : fs::directory_iterator(BTCHECK_FINDINGS)) {
      const std::string name = file.path().filename().string();
      if (name.starts_with("clean-")) fs::copy(file.path(), path() / name);
    }
  }
  std::string run(const std::string& words,
                  const std::string& input = "") const {
    return run_in(path(),
                  "printf '" + input + "' | " + kProgram + words + " 2>&1")
        .text;
  }
  // The same answer to every question.
  std::string answered(const std::string& with) const {
    return run_in(path(), "yes '" + with + "' 2>/dev/null | " + kProgram +
                              "answer . 2>&1")
        .text;
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name) << text;
  }
  std::string text_of(const std::string& name) const {
    return file_text(path() / name);
  }
};

std::string parallel(const std::string& second) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">\n"
         "  <BehaviorTree ID=\"T\">\n"
         "    <Parallel>\n"
         "      <Sequence>\n        <Brush/>\n        <Rinse/>\n"
         "      </Sequence>\n"
         "      " +
         second +
         "\n    </Parallel>\n  </BehaviorTree>\n"
         "  <TreeNodesModel>\n    <Action ID=\"Brush\"/>\n"
         "    <Action ID=\"Rinse\"/>\n    <Action ID=\"Report\"/>\n"
         "  </TreeNodesModel>\n</root>\n";
}

TEST_CASE("an answered project stays answered") {
  const Workspace project;
  const std::string before = project.run("batch .");
  CHECK(has(before, "12 entries: 12 without a fault"));
  const std::string first = project.answered("1");
  CHECK(has(first, "0 left open"));
  CHECK(count_of(first, "\n> ") >= 8);
  CHECK(has(project.text_of("btcheck.toml"), "leaves = [\"answers.leaves\"]"));

  // Nothing is asked any more, nor told; verdicts are what they were.
  CHECK(has(project.answered("1"), "0 questions answered, 0 left open"));
  const std::string after = project.run("batch .");
  CHECK(!has(after, "BT25"));
  CHECK(!has(after, "BT1021"));
  CHECK(has(after, "12 entries: 12 without a fault"));

  // A change that violates an answer: what may not be cut off, is.
  project.write("robot.xml",
                parallel("<ForceSuccess><Report/></ForceSuccess>"));
  CHECK(!has(project.run("robot.xml"), "BT25"));
  project.write("robot.xml", parallel("<Report/>"));
  CHECK(has(project.run("robot.xml"), "  BT2502  line 3"));
  CHECK(has(project.run("answer robot.xml", "2\\n"), "1 question answered"));
  const std::string broken = project.run("robot.xml");
  CHECK(has(broken,
            "warning[BT2502]: `Parallel` halts `Sequence` when "
            "`Report` has failed: by a contract it may not be cut off"));
  CHECK(has(broken, "tick 1   Brush -> running, Report -> failure"));
  CHECK(!has(broken, "Questions"));
  // In every tree of the project, and gone with the change.
  project.write("other.xml", parallel("<Report/>"));
  CHECK(has(project.run("batch . --deny warnings"), "error[BT2502] line 3"));
  project.write("robot.xml",
                parallel("<ForceSuccess><Report/></ForceSuccess>"));
  project.write("other.xml",
                parallel("<ForceSuccess><Report/></ForceSuccess>"));
  CHECK(has(project.run("batch . --deny warnings"),
            "14 entries: 14 without a fault"));
}

TEST_CASE("a guard that has to be asked all along") {
  const Workspace project;
  const std::string bug =
      file_text(fs::path(BTCHECK_FINDINGS) / "03-stale-guard-bug.xml");
  project.write("yard.xml", bug);
  CHECK(has(project.run("answer yard.xml", "2\\n"), "1 question answered"));
  CHECK(has(project.text_of("answers.leaves"),
            "(defcondition IsPersonNear :holds-while (FollowYardRoute))"));
  const std::string told = project.run("yard.xml");
  CHECK(has(told, "warning[BT2205]: `IsPersonNear` is not asked again"));
  CHECK(has(told, "by a contract it has to be asked meanwhile"));
  CHECK(has(told, "tick 1"));
  CHECK(!has(told, "BT2501"));
}

TEST_CASE("what stands in the file is kept") {
  const Workspace project;
  project.write("robot.xml", parallel("<Report/>"));
  project.write("own.leaves",
                "; ours\n(defaction Brush ; the small one\n"
                "  :returns (success running))\n");
  project.write("btcheck.toml", "leaves = [\"own.leaves\"]\n");
  CHECK(has(project.run("answer robot.xml", "1\\n"), "1 question answered"));
  CHECK(project.text_of("own.leaves") ==
        "; ours\n(defaction Brush ; the small one\n"
        "  :returns (success running) :may-be-cut-off)\n"
        "(defaction Rinse :may-be-cut-off)\n");
  CHECK(project.text_of("btcheck.toml") == "leaves = [\"own.leaves\"]\n");
  CHECK(!has(project.run("robot.xml"), "BT25"));
  // Answered the other way by hand: the word is replaced.
  project.write("own.leaves",
                "(defaction Brush :may-be-cut-off no)\n"
                "(defaction Rinse :may-be-cut-off)\n");
  CHECK(has(project.run("robot.xml"), "warning[BT2502]"));
}

TEST_CASE("what cannot be read is not written over") {
  const Workspace project;
  project.write("robot.xml", parallel("<Report/>"));
  project.write("btcheck.toml", "leaves = []  # none yet\n");
  const std::string told = project.run("answer robot.xml", "1\\n");
  CHECK(has(told, "add \"answers.leaves\" to `leaves` in btcheck.toml"));
  CHECK(project.text_of("btcheck.toml") == "leaves = []  # none yet\n");
  fs::create_directory(project.path() / "own.leaves");
  const std::string refused =
      project.run("answer robot.xml -o own.leaves", "1\\n");
  CHECK(has(refused, "error["));
  CHECK(fs::is_directory(project.path() / "own.leaves"));
}

TEST_CASE("no answer, and answers that there are not") {
  const Workspace project;
  project.write("robot.xml", parallel("<Report/>"));
  CHECK(has(project.run("answer robot.xml"), "0 questions answered, 1 left"));
  CHECK(has(project.run("answer robot.xml", "9\\nx\\n\\n"),
            "a number from 1 to 2, Enter or q"));
  CHECK(has(project.run("answer robot.xml", "q\\n"), "1 left open"));
  CHECK(!fs::exists(project.path() / "answers.leaves"));
  CHECK(!fs::exists(project.path() / "btcheck.toml"));
  CHECK(has(project.run("answer missing.xml"), "error["));
  CHECK(has(project.run("answer -"), "error[BT0001]"));
  project.write("t.btf", "(BehaviorTree :name t (Action :ID a))");
  CHECK(has(project.run("answer t.btf"), "error[BT1636]"));
}

// Each comment stands before its node, whatever was answered before.
TEST_CASE("comments, and answers that ask again, in one file") {
  const Workspace project;
  const std::string tree =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">\n"
      "  <Sequence>\n"
      "    <Fallback name=\"one\">\n      <Brush/>\n    </Fallback>\n"
      "    <Fallback name=\"two\"><Brush/></Fallback>\n"
      "    <Repeat num_cycles=\"-1\">\n      <Rinse/>\n    </Repeat>\n"
      "  </Sequence>\n"
      "</BehaviorTree><TreeNodesModel><Action ID=\"Brush\"/>"
      "<Action ID=\"Rinse\"/></TreeNodesModel></root>\n";
  project.write("robot.xml", tree);
  const std::string told =
      project.run("answer robot.xml", "1\\n1\\n1\\n1\\n1\\n");
  CHECK(has(told, "4 questions answered, 0 left open"));
  CHECK(has(project.text_of("robot.xml"),
            "    <!-- btcheck: allow BT2512 -->\n    <Fallback name=\"one\">"));
  CHECK(has(project.text_of("robot.xml"),
            "    <!-- btcheck: allow BT2512 -->\n    <Fallback name=\"two\">"));
  CHECK(has(project.text_of("robot.xml"),
            "    <!-- btcheck: allow BT2511 -->\n    <Repeat"));
  CHECK(has(project.text_of("answers.leaves"), "Rinse :duration [1,inf]"));
  CHECK(!has(project.run("robot.xml"), "BT25"));
}

TEST_CASE("an answer that no contract can give becomes a comment") {
  const Workspace project;
  project.write("robot.xml",
                "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">\n"
                "  <Fallback>\n    <Brush/>\n  </Fallback>\n"
                "</BehaviorTree><TreeNodesModel><Action ID=\"Brush\"/>"
                "</TreeNodesModel></root>\n");
  CHECK(has(project.run("answer robot.xml", "1\\n"), "1 question answered"));
  CHECK(has(project.text_of("robot.xml"),
            "\n  <!-- btcheck: allow BT2512 -->\n  <Fallback>\n"));
  CHECK(!has(project.run("robot.xml"), "BT25"));
}

}  // namespace
}  // namespace btcheck::answer_test

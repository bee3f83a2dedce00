// SPDX-License-Identifier: MIT
//
// btcheck.toml and baselines, as the program takes them: every command reads
// the settings, each in its own way of finding a tree.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck::settings_test {
namespace {

// A node of Nav2: without a profile a note says which one is guessed.
const std::string kTree =
    "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">\n"
    "<BehaviorTree ID=\"T\"><Sequence>\n"
    "<PipelineSequence><Spin/></PipelineSequence>\n"
    "<Fallback><Wait/><ForceSuccess><BackUp/></ForceSuccess></Fallback>\n"
    "</Sequence></BehaviorTree></root>\n";

// A race: one finding, BT2214, on the line of the Parallel.
std::string race(const std::string& before = "") {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">\n" + before +
         "<Parallel name=\"race\" success_count=\"1\"><A/><B/></Parallel>\n"
         "</BehaviorTree><TreeNodesModel><Action ID=\"A\"/><Action ID=\"B\"/>"
         "</TreeNodesModel></root>\n";
}

struct Project {
  TemporaryFolder folder;

  Project() { fs::create_directory(folder.path() / ".git"); }

  void write(const std::string& name, const std::string& text) const {
    const fs::path file = folder.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
  }
  Outcome run(const std::string& words) const {
    return run_in(folder.path(),
                  "timeout 60 '" BTCHECK_PROGRAM "' " + words + " 2>&1");
  }
  // Runs it and looks for a text in what it prints.
  bool says(const std::string& words, const std::string& text) const {
    const std::string all = run(words).text;
    CAPTURE(words);
    INFO(all);
    return all.find(text) != std::string::npos;
  }
};

const std::vector<std::string> kCommands = {"check a/t.xml",
                                            "lint a/t.xml",
                                            "space a/t.xml",
                                            "export a/t.xml --to dot",
                                            "export a/t.xml --to promela",
                                            "simulate a/t.xml --seed 1",
                                            "batch a -v --root ."};

struct Nav2Project : Project {
  Nav2Project() {
    write("a/t.xml", kTree);
    write("a/rules.ltl", "tree \"t.xml\"\nproperty p: possible root.success\n");
  }
};

}  // namespace

TEST_CASE("every command that takes a tree takes its settings") {
  const Nav2Project project;
  for (const std::string& command : kCommands) {
    CAPTURE(command);
    CHECK(project.says(command, "BT1637"));
  }
  project.write("btcheck.toml", "profile = \"nav2-humble\"\n");
  for (const std::string& command : kCommands) {
    CAPTURE(command);
    CHECK(!project.says(command, "BT1637"));
    CHECK(project.says(command + " --no-config", "BT1637"));
    CHECK(!project.says(command + " --profile nav2-main", "BT1637"));
    CHECK(project.says(command + " -v", "settings: "));
  }
  CHECK(project.says("a/t.xml", "profile nav2-humble"));
  CHECK(project.says("a/t.xml --profile nav2-main", "profile nav2-main"));
}

TEST_CASE("every command refuses settings with a mistake") {
  const Nav2Project project;
  project.write("btcheck.toml", "profil = \"nav2-humble\"\n");
  for (const std::string& command : kCommands) {
    const Outcome outcome = project.run(command);
    CAPTURE(command);
    CHECK(outcome.code == 2);
    CHECK(outcome.text.find("btcheck.toml:1:1") != std::string::npos);
    CHECK(project.run(command + " --no-config").code != 2);
  }
}

TEST_CASE("a level is shown and counts in every command") {
  const Nav2Project project;
  project.write("btcheck.toml", "[levels]\nBT1637 = \"error\"\n");
  for (const std::string& command : kCommands) {
    const Outcome outcome = project.run(command);
    CAPTURE(command);
    INFO(outcome.text);
    CHECK(outcome.code == 1);
    CHECK(outcome.text.find("error[BT1637]") != std::string::npos);
  }
  project.write("btcheck.toml", "[levels]\nBT1637 = \"allow\"\n");
  for (const std::string& command : kCommands) {
    CAPTURE(command);
    CHECK(!project.says(command, "BT1637"));
  }
}

TEST_CASE("settings are those next above the tree, up to the repository") {
  const Nav2Project project;
  project.write("btcheck.toml", "profile = \"nav2-humble\"\n");
  project.write("a/b/t.xml", kTree);
  CHECK(project.says("a/b/t.xml -v", "settings: btcheck.toml"));
  project.write("a/btcheck.toml", "profile = \"nav2-jazzy\"\n");
  CHECK(project.says("a/b/t.xml", "profile nav2-jazzy"));
  CHECK(project.says("a/b/t.xml -v", "settings: a/btcheck.toml"));
  CHECK(project.says("a/b/t.xml --config btcheck.toml", "profile nav2-humble"));
  fs::create_directory(project.folder.path() / "a/b/.git");
  CHECK(project.says("a/b/t.xml", "BT1637"));
  CHECK(project.run("a/b/t.xml --config nowhere.toml").code == 2);
}

TEST_CASE("settings, and what they name, are read in the root only") {
  const Nav2Project project;
  project.write("btcheck.toml", "models = \"../nodes.xml\"\n");
  CHECK(project.says("a/t.xml --root a", "error[BT0009]: `btcheck.toml`"));
  CHECK(project.says("a/t.xml --root .", "error[BT0009]: `../nodes.xml`"));
  CHECK(project.says("a/t.xml", "error[BT0009]: `../nodes.xml`"));
  CHECK(project.says("batch a", "error[BT0009]"));
  project.write("btcheck.toml", "profile = \"nav2-humble\"\n");
  // A folder is in the repository of the settings above it.
  CHECK(project.says("batch a --format json", "\"nav2-humble\""));
  CHECK(project.says("a --format json", "\"nav2-humble\""));
  CHECK(project.run("a/t.xml --root a --config btcheck.toml").code == 0);
  CHECK(project.run("batch a --config btcheck.toml").code == 0);
}

TEST_CASE("a manifest wins over settings, and resumed results know of them") {
  const Nav2Project project;
  project.write("btcheck.toml", "profile = \"nav2-jazzy\"\n");
  project.write("batch.toml",
                "[[entry]]\ntree = \"a/t.xml\"\nprofile = \"nav2-main\"\n");
  CHECK(project.says("batch batch.toml --format json", "\"nav2-main\""));
  project.write("race.xml", race());
  project.write("races.toml", "[[entry]]\ntree = \"race.xml\"\n");
  CHECK(project.run("batch races.toml --resume").code == 0);
  CHECK(project.says("batch races.toml --resume", "1 of them taken"));
  project.write("btcheck.toml", "deny = [\"BT2214\"]\n");
  CHECK(project.run("batch races.toml --resume").code == 1);
  CHECK(project.says("batch races.toml --resume", "1 of them taken"));
  CHECK(project.run("batch races.toml --resume").code == 1);
}

TEST_CASE("a level is the same in every format") {
  const Project project;
  project.write("race.xml", race());
  project.write("btcheck.toml", "[levels]\nBT2214 = \"error\"\n");
  CHECK(project.run("race.xml").code == 1);
  CHECK(project.says("race.xml", "error[BT2214]"));
  CHECK(project.says("race.xml --format json", "\"severity\": \"error\""));
  CHECK(project.says("race.xml --format jsonl", "\"severity\":\"error\""));
  CHECK(project.says("race.xml --format sarif", "\"level\": \"error\""));
  CHECK(project.says("race.xml --format github", "::error file=race.xml"));
  project.write(
      "btcheck.toml",
      "[[paths]]\nmatch = \"ra*\"\nlevels = { BT2214 = \"allow\" }\n");
  CHECK(project.says("race.xml", "no findings, 1 allowed;"));
  CHECK(project.says("race.xml --deny BT2214", "error[BT2214]"));
  CHECK(project.says("race.xml --format json", "\"allowed\": 1"));
}

TEST_CASE("a baseline knows findings again when lines have moved") {
  const Project project;
  project.write("race.xml", race());
  REQUIRE(project.run("race.xml --write-baseline ci.json").code == 0);
  project.write("race.xml", race("\n\n"));
  CHECK(project.says("race.xml --baseline ci.json",
                     "no findings, 1 in the baseline;"));
  CHECK(project.run("race.xml --baseline ci.json --deny warnings").code == 0);
  CHECK(project.run("race.xml --deny warnings").code == 1);
  CHECK(project.says("race.xml --baseline ci.json --format sarif",
                     "\"results\": []"));
  project.write("other.xml", race());
  CHECK(project.says("other.xml --baseline ci.json", "1 finding;"));
  CHECK(project.says("other.xml --baseline ci.json --format sarif",
                     "\"baselineState\": \"new\""));
  CHECK(!project.says("other.xml --baseline ci.json", "BT1512"));
}

TEST_CASE("what the baseline has and nobody finds is said, and left out") {
  const Project project;
  project.write("race.xml", race());
  project.write("other.xml", race());
  project.write("batch.toml",
                "[[entry]]\ntree = \"race.xml\"\n"
                "[[entry]]\ntree = \"other.xml\"\n");
  REQUIRE(project.run("batch batch.toml --write-baseline ci.json").code == 0);
  CHECK(project.says("batch batch.toml --baseline ci.json",
                     "2 without a fault; no findings, 2 in the baseline"));
  const std::string parallel = "success_count=\"1\"";
  std::string repaired = race();
  repaired.replace(repaired.find(parallel), parallel.size(),
                   "success_count=\"2\"");
  project.write("race.xml", repaired);
  const std::string gone =
      "note[BT1512]: 1 entry of the baseline occurs no more";
  CHECK(project.says("race.xml --baseline ci.json", gone));
  CHECK(project.says("batch batch.toml --baseline ci.json", gone));
  CHECK(project.run("race.xml --baseline ci.json --write-baseline ci.json")
            .code == 0);
  const std::string left = file_text(project.folder.path() / "ci.json");
  CHECK(left.find("other.xml") != std::string::npos);
  CHECK(left.find("race.xml") == std::string::npos);
}

TEST_CASE("lint has a baseline and levels of its own findings") {
  const Project project;
  project.write(
      "t.btf", "(defsv spare :max 3)\n(BehaviorTree :name t (Action :ID a))\n");
  CHECK(project.run("lint t.btf").code == 1);
  CHECK(project.run("lint t.btf --write-baseline b.json").code == 1);
  CHECK(project.run("lint t.btf --baseline b.json").code == 0);
  CHECK(project.says("lint t.btf --baseline b.json",
                     "1 tree, 0 findings, 1 in the baseline"));
  project.write("btcheck.toml", "[levels]\nBT2303 = \"note\"\n");
  CHECK(project.run("lint t.btf").code == 0);
  CHECK(project.says("lint t.btf", "note[BT2303]"));
  CHECK(project.run("lint t.btf --deny BT2303").code == 1);
}

}  // namespace btcheck::settings_test

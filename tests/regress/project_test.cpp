// SPDX-License-Identifier: MIT
//
// XML trees as they lie in a project: over several files, packages and folders.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck::project_test {
namespace {

const std::string kProgram = "'" BTCHECK_PROGRAM "' ";

// Five packages of one workspace.
struct Workspace : TemporaryFolder {
  Workspace() {
    fs::copy(BTCHECK_REGRESS "/workspace", path(), fs::copy_options::recursive);
  }
  Outcome lint(const std::string& words) const {
    return run_in(path(), kProgram + "lint " + words + " -q 2>errors");
  }
  Outcome run(const std::string& words) const {
    return run_in(path(), kProgram + words + " -q --jobs 1 2>errors");
  }
  std::string errors() const { return file_text(fs::path(path()) / "errors"); }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a workspace is checked as it lies there") {
  const Workspace workspace;
  const Outcome all = workspace.run("batch .");
  CHECK(all.code == 2);
  CAPTURE(all.text);
  CAPTURE(workspace.errors());
  // What is run, and nothing that is a part of it.
  CHECK(has(all.text, "src/patrol_bringup/trees/patrol.xml\n"));
  CHECK(has(all.text, "src/patrol_dock/trees/undock.xml#Undock\n"));
  CHECK(has(all.text, "src/patrol_dock/trees/undock.xml#ForceUndock\n"));
  CHECK(has(all.text, "src/patrol_old/trees/charge.xml\n"));
  CHECK(has(all.text, "4 entries: 3 without a fault, 1 broken"));
  // One tree is broken, and it is said which.
  CHECK(has(workspace.errors(),
            "error[BT1612]: no tree is called `FindCharger`"));
  CHECK(has(workspace.errors(), "src/patrol_old/trees/charge.xml:4:"));
  CHECK(!has(workspace.errors(), "BT1603"));

  // The word may be left out.
  const Outcome same = workspace.run(".");
  CHECK(same.code == 2);
  CHECK(has(same.text, "4 entries: 3 without a fault, 1 broken"));
  fs::remove_all(fs::path(workspace.path()) / "src/patrol_old");
  CHECK(workspace.run("src").code == 0);
}

TEST_CASE("the models of a project are those of all its files") {
  const Workspace workspace;
  const Outcome json = workspace.run("batch src --format json");
  CHECK(!has(json.text, "BT1620"));
  const std::string tree = "src/patrol_dock/trees/dock.xml";
  // Alone it is looked at with what lies beside it.
  const Outcome alone =
      run_in(workspace.path(), kProgram + tree + " -q 2>&1 </dev/null");
  CHECK(has(alone.text, "BT1649"));
  CHECK(has(alone.text, "BT1620"));
}

TEST_CASE("a tree by itself is looked for in all of the workspace") {
  const Workspace workspace;
  const auto write = [&](const std::string& name, const std::string& inside) {
    const fs::path file = fs::path(workspace.path()) / "src" / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "<root BTCPP_format=\"4\">" << inside << "</root>";
  };
  write("patrol_bringup/trees/alone.xml",
        "<BehaviorTree ID=\"M\"><SubTree ID=\"Inspect\"/></BehaviorTree>");
  const auto said_of = [&](const std::string& words) {
    return run_in(workspace.path(), kProgram + words + " -q 2>&1 </dev/null");
  };
  const std::string alone = "src/patrol_bringup/trees/alone.xml";
  // Each package may be a repository of its own.
  const fs::path repository =
      fs::path(workspace.path()) / "src/patrol_bringup/.git";
  fs::create_directories(repository);
  CHECK(said_of("src/patrol_bringup/trees/patrol.xml").code == 0);
  const Outcome found = said_of(alone);
  CHECK(found.code == 0);
  CHECK(has(found.text,
            "note[BT1649]: `Inspect` is in "
            "`src/patrol_skills/trees/inspect.xml`"));

  // Two that are as near: the first, and that is no secret.
  const std::string home = "<BehaviorTree ID=\"Home\">";
  write("patrol_b/home.xml", home + "<AlwaysSuccess/></BehaviorTree>");
  write("patrol_a/home.xml", home + "<AlwaysFailure/></BehaviorTree>");
  write("patrol_bringup/trees/alone.xml",
        "<BehaviorTree ID=\"M\"><SubTree ID=\"Home\"/></BehaviorTree>");
  for (const std::string& words : {alone, std::string("lint src")}) {
    CAPTURE(words);
    const Outcome either = said_of(words);
    CAPTURE(either.text);
    CHECK(has(either.text,
              "warning[BT1649]: `Home` is in `src/patrol_a/home.xml`, and "
              "otherwise in `src/patrol_b/home.xml`"));
  }
  write("patrol_b/home.xml", home + "<AlwaysFailure/></BehaviorTree>");
  CHECK(has(said_of(alone).text, "note[BT1649]"));
}

TEST_CASE("several trees are named one by one") {
  const Workspace workspace;
  const std::string folder = "src/patrol_dock/trees/";
  const Outcome both =
      workspace.run(folder + "dock.xml " + folder + "approach.xml");
  CHECK(both.code == 0);
  CHECK(has(both.text, folder + "dock.xml\n"));
  CHECK(!has(both.text, folder + "approach.xml\n"));  // it is part of the other
  CHECK(has(both.text, "1 entry: 1 without a fault"));
}

TEST_CASE("an installed package is found by AMENT_PREFIX_PATH") {
  const Workspace workspace;
  const fs::path top = workspace.path();
  fs::create_directories(top / "install/share");
  fs::rename(top / "src/patrol_skills", top / "install/share/patrol_skills");
  const std::string words =
      " src/patrol_bringup/trees/patrol.xml -q 2>&1 </dev/null";
  const Outcome without = run_in(workspace.path(), kProgram + words);
  CHECK(without.code == 2);
  CHECK(has(without.text, "there is no package `patrol_skills`"));
  const Outcome with =
      run_in(workspace.path(),
             "AMENT_PREFIX_PATH=/nowhere:$PWD/install " + kProgram + words);
  CAPTURE(with.text);
  // The tree for docking lies in another package of the workspace.
  CHECK(with.code == 0);
  CHECK(has(with.text, "BT1649"));
  CHECK(!has(with.text, "BT1603"));
}

TEST_CASE("lint takes folders") {
  const Workspace workspace;
  const Outcome all = workspace.lint("src");
  CHECK(all.code == 2);
  CHECK(has(workspace.errors(), "src/patrol_old/trees/charge.xml:4:"));
  CHECK(!has(workspace.errors(), "is a directory"));
  // The same of a single tree, which knows its neighbours only.
  CHECK(!has(all.text, "BT1620"));
  CHECK(has(workspace.lint("src/patrol_dock/trees/dock.xml").text, "BT1620"));
  fs::remove_all(fs::path(workspace.path()) / "src/patrol_old");
  CHECK(workspace.lint("src").code == 0);
  const Outcome two = run_in(
      workspace.path(), kProgram + "lint src src/patrol_dock/trees/dock.xml");
  CHECK(has(two.text, "4 trees, "));
  CHECK(workspace.lint("nowhere").code == 2);
}

TEST_CASE("what btcheck.toml excludes is left out of folders") {
  const Workspace workspace;
  const fs::path top = workspace.path();
  const auto settings = [&](const std::string& text) {
    std::ofstream(top / "btcheck.toml") << text;
  };
  settings("excludes = [\"patrol_old/\", \"src/*/undock.xml\"]\n");
  const Outcome rest = workspace.run("batch .");
  CAPTURE(rest.text);
  CHECK(rest.code == 0);
  CHECK(has(rest.text, "1 entry: 1 without a fault"));
  CHECK(workspace.lint(".").code == 0);
  // From a folder below it is the same.
  CHECK(has(run_in(top / "src", kProgram + "batch . --root .. -q 2>&1").text,
            "1 entry: 1 without a fault"));
  // A tree that is named is read.
  CHECK(workspace.run("src/patrol_old/trees/charge.xml").code == 2);
  CHECK(workspace.run("batch . --no-config").code == 2);
  settings("excludes = 3\n");
  CHECK(workspace.run("batch .").code == 2);
  CHECK(has(workspace.errors(), "error[BT1504]"));
}

TEST_CASE("a .btproj is checked tree by tree") {
  const TemporaryFolder folder;
  const fs::path top = folder.path();
  const auto put = [&](const std::string& name, const std::string& inside) {
    std::ofstream(top / name)
        << "<root BTCPP_format=\"4\">" << inside << "</root>\n";
  };
  put("a.xml", "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree>");
  put("b.xml", "<BehaviorTree ID=\"B\"><AlwaysFailure/></BehaviorTree>");
  put("robot.btproj", "<include path=\"a.xml\"/><include path=\"b.xml\"/>");
  const auto run = [&](const std::string& words) {
    return run_in(top, kProgram + words + " -q 2>&1 </dev/null");
  };
  const Outcome both = run("robot.btproj");
  CHECK(has(both.text, "robot.btproj#A\n"));
  CHECK(has(both.text, "robot.btproj#B\n"));
  CHECK(has(both.text, "2 entries"));
  CHECK(!has(both.text, "BT1611"));
  CHECK(has(run("batch robot.btproj").text, "2 entries: 2 without a fault"));
  const Outcome one = run("robot.btproj --main-tree A");
  CHECK(!has(one.text, "entries"));
  CHECK(one.code == 0);
  CHECK(run("lint robot.btproj").code == 0);
  const Outcome spaces = run("space robot.btproj");
  CHECK(spaces.code == 0);
  CHECK(has(spaces.text, "robot.btproj#A\n"));
  CHECK(has(spaces.text, "robot.btproj#B\n"));
  CHECK(!has(run("space robot.btproj --main-tree A").text, "robot.btproj#"));
  // A run is of one tree: which there are is said.
  const Outcome stepped = run("simulate robot.btproj");
  CHECK(stepped.code == 2);
  CHECK(has(stepped.text, "there are `A` and `B`"));
}

TEST_CASE("of a .btproj runs what its files name, or what no tree uses") {
  const TemporaryFolder folder;
  const fs::path top = folder.path();
  const auto put = [&](const std::string& name, const std::string& words,
                       const std::string& inside) {
    std::ofstream(top / name)
        << "<root BTCPP_format=\"4\"" << words << ">" << inside << "</root>\n";
  };
  const auto run = [&](const std::string& words) {
    return run_in(top, kProgram + words + " robot.btproj 2>&1 </dev/null");
  };
  const std::string main =
      "<BehaviorTree ID=\"A\"><SubTree ID=\"B\"/></BehaviorTree>";
  put("a.xml", "", main);
  put("b.xml", "",
      "<BehaviorTree ID=\"B\"><AlwaysSuccess/></BehaviorTree>"
      "<BehaviorTree ID=\"C\"><AlwaysFailure/></BehaviorTree>");
  put("robot.btproj", "", "<include path=\"a.xml\"/><include path=\"b.xml\"/>");
  CHECK(has(run("simulate").text, "there are `A`, `B` and `C`"));
  put("a.xml", " main_tree_to_execute=\"A\"", main);
  for (const char* command : {"simulate", "export --to dot", "lint"}) {
    CAPTURE(command);
    CHECK(run(command).code == 0);
  }
  put("a.xml", "", main);
  put("b.xml", "", "<BehaviorTree ID=\"B\"><AlwaysSuccess/></BehaviorTree>");
  for (const char* command : {"simulate", "space", "", "batch"}) {
    CAPTURE(command);
    const Outcome alone = run(command);
    CHECK(alone.code == 0);
    CHECK(!has(alone.text, "BT1611"));
  }
  CHECK(has(run("simulate").text, "note[BT1648]: `A`"));
}

TEST_CASE("trees of a file that does not say which one runs are all checked") {
  const TemporaryFolder folder;
  std::ofstream(fs::path(folder.path()) / "robot.xml")
      << "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><AlwaysSuccess/>"
         "</BehaviorTree><BehaviorTree ID=\"B\"><SubTree ID=\"C\"/>"
         "</BehaviorTree><BehaviorTree ID=\"C\"><AlwaysSuccess/>"
         "</BehaviorTree></root>\n";
  const auto run = [&](const std::string& words) {
    return run_in(folder.path(), kProgram + words + " -q 2>&1 </dev/null");
  };
  const Outcome all = run("robot.xml");
  CHECK(has(all.text, "robot.xml#A\n"));
  CHECK(has(all.text, "robot.xml#B\n"));
  CHECK(has(all.text, "2 entries: 2 without a fault"));
  CHECK(has(run("robot.xml -e 'never root.failure'").text, "BT1611"));
  CHECK(has(run("robot.xml --main-tree C").text, "2 nodes, 10 states"));
}

TEST_CASE("a finding in a file that nobody includes is quoted and repaired") {
  const TemporaryFolder folder;
  const fs::path top = folder.path();
  std::ofstream(top / "a.xml")
      << "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><SubTree ID=\"B\"/>"
         "</BehaviorTree></root>\n";
  std::ofstream(top / "b.xml")
      << "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><Sequence>\n"
         "<Fallback><AlwaysSuccess/><Never/></Fallback>\n"
         "<RetryUntilSuccessful num_attempts=\"-1\"><Work/>"
         "</RetryUntilSuccessful>\n"
         "</Sequence></BehaviorTree></root>\n";
  const Outcome outcome = run_in(top, kProgram + "a.xml 2>&1 </dev/null");
  CAPTURE(outcome.text);
  CHECK(has(outcome.text, "2 | <Fallback><AlwaysSuccess/><Never/></Fallback>"));
  CHECK(has(outcome.text, "+<RetryUntilSuccessful num_attempts=\"5\">"));
}

TEST_CASE("a folder that is called like a tree's file is a folder") {
  const TemporaryFolder folder;
  const fs::path trees = fs::path(folder.path()) / "missions.btf";
  fs::create_directory(trees);
  std::ofstream(trees / "patrol.btf")
      << "(BehaviorTree :name patrol (Action :ID drive))\n";
  std::ofstream(trees / "patrol.ltl") << "property p: never root.failure\n";
  std::ofstream(fs::path(folder.path()) / "secret.btf") << "(secret)\n";
  std::ofstream(trees / "out.ltl") << "tree \"../secret.btf\"\n";
  const auto run = [&](const std::string& words) {
    return run_in(folder.path(), kProgram + words + " -q 2>&1 </dev/null");
  };
  const Outcome outcome = run("batch missions.btf");
  CHECK(has(outcome.text, "2 entries: 0 met, 1 missed, 1 broken"));
  CHECK(!has(outcome.text, "(secret)"));
  CHECK(has(run("missions.btf").text, "2 entries"));
}

TEST_CASE("a kept run has the texts of all files of its tree") {
  const Workspace workspace;
  const std::string tree = "src/patrol_dock/trees/dock.xml";
  run_in(
      workspace.path(),
      kProgram + tree + " -e 'never root.running' --trace-dir runs >out 2>&1");
  std::string kept;
  for (const auto& each :
       fs::directory_iterator(fs::path(workspace.path()) / "runs")) {
    if (each.path().string().ends_with(".itf.json")) {
      kept = file_text(each.path());
    }
  }
  CHECK(has(kept, "src/patrol_dock/trees/approach.xml"));
  CHECK(has(kept, "BehaviorTree ID=\\\"Approach"));
}

TEST_CASE("files of another format are each named") {
  const TemporaryFolder folder;
  for (const char* name : {"a.json", "b.json"}) {
    std::ofstream(fs::path(folder.path()) / name) << "{\"a\": 1}";
  }
  const Outcome both =
      run_in(folder.path(), kProgram + "a.json b.json -q 2>&1");
  CHECK(both.code == 2);
  CHECK(has(both.text, "error[BT1652]: `a.json` is JSON\n"));
  CHECK(has(both.text, "error[BT1652]: `b.json` is JSON\n"));
}

}  // namespace btcheck::project_test

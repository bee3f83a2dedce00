// SPDX-License-Identifier: MIT
//
// XML trees as they lie in a project: over several files, packages and folders.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace {

using btcheck::file_text;
using btcheck::Outcome;
using btcheck::run_in;
using btcheck::TemporaryFolder;

const std::string kProgram = "'" BTCHECK_PROGRAM "' ";

// Five packages of one workspace.
struct Workspace : TemporaryFolder {
  Workspace() {
    fs::copy(BTCHECK_REGRESS "/workspace", path(), fs::copy_options::recursive);
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
  CHECK(has(all.text, "4 entries: 3 met, 1 broken"));
  // One tree is broken, and it is said which.
  CHECK(has(workspace.errors(),
            "error[BT1612]: no tree is called `FindCharger`"));
  CHECK(has(workspace.errors(), "src/patrol_old/trees/charge.xml:4:"));
  CHECK(!has(workspace.errors(), "BT1603"));

  // The word may be left out.
  const Outcome same = workspace.run(".");
  CHECK(same.code == 2);
  CHECK(has(same.text, "4 entries: 3 met, 1 broken"));
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

TEST_CASE("several trees are named one by one") {
  const Workspace workspace;
  const std::string folder = "src/patrol_dock/trees/";
  const Outcome both =
      workspace.run(folder + "dock.xml " + folder + "approach.xml");
  CHECK(both.code == 0);
  CHECK(has(both.text, folder + "dock.xml\n"));
  CHECK(!has(both.text, folder + "approach.xml\n"));  // it is part of the other
  CHECK(has(both.text, "1 entry: 1 met"));
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
  // The tree for docking lies in another package, which nobody has named.
  CHECK(has(with.text, "BT1612"));
  CHECK(!has(with.text, "BT1603"));
}

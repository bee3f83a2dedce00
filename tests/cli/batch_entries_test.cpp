// SPDX-License-Identifier: MIT
//
// From folders and manifests to entries.
#include "batch/entries/entries.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace btcheck::batch_entries_test {
namespace {

namespace fs = std::filesystem;

struct Folder : TemporaryFolder {
  std::string put(const std::string& name, const std::string& text = "") const {
    const fs::path file = path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  std::string name(const std::string& file) const { return path() / file; }

  // "NAME: TREE + PROPERTIES", without the folder; "!" for an error.
  std::vector<std::string> told(const std::vector<BatchEntry>& entries) const {
    const std::string start = path().string() + "/";
    const auto inside = [&](const std::string& file) {
      return file.starts_with(start) ? file.substr(start.size()) : file;
    };
    std::vector<std::string> lines;
    for (const BatchEntry& entry : entries) {
      std::string line = inside(entry.name) + ": " + inside(entry.input);
      for (const std::string& file : entry.properties) {
        line += " + " + inside(file);
      }
      lines.push_back(line + (has_error(entry.diagnostics) ? " !" : ""));
    }
    return lines;
  }
};

using Lines = std::vector<std::string>;

Options options_for(const std::string& source) {
  Options options;
  options.batch.sources = {source};
  return options;
}

TEST_CASE("pairs are found by the tree's line, else by name, in all folders") {
  const Folder folder;
  folder.put("b.btf");
  folder.put("b.ltl", "property p: never x.failure");
  folder.put("a/named.ltl", "tree \"../c.btf\"\nproperty p: never x.failure");
  folder.put("a/own.btp", "property p: never x.failure");
  folder.put("a/own.btf");
  folder.put("c.btf");
  folder.put("alone.btf");
  folder.put("orphan.ltl", "property p: never x.failure");
  folder.put("unreadable.ltl", "property");
  folder.put("notes.txt");
  folder.put(".hidden/h.btf");
  CHECK(folder.told(entries_in(folder.path(), {})) ==
        Lines{"a/named.ltl: c.btf + a/named.ltl",
              "a/own.btp: a/own.btf + a/own.btp", "alone.btf: alone.btf",
              "b.ltl: b.btf + b.ltl", "orphan.ltl: orphan.ltl",
              "unreadable.ltl: unreadable.ltl"});
  CHECK(folder.told(entries_in(folder.path(), {"a/", "b.ltl", "./c.btf"})) ==
        Lines{"alone.btf: alone.btf", "b.btf: b.btf", "orphan.ltl: orphan.ltl",
              "unreadable.ltl: unreadable.ltl"});
}

TEST_CASE("folders that are links are not followed") {
  const Folder folder;
  folder.put("in/t.btf");
  fs::create_directory_symlink(folder.path(), folder.path() / "in/round");
  CHECK(folder.told(entries_in(folder.path(), {})) ==
        Lines{"in/t.btf: in/t.btf"});
}

TEST_CASE(
    "a folder with nothing in it, or none at all, is an entry with an "
    "error") {
  const Folder folder;
  const auto empty = entries_in(folder.path(), {});
  REQUIRE(empty.size() == 1);
  CHECK(empty[0].diagnostics.at(0).code == "BT1507");
  const auto missing = entries_in(folder.name("no"), {});
  REQUIRE(missing.size() == 1);
  CHECK(missing[0].diagnostics.at(0).code == "BT0002");
}

TEST_CASE("a manifest names files from where it stands") {
  const Folder folder;
  folder.put("trees/a.btf");
  folder.put("trees/more/b.btf");
  folder.put("rules/p.ltl", "property p: never x.failure");
  const std::string manifest =
      folder.put("rules/all.toml",
                 "defaults = { timeout = 3 }\n"
                 "[[entry]]\nfolder = \"../trees\"\nexclude = \"a.btf\"\n"
                 "[[entry]]\ntree = \"../trees/a.btf\"\n"
                 "properties = \"p.ltl\"\n"
                 "[[entry]]\nproperties = \"p.ltl\"\ntimeout = 4\n"
                 "[[entry]]\nname = \"mine\"\ntree = \"x.btf\"\n"
                 "[[entry]]\n");
  const auto entries = gather_batch(options_for(manifest));
  CHECK(folder.told(entries) == Lines{"trees/more/b.btf: trees/more/b.btf",
                                      "rules/p.ltl: trees/a.btf + rules/p.ltl",
                                      "rules/p.ltl#2: rules/p.ltl",
                                      "mine: rules/x.btf",
                                      "rules/all.toml: rules/all.toml !"});
  CHECK(applied({}, entries[0].choices).timeout == 3);
  CHECK(applied({}, entries[2].choices).timeout == 4);
}

TEST_CASE("an entry whose property files are none is called by its tree") {
  const Folder folder;
  const std::string manifest =
      folder.put("m.toml", "[[entry]]\ntree = \"a.btf\"\nproperties = [1]\n");
  CHECK(folder.told(gather_batch(options_for(manifest))) ==
        Lines{"a.btf: a.btf !"});
}

TEST_CASE("what the settings exclude is not read") {
  const Folder folder;
  for (const char* name :
       {"a.btf", "old.btf", "sub/old.btf", "sub/b.btf", "build/c.btf",
        "sub/build/d.btf", "vendor/e.btf", "vendor/deep/f.btf"}) {
    folder.put(name);
  }
  const auto left = [&](const std::vector<std::string>& patterns) {
    return folder.told(
        entries_in(folder.path(), {}, Excludes{folder.path(), patterns}));
  };
  // A name, wherever it is; a path, from the folder of the settings.
  CHECK(left({"build", "vendor"}) == Lines{"a.btf: a.btf", "old.btf: old.btf",
                                           "sub/b.btf: sub/b.btf",
                                           "sub/old.btf: sub/old.btf"});
  CHECK(left({"old.*", "sub/build", "*/deep/*", "vendor/e.btf"}) ==
        Lines{"a.btf: a.btf", "build/c.btf: build/c.btf",
              "sub/b.btf: sub/b.btf"});
  CHECK(left({}).size() == 8);
  const auto none = entries_in(folder.path(), {}, {folder.path(), {"*"}});
  REQUIRE(none.size() == 1);
  CHECK(none[0].diagnostics.at(0).code == "BT1507");
}

TEST_CASE("a .btproj stands for what its files run") {
  const Folder folder;
  const auto tree = [](const std::string& id, const std::string& uses,
                       const std::string& main) {
    return "<root BTCPP_format=\"4\"" + main + "><BehaviorTree ID=\"" + id +
           "\"><Sequence><A/>" + uses + "</Sequence></BehaviorTree></root>";
  };
  folder.put("trees/a.xml", tree("A", "<SubTree ID=\"Part\"/>",
                                 " main_tree_to_execute=\"A\""));
  folder.put("trees/b.xml", tree("B", "", ""));
  folder.put("trees/part.xml", tree("Part", "", ""));
  const std::string project = folder.put(
      "robot.btproj",
      "<root BTCPP_format=\"4\" project_name=\"r\">"
      "<include path=\"trees/a.xml\"/><include path=\"trees/b.xml\"/>"
      "<include path=\"trees/part.xml\"/></root>");
  const auto entries = gather_batch(options_for(project));
  CHECK(folder.told(entries) ==
        Lines{"robot.btproj#A: robot.btproj", "robot.btproj#B: robot.btproj"});
  CHECK(applied({}, entries.at(1).choices).main_tree == "B");
  Options one = options_for(project);
  one.main_tree = "B";
  CHECK(folder.told(gather_batch(one)) == Lines{"robot.btproj: robot.btproj"});
  // In a folder the files stand for themselves.
  CHECK(folder.told(entries_in(folder.path(), {})) ==
        Lines{"trees/a.xml: trees/a.xml", "trees/b.xml: trees/b.xml"});
}

TEST_CASE("a folder with a manifest of its own is what that says") {
  const Folder folder;
  folder.put("a.btf");
  folder.put("b.btf");
  folder.put("batch.toml", "[[entry]]\ntree = \"b.btf\"\n");
  CHECK(folder.told(gather_batch(options_for(folder.path()))) ==
        Lines{"b.btf: b.btf"});
}

TEST_CASE("files of contracts are named from the manifest") {
  const Folder folder;
  folder.put("trees/p.ltl", "tree \"t.xml\"\nproperty p: never x.failure");
  folder.put("trees/t.xml");
  const std::string manifest =
      folder.put("m.toml",
                 "[defaults]\nleaves = \"all.leaves\"\n"
                 "[[entry]]\nfolder = \"trees\"\n"
                 "[[entry]]\ntree = \"trees/t.xml\"\n"
                 "leaves = [\"trees/t.leaves\", \"all.leaves\"]\n"
                 "[[entry]]\ntree = \"trees/t.xml\"\nleaves = []\n");
  const auto entries = gather_batch(options_for(manifest));
  REQUIRE(entries.size() == 3);
  CHECK(applied({}, entries[0].choices).leaves ==
        Lines{folder.name("all.leaves")});
  CHECK(applied({}, entries[1].choices).leaves ==
        Lines{folder.name("trees/t.leaves"), folder.name("all.leaves")});
  CHECK(applied({}, entries[2].choices).leaves == Lines{});
}

TEST_CASE("what cannot be a source is an entry with an error") {
  const Folder folder;
  folder.put("a.txt");
  Options options = options_for(folder.name("a.txt"));
  options.batch.sources.push_back(folder.name("no"));
  options.batch.sources.push_back(folder.put("bad.toml", "[[entry]\n"));
  // A tree comes before the folders and manifests.
  options.batch.sources.push_back(folder.put("a.btf"));
  const auto entries = gather_batch(options);
  REQUIRE(entries.size() == 4);
  CHECK(entries[0].diagnostics.empty());
  CHECK(entries[1].diagnostics.at(0).code == "BT1501");
  CHECK(entries[2].diagnostics.at(0).code == "BT0002");
  CHECK(entries[3].diagnostics.at(0).code == "BT1502");
}

TEST_CASE("no two entries have one name, or one folder for their runs") {
  const Folder folder;
  const std::string manifest =
      folder.put("m.toml",
                 "[[entry]]\nname = \"a/b\"\ntree = \"t\"\n"
                 "[[entry]]\nname = \"a_b\"\ntree = \"t\"\n"
                 "[[entry]]\nname = \"a/b\"\ntree = \"t\"\n"
                 "[[entry]]\nname = \"..\"\ntree = \"t\"\n");
  const auto entries = gather_batch(options_for(manifest));
  REQUIRE(entries.size() == 4);
  CHECK(entries[0].folder == "a_b");
  CHECK(entries[1].folder == "a_b-2");
  CHECK(entries[2].name == "a/b#2");
  CHECK(entries[2].folder == "a_b_2");
  CHECK(entries[3].folder == "__");  // not the folder above
}

TEST_CASE("the shards of a batch are all of it, once") {
  const Folder folder;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    folder.put(std::string(name) + ".btf");
  }
  Options options = options_for(folder.path());
  const auto whole = gather_batch(options);
  CHECK(whole.size() == 5);
  std::vector<std::string> names;
  for (unsigned i = 1; i <= 3; ++i) {
    options.batch.shard = {i, 3};
    for (const BatchEntry& entry : gather_batch(options)) {
      names.push_back(entry.name);
    }
  }
  std::sort(names.begin(), names.end());
  REQUIRE(names.size() == whole.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK(names[i] == whole[i].name);
  }
}

TEST_CASE("parts are written i/n") {
  REQUIRE(shard_of("2/3").has_value());
  CHECK(shard_of("2/3")->index == 2);
  CHECK(shard_of("2/3")->count == 3);
  for (const char* text : {"", "2", "0/3", "4/3", "a/b", "1/3x", "-1/3", "1/0",
                           "1/", "/1", "1/99999", "1 / 2"}) {
    CAPTURE(text);
    CHECK(!shard_of(text).has_value());
  }
}

TEST_CASE("results are kept beside the folder's contents or the manifest") {
  const Folder folder;
  folder.put("a.btf");
  folder.put("sub/batch.toml", "[[entry]]\ntree=\"a.btf\"\n");
  folder.put("night.toml", "[[entry]]\ntree=\"a.btf\"\n");
  CHECK(results_file(options_for(folder.path()).batch) ==
        folder.name(".btcheck-results"));
  CHECK(results_file(options_for(folder.name("sub")).batch) ==
        folder.name("sub/.btcheck-results"));
  BatchOptions night = options_for(folder.name("night.toml")).batch;
  night.shard = {2, 3};
  CHECK(results_file(night) == folder.name(".btcheck-results-night-2-3"));
}

}  // namespace
}  // namespace btcheck::batch_entries_test

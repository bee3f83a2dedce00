// SPDX-License-Identifier: MIT
//
// Manifests: what they say, and what is wrong with them, to the letter.
#include "batch/entries/manifest.hpp"

#include <doctest/doctest.h>

#include <string>

namespace btcheck::manifest_test {
namespace {

Manifest read(const std::string& text) {
  return read_manifest("batch.toml", text);
}

// The only entry of a manifest in which nothing is wrong.
ManifestEntry entry_of(const std::string& text) {
  Manifest manifest = read(text);
  for (const Diagnostic& found : manifest.diagnostics) FAIL(render(found));
  REQUIRE(manifest.entries.size() == 1);
  for (const Diagnostic& found : manifest.entries[0].diagnostics) {
    FAIL(render(found));
  }
  return manifest.entries[0];
}

// The only thing that is wrong with a manifest as a whole, or with its entry.
std::string mistake_in(const std::string& text) {
  const Manifest manifest = read(text);
  std::vector<Diagnostic> found = manifest.diagnostics;
  for (const ManifestEntry& entry : manifest.entries) {
    found.insert(found.end(), entry.diagnostics.begin(),
                 entry.diagnostics.end());
  }
  CHECK(manifest.entries.empty() == has_error(manifest.diagnostics));
  REQUIRE(found.size() == 1);
  return render(found[0]);
}

TEST_CASE("an entry names a tree, property files and verdicts") {
  const ManifestEntry entry = entry_of(
      "[[entry]]\n"
      "name = \"by nodes\"\n"
      "tree = \"t.btf\"\n"
      "properties = [\"a.ltl\", \"b.ltl\"]\n"
      "expect = { z = \"holds\", a = \"violated\" }\n");
  CHECK(entry.name == "by nodes");
  CHECK(entry.tree == "t.btf");
  CHECK(entry.properties == std::vector<std::string>{"a.ltl", "b.ltl"});
  REQUIRE(entry.expected.size() == 2);
  CHECK(entry.expected[0].property == "z");  // as written, not by name
  CHECK(entry.expected[0].expectation == Expectation::Holds);
  CHECK(entry.expected[1].property == "a");
  CHECK(entry.expected[1].expectation == Expectation::Violated);
  CHECK(entry.expected[1].place.span.line == 5);
  CHECK(entry.expected[1].place.span.column == 25);
}

TEST_CASE("one property file needs no list, and a folder may leave some out") {
  CHECK(entry_of("[[entry]]\nproperties = \"p.ltl\"\n").properties.size() == 1);
  const ManifestEntry entry =
      entry_of("[[entry]]\nfolder = \".\"\nexclude = \"draft.btf\"\n");
  CHECK(entry.folder == ".");
  CHECK(entry.exclude == std::vector<std::string>{"draft.btf"});
}

TEST_CASE("every option of a check may stand in an entry") {
  const OptionChoices choices = entry_of(
                                    "[[entry]]\ntree = \"t.btf\"\n"
                                    "tick = \"nodes\"\nsearch = \"dfs\"\n"
                                    "reduce = \"live\"\n"
                                    "assume = \"actions-end\"\nthreads = 3\n"
                                    "max-states = 1000\nmemory = \"2M\"\n"
                                    "timeout = 1.5\n"
                                    "leaves = [\"a.leaves\", \"b.leaves\"]\n")
                                    .choices;
  const Options chosen = applied({}, choices);
  CHECK(chosen.ticks == TickSemantics::Nodes);
  CHECK(chosen.search == SearchOrder::DepthFirst);
  CHECK(chosen.reduce == Reduction::Live);
  CHECK(chosen.assume == ExtraAssumption::ActionsEnd);
  CHECK(chosen.threads == 3);
  CHECK(chosen.max_states == 1000);
  CHECK(chosen.max_bytes == 2 << 20);
  CHECK(chosen.timeout == 1.5);
  CHECK(chosen.leaves == std::vector<std::string>{"a.leaves", "b.leaves"});
  Options options;
  options.leaves = {"c.leaves"};
  options.timeout = 9;
  options.search = SearchOrder::BreadthFirst;
  options.max_states = 7;
  options.tick_ms = 10;
  const Options both = applied(options, choices);
  CHECK(both.timeout == 1.5);
  CHECK(both.search == SearchOrder::DepthFirst);
  CHECK(both.max_states == 1000);
  CHECK(both.leaves == chosen.leaves);
  CHECK(both.tick_ms == 10);
  CHECK(applied(options, {}).max_states == 7);
  CHECK(applied(options, {}).leaves == options.leaves);
}

TEST_CASE("how an XML tree is read may stand in an entry, too") {
  const Options chosen =
      applied({}, entry_of("[[entry]]\ntree = \"t.xml\"\n"
                           "profile = \"nav2-humble\"\ntick-ms = 20\n"
                           "loop = true\nwake-ups = true\n"
                           "main-tree = \"Patrol\"\n")
                      .choices);
  CHECK(chosen.profile == Profile::Nav2Humble);
  CHECK(chosen.tick_ms == 20);
  CHECK(chosen.loops);
  CHECK(chosen.wakes);
  CHECK(chosen.main_tree == "Patrol");
}

TEST_CASE("defaults are for every entry that says nothing else") {
  const Manifest manifest = read(
      "[[entry]]\ntree = \"a.btf\"\n"
      "[[entry]]\ntree = \"b.btf\"\ntimeout = 0\n"
      "[defaults]\ntimeout = 5\ntick = \"none\"\n");
  REQUIRE(manifest.entries.size() == 2);
  const Options first = applied({}, manifest.entries[0].choices);
  Options line;
  line.timeout = 9;
  const Options second = applied(line, manifest.entries[1].choices);
  CHECK(first.timeout == 5);
  CHECK(second.timeout == 0);
  CHECK(second.ticks == TickSemantics::None);
}

TEST_CASE("what is no TOML is refused where it goes wrong") {
  const std::string found = mistake_in("[[entry]]\ntree = \"t.btf\n");
  CHECK(
      found.starts_with("error[BT1502]: this is not TOML\n"
                        "  --> batch.toml:2:"));
  CHECK(mistake_in("[[ = 1").starts_with("error[BT1502]"));
  CHECK(mistake_in("\ufefe=").starts_with("error[BT1502]"));
  CHECK(mistake_in(std::string("a = \"\0\"", 7)).starts_with("error[BT1000]"));
  CHECK(mistake_in("a = \"\xff\"").starts_with("error[BT1000]"));
}

TEST_CASE("unknown keys and words are refused with what is near") {
  CHECK(mistake_in("[[entry]]\ntree = \"t.btf\"\ntimeuot = 5\n") ==
        "error[BT1503]: unknown key `timeuot`\n"
        "  --> batch.toml:3:1\n"
        "  |\n"
        "3 | timeuot = 5\n"
        "  | ^^^^^^^\n"
        "  |\n"
        "  = help: did you mean `timeout`?\n");
  CHECK(mistake_in("[[entry]]\ntree = \"t.btf\"\ntick = \"node\"\n") ==
        "error[BT1504]: `tick` is one of: root, leaves, nodes, none\n"
        "  --> batch.toml:3:8\n"
        "  |\n"
        "3 | tick = \"node\"\n"
        "  |        ^^^^^^ not one of them\n"
        "  |\n"
        "  = help: did you mean `nodes`?\n");
  CHECK(mistake_in("[[entry]]\ntree = \"t.btf\"\n[default]\n")
            .starts_with("error[BT1503]: unknown key `default`\n"));
  CHECK(mistake_in("[defaults]\ntree = \"t.btf\"\n[[entry]]\nfolder=\".\"\n")
            .starts_with("error[BT1503]: unknown key `tree`\n"));
}

TEST_CASE("values of the wrong kind are refused") {
  CHECK(mistake_in("[[entry]]\ntree = \"t.btf\"\ntimeout = \"5\"\n") ==
        "error[BT1504]: `timeout` is a number of seconds, 0 for no limit\n"
        "  --> batch.toml:3:11\n"
        "  |\n"
        "3 | timeout = \"5\"\n"
        "  |           ^^^ this is a text\n"
        "  |\n"
        "  = help: write for instance `timeout = 60`\n");
  for (const char* line : {"timeout = -1",
                           "timeout = nan",
                           "timeout = inf",
                           "threads = 0",
                           "threads = 257",
                           "threads = 1.0",
                           "max-states = 0",
                           "max-states = -4",
                           "memory = 4",
                           "memory = \"4 apples\"",
                           "tick = 3",
                           "tree = []",
                           "tree = \"\"",
                           "properties = [1]",
                           "name = true",
                           "expect = 1",
                           "expect = { p = \"true\" }",
                           "expect = { p = 1 }",
                           "exclude = 1979-05-27",
                           "search = \"\"",
                           "leaves = 1",
                           "leaves = \"\"",
                           "folder = {}"}) {
    CAPTURE(line);
    CHECK(mistake_in("[[entry]]\nproperties = \"p.ltl\"\n" + std::string(line) +
                     "\n")
              .find("BT15") != std::string::npos);
  }
}

TEST_CASE("what does not go together is refused") {
  CHECK(mistake_in("[[entry]]\n").starts_with("error[BT1505]"));
  CHECK(mistake_in("[[entry]]\ntimeout = 3\n") ==
        "error[BT1505]: an entry without a tree\n"
        "  --> batch.toml:1:1\n"
        "  |\n"
        "1 | [[entry]]\n"
        "  | ^^^^^^^^^\n"
        "  |\n"
        "  = help: write `tree = \"TREE\"`, `properties = \"RULES.ltl\"` or "
        "`folder = \"TREES\"`\n");
  for (const char* lines :
       {"folder = \".\"\ntree = \"t.btf\"", "folder = \".\"\nname = \"n\"",
        "folder = \".\"\nproperties = \"p.ltl\"",
        "tree = \"t.btf\"\nexclude = \"x\"",
        "tree = \"t.btf\"\nexpect = { p = \"holds\" }",
        "folder = \".\"\nexpect = { p = \"holds\" }"}) {
    CAPTURE(lines);
    CHECK(mistake_in("[[entry]]\n" + std::string(lines) + "\n")
              .starts_with("error[BT1505]"));
  }
}

TEST_CASE("a manifest without entries, or with something else in their place") {
  CHECK(mistake_in("").starts_with("error[BT1507]: no entry in this manifest"));
  CHECK(mistake_in("entry = 3\n").starts_with("error[BT1504]"));
  CHECK(mistake_in("entry = [1]\n").starts_with("error[BT1504]"));
  CHECK(mistake_in("[entry]\ntree = \"t.btf\"\n")
            .find("help: write `[[entry]]`") != std::string::npos);
  CHECK(mistake_in("defaults = 1\n[[entry]]\nfolder=\".\"\n")
            .starts_with("error[BT1504]"));
}

TEST_CASE("a mistake in an entry is its own") {
  const Manifest manifest = read(
      "[[entry]]\nb = 1\ntree = \"a.btf\"\na = 2\n"
      "[[entry]]\ntree = \"b.btf\"\n");
  REQUIRE(manifest.entries.size() == 2);
  REQUIRE(manifest.entries[0].diagnostics.size() == 2);
  CHECK(manifest.entries[0].diagnostics[0].span.line == 2);  // in order
  CHECK(manifest.entries[0].diagnostics[1].span.line == 4);
  CHECK(manifest.entries[1].diagnostics.empty());
}

TEST_CASE("what a key has that a terminal would obey is not shown") {
  const std::string found =
      mistake_in("[[entry]]\ntree = \"t.btf\"\n\"\\u001b[31m\" = 1\n");
  CHECK(found.find('\x1b') == std::string::npos);
  CHECK(found.starts_with("error[BT1503]: unknown key `?[31m`"));
}

}  // namespace
}  // namespace btcheck::manifest_test

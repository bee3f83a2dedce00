// SPDX-License-Identifier: MIT
//
// `btcheck batch` as a whole: many trees with broken ones among them, killed
// and resumed, interrupted, in parts.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "regress/batch_place.hpp"

namespace btcheck::batch_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE(
    "of 200 trees, ten of them broken, 190 are checked, by one job as by "
    "two") {
  const BatchPlace place;
  generate_trees(place.path() / "trees", 200);
  const Outcome one = place.run("trees -q --jobs 1 2>err1");
  const Outcome two = place.run("trees -q --jobs 2 2>err2");
  CHECK(one.code == 2);
  CHECK(two.code == 2);
  CHECK(without_times(one.text) == without_times(two.text));
  const std::string complaints = file_text(place.path() / "err1");
  CHECK(complaints == file_text(place.path() / "err2"));
  CHECK(lines_with(one.text, "BROKEN ") == 10);
  CHECK(lines_with(one.text, "MET          3 of 3 ") == 190);
  CHECK(lines_with(one.text, "200 entries: 190 met, 10 broken") == 1);
  // One diagnostic for each broken tree, in the order of the table.
  CHECK(lines_with(complaints, "error[BT10") == 10);
  CHECK(lines_with(complaints, "  --> trees/part3/007.btf") == 1);
}

TEST_CASE("every format has the same entries, by one job as by two") {
  const BatchPlace place;
  generate_trees(place.path() / "trees", 40);
  for (const char* format :
       {"json", "jsonl", "sarif", "junit", "github", "gitlab"}) {
    CAPTURE(format);
    const std::string words = std::string("trees -q --format ") + format;
    const Outcome one = place.run(words + " --jobs 1 2>/dev/null");
    const Outcome two = place.run(words + " --jobs 2 2>/dev/null");
    CHECK(one.code == 2);
    CHECK(!one.text.empty());
    CHECK(without_times(one.text) == without_times(two.text));
  }
}

TEST_CASE("killed half-way and resumed, a batch ends with the same reports") {
  const BatchPlace place;
  fs::copy(BTCHECK_EXAMPLES, place.path() / "examples",
           fs::copy_options::recursive);
  fs::remove(place.path() / "examples/.btcheck-results");
  const std::string words = "examples --jobs 1" + kReports;
  const std::string whole = reports_in(place, place.run(words + "2>err"));
  for (const char* file :
       {"r.json", "r.xml", "r.sarif", "r.txt", "r.lab", "r.jsonl", "r.html"}) {
    fs::remove(place.path() / file);
  }
  // The kill comes when three entries are done.
  const Outcome killed = run_in(
      place.path(), "f=examples/.btcheck-results; rm $f; " + kBatch + words +
                        ">/dev/null 2>&1 & batch=$!; "
                        "until [ -e $f ] && [ $(wc -l <$f) -ge 3 ]; "
                        "do kill -0 $batch || exit 1; done; "
                        "kill -9 $batch && ! wait $batch 2>/dev/null");
  REQUIRE(killed.code == 0);
  CHECK(!fs::exists(place.path() / "r.json"));
  const Outcome resumed = place.run(words + "--resume 2>err");
  CHECK(reports_in(place, resumed) == whole);
  const std::string statistics = file_text(place.path() / "err");
  CHECK(statistics.find(" of them taken from an earlier run") !=
        std::string::npos);
  CHECK(statistics.find(" 20 of them") == std::string::npos);
  // And once more, when there is nothing left to do.
  CHECK(reports_in(place, place.run(words + "--resume 2>err")) == whole);
  CHECK(file_text(place.path() / "err").find(", 20 of them taken from") !=
        std::string::npos);
}

// How many entries a resumed batch takes from the run before it.
int taken(const BatchPlace& place, const std::string& words) {
  const std::string text =
      run_in(place.path(), kBatch + words + " --resume 2>&1 >/dev/null").text;
  std::smatch found;
  const std::regex pattern(", ([0-9]+) of them taken from an earlier run");
  return std::regex_search(text, found, pattern) ? std::stoi(found[1]) : 0;
}

TEST_CASE("what has changed is checked again, and nothing else") {
  const BatchPlace place;
  const fs::path f = place.path() / "f";
  for (const char* name : {"a", "b", "c"}) {
    put_pair(f / name, "possible root.success");
  }
  CHECK(taken(place, "f") == 0);
  CHECK(taken(place, "f") == 3);
  CHECK(taken(place, "f --jobs 1 --threads 1") == 3);
  put_pair(f / "b", "possible root.failure");
  CHECK(taken(place, "f") == 2);
  put(f / "a.btf", "(BehaviorTree :name t (Sequence (Action :ID a)))\n");
  CHECK(taken(place, "f") == 2);
  CHECK(taken(place, "f --tick nodes") == 0);
  CHECK(taken(place, "f --tick nodes") == 3);
  // The file has the results of the last batch, and no older ones.
  const std::string kept = file_text(f / ".btcheck-results");
  CHECK(std::count(kept.begin(), kept.end(), '\n') == 1 + 3);
  CHECK(taken(place, "f --max-states 99999 --tick nodes") == 0);
  // A run's page that is gone is made again.
  CHECK(taken(place, "f --trace-dir runs") == 0);
  CHECK(taken(place, "f --trace-dir runs") == 3);
  fs::remove_all(place.path() / "runs/f_c_ltl");
  CHECK(taken(place, "f --trace-dir runs") == 2);
  CHECK(fs::exists(place.path() / "runs/f_c_ltl/c.p.html"));
  // Without --resume everything is done again, and kept.
  CHECK(place.run("f 2>/dev/null").code == 0);
  CHECK(taken(place, "f") == 3);
}

TEST_CASE("an entry whose contracts have changed is checked again") {
  const BatchPlace place;
  const fs::path f = place.path() / "f";
  put(f / "t.xml",
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><A/></BehaviorTree>"
      "</root>\n");
  put(f / "p.ltl", "tree \"t.xml\"\nproperty p: never A.failure\n");
  put(f / "batch.toml",
      "[[entry]]\nproperties = \"p.ltl\"\nleaves = \"all.leaves\"\n");
  put(f / "all.leaves", "(defaction A :returns (success))\n");
  CHECK(place.run("f 2>/dev/null").code == 0);
  CHECK(taken(place, "f") == 1);
  put(f / "all.leaves", "(defaction A :returns (failure))\n");
  CHECK(place.run("f --resume 2>/dev/null").code == 1);
  fs::remove(f / "all.leaves");
  CHECK(place.run("f --resume 2>/dev/null").code == 2);
}

TEST_CASE("a damaged file of results is said to be so, and made again") {
  const BatchPlace place;
  const fs::path f = place.path() / "f";
  for (const char* name : {"a", "b", "c"}) {
    put_pair(f / name, "possible root.success");
  }
  const std::string whole = place.run("f 2>/dev/null").text;
  std::string kept = file_text(f / ".btcheck-results");
  const std::size_t line = kept.find('\n');
  kept[line + 100] = static_cast<char>(kept[line + 100] ^ 1);
  kept.resize(kept.size() - 5);
  put(f / ".btcheck-results", kept);
  CHECK(place.complaints("f --resume") ==
        "warning[BT1508]: 2 of the results kept in `f/.btcheck-results` are "
        "damaged, and done again\n  --> f/.btcheck-results\n\n");
  CHECK(place.complaints("f --resume").empty());
  CHECK(without_times(place.run("f --resume 2>/dev/null").text) ==
        without_times(whole));
}

TEST_CASE("--fail-fast tells what is before the first that fails, and it") {
  const BatchPlace place;
  const fs::path f = place.path() / "f";
  for (const char* name : {"a", "b", "c", "d", "e", "g"}) {
    put_pair(f / name, "possible root.success");
  }
  put_pair(f / "c", "never root.success");
  for (const char* jobs : {"1", "2", "4"}) {
    const Outcome found =
        place.run("f --fail-fast 2>/dev/null --jobs " + std::string(jobs));
    CHECK(found.code == 1);
    CHECK(lines_with(found.text, "MET ") == 2);
    CHECK(lines_with(found.text, "MISSED ") == 1);
    CHECK(lines_with(found.text, "NOT RUN ") == 3);
    CHECK(lines_with(found.text, "6 entries: 2 met, 1 missed, 3 not run") == 1);
  }
}

TEST_CASE("an interrupt tells what is done, and exits with 3") {
  const BatchPlace place;
  const fs::path f = place.path() / "f";
  put_pair(f / "a", "possible root.success");
  put_endless(f / "b");
  put_pair(f / "c", "possible root.success");
  const Outcome found = run_in(
      place.path(),
      "f=f/.btcheck-results; " + kBatch +
          "f -q --jobs 1 >out 2>err & batch=$!; "
          "until [ -e $f ] && [ $(wc -l <$f) -ge 1 ]; do sleep 0.05; done; "
          "sleep 0.3; kill -INT $batch; wait $batch; echo $?");
  CHECK(found.text == "3\n");
  const std::string text = file_text(place.path() / "out");
  CHECK(lines_with(text, "MET ") == 1);
  CHECK(lines_with(text, "NOT RUN ") == 2);
  CHECK(lines_with(text, "3 entries: 1 met, 2 not run\n") == 1);
}

TEST_CASE("a time limit ends one entry, and the manifest says which") {
  const BatchPlace place;
  const fs::path f = place.path() / "f";
  put_pair(f / "a", "possible root.success");
  put_endless(f / "b");
  put(f / "batch.toml",
      "[[entry]]\nproperties = \"b.ltl\"\ntree = \"b.btf\"\ntimeout = 0.2\n"
      "[[entry]]\nproperties = \"a.ltl\"\ntree = \"a.btf\"\n"
      "expect = { p = \"violated\" }\n");
  const Outcome found = place.run("f --jobs 1 2>/dev/null");
  CHECK(found.code == 1);
  CHECK(found.text.starts_with("result "));
  CHECK(lines_with(found.text, "UNDECIDED    0 of 1 ") == 1);
  CHECK(lines_with(found.text, "MISSED       0 of 1 ") == 1);
  CHECK(found.text.find("the limit of --timeout") != std::string::npos);
  CHECK(found.text.find("expected a violation") != std::string::npos);
  CHECK(taken(place, "f --jobs 1") == 2);
}

TEST_CASE("a verdict expected of no property breaks its entry alone") {
  const BatchPlace place;
  const fs::path f = place.path() / "f";
  put_pair(f / "a", "possible root.success");
  put(f / "batch.toml",
      "[[entry]]\nproperties = \"a.ltl\"\ntree = \"a.btf\"\n"
      "expect = { p2 = \"violated\" }\n"
      "[[entry]]\nproperties = \"a.ltl\"\ntree = \"a.btf\"\n");
  CHECK(place.run("f 2>/dev/null").code == 2);
  CHECK(place.complaints("f") ==
        "error[BT1506]: no property is called `p2`\n"
        "  --> f/batch.toml:4:12\n"
        "  |\n"
        "4 | expect = { p2 = \"violated\" }\n"
        "  |            ^^\n"
        "  |\n"
        "  = help: there are: p\n\n");
}

TEST_CASE("the shards together are the whole batch") {
  const BatchPlace place;
  generate_trees(place.path() / "trees", 60);
  const std::string whole =
      without_times(place.run("trees -q 2>/dev/null").text);
  std::size_t met = 0;
  for (int i = 1; i <= 3; ++i) {
    const std::string part =
        place.run("trees -q --shard " + std::to_string(i) + "/3 2>/dev/null")
            .text;
    met += lines_with(part, "MET ");
    std::istringstream lines(without_times(part));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("MET ")) continue;
      CHECK(whole.find(line + "\n") != std::string::npos);
    }
  }
  CHECK(met == 57);
}

TEST_CASE(
    "the specifications of all node types are proven, and every example "
    "is as expected") {
  const BatchPlace place;
  for (const char* folder : {BTCHECK_PROPERTIES, BTCHECK_EXAMPLES}) {
    const fs::path copy = place.path() / fs::path(folder).filename();
    fs::copy(folder, copy, fs::copy_options::recursive);
    const Outcome found =
        place.run(quoted(copy) + " -q --jobs 2 --timeout 600 2>&1");
    CAPTURE(found.text);
    CHECK(found.code == 0);
    CHECK(lines_with(found.text, "MET ") >= 13);
  }
}

TEST_CASE("a job's summary is added to the page that GitHub names") {
  const BatchPlace place;
  put_pair(place.path() / "f/a", "never root.success");
  const std::string setting = "GITHUB_STEP_SUMMARY=page.md ";
  put(place.path() / "page.md", "before\n");
  const Outcome found =
      run_in(place.path(), setting + kBatch + "f --format github 2>/dev/null");
  CHECK(found.code == 1);
  CHECK(found.text.starts_with("::error file=f/a.btf,line=1,"));
  CHECK(file_text(place.path() / "page.md")
            .starts_with(
                "before\n### btcheck: 1 entry: 0 met, 1 missed; 1 error\n"));
}

TEST_CASE(
    "of runs that are kept, wrong ones are pictures on the page of a job") {
  const BatchPlace place;
  put_pair(place.path() / "f/a", "never root.success");
  put_pair(place.path() / "f/b", "possible root.success");
  const std::string setting = "GITHUB_STEP_SUMMARY=page.md ";
  const std::string words = "f --format github --trace-dir runs 2>/dev/null";
  for (const char* how : {"", "--resume "}) {
    fs::remove(place.path() / "page.md");
    run_in(place.path(), setting + kBatch + how + words);
    const std::string page = file_text(place.path() / "page.md");
    CAPTURE(page);
    CHECK(lines_with(page, "```mermaid") == 1);
    CHECK(page.find("<details><summary>f/a.ltl: VIOLATED p</summary>\n\n"
                    "```mermaid\nflowchart LR\n  n0[") != page.npos);
  }
}

TEST_CASE("a report that cannot be written is refused before anything else") {
  const BatchPlace place;
  put_pair(place.path() / "f/a", "possible root.success");
  for (const char* words : {"--report no/r.html", "--format junit=no/r.xml"}) {
    const Outcome found = place.run("f 2>&1 " + std::string(words));
    CHECK(found.code == 2);
    CHECK(found.text.starts_with("error[BT0004]: cannot write `no/r."));
  }
  CHECK(!fs::exists(place.path() / "f/.btcheck-results"));
}

}  // namespace
}  // namespace btcheck::batch_test

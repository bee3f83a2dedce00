// SPDX-License-Identifier: MIT
//
// `btcheck batch --results`: several processes that fill one folder, some of
// which are killed, and `--join`, which tells what is there.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "reference/effort.hpp"
#include "regress/batch_place.hpp"
#include "robust/child_process.hpp"

namespace btcheck::shared_batch_test {
namespace {

namespace fs = std::filesystem;

// A batch that runs beside others, and tells what it tells to NAME.out and
// NAME.err.
struct Member {
  Member(const BatchPlace& place, const std::string& name,
         const std::string& words)
      : file(place.path() / name),
        child({"/bin/sh", "-c",
               "exec " + kBatch + words + " >" + name + ".out 2>" + name +
                   ".err"},
              place.path()) {}

  std::string told() const { return file_text(file.string() + ".out"); }
  std::string said() const { return file_text(file.string() + ".err"); }

  fs::path file;
  ChildProcess child;
};

// Until something is so; a test that waits here for ever has failed.
template <class Condition>
void await(const Condition& is_so) {
  for (int tries = 0; tries < 60'000 && !is_so(); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  REQUIRE(is_so());
}

std::vector<fs::path> files_in(const BatchPlace& place,
                               const std::string& ending) {
  std::vector<fs::path> all;
  if (!fs::exists(place.path() / "shared")) return all;
  for (const auto& file : fs::directory_iterator(place.path() / "shared")) {
    if (file.path().extension() == ending) all.push_back(file.path());
  }
  return all;
}

// How many results each process has left.
std::map<int, std::size_t> makers(const BatchPlace& place) {
  std::map<int, std::size_t> all;
  for (const fs::path& file : files_in(place, ".result")) {
    const std::string text = file_text(file);
    const std::size_t at = text.find(", process ");
    REQUIRE(at < text.find('\n'));
    ++all[std::stoi(text.substr(at + 10))];
  }
  return all;
}

int number_in(const std::string& text, const std::string& pattern) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(pattern))
             ? std::stoi(found[1])
             : 0;
}

// How many entries a batch has checked itself, by what it has said.
int checked(const std::string& said) {
  return number_in(said, "([0-9]+) entr(y|ies) in [0-9.]+ s") -
         number_in(said, ", ([0-9]+) of them taken from `shared`");
}

std::string table(const std::string& told) { return without_times(told); }

TEST_CASE(
    "four processes check each entry once, and the report of their folder is "
    "that of one") {
  const BatchPlace place;
  // An entry is one whatever it says: of the properties a few will do.
  const std::string asked = reference::by_effort("/sequence", "");
  fs::copy(BTCHECK_PROPERTIES + asked, place.path() / "properties",
           fs::copy_options::recursive);
  generate_trees(place.path() / "trees", reference::by_effort(60, 200));
  const std::string words = "properties trees --jobs 1 --timeout 600 ";
  const Outcome alone = place.run(words + kFormats + "2>err");
  const std::string whole = reports_in(place, alone);
  const int entries =
      number_in(file_text(place.path() / "err"), "([0-9]+) entries in");
  CHECK(entries > reference::by_effort(60, 340));
  {
    std::vector<std::unique_ptr<Member>> members;
    for (const char* name : {"m1", "m2", "m3", "m4"}) {
      members.push_back(
          std::make_unique<Member>(place, name, words + "--results shared"));
    }
    int sum = 0;
    for (const auto& member : members) {
      CHECK(member->child.wait().code == alone.code);
      // Each has the whole of it.
      CHECK(table(member->told()) == table(alone.text));
      sum += checked(member->said());
    }
    CHECK(sum == entries);
  }
  CHECK(files_in(place, ".result").size() == static_cast<std::size_t>(entries));
  CHECK(files_in(place, ".lease").empty());
  CHECK(files_in(place, ".alive").empty());
  CHECK(files_in(place, ".tmp").empty());
  CHECK(reports_in(place, place.run(words + kFormats +
                                    "--join shared 2>err")) == whole);
  CHECK(checked(file_text(place.path() / "err")) == 0);
}

TEST_CASE("killed processes' entries are taken over, and no others") {
  const BatchPlace place;
  generate_trees(place.path() / "trees", 80);
  const std::string words = "trees --jobs 1 --results shared";
  const std::string whole = table(place.run("trees 2>/dev/null").text);
  Member one(place, "one", words);
  Member two(place, "two", words);
  Member other(place, "other", words);
  await([&] { return files_in(place, ".result").size() >= 10; });
  const int lost[] = {one.child.id(), two.child.id()};
  for (Member* member : {&one, &two}) {
    member->child.send(SIGKILL);
    member->child.wait();
  }
  const int id = other.child.id();
  CHECK(other.child.wait().code == 2);
  CHECK(table(other.told()) == whole);
  auto made = makers(place);
  CHECK(made[lost[0]] + made[lost[1]] + made[id] == 80);
  CHECK(made[id] == static_cast<std::size_t>(checked(other.said())));
  // Late joiners take what is left: here, nothing.
  const Outcome late = place.run(words + " 2>err");
  CHECK(table(late.text) == whole);
  CHECK(checked(file_text(place.path() / "err")) == 0);
}

// An entry that is soon done, and one that takes three seconds.
void put_short_and_long(const BatchPlace& place) {
  put_pair(place.path() / "f/a", "possible root.success");
  put_endless(place.path() / "f/b");
}
const std::string kLong = "f --jobs 1 --timeout 3 --results shared";

TEST_CASE("what a process held when it was killed is checked by the next") {
  const BatchPlace place;
  put_short_and_long(place);
  Member first(place, "first", kLong);
  await([&] {
    return files_in(place, ".result").size() == 1 &&
           files_in(place, ".lease").size() == 1;
  });
  first.child.send(SIGKILL);
  first.child.wait();
  CHECK(files_in(place, ".alive").size() == 1);
  const Outcome second = place.run(kLong + " 2>err");
  CHECK(second.code == 3);
  CHECK(lines_with(second.text, "2 entries: 1 met, 1 undecided\n") == 1);
  CHECK(checked(file_text(place.path() / "err")) == 1);
  CHECK(files_in(place, ".result").size() == 2);
  CHECK(files_in(place, ".lease").empty());
}

TEST_CASE("what somebody holds who lives is left to him, or waited for") {
  const BatchPlace place;
  put_short_and_long(place);
  const std::string words = "f --jobs 1 --results shared";
  Member owner(place, "owner", words);
  await([&] { return files_in(place, ".result").size() == 1; });
  await([&] { return files_in(place, ".lease").size() == 1; });
  const Outcome hasty = place.run(words + " --no-wait 2>err");
  CHECK(hasty.code == 3);
  CHECK(lines_with(hasty.text, "2 entries: 1 met, 1 not run\n") == 1);
  const std::string said = file_text(place.path() / "err");
  CHECK(said.find("warning[BT1513]: 1 of 2 entries: begun by ") !=
        std::string::npos);
  CHECK(said.find(", process " + std::to_string(owner.child.id()) +
                  ": f/b.ltl\n") != std::string::npos);
  const Outcome joined = place.run("f --join shared 2>err");
  CHECK(joined.code == 3);
  CHECK(file_text(place.path() / "err").find(": begun by ") !=
        std::string::npos);
  // It waits, and takes what is given up.
  Member patient(place, "patient", words);
  await([&] {
    return patient.said().find("; waiting for 1 entry that others check") !=
           std::string::npos;
  });
  const auto held = [&] {
    const auto leases = files_in(place, ".lease");
    return leases.size() == 1 ? file_text(leases[0]) : std::string();
  };
  const std::string before = held();
  CHECK(before.find("-" + std::to_string(owner.child.id()) + "-") !=
        std::string::npos);
  owner.child.send(SIGINT);
  CHECK(owner.child.wait().code == 3);
  await([&] {
    return held().find("-" + std::to_string(patient.child.id()) + "-") !=
           std::string::npos;
  });
  patient.child.send(SIGINT);
  CHECK(patient.child.wait().code == 3);
  CHECK(lines_with(patient.told(), "2 entries: 1 met, 1 not run\n") == 1);
  CHECK(files_in(place, ".lease").empty());
  CHECK(files_in(place, ".alive").empty());
}

TEST_CASE("two shards, joined, check nothing again") {
  const BatchPlace place;
  generate_trees(place.path() / "trees", 60);
  const std::string whole =
      reports_in(place, place.run("trees" + kReports + "2>err"));
  for (const char* part : {"1/2", "2/2"}) {
    const std::string words =
        std::string("trees --trace-dir runs --results shared --shard ") + part;
    place.run(words + " >/dev/null 2>err");
    CHECK(checked(file_text(place.path() / "err")) == 30);
  }
  const Outcome joined = place.run("trees" + kReports + "--join shared 2>err");
  CHECK(reports_in(place, joined) == whole);
  CHECK(checked(file_text(place.path() / "err")) == 0);
  // So does whoever comes with --results.
  place.run("trees --trace-dir runs --results shared >/dev/null 2>err");
  CHECK(checked(file_text(place.path() / "err")) == 0);
}

TEST_CASE("a join says what is missing, damaged, of other options or builds") {
  const BatchPlace place;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    put_pair(place.path() / "f" / name, "possible root.success");
  }
  CHECK(place.run("f --shard 1/2 --results shared -q").code == 0);
  CHECK(place.complaints("f --join shared") ==
        "warning[BT1513]: 2 of 5 entries: no result in `shared`: f/b.ltl, "
        "f/d.ltl\n  --> shared\n  = help: the same batch with --results "
        "instead of --join checks what is left\n\n");
  CHECK(place.complaints("f --join shared --tick nodes")
            .starts_with("warning[BT1513]: 2 of 5 entries: no result in "
                         "`shared`: f/b.ltl, f/d.ltl\n"));
  CHECK(place.complaints("f --join shared --tick nodes")
            .find("3 of 5 entries: result of other inputs or options in "
                  "`shared`: f/a.ltl, f/c.ltl, f/e.ltl\n") !=
        std::string::npos);
  const fs::path file = files_in(place, ".result").at(0);
  const std::string text = file_text(file);
  put(file, text.substr(0, text.size() / 2));
  CHECK(place.complaints("f --join shared")
            .find("1 of 5 entries: damaged or foreign result in `shared`: ") !=
        std::string::npos);
  const Outcome joined = place.run("f --join shared 2>/dev/null");
  CHECK(joined.code == 3);
  CHECK(lines_with(joined.text, "5 entries: 2 met, 3 not run\n") == 1);
  // What works in the folder mends it.
  CHECK(place.complaints("f --results shared") ==
        "warning[BT1508]: 1 of the results kept in `shared` is damaged, and "
        "done again\n  --> shared\n\n");
  CHECK(place.complaints("f --join shared").empty());
  // Another program of the same version: a byte behind its end.
  fs::copy_file(BTCHECK_PROGRAM, place.path() / "other");
  std::ofstream(place.path() / "other", std::ios::app) << ' ';
  CHECK(run_in(place.path(), "./other batch f --join shared -q 2>&1")
            .text.find("5 of 5 entries: result of another build in `shared`: "
                       "f/a.ltl, f/b.ltl, f/c.ltl and 2 more\n") !=
        std::string::npos);
  const Outcome nowhere = place.run("f --join nowhere 2>&1");
  CHECK(nowhere.code == 2);
  CHECK(nowhere.text == "error[BT0002]: cannot find the folder `nowhere`\n");
}

TEST_CASE("two joins at once tell the same") {
  const BatchPlace place;
  generate_trees(place.path() / "trees", 40);
  place.run("trees --results shared >/dev/null 2>&1");
  Member one(place, "one", "trees --format json --join shared");
  Member two(place, "two", "trees --format json --join shared");
  CHECK(one.child.wait().code == 2);
  CHECK(two.child.wait().code == 2);
  CHECK(without_times(one.told()) == without_times(two.told()));
  CHECK(files_in(place, ".result").size() == 40);
}

TEST_CASE("what another machine holds is left to it, until it falls silent") {
  const BatchPlace place;
  put_pair(place.path() / "f/a", "possible root.success");
  CHECK(place.run("f --results shared -q").code == 0);
  const fs::path result = files_in(place, ".result").at(0);
  const fs::path lease = fs::path(result).replace_extension(".1.lease");
  // Its clock is wrong by an hour, and it counts on while `counts` is there.
  const std::string counts =
      "touch counts; while [ -e counts ]; do n=$((n + 1)); "
      "echo robot 7 1 x/pid:[1] $n >sign; touch -d \"$hour\" sign; "
      "mv sign shared/robot-7-1.alive; sleep 0.02; done & ";
  for (const char* hour : {"-1 hour", "+1 hour"}) {
    fs::remove(result);
    put(place.path() / "shared/robot-7-1.alive", "robot 7 1 x/pid:[1] 0\n");
    put(lease, "robot-7-1\n");
    const Outcome hasty = run_in(
        place.path(), "hour='" + std::string(hour) + "'; " + counts + kBatch +
                          "f --results shared --no-wait 2>&1; code=$?; "
                          "rm counts; wait; exit $code");
    CHECK(hasty.code == 3);
    CHECK(hasty.text.find("begun by robot, process 7: f/a.ltl") !=
          std::string::npos);
    // And who does not wait for those who work waits for those who do not.
    CHECK(place.run("f --results shared --no-wait --lease 0.2 -q").code == 0);
    CHECK(fs::exists(result));
    CHECK(files_in(place, ".lease").empty());
  }
}

TEST_CASE("a full share costs the results, not the report") {
  const BatchPlace place;
  generate_trees(place.path() / "trees", 20);
  const Outcome alone = place.run("trees 2>/dev/null");
  // Nothing fits, or signs and leases do.
  for (const char* blocks : {"0", "1"}) {
    const std::string full = "ulimit -f " + std::string(blocks) + "; " +
                             kBatch + "trees --results shared -q ";
    CHECK(table(run_in(place.path(), full + "2>/dev/null").text) ==
          table(alone.text));
    CHECK(
        run_in(place.path(), full + "2>&1 >/dev/null")
            .text.find("warning[BT1509]: results are not kept: cannot write") !=
        std::string::npos);
    for (const char* ending : {".result", ".tmp", ".lease", ".alive"}) {
      CHECK(files_in(place, ending).empty());
    }
  }
}

TEST_CASE("what has failed is not tried again, unless it is said to be") {
  const BatchPlace place;
  put(place.path() / "f/a.btf", "(BehaviorTree :name t (Seq))\n");
  for (const auto& [more, count] : std::vector<std::pair<std::string, int>>{
           {"", 1}, {"", 0}, {"--resume", 1}, {"", 0}}) {
    const std::string& words = more;  // clang 14 captures no binding
    CAPTURE(words);
    const Outcome found = place.run("f --results shared " + words + " 2>err");
    CHECK(found.code == 2);
    CHECK(lines_with(found.text, "1 entry: 0 met, 1 broken") == 1);
    const std::string said = file_text(place.path() / "err");
    CHECK(said.starts_with("error[BT1004]: unknown node type `Seq`\n"));
    CHECK(checked(said) == count);
  }
  const Outcome joined = place.run("f --join shared -q 2>&1 >/dev/null");
  CHECK(joined.code == 2);
  CHECK(joined.text.starts_with("error[BT1004]: unknown node type `Seq`\n"));
}

TEST_CASE("for want of memory a worker is killed for all, by hand for one") {
  for (const auto& [signal, results] :
       std::vector<std::pair<std::string, std::size_t>>{{"KILL", 1},
                                                        {"TERM", 0}}) {
    const BatchPlace place;
    put_endless(place.path() / "f/b");
    Member member(place, "member", "f --results shared");
    await([&] { return !files_in(place, ".lease").empty(); });
    CHECK(run_in(place.path(), "kill -" + signal + " $(pgrep -P " +
                                   std::to_string(member.child.id()) + ")")
              .code == 0);
    CHECK(member.child.wait().code == (signal == "KILL" ? 3 : 4));
    CHECK(files_in(place, ".result").size() == results);
    CHECK(files_in(place, ".lease").empty());
  }
}

TEST_CASE("what took longest the last time is begun first") {
  const BatchPlace place;
  for (const char* name : {"a", "b"}) {
    put_pair(place.path() / "f" / name, "possible root.success");
  }
  put_endless(place.path() / "f/c");
  fs::create_directory(place.path() / "shared");
  for (const char* times : {"0.1 s: f/a.ltl", "7 s: f/b.ltl", "9 s: f/c.ltl"}) {
    put(place.path() / "shared" / (std::string(1, times[0]) + ".result"),
        "# btcheck 0.1.0 (build 0) on x in y, process 1\n# " +
            std::string(times) + "\n");
  }
  Member member(place, "member", "f --jobs 1 --results shared");
  await([&] { return !files_in(place, ".lease").empty(); });
  // Nothing was done before the last one was begun.
  std::string owner;
  await([&] {
    owner = member.said();
    return owner.find("; now f/") != std::string::npos;
  });
  CHECK(owner.find("; now f/c.ltl (") != std::string::npos);
  CHECK(files_in(place, ".result").size() == 3);
  member.child.send(SIGINT);
  CHECK(member.child.wait().code == 3);
  CHECK(lines_with(member.told(), "3 entries: 0 met, 3 not run\n") == 1);
}

}  // namespace
}  // namespace btcheck::shared_batch_test

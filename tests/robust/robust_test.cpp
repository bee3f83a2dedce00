// SPDX-License-Identifier: MIT
//
// The program where things go wrong around it: full disks, closed pipes,
// interrupts, kills, little memory. No file is left half-written, and the exit
// code is the right one.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "file_text.hpp"
#include "robust/child_process.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck {
namespace {

const std::string kProgram = BTCHECK_PROGRAM;
const std::string kDrone = BTCHECK_EXAMPLES "/drone3.btf";
const std::string kDroneRules = BTCHECK_EXAMPLES "/drone3.ltl";
const std::string kNav2 = BTCHECK_EXAMPLES "/nav2.btf";

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

// A run to be converted, in the folder.
std::string kept_run(const fs::path& folder) {
  const Outcome check = run_in(folder, kProgram + " " + kDrone +
                                           " --prop " BTCHECK_EXAMPLES
                                           "/demo.ltl --trace-dir . -q");
  REQUIRE(check.code == 1);
  const fs::path file = folder / "drone3.watched.itf.json";
  REQUIRE(fs::exists(file));
  return file.string();
}

TEST_CASE("a full disk under standard output is an error") {
  TemporaryFolder folder;
  const std::string kept = kept_run(folder.path());
  const std::vector<std::string> commands = {
      kDrone,
      kDrone + " --prop " + kDroneRules,
      kDrone + " --format json",
      kDrone + " --format sarif",
      kDrone + " --format junit",
      kDrone + " --format jsonl",
      "space " + kDrone,
      "space " + kDrone + " --stats json",
      "export " + kDrone + " --to promela",
      "trace " + kept + " --to text",
      "trace " + kept + " --to html",
      "simulate " + kDrone + " --seed 1",
      "demo",
      "--help",
      "--version"};
  for (const std::string& command : commands) {
    CAPTURE(command);
    const Outcome outcome =
        run_in(folder.path(), kProgram + " " + command + " 2>&1 >/dev/full");
    CHECK(outcome.code == 2);
    CHECK(outcome.text.find("error[BT0004]: cannot write the output: ") !=
          std::string::npos);
  }
}

// What a command leaves in a folder in which no file may grow beyond 4 KiB.
std::vector<std::string> left_behind(const std::string& command) {
  TemporaryFolder folder;
  const fs::path work = folder.path() / "work";
  fs::create_directory(work);
  const std::string kept = kept_run(folder.path());
  std::string words = command;
  if (const auto at = words.find("RUN"); at != words.npos) {
    words.replace(at, 3, kept);
  }
  const Outcome outcome = run_in(
      work, "ulimit -f 8; " + kProgram + " " + words + " 2>&1 >/dev/null");
  CHECK(outcome.code == 2);
  CHECK(outcome.text.find("error[BT0004]") != std::string::npos);
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(work)) {
    if (entry.is_regular_file()) names.push_back(entry.path().filename());
  }
  return names;
}

TEST_CASE("a file that cannot be written in full is not there") {
  for (const std::string& command : std::vector<std::string>{
           kDrone + " --prop " + kDroneRules + " --format json=report.json",
           kDrone + " --prop " + kDroneRules + " --format sarif=r.sarif",
           kDrone + " --prop " + kDroneRules + " --format junit=r.xml",
           "space " BTCHECK_EXAMPLES "/mars_rover.btf --export aut=graph.aut",
           "space " BTCHECK_EXAMPLES
           "/mars_rover.btf --reduce strong --export aut=graph.aut",
           "simulate " + kDrone + " --seed 3 -o run.itf.json",
           "trace RUN --to html -o run.html",
           "trace RUN --to mcap -o run.mcap"}) {
    CAPTURE(command);
    CHECK(left_behind(command) == std::vector<std::string>{});
  }
}

TEST_CASE("of runs that cannot be kept none is kept in part") {
  for (const std::string& name :
       left_behind(kDrone + " --prop " + kDroneRules + " --trace-dir runs")) {
    CHECK(name.find(".tmp") == std::string::npos);
  }
}

TEST_CASE("a pipe that nobody reads ends the program quietly") {
  TemporaryFolder folder;
  for (const std::string& command : std::vector<std::string>{
           "simulate " + kDrone + " --seed 3 --ticks 1000000",
           "export " + kNav2 + " --to promela", "space " + kDrone}) {
    CAPTURE(command);
    // The reader is gone before the first byte is written.
    const Outcome outcome =
        run_in(folder.path(), "{ sleep 0.2; " + kProgram + " " + command +
                                  " 2>err; echo $? >code; } | true; cat err");
    CHECK(file_text(folder.path() / "code") == "141\n");
    CHECK(outcome.text.find("error") == std::string::npos);
  }
}

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words{kProgram};
  std::istringstream stream(command);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Until the program has told something: how far its search is, or a first tick.
void await_output(const fs::path& folder) {
  for (int tries = 0; tries < 6000; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    for (const char* name : {"stdout", "stderr"}) {
      std::error_code none_yet;
      if (const auto size = fs::file_size(folder / name, none_yet);
          !none_yet && size > 0) {
        return;
      }
    }
  }
}

TEST_CASE("an interrupt ends every command with what is known") {
  TemporaryFolder folder;
  write(folder.path() / "ctl.ltl", "property p: AG EF root.success\n");
  write(folder.path() / "timed.ltl",
        "property p: whenever root.ticked then root.ended within 9999 ticks\n");
  write(folder.path() / "ltl.ltl",
        "property p: ([] <> SpinAction.running) => <> root.ended\n");
  write(folder.path() / "endless.btf",
        "(BehaviorTree :name t :loop 1\n"
        "  (Sequence (Action :ID a) (Action :ID b)))\n");
  const std::string free = kNav2 + " --reduce none ";
  for (const std::string& command : std::vector<std::string>{
           free, free + "--prop ctl.ltl", free + "--prop timed.ltl",
           "space " + kNav2, "space --search dfs " + kNav2,
           "space " + kNav2 + " --on-disk . --memory 20M",
           "simulate endless.btf --seed 3 --ticks 999999999 -o run.json"}) {
    CAPTURE(command);
    ChildProcess child(words_of(command), folder.path());
    await_output(folder.path());
    child.send(SIGINT);
    const Ending ending = child.wait();
    CHECK(ending.code == 3);
    MESSAGE(ending.seconds << " s from the interrupt to the end");
    CHECK(ending.seconds < 20);  // a hang; how fast it is, stands above
    CHECK(!file_text(folder.path() / "stdout").empty());
  }
  CHECK(fs::exists(folder.path() / "run.json"));
}

TEST_CASE(
    "an interrupt ends a run after its tick, and actions are told to stop") {
  TemporaryFolder folder;
  write(folder.path() / "endless.btf",
        "(BehaviorTree :name t :loop 1 (ParallelAll (Action :ID a :duration "
        "90000) (Action :ID b :duration 90000)))");
  write(folder.path() / "leaves.sh",
        R"(while read -r line; do
  id=${line#*\"id\":}
  id=${id%%,*}
  case $line in
    *begin*) echo "{\"id\":$id,\"answer\":\"ready\"}" ;;
    *halt*) echo "halted" >>halts; echo "{\"id\":$id,\"answer\":\"halted\"}" ;;
    *) echo "{\"id\":$id,\"answer\":\"running\"}" ;;
  esac
done
)");
  ChildProcess child({BTCHECK_PROGRAM, "run", "endless.btf", "--tick-ms", "20",
                      "--leaves-exec", "sh leaves.sh", "-o", "run.json"},
                     folder.path());
  await_output(folder.path());
  child.send(SIGINT);
  CHECK(child.wait().code == 3);
  CHECK(file_text(folder.path() / "halts") == "halted\nhalted\n");
  CHECK(file_text(folder.path() / "stderr").find("`a` is told to stop\n") !=
        std::string::npos);
  CHECK(fs::exists(folder.path() / "run.json"));
}

TEST_CASE("two runs are not kept in one file") {
  TemporaryFolder folder;
  write(folder.path() / "endless.btf",
        "(BehaviorTree :name t :loop 1 (Action :ID a))");
  ChildProcess first({BTCHECK_PROGRAM, "run", "endless.btf", "--tick-ms", "20",
                      "--seed", "1", "-o", "run.json"},
                     folder.path());
  await_output(folder.path());
  const Outcome second =
      run_in(folder.path(), quoted(fs::path(BTCHECK_PROGRAM)) +
                                " run endless.btf --seed 1 -o run.json 2>&1");
  CHECK(second.code == 2);
  CHECK(second.text ==
        "error[BT0004]: `run.json` is being written by another run\n");
  first.send(SIGINT);
  CHECK(first.wait().code == 3);
  CHECK(!file_text(folder.path() / "run.json").empty());
}

TEST_CASE("a port that another has is told before a tree starts") {
  TemporaryFolder folder;
  write(folder.path() / "tree.btf",
        "(BehaviorTree :name t (Action :ID a :duration [1,100000]))");
  const auto told = [&] { return file_text(folder.path() / "stderr"); };
  const std::vector<std::string> words = {kProgram, "run",   "tree.btf",
                                          "--seed", "1",     "--ticks",
                                          "100000", "--view"};
  ChildProcess first(words, folder.path());
  const std::string mark = "view: http://127.0.0.1:";
  std::size_t at = std::string::npos;
  for (int i = 0; i < 500 && at == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    at = told().find(mark);
  }
  REQUIRE(at != std::string::npos);
  const std::string port =
      std::to_string(std::stoi(told().substr(at + mark.size())));
  const Outcome second = run_in(
      folder.path(),
      kProgram + " run tree.btf --leaves-exec 'touch started' --view=" + port +
          " 2>&1");
  CHECK(second.code == 2);
  CHECK(second.text.find("error[BT1705]: the run cannot be shown on port " +
                         port + ": Address already in use") !=
        std::string::npos);
  CHECK(!fs::exists(folder.path() / "started"));
  // A view does not keep the run from ending.
  first.send(SIGINT);
  const Ending ending = first.wait();
  CHECK(ending.code == 3);
  CHECK(ending.seconds < 20);  // a hang
}

TEST_CASE("whoever ends the program, it tells what is known") {
  TemporaryFolder folder;
  for (const int signal : {SIGTERM, SIGHUP, SIGXCPU}) {
    for (const std::string& command :
         {kNav2 + " --reduce none --format json=report.json",
          "space " + kNav2 + " --reduce none"}) {
      CAPTURE(signal);
      CAPTURE(command);
      ChildProcess child(words_of(command), folder.path());
      await_output(folder.path());
      child.send(signal);
      CHECK(child.wait().code == 3);
      CHECK(!file_text(folder.path() / "stdout").empty());
    }
    CHECK(file_text(folder.path() / "report.json").ends_with("}\n"));
    fs::remove(folder.path() / "report.json");
  }
}

TEST_CASE("whenever the program is killed, every file is whole") {
  for (int delay = 0; delay < 12; ++delay) {
    CAPTURE(delay);
    TemporaryFolder folder;
    ChildProcess child(words_of(kDrone + " --prop " + kDroneRules +
                                " --trace-dir . --format json=report.json"),
                       folder.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(25 * delay));
    child.send(SIGKILL);
    child.wait();
    for (const auto& entry : fs::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename();
      CAPTURE(name);
      if (name.ends_with(".html")) {
        CHECK(file_text(entry.path()).ends_with("</html>\n"));
      } else if (name.ends_with(".json")) {
        CHECK(file_text(entry.path()).ends_with("}\n"));
      }
    }
  }
}

// Many leaves beside one another, each in its own time: many states at once.
std::string side_by_side(int leaves) {
  std::string text = "(BehaviorTree :name t :loop 1 (ParallelAll";
  for (int i = 0; i < leaves; ++i) {
    text += " (Action :ID a" + std::to_string(i) + ")";
  }
  return text + "))\n";
}

std::string side_by_side_in_xml(int pairs) {
  std::string text =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\">"
      "<ParallelAll max_failures=\"3\">";
  for (int i = 0; i < pairs; ++i) {
    const std::string number = std::to_string(i);
    text += "<Sequence><A" + number + "/><B" + number + "/></Sequence>";
  }
  return text + "</ParallelAll></BehaviorTree></root>\n";
}

// Long runs, one for each of many questions.
std::string one_after_the_other(int leaves) {
  std::string text = "(BehaviorTree :name t (Sequence";
  for (int i = 0; i < leaves; ++i) {
    text += "\n (Condition :ID c" + std::to_string(i) + ")";
  }
  return text + "))\n";
}

TEST_CASE("every command keeps its limit of memory") {
  TemporaryFolder folder;
  write(folder.path() / "ctl.ltl", "property p: AG EF root.success\n");
  write(folder.path() / "timed.ltl",
        "property p: whenever root.ticked then root.ended within 9999 ticks\n");
  write(folder.path() / "beside.btf", side_by_side(14));
  write(folder.path() / "beside.xml", side_by_side_in_xml(12));
  write(folder.path() / "after.btf", one_after_the_other(1000));
  write(folder.path() / "never.ltl",
        "property p: never root.success and a1.status == failure\n");
  write(folder.path() / "ltl.ltl",
        "property p: [] (a1.running => <> (a1.success or a2.running))\n");
  write(folder.path() / "beside.ltl",
        "property p: whenever a1.ticked then a2.ticked within 50 ticks\n");
  fs::create_directory(folder.path() / "many");
  for (const char* name : {"many/a.btf", "many/b.btf", "many/c.btf"}) {
    write(folder.path() / name, side_by_side(13));
  }
  const std::string free = kNav2 + " --reduce none -q ";
  constexpr std::uint64_t kLimit = 100;
  for (const std::string& command :
       std::vector<std::string>{free,
                                free + "--prop ctl.ltl",
                                free + "--prop timed.ltl",
                                "space -q " + kNav2,
                                "space -q --search dfs " + kNav2,
                                "space -q --threads 1 " + kNav2,
                                "space -q beside.btf",
                                "space -q beside.xml",
                                "beside.btf -q",
                                "beside.xml -q",
                                "after.btf -q",
                                "after.btf -q --format json",
                                "after.btf -q --format sarif",
                                "after.btf -q --trace-dir runs",
                                "beside.xml -q --trace-dir runs",
                                "beside.btf -q --prop never.ltl",
                                "beside.btf -q --prop never.ltl --search dfs",
                                "beside.btf -q --prop ltl.ltl",
                                "beside.btf -q --prop ltl.ltl --assume "
                                "actions-end",
                                "demo -q",
                                "beside.btf -q --prop ctl.ltl",
                                "beside.btf -q --prop beside.ltl",
                                "batch -q --jobs 2 many"}) {
    CAPTURE(command);
    ChildProcess child(
        words_of(command + " --memory " + std::to_string(kLimit) + "M"),
        folder.path());
    const Ending ending = child.wait();
    CHECK((ending.code == 0 || ending.code == 1 || ending.code == 3));
    MESSAGE((ending.peak_bytes >> 20)
            << " MiB of " << kLimit << ": " << command);
    CHECK(ending.peak_bytes < (kLimit << 20) / 10 * 11);
  }
}

}  // namespace
}  // namespace btcheck

// SPDX-License-Identifier: MIT
//
// Limits and signals where no search has begun: every command, every kind of
// input that once took minutes. What is measured is the time of the processor,
// so that a machine that does other things besides is no reason to fail.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "file_text.hpp"
#include "robust/child_process.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck {
namespace limits_test {
namespace {

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

std::string xml(const std::string& body) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"m\">" + body +
         "</BehaviorTree></root>";
}

std::string repeated(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// Each tree uses the one below it twice, with other remappings: doublings.
std::string doubled(int depth) {
  std::string text = "<root BTCPP_format=\"4\" main_tree_to_execute=\"t0\">";
  for (int i = 0; i < depth; ++i) {
    const std::string next = "<SubTree ID=\"t" + std::to_string(i + 1) + "\" ";
    text += "<BehaviorTree ID=\"t" + std::to_string(i) + "\"><Fallback>" +
            next + "_autoremap=\"true\"/>" + next +
            "x=\"{y}\"/></Fallback></BehaviorTree>";
  }
  return text + "<BehaviorTree ID=\"t" + std::to_string(depth) +
         "\"><Script code=\"x := 1\"/></BehaviorTree></root>";
}

std::string scripts(int count) {
  std::string body;
  for (int i = 0; i < count; ++i) {
    const std::string entry = "v" + std::to_string(i % 50);
    body += "<A _skipIf=\"" + entry + " > " + std::to_string(i) +
            "\" _post=\"" + entry + " := " + std::to_string(i % 7) + "\"/>\n";
  }
  return xml("<Sequence>" + body + "</Sequence>");
}

std::string rules(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "property p" + std::to_string(i) +
            ": always eventually (root.success or root.failure)\n";
  }
  return text;
}

std::string beside(int leaves) {
  std::string text = "(BehaviorTree :name t :loop 1 (ParallelAll";
  for (int i = 0; i < leaves; ++i) {
    text += " (Action :ID a" + std::to_string(i) + ")";
  }
  return text + "))\n";
}

void write_inputs(const fs::path& folder) {
  write(folder / "pairs.xml",
        xml("<Sequence>" + repeated(9000, "<A/><B/>") + "</Sequence>"));
  write(folder / "doubled.xml", doubled(12));
  write(folder / "scripts.xml", scripts(2500));
  write(folder / "beside.btf", beside(13));
  write(folder / "rules.ltl", rules(4000));
}

std::vector<std::string> words(const std::string& command) {
  std::vector<std::string> all = {BTCHECK_PROGRAM};
  std::istringstream stream(command);
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

constexpr double kSeconds = 1;
constexpr std::uint64_t kMegabytes = 150;

bool is_told(const fs::path& folder) {
  const std::string text =
      file_text(folder / "stdout") + file_text(folder / "stderr");
  return text.find("UNDECIDED") != std::string::npos;
}

TEST_CASE("limits hold in every stage of every command") {
  TemporaryFolder folder;
  write_inputs(folder.path());
  for (const std::string& command : std::vector<std::string>{
           "pairs.xml", "lint pairs.xml", "doubled.xml", "init doubled.xml",
           "space doubled.xml", "export doubled.xml --to fiacre",
           "simulate doubled.xml --seed 1 --ticks 5", "leaves scripts.xml",
           "scripts.xml", "lint scripts.xml", "batch scripts.xml",
           "scripts.xml --format json=report.json",
           "beside.btf --prop rules.ltl",
           "export beside.btf --to promela --prop rules.ltl"}) {
    CAPTURE(command);
    ChildProcess child(words(command + " -q --timeout 1 --memory 150M"),
                       folder.path());
    const Ending ending = child.wait();
    MESSAGE(ending.processor << " s, " << (ending.peak_bytes >> 20)
                             << " MiB, exit code " << ending.code << ": "
                             << command);
    CHECK(ending.signal == 0);
    CHECK(ending.code >= 0);
    CHECK(ending.code <= 3);
    // Threads besides work at the same time.
    CHECK(ending.processor < 2 * (kSeconds + 1));
    CHECK(ending.peak_bytes < (kMegabytes << 20) / 10 * 11);
    if (ending.code == 3) CHECK(is_told(folder.path()));
  }
  CHECK(file_text(folder.path() / "report.json").ends_with("}\n"));
}

TEST_CASE("a signal is heard before the first search, and says so") {
  TemporaryFolder folder;
  write_inputs(folder.path());
  for (const std::string& command : std::vector<std::string>{
           "init doubled.xml", "lint scripts.xml", "scripts.xml",
           "export doubled.xml --to smv", "conform doubled.xml"}) {
    CAPTURE(command);
    ChildProcess child(words(command + " -q"), folder.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    child.send(SIGTERM);
    const Ending ending = child.wait();
    MESSAGE(ending.seconds << " s from the signal to the end: " << command);
    CHECK(ending.signal == 0);
    CHECK(ending.seconds < 20);  // a hang; how fast it is, stands above
    if (ending.code == 3) CHECK(is_told(folder.path()));
  }
}

}  // namespace
}  // namespace limits_test
}  // namespace btcheck
